/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A block is a row of pieces. A piece begins with a byte c:
 *   c < 32:   c + 1 bytes follow that are taken as they are;
 *   else      length = c >> 5, with 7 plus the next byte for 7; distance = (c & 31) << 8 plus the
 *             next byte; length + 2 bytes are repeated from distance + 1 bytes before, which may
 *             reach into the bytes that the piece itself makes. */
#include "read/lzf.h"

#include <string.h>

enum { FIRST_REPEAT = 32, LONG_REPEAT = 7 };

typedef struct block {
    const unsigned char *in, *in_end;
    unsigned char *begin, *out, *out_end;
} block;

static bool copy_literal(block *work, size_t length)
{
    if ((size_t)(work->in_end - work->in) < length || (size_t)(work->out_end - work->out) < length)
        return false;
    memcpy(work->out, work->in, length);
    work->in += length;
    work->out += length;
    return true;
}

static bool copy_repeat(block *work, unsigned control)
{
    size_t length = control >> 5;
    if (length == LONG_REPEAT && work->in < work->in_end)
        length += *work->in++;
    if (work->in == work->in_end)
        return false;
    const size_t back = ((size_t)(control & 31) << 8) + *work->in++ + 1;
    length += 2;
    if ((size_t)(work->out - work->begin) < back || (size_t)(work->out_end - work->out) < length)
        return false;
    for (const unsigned char *from = work->out - back; length; length--)
        *work->out++ = *from++;
    return true;
}

bool crease_lzf_expand(const unsigned char *in, size_t in_size, unsigned char *out, size_t out_size)
{
    block work = {
        .in = in, .in_end = in + in_size, .begin = out, .out = out, .out_end = out + out_size};
    while (work.in < work.in_end) {
        const unsigned control = *work.in++;
        const bool done =
            control < FIRST_REPEAT ? copy_literal(&work, control + 1) : copy_repeat(&work, control);
        if (!done)
            return false;
    }
    return work.out == work.out_end;
}
