/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#ifndef CREASE_FIT_STRAIGHT_H
#define CREASE_FIT_STRAIGHT_H

#include "base/context.h"

/* What a height field with straight lines along its two axes can do with creases. */
typedef struct crease_straightness {
    bool straight; /* it can have them */
    bool nearly; /* or perhaps: they bend by little, which the surfaces beside them may be wrong by
                  */
    double point[3], direction[3]; /* of the longest of them; a unit vector */
} crease_straightness;

/* Whether a height field with straight lines along its two axes can have the creases of a network,
 * of which there must be one at least: seen along the z that crease_sheet_fit() would choose the
 * points do not overlap, and the creases are straight, and parallel or at right angles to each
 * other. */
crease_status crease_straight(crease_context *context, const crease_cloud *cloud,
    const crease_network *network, crease_straightness *out);

#endif
