/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/exact.h"

#include "base/memory.h"
#include "base/vector.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_POINTS = 600,
    MOST_STARTS = 32,
    PLACES = 4, /* unknowns besides the control points: three turns, one line */
    STEPS = 30,
    PATIENCE = 3,
    HALVINGS = 4
};

/* Points for each unknown, so that nothing but the surface explains why all lie on it. */
static const double OVERDETERMINED = 2.0;
/* Of the size, beside the rounding of the coordinates. */
static const double EXACT = 1e-12;
/* What a step must at least take off the residual; one in PATIENCE must take off more. */
static const double PROGRESS = 0.5;
static const double LONGEST = 0.3; /* step: radians, sizes */
static const double KNOWN = 1e-9;  /* share of a column that the control points do not explain */
static const double TILTS[] = {0.0, 0.1, -0.1, 0.3, -0.3, 0.75, -0.75};

typedef struct start {
    crease_frame frame;
    bool line;
    double at; /* x of the line */
} start;

typedef struct work {
    crease_context *context;
    size_t count, unknowns, places; /* places: 3, or 4 with a line */
    int order;
    bool line;
    double size, tolerance;
    double *points; /* count x 3, relative to the origin of all frames, in sizes */
    double *local;  /* count x 3 */
    double *matrix; /* count x unknowns, column by column: its factors */
    double *scales; /* unknowns: of the reflections */
    double *sides;  /* count x (1 + PLACES), column by column */
    crease_height height;
    crease_layout layout;
} work;

static void release(work *w)
{
    crease_height_free(&w->height);
    free(w->points);
    free(w->local);
    free(w->matrix);
    free(w->scales);
    free(w->sides);
}

static crease_status create(crease_context *context, const crease_samples *samples,
    const double origin[3], int order, work *w)
{
    const size_t step = (samples->count + MOST_POINTS - 1) / MOST_POINTS;
    const size_t most = (size_t)(order * (2 * order - 1));
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    *w = (work){.context = context, .order = order};
    w->points = crease_allocate(context, MOST_POINTS, 3 * sizeof(double));
    w->local = crease_allocate(context, MOST_POINTS, 3 * sizeof(double));
    w->matrix = crease_allocate(context, MOST_POINTS, most * sizeof(double));
    w->scales = crease_allocate(context, most, sizeof(double));
    w->sides = crease_allocate(context, MOST_POINTS, (1 + PLACES) * sizeof(double));
    if (!w->points || !w->local || !w->matrix || !w->scales || !w->sides)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < samples->count; i += step) {
        if (!(samples->prior[i] > 0.0))
            continue;
        const double *const from = samples->source + 3 * crease_samples_number(samples, i);
        for (int c = 0; c < 3; c++) {
            w->points[3 * w->count + (size_t)c] = from[c] - origin[c];
            low[c] = fmin(low[c], from[c]);
            high[c] = fmax(high[c], from[c]);
        }
        w->count++;
    }
    w->size = 0.5 * hypot(hypot(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
    for (size_t i = 0; i < 3 * w->count; i++)
        w->points[i] /= w->size;
    w->tolerance = EXACT + 0.5 * samples->rounding / w->size;
    return CREASE_OK;
}

/* -------------------------------------------------------------------------------------- solve --
 */

static void lay_out(work *w, double at)
{
    w->layout = (crease_layout){.order = w->order};
    for (size_t d = 0; d < 2; d++) {
        crease_layout_axis *const axis = &w->layout.axis[d];
        axis->low = INFINITY, axis->high = -INFINITY;
        for (size_t i = 0; i < w->count; i++) {
            axis->low = fmin(axis->low, w->local[3 * i + d]);
            axis->high = fmax(axis->high, w->local[3 * i + d]);
        }
    }
    w->layout.axis[0].line_count = w->line;
    w->layout.axis[0].lines[0] = at;
}

/* Products of functions, points by control points, as factors of an orthogonal and a triangular
 * matrix; heights, and all that the control points do not explain of them. */
static bool factor(work *w)
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const size_t order = (size_t)w->order, m = w->count, n = w->unknowns;
    memset(w->matrix, 0, m * n * sizeof *w->matrix);
    for (size_t i = 0; i < m; i++) {
        crease_support s;
        crease_height_support(&w->height, w->local + 3 * i, sides, 0, &s);
        for (size_t a = 0; a < order; a++)
            for (size_t b = 0; b < order; b++)
                w->matrix[((s.first[0] + a) * w->height.count[1] + s.first[1] + b) * m + i] =
                    s.values[0][a] * s.values[1][b];
        w->sides[i] = w->local[3 * i + 2];
    }
    const lapack_int rows = (lapack_int)m, columns = (lapack_int)n;
    if (LAPACKE_dgeqrf(LAPACK_COL_MAJOR, rows, columns, w->matrix, rows, w->scales) != 0)
        return false;
    for (size_t i = 0; i < n; i++) /* control points that no point holds */
        if (!(fabs(w->matrix[i * m + i]) > 1e-9))
            return false;
    return LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'T', rows, 1, columns, w->matrix, rows, w->scales,
               w->sides, rows) == 0;
}

/* What the control points do not explain of a side. */
static double rest(const work *w, size_t side)
{
    double sum = 0.0;
    for (size_t i = w->unknowns; i < w->count; i++)
        sum += pow(w->sides[side * w->count + i], 2.0);
    return sqrt(sum / (double)w->count);
}

static crease_status evaluate(work *w, const start *at, double *rms)
{
    *rms = INFINITY;
    for (size_t i = 0; i < w->count; i++)
        for (size_t r = 0; r < 3; r++)
            w->local[3 * i + r] = crease_vector_dot(at->frame.rotation + 3 * r, w->points + 3 * i);
    lay_out(w, at->at);
    const crease_layout_axis *const axis = &w->layout.axis[0];
    if (w->line && !(at->at > axis->low && at->at < axis->high))
        return CREASE_OK;
    crease_height_free(&w->height);
    const crease_status status = crease_height_create(w->context, &w->layout, &w->height);
    if (status != CREASE_OK)
        return status;
    w->unknowns = w->height.count[0] * w->height.count[1];
    if ((double)w->count < OVERDETERMINED * (double)w->unknowns || !factor(w))
        return CREASE_OK;
    *rms = rest(w, 0);
    return CREASE_OK;
}

/* --------------------------------------------------------------------------------------- step --
 */

/* Jump of the slope across the line. */
static double slope_jump(const work *w, double at, double v)
{
    const double uv[2] = {at, v};
    const crease_side right[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const crease_side left[2] = {CREASE_SIDE_LEFT, CREASE_SIDE_RIGHT};
    double f[3], g[3];
    crease_height_at(&w->height, uv, right, 1, f);
    crease_height_at(&w->height, uv, left, 1, g);
    return f[1] - g[1];
}

/* How the distance of each point above the sheet changes with turns about x, y and z, and with a
 * step of the line. */
static void set_columns(work *w, double at)
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const size_t m = w->count;
    double *const columns = w->sides + m;
    for (size_t i = 0; i < m; i++) {
        const double *const p = w->local + 3 * i;
        double f[3];
        crease_height_at(&w->height, p, sides, 1, f);
        columns[i] = p[1] + f[2] * p[2];
        columns[m + i] = -p[0] - f[1] * p[2];
        columns[2 * m + i] = f[1] * p[1] - f[2] * p[0];
        if (w->line)
            columns[3 * m + i] = p[0] > at ? slope_jump(w, at, p[1]) : 0.0;
    }
}

/* The step of Gauss and Newton; what the points do not determine stays. */
static bool find_step(work *w, const start *at, double step[PLACES])
{
    const lapack_int m = (lapack_int)w->count, n = (lapack_int)w->unknowns;
    const lapack_int q = (lapack_int)w->places, left = m - n;
    double whole[PLACES], values[PLACES];
    memcpy(w->height.coefficients, w->sides, w->unknowns * sizeof(double));
    if (LAPACKE_dtrtrs(
            LAPACK_COL_MAJOR, 'U', 'N', 'N', n, 1, w->matrix, m, w->height.coefficients, n) != 0)
        return false;
    set_columns(w, at->at);
    double *const columns = w->sides + w->count;
    for (size_t c = 0; c < w->places; c++) {
        double sum = 0.0;
        for (size_t i = 0; i < w->count; i++)
            sum += pow(columns[c * w->count + i], 2.0);
        whole[c] = sqrt(sum / (double)w->count);
    }
    if (LAPACKE_dormqr(LAPACK_COL_MAJOR, 'L', 'T', m, q, n, w->matrix, m, w->scales, columns, m) !=
        0)
        return false;
    for (size_t c = 0; c < w->places; c++)
        if (!(rest(w, 1 + c) > KNOWN * whole[c]))
            memset(columns + c * w->count, 0, w->count * sizeof(double));
    double *const right = w->sides + w->unknowns;
    for (size_t i = 0; i < w->count - w->unknowns; i++)
        right[i] = -right[i];
    lapack_int rank;
    if (LAPACKE_dgelsd(LAPACK_COL_MAJOR, left, q, 1, columns + w->unknowns, m, right, m, values,
            1e-9, &rank) != 0)
        return false;
    memset(step, 0, PLACES * sizeof *step);
    for (size_t c = 0; c < w->places; c++)
        step[c] = right[c];
    return true;
}

/* The frame in which points are turned by these small angles about x, y and z. */
static void turn_points(crease_frame *frame, const double angles[3])
{
    const double angle = crease_vector_length(angles);
    if (!(angle > 0.0))
        return;
    const double axis[3] = {angles[0] / angle, angles[1] / angle, angles[2] / angle};
    const double c = cos(angle), s = sin(angle);
    double turned[9];
    for (size_t k = 0; k < 3; k++) { /* columns: the cloud's axes, seen in the frame */
        const double v[3] = {frame->rotation[k], frame->rotation[3 + k], frame->rotation[6 + k]};
        double cross[3];
        crease_vector_cross(axis, v, cross);
        const double along = crease_vector_dot(axis, v) * (1.0 - c);
        for (size_t r = 0; r < 3; r++)
            turned[3 * r + k] = c * v[r] + s * cross[r] + along * axis[r];
    }
    memcpy(frame->rotation, turned, sizeof turned);
}

static start moved(const start *from, const double step[PLACES], double share)
{
    start to = *from;
    double longest = 0.0;
    for (int c = 0; c < PLACES; c++)
        longest = fmax(longest, fabs(step[c]));
    share *= longest > LONGEST ? LONGEST / longest : 1.0;
    const double angles[3] = {share * step[0], share * step[1], share * step[2]};
    turn_points(&to.frame, angles);
    to.at += share * step[3];
    return to;
}

/* The largest of 1, 1/2, 1/4 .. of the step that brings the points nearer. */
static crease_status advance(work *w, start *at, const double step[PLACES], double *rms)
{
    crease_status status = CREASE_OK;
    const double before = *rms;
    double share = 1.0;
    for (int i = 0; i < HALVINGS && status == CREASE_OK; i++, share *= 0.5) {
        start trial = moved(at, step, share);
        status = evaluate(w, &trial, rms);
        if (*rms < before) {
            *at = trial;
            return status;
        }
    }
    *rms = INFINITY;
    return status;
}

/* From a start to where the points fit best, as long as it gets much better. */
static crease_status descend(work *w, start *at, bool *found)
{
    double rms, since, step[PLACES];
    w->line = at->line;
    w->places = at->line ? 4 : 3;
    crease_status status = evaluate(w, at, &rms);
    since = rms;
    for (int i = 1; i <= STEPS && rms < INFINITY && rms > w->tolerance && status == CREASE_OK;
         i++) {
        if (!find_step(w, at, step))
            break;
        status = advance(w, at, step, &rms);
        if (i % PATIENCE == 0) {
            if (!(rms < PROGRESS * since))
                break;
            since = rms;
        }
    }
    *found = status == CREASE_OK && rms <= w->tolerance;
    return status;
}

/* ------------------------------------------------------------------------------------- starts --
 */

/* z stays, and y becomes the edge's direction, seen along z; false when they are the same. */
static bool follow_edge(crease_frame *frame, const double edge[3])
{
    double *const x = frame->rotation, *const y = x + 3, *const z = x + 6;
    const double along = crease_vector_dot(z, edge);
    for (int c = 0; c < 3; c++)
        y[c] = edge[c] - along * z[c];
    const double length = crease_vector_length(y);
    if (!(length > 0.1))
        return false;
    for (int c = 0; c < 3; c++)
        y[c] /= length;
    crease_vector_cross(y, z, x);
    return true;
}

/* Tilted by every pair of angles that are not both large, about y and about x. */
static size_t add_tilted(const start *from, start *starts, size_t count)
{
    for (size_t a = 0; a < sizeof TILTS / sizeof TILTS[0]; a++)
        for (size_t b = 0; b < (a == 0 ? 3u : 1u) && count < MOST_STARTS; b++) {
            const double angles[3] = {TILTS[b], TILTS[a], 0.0};
            starts[count] = *from;
            turn_points(&starts[count].frame, angles);
            count++;
        }
    return count;
}

/* Along a known edge, or without a line. */
static size_t set_starts(const work *w, const crease_oriented *oriented, start *starts)
{
    static const double axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double point[3];
    size_t count = 0;
    start plain[2] = {{.frame = oriented->frame}, {.frame = oriented->frame}};
    memcpy(plain[1].frame.rotation, axes, sizeof axes);
    for (int i = 0; i < 2 && oriented->edge; i++) {
        start line = plain[i];
        if (!follow_edge(&line.frame, oriented->direction))
            continue;
        crease_frame_enter(&line.frame, oriented->point, 1, point);
        line.line = true;
        line.at = point[0] / w->size;
        if (i == 0)
            count = add_tilted(&line, starts, count);
        else
            starts[count++] = line;
    }
    starts[count++] = plain[1];
    return oriented->edge ? count : add_tilted(plain, starts, count);
}

crease_status crease_exact_find(crease_context *context, const crease_samples *samples,
    const crease_oriented *oriented, size_t lines, crease_frame *frame, crease_layout *layout,
    bool *found)
{
    start starts[MOST_STARTS];
    work w;
    *found = false;
    crease_status status = create(context, samples, oriented->frame.origin, layout->order, &w);
    const size_t count = status == CREASE_OK && w.size > 0.0 ? set_starts(&w, oriented, starts) : 0;
    for (size_t i = 0; i < count && !*found && status == CREASE_OK; i++) {
        if (starts[i].line && lines == 0)
            continue;
        status = descend(&w, &starts[i], found);
        if (*found) {
            *frame = starts[i].frame;
            *layout = (crease_layout){.order = w.order};
            layout->axis[0].line_count = starts[i].line;
            layout->axis[0].lines[0] = starts[i].at * w.size;
        }
        if (status == CREASE_OK && crease_cancelled(context))
            status = crease_fail_cancelled(context);
    }
    release(&w);
    return status;
}
