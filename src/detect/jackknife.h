/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What the bootstrap variance of a normal tends to with ever more resamples, without resampling. */
#ifndef CREASE_DETECT_JACKKNIFE_H
#define CREASE_DETECT_JACKKNIFE_H

#include "detect/principal.h"

/* 0..1; 0 for points in a plane. O(k). The neighbourhood must not be degenerate. */
double crease_jackknife_variance(
    const crease_neighbourhood *neighbourhood, const crease_principal *principal);

#endif
