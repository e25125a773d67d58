/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "stream/labelling.h"

#include "base/memory.h"
#include "crease/feature.h"
#include "crease/network.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the squared distance beyond which a point is an outlier; and the most for one point. */
static const double SHARES = 0x1p24, MOST_SHARES = 0x1p31;

crease_status crease_found_create(crease_context *context, size_t count, crease_found *out)
{
    *out = (crease_found){.regions = crease_allocate(context, count, sizeof *out->regions),
        .distances = crease_allocate(context, count, sizeof *out->distances),
        .features = crease_allocate(context, count, sizeof *out->features)};
    if (out->regions && out->distances && out->features)
        return CREASE_OK;
    crease_found_free(out);
    return CREASE_ERROR_NO_MEMORY;
}

void crease_found_free(crease_found *found)
{
    free(found->regions);
    free(found->distances);
    free(found->features);
    *found = (crease_found){0};
}

/* The spacing is the root of the area that a point has: the sample has the same area. */
crease_status crease_labelling_create(crease_context *context, const crease_regions *regions,
    const crease_network *network, size_t count, crease_labelling *out)
{
    const size_t regions_count = regions->region_count;
    *out = (crease_labelling){.regions = regions,
        .network = network,
        .whole = regions->count == count,
        .spacing = network->spacing * sqrt((double)regions->count / (double)count),
        .sizes = crease_allocate(context, regions_count, sizeof *out->sizes),
        .squares = crease_allocate(context, regions_count, sizeof *out->squares)};
    crease_status status = out->sizes && out->squares ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_assignment_create(context, regions, out->spacing, &out->assignment);
    if (status != CREASE_OK)
        crease_labelling_free(out);
    return status;
}

void crease_labelling_free(crease_labelling *labelling)
{
    crease_assignment_free(&labelling->assignment);
    free(labelling->sizes);
    free(labelling->squares);
    *labelling = (crease_labelling){0};
}

void crease_labelling_begin(crease_labelling *labelling)
{
    const size_t count = labelling->regions->region_count;
    memset(labelling->sizes, 0, count * sizeof *labelling->sizes);
    memset(labelling->squares, 0, count * sizeof *labelling->squares);
}

static void take_known(
    const crease_labelling *labelling, const crease_piece *piece, crease_found *found)
{
    for (size_t i = 0; i < piece->count; i++) {
        const size_t number = crease_piece_number(piece, i);
        found->regions[i] = labelling->regions->labels_by_index[number];
        found->features[i] = labelling->network->features[number];
    }
}

static crease_status find(crease_context *context, const crease_labelling *labelling,
    const crease_piece *piece, const crease_tree *tree, crease_found *found)
{
    const crease_network *const network = labelling->network;
    const crease_bystanders all = {piece->points, tree, labelling->spacing};
    const double reach = crease_network_options_default().reach;
    const crease_status status = crease_assign(context, &labelling->assignment, piece->points,
        piece->own, piece->count, found->regions, found->distances);
    return status == CREASE_OK ? crease_features_mark(context, &all, crease_network_curves(network),
                                     network->count, reach * labelling->spacing, found->features)
                               : status;
}

crease_status crease_label(crease_context *context, crease_labelling *labelling,
    const crease_piece *piece, const crease_tree *tree, crease_found *found)
{
    crease_stage(context, "labels");
    if (labelling->whole) {
        take_known(labelling, piece, found);
        return CREASE_OK;
    }
    const crease_status status = find(context, labelling, piece, tree, found);
    for (size_t i = 0; i < piece->count && status == CREASE_OK; i++) {
        if (!crease_piece_owns(piece, i) || found->regions[i] < 0)
            continue;
        const int32_t region = found->regions[i];
        const double share = found->distances[i] / labelling->assignment.farthest[region];
        labelling->sizes[region]++;
        labelling->squares[region] += (uint64_t)(fmin(SHARES * share * share, MOST_SHARES) + 0.5);
    }
    return status;
}

void crease_labelling_settle(
    const crease_labelling *labelling, crease_regions *regions, crease_network *network)
{
    for (size_t r = 0; r < regions->region_count && !labelling->whole; r++) {
        const double size = (double)labelling->sizes[r];
        const double squares = (double)labelling->squares[r] / SHARES;
        regions->sizes[r] = labelling->sizes[r];
        regions->rms[r] = size > 0 ? labelling->assignment.farthest[r] * sqrt(squares / size) : 0.0;
    }
    regions->noise_sigma = fmin(regions->noise_sigma, labelling->assignment.sigma);
    network->spacing = labelling->spacing;
}
