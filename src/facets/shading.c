/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "facets/shading.h"

#include "base/memory.h"
#include "base/vector.h"
#include "facets/sides.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double FLAT = 0.0035;     /* sine of 0.2 degrees */
static const double SMOOTH = 0.342;    /* sine of 20 degrees */
static const double WIDER = 2.5;       /* a flat facet than the curved ones beside it */
static const double NEGLECTED = 0.003; /* share of the area in faces that may be narrower */

typedef struct relief {
    const crease_facets *facets;
    crease_shading *out;
    uint32_t *opposite; /* of each side */
    double *normals;    /* of each triangle */
    uint32_t *plane;    /* of each triangle: the first one of its facet */
    uint32_t *face;     /* of each triangle: the first one of its face */
    double *widths;     /* of facets, later of faces, at their first triangle */
    double *lengths;    /* of their borders */
    uint32_t *beside;   /* a facet that turns on from this one, plus 1 */
    bool *passes;       /* facets that turn on two sides */
    double *inner;      /* of each facet: the sum of its normals at corners where it turns on */
} relief;

/* --------------------------------------------------------------------------------- groups -- */

static uint32_t root(uint32_t *group, uint32_t i)
{
    while (group[i] != i)
        i = group[i] = group[group[i]];
    return i;
}

static void join(uint32_t *group, uint32_t a, uint32_t b)
{
    a = root(group, a);
    b = root(group, b);
    group[a > b ? a : b] = a > b ? b : a;
}

/* Whether the surface turns by less than the angle with this sine at a side that two triangles
 * share. */
static bool turns_less(const relief *r, uint32_t side, double sine)
{
    double cross[3];
    const uint32_t other = r->opposite[side];
    if (other == CREASE_SIDE_NONE)
        return false;
    const double *const a = r->normals + 3 * (size_t)(side / 3);
    const double *const b = r->normals + 3 * (size_t)(other / 3);
    crease_vector_cross(a, b, cross);
    return crease_vector_dot(a, b) > 0 && crease_vector_length(cross) < sine;
}

static void find_groups(const relief *r, double sine, uint32_t *group)
{
    const uint32_t count = (uint32_t)r->facets->triangle_count;
    for (uint32_t i = 0; i < count; i++)
        group[i] = i;
    for (uint32_t i = 0; i < 3 * count; i++)
        if (turns_less(r, i, sine))
            join(group, i / 3, r->opposite[i] / 3);
    for (uint32_t i = 0; i < count; i++)
        group[i] = root(group, i);
}

static double length_of(const crease_facets *facets, uint32_t side)
{
    const int corner = (int)(side % 3);
    return crease_vector_distance(crease_facets_corner(facets, side / 3, corner),
        crease_facets_corner(facets, side / 3, (corner + 1) % 3));
}

/* Twice the area by the length of the border: a long strip's width. A closed face has no border. */
static void find_widths(const relief *r, const uint32_t *group)
{
    const size_t count = r->facets->triangle_count;
    memset(r->widths, 0, count * sizeof *r->widths);
    memset(r->lengths, 0, count * sizeof *r->lengths);
    for (size_t i = 0; i < count; i++)
        r->widths[group[i]] += r->out->areas[i];
    for (uint32_t i = 0; i < 3 * count; i++)
        if (r->opposite[i] == CREASE_SIDE_NONE || group[r->opposite[i] / 3] != group[i / 3])
            r->lengths[group[i / 3]] += length_of(r->facets, i);
    for (size_t i = 0; i < count; i++)
        r->widths[i] = r->lengths[i] > 0 ? 2 * r->widths[i] / r->lengths[i] : sqrt(r->widths[i]);
}

/* ------------------------------------------------------------------------- flat and curved -- */

static bool bends(const relief *r, uint32_t side)
{
    return turns_less(r, side, SMOOTH) && r->plane[side / 3] != r->plane[r->opposite[side] / 3];
}

static void find_passes(const relief *r)
{
    for (uint32_t i = 0; i < 3 * r->facets->triangle_count; i++)
        if (bends(r, i)) {
            const uint32_t facet = r->plane[i / 3], other = r->plane[r->opposite[i] / 3] + 1;
            r->passes[facet] = r->passes[facet] || (r->beside[facet] && r->beside[facet] != other);
            r->beside[facet] = other;
        }
}

static void find_curved(const relief *r)
{
    bool *const curved = r->out->curved;
    for (uint32_t i = 0; i < 3 * r->facets->triangle_count; i++)
        if (bends(r, i)) {
            const uint32_t facet = r->plane[i / 3], other = r->plane[r->opposite[i] / 3];
            if (r->passes[other] && r->widths[other] * WIDER > r->widths[facet])
                curved[facet] = true;
        }
    for (size_t i = 0; i < r->facets->triangle_count; i++)
        curved[i] = curved[r->plane[i]];
}

/* --------------------------------------------------------------------------------- normals -- */

/* What the triangles around a corner say of its normal. */
typedef struct opinion {
    double sum[3];
    uint32_t flat; /* a triangle of the flat facet, plus 1 */
    bool several;  /* flat facets */
    bool bends;    /* facets of more than one plane */
} opinion;

static double angle_at(const crease_facets *facets, size_t triangle, int corner)
{
    const double *const at = crease_facets_corner(facets, triangle, corner);
    const double *const p = crease_facets_corner(facets, triangle, (corner + 1) % 3);
    const double *const q = crease_facets_corner(facets, triangle, (corner + 2) % 3);
    const double a[3] = {p[0] - at[0], p[1] - at[1], p[2] - at[2]};
    const double b[3] = {q[0] - at[0], q[1] - at[1], q[2] - at[2]};
    double cross[3];
    crease_vector_cross(a, b, cross);
    return atan2(crease_vector_length(cross), crease_vector_dot(a, b));
}

static void ask(const relief *r, uint32_t corner, uint32_t plane, opinion *out)
{
    const uint32_t triangle = corner / 3;
    const double *const normal = r->normals + 3 * (size_t)triangle;
    const double angle = angle_at(r->facets, triangle, (int)(corner % 3));
    for (int c = 0; c < 3; c++)
        out->sum[c] += angle * normal[c];
    out->bends = out->bends || r->plane[triangle] != plane;
    if (r->out->curved[triangle])
        return;
    out->several = out->several || (out->flat && r->plane[out->flat - 1] != r->plane[triangle]);
    out->flat = triangle + 1;
}

static uint32_t next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/* The same vertex in the next triangle around it, or NONE where the face ends. Side k begins at
 * corner k: forwards over the side before the corner, backwards over the one behind it. */
static uint32_t around(const relief *r, uint32_t corner, bool forwards)
{
    const uint32_t side = forwards ? next_corner(next_corner(corner)) : corner;
    if (!turns_less(r, side, SMOOTH))
        return CREASE_SIDE_NONE;
    const uint32_t other = r->opposite[side];
    return forwards ? other : next_corner(other);
}

/* False where all triangles around the corner are in one plane: the face ends here. */
static bool find_normal(const relief *r, uint32_t corner, double normal[3])
{
    const uint32_t plane = r->plane[corner / 3];
    opinion all = {.flat = 0};
    uint32_t at = corner;
    ask(r, corner, plane, &all);
    while ((at = around(r, at, true)) != CREASE_SIDE_NONE && at != corner)
        ask(r, at, plane, &all);
    if (at != corner)
        for (at = corner; (at = around(r, at, false)) != CREASE_SIDE_NONE;)
            ask(r, at, plane, &all);
    const double *const flat = all.flat ? r->normals + 3 * (size_t)(all.flat - 1) : NULL;
    memcpy(normal, flat && !all.several ? flat : all.sum, 3 * sizeof *normal);
    crease_vector_normalise(normal);
    return all.bends;
}

/* Where a curved face ends, its normal turns as much beyond the facet's as it does on the facet's
 * other side before it: exact on cylinders and cones. */
static void continue_normals(const relief *r, const bool *ends)
{
    for (size_t i = 0; i < 3 * r->facets->triangle_count; i++) {
        const double *const facet = r->normals + i / 3 * 3;
        double before[3];
        if (!ends[i])
            continue;
        memcpy(before, r->inner + 3 * (size_t)r->plane[i / 3], sizeof before);
        crease_vector_normalise(before);
        const double along = 2 * crease_vector_dot(before, facet);
        for (int c = 0; c < 3 && along > 0; c++)
            r->out->normals[3 * i + (size_t)c] = along * facet[c] - before[c];
    }
}

static void find_normals(const relief *r, bool *ends)
{
    for (uint32_t i = 0; i < 3 * r->facets->triangle_count; i++) {
        double *const normal = r->out->normals + 3 * (size_t)i;
        memcpy(normal, r->normals + 3 * (size_t)(i / 3), 3 * sizeof *normal);
        if (!r->out->curved[i / 3])
            continue;
        ends[i] = !find_normal(r, i, normal);
        for (int c = 0; c < 3 && !ends[i]; c++)
            r->inner[3 * (size_t)r->plane[i / 3] + (size_t)c] += normal[c];
    }
    continue_normals(r, ends);
}

/* ----------------------------------------------------------------------------------- whole -- */

static void measure(const relief *r)
{
    for (size_t i = 0; i < r->facets->triangle_count; i++) {
        double *const normal = r->normals + 3 * i;
        crease_facets_normal(r->facets, i, normal);
        r->out->areas[i] = crease_vector_length(normal) / 2;
        r->out->area += r->out->areas[i];
        crease_vector_normalise(normal);
    }
}

typedef struct part {
    double width, area;
} part;

static int by_width(const void *a, const void *b)
{
    const part *const p = a, *const q = b;
    return p->width < q->width ? -1 : p->width > q->width;
}

static void find_narrow(const relief *r, part *parts)
{
    const size_t count = r->facets->triangle_count;
    for (size_t i = 0; i < count; i++)
        parts[i] = (part){r->widths[r->face[i]], r->out->areas[i]};
    qsort(parts, count, sizeof *parts, by_width);
    double area = 0;
    size_t i = 0;
    while (i + 1 < count && (area += parts[i].area) < NEGLECTED * r->out->area)
        i++;
    r->out->narrow = parts[i].width;
}

static bool allocate(crease_context *context, relief *r)
{
    const size_t count = r->facets->triangle_count;
    crease_shading *const out = r->out;
    return (out->normals = crease_allocate(context, count, 9 * sizeof(double))) &&
        (out->curved = crease_allocate(context, count, sizeof(bool))) &&
        (out->areas = crease_allocate(context, count, sizeof(double))) &&
        (r->opposite = crease_allocate(context, count, 3 * sizeof(uint32_t))) &&
        (r->normals = crease_allocate(context, count, 3 * sizeof(double))) &&
        (r->plane = crease_allocate(context, count, sizeof(uint32_t))) &&
        (r->face = crease_allocate(context, count, sizeof(uint32_t))) &&
        (r->widths = crease_allocate(context, count, sizeof(double))) &&
        (r->lengths = crease_allocate(context, count, sizeof(double))) &&
        (r->beside = crease_allocate(context, count, sizeof(uint32_t))) &&
        (r->passes = crease_allocate(context, count, sizeof(bool))) &&
        (r->inner = crease_allocate(context, count, 3 * sizeof(double)));
}

static void release(relief *r)
{
    free(r->opposite);
    free(r->normals);
    free(r->plane);
    free(r->face);
    free(r->widths);
    free(r->lengths);
    free(r->beside);
    free(r->passes);
    free(r->inner);
}

crease_status crease_shading_find(
    crease_context *context, crease_facets *facets, crease_shading *out)
{
    *out = (crease_shading){0};
    relief r = {.facets = facets, .out = out};
    part *const parts = crease_allocate(context, facets->triangle_count, sizeof *parts);
    bool *const ends = crease_allocate(context, facets->triangle_count, 3 * sizeof *ends);
    crease_status status = parts && ends && allocate(context, &r)
        ? crease_sides_find(context, facets, r.opposite)
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        measure(&r);
        find_groups(&r, FLAT, r.plane);
        find_widths(&r, r.plane);
        find_passes(&r);
        find_curved(&r);
        find_normals(&r, ends);
        find_groups(&r, SMOOTH, r.face);
        find_widths(&r, r.face);
        find_narrow(&r, parts);
    }
    release(&r);
    free(parts);
    free(ends);
    return status;
}

void crease_shading_free(crease_shading *shading)
{
    free(shading->normals);
    free(shading->curved);
    free(shading->areas);
    *shading = (crease_shading){0};
}

/* ----------------------------------------------------------------------------------- places -- */

/* The control point beside corner i on the side to corner j, times 3: moved into the plane at
 * corner i. */
static void control(const double *at, const double *to, const double *normal, double out[3])
{
    const double side[3] = {to[0] - at[0], to[1] - at[1], to[2] - at[2]};
    const double off = crease_vector_dot(side, normal);
    for (int c = 0; c < 3; c++)
        out[c] = 2 * at[c] + to[c] - off * normal[c];
}

void crease_shading_place(const crease_facets *facets, const crease_shading *shading,
    size_t triangle, const double weights[3], double place[3])
{
    const double u = weights[0], v = weights[1], w = weights[2];
    const double *corner[3];
    double sides[3] = {0, 0, 0}; /* the six control points on the sides, together, times 3 */
    for (int i = 0; i < 3; i++)
        corner[i] = crease_facets_corner(facets, triangle, i);
    for (int c = 0; c < 3; c++)
        place[c] = shading->curved[triangle]
            ? u * u * u * corner[0][c] + v * v * v * corner[1][c] + w * w * w * corner[2][c]
            : u * corner[0][c] + v * corner[1][c] + w * corner[2][c];
    for (int i = 0; i < 3 && shading->curved[triangle]; i++)
        for (int step = 1; step < 3; step++) {
            const int j = (i + step) % 3;
            double beside[3];
            control(corner[i], corner[j], shading->normals + 9 * triangle + 3 * (size_t)i, beside);
            for (int c = 0; c < 3; c++) {
                place[c] += weights[i] * weights[i] * weights[j] * beside[c];
                sides[c] += beside[c];
            }
        }
    for (int c = 0; c < 3 && shading->curved[triangle]; c++) {
        const double mean = sides[c] / 18;
        const double middle = (corner[0][c] + corner[1][c] + corner[2][c]) / 3;
        place[c] += 6 * u * v * w * (mean + (mean - middle) / 2);
    }
}
