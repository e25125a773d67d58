/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Whether a sheet has the creases that its cloud's regions have between them, and follows the rest
 * as closely as the noise lets it. */
#include "base/memory.h"
#include "base/select.h"
#include "base/vector.h"
#include "spline/sheet.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_PARTS = 4000, CHORDS = 64 };

static const double EXACT = 1e-7; /* spacings that a deviation may be, of points without noise */
static const double FEW =
    0.25; /* control points for each point, where exactness proves something */
static const double EXCESS = 1.25; /* of the residual over the noise */
/* Spacings between a crease and the sheet's line, at most: what the points can tell is between. */
static const double ASTRAY[2] = {0.5, 1.0};
static const double TOLD = 3.0;    /* standard deviations between surfaces that points tell apart */
static const double STEP = 0.25;   /* spacings between places along a curve */
static const double UNKNOWN = 3.0; /* spacings from every crease: a bend of the sheet's own */
static const double SHOWN = 2.0;   /* spacings from a point, at most, for a bend to count */
static const double LEAST_BEND = 10.0; /* degrees */
static const double TOLERATED = 0.1;   /* of the length of all creases, or of all bends */

/* Places along curves, densely. */
typedef struct stations {
    size_t count, room;
    double *places;
} stations;

static crease_status add_place(crease_context *context, const double place[3], stations *out)
{
    if (out->count == out->room) {
        const size_t room = 2 * out->room + 64;
        double *const more = crease_reallocate(context, out->places, room, 3 * sizeof *more);
        if (!more)
            return CREASE_ERROR_NO_MEMORY;
        out->places = more;
        out->room = room;
    }
    memcpy(out->places + 3 * out->count++, place, 3 * sizeof *place);
    return CREASE_OK;
}

static size_t parts_of(double length, double step)
{
    return (size_t)fmin(fmax(ceil(length / step), 1.0), MOST_PARTS);
}

static crease_status add_curve(
    crease_context *context, const crease_curve *curve, double length, double step, stations *out)
{
    crease_status status = CREASE_OK;
    double domain[2];
    crease_curve_domain(curve, domain);
    const size_t parts = parts_of(length, step);
    for (size_t i = 0; i <= parts && status == CREASE_OK; i++) {
        const double share = (double)i / (double)parts;
        double place[3];
        crease_curve_evaluate(
            curve, domain[0] + (domain[1] - domain[0]) * share, CREASE_SIDE_RIGHT, 0, place);
        status = add_place(context, place, out);
    }
    return status;
}

/* Squares of the distances of places to the nearest of the others. */
static crease_status measure(crease_context *context, const double *places, size_t count,
    const stations *others, double *squares)
{
    crease_tree *tree = NULL;
    for (size_t i = 0; i < count; i++)
        squares[i] = INFINITY;
    if (others->count == 0)
        return CREASE_OK;
    uint32_t *const near = crease_allocate(context, count, sizeof *near);
    crease_status status = near ? crease_tree_create(context, others->places, others->count, &tree)
                                : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_tree_nearest(context, tree, places, count, 1, near, squares);
    crease_tree_free(tree);
    free(near);
    return status;
}

/* The places that lie within `reach` of one of the others, or those that do not. */
static crease_status sift(crease_context *context, const stations *places, const stations *others,
    double reach, bool within, stations *out)
{
    if (places->count == 0)
        return CREASE_OK;
    double *const squares = crease_allocate(context, places->count, sizeof *squares);
    if (!squares)
        return CREASE_ERROR_NO_MEMORY;
    crease_status status = measure(context, places->places, places->count, others, squares);
    for (size_t i = 0; i < places->count && status == CREASE_OK; i++)
        if ((squares[i] <= reach * reach) == within)
            status = add_place(context, places->places + 3 * i, out);
    free(squares);
    return status;
}

static void place_on_line(
    const crease_sheet *sheet, size_t line, double share, double uv[2], double place[3])
{
    const crease_line l = sheet->lines[line];
    double domain[2];
    crease_surface_domain(sheet->surface, 1 - l.direction, domain);
    uv[l.direction] = l.parameter;
    uv[1 - l.direction] = domain[0] + (domain[1] - domain[0]) * share;
    crease_surface_point(sheet->surface, uv, place);
}

static double line_length(const crease_sheet *sheet, size_t line)
{
    double uv[2], last[3], place[3], length = 0.0;
    place_on_line(sheet, line, 0.0, uv, last);
    for (int i = 1; i <= CHORDS; i++) {
        place_on_line(sheet, line, (double)i / CHORDS, uv, place);
        length += crease_vector_distance(place, last);
        memcpy(last, place, sizeof last);
    }
    return length;
}

/* The places of a line at which the sheet bends. */
static crease_status add_bends(
    crease_context *context, const crease_sheet *sheet, size_t line, double step, stations *out)
{
    crease_status status = CREASE_OK;
    const size_t parts = parts_of(line_length(sheet, line), step);
    for (size_t i = 0; i <= parts && status == CREASE_OK; i++) {
        double uv[2], place[3];
        place_on_line(sheet, line, (double)i / (double)parts, uv, place);
        if (crease_sheet_bend(sheet->surface, sheet->lines[line].direction, uv) >= LEAST_BEND)
            status = add_place(context, place, out);
    }
    return status;
}

/* How far a line may be from a crease: to where a point may as well be of either side. */
static double leeway(double sigma, double dihedral, double spacing)
{
    const double bend = tan(0.017453292519943296 * fmin(fabs(180.0 - dihedral), 89.0));
    return fmin(fmax(TOLD * sigma / bend, ASTRAY[0] * spacing), ASTRAY[1] * spacing);
}

/* Whether the creases run along bends. */
static crease_status creases_bend(crease_context *context, const crease_network *network,
    const stations *bends, double sigma, bool *bend)
{
    const double spacing = crease_network_spacing(network);
    stations astray = {0};
    size_t all = 0;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < crease_network_count(network) && status == CREASE_OK; i++) {
        const crease_network_crease one = crease_network_at(network, i);
        stations crease = {0};
        status = add_curve(
            context, crease_network_curves(network)[i], one.length, STEP * spacing, &crease);
        if (status == CREASE_OK)
            status =
                sift(context, &crease, bends, leeway(sigma, one.angle, spacing), false, &astray);
        all += crease.count;
        free(crease.places);
    }
    *bend = status == CREASE_OK && (double)astray.count <= TOLERATED * (double)all;
    free(astray.places);
    return status;
}

/* Whether the bends run along creases, where there are points: a line goes on past their border. */
static crease_status bends_crease(crease_context *context, const crease_sheet *sheet,
    const stations *bends, const stations *creases, double spacing, bool *crease)
{
    const stations points = {.count = sheet->point_count, .places = sheet->projected};
    stations shown = {0}, unknown = {0};
    crease_status status = sift(context, bends, &points, SHOWN * spacing, true, &shown);
    if (status == CREASE_OK)
        status = sift(context, &shown, creases, UNKNOWN * spacing, false, &unknown);
    *crease = status == CREASE_OK && (double)unknown.count <= TOLERATED * (double)shown.count;
    free(shown.places);
    free(unknown.places);
    return status;
}

static crease_status creases_agree(crease_context *context, const crease_sheet *sheet,
    const crease_network *network, double sigma, bool *agree)
{
    const double spacing = crease_network_spacing(network), step = STEP * spacing;
    stations creases = {0}, bends = {0};
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < crease_network_count(network) && status == CREASE_OK; i++)
        status = add_curve(context, crease_network_curves(network)[i],
            crease_network_at(network, i).length, step, &creases);
    for (size_t l = 0; l < sheet->line_count && status == CREASE_OK; l++)
        status = add_bends(context, sheet, l, step, &bends);
    if (status == CREASE_OK)
        status = creases_bend(context, network, &bends, sigma, agree);
    if (status == CREASE_OK && *agree)
        status = bends_crease(context, sheet, &bends, &creases, spacing, agree);
    free(creases.places);
    free(bends.places);
    return status;
}

/* Robust standard deviation of the points that have a region. */
static crease_status residual_scale(crease_context *context, const crease_sheet *sheet,
    const crease_regions *regions, double *scale)
{
    size_t n = 0;
    double *const values = crease_allocate(context, sheet->point_count, sizeof *values);
    if (!values)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < sheet->point_count; i++)
        if (crease_regions_labels(regions)[i] >= 0)
            values[n++] = fabs(sheet->deviations[i]);
    *scale = n ? 1.4826 * crease_select(values, n, n / 2) : 0.0;
    free(values);
    return CREASE_OK;
}

/* Whether all points lie on the sheet as well as rounding lets them, and are many more than what it
 * is made of: a crease that it missed, or made up, would show. */
static bool is_exact(const crease_sheet *sheet, double spacing)
{
    const crease_surface_parts parts = crease_surface_parts_of(sheet->surface);
    double most = 0.0;
    for (size_t i = 0; i < sheet->point_count; i++)
        most = fmax(most, fabs(sheet->deviations[i]));
    return most <= EXACT * spacing &&
        (double)(parts.count[0] * parts.count[1]) <= FEW * (double)sheet->point_count;
}

crease_status crease_sheet_carries(crease_context *context, const crease_sheet *sheet,
    const crease_regions *regions, const crease_network *network, bool *carries)
{
    double scale = 0.0;
    *carries = false;
    if (crease_regions_point_count(regions) != sheet->point_count)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sheet: regions of %zu points for a sheet of %zu; give those of the same cloud",
            crease_regions_point_count(regions), sheet->point_count);
    if (is_exact(sheet, crease_network_spacing(network))) {
        *carries = true;
        return CREASE_OK;
    }
    crease_status status = residual_scale(context, sheet, regions, &scale);
    if (status != CREASE_OK || !(scale <= EXCESS * crease_regions_sigma(regions)))
        return status;
    return creases_agree(context, sheet, network, crease_regions_sigma(regions), carries);
}
