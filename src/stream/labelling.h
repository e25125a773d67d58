/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The regions of points and whether they lie beside a crease, by the regions and creases that were
 * found from a sample. */
#ifndef CREASE_STREAM_LABELLING_H
#define CREASE_STREAM_LABELLING_H

#include "detect/scoring.h"
#include "segment/assign.h"

/* What is found of the points of a piece. */
typedef struct crease_found {
    int32_t *regions;
    double *distances; /* from the region's surface */
    uint8_t *features;
} crease_found;

crease_status crease_found_create(crease_context *context, size_t count, crease_found *out);
void crease_found_free(crease_found *found);

typedef struct crease_labelling {
    crease_assignment assignment;
    const crease_regions *regions;
    const crease_network *network;
    bool whole;        /* the sample is the cloud: what is known of its points is the answer */
    double spacing;    /* of the cloud */
    uint64_t *sizes;   /* by region: points so far, */
    uint64_t *squares; /* and the sum of their squared distances, in shares of the squared distance
                          of an outlier: whole numbers, whose sum has no order */
} crease_labelling;

/* count: points of the whole cloud. */
crease_status crease_labelling_create(crease_context *context, const crease_regions *regions,
    const crease_network *network, size_t count, crease_labelling *out);
void crease_labelling_free(crease_labelling *labelling);
/* Forgets the points so far. */
void crease_labelling_begin(crease_labelling *labelling);
/* Labels the own points of a piece. tree: of all its points. */
crease_status crease_label(crease_context *context, crease_labelling *labelling,
    const crease_piece *piece, const crease_tree *tree, crease_found *found);
/* Tells regions and creases what all points are. */
void crease_labelling_settle(
    const crease_labelling *labelling, crease_regions *regions, crease_network *network);

/* What labelling needs to know, as bytes for another process of the same build; free() them. */
crease_status crease_labelling_pack(
    crease_context *context, const crease_labelling *labelling, char **bytes, size_t *size);
/* The same from such bytes; regions and network, which it looks at, hold no more than it needs. */
crease_status crease_labelling_unpack(crease_context *context, const char *bytes,
    crease_regions **regions, crease_network **network, crease_labelling *out);

#endif
