/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/raster.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

static const double SAMPLES_MOST = 6e7;

static int columns_of(const crease_raster *raster)
{
    return raster->width * raster->samples;
}

static int rows_of(const crease_raster *raster)
{
    return raster->height * raster->samples;
}

crease_status crease_raster_create(crease_context *context, double left, double top, double width,
    double height, double density, int samples, crease_raster **out)
{
    *out = NULL;
    crease_raster *raster = crease_allocate(context, 1, sizeof *raster);
    if (!raster)
        return CREASE_ERROR_NO_MEMORY;
    *raster = (crease_raster){.left = left,
        .top = top,
        .width = (int)fmax(1, ceil(width * density)),
        .height = (int)fmax(1, ceil(height * density)),
        .density = density,
        .samples = samples};
    while (raster->samples > 1 && (double)columns_of(raster) * rows_of(raster) > SAMPLES_MOST)
        raster->samples--;
    const size_t count = (size_t)columns_of(raster) * (size_t)rows_of(raster);
    raster->depths = crease_allocate(context, count, sizeof *raster->depths);
    raster->colours = crease_allocate(context, count, sizeof *raster->colours);
    raster->dots = crease_allocate(context, count, sizeof *raster->dots);
    if (!raster->depths || !raster->colours || !raster->dots) {
        crease_raster_free(raster);
        return CREASE_ERROR_NO_MEMORY;
    }
    for (size_t i = 0; i < count; i++)
        raster->depths[i] = INFINITY;
    *out = raster;
    return CREASE_OK;
}

void crease_raster_free(crease_raster *raster)
{
    if (!raster)
        return;
    free(raster->depths);
    free(raster->colours);
    free(raster->dots);
    free(raster);
}

static uint32_t opaque(double red, double green, double blue)
{
    const uint32_t r = (uint32_t)lround(255 * fmin(1, fmax(0, red)));
    const uint32_t g = (uint32_t)lround(255 * fmin(1, fmax(0, green)));
    const uint32_t b = (uint32_t)lround(255 * fmin(1, fmax(0, blue)));
    return 0xFF000000U | r << 16 | g << 8 | b;
}

/* A vertex on the grid of samples: sample (i, j) is the square from (i, j) to (i + 1, j + 1). */
typedef struct vertex {
    double x, y, depth;
    const double *normal;
} vertex;

typedef struct brush {
    crease_raster *raster;
    const crease_camera *camera;
    double light[3];
    crease_colour colour;
} brush;

static double to_samples(const crease_raster *raster)
{
    return raster->density * raster->samples;
}

/* How bright a place with this normal is: soft light from one side, so that no part is black. */
static double brightness(const brush *b, const double normal[3])
{
    const double length = crease_vector_length(normal);
    if (!(length > 0))
        return 0.8;
    const double side = crease_vector_dot(normal, b->camera->eye) < 0 ? -1 : 1;
    const double lit = side * crease_vector_dot(normal, b->light) / length;
    return 0.52 + 0.30 * (lit + 1) / 2 + 0.26 * fmax(0, lit);
}

static uint32_t shade(const brush *b, const double normal[3])
{
    const double bright = brightness(b, normal);
    return opaque(b->colour.red * bright, b->colour.green * bright, b->colour.blue * bright);
}

static void fill_sample(const brush *b, const vertex v[3], const double w[3], size_t at)
{
    const float depth = (float)(w[0] * v[0].depth + w[1] * v[1].depth + w[2] * v[2].depth);
    if (depth >= b->raster->depths[at])
        return;
    double normal[3];
    for (int c = 0; c < 3; c++)
        normal[c] = w[0] * v[0].normal[c] + w[1] * v[1].normal[c] + w[2] * v[2].normal[c];
    b->raster->depths[at] = depth;
    b->raster->colours[at] = shade(b, normal);
    b->raster->dots[at] = false;
}

static double lowest_of(double a, double b, double c)
{
    return fmin(a, fmin(b, c));
}

static double highest_of(double a, double b, double c)
{
    return fmax(a, fmax(b, c));
}

static int clamp(double value, int most)
{
    return (int)fmin(most, fmax(0, value));
}

/* Every sample whose middle lies in the triangle, by barycentric coordinates. */
static void fill_triangle(const brush *b, const vertex v[3])
{
    const double area =
        (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (v[1].y - v[0].y);
    if (!(fabs(area) > 1e-12))
        return;
    const int columns = columns_of(b->raster), rows = rows_of(b->raster);
    const int left = clamp(floor(lowest_of(v[0].x, v[1].x, v[2].x)), columns);
    const int right = clamp(ceil(highest_of(v[0].x, v[1].x, v[2].x)), columns);
    const int top = clamp(floor(lowest_of(v[0].y, v[1].y, v[2].y)), rows);
    const int bottom = clamp(ceil(highest_of(v[0].y, v[1].y, v[2].y)), rows);
    for (int j = top; j < bottom; j++)
        for (int i = left; i < right; i++) {
            const double x = i + 0.5, y = j + 0.5;
            double w[3];
            w[1] = ((x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (y - v[0].y)) / area;
            w[2] = ((v[1].x - v[0].x) * (y - v[0].y) - (x - v[0].x) * (v[1].y - v[0].y)) / area;
            w[0] = 1 - w[1] - w[2];
            if (w[0] >= -1e-9 && w[1] >= -1e-9 && w[2] >= -1e-9)
                fill_sample(b, v, w, (size_t)j * (size_t)columns + (size_t)i);
        }
}

void crease_raster_draw_mesh(crease_raster *raster, const crease_mesh *mesh,
    const crease_camera *camera, crease_colour colour)
{
    brush b = {.raster = raster, .camera = camera, .colour = colour};
    for (int c = 0; c < 3; c++)
        b.light[c] = 0.62 * camera->eye[c] - 0.55 * camera->right[c] + 0.56 * camera->up[c];
    const double *points = crease_mesh_vertices(mesh), *normals = crease_mesh_normals(mesh);
    const uint32_t *triangles = crease_mesh_triangles(mesh);
    const double grid = to_samples(raster);
    for (size_t t = 0; t < crease_mesh_triangle_count(mesh); t++) {
        vertex v[3];
        for (int k = 0; k < 3; k++) {
            const size_t at = 3 * (size_t)triangles[3 * t + (size_t)k];
            const crease_spot spot = crease_camera_project(camera, &points[at]);
            v[k] = (vertex){(spot.x - raster->left) * grid, (spot.y - raster->top) * grid,
                spot.depth, &normals[at]};
        }
        fill_triangle(&b, v);
    }
}

/* The samples x0..x1-1, y0..y1-1 that a square around a place covers. */
typedef struct window {
    int x0, x1, y0, y1;
} window;

static window window_around(const crease_raster *raster, double x, double y, double radius)
{
    return (window){clamp(floor(x - radius), columns_of(raster)),
        clamp(ceil(x + radius), columns_of(raster)), clamp(floor(y - radius), rows_of(raster)),
        clamp(ceil(y + radius), rows_of(raster))};
}

void crease_raster_draw_dot(
    crease_raster *raster, crease_spot middle, double radius, crease_colour colour)
{
    const double grid = to_samples(raster);
    const double x = (middle.x - raster->left) * grid, y = (middle.y - raster->top) * grid;
    const double r = fmax(0.75, radius * grid);
    const window w = window_around(raster, x, y, r);
    const uint32_t paint = opaque(colour.red, colour.green, colour.blue);
    const float front = (float)(middle.depth - radius);
    for (int j = w.y0; j < w.y1; j++)
        for (int i = w.x0; i < w.x1; i++) {
            const size_t at = (size_t)j * (size_t)columns_of(raster) + (size_t)i;
            const double dx = i + 0.5 - x, dy = j + 0.5 - y;
            if (dx * dx + dy * dy > r * r || front >= raster->depths[at])
                continue;
            raster->depths[at] = front;
            raster->colours[at] = paint;
            raster->dots[at] = true;
        }
}

/* How far a sample lies behind those around it, in the mean, in units of the drawing. */
static double depth_behind(const crease_raster *raster, int x, int y)
{
    const int reach = raster->samples, columns = columns_of(raster), rows = rows_of(raster);
    const float own = raster->depths[(size_t)y * (size_t)columns + (size_t)x];
    double sum = 0;
    for (int j = -reach; j <= reach; j += reach)
        for (int i = -reach; i <= reach; i += reach) {
            if (x + i < 0 || x + i >= columns || y + j < 0 || y + j >= rows)
                continue;
            const float other = raster->depths[(size_t)(y + j) * (size_t)columns + (size_t)(x + i)];
            sum += fmax(0, (double)(own - other));
        }
    return sum / 8;
}

static uint32_t darken(uint32_t colour, double factor)
{
    uint32_t out = colour & 0xFF000000U;
    for (int c = 0; c < 24; c += 8)
        out |= (uint32_t)lround(factor * (colour >> c & 0xFF)) << c;
    return out;
}

void crease_raster_shade_dots(crease_raster *raster, double darkest)
{
    const double strength = 0.8 * (1 - darkest) * raster->density;
    for (int y = 0; y < rows_of(raster); y++)
        for (int x = 0; x < columns_of(raster); x++) {
            const size_t at = (size_t)y * (size_t)columns_of(raster) + (size_t)x;
            if (raster->dots[at])
                raster->colours[at] = darken(raster->colours[at],
                    fmax(darkest, exp(-strength * depth_behind(raster, x, y))));
        }
}

bool crease_raster_sees(const crease_raster *raster, crease_spot spot, double slack)
{
    const double grid = to_samples(raster);
    const double x = (spot.x - raster->left) * grid, y = (spot.y - raster->top) * grid;
    const window w = window_around(raster, x, y, 1);
    double farthest = -INFINITY;
    for (int j = w.y0; j < w.y1; j++)
        for (int i = w.x0; i < w.x1; i++)
            farthest = fmax(farthest,
                (double)raster->depths[(size_t)j * (size_t)columns_of(raster) + (size_t)i]);
    return w.x0 >= w.x1 || w.y0 >= w.y1 || spot.depth - slack <= farthest;
}

/* The mean of a pixel's samples, with alpha already multiplied in, as cairo wants it. */
static uint32_t pixel(const crease_raster *raster, int x, int y)
{
    const int n = raster->samples;
    uint32_t sums[4] = {0};
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const uint32_t colour =
                raster->colours[(size_t)(y * n + j) * (size_t)columns_of(raster) +
                    (size_t)(x * n + i)];
            for (int c = 0; c < 4; c++)
                sums[c] += colour >> 8 * c & 0xFF;
        }
    const uint32_t count = (uint32_t)(n * n);
    uint32_t mean = 0;
    for (int c = 0; c < 4; c++)
        mean |= (sums[c] + count / 2) / count << 8 * c;
    return mean;
}

crease_status crease_raster_paint(
    crease_context *context, const crease_raster *raster, cairo_t *cairo)
{
    cairo_surface_t *image =
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, raster->width, raster->height);
    if (cairo_surface_status(image) != CAIRO_STATUS_SUCCESS) {
        cairo_surface_destroy(image);
        return crease_fail(context, CREASE_ERROR_NO_MEMORY,
            "figure: memory ran out for a picture of %d x %d pixels; make it smaller",
            raster->width, raster->height);
    }
    unsigned char *bytes = cairo_image_surface_get_data(image);
    const int stride = cairo_image_surface_get_stride(image);
    for (int y = 0; y < raster->height; y++) {
        uint32_t *row = (uint32_t *)(void *)(bytes + (ptrdiff_t)y * stride);
        for (int x = 0; x < raster->width; x++)
            row[x] = pixel(raster, x, y);
    }
    cairo_surface_mark_dirty(image);
    cairo_save(cairo);
    cairo_translate(cairo, raster->left, raster->top);
    cairo_scale(cairo, 1 / raster->density, 1 / raster->density);
    cairo_set_source_surface(cairo, image, 0, 0);
    cairo_paint(cairo);
    cairo_restore(cairo);
    cairo_surface_destroy(image);
    return CREASE_OK;
}
