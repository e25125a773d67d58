/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The stages of the search for creases, in order: chains along the intersections of neighbouring
 * regions; those that are no kinks removed; corners; curves; points beside them. */
#include "crease/network.h"

#include "base/memory.h"
#include "base/vector.h"
#include "crease/curve.h"
#include "crease/feature.h"
#include "crease/junction.h"
#include "crease/precision.h"
#include "crease/profile.h"
#include "crease/spur.h"
#include "crease/support.h"

#include <stdlib.h>
#include <string.h>

/* In spacings. */
static const double CURVE_TOLERANCE = 0.01;
static const double LEAD_IN = 3.0;    /* how far from a corner a curve bends towards it */
static const double EDGE_WIDTH = 3.0; /* where edges disturb the spacing */
static const double SHORTEST = 1.0;   /* crease that ends on its own */

static const double DEGREE = 3.14159265358979323846 / 180.0;

crease_network_options crease_network_options_default(void)
{
    return (crease_network_options){.least_turn = 10.0, .reach = 1.0};
}

/* --------------------------------------------------------------------------------- curves -- */

/* Moves the points at one end, the less the farther away, so that they lead straight into the
 * corner, which noise puts beside the intersection of two of its regions: a kink there would make
 * the curve swing. step: 1 when the corner is the first point, -1 when it is the last. */
static void lead_in(double *points, size_t count, ptrdiff_t step, double range)
{
    double *const corner = step > 0 ? points : points + 3 * (count - 1);
    const double *const first = corner + 3 * step;
    double forward[3], aside[3], away = 0.0;
    for (int c = 0; c < 3; c++) {
        forward[c] = first[3 * step + c] - first[c];
        aside[c] = corner[c] - first[c];
    }
    crease_vector_normalise(forward);
    const double along = crease_vector_dot(aside, forward);
    for (int c = 0; c < 3; c++)
        aside[c] -= along * forward[c];
    double *last = corner;
    for (size_t i = 1; i < count; i++) {
        double *const point = last + 3 * step;
        away += crease_vector_distance(last, point);
        if (away >= range)
            break;
        for (int c = 0; c < 3; c++)
            point[c] += (1.0 - away / range) * (1.0 - away / range) * aside[c];
        last = point;
    }
}

/* The points of a chain with the corners at its ends; returns their number. */
static size_t add_ends(
    const crease_chain *chain, const crease_junctions *corners, double range, double *points)
{
    const int32_t *const ends = chain->corners;
    size_t count = 0;
    if (ends[0] != CREASE_NO_CORNER)
        memcpy(points + 3 * count++, corners->items[ends[0]].place, 3 * sizeof *points);
    memcpy(points + 3 * count, chain->points, 3 * chain->count * sizeof *points);
    count += chain->count;
    if (ends[1] != CREASE_NO_CORNER)
        memcpy(points + 3 * count++, corners->items[ends[1]].place, 3 * sizeof *points);
    if (ends[0] != CREASE_NO_CORNER && count > 3)
        lead_in(points, count, 1, range);
    if (ends[1] != CREASE_NO_CORNER && count > 3)
        lead_in(points, count, -1, range);
    return count;
}

static crease_status fit_curve(crease_context *context, const crease_survey *survey,
    const crease_chain *chain, const crease_junctions *corners, crease_curve **out)
{
    double *const points = crease_allocate(context, chain->count + 2, 3 * sizeof *points);
    const double s = survey->spacing;
    *out = NULL;
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    const size_t count = add_ends(chain, corners, LEAD_IN * s, points);
    const crease_status status =
        crease_curve_fit(context, points, count, chain->closed, CURVE_TOLERANCE * s, out);
    free(points);
    return status;
}

static crease_network_crease describe(const crease_survey *survey, const crease_chain *chain)
{
    const crease_precision precision = crease_precision_estimate(survey, chain);
    return (crease_network_crease){.regions = {chain->regions[0], chain->regions[1]},
        .corners = {chain->corners[0], chain->corners[1]},
        .closed = chain->closed,
        .angle = 180.0 - crease_chain_mean_bend(chain) / DEGREE,
        .angle_error = precision.bend / DEGREE,
        .position_error = precision.position};
}

static crease_status make_curves(crease_context *context, const crease_survey *survey,
    const crease_chains *chains, const crease_junctions *corners, crease_network *network)
{
    network->creases = crease_allocate(context, chains->count, sizeof *network->creases);
    network->curves = crease_allocate(context, chains->count, sizeof *network->curves);
    crease_status status = network->creases && network->curves ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < chains->count && status == CREASE_OK; i++) {
        double domain[2];
        status = fit_curve(context, survey, &chains->items[i], corners, &network->curves[i]);
        if (status != CREASE_OK)
            break;
        network->creases[i] = describe(survey, &chains->items[i]);
        crease_curve_domain(network->curves[i], domain);
        network->creases[i].length = domain[1] - domain[0];
        network->count++;
    }
    return status;
}

static crease_status take_corners(
    crease_context *context, const crease_junctions *corners, crease_network *network)
{
    network->corners = crease_allocate(context, corners->count, sizeof *network->corners);
    if (!network->corners)
        return CREASE_ERROR_NO_MEMORY;
    network->corner_count = corners->count;
    for (size_t i = 0; i < corners->count; i++) {
        memcpy(network->corners[i].position, corners->items[i].place,
            sizeof network->corners[i].position);
        network->corners[i].valence = corners->items[i].valence;
    }
    return CREASE_OK;
}

/* -------------------------------------------------------------------------------- features -- */

/* Labels the points within `reach` true spacings of a crease: the spacing found first counts the
 * thickness of edges and noise as area, so it is measured again away from the creases. */
static crease_status label_points(
    crease_context *context, const crease_survey *survey, double reach, crease_network *network)
{
    const size_t count = survey->regions->count;
    const crease_curve *const *const curves = (const crease_curve *const *)network->curves;
    uint8_t *const near = crease_allocate(context, count, sizeof *near);
    network->features = crease_allocate(context, count, sizeof *network->features);
    network->point_count = count;
    const crease_bystanders all = {survey->regions->points, survey->tree, survey->spacing};
    crease_status status = CREASE_ERROR_NO_MEMORY;
    if (near && network->features)
        status = crease_features_mark(
            context, &all, curves, network->count, EDGE_WIDTH * survey->spacing, near);
    if (status == CREASE_OK)
        status = crease_features_spacing(context, survey, near, &network->spacing);
    if (status == CREASE_OK) {
        memset(near, 0, count);
        status = crease_features_mark(
            context, &all, curves, network->count, reach * network->spacing, near);
    }
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        network->features[survey->regions->order[i]] = near[i];
    free(near);
    return status;
}

/* --------------------------------------------------------------------------------- network -- */

static crease_status search(
    crease_context *context, const crease_survey *survey, double reach, crease_network *network)
{
    crease_chains chains = {.count = 0};
    crease_junctions corners = {.count = 0};
    crease_status status = crease_support_trace(context, survey, &chains);
    if (status == CREASE_OK)
        status = crease_profile_prune(context, survey, &chains);
    if (status == CREASE_OK)
        status = crease_junctions_find(context, survey, &chains, &corners);
    if (status == CREASE_OK) {
        crease_spurs_drop(&chains, &corners, SHORTEST * survey->spacing);
        status = make_curves(context, survey, &chains, &corners, network);
    }
    if (status == CREASE_OK)
        status = take_corners(context, &corners, network);
    if (status == CREASE_OK)
        status = label_points(context, survey, reach, network);
    crease_junctions_clear(&corners);
    crease_chains_clear(&chains);
    return status;
}

static crease_status check(crease_context *context, const crease_network_options *options)
{
    if (!(options->least_turn >= 1.0 && options->least_turn <= 90.0))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "creases: the least turn is %g degrees; give 1 to 90", options->least_turn);
    if (!(options->reach > 0.0 && options->reach <= 100.0))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "creases: features within %g spacings asked for; give more than 0, at most 100",
            options->reach);
    return CREASE_OK;
}

crease_status crease_network_find(crease_context *context, const crease_regions *regions,
    const crease_network_options *options, crease_network **out)
{
    *out = NULL;
    const crease_network_options chosen = options ? *options : crease_network_options_default();
    crease_tree *tree = NULL;
    crease_network *network = NULL;
    crease_status status = check(context, &chosen);
    if (status != CREASE_OK)
        return status;
    crease_stage(context, "creases");
    status = crease_tree_create(context, regions->points, regions->count, &tree);
    if (status != CREASE_OK)
        return status;
    network = crease_allocate(context, 1, sizeof *network);
    status = CREASE_ERROR_NO_MEMORY;
    if (network) {
        const crease_survey survey = {.regions = regions,
            .tree = tree,
            .spacing = regions->noise->spacing,
            .sigma = regions->sigma,
            .least_bend = chosen.least_turn * DEGREE};
        status = search(context, &survey, chosen.reach, network);
    }
    crease_tree_free(tree);
    if (status == CREASE_OK)
        *out = network;
    else
        crease_network_free(network);
    return status;
}

void crease_network_free(crease_network *network)
{
    if (!network)
        return;
    for (size_t i = 0; i < network->count; i++)
        crease_curve_free(network->curves[i]);
    free(network->creases);
    free(network->curves);
    free(network->corners);
    free(network->features);
    free(network);
}

size_t crease_network_count(const crease_network *network)
{
    return network->count;
}

crease_network_crease crease_network_at(const crease_network *network, size_t index)
{
    return network->creases[index];
}

const crease_curve *const *crease_network_curves(const crease_network *network)
{
    return (const crease_curve *const *)network->curves;
}

size_t crease_network_corner_count(const crease_network *network)
{
    return network->corner_count;
}

crease_corner crease_network_corner(const crease_network *network, size_t index)
{
    return network->corners[index];
}

size_t crease_network_point_count(const crease_network *network)
{
    return network->point_count;
}

const uint8_t *crease_network_features(const crease_network *network)
{
    return network->features;
}

double crease_network_spacing(const crease_network *network)
{
    return network->spacing;
}
