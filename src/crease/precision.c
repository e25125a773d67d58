/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "crease/precision.h"

#include "base/vector.h"
#include "primitive/patch.h"

#include <math.h>

/* Variance of the model's tilt about the crease. The variance of its height u away from the crease
 * is v + 2 c u + t u^2, of which t is wanted. Of height fields only a mean is known: a plane over
 * the same rectangle with that mean would have a third of it in each of its three parameters. */
static double tilt_variance(
    const crease_model *model, const double place[3], const double inward[3], double away)
{
    if (model->type == CREASE_REGION_FREEFORM) {
        const crease_patch *const patch = &model->patch;
        const double length = patch->high[1] - patch->low[1];
        double slope[2], width = fmin(patch->high[0] - patch->low[0], length);
        if (patch->round)
            width = length;
        if (patch->ball)
            width *= crease_patch_at(patch, 0.0, 0.0, slope);
        return width > 0.0 ? 4.0 * crease_model_variance(model, place) / (width * width) : 0.0;
    }
    double before[3], after[3];
    for (int c = 0; c < 3; c++) {
        before[c] = place[c] - away * inward[c];
        after[c] = place[c] + away * inward[c];
    }
    const double second = crease_model_variance(model, before) +
        crease_model_variance(model, after) - 2.0 * crease_model_variance(model, place);
    return fmax(second, 0.0) / (2.0 * away * away);
}

/* Variances at one place. Two planes that move along their normals by independent errors move their
 * common line by (e1^2 + e2^2 - 2 e1 e2 cos) / sin^2, squared. */
static void add_place(const crease_survey *survey, const crease_chain *chain, const double place[3],
    double *position, double *bend)
{
    double gradients[2][3], along[3], inward[3];
    const crease_model *models[2];
    for (int side = 0; side < 2; side++) {
        models[side] = &survey->regions->models[chain->regions[side]];
        crease_model_distance(models[side], place, gradients[side]);
    }
    crease_vector_cross(gradients[0], gradients[1], along);
    const double sine_squared = crease_vector_dot(along, along);
    crease_vector_normalise(along);
    for (int side = 0; side < 2; side++) {
        crease_vector_cross(gradients[side], along, inward);
        *position += crease_model_variance(models[side], place) / sine_squared;
        *bend += tilt_variance(models[side], place, inward, survey->spacing);
    }
}

crease_precision crease_precision_estimate(const crease_survey *survey, const crease_chain *chain)
{
    double position = 0.0, bend = 0.0;
    for (size_t i = 0; i < chain->count; i++)
        add_place(survey, chain, chain->points + 3 * i, &position, &bend);
    const double count = (double)chain->count;
    return (crease_precision){sqrt(position / count), sqrt(bend / count)};
}
