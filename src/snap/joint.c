/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "snap/joint.h"

#include "base/memory.h"
#include "snap/cluster.h"

#include <math.h>
#include <stdlib.h>

static const double MET = 1e-12; /* of the terms: a relation that holds already, but for rounding */

crease_status crease_joint_make(crease_context *context, size_t count, crease_joint *out)
{
    *out = (crease_joint){.count = count};
    out->at = crease_allocate(context, count, sizeof *out->at);
    out->covariance = crease_allocate(context, count * count, sizeof *out->covariance);
    out->work = crease_allocate(context, count, sizeof *out->work);
    if (!out->at || !out->covariance || !out->work) {
        crease_joint_clear(out);
        return CREASE_ERROR_NO_MEMORY;
    }
    return CREASE_OK;
}

void crease_joint_clear(crease_joint *joint)
{
    free(joint->at);
    free(joint->covariance);
    free(joint->work);
    *joint = (crease_joint){0};
}

bool crease_joint_condition(crease_joint *joint, const double *row)
{
    const size_t n = joint->count;
    double value = 0.0, terms = 0.0, variance = 0.0, variances = 0.0;
    for (size_t i = 0; i < n; i++) {
        joint->work[i] = 0.0;
        for (size_t k = 0; k < n; k++)
            joint->work[i] += joint->covariance[n * i + k] * row[k];
        value += row[i] * joint->at[i];
        terms += fabs(row[i] * joint->at[i]);
        variance += row[i] * joint->work[i];
        variances += row[i] * row[i] * joint->covariance[(n + 1) * i];
    }
    if (fabs(value) <= MET * terms)
        return true;
    if (!(variance > MET * variances) || !(value * value < CREASE_WITHIN_ERRORS[1] * variance))
        return false;
    for (size_t i = 0; i < n; i++) {
        joint->at[i] -= joint->work[i] * value / variance;
        for (size_t k = 0; k < n; k++)
            joint->covariance[n * i + k] -= joint->work[i] * joint->work[k] / variance;
    }
    return true;
}
