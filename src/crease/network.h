/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The creases of a cloud and their corners. Internal view. */
#ifndef CREASE_CREASE_NETWORK_H
#define CREASE_CREASE_NETWORK_H

#include "base/context.h"

struct crease_network {
    size_t count, corner_count, point_count;
    crease_network_crease *creases;
    crease_curve **curves; /* count */
    crease_corner *corners;
    uint8_t *features; /* by index */
    double spacing;
};

#endif
