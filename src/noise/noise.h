/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Spacing, noise and normals of a cloud. Internal view. */
#ifndef CREASE_NOISE_NOISE_H
#define CREASE_NOISE_NOISE_H

#include "base/context.h"

/* Neighbours that the estimate looks at, the point itself included. */
enum { CREASE_NOISE_NEIGHBOURS = 25 };

struct crease_noise {
    size_t count;
    double spacing;  /* s = sqrt(area / count), away from thin places */
    double sigma;    /* standard deviation along the normal; at least 0.03 s, the flatness that any
                        comparison with the noise is allowed to ask for */
    double alike;    /* how many neighbouring points err as if they were one, at least 1 */
    double *normals; /* count x 3: of the side of an edge that the point lies on; sign arbitrary */
    float *scores;   /* mean squared residual of the point's surroundings over sigma^2 */
    float *local_spacing; /* spacing around each point */
};

/* Makes room for so many points. */
crease_status crease_noise_create(crease_context *context, size_t count, crease_noise **out);

/* What is asked of the windows of all points at once. In units of the unit, or its square. */
typedef enum crease_noise_value {
    CREASE_WIDE_VARIANCE,  /* of the residuals of the wide window */
    CREASE_WIDE_REACH,     /* squared distance of its farthest point */
    CREASE_TIGHT_VARIANCE, /* the same of a plane through 8 neighbours */
    CREASE_TIGHT_REACH,
    CREASE_NO_VALUE
} crease_noise_value;

/* Gets that number of every point of a cloud, wherever it is known. */
typedef struct crease_noise_source {
    crease_status (*get)(void *user, crease_noise_value which, double *values);
    void *user;
} crease_noise_source;

typedef struct crease_noise_scale {
    double unit;       /* of length: about the spacing, whatever that is */
    double raw_sigma2; /* in square units, by small windows */
    double sigma2;     /* the same, at least the least that is told from rounding */
    double spacing2;   /* in square units */
    bool thin;         /* walls are so thin that wide windows see both sides */
    bool terraced;     /* points beside each other have been rounded alike */
} crease_noise_scale;

/* The steps of the estimate, for a cloud whose points are shared out; each sees the whole cloud, or
 * one number of every point.
 * The unit. Errors: DEGENERATE. */
crease_status crease_noise_measure(
    crease_context *context, const double *points, size_t count, crease_noise_scale *scale);
/* The rest of the scale. k: neighbours that are known. Errors: DEGENERATE. */
crease_status crease_noise_scale_find(crease_context *context, const crease_noise_source *source,
    size_t count, int k, crease_noise_scale *scale);
/* Spacing, sigma and alike of the noise. */
crease_status crease_noise_judge(crease_context *context, const double *points,
    const crease_noise_scale *scale, crease_noise *noise);

/* The same from neighbours that are known already: at least CREASE_NOISE_NEIGHBOURS of each point,
 * or all there are. */
crease_status crease_noise_estimate_from(crease_context *context, const double *points,
    const crease_neighbours *neighbours, crease_noise **out);

#endif
