/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/text.h"

#include "base/memory.h"

#include <string.h>

/* How many bytes follow the first one, -1 when it begins no sequence. */
static int followers(unsigned char first)
{
    if (first < 0x80)
        return 0;
    if (first >= 0xC2 && first <= 0xDF)
        return 1;
    if (first >= 0xE0 && first <= 0xEF)
        return 2;
    return first >= 0xF0 && first <= 0xF4 ? 3 : -1;
}

/* True for sequences that are too long for their value, surrogates, and values above U+10FFFF. */
static bool forbidden(unsigned char first, unsigned char second)
{
    return (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
}

size_t crease_text_sequence(const char *text)
{
    const unsigned char *bytes = (const unsigned char *)text;
    const int more = followers(bytes[0]);
    if (bytes[0] == 0 || more < 0)
        return 0;
    for (int i = 1; i <= more; i++)
        if ((bytes[i] & 0xC0) != 0x80)
            return 0;
    return more && forbidden(bytes[0], bytes[1]) ? 0 : (size_t)more + 1;
}

/* C0, DEL and C1 (U+0080 to U+009F), and the line separators U+2028 and U+2029. */
static bool control(const char *sequence, size_t length)
{
    const unsigned char *b = (const unsigned char *)sequence;
    return (length == 1 && (b[0] < 0x20 || b[0] == 0x7F)) ||
        (length == 2 && b[0] == 0xC2 && b[1] < 0xA0) ||
        (length == 3 && b[0] == 0xE2 && b[1] == 0x80 && (b[2] == 0xA8 || b[2] == 0xA9));
}

static size_t append(char *to, const char *from, size_t length)
{
    memcpy(to, from, length);
    return length;
}

char *crease_text_clean(crease_context *context, const char *text)
{
    const char *from = text ? text : "";
    char *clean = crease_allocate(context, 3 * strlen(from) + 1, 1);
    if (!clean)
        return NULL;
    size_t used = 0;
    while (*from) {
        const size_t length = crease_text_sequence(from);
        if (length == 0)
            used += append(clean + used, "\xEF\xBF\xBD", 3);
        else if (control(from, length))
            used += append(clean + used, " ", 1);
        else
            used += append(clean + used, from, length);
        from += length ? length : 1;
    }
    return clean;
}
