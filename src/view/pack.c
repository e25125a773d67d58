/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/pack.h"

#include "base/memory.h"
#include "view/base64.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { BLOCK = 4096, MOST_COMPONENTS = 3, LEVEL = 5 };

const crease_pack_form crease_pack_lattice = {"lattice", 3, 3, true};
const crease_pack_form crease_pack_direction = {"direction", 3, 2, true};
const crease_pack_form crease_pack_links = {"links", 2, 4, true};
const crease_pack_form crease_pack_triangles = {"triangles", 3, 4, true};

struct crease_pack {
    crease_pack_form form;
    z_stream stream;
    crease_base64 encoder;
    uint32_t previous[MOST_COMPONENTS];
    size_t component, tuples;                    /* where the next number goes */
    uint8_t planes[MOST_COMPONENTS * 4 * BLOCK]; /* of component c and byte b: from (c x bytes + b)
                                                     x BLOCK on */
    uint8_t room[8192];
};

crease_pack_form crease_pack_of_type(crease_type type)
{
    static const char *const names[] = {
        "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float32"};
    const bool fraction = type >= CREASE_TYPE_FLOAT32;
    return (crease_pack_form){names[type], 1, fraction ? 4 : crease_type_size(type), !fraction};
}

static void *take(void *context, unsigned count, unsigned size)
{
    return crease_allocate(context, count, size);
}

static void give_back(void *context, void *block)
{
    (void)context;
    free(block);
}

crease_status crease_pack_open(
    crease_context *context, crease_output *output, crease_pack_form form, crease_pack **out)
{
    crease_pack *const pack = crease_allocate(context, 1, sizeof *pack);
    *out = NULL;
    if (!pack)
        return CREASE_ERROR_NO_MEMORY;
    pack->form = form;
    pack->stream.zalloc = take;
    pack->stream.zfree = give_back;
    pack->stream.opaque = context;
    if (deflateInit(&pack->stream, LEVEL) != Z_OK) {
        free(pack);
        return CREASE_ERROR_NO_MEMORY;
    }
    crease_base64_begin(&pack->encoder, output);
    *out = pack;
    return CREASE_OK;
}

/* Deflates what the stream has been given and writes what comes out. */
static void drain(crease_pack *pack, int flush)
{
    do {
        pack->stream.next_out = pack->room;
        pack->stream.avail_out = sizeof pack->room;
        deflate(&pack->stream, flush);
        const size_t made = sizeof pack->room - pack->stream.avail_out;
        for (size_t i = 0; i < made; i++)
            crease_base64_put(&pack->encoder, pack->room[i], 1);
    } while (pack->stream.avail_out == 0);
}

static void flush_block(crease_pack *pack)
{
    for (size_t plane = 0; plane < pack->form.components * pack->form.bytes; plane++) {
        pack->stream.next_in = pack->planes + plane * BLOCK;
        pack->stream.avail_in = (unsigned)pack->tuples;
        drain(pack, Z_NO_FLUSH);
    }
    pack->tuples = 0;
}

/* The difference modulo 2^bits, its sign folded into the lowest bit. */
static uint32_t fold(uint32_t difference, unsigned bits)
{
    const uint32_t mask = bits < 32 ? (1U << bits) - 1 : UINT32_MAX;
    const bool negative = difference >> (bits - 1) & 1;
    return (negative ? ~(difference << 1) : difference << 1) & mask;
}

void crease_pack_put(crease_pack *pack, uint32_t value)
{
    const size_t bytes = pack->form.bytes, c = pack->component;
    uint32_t shown = value;
    if (pack->form.differences) {
        shown = fold(value - pack->previous[c], 8 * (unsigned)bytes);
        pack->previous[c] = value;
    }
    for (size_t b = 0; b < bytes; b++)
        pack->planes[(c * bytes + b) * BLOCK + pack->tuples] = (uint8_t)(shown >> 8 * b);
    pack->component = (c + 1) % pack->form.components;
    pack->tuples += pack->component == 0;
    if (pack->tuples == BLOCK)
        flush_block(pack);
}

void crease_pack_put_float(crease_pack *pack, float value)
{
    uint32_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    crease_pack_put(pack, bits);
}

void crease_pack_put_coordinate(crease_pack *pack, double value)
{
    const double most = pack->form.bytes == 3 ? 8388607 : 32767;
    crease_pack_put(pack, (uint32_t)(int32_t)lround(most * fmax(-1, fmin(1, value))));
}

void crease_pack_close(crease_pack *pack)
{
    if (!pack)
        return;
    flush_block(pack);
    drain(pack, Z_FINISH);
    crease_base64_end(&pack->encoder);
    deflateEnd(&pack->stream);
    free(pack);
}
