/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Whether a row of points in a plane has a kink at u = 0, or is smooth. */
#ifndef CREASE_CREASE_KINK_H
#define CREASE_CREASE_KINK_H

#include <stdbool.h>
#include <stddef.h>

typedef struct crease_profile_sample {
    double u, z; /* across, and height */
} crease_profile_sample;

typedef struct crease_kink {
    double smooth, kinked; /* what the best profile without and with a kink leaves, the sum of the
                              squared residuals in sigmas */
    double bend;           /* radians, of the profile with a kink */
    double error;          /* standard deviation of the bend, at most */
} crease_kink;

/* Measures the kink of points within -width..width; false when they do not determine a profile. The
 * noise of the heights is sigma. */
bool crease_kink_measure(const crease_profile_sample *samples, size_t count, double width,
    double spacing, double sigma, crease_kink *out);

#endif
