/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Spacing, noise and normals of a cloud. Internal view. */
#ifndef CREASE_CLOUD_NOISE_H
#define CREASE_CLOUD_NOISE_H

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

/* The same from neighbours that are known already: at least CREASE_NOISE_NEIGHBOURS of each point,
 * or all there are. */
crease_status crease_noise_estimate_from(crease_context *context, const double *points,
    const crease_neighbours *neighbours, crease_noise **out);

#endif
