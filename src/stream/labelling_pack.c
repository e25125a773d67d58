/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Labelling in another process: the points, labels and surfaces of the sample, and the creases. */
#include "base/memory.h"
#include "base/packing.h"
#include "crease/network.h"
#include "spline/curve.h"
#include "stream/labelling.h"

#include <stdlib.h>
#include <string.h>

/* What is of one size. */
typedef struct summary {
    uint64_t points, regions, curves;
    double spacing, sigma;
    int32_t links, rounded;
} summary;

/* ---------------------------------------------------------------------------------- packing -- */

static void put_curve(crease_packing *out, const crease_curve *curve)
{
    const uint64_t sizes[2] = {(uint64_t)curve->order, curve->count};
    crease_packing_put(out, sizes, sizeof sizes);
    crease_packing_put(
        out, curve->knots, (curve->count + (size_t)curve->order) * sizeof *curve->knots);
    crease_packing_put(
        out, curve->control_points, 3 * curve->count * sizeof *curve->control_points);
}

static void put_all(crease_packing *out, const void *user)
{
    const crease_labelling *const from = user;
    const crease_regions *const regions = from->regions;
    const crease_network *const network = from->network;
    const size_t points = regions->count, count = regions->region_count;
    const summary head = {.points = points,
        .regions = count,
        .curves = network->count,
        .spacing = from->spacing,
        .sigma = from->assignment.sigma,
        .links = from->assignment.links,
        .rounded = regions->rounded != NULL};
    crease_packing_put(out, &head, sizeof head);
    crease_packing_put(out, regions->points, points * 3 * sizeof *regions->points);
    crease_packing_put(out, regions->labels, points * sizeof *regions->labels);
    crease_packing_put(out, regions->rounded, head.rounded ? points : 0);
    crease_packing_put(out, from->assignment.farthest, count * sizeof *from->assignment.farthest);
    crease_packing_put(out, regions->models, count * sizeof *regions->models);
    for (size_t r = 0; r < count; r++)
        crease_packing_put(out, regions->models[r].patch.coefficients,
            regions->models[r].patch.coefficient_count * sizeof(double));
    for (size_t c = 0; c < network->count; c++)
        put_curve(out, network->curves[c]);
}

crease_status crease_labelling_pack(
    crease_context *context, const crease_labelling *labelling, char **bytes, size_t *size)
{
    return crease_packing_make(context, put_all, labelling, bytes, size);
}

/* --------------------------------------------------------------------------------- unpacking -- */

typedef struct unpacking {
    crease_context *context;
    const char *from;
    bool failed; /* memory ran out: nothing is taken any more */
} unpacking;

static void get(unpacking *in, void *out, size_t size)
{
    if (in->failed)
        return;
    memcpy(out, in->from, size);
    in->from += size;
}

/* A block of so many elements; NULL once memory has run out. */
static void *get_new(unpacking *in, size_t count, size_t size)
{
    void *const block = in->failed ? NULL : crease_allocate(in->context, count, size);
    in->failed = !block;
    get(in, block, count * size);
    return block;
}

static crease_curve *get_curve(unpacking *in)
{
    uint64_t sizes[2] = {0, 0};
    crease_curve *const curve = in->failed ? NULL : crease_allocate(in->context, 1, sizeof *curve);
    in->failed = !curve;
    if (!curve)
        return NULL;
    get(in, sizes, sizeof sizes);
    curve->order = (int)sizes[0];
    curve->count = sizes[1];
    curve->knots = get_new(in, sizes[0] + sizes[1], sizeof *curve->knots);
    curve->control_points = get_new(in, sizes[1], 3 * sizeof *curve->control_points);
    return curve;
}

/* The blocks of the models come after all of them, and until then are not theirs. */
static void get_models(unpacking *in, crease_regions *regions, size_t count)
{
    regions->models = get_new(in, count, sizeof *regions->models);
    for (size_t r = 0; r < count && regions->models; r++)
        regions->models[r].patch.coefficients = NULL;
    regions->region_count = regions->models ? count : 0;
    for (size_t r = 0; r < regions->region_count; r++)
        regions->models[r].patch.coefficients =
            get_new(in, regions->models[r].patch.coefficient_count, sizeof(double));
}

static void get_network(unpacking *in, const summary *head, crease_network *network)
{
    network->spacing = head->spacing;
    network->curves = crease_allocate(in->context, head->curves, sizeof *network->curves);
    in->failed = in->failed || !network->curves;
    for (size_t c = 0; c < head->curves && !in->failed; c++)
        network->curves[network->count++] = get_curve(in);
}

static void get_all(
    unpacking *in, crease_regions *regions, crease_network *network, crease_labelling *out)
{
    summary head;
    get(in, &head, sizeof head);
    *out = (crease_labelling){.regions = regions,
        .network = network,
        .spacing = head.spacing,
        .assignment = {.regions = regions, .sigma = head.sigma, .links = head.links}};
    regions->count = head.points;
    regions->points = get_new(in, head.points, 3 * sizeof *regions->points);
    regions->labels = get_new(in, head.points, sizeof *regions->labels);
    if (head.rounded)
        regions->rounded = get_new(in, head.points, 1);
    out->assignment.farthest = get_new(in, head.regions, sizeof *out->assignment.farthest);
    get_models(in, regions, head.regions);
    get_network(in, &head, network);
    out->sizes = crease_allocate(in->context, head.regions, sizeof *out->sizes);
    out->squares = crease_allocate(in->context, head.regions, sizeof *out->squares);
    in->failed = in->failed || !out->sizes || !out->squares;
}

crease_status crease_labelling_unpack(crease_context *context, const char *bytes,
    crease_regions **regions, crease_network **network, crease_labelling *out)
{
    unpacking in = {.context = context, .from = bytes};
    *out = (crease_labelling){0};
    *regions = crease_allocate(context, 1, sizeof **regions);
    *network = crease_allocate(context, 1, sizeof **network);
    in.failed = !*regions || !*network;
    if (!in.failed)
        get_all(&in, *regions, *network, out);
    crease_status status = in.failed ? CREASE_ERROR_NO_MEMORY : CREASE_OK;
    if (status == CREASE_OK)
        status = crease_tree_create(
            context, (*regions)->points, (*regions)->count, &out->assignment.tree);
    if (status == CREASE_OK)
        return status;
    crease_labelling_free(out);
    crease_network_free(*network);
    crease_regions_free(*regions);
    *network = NULL;
    *regions = NULL;
    return status;
}
