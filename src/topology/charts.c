/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/charts.h"

#include "base/memory.h"
#include "base/vector.h"
#include "primitive/patch.h"
#include "primitive/primitive.h"
#include "topology/loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_HEIGHTS = 48, HEIGHTS_PER_SPAN = 3 };

static const double CAP_COSINE = 0.26;  /* of the angle from the middle up to which a face of a
                                           sphere is a patch that no pole is near */
static const double MARGIN = 3.0;       /* spacings around a free form */
static const double BALL_MARGIN = 0.05; /* of its width around a free form about a centre */
static const double TURN = 6.283185307179586476925;

/* ------------------------------------------------------------------------------- frames -- */

/* Right-handed, and with a cone that widens upwards. */
static crease_chart chart_of(const crease_model *model)
{
    crease_chart chart = {.type = model->type,
        .radius = model->radius,
        .round = model->type == CREASE_REGION_FREEFORM && model->patch.round,
        .ball = model->type == CREASE_REGION_FREEFORM && model->patch.ball,
        .shape = model->type == CREASE_REGION_CONE ? fabs(model->shape) : model->shape};
    const double up = model->type == CREASE_REGION_CONE && model->shape < 0.0 ? -1.0 : 1.0;
    for (int c = 0; c < 3; c++) {
        chart.centre[c] = model->centre[c];
        chart.axes[c] = model->axes[c];
        chart.axes[6 + c] = up * model->axes[6 + c];
    }
    crease_vector_cross(chart.axes + 6, chart.axes, chart.axes + 3);
    return chart;
}

/* Mean unit direction of a region's points from the centre, across the axis if there is one. */
static void mean_direction(
    const crease_graph *graph, uint32_t region, const double *axis, double out[3])
{
    const crease_regions *const r = graph->survey->regions;
    const double *const centre = graph->topology->charts[region].centre;
    memset(out, 0, 3 * sizeof *out);
    for (size_t i = 0; i < r->count; i++) {
        if (r->labels[i] != (int32_t)region)
            continue;
        double d[3];
        for (size_t c = 0; c < 3; c++)
            d[c] = r->points[3 * i + c] - centre[c];
        const double along = axis ? crease_vector_dot(d, axis) : 0.0;
        for (int c = 0; c < 3 && axis; c++)
            d[c] -= along * axis[c];
        crease_vector_normalise(d);
        for (int c = 0; c < 3; c++)
            out[c] += d[c];
    }
}

/* Least cosine of the angle between a direction and those of the region's points. */
static double least_cosine(const crease_graph *graph, uint32_t region, const double direction[3])
{
    const crease_regions *const r = graph->survey->regions;
    const double *const centre = graph->topology->charts[region].centre;
    double least = 1.0;
    for (size_t i = 0; i < r->count; i++) {
        double d[3];
        for (size_t c = 0; c < 3; c++)
            d[c] = r->points[3 * i + c] - centre[c];
        crease_vector_normalise(d);
        if (r->labels[i] == (int32_t)region)
            least = fmin(least, crease_vector_dot(d, direction));
    }
    return least;
}

/* Lets the axis of a sphere go through the middle of its greatest rim. */
static crease_status through_rim(crease_graph *graph, uint32_t region, double axis[3])
{
    crease_loops loops;
    bool closed;
    double most = 0.0;
    const crease_status status = crease_loops_walk(graph, region, &loops, &closed);
    for (size_t i = 0; i < loops.count; i++) {
        double area[3];
        crease_loop_area_vector(graph, &loops.items[i], area);
        if (crease_vector_length(area) > most) {
            most = crease_vector_length(area);
            memcpy(axis, area, sizeof area);
        }
    }
    crease_loops_clear(&loops);
    return status;
}

static crease_status turn_sphere(crease_graph *graph, uint32_t region)
{
    crease_chart *const chart = &graph->topology->charts[region];
    double middle[3];
    crease_status status = CREASE_OK;
    mean_direction(graph, region, NULL, middle);
    if (!(crease_vector_length(middle) > 0.0))
        return CREASE_OK;
    crease_vector_normalise(middle);
    memcpy(chart->axes + 6, middle, sizeof middle);
    crease_primitive_frame(chart->axes);
    if (least_cosine(graph, region, middle) > CAP_COSINE)
        memcpy(chart->axes + 6, chart->axes, sizeof middle);
    else
        status = through_rim(graph, region, chart->axes + 6);
    crease_vector_normalise(chart->axes + 6);
    crease_primitive_frame(chart->axes);
    return status;
}

/* Mean angle about the tube of a torus. */
static double middle_of_tube(const crease_graph *graph, uint32_t region)
{
    const crease_regions *const r = graph->survey->regions;
    double x = 0.0, y = 0.0;
    for (size_t i = 0; i < r->count; i++) {
        double uv[2];
        if (r->labels[i] != (int32_t)region)
            continue;
        crease_chart_at(&graph->topology->charts[region], r->points + 3 * i, uv);
        x += cos(uv[1]);
        y += sin(uv[1]);
    }
    return atan2(y, x);
}

static crease_status turn_chart(crease_graph *graph, uint32_t region)
{
    crease_chart *const chart = &graph->topology->charts[region];
    crease_status status = CREASE_OK;
    if (!crease_chart_turns(chart, 0))
        return CREASE_OK;
    if (chart->type == CREASE_REGION_SPHERE)
        status = turn_sphere(graph, region);
    if (chart->type == CREASE_REGION_TORUS)
        chart->middle = middle_of_tube(graph, region);
    double away[3];
    mean_direction(graph, region, chart->axes + 6, away);
    for (int c = 0; c < 3; c++)
        away[c] = chart->centre[c] - away[c];
    crease_chart_begin_at(chart, away);
    return status;
}

crease_status crease_charts_make(crease_graph *graph)
{
    const crease_regions *const r = graph->survey->regions;
    crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    t->charts = crease_allocate(graph->context, r->region_count, sizeof *t->charts);
    if (!t->charts)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < r->region_count; i++)
        t->charts[i] = chart_of(&r->models[i]);
    for (size_t i = 0; i < r->region_count && status == CREASE_OK; i++)
        status = turn_chart(graph, (uint32_t)i);
    return status;
}

/* ------------------------------------------------------------------------------ heights -- */

static void extend(crease_chart *chart, const double place[3])
{
    double at[2];
    crease_chart_at(chart, place, at);
    for (int d = 0; d < 2; d++) {
        chart->low[d] = fmin(chart->low[d], at[d]);
        chart->high[d] = fmax(chart->high[d], at[d]);
    }
}

static void find_rectangle(const crease_graph *graph, uint32_t region, crease_chart *chart)
{
    const crease_regions *const r = graph->survey->regions;
    const crease_topology *const t = graph->topology;
    for (int d = 0; d < 2; d++) {
        chart->low[d] = INFINITY;
        chart->high[d] = -INFINITY;
    }
    for (size_t i = 0; i < r->count; i++)
        if (r->labels[i] == (int32_t)region)
            extend(chart, r->points + 3 * i);
    for (size_t e = 0; e < t->edge_count; e++)
        for (size_t i = 0; i < t->edges[e].count && crease_edge_has(&t->edges[e], region); i++)
            extend(chart, t->edges[e].points + 3 * i);
    const double margin = MARGIN * graph->survey->spacing;
    for (int d = 0; d < 2; d++) {
        chart->low[d] -= chart->ball ? BALL_MARGIN * (chart->high[d] - chart->low[d]) : margin;
        chart->high[d] += chart->ball ? BALL_MARGIN * (chart->high[d] - chart->low[d]) : margin;
    }
    if (chart->round) {
        chart->low[0] = 0.0;
        chart->high[0] = TURN;
    }
}

/* The model's own x and y, or angle and z, of u and v. */
static void model_parameters(
    const crease_model *model, const crease_chart *chart, const double uv[2], double out[2])
{
    const double *const x = chart->axes, *const y = x + 3;
    double towards[3];
    out[1] = uv[1];
    if (!chart->round) {
        out[0] = uv[0];
        out[1] *= crease_vector_dot(y, model->axes + 3) < 0.0 ? -1.0 : 1.0;
        return;
    }
    for (int c = 0; c < 3; c++)
        towards[c] = cos(uv[0]) * x[c] + sin(uv[0]) * y[c];
    out[0] =
        atan2(crease_vector_dot(towards, model->axes + 3), crease_vector_dot(towards, model->axes));
}

static void sample_heights(const crease_model *model, crease_chart *chart)
{
    const double cells = (double)(chart->side - 1);
    for (size_t i = 0; i < chart->side; i++)
        for (size_t k = 0; k < chart->side; k++) {
            const double uv[2] = {
                chart->low[0] + (chart->high[0] - chart->low[0]) * (double)i / cells,
                chart->low[1] + (chart->high[1] - chart->low[1]) * (double)k / cells};
            double at[2], slope[2];
            model_parameters(model, chart, uv, at);
            chart->heights[i * chart->side + k] =
                crease_patch_at(&model->patch, at[0], at[1], slope);
        }
}

/* So many heights that a spline through them is the spline that they are of. */
static size_t heights_of(const crease_patch *patch)
{
    const size_t wanted = patch->spline ? HEIGHTS_PER_SPAN * (size_t)patch->spans : 0;
    return wanted > LEAST_HEIGHTS ? wanted : LEAST_HEIGHTS;
}

crease_status crease_charts_cover(crease_graph *graph)
{
    crease_topology *const t = graph->topology;
    for (size_t i = 0; i < t->region_count; i++) {
        crease_chart *const chart = &t->charts[i];
        if (chart->type != CREASE_REGION_FREEFORM)
            continue;
        const crease_model *const model = &graph->survey->regions->models[i];
        chart->side = heights_of(&model->patch);
        chart->heights =
            crease_allocate(graph->context, chart->side * chart->side, sizeof *chart->heights);
        if (!chart->heights)
            return CREASE_ERROR_NO_MEMORY;
        find_rectangle(graph, (uint32_t)i, chart);
        sample_heights(model, chart);
    }
    return CREASE_OK;
}
