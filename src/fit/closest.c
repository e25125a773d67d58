/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* With a point p and a foot at the distance r, whatever is closer lies over the square of half
 * width r around p. There half the squared distance has the second derivatives
 * 1 + grad f grad f^T + (f - z) f'', and |f - z| is at most r (1 + 2 sqrt(2) |grad f|): so it is
 * convex where that times |f''| is below 1, and its only stationary place is the closest. Slopes
 * and second derivatives are bounded by their coefficients.
 *
 * Based on: de Boor. A practical guide to splines. 1978 (chapter X: derivatives, convex hull). */
#include "fit/closest.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "spline/basis.h"
#include "spline/project.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 4096, MOST = CREASE_HEIGHT_ORDER_MAX, MOST_STEPS = 8, MOST_CELLS = 16 };

/* Of the length of the domain: after so small a step of Newton's method only rounding is left. */
static const double SMALL_STEP = 1e-9;

/* Largest slope and second derivative in a cell. */
typedef struct bound {
    double slope, bend;
} bound;

struct crease_closest {
    const crease_height *height;
    const crease_layout *layout;
    const crease_frame *frame;
    size_t spans[2];
    bound *bounds; /* of the cells, spans of no length included */
    crease_projector *projector;
};

typedef struct work {
    const crease_closest *on;
    const double *points;
    crease_foot *feet;
    bool *left; /* points whose foot is not certain */
} work;

/* Height, slopes along u and v, second derivatives uu, uv, vv. */
typedef struct jet {
    double f, slope[2], bend[3];
} jet;

/* ------------------------------------------------------------------------------------ bounds --
 */

/* Coefficients of the derivative along u or v of a cell of rows x columns coefficients (MOST in a
 * row): in place, one less along it. knots: of the direction, from that of the span's first
 * function; degree: of what is differentiated. */
static void differentiate(double (*c)[MOST], size_t size[2], int direction, const double *knots,
    size_t whole, size_t degree)
{
    size[direction]--;
    const size_t gone = whole - 1 - degree; /* derivatives before */
    for (size_t a = 0; a < size[0]; a++)
        for (size_t b = 0; b < size[1]; b++) {
            const size_t i = (direction ? b : a) + 1 + gone;
            const double next = direction ? c[a][b + 1] : c[a + 1][b];
            c[a][b] = (double)degree * (next - c[a][b]) / (knots[i + degree] - knots[i]);
        }
}

static double largest(double (*c)[MOST], const size_t size[2])
{
    double most = 0.0;
    for (size_t a = 0; a < size[0]; a++)
        for (size_t b = 0; b < size[1]; b++)
            most = fmax(most, fabs(c[a][b]));
    return most;
}

/* Bound of the derivative, `times[d]` times along each direction. */
static double bound_of(
    const crease_height *h, const size_t first[2], size_t times_u, size_t times_v)
{
    const size_t order = (size_t)h->order;
    const size_t times[2] = {times_u, times_v};
    double c[MOST][MOST];
    size_t size[2] = {order, order};
    for (size_t a = 0; a < order; a++)
        memcpy(c[a], h->coefficients + (first[0] + a) * h->count[1] + first[1], order * sizeof **c);
    for (int d = 0; d < 2; d++)
        for (size_t k = 0; k < times[d]; k++) {
            if (order < 2 + k)
                return 0.0;
            differentiate(c, size, d, h->knots[d] + first[d], order, order - 1 - k);
        }
    return largest(c, size);
}

static void bound_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const crease_closest *const w = user;
    const crease_height *const h = w->height;
    const size_t degree = (size_t)h->order - 1;
    for (size_t cell = begin; cell < end; cell++) {
        const size_t first[2] = {cell / w->spans[1], cell % w->spans[1]};
        const double *const u = h->knots[0] + first[0] + degree;
        const double *const v = h->knots[1] + first[1] + degree;
        if (!(u[1] > u[0] && v[1] > v[0]))
            continue;
        w->bounds[cell].slope = hypot(bound_of(h, first, 1, 0), bound_of(h, first, 0, 1));
        w->bounds[cell].bend = sqrt(pow(bound_of(h, first, 2, 0), 2.0) +
            2.0 * pow(bound_of(h, first, 1, 1), 2.0) + pow(bound_of(h, first, 0, 2), 2.0));
    }
}

/* -------------------------------------------------------------------------------------- feet --
 */

static void look(const crease_height *h, const double uv[2], int derivatives, jet *out)
{
    const size_t order = (size_t)h->order;
    double basis[2][3 * MOST];
    size_t first[2];
    for (int d = 0; d < 2; d++) {
        const size_t span =
            crease_basis_span(h->knots[d], h->order, h->count[d], uv[d], CREASE_SIDE_RIGHT);
        first[d] = span + 1 - order;
        crease_basis_derivatives(h->knots[d], h->order, span, uv[d], derivatives, basis[d]);
    }
    *out = (jet){.f = 0.0};
    for (size_t a = 0; a < order; a++) {
        const double *const c = h->coefficients + (first[0] + a) * h->count[1] + first[1];
        double row[3] = {0.0};
        for (int k = 0; k <= derivatives; k++)
            for (size_t b = 0; b < order; b++)
                row[k] += basis[1][(size_t)k * order + b] * c[b];
        out->f += basis[0][a] * row[0];
        if (!derivatives)
            continue;
        out->slope[0] += basis[0][order + a] * row[0];
        out->slope[1] += basis[0][a] * row[1];
        out->bend[0] += basis[0][2 * order + a] * row[0];
        out->bend[1] += basis[0][order + a] * row[1];
        out->bend[2] += basis[0][a] * row[2];
    }
}

/* Newton's step towards the foot of p; false where the distance is not convex. */
static bool step_of(const double p[3], const double uv[2], const jet *j, double step[2])
{
    const double off = p[2] - j->f;
    const double p0 = p[0] - uv[0] + j->slope[0] * off, p1 = p[1] - uv[1] + j->slope[1] * off;
    const double a = 1.0 + j->slope[0] * j->slope[0] - off * j->bend[0];
    const double b = j->slope[0] * j->slope[1] - off * j->bend[1];
    const double c = 1.0 + j->slope[1] * j->slope[1] - off * j->bend[2];
    const double determinant = a * c - b * b;
    if (!(a > 0.0 && determinant > 0.0))
        return false;
    step[0] = (c * p0 - b * p1) / determinant;
    step[1] = (a * p1 - b * p0) / determinant;
    return true;
}

/* A stationary place inside the part of the domain between lines that is below p. */
static bool descend(const crease_closest *w, const double p[3], double interval[2][2], double uv[2])
{
    for (int d = 0; d < 2; d++) {
        crease_layout_between(w->layout, d, p[d], interval[d]);
        uv[d] = p[d];
        if (!(uv[d] > interval[d][0] && uv[d] < interval[d][1]))
            return false;
    }
    for (int k = 0; k < MOST_STEPS; k++) {
        jet j;
        double step[2];
        bool small = true;
        look(w->height, uv, 2, &j);
        if (!step_of(p, uv, &j, step))
            return false;
        for (int d = 0; d < 2; d++) {
            const crease_layout_axis *const axis = &w->layout->axis[d];
            uv[d] += step[d];
            if (!(uv[d] > interval[d][0] && uv[d] < interval[d][1]))
                return false;
            small = small && fabs(step[d]) <= SMALL_STEP * (axis->high - axis->low);
        }
        if (small)
            return true;
    }
    return false;
}

/* Whether nothing within the radius of p is closer than a stationary place at that distance. */
static bool certain(
    const crease_closest *w, const double p[3], double interval[2][2], double radius)
{
    const crease_height *const h = w->height;
    const double reach = radius * (1.0 + 1e-9);
    size_t cells[2][2];
    for (int d = 0; d < 2; d++) {
        const crease_layout_axis *const axis = &w->layout->axis[d];
        const double low = p[d] - reach, high = p[d] + reach;
        if ((low <= interval[d][0] && interval[d][0] > axis->low) ||
            (high >= interval[d][1] && interval[d][1] < axis->high))
            return false;
        cells[d][0] = crease_basis_span(h->knots[d], h->order, h->count[d], low, CREASE_SIDE_RIGHT);
        cells[d][1] = crease_basis_span(h->knots[d], h->order, h->count[d], high, CREASE_SIDE_LEFT);
        if (cells[d][1] < cells[d][0]) /* a square without width, on a knot */
            cells[d][0] = cells[d][1];
        if (cells[d][1] - cells[d][0] >= MOST_CELLS)
            return false;
    }
    const size_t degree = (size_t)h->order - 1;
    bound most = {0.0, 0.0};
    if (degree < 2) /* every knot is a crease */
        return false;
    for (size_t i = cells[0][0]; i <= cells[0][1]; i++)
        for (size_t k = cells[1][0]; k <= cells[1][1]; k++) {
            const bound *const here = &w->bounds[(i - degree) * w->spans[1] + k - degree];
            most.slope = fmax(most.slope, here->slope);
            most.bend = fmax(most.bend, here->bend);
        }
    return radius * (1.0 + 2.0 * sqrt(2.0) * most.slope) * most.bend < 0.5;
}

static bool find_foot(const crease_closest *w, const double *point, crease_foot *foot)
{
    double p[3], interval[2][2];
    jet j;
    crease_frame_enter(w->frame, point, 1, p);
    if (!descend(w, p, interval, foot->uv))
        return false;
    look(w->height, foot->uv, 0, &j);
    const double local[3] = {foot->uv[0], foot->uv[1], j.f};
    crease_frame_leave(w->frame, local, 1, foot->point);
    double squared = 0.0;
    for (int c = 0; c < 3; c++)
        squared += (point[c] - foot->point[c]) * (point[c] - foot->point[c]);
    foot->distance = p[2] < j.f ? -sqrt(squared) : sqrt(squared);
    return certain(w, p, interval, sqrt(squared));
}

static void find_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    for (size_t i = begin; i < end; i++)
        w->left[i] = !find_foot(w->on, w->points + 3 * i, &w->feet[i]);
}

/* ---------------------------------------------------------------------------- what is left -- */

static crease_status search(crease_context *context, const work *w, size_t count)
{
    size_t left = 0;
    for (size_t i = 0; i < count; i++)
        left += w->left[i];
    if (left == 0)
        return CREASE_OK;
    double *points = crease_allocate(context, left, 3 * sizeof *points);
    crease_foot *feet = crease_allocate(context, left, sizeof *feet);
    crease_status status = points && feet ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0, k = 0; i < count && status == CREASE_OK; i++)
        if (w->left[i])
            memcpy(points + 3 * k++, w->points + 3 * i, 3 * sizeof *points);
    if (status == CREASE_OK)
        status = crease_projector_project(context, w->on->projector, points, left, feet);
    for (size_t i = 0, k = 0; i < count && status == CREASE_OK; i++)
        if (w->left[i])
            w->feet[i] = feet[k++];
    free(points);
    free(feet);
    return status;
}

crease_status crease_closest_feet(crease_context *context, const crease_closest *closest,
    const double *points, size_t count, crease_foot *feet)
{
    work w = {.on = closest, .points = points, .feet = feet};
    w.left = crease_allocate(context, count, sizeof *w.left);
    crease_status status =
        w.left ? crease_parallel_for(context, count, GRAIN, find_some, &w) : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = search(context, &w, count);
    free(w.left);
    return status;
}

/* ------------------------------------------------------------------------------------- making --
 */

crease_status crease_closest_create(crease_context *context, const crease_height *height,
    const crease_layout *layout, const crease_frame *frame, const crease_surface *surface,
    crease_closest **out)
{
    const size_t order = (size_t)height->order;
    *out = NULL;
    crease_closest *const made = crease_allocate(context, 1, sizeof *made);
    if (!made)
        return CREASE_ERROR_NO_MEMORY;
    *made = (crease_closest){.height = height,
        .layout = layout,
        .frame = frame,
        .spans = {height->count[0] + 1 - order, height->count[1] + 1 - order}};
    const size_t cells = made->spans[0] * made->spans[1];
    made->bounds = crease_allocate(context, cells, sizeof *made->bounds);
    crease_status status = made->bounds
        ? crease_parallel_for(context, cells, GRAIN, bound_some, made)
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_projector_create(context, surface, &made->projector);
    if (status == CREASE_OK)
        *out = made;
    else
        crease_closest_free(made);
    return status;
}

void crease_closest_free(crease_closest *closest)
{
    if (!closest)
        return;
    crease_projector_free(closest->projector);
    free(closest->bounds);
    free(closest);
}
