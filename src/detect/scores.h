/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What every point tells about a sharp edge near it. Internal view. */
#ifndef CREASE_DETECT_SCORES_H
#define CREASE_DETECT_SCORES_H

#include "detect/principal.h"

struct crease_scores {
    size_t count;
    double *variance;  /* count */
    double *normals;   /* count x 3 */
    uint8_t *features; /* count */
};

/* Makes room for the scores of so many points, all 0. */
crease_status crease_scores_create(crease_context *context, size_t count, crease_scores **out);

/* Takes the scores of these points from the context's folder; false when they are not there. */
bool crease_scores_load(crease_context *context, const double *points,
    const crease_detect_options *options, crease_scores *scores);
/* Keeps them there. */
void crease_scores_save(crease_context *context, const double *points,
    const crease_detect_options *options, const crease_scores *scores);

/* Room for the normals of the resamples of one neighbourhood. */
typedef struct crease_resamples {
    size_t room;       /* B */
    double *values[3]; /* components of the normals, room each */
    uint32_t *pending; /* resamples that have no normal yet, room */
} crease_resamples;

/* Bootstrap of the normal of one neighbourhood. */
typedef struct crease_normal_bootstrap {
    double mean[3];  /* eq. 3: mean of the resampled normals, turned to the side of the normal */
    double variance; /* eq. 4: trace of their covariance */
} crease_normal_bootstrap;

/* seed, stream: of the random draws. False when resamples have no normal, however often they are
 * drawn: the neighbours are nearly all in one place. The neighbourhood must not be degenerate. */
bool crease_normal_bootstrap_compute(const crease_neighbourhood *neighbourhood,
    const crease_principal *principal, uint64_t seed, uint64_t stream, crease_resamples *resamples,
    crease_normal_bootstrap *out);

#endif
