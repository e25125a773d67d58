/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "facets/draw.h"

#include "base/memory.h"
#include "base/random.h"
#include "base/vector.h"
#include "facets/shading.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    STREAM_DRAW = 0xd3a0,
    STREAM_ORDER,
    LEAST_VERTICES = 5000,
    LEAST_POINTS = 10000,
    MOST_POINTS = 100000,
    CANDIDATES = 6, /* for each point */
    NEAR = 64       /* candidates around a point; there are eleven in the mean */
};

static const double LARGE = 4;   /* longest side by the vertices' spacing */
static const double SHARE = 0.1; /* of the area in large triangles */
static const double ACROSS = 6;  /* points across the narrowest face */
static const double APART =
    0.72; /* least distance of two points in spacings: leaves as many as wanted */

static double longest_side(const crease_facets *facets, size_t triangle)
{
    double longest = 0;
    for (int c = 0; c < 3; c++)
        longest = fmax(longest,
            crease_vector_distance(crease_facets_corner(facets, triangle, c),
                crease_facets_corner(facets, triangle, (c + 1) % 3)));
    return longest;
}

static double area_of(const crease_facets *facets, size_t triangle)
{
    double normal[3];
    crease_facets_normal(facets, triangle, normal);
    return crease_vector_length(normal) / 2;
}

bool crease_facets_dense(const crease_facets *facets)
{
    double area = 0, large = 0;
    for (size_t i = 0; i < facets->triangle_count; i++)
        area += area_of(facets, i);
    const double spacing = sqrt(area / (double)facets->vertex_count);
    for (size_t i = 0; i < facets->triangle_count; i++)
        if (longest_side(facets, i) > LARGE * spacing)
            large += area_of(facets, i);
    return facets->vertex_count >= LEAST_VERTICES && large <= SHARE * area;
}

/* No fewer than the vertices: who made the mesh knew why. */
static size_t points_for(const crease_facets *facets, const crease_shading *shading)
{
    const double points = ACROSS * ACROSS * shading->area / (shading->narrow * shading->narrow);
    const double least = fmax(LEAST_POINTS, (double)facets->vertex_count);
    return (size_t)fmin(fmax(points, least), MOST_POINTS);
}

/* ----------------------------------------------------------------------------- candidates -- */

/* The triangle in which a share of the whole area ends; sums: of the areas up to each. */
static size_t triangle_at(const double *sums, size_t count, double area)
{
    size_t low = 0, high = count - 1;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (sums[middle] > area)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

static void draw_one(const crease_context *context, const crease_facets *facets,
    const crease_shading *shading, const double *sums, size_t count, size_t i, double place[3])
{
    const uint64_t seed = context->options.seed;
    const double share =
        ((double)i + crease_random_uniform(seed, STREAM_DRAW, 3 * i)) / (double)count;
    const double root = sqrt(crease_random_uniform(seed, STREAM_DRAW, 3 * i + 1));
    const double second = crease_random_uniform(seed, STREAM_DRAW, 3 * i + 2);
    const double weights[3] = {1 - root, root * (1 - second), root * second};
    crease_shading_place(facets, shading,
        triangle_at(sums, facets->triangle_count, share * shading->area), weights, place);
}

/* Evenly in area, in a random order. */
static crease_status draw_candidates(crease_context *context, const crease_facets *facets,
    const crease_shading *shading, size_t count, double *places)
{
    double *const sums = crease_allocate(context, facets->triangle_count, sizeof *sums);
    uint32_t *const order = crease_allocate(context, count, sizeof *order);
    if (sums && order) {
        double sum = 0;
        for (size_t i = 0; i < facets->triangle_count; i++)
            sums[i] = sum += shading->areas[i];
        for (size_t i = 0; i < count; i++) {
            const size_t j =
                crease_random_below(context->options.seed, STREAM_ORDER, i, (uint32_t)(i + 1));
            order[i] = order[j];
            order[j] = (uint32_t)i;
        }
        for (size_t i = 0; i < count; i++)
            draw_one(context, facets, shading, sums, count, i, places + 3 * (size_t)order[i]);
    }
    const bool room = sums && order;
    free(sums);
    free(order);
    return room ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

/* ------------------------------------------------------------------------------- thinning -- */

/* Keeps each place in turn unless one that was kept is nearer than the distance. (Cook. Stochastic
 * sampling in computer graphics. 1986: Poisson discs.) */
static crease_status thin(crease_context *context, double *places, size_t *count, double distance)
{
    crease_tree *tree = NULL;
    bool *const near = crease_allocate(context, *count, sizeof *near);
    crease_status status =
        near ? crease_tree_create(context, places, *count, &tree) : CREASE_ERROR_NO_MEMORY;
    size_t kept = 0;
    for (size_t i = 0; i < *count && status == CREASE_OK; i++) {
        uint32_t around[NEAR];
        size_t found = 0;
        if (near[i])
            continue;
        status = crease_tree_within(tree, places + 3 * i, distance, NEAR, around, &found);
        for (size_t j = 0; j < found && j < NEAR; j++)
            near[around[j]] = true;
        memmove(places + 3 * kept++, places + 3 * i, 3 * sizeof *places);
    }
    *count = kept;
    crease_tree_free(tree);
    free(near);
    return status;
}

static crease_status draw(crease_context *context, const crease_facets *facets,
    const crease_shading *shading, size_t wanted, crease_cloud **out)
{
    size_t count = CANDIDATES * wanted;
    double *const places = crease_allocate(context, count, 3 * sizeof *places);
    crease_status status =
        places ? draw_candidates(context, facets, shading, count, places) : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = thin(context, places, &count, APART * sqrt(shading->area / (double)wanted));
    const crease_cloud_parts parts = {
        .count = count, .points = places, .coordinate_type = CREASE_TYPE_FLOAT64};
    if (status == CREASE_OK)
        status = crease_cloud_create(context, &parts, out);
    free(places);
    return status;
}

crease_status crease_facets_draw(
    crease_context *context, crease_facets *facets, int wanted, crease_cloud **out)
{
    crease_shading shading = {0};
    *out = NULL;
    crease_status status = crease_facets_weld(context, facets);
    if (status == CREASE_OK)
        status = crease_shading_find(context, facets, &shading);
    if (status == CREASE_OK && !(shading.area > 0 && isfinite(shading.area)))
        status = crease_fail(context, CREASE_ERROR_VALUE,
            "%s: its triangles have no area, or one that is not finite; read its vertices alone "
            "with "
            "--mesh-points 0",
            facets->name);
    if (status == CREASE_OK)
        status = draw(context, facets, &shading,
            wanted < 0 ? points_for(facets, &shading) : (size_t)wanted, out);
    crease_shading_free(&shading);
    return status;
}
