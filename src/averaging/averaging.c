/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Algorithm 1 from its first step to its last. It is kept as published, with its faults: where no
 * row of the net falls on the edge, the edge comes out flattened or displaced.
 *
 * What the paper leaves open: the knots. They are equally spaced and clamped, so that the surface
 * reaches the border of the net, and a row that stands three times in it is interpolated at a knot:
 * the crease line.
 *
 * Based on: Sharp edge preservation using bicubic B-spline surfaces. ScienceAsia. Algorithm 1. */
#include "averaging/mark.h"
#include "averaging/net.h"
#include "averaging/orient.h"
#include "averaging/project.h"
#include "averaging/repeat.h"
#include "base/memory.h"
#include "detect/standardise.h"
#include "spline/knots.h"
#include "spline/sheet.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ORDER = 4, MOST_NEIGHBOURS = 256, MOST_PASSES = 1000, MOST_ROWS = 4096 };

/* What the steps hand on to each other. */
typedef struct work {
    const crease_averaging_options *options;
    size_t count;
    const double *points; /* as given */
    double *local;        /* reoriented */
    crease_tree *tree;
    double *standardised, *weights; /* step 2: with mean 0; shifted to be positive */
    bool transposed;                /* the edge is vertical: it runs along local x */
    crease_net net, repeated;
    uint8_t *marks;
    bool *passes;
    crease_sheet *sheet;
} work;

crease_averaging_options crease_averaging_options_default(void)
{
    return (crease_averaging_options){.detect = crease_detect_options_default(),
        .orientation = CREASE_ORIENTATION_AUTOMATIC,
        .rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1},
        .net = {6, 6},
        .averaging_neighbours = 2,
        .passes = 3,
        .marking_neighbours = 4,
        .mark_threshold = 0.20,
        .row_threshold = 4,
        .multiplicity = 3};
}

static crease_status check_range(
    crease_context *context, const char *what, double value, double low, double high)
{
    return value >= low && value <= high
        ? CREASE_OK
        : crease_fail(context, CREASE_ERROR_ARGUMENT, "averaging: %s is %g; give %g to %g", what,
              value, low, high);
}

static crease_status check_options(crease_context *context, const crease_averaging_options *o)
{
    const struct {
        const char *what;
        double value, low, high;
    } ranges[] = {{"the number of rows of the net", (double)o->net[0], ORDER, MOST_ROWS},
        {"the number of columns of the net", (double)o->net[1], ORDER, MOST_ROWS},
        {"the number of neighbours averaged", o->averaging_neighbours, 1, MOST_NEIGHBOURS},
        {"the number of passes", o->passes, 1, MOST_PASSES},
        {"the number of neighbours for marking", o->marking_neighbours, 1, MOST_NEIGHBOURS},
        {"the threshold e of the marks", o->mark_threshold, -1e300, 1e300},
        {"the threshold g of the rows", o->row_threshold, 0, MOST_ROWS},
        {"the multiplicity of a row", o->multiplicity, 1, ORDER - 1}};
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        const crease_status status =
            check_range(context, ranges[i].what, ranges[i].value, ranges[i].low, ranges[i].high);
        if (status != CREASE_OK)
            return status;
    }
    return CREASE_OK;
}

static crease_status check_count(
    crease_context *context, size_t count, const crease_averaging_options *options)
{
    size_t least = (size_t)options->detect.neighbours;
    if (least < (size_t)options->averaging_neighbours)
        least = (size_t)options->averaging_neighbours;
    if (least < (size_t)options->marking_neighbours)
        least = (size_t)options->marking_neighbours;
    return count >= least
        ? CREASE_OK
        : crease_fail(context, CREASE_ERROR_TOO_FEW_POINTS,
              "averaging: %zu points; the neighbourhoods asked for need %zu, give more "
              "points or smaller numbers of neighbours",
              count, least);
}

/* Steps 1 and 2: bootstrap variance, standardised, and shifted to be positive. */
static crease_status weigh(crease_context *context, const crease_cloud *cloud, work *w)
{
    crease_scores *scores = NULL;
    crease_status status = crease_scores_compute(context, cloud, &w->options->detect, &scores);
    if (status != CREASE_OK)
        return status;
    const double *const variance = crease_scores_variance(scores);
    w->sheet->variance = crease_duplicate(context, variance, w->count, sizeof *variance);
    w->standardised = crease_allocate(context, w->count, sizeof *w->standardised);
    w->weights = crease_allocate(context, w->count, sizeof *w->weights);
    if (w->sheet->variance && w->standardised && w->weights) {
        crease_standardise(variance, w->count, false, w->standardised);
        crease_standardise(variance, w->count, true, w->weights);
    } else {
        status = CREASE_ERROR_NO_MEMORY;
    }
    crease_scores_free(scores);
    return status;
}

/* Moves the frame's origin up to the highest point: z = 0, where step 4 puts the first net, is the
 * level of the ridge, as in the sample of the paper. Which points are nearest to it depends on
 * that.
 */
static void lift_origin(crease_frame *frame, const double *local, size_t count)
{
    double highest[3] = {0.0, 0.0, -INFINITY};
    for (size_t i = 0; i < count; i++)
        highest[2] = fmax(highest[2], local[3 * i + 2]);
    crease_frame_leave(frame, highest, 1, frame->origin);
}

/* Step 3. */
static crease_status reorient(crease_context *context, work *w)
{
    crease_oriented oriented;
    const crease_status status = crease_orient(
        context, w->points, w->count, w->options->orientation, w->options->rotation, &oriented);
    if (status != CREASE_OK)
        return status;
    w->sheet->frame = oriented.frame;
    w->transposed = crease_orient_edge_axis(&oriented) == 0;
    w->local = crease_allocate(context, w->count, 3 * sizeof *w->local);
    if (!w->local)
        return CREASE_ERROR_NO_MEMORY;
    crease_frame_enter(&w->sheet->frame, w->points, w->count, w->local);
    lift_origin(&w->sheet->frame, w->local, w->count);
    crease_frame_enter(&w->sheet->frame, w->points, w->count, w->local);
    return CREASE_OK;
}

/* Steps 4 to 6. */
static crease_status shape_net(crease_context *context, work *w)
{
    const crease_averaging_options *const o = w->options;
    crease_status status =
        crease_net_create(context, w->local, w->count, o->net[0], o->net[1], &w->net);
    if (status == CREASE_OK)
        status = crease_tree_create(context, w->local, w->count, &w->tree);
    if (status == CREASE_OK)
        status = crease_net_average(
            context, &w->net, w->tree, w->local, w->weights, o->averaging_neighbours, o->passes);
    return status;
}

/* Steps 7 to 9. Distances are the same in both frames, so the net is marked where it is. */
static crease_status repeat_rows(crease_context *context, work *w)
{
    const crease_averaging_options *const o = w->options;
    w->marks = crease_allocate(context, o->net[0] * o->net[1], 1);
    w->passes = crease_allocate(context, o->net[0] + o->net[1], sizeof *w->passes);
    if (!w->marks || !w->passes)
        return CREASE_ERROR_NO_MEMORY;
    crease_status status = crease_mark(context, &w->net, w->tree, w->standardised,
        o->marking_neighbours, o->mark_threshold, w->marks);
    if (status == CREASE_OK && w->transposed)
        status = crease_net_transpose(context, &w->net, w->marks);
    if (status != CREASE_OK)
        return status;
    crease_marked_rows(w->marks, w->net.rows, w->net.columns, o->row_threshold, w->passes);
    return crease_net_repeat(context, &w->net, w->passes, (size_t)o->multiplicity, &w->repeated);
}

static crease_status make_surface(crease_context *context, const crease_net *net, double *knots[2],
    const double *control_points, crease_surface **out)
{
    const crease_surface_parts parts = {.order = {ORDER, ORDER},
        .count = {net->rows, net->columns},
        .knots = {knots[0], knots[1]},
        .control_points = control_points};
    return crease_surface_create(context, &parts, out);
}

/* Step 10, the surface: in the local frame for step 11, and where the cloud is (step 6). */
static crease_status make_surfaces(crease_context *context, work *w, crease_surface **local)
{
    const crease_net *const net = &w->repeated;
    const size_t counts[2] = {net->rows, net->columns}, size = net->rows * net->columns;
    double *knots[2] = {NULL, NULL};
    double *turned = crease_allocate(context, size, 3 * sizeof *turned);
    crease_status status = turned ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (int d = 0; d < 2 && status == CREASE_OK; d++) {
        knots[d] = crease_allocate(context, counts[d] + ORDER, sizeof *knots[d]);
        status = knots[d] ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
        if (knots[d])
            crease_knots_clamped(ORDER, counts[d], 0.0, 1.0, knots[d]);
    }
    if (status == CREASE_OK)
        status = make_surface(context, net, knots, net->points, local);
    if (status == CREASE_OK) {
        crease_frame_leave(&w->sheet->frame, net->points, size, turned);
        status = make_surface(context, net, knots, turned, &w->sheet->surface);
    }
    free(knots[0]);
    free(knots[1]);
    free(turned);
    return status;
}

/* A row that stands three times in the net makes a crease line, unless it is the border. */
static crease_status find_lines(crease_context *context, work *w)
{
    w->sheet->lines = crease_allocate(context, w->net.rows, sizeof *w->sheet->lines);
    if (!w->sheet->lines)
        return CREASE_ERROR_NO_MEMORY;
    const size_t times = (size_t)w->options->multiplicity;
    const double *const knots = crease_surface_parts_of(w->sheet->surface).knots[0];
    for (size_t i = 0, first = 0; i < w->net.rows; first += w->passes[i++] ? times : 1) {
        if (!w->passes[i] || times < ORDER - 1 || i == 0 || i + 1 == w->net.rows)
            continue;
        const double parameter = knots[first + ORDER - 1];
        w->sheet->lines[w->sheet->line_count++] = (crease_line){.direction = 0,
            .parameter = parameter,
            .angle = crease_sheet_dihedral(w->sheet->surface, 0, parameter)};
    }
    return CREASE_OK;
}

/* Step 11, and the distances to the surface. */
static crease_status project(crease_context *context, work *w, const crease_surface *local)
{
    crease_sheet *const sheet = w->sheet;
    crease_foot *feet = crease_allocate(context, w->count, sizeof *feet);
    sheet->projected = crease_duplicate(context, w->local, w->count, 3 * sizeof(double));
    sheet->deviations = crease_allocate(context, w->count, sizeof *sheet->deviations);
    crease_status status =
        feet && sheet->projected && sheet->deviations ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_project_heights(context, local, w->transposed, sheet->projected, w->count);
    if (status == CREASE_OK) {
        crease_frame_leave(&sheet->frame, sheet->projected, w->count, sheet->projected);
        status = crease_surface_project(context, sheet->surface, w->points, w->count, feet);
    }
    for (size_t i = 0; i < w->count && status == CREASE_OK; i++)
        sheet->deviations[i] = feet[i].distance;
    free(feet);
    return status;
}

static crease_status run(crease_context *context, const crease_cloud *cloud, work *w)
{
    crease_surface *local = NULL;
    crease_status status = reorient(context, w);
    if (status == CREASE_OK)
        status = weigh(context, cloud, w);
    if (status == CREASE_OK)
        status = shape_net(context, w);
    if (status == CREASE_OK)
        status = repeat_rows(context, w);
    if (status == CREASE_OK)
        status = make_surfaces(context, w, &local);
    if (status == CREASE_OK)
        status = find_lines(context, w);
    if (status == CREASE_OK)
        status = project(context, w, local);
    crease_surface_free(local);
    return status;
}

static void free_work(work *w)
{
    free(w->local);
    crease_tree_free(w->tree);
    free(w->standardised);
    free(w->weights);
    crease_net_free(&w->net);
    crease_net_free(&w->repeated);
    free(w->marks);
    free(w->passes);
    crease_sheet_free(w->sheet);
}

crease_status crease_averaging_fit(crease_context *context, const crease_cloud *cloud,
    const crease_averaging_options *options, crease_sheet **out)
{
    *out = NULL;
    const crease_averaging_options chosen = options ? *options : crease_averaging_options_default();
    work w = {.options = &chosen,
        .count = crease_cloud_count(cloud),
        .points = crease_cloud_points(cloud)};
    crease_status status = check_options(context, &chosen);
    if (status == CREASE_OK)
        status = check_count(context, w.count, &chosen);
    if (status == CREASE_OK) {
        w.sheet = crease_allocate(context, 1, sizeof *w.sheet);
        status = w.sheet ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    }
    if (status == CREASE_OK) {
        w.sheet->point_count = w.count;
        status = run(context, cloud, &w);
    }
    if (status == CREASE_OK) {
        *out = w.sheet;
        w.sheet = NULL;
    }
    free_work(&w);
    return status;
}
