/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Surfaces of known shape: planes, boxes, tubes, and a roof as the averaging method leaves it. */
#ifndef CREASE_TESTS_GIVEN_SURFACES_H
#define CREASE_TESTS_GIVEN_SURFACES_H

#include "given.h"

enum { MOST = 16 };

typedef struct model {
    crease_context *context;
    crease_surface *surfaces[MOST];
    size_t count;
} model;

static inline model given_model(void)
{
    return (model){.context = given_context()};
}

static inline void free_model(model *m)
{
    for (size_t i = 0; i < m->count; i++)
        crease_surface_free(m->surfaces[i]);
    crease_context_free(m->context);
}

static inline void add_surface(model *m, const crease_surface_parts *parts)
{
    assert_true(m->count < MOST);
    assert_int_equal(crease_surface_create(m->context, parts, &m->surfaces[m->count++]), CREASE_OK);
}

static inline void clamped_knots(int order, size_t count, double *knots)
{
    const size_t inner = count - (size_t)order;
    for (size_t i = 0; i < count + (size_t)order; i++) {
        const double t = ((double)i - order + 1) / ((double)inner + 1);
        knots[i] = fmin(fmax(t, 0.0), 1.0);
    }
}

static inline double greville(const double *knots, int order, size_t i)
{
    double sum = 0;
    for (int k = 1; k < order; k++)
        sum += knots[i + (size_t)k];
    return sum / (order - 1);
}

/* A place in space for a place in the unit square. */
typedef void shape_of(double u, double v, double out[3]);

/* A bicubic surface over given knots whose control points are the shape at the Greville places:
 * the shape itself where that is bilinear. */
static inline void add_over_knots(model *m, const double *u, size_t rows, const double *v,
    size_t columns, const double frame[12], shape_of *shape)
{
    double points[3 * 256];
    assert_true(rows * columns <= 256);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) {
            double at[3], *out = points + 3 * (i * columns + j);
            shape(greville(u, 4, i), greville(v, 4, j), at);
            for (int c = 0; c < 3; c++)
                out[c] =
                    frame[9 + c] + frame[c] * at[0] + frame[3 + c] * at[1] + frame[6 + c] * at[2];
        }
    add_surface(m, &(crease_surface_parts){{4, 4}, {rows, columns}, {u, v}, points});
}

static inline void flat(double u, double v, double out[3])
{
    out[0] = u;
    out[1] = v;
    out[2] = 0;
}

static inline void bump(double u, double v, double out[3])
{
    flat(u, v, out);
    out[2] = 0.3 * sin(3 * u) * cos(2 * v);
}

/* frame: images of x, y, z, then the origin. */
static inline void add_shaped(
    model *m, size_t rows, size_t columns, const double frame[12], shape_of *shape)
{
    double u[32], v[32];
    clamped_knots(4, rows, u);
    clamped_knots(4, columns, v);
    add_over_knots(m, u, rows, v, columns, frame, shape);
}

static const double IDENTITY[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

/* Two planes at a right angle that meet along y; the second one runs as `turned` says: bit 0
 * reverses the common border, bit 1 puts the border on the other side. */
static inline void add_wedge(model *m, double size, const double origin[3], int turned)
{
    const double s = size, *o = origin;
    add_shaped(m, 5, 4, (double[]){s, 0, 0, 0, s, 0, 0, 0, s, o[0], o[1], o[2]}, flat);
    const double y = turned & 1 ? -s : s, y0 = turned & 1 ? s : 0;
    const double z = turned & 2 ? -s : s, z0 = turned & 2 ? s : 0;
    add_shaped(m, 6, 4, (double[]){0, 0, z, 0, y, 0, 1, 0, 0, o[0], o[1] + y0, o[2] + z0}, flat);
}

static inline void add_box(model *m, double size, const double origin[3])
{
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            double frame[12] = {0};
            frame[(axis + 1) % 3] = size;
            frame[3 + (axis + 2) % 3] = size;
            frame[6 + axis] = size;
            for (int c = 0; c < 3; c++)
                frame[9 + c] = origin[c] + (c == axis && side ? size : 0);
            add_shaped(m, 4 + (size_t)axis % 2, 4 + (size_t)axis % 2, frame, flat);
        }
}

/* A roof whose ridge row stands three times over uniform knots that are not clamped: the averaging
 * method's result. Its rows lie at x = i, z = -|x - ridge|. */
static inline void add_repeated_rows(model *m, int direction, double scale)
{
    double knots[2][16], points[9 * 6 * 3];
    for (int i = 0; i < 16; i++)
        knots[0][i] = knots[1][i] = 10 + 0.5 * i;
    for (size_t i = 0; i < 9; i++)
        for (size_t j = 0; j < 6; j++) {
            double *p = points + 3 * (direction == 0 ? i * 6 + j : j * 9 + i);
            const double row = i < 3 ? (double)i : (i < 6 ? 3.0 : (double)i - 2);
            p[0] = scale * row;
            p[1] = scale * (double)j;
            p[2] = -scale * fabs(row - 3.0);
        }
    const size_t rows = direction == 0 ? 9 : 6, columns = direction == 0 ? 6 : 9;
    add_surface(m, &(crease_surface_parts){{4, 4}, {rows, columns}, {knots[0], knots[1]}, points});
}

/* A tube around the z axis, closed in u; its radius falls to zero at the ends that `tip` names. */
static inline void add_tube(model *m, int tips)
{
    enum { ROUND = 8 };
    double u[16], v[8], points[12 * 4 * 3];
    clamped_knots(4, 12, u);
    clamped_knots(4, 4, v);
    for (size_t i = 0; i < 12; i++)
        for (size_t j = 0; j < 4; j++) {
            const double angle = 2 * acos(-1.0) * greville(u, 4, i % 11);
            const bool tip = (j == 0 && tips & 1) || (j == 3 && tips & 2);
            const double radius = tip ? 0.0 : 1.0;
            memcpy(points + 3 * (i * 4 + j),
                (double[]){radius * cos(angle), radius * sin(angle), (double)j / 3},
                3 * sizeof(double));
        }
    add_surface(m, &(crease_surface_parts){{4, 4}, {12, 4}, {u, v}, points});
}

#endif
