/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/span.h"

#include <string.h>

bool crease_cursor_line(crease_cursor *cursor, crease_span *line)
{
    if (cursor->at >= cursor->end)
        return false;
    const char *stop = memchr(cursor->at, '\n', (size_t)(cursor->end - cursor->at));
    const char *next = stop ? stop + 1 : cursor->end;
    line->end = stop ? stop : cursor->end;
    line->at = crease_skip_blanks(cursor->at, line->end);
    while (line->end > line->at && crease_is_blank(line->end[-1]))
        line->end--;
    cursor->at = next;
    cursor->line++;
    return true;
}

bool crease_span_word(crease_span *line, crease_span *word)
{
    word->at = crease_skip_blanks(line->at, line->end);
    word->end = word->at;
    while (word->end < line->end && !crease_is_blank(*word->end))
        word->end++;
    line->at = word->end;
    return word->at < word->end;
}

size_t crease_span_words(crease_span line)
{
    size_t count = 0;
    crease_span word;
    while (crease_span_word(&line, &word) && *word.at != '#')
        count++;
    return count;
}

bool crease_span_is(crease_span word, const char *text)
{
    const size_t length = strlen(text);
    return (size_t)(word.end - word.at) == length && memcmp(word.at, text, length) == 0;
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c + 'a' - 'A') : c;
}

bool crease_span_is_like(crease_span word, const char *text)
{
    for (; word.at < word.end && *text; word.at++, text++)
        if (lower(*word.at) != *text)
            return false;
    return word.at == word.end && !*text;
}

bool crease_span_count(crease_span word, uint64_t *count)
{
    uint64_t value = 0;
    if (word.at == word.end)
        return false;
    for (; word.at < word.end; word.at++) {
        if (*word.at < '0' || *word.at > '9' || value > INT64_MAX / 10 - 1)
            return false;
        value = 10 * value + (uint64_t)(*word.at - '0');
    }
    *count = value;
    return true;
}

const char *crease_span_excerpt(crease_span word, char text[CREASE_EXCERPT_SIZE])
{
    const size_t length = (size_t)(word.end - word.at);
    const size_t kept = length < CREASE_EXCERPT_SIZE ? length : CREASE_EXCERPT_SIZE - 4;
    for (size_t i = 0; i < kept; i++)
        text[i] = word.at[i] >= ' ' && word.at[i] <= '~' ? word.at[i] : '?';
    memcpy(text + kept, kept < length ? "..." : "", kept < length ? 4 : 1);
    return text;
}
