/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "averaging/project.h"

#include "base/parallel.h"

enum { GRAIN = 256, MOST_HALVINGS = 80 };

typedef struct work {
    const crease_surface *surface;
    double domain[2][2], start[2];
    int coordinate[2]; /* of u and of v */
    double *points;
} work;

static double coordinate_at(const work *w, int direction, double t)
{
    double uv[2] = {w->start[0], w->start[1]}, point[3];
    uv[direction] = t;
    crease_surface_point(w->surface, uv, point);
    return point[w->coordinate[direction]];
}

/* The parameter at which a coordinate, which never falls along the direction, takes a value. */
static double parameter_at(const work *w, int direction, double value)
{
    double low = w->domain[direction][0], high = w->domain[direction][1];
    if (value <= coordinate_at(w, direction, low))
        return low;
    if (value >= coordinate_at(w, direction, high))
        return high;
    for (int i = 0; i < MOST_HALVINGS; i++) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high)
            break;
        if (coordinate_at(w, direction, middle) < value)
            low = middle;
        else
            high = middle;
    }
    return high;
}

static void project_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    for (size_t i = begin; i < end; i++) {
        double uv[2], foot[3];
        double *const point = w->points + 3 * i;
        for (int d = 0; d < 2; d++)
            uv[d] = parameter_at(w, d, point[w->coordinate[d]]);
        crease_surface_point(w->surface, uv, foot);
        point[2] = foot[2];
    }
}

crease_status crease_project_heights(crease_context *context, const crease_surface *surface,
    bool transposed, double *points, size_t count)
{
    work w = {.surface = surface, .points = points, .coordinate = {transposed, !transposed}};
    for (int d = 0; d < 2; d++) {
        crease_surface_domain(surface, d, w.domain[d]);
        w.start[d] = w.domain[d][0];
    }
    return crease_parallel_for(context, count, GRAIN, project_some, &w);
}
