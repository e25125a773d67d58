/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Expansion of LZF, the compression inside PCD files. */
#ifndef CREASE_READ_LZF_H
#define CREASE_READ_LZF_H

#include <stdbool.h>
#include <stddef.h>

/* Three bytes stand for at most 264: no block expands to more than 88 times its size. */
enum { CREASE_LZF_MOST_GROWTH = 88 };

/* Expands a block that must come out at exactly out_size bytes; false when it is damaged. */
bool crease_lzf_expand(
    const unsigned char *in, size_t in_size, unsigned char *out, size_t out_size);

#endif
