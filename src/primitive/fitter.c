/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "primitive/fitter.h"

#include "base/memory.h"
#include "base/select.h"
#include "primitive/patch.h"

#include <math.h>
#include <stdlib.h>

/* Residuals looked at for the scale. */
enum { SCALE_POINTS = 255 };

static size_t take(crease_fitter *fitter, size_t at, size_t count, double **out)
{
    *out = fitter->memory ? fitter->memory + at : NULL;
    return at + count;
}

/* Gives every array its part of the memory; returns how much there is to be. */
static size_t divide(crease_fitter *fitter)
{
    const size_t n = CREASE_SAMPLE_POINTS, m = CREASE_PATCH_COEFFICIENTS;
    size_t at = 0;
    for (int i = 0; i < 2; i++) {
        at = take(fitter, at, n, &fitter->residuals[i]);
        at = take(fitter, at, 3 * n, &fitter->gradients[i]);
    }
    at = take(fitter, at, n, &fitter->weights);
    at = take(fitter, at, 3 * n, &fitter->local);
    at = take(fitter, at, SCALE_POINTS, &fitter->deviations);
    at = take(fitter, at, 3 * n, &fitter->sample.points);
    at = take(fitter, at, 3 * n, &fitter->sample.normals);
    at = take(fitter, at, 3 * n, &fitter->screen.points);
    at = take(fitter, at, m * m, &fitter->matrix);
    at = take(fitter, at, m, &fitter->right);
    at = take(fitter, at, m, &fitter->support);
    for (int i = 0; i < CREASE_FITTER_CANDIDATES; i++)
        at = take(fitter, at, m, &fitter->coefficients[i]);
    return at;
}

crease_status crease_fitters_create(crease_context *context, crease_fitter **out)
{
    const size_t threads = (size_t)crease_context_threads(context);
    crease_fitter *const fitters = crease_allocate(context, threads, sizeof *fitters);
    *out = NULL;
    if (!fitters)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < threads; i++) {
        fitters[i].memory = crease_allocate(context, divide(&fitters[i]), sizeof(double));
        if (!fitters[i].memory) {
            crease_fitters_free(context, fitters);
            return CREASE_ERROR_NO_MEMORY;
        }
        divide(&fitters[i]);
    }
    *out = fitters;
    return CREASE_OK;
}

void crease_fitters_free(crease_context *context, crease_fitter *fitters)
{
    if (!fitters)
        return;
    for (size_t i = 0; i < (size_t)crease_context_threads(context); i++)
        free(fitters[i].memory);
    free(fitters);
}

double crease_fit_scale(const crease_fitter *fitter, const double *residuals, size_t count)
{
    const size_t looked = count < SCALE_POINTS ? count : SCALE_POINTS;
    for (size_t i = 0; i < looked; i++)
        fitter->deviations[i] = fabs(residuals[i * count / looked]);
    return fmax(1.4826 * crease_select(fitter->deviations, looked, looked / 2), fitter->sigma);
}

double crease_fit_weight(double residual, double scale)
{
    const double t = 1.0 + residual * residual / (9.0 * scale * scale);
    return 1.0 / (t * t);
}
