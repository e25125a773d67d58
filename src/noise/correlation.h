/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Noise that neighbouring points share. */
#ifndef CREASE_NOISE_CORRELATION_H
#define CREASE_NOISE_CORRELATION_H

#include "base/context.h"

typedef struct crease_correlation {
    double sigma2; /* variance of the noise along the normal, shared errors included; 0: the windows
                      show none that neighbours share */
    double points; /* how many points err alike, as if they were one: at least 1 */
} crease_correlation;

/* sigma2: variance by windows of 24 points, in the square of the points' unit of length; the
 * result is in the same unit. spacing: of the points. */
crease_status crease_correlation_estimate(crease_context *context, const double *points,
    size_t count, double sigma2, double spacing, crease_correlation *out);

#endif
