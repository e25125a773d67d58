/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#ifndef CREASE_FIT_STRAIGHT_H
#define CREASE_FIT_STRAIGHT_H

#include "base/context.h"

/* Whether a height field with straight lines along its two axes can have the creases of a network:
 * seen along the z that crease_sheet_fit() would choose the points do not overlap, and the creases
 * are straight, and parallel or at right angles to each other. */
crease_status crease_straight(crease_context *context, const crease_cloud *cloud,
    const crease_network *network, bool *straight);

#endif
