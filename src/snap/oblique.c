/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Directions that are neither parallel nor perpendicular to a third, and that a mirror across the
 * third takes to each other: the flanks of a groove, the sides of a hexagon. */
#include "base/memory.h"
#include "base/vector.h"
#include "snap/snapping.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double EXACT = 1e-9;                  /* cosine of a right angle that was set */
static const double OBLIQUE[2] = {0.05, 0.998749}; /* cosine and sine of the least angle to either:
                                                      3 degrees */
static const double NEAR_COSINE = 0.99;            /* of an image to what it may be: 8 degrees */

void crease_mirror_vector(const double normal[3], const double v[3], double out[3])
{
    const double along = crease_vector_dot(normal, v);
    for (int c = 0; c < 3; c++)
        out[c] = v[c] - 2.0 * along * normal[c];
}

static bool is_oblique(const double a[3], const double b[3])
{
    const double cosine = fabs(crease_vector_dot(a, b));
    return cosine > OBLIQUE[0] && cosine < OBLIQUE[1];
}

/* Whether all right angles that the cluster has a part in are right. */
static bool is_upright(const crease_snapping *all, size_t cluster)
{
    for (size_t k = 0; k < all->directions.count; k++)
        for (int n = 0; n < 2; n++) {
            const int32_t to = all->upright[k][n];
            if (to < 0 || (k != cluster && (size_t)to != cluster))
                continue;
            if (fabs(crease_vector_dot(all->axis_of[k], all->axis_of[to])) > EXACT)
                return false;
        }
    return true;
}

/* Takes from a direction what it has along those that the cluster is at a right angle to, or along
 * the images of these. */
static void keep_upright(
    const crease_snapping *all, size_t cluster, const double *normal, double direction[3])
{
    for (size_t k = 0; k < all->directions.count; k++)
        for (int n = 0; n < 2; n++) {
            const int32_t to = all->upright[k][n];
            if (to < 0 || (k != cluster && (size_t)to != cluster))
                continue;
            double other[3];
            memcpy(other, all->axis_of[k == cluster ? (size_t)to : k], sizeof other);
            if (normal)
                crease_mirror_vector(normal, all->axis_of[k == cluster ? (size_t)to : k], other);
            const double along = crease_vector_dot(direction, other);
            for (int c = 0; c < 3; c++)
                direction[c] -= along * other[c];
        }
}

static double weight(const crease_snapping *all, size_t cluster)
{
    const double *const c = all->directions.items[cluster].mean.covariance;
    return 1.0 / (c[0] + c[2]);
}

/* Makes the two each other's image, if their errors and their right angles allow it. */
static bool pair_up(crease_snapping *all, size_t a, size_t b, const double normal[3])
{
    double image[3], mean[3], before[2][3];
    const double share[2] = {weight(all, a), weight(all, b)};
    crease_mirror_vector(normal, all->axis_of[b], image);
    const double cosine = crease_vector_dot(image, all->axis_of[a]);
    const double sign = cosine < 0.0 ? -1.0 : 1.0;
    if (fabs(cosine) < NEAR_COSINE)
        return false;
    for (int c = 0; c < 3; c++)
        mean[c] = share[0] * all->axis_of[a][c] + sign * share[1] * image[c];
    keep_upright(all, a, NULL, mean);
    keep_upright(all, b, normal, mean);
    crease_vector_normalise(mean);
    crease_mirror_vector(normal, mean, image);
    for (int c = 0; c < 3; c++)
        image[c] *= sign;
    if (!(crease_snap_turn_squared(all, a, mean) < CREASE_WITHIN_ERRORS[2]) ||
        !(crease_snap_turn_squared(all, b, image) < CREASE_WITHIN_ERRORS[2]))
        return false;
    memcpy(before[0], all->axis_of[a], sizeof before[0]);
    memcpy(before[1], all->axis_of[b], sizeof before[1]);
    memcpy(all->axis_of[a], mean, sizeof mean);
    memcpy(all->axis_of[b], image, sizeof image);
    if (is_upright(all, a) && is_upright(all, b))
        return true;
    memcpy(all->axis_of[a], before[0], sizeof before[0]);
    memcpy(all->axis_of[b], before[1], sizeof before[1]);
    return false;
}

static bool is_free(const crease_snapping *all, size_t cluster, const bool *settled)
{
    return all->directions.items[cluster].size > 0 && !settled[cluster];
}

crease_status crease_snap_oblique(crease_snapping *all)
{
    const size_t count = all->directions.count;
    bool *const settled = crease_allocate(all->context, count, sizeof *settled);
    if (!settled)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t k = 0; k < count; k++)
        all->image_of[k] = CREASE_NO_CLUSTER;
    for (size_t n = 0; n < count; n++) {
        if (all->directions.items[n].size == 0)
            continue;
        const double *const normal = all->axis_of[n];
        for (size_t a = 0; a < count; a++)
            for (size_t b = a + 1; b < count; b++) {
                if (a == n || b == n || !is_free(all, a, settled) || !is_free(all, b, settled) ||
                    !is_oblique(normal, all->axis_of[a]) || !is_oblique(normal, all->axis_of[b]) ||
                    !pair_up(all, a, b, normal))
                    continue;
                settled[a] = settled[b] = settled[n] = true;
                all->image_of[a] = (int32_t)b;
                all->image_of[b] = (int32_t)a;
            }
    }
    free(settled);
    return CREASE_OK;
}
