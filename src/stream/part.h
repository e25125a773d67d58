/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* One part of a cloud in memory, completed by the points of others that its own have among their
 * nearest. */
#ifndef CREASE_STREAM_PART_H
#define CREASE_STREAM_PART_H

#include "space/piece.h"
#include "stream/parts.h"

/* Bytes that a part takes for each of its points, those of others counted, with all that is made of
 * it; and for itself. */
enum { CREASE_PART_POINT = 135, CREASE_PART_FIXED = 3 << 20 };

typedef struct crease_held {
    crease_piece piece;
    crease_tree *tree;
    double *points;
    double *variance; /* as the scratch file has it */
    uint32_t *numbers;
    uint8_t *own;
    uint32_t *places; /* of own points in the piece, in the order of the scratch file */
} crease_held;

/* Loads a part. k: nearest points of each own one that are to be there. most: points that it may
 * have with those of others; when there would be more, *fits is false and nothing is loaded. */
crease_status crease_held_load(crease_context *context, const crease_parts *parts, size_t part,
    int k, size_t most, crease_held *out, bool *fits);
void crease_held_free(crease_held *held);
/* Writes the scores of own points back. */
crease_status crease_held_store(
    crease_context *context, const crease_parts *parts, size_t part, const crease_held *held);

#endif
