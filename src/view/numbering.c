/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/numbering.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

/* More different surfaces than a figure ever holds; those beyond keep their numbers. */
enum { NUMBERS_MOST = 512, DIGITS_MOST = 18 };

typedef struct renaming {
    unsigned long long old[NUMBERS_MOST];
    size_t count;
} renaming;

/* The new number, counted from 1, of an old one. */
static unsigned long long renumber(renaming *r, unsigned long long old)
{
    for (size_t i = 0; i < r->count; i++)
        if (r->old[i] == old)
            return i + 1;
    if (r->count == NUMBERS_MOST)
        return old;
    r->old[r->count++] = old;
    return r->count;
}

/* The length of `id="surface` or `#surface` and the like at the text, 0 when there is none. */
static size_t identifier(const char *text, size_t left)
{
    static const char *const openings[] = {"id=\"", "#"};
    static const char *const kinds[] = {"surface", "image", "mask", "source", "compositing-group"};
    for (size_t o = 0; o < sizeof openings / sizeof *openings; o++) {
        const size_t opening = strlen(openings[o]);
        if (left <= opening || memcmp(text, openings[o], opening) != 0)
            continue;
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
            const size_t kind = strlen(kinds[k]);
            if (left > opening + kind && memcmp(text + opening, kinds[k], kind) == 0 &&
                isdigit((unsigned char)text[opening + kind]))
                return opening + kind;
        }
    }
    return 0;
}

void crease_numbering_write(crease_output *output, const char *text, size_t size)
{
    renaming r = {.count = 0};
    size_t written = 0, at = 0;
    while (at < size) {
        const bool begins = text[at] == '#' || text[at] == 'i';
        const size_t length = begins ? identifier(text + at, size - at) : 0;
        at += length ? length : 1;
        if (length == 0)
            continue;
        crease_output_bytes(output, text + written, at - written);
        unsigned long long old = 0;
        for (int i = 0; at < size && isdigit((unsigned char)text[at]) && i < DIGITS_MOST; i++)
            old = 10 * old + (unsigned long long)(text[at++] - '0');
        crease_output_format(output, "%llu", renumber(&r, old));
        written = at;
    }
    crease_output_bytes(output, text + written, size - written);
}
