/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Clouds made face by face: one random point in each cell of a grid of the given spacing, so that
 * their density is even and known, and every point's face is known. */
#ifndef CREASE_TESTS_GIVEN_FACES_H
#define CREASE_TESTS_GIVEN_FACES_H

#include "given.h"

#include "base/random.h"

enum { GIVEN_MOST_POINTS = 200000 };

struct faces {
    size_t count;
    double *points;
    int *face; /* of each point */
    int face_count;
    double spacing;
    double area;
};

static inline struct faces given_faces(double spacing)
{
    return (struct faces){.points = malloc(GIVEN_MOST_POINTS * 3 * sizeof(double)),
        .face = malloc(GIVEN_MOST_POINTS * sizeof(int)),
        .spacing = spacing};
}

static inline void free_faces(struct faces *faces)
{
    free(faces->points);
    free(faces->face);
}

static inline void add_point(struct faces *faces, double x, double y, double z)
{
    assert_true(faces->count < GIVEN_MOST_POINTS);
    double *const p = faces->points + 3 * faces->count;
    p[0] = x;
    p[1] = y;
    p[2] = z;
    faces->face[faces->count++] = faces->face_count;
}

typedef void map_to_surface(const double *shape, double s, double t, double out[3]);

/* A face over the parameters 0..length[0], 0..length[1], in which the map keeps areas. */
static inline void add_face(
    struct faces *faces, map_to_surface *map, const double *shape, double width, double height)
{
    const size_t n = (size_t)fmax(round(width / faces->spacing), 1);
    const size_t m = (size_t)fmax(round(height / faces->spacing), 1);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < m; j++) {
            const uint64_t draw = 2 * (uint64_t)faces->count;
            double p[3];
            const double a = crease_random_uniform(7, 1, draw);
            const double b = crease_random_uniform(7, 1, draw + 1);
            map(shape, ((double)i + a) * width / (double)n, ((double)j + b) * height / (double)m,
                p);
            add_point(faces, p[0], p[1], p[2]);
        }
    faces->area += width * height;
    faces->face_count++;
}

/* shape: corner, two unit directions. */
static inline void map_rectangle(const double *shape, double s, double t, double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = shape[c] + s * shape[3 + c] + t * shape[6 + c];
}

/* shape: radius; along z. */
static inline void map_cylinder(const double *shape, double s, double t, double out[3])
{
    out[0] = shape[0] * cos(s / shape[0]);
    out[1] = shape[0] * sin(s / shape[0]);
    out[2] = t;
}

/* shape: radius, z. Concentric squares: equal areas. */
static inline void map_disc(const double *shape, double s, double t, double out[3])
{
    const double pi = acos(-1.0), scale = 2.0 / sqrt(pi);
    const double a = s * scale - shape[0], b = t * scale - shape[0];
    const bool wide = fabs(a) > fabs(b);
    const double r = wide ? a : b;
    const double angle = r == 0 ? 0 : wide ? pi / 4 * b / a : pi / 2 - pi / 4 * a / b;
    out[0] = r * cos(angle);
    out[1] = r * sin(angle);
    out[2] = shape[1];
}

/* shape: radius. Archimedes: areas of the sphere are those of the cylinder around it. */
static inline void map_sphere(const double *shape, double s, double t, double out[3])
{
    const double z = t - shape[0], r = sqrt(fmax(shape[0] * shape[0] - z * z, 0));
    out[0] = r * cos(s / shape[0]);
    out[1] = r * sin(s / shape[0]);
    out[2] = z;
}

/* shape: radius of the circle, of the tube. s along the outer circle, t around the tube; density
 * varies with the distance from the axis. */
static inline void map_torus(const double *shape, double s, double t, double out[3])
{
    const double r = shape[0] + shape[1] * cos(t / shape[1]);
    out[0] = r * cos(s / shape[0]);
    out[1] = r * sin(s / shape[0]);
    out[2] = shape[1] * sin(t / shape[1]);
}

static inline void add_rectangle(struct faces *faces, const double corner[3], const double u[3],
    const double v[3], double width, double height)
{
    double shape[9];
    memcpy(shape, corner, 3 * sizeof(double));
    memcpy(shape + 3, u, 3 * sizeof(double));
    memcpy(shape + 6, v, 3 * sizeof(double));
    add_face(faces, map_rectangle, shape, width, height);
}

static inline struct faces given_cube(double spacing)
{
    static const double e[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    struct faces faces = given_faces(spacing);
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            double corner[3] = {0};
            corner[axis] = side;
            add_rectangle(&faces, corner, e[(axis + 1) % 3], e[(axis + 2) % 3], 1, 1);
        }
    return faces;
}

static inline void add_cylinder(struct faces *faces, double radius, double height)
{
    const double pi = acos(-1.0), root = sqrt(pi);
    add_face(faces, map_cylinder, &radius, 2 * pi * radius, height);
    add_face(faces, map_disc, (double[]){radius, 0}, root * radius, root * radius);
    add_face(faces, map_disc, (double[]){radius, height}, root * radius, root * radius);
}

/* Normal noise in all directions, sigma in spacings. */
static inline void add_noise(struct faces *faces, double sigma)
{
    for (size_t i = 0; i < 3 * faces->count; i++)
        faces->points[i] += sigma * faces->spacing * crease_random_normal(7, 2, i);
}

/* A plate of spacing 1 in the plane z = slope y, scanned along lines of constant y: each error
 * along z is shared by `alike` points of its line. */
static inline struct faces given_scanned_plate(
    size_t width, size_t height, double slope, double sigma, size_t alike)
{
    struct faces faces = given_faces(1);
    for (size_t j = 0; j < height; j++)
        for (size_t i = 0; i < width; i++) {
            const uint64_t n = (uint64_t)faces.count;
            const double x = (double)i + 0.4 * crease_random_uniform(9, 1, n);
            const double y = (double)j + 0.4 * crease_random_uniform(9, 2, n);
            const double error = crease_random_normal(9, 3, j * width + i / alike);
            add_point(&faces, x, y, slope * y + sigma * error);
        }
    return faces;
}

/* Heights as a depth camera gives them: whole multiples of the step. */
static inline void round_heights(struct faces *faces, double step)
{
    for (size_t i = 0; i < faces->count; i++)
        faces->points[3 * i + 2] = step * round(faces->points[3 * i + 2] / step);
}

static inline crease_cloud *cloud_of(crease_context *context, const struct faces *faces)
{
    const crease_cloud_parts parts = {.count = faces->count, .points = faces->points};
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    return cloud;
}

#endif
