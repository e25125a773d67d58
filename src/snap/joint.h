/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Many measured values with their joint covariance, conditioned on linear relations between them:
 * each takes all of them to what is then the most probable, and those before it remain met. */
#ifndef CREASE_SNAP_JOINT_H
#define CREASE_SNAP_JOINT_H

#include "base/context.h"

typedef struct crease_joint {
    size_t count;
    double *at;         /* count */
    double *covariance; /* count x count */
    double *work;       /* count */
} crease_joint;

/* All zero. O(count^2) memory. */
crease_status crease_joint_make(crease_context *context, size_t count, crease_joint *out);
void crease_joint_clear(crease_joint *joint);
/* Makes the sum of row[i] x value i zero. False, with nothing changed, when it is further from that
 * than 99 of 100 values that are zero would be measured. O(count^2). */
bool crease_joint_condition(crease_joint *joint, const double *row);

#endif
