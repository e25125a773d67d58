/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A bracket and a scanner that goes around it. The bracket is two blocks less three drilled holes;
 * a ray meets it where the first stretch inside begins. */
#include "cloud/shape.h"

#include "base/frame.h"
#include "base/memory.h"
#include "base/random.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Lengths in millimetres. */
typedef struct block {
    double low[3], high[3];
} block;

typedef struct hole {
    int axis; /* along which it goes through everything */
    double centre[3], radius;
} hole;

enum { BLOCKS = 2, HOLES = 3, VIEWS = 8, MOST_CROSSINGS = 2 * (BLOCKS + HOLES), STREAM = 0x42 };

static const block blocks[BLOCKS] = {
    {{0, 0, 0}, {80, 50, 10}},
    {{0, 40, 0}, {80, 50, 55}},
};
static const hole holes[HOLES] = {
    {2, {18, 20, 0}, 6},
    {2, {62, 20, 0}, 6},
    {1, {40, 0, 32}, 14},
};
static const double middle[3] = {40, 25, 27.5};
static const double reach = 55;   /* of every corner from the middle */
static const double area = 18650; /* of the surface: what the spacing is told from */

/* From where the scanner looks: around the part, from above and from below. */
static const double views[VIEWS][3] = {{1, -1, 0.7}, {-1, -1, 0.7}, {1, 1, 0.7}, {-1, 1, 0.7},
    {0.8, -1, -0.9}, {-0.8, 1, -0.9}, {0.1, -0.4, 1}, {-0.1, -1, 0.15}};

static bool is_inside(const double place[3])
{
    bool inside = false;
    for (int b = 0; b < BLOCKS; b++) {
        bool here = true;
        for (int c = 0; c < 3; c++)
            here = here && place[c] > blocks[b].low[c] && place[c] < blocks[b].high[c];
        inside = inside || here;
    }
    for (int h = 0; h < HOLES; h++) {
        const int u = (holes[h].axis + 1) % 3, v = (holes[h].axis + 2) % 3;
        inside = inside &&
            hypot(place[u] - holes[h].centre[u], place[v] - holes[h].centre[v]) > holes[h].radius;
    }
    return inside;
}

/* --------------------------------------------------------------------------------- one ray -- */

typedef struct ray {
    double from[3], along[3]; /* unit vector */
} ray;

/* Where the ray enters and leaves the block; false when it misses. */
static bool cross_block(const block *of, const ray *r, double crossings[2])
{
    double enter = -INFINITY, leave = INFINITY;
    for (int c = 0; c < 3; c++) {
        const double a = (of->low[c] - r->from[c]) / r->along[c];
        const double b = (of->high[c] - r->from[c]) / r->along[c];
        enter = fmax(enter, fmin(a, b));
        leave = fmin(leave, fmax(a, b));
    }
    crossings[0] = enter, crossings[1] = leave;
    return enter < leave;
}

static bool cross_hole(const hole *of, const ray *r, double crossings[2])
{
    const int u = (of->axis + 1) % 3, v = (of->axis + 2) % 3;
    const double x = r->from[u] - of->centre[u], y = r->from[v] - of->centre[v];
    const double a = r->along[u] * r->along[u] + r->along[v] * r->along[v];
    const double b = x * r->along[u] + y * r->along[v];
    const double square = b * b - a * (x * x + y * y - of->radius * of->radius);
    if (!(square > 0.0) || !(a > 0.0))
        return false;
    crossings[0] = (-b - sqrt(square)) / a, crossings[1] = (-b + sqrt(square)) / a;
    return true;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool first_hit(const ray *r, double point[3])
{
    double at[MOST_CROSSINGS];
    size_t count = 0;
    for (int b = 0; b < BLOCKS; b++)
        count += cross_block(&blocks[b], r, at + count) ? 2 : 0;
    for (int h = 0; h < HOLES; h++)
        count += cross_hole(&holes[h], r, at + count) ? 2 : 0;
    qsort(at, count, sizeof *at, ascending);
    for (size_t i = 0; i + 1 < count; i++) {
        double inside[3];
        for (int c = 0; c < 3; c++)
            inside[c] = r->from[c] + 0.5 * (at[i] + at[i + 1]) * r->along[c];
        if (at[i + 1] - at[i] > 1e-9 && is_inside(inside)) {
            for (int c = 0; c < 3; c++)
                point[c] = r->from[c] + at[i] * r->along[c];
            return true;
        }
    }
    return false;
}

/* A ray of a view, through a place of the square that it looks at. */
static ray ray_of(const double view[3], double right, double up)
{
    ray r;
    double across[3] = {-view[1], view[0], 0.0}, over[3];
    memcpy(r.along, view, sizeof r.along);
    crease_vector_normalise(r.along);
    crease_vector_normalise(across);
    crease_vector_cross(r.along, across, over);
    for (int c = 0; c < 3; c++) {
        r.from[c] = middle[c] + reach * (3.0 * r.along[c] + right * across[c] + up * over[c]);
        r.along[c] = -r.along[c];
    }
    return r;
}

/* --------------------------------------------------------------------------------- the scan -- */

/* Turned by 40 degrees about z and by 25 about x: no face lies along an axis. */
static const crease_frame scanner = {
    .rotation = {0.76604444311897801345, 0.58256341606958539359, 0.27165378227418446322,
        -0.64278760968653936292, 0.69427204401488384899, 0.32374437096706459860, 0.0,
        -0.42261826174069944129, 0.90630778703664993667}};

bool crease_shape_bracket_holds(const double place[3])
{
    double own[3];
    crease_frame_enter(&scanner, place, 1, own);
    return is_inside(own);
}

static void scan(uint64_t seed, const crease_bracket_options *options, double *points)
{
    const double sigma = options->noise * sqrt(area / (double)options->count);
    size_t found = 0;
    for (uint64_t shot = 0; found < options->count; shot++) {
        const uint64_t draw = 8 * shot;
        double *const p = points + 3 * found;
        const double right = 2.0 * crease_random_uniform(seed, STREAM, draw) - 1.0;
        const double up = 2.0 * crease_random_uniform(seed, STREAM, draw + 1) - 1.0;
        const ray r = ray_of(views[shot % VIEWS], right, up);
        if (!first_hit(&r, p))
            continue;
        double off = sigma * crease_random_normal(seed, STREAM + 1, shot);
        if (crease_random_uniform(seed, STREAM, draw + 2) < options->outliers)
            off = (crease_random_uniform(seed, STREAM, draw + 3) - 0.5) * reach;
        for (int c = 0; c < 3; c++)
            p[c] += off * r.along[c];
        crease_frame_leave(&scanner, p, 1, p);
        found++;
    }
}

crease_bracket_options crease_bracket_options_default(void)
{
    return (crease_bracket_options){.count = 30000, .noise = 0.2, .outliers = 0.005};
}

crease_status crease_shape_bracket(
    crease_context *context, const crease_bracket_options *options, crease_cloud **out)
{
    *out = NULL;
    const crease_bracket_options chosen = options ? *options : crease_bracket_options_default();
    if (chosen.count < 4 || chosen.count > UINT32_MAX || !(chosen.noise >= 0.0) ||
        !isfinite(chosen.noise) || !(chosen.outliers >= 0.0 && chosen.outliers <= 1.0))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "bracket: %zu points, noise %g, outliers %g; give at least 4 points, a noise that is "
            "not negative, and a share of outliers from 0 to 1",
            chosen.count, chosen.noise, chosen.outliers);
    double *const points = crease_allocate(context, chosen.count, 3 * sizeof *points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    scan(crease_context_seed(context), &chosen, points);
    const crease_cloud_parts parts = {
        .count = chosen.count, .points = points, .coordinate_type = CREASE_TYPE_FLOAT64};
    const crease_status status = crease_cloud_create(context, &parts, out);
    free(points);
    return status;
}
