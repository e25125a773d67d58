/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "snap/cluster.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct rank {
    double uncertainty;
    size_t item;
} rank;

static bool invert(const double matrix[3], int dimensions, double out[3])
{
    out[1] = out[2] = 0.0;
    if (dimensions == 1) {
        out[0] = 1.0 / matrix[0];
        return matrix[0] > 0.0 && isfinite(out[0]);
    }
    const double determinant = matrix[0] * matrix[2] - matrix[1] * matrix[1];
    out[0] = matrix[2] / determinant;
    out[1] = -matrix[1] / determinant;
    out[2] = matrix[0] / determinant;
    return matrix[0] > 0.0 && determinant > 0.0 && isfinite(out[0]) && isfinite(out[2]);
}

static double square(const double d[2], const double inverse[3])
{
    return d[0] * d[0] * inverse[0] + 2.0 * d[0] * d[1] * inverse[1] + d[1] * d[1] * inverse[2];
}

double crease_value_squared(const double d[2], const double covariance[3], int dimensions)
{
    double inverse[3];
    return invert(covariance, dimensions, inverse) ? square(d, inverse) : INFINITY;
}

static int compare_ranks(const void *a, const void *b)
{
    const rank *x = a, *y = b;
    if (x->uncertainty != y->uncertainty)
        return x->uncertainty < y->uncertainty ? -1 : 1;
    return x->item < y->item ? -1 : x->item > y->item;
}

/* Squared deviation of a value from the mean of a cluster, with the errors of both. */
static double apart(const crease_cluster *cluster, const crease_value *value, int dimensions)
{
    const crease_value *const mean = &cluster->mean;
    const double d[2] = {value->at[0] - mean->at[0], value->at[1] - mean->at[1]};
    double both[3];
    for (int k = 0; k < 3; k++)
        both[k] = value->covariance[k] + mean->covariance[k];
    return crease_value_squared(d, both, dimensions);
}

/* The mean of both, weighted by what is known of them. */
static void unite(crease_cluster *cluster, const crease_value *value, int dimensions)
{
    crease_value *const mean = &cluster->mean;
    double a[3], b[3], sum[3], right[2];
    cluster->size++;
    if (!invert(mean->covariance, dimensions, a) || !invert(value->covariance, dimensions, b))
        return;
    for (int k = 0; k < 3; k++)
        sum[k] = a[k] + b[k];
    for (int k = 0; k < 2; k++)
        right[k] = a[k] * mean->at[0] + a[k + 1] * mean->at[1] + b[k] * value->at[0] +
            b[k + 1] * value->at[1];
    if (!invert(sum, dimensions, mean->covariance))
        return;
    const double *const c = mean->covariance;
    mean->at[0] = c[0] * right[0] + c[1] * right[1];
    mean->at[1] = c[1] * right[0] + c[2] * right[1];
}

/* Puts the item into the nearest cluster, or begins one with it. */
static void place(
    crease_clusters *out, int dimensions, crease_value_of *value_of, void *user, size_t item)
{
    crease_value value, nearest = {{0}, {0}};
    double least = CREASE_WITHIN_ERRORS[dimensions];
    size_t best = out->count;
    for (size_t c = 0; c < out->count; c++) {
        if (!value_of(user, item, out->items[c].leader, &value))
            continue;
        const double squared = apart(&out->items[c], &value, dimensions);
        if (squared < least) {
            least = squared;
            best = c;
            nearest = value;
        }
    }
    out->of[item] = (int32_t)best;
    if (best < out->count) {
        unite(&out->items[best], &nearest, dimensions);
        return;
    }
    value_of(user, item, item, &value);
    out->items[out->count++] = (crease_cluster){item, 1, value};
}

/* Items that the mean is too far from for their own errors. */
static void let_go(
    crease_clusters *out, size_t count, int dimensions, crease_value_of *value_of, void *user)
{
    for (size_t item = 0; item < count; item++) {
        crease_value value;
        if (out->of[item] < 0)
            continue;
        crease_cluster *const cluster = &out->items[out->of[item]];
        const crease_value *const mean = &cluster->mean;
        if (value_of(user, item, cluster->leader, &value)) {
            const double d[2] = {value.at[0] - mean->at[0], value.at[1] - mean->at[1]};
            if (crease_value_squared(d, value.covariance, dimensions) <
                CREASE_WITHIN_ERRORS[dimensions])
                continue;
        }
        out->of[item] = CREASE_NO_CLUSTER;
        cluster->size--;
    }
}

crease_status crease_clusters_find(crease_context *context, size_t count, int dimensions,
    crease_value_of *value_of, void *user, crease_clusters *out)
{
    *out = (crease_clusters){0};
    rank *const ranks = crease_allocate(context, count, sizeof *ranks);
    out->of = crease_allocate(context, count, sizeof *out->of);
    out->items = crease_allocate(context, count, sizeof *out->items);
    if (!ranks || !out->of || !out->items) {
        free(ranks);
        crease_clusters_clear(out);
        return CREASE_ERROR_NO_MEMORY;
    }
    for (size_t item = 0; item < count; item++) {
        crease_value value;
        const bool has = value_of(user, item, item, &value);
        out->of[item] = CREASE_NO_CLUSTER;
        ranks[item] = (rank){has ? value.covariance[0] + value.covariance[2] : INFINITY, item};
    }
    qsort(ranks, count, sizeof *ranks, compare_ranks);
    for (size_t k = 0; k < count && ranks[k].uncertainty < INFINITY; k++)
        place(out, dimensions, value_of, user, ranks[k].item);
    let_go(out, count, dimensions, value_of, user);
    free(ranks);
    return CREASE_OK;
}

void crease_clusters_clear(crease_clusters *clusters)
{
    free(clusters->of);
    free(clusters->items);
    *clusters = (crease_clusters){0};
}
