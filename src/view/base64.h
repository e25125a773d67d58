/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Numbers as base64 of their little-endian bytes, written as they come. */
#ifndef CREASE_VIEW_BASE64_H
#define CREASE_VIEW_BASE64_H

#include "write/output.h"

enum { CREASE_BASE64_BYTES = 3 * 1024 };

typedef struct crease_base64 {
    crease_output *output;
    size_t used;
    uint8_t bytes[CREASE_BASE64_BYTES];
} crease_base64;

void crease_base64_begin(crease_base64 *encoder, crease_output *output);
/* The lowest `size` bytes (1, 2 or 4) of a value, the lowest first. */
void crease_base64_put(crease_base64 *encoder, uint32_t value, size_t size);
void crease_base64_put_float(crease_base64 *encoder, float value);
/* Writes what is left, with its padding. */
void crease_base64_end(crease_base64 *encoder);

#endif
