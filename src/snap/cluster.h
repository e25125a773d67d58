/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Measured values of one or two dimensions, each with its covariance: which of them may be one and
 * the same. */
#ifndef CREASE_SNAP_CLUSTER_H
#define CREASE_SNAP_CLUSTER_H

#include "base/context.h"

#include <stdint.h>

enum { CREASE_NO_CLUSTER = -1 };

/* Squared deviation in standard errors that 99 of 100 values stay below, by dimensions. */
static const double CREASE_WITHIN_ERRORS[3] = {0.0, 6.63, 9.21};

typedef struct crease_value {
    double at[2];
    double covariance[3]; /* xx xy yy; the rest is 0 in one dimension */
} crease_value;

/* The value of an item in the coordinates of another one, the first of a cluster; false when the
 * two are not to be compared. */
typedef bool crease_value_of(void *user, size_t item, size_t leader, crease_value *out);

typedef struct crease_cluster {
    size_t leader, size;
    crease_value mean; /* in the leader's coordinates */
} crease_cluster;

typedef struct crease_clusters {
    int32_t *of; /* for every item, or CREASE_NO_CLUSTER */
    size_t count;
    crease_cluster *items;
} crease_clusters;

/* d' C^-1 d; infinite when C is no covariance. */
double crease_value_squared(const double d[2], const double covariance[3], int dimensions);

/* Clusters of values that are equal within their errors: the most certain ones lead, each of the
 * others joins the cluster that it is nearest to. Those that the mean does not suit after all are
 * in none. O(count x clusters). */
crease_status crease_clusters_find(crease_context *context, size_t count, int dimensions,
    crease_value_of *value_of, void *user, crease_clusters *out);
void crease_clusters_clear(crease_clusters *clusters);

#endif
