/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Pieces of text in a source, and walking over its lines: what headers are read with. */
#ifndef CREASE_READ_SPAN_H
#define CREASE_READ_SPAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The characters at..end-1. */
typedef struct crease_span {
    const char *at, *end;
} crease_span;

/* Walks over lines; `line` is the number of the line last taken, the first is 1. */
typedef struct crease_cursor {
    const char *at, *end;
    size_t line;
} crease_cursor;

enum { CREASE_EXCERPT_SIZE = 28 };

static inline bool crease_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

static inline const char *crease_skip_blanks(const char *at, const char *end)
{
    while (at < end && crease_is_blank(*at))
        at++;
    return at;
}

/* Takes the next line without the blanks around it; false at the end. */
bool crease_cursor_line(crease_cursor *cursor, crease_span *line);
/* Takes the next word of the line off its front; false when there is none. */
bool crease_span_word(crease_span *line, crease_span *word);
/* Number of words in front of any comment. */
size_t crease_span_words(crease_span line);
/* True when the word is this text. */
bool crease_span_is(crease_span word, const char *text);
/* The same in any case; the text in lower case. */
bool crease_span_is_like(crease_span word, const char *text);
/* Reads a whole number 0..2^63-1; false when the word is anything else. */
bool crease_span_count(crease_span word, uint64_t *count);
/* A printable copy for a sentence, cut when long. Returns text. */
const char *crease_span_excerpt(crease_span word, char text[CREASE_EXCERPT_SIZE]);

#endif
