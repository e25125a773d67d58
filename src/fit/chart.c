/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* First across: between courses by shares, beyond the outer ones by distance. Then each coordinate
 * is stretched to between its lowest and highest value over the other one, so that ragged or
 * slanted borders become sides of the rectangle. */
#include "fit/chart.h"

#include <math.h>
#include <string.h>

enum { MOST_NODES = 64, STATIONS = 64, PASSES = 8 };

static const double NODE = 8.0;         /* spacings between nodes, at least */
static const double INWARD = 1.5;       /* standard deviations, from the outermost points */
static const double MOST_SLANT = 0.3;   /* of the extent: as far as a side follows its border in */
static const double LEAST_EXTENT = 0.4; /* of the mean one: borders that come closer are not
                                           followed, the sheet would be pinched */

/* A polygon over one coordinate. */
typedef struct bounds {
    size_t count;
    double at[MOST_NODES], low[MOST_NODES], high[MOST_NODES];
} bounds;

static double mean_across(const crease_course *course, const double along[2])
{
    double sum = 0.0;
    for (int i = 0; i < STATIONS; i++)
        sum +=
            crease_course_across(course, along[0] + (along[1] - along[0]) * (i + 0.5) / STATIONS);
    return sum / STATIONS;
}

/* Coordinate across that is constant on the courses. */
static double straighten(const crease_courses *courses, const double *line, const double p[2],
    size_t strip, double spacing)
{
    const size_t last = courses->count;
    const double least = 0.01 * spacing;
    double before = 0.0, behind = 0.0;
    if (strip > 0)
        before = crease_course_across(&courses->items[strip - 1], p[1]);
    if (strip < last)
        behind = crease_course_across(&courses->items[strip], p[1]);
    if (strip == 0)
        return line[0] - fmax(behind - p[0], least);
    if (strip == last)
        return line[last - 1] + fmax(p[0] - before, least);
    const double share = (p[0] - before) / fmax(behind - before, least);
    return line[strip - 1] + (line[strip] - line[strip - 1]) * fmin(fmax(share, 0.01), 0.99);
}

/* Nodes at the ends of the parts of an interval and evenly between. */
static void set_nodes(const double *ends, size_t count, double step, bounds *out)
{
    const double whole = ends[count - 1] - ends[0];
    const double wanted = fmin(fmax(floor(whole / step), 1.0), MOST_NODES - 2.0 * (double)count);
    out->count = 0;
    for (size_t e = 0; e + 1 < count; e++) {
        const double length = ends[e + 1] - ends[e];
        const size_t parts = (size_t)fmax(1.0, floor(wanted * length / whole));
        for (size_t i = 0; i < parts && out->count + 1 < MOST_NODES; i++)
            out->at[out->count++] = ends[e] + length * (double)i / (double)parts;
    }
    out->at[out->count++] = ends[count - 1];
}

static size_t interval_of(const bounds *b, double t)
{
    size_t k = 0;
    while (k + 2 < b->count && b->at[k + 1] <= t)
        k++;
    return k;
}

static double between(const bounds *b, const double *values, double t)
{
    const size_t k = interval_of(b, t);
    const double share = (t - b->at[k]) / (b->at[k + 1] - b->at[k]);
    return values[k] + (values[k + 1] - values[k]) * fmin(fmax(share, 0.0), 1.0);
}

/* Nodes without points get the values of the nearest ones that have some. */
static void fill_empty(bounds *b)
{
    for (size_t k = 0; k < b->count; k++)
        for (size_t off = 1; off < b->count && !(b->low[k] <= b->high[k]); off++) {
            const size_t near[2] = {k >= off ? k - off : k, k + off < b->count ? k + off : k};
            for (int i = 0; i < 2; i++)
                if (b->low[near[i]] <= b->high[near[i]]) {
                    b->low[k] = b->low[near[i]];
                    b->high[k] = b->high[near[i]];
                }
        }
}

/* Lowest and highest `value` around each node, the extents kept from vanishing. */
static void set_bounds(
    const crease_spread *spread, const double *over, const double *value, bounds *b)
{
    const double inward = INWARD * spread->sigma;
    for (size_t k = 0; k < b->count; k++) {
        b->low[k] = INFINITY;
        b->high[k] = -INFINITY;
    }
    for (size_t i = 0; i < spread->count; i++) {
        if (!(spread->keep[i] > 0.0))
            continue;
        size_t k = interval_of(b, over[2 * i]);
        k += over[2 * i] > 0.5 * (b->at[k] + b->at[k + 1]);
        b->low[k] = fmin(b->low[k], value[2 * i]);
        b->high[k] = fmax(b->high[k], value[2 * i]);
    }
    fill_empty(b);
    double mean = 0.0;
    for (size_t k = 0; k < b->count; k++) {
        b->low[k] += inward;
        b->high[k] -= inward;
        mean += (b->high[k] - b->low[k]) / (double)b->count;
    }
    for (size_t k = 0; k < b->count; k++) {
        const double missing = LEAST_EXTENT * mean - (b->high[k] - b->low[k]);
        b->low[k] -= fmax(0.0, 0.5 * missing);
        b->high[k] += fmax(0.0, 0.5 * missing);
    }
}

/* A border that comes in by more than a little is no side: the side stays where the border is
 * farthest out, and what it encloses is trimmed. */
static void keep_straight(bounds *b)
{
    double lowest = INFINITY, inmost = -INFINITY, highest = -INFINITY, least = INFINITY;
    for (size_t k = 0; k < b->count; k++) {
        lowest = fmin(lowest, b->low[k]);
        inmost = fmax(inmost, b->low[k]);
        highest = fmax(highest, b->high[k]);
        least = fmin(least, b->high[k]);
    }
    const double most = MOST_SLANT * (highest - lowest);
    for (size_t k = 0; k < b->count; k++) {
        if (inmost - lowest > most)
            b->low[k] = lowest;
        if (highest - least > most)
            b->high[k] = highest;
    }
}

static void range(const crease_spread *spread, const double *value, double ends[2])
{
    ends[0] = INFINITY;
    ends[1] = -INFINITY;
    for (size_t i = 0; i < spread->count; i++)
        if (spread->keep[i] > 0.0) {
            ends[0] = fmin(ends[0], value[2 * i]);
            ends[1] = fmax(ends[1], value[2 * i]);
        }
}

/* Along: from border to border over every place across. */
static void stretch_along(
    const crease_spread *spread, const double *ends, size_t count, double *uv, double domain[2])
{
    bounds b;
    set_nodes(ends, count, NODE * spread->spacing, &b);
    set_bounds(spread, uv, uv + 1, &b);
    keep_straight(&b);
    double extent = 0.0;
    for (size_t k = 0; k < b.count; k++)
        extent += (b.high[k] - b.low[k]) / (double)b.count;
    domain[0] = 0.0;
    domain[1] = extent;
    for (size_t i = 0; i < spread->count; i++) {
        const double low = between(&b, b.low, uv[2 * i]), high = between(&b, b.high, uv[2 * i]);
        uv[2 * i + 1] = (uv[2 * i + 1] - low) / (high - low) * extent;
    }
}

/* Across: beyond the outer lines, from border to border over every place along. */
static void stretch_across(const crease_spread *spread, const double *line, size_t lines,
    const double domain[2], double *uv, double ends[2])
{
    bounds b;
    double outer[2] = {0.0, 0.0};
    set_nodes(domain, 2, NODE * spread->spacing, &b);
    set_bounds(spread, uv + 1, uv, &b);
    keep_straight(&b);
    for (size_t k = 0; k < b.count; k++) {
        outer[0] += (line[0] - b.low[k]) / (double)b.count;
        outer[1] += (b.high[k] - line[lines - 1]) / (double)b.count;
    }
    for (size_t k = 0; k < b.count; k++) {
        b.low[k] = fmin(b.low[k], line[0] - LEAST_EXTENT * outer[0]);
        b.high[k] = fmax(b.high[k], line[lines - 1] + LEAST_EXTENT * outer[1]);
    }
    ends[0] = line[0] - outer[0];
    ends[1] = line[lines - 1] + outer[1];
    for (size_t i = 0; i < spread->count; i++) {
        double *const u = uv + 2 * i;
        if (spread->strip[i] == 0)
            *u = line[0] - (line[0] - *u) / (line[0] - between(&b, b.low, u[1])) * outer[0];
        else if (spread->strip[i] == lines)
            *u = line[lines - 1] +
                (*u - line[lines - 1]) / (between(&b, b.high, u[1]) - line[lines - 1]) * outer[1];
    }
}

static void clamp(size_t count, const double across[2], const double along[2], double *uv)
{
    for (size_t i = 0; i < count; i++) {
        uv[2 * i] = fmin(fmax(uv[2 * i], across[0]), across[1]);
        uv[2 * i + 1] = fmin(fmax(uv[2 * i + 1], along[0]), along[1]);
    }
}

void crease_chart_points(
    const crease_spread *spread, const crease_courses *courses, double *uv, crease_layout *layout)
{
    double ends[CREASE_MOST_LINES + 2] = {0.0}, domain[2], outer[2];
    double *const line = ends + 1;
    const size_t lines = courses->count;
    range(spread, spread->plane + 1, outer);
    for (size_t c = 0; c < lines; c++)
        line[c] = mean_across(&courses->items[c], outer);
    for (size_t i = 0; i < spread->count; i++) {
        uv[2 * i] =
            straighten(courses, line, spread->plane + 2 * i, spread->strip[i], spread->spacing);
        uv[2 * i + 1] = spread->plane[2 * i + 1];
    }
    range(spread, uv + 1, domain);
    for (int pass = 0; pass < PASSES; pass++) {
        stretch_across(spread, line, lines, domain, uv, outer);
        ends[0] = outer[0];
        ends[lines + 1] = outer[1];
        stretch_along(spread, ends, lines + 2, uv, domain);
    }
    clamp(spread->count, outer, domain, uv);
    layout->axis[0] = (crease_layout_axis){.low = outer[0], .high = outer[1], .line_count = lines};
    memcpy(layout->axis[0].lines, line, lines * sizeof *line);
    layout->axis[1] = (crease_layout_axis){.low = domain[0], .high = domain[1]};
}
