/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Edges that a scanner has rounded: a camera that matches windows of pixels shows no edge sharper
 * than its window, but a bent strip some spacings wide. */
#ifndef CREASE_NOISE_BLUR_H
#define CREASE_NOISE_BLUR_H

#include "noise/noise.h"

/* Half the width of a rounded edge, at most, in spacings. */
static const double CREASE_BLUR_REACH = 5.0;

/* Whether all edges of the cloud are rounded so, and, if they are, which points lie on them: those
 * where the surface turns by more than about 30 degrees within 5 spacings. Never so where
 * neighbouring points err independently of each other: then what is round is the surface. */
crease_status crease_blur_find(crease_context *context, const double *points, size_t count,
    const crease_noise *noise, bool *blurred, uint8_t *bent);

#endif
