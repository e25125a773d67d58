/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The paper turns its sample by hand. Here two planes are fitted to the points by expectation and
 * maximisation, from several first guesses; the planes tell everything else.
 *
 * Based on: Dempster, Laird, Rubin. Maximum likelihood from incomplete data via the EM algorithm.
 * 1977. */
#include "averaging/orient.h"

#include "averaging/twoplane.h"
#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 2048, NEAREST = 5, CANDIDATES = 3 };

/* Fills the rotation's rows from z and a direction across the edge; fixes all signs. */
static void set_axes(crease_frame *frame, const double z[3], const double across[3])
{
    double x[3], y[3], up[3];
    memcpy(up, z, sizeof up);
    const int by_height[3] = {2, 1, 0}, by_width[3] = {0, 1, 2};
    crease_vector_orient(up, by_height);
    const double dot = crease_vector_dot(across, up);
    for (int c = 0; c < 3; c++)
        x[c] = across[c] - dot * up[c];
    crease_vector_normalise(x);
    crease_vector_orient(x, by_width);
    crease_vector_cross(up, x, y);
    memcpy(frame->rotation, x, sizeof x);
    memcpy(frame->rotation + 3, y, sizeof y);
    memcpy(frame->rotation + 6, up, sizeof up);
}

static bool edge_frame(
    const double *points, size_t count, double *scratch, crease_frame *frame, crease_oriented *out)
{
    crease_twoplane planes;
    if (!crease_twoplane_fit(points, count, scratch, &planes))
        return false;
    double z[3], across[3];
    for (int c = 0; c < 3; c++) {
        z[c] = -planes.inward[0][c] - planes.inward[1][c];
        across[c] = planes.inward[1][c] - planes.inward[0][c];
    }
    if (crease_vector_length(z) > crease_vector_length(across))
        crease_vector_cross(planes.direction, z, across);
    else
        crease_vector_cross(across, planes.direction, z);
    crease_vector_normalise(z);
    set_axes(frame, z, across);
    memcpy(out->point, planes.edge, sizeof out->point);
    memcpy(out->direction, planes.direction, sizeof out->direction);
    return true;
}

static bool main_axes_frame(const double *points, size_t count, crease_frame *frame)
{
    double mean[3], values[3], axes[9];
    crease_vector_main_axes(points, NULL, count, mean, values, axes);
    set_axes(frame, axes, axes + 6);
    return values[1] > 1e-14 * values[2];
}

/* How far apart points are, in space, that are neighbours seen along z: large where the points are
 * no height field in this frame. */
static crease_status folding(crease_context *context, const crease_frame *frame,
    const double *points, size_t count, double *scratch, double *out)
{
    crease_tree *tree = NULL;
    uint32_t *nearest = crease_allocate(context, count, NEAREST * sizeof *nearest);
    if (!nearest)
        return CREASE_ERROR_NO_MEMORY;
    const int k = count < NEAREST ? (int)count : NEAREST;
    crease_frame_enter(frame, points, count, scratch);
    for (size_t i = 0; i < count; i++)
        scratch[3 * i + 2] = 0.0;
    crease_status status = crease_tree_create(context, scratch, count, &tree);
    if (status == CREASE_OK)
        status = crease_tree_nearest(context, tree, scratch, count, k, nearest, NULL);
    double sum = 0.0;
    for (size_t i = 0; status == CREASE_OK && i < count * (size_t)k; i++)
        sum += crease_vector_distance(points + 3 * (i / (size_t)k), points + 3 * nearest[i]);
    *out = sum / (double)count;
    crease_tree_free(tree);
    free(nearest);
    return status;
}

/* The first frame that folds the points hardly more than the best one does. */
static crease_status choose(crease_context *context, const crease_frame *frames, size_t frame_count,
    const double *points, size_t count, double *scratch, size_t *chosen)
{
    double folds[CANDIDATES], least = INFINITY;
    for (size_t i = 0; i < frame_count; i++) {
        const crease_status status =
            folding(context, &frames[i], points, count, scratch, &folds[i]);
        if (status != CREASE_OK)
            return status;
        least = fmin(least, folds[i]);
    }
    *chosen = 0;
    while (folds[*chosen] > 1.5 * least)
        ++*chosen;
    return CREASE_OK;
}

static void centre_of_box(const double *points, size_t count, double centre[3])
{
    for (int c = 0; c < 3; c++) {
        double low = points[c], high = points[c];
        for (size_t i = 1; i < count; i++) {
            low = fmin(low, points[3 * i + (size_t)c]);
            high = fmax(high, points[3 * i + (size_t)c]);
        }
        centre[c] = 0.5 * low + 0.5 * high;
    }
}

/* At most MOST_POINTS of the points, evenly taken, relative to the origin. */
static size_t thin_out(const double *points, size_t count, const double origin[3], double *out)
{
    const size_t taken = count < MOST_POINTS ? count : MOST_POINTS;
    for (size_t i = 0; i < taken; i++)
        for (size_t c = 0; c < 3; c++)
            out[3 * i + c] = points[3 * (i * count / taken) + c] - origin[c];
    return taken;
}

static crease_status check_points(crease_context *context, size_t count)
{
    return count >= 4 ? CREASE_OK
                      : crease_fail(context, CREASE_ERROR_TOO_FEW_POINTS,
                            "orient: %zu points; a surface needs at least 4, give more", count);
}

crease_status crease_orient_find(
    crease_context *context, const double *points, size_t count, crease_oriented *out)
{
    *out = (crease_oriented){.edge = false};
    crease_status status = check_points(context, count);
    if (status != CREASE_OK)
        return status;
    double origin[3];
    centre_of_box(points, count, origin);
    double *few = crease_allocate(context, MOST_POINTS, 3 * sizeof *few);
    double *scratch = crease_allocate(context, MOST_POINTS, 4 * sizeof *scratch);
    if (!few || !scratch) {
        status = CREASE_ERROR_NO_MEMORY;
        goto done;
    }
    const size_t taken = thin_out(points, count, origin, few);
    crease_frame frames[CANDIDATES] = {0};
    const bool has_edge = edge_frame(few, taken, scratch, &frames[0], out);
    size_t found = has_edge, chosen = 0;
    if (!main_axes_frame(few, taken, &frames[found++])) {
        status = crease_fail(context, CREASE_ERROR_DEGENERATE,
            "orient: all %zu points lie on one line or in one place; give points of a surface",
            count);
        goto done;
    }
    frames[found++] = (crease_frame){.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    status = choose(context, frames, found, few, taken, scratch, &chosen);
    out->edge = has_edge && chosen == 0;
    for (int c = 0; c < 3; c++)
        out->point[c] += origin[c];
    out->frame = frames[chosen];
    memcpy(out->frame.origin, origin, sizeof origin);
done:
    free(few);
    free(scratch);
    return status;
}

crease_status crease_orient(crease_context *context, const double *points, size_t count,
    crease_orientation orientation, const double rotation[9], crease_oriented *out)
{
    const crease_status status = crease_orient_find(context, points, count, out);
    if (status != CREASE_OK || orientation == CREASE_ORIENTATION_AUTOMATIC)
        return status;
    const double as_it_is[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const bool given = orientation == CREASE_ORIENTATION_GIVEN;
    if (given && !(crease_frame_defect(rotation) < 1e-6))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "orient: the nine numbers given are no rotation; give an orthonormal, right-handed "
            "matrix, row by row");
    memcpy(out->frame.rotation, given ? rotation : as_it_is, sizeof out->frame.rotation);
    return CREASE_OK;
}

int crease_orient_edge_axis(const crease_oriented *oriented)
{
    const double *const m = oriented->frame.rotation;
    const double along_x = fabs(crease_vector_dot(m, oriented->direction));
    return oriented->edge && along_x > fabs(crease_vector_dot(m + 3, oriented->direction)) ? 0 : 1;
}
