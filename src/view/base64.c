/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/base64.h"

#include <string.h>

void crease_base64_begin(crease_base64 *encoder, crease_output *output)
{
    encoder->output = output;
    encoder->used = 0;
}

/* Four characters for the three bytes at `bytes`. */
static void encode(const uint8_t *bytes, char out[4])
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const uint32_t all = (uint32_t)bytes[0] << 16 | (uint32_t)bytes[1] << 8 | bytes[2];
    for (int i = 0; i < 4; i++)
        out[i] = digits[all >> (18 - 6 * i) & 63];
}

static void flush(crease_base64 *encoder)
{
    char text[CREASE_BASE64_BYTES / 3 * 4];
    const size_t groups = (encoder->used + 2) / 3, missing = 3 * groups - encoder->used;
    memset(encoder->bytes + encoder->used, 0, missing);
    for (size_t i = 0; i < groups; i++)
        encode(encoder->bytes + 3 * i, text + 4 * i);
    memset(text + 4 * groups - missing, '=', missing);
    crease_output_bytes(encoder->output, text, 4 * groups);
    encoder->used = 0;
}

void crease_base64_put(crease_base64 *encoder, uint32_t value, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        encoder->bytes[encoder->used++] = (uint8_t)(value >> 8 * i);
        if (encoder->used == CREASE_BASE64_BYTES)
            flush(encoder);
    }
}

void crease_base64_put_float(crease_base64 *encoder, float value)
{
    uint32_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    crease_base64_put(encoder, bits, 4);
}

void crease_base64_end(crease_base64 *encoder)
{
    flush(encoder);
}
