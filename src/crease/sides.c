/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* For each region the mean of its points' distances across the chain, along its surface, beside the
 * mean of their amounts: 1 where all lie on one side, near 0 where the region goes on as if the
 * chain were not there. */
#include "crease/sides.h"

#include "base/vector.h"

#include <math.h>

static const double RADIUS = 4.0; /* in spacings, around a place of the chain */
/* A region ends at the chain, or on the other region: 0.04 to 0.08 is what crossing surfaces have,
 * 0.37 the least of true edges, at a hole smaller than the radius. */
static const double ENDS = 0.2, ALL_ON_ONE_SIDE = 0.8;
static const double RIB_SINE = 0.5;   /* a rib stands at 30 degrees or more */
static const double RIB_LENGTH = 5.0; /* in spacings, at least */

/* What the points of the two regions show. */
struct leaning {
    double signed_sum[2], sum[2]; /* of the distances across the chain, by region */
    double sine;                  /* sum of those of the angle between the models */
};

/* Directions in which the surfaces of both regions leave the chain, the sine of their angle. */
static double leave(const crease_survey *survey, const crease_chain *chain, const double place[3],
    double away[2][3])
{
    double gradients[2][3], along[3];
    for (int side = 0; side < 2; side++)
        crease_model_distance(
            &survey->regions->models[chain->regions[side]], place, gradients[side]);
    crease_vector_cross(gradients[0], gradients[1], along);
    const double sine = crease_vector_length(along);
    if (sine > 0.0)
        crease_vector_normalise(along);
    for (int side = 0; side < 2; side++)
        crease_vector_cross(gradients[side], along, away[side]);
    return sine;
}

static void add_place(const crease_survey *survey, const crease_chain *chain, const double place[3],
    uint32_t *found, struct leaning *leaning)
{
    const crease_regions *const regions = survey->regions;
    double away[2][3];
    size_t count = 0;
    leaning->sine += leave(survey, chain, place, away);
    crease_tree_within(
        survey->tree, place, RADIUS * survey->spacing, CREASE_SIDES_POINTS, found, &count);
    for (size_t i = 0; i < count && i < CREASE_SIDES_POINTS; i++)
        for (int side = 0; side < 2; side++) {
            if (regions->labels[found[i]] != (int32_t)chain->regions[side])
                continue;
            const double *const p = regions->points + 3 * (size_t)found[i];
            const double d[3] = {p[0] - place[0], p[1] - place[1], p[2] - place[2]};
            const double across = crease_vector_dot(d, away[side]);
            leaning->signed_sum[side] += across;
            leaning->sum[side] += fabs(across);
        }
}

bool crease_sides_end(const crease_survey *survey, const crease_chain *chain, uint32_t *found)
{
    struct leaning leaning = {{0.0, 0.0}, {0.0, 0.0}, 0.0};
    for (size_t i = 0; i < chain->count; i++)
        add_place(survey, chain, chain->points + 3 * i, found, &leaning);
    const double first = fabs(leaning.signed_sum[0]), second = fabs(leaning.signed_sum[1]);
    if (first >= ENDS * leaning.sum[0] && second >= ENDS * leaning.sum[1])
        return true;
    return (first >= ALL_ON_ONE_SIDE * leaning.sum[0] ||
               second >= ALL_ON_ONE_SIDE * leaning.sum[1]) &&
        leaning.sine >= RIB_SINE * (double)chain->count &&
        crease_chain_length(chain) >= RIB_LENGTH * survey->spacing;
}
