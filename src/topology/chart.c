/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/chart.h"

#include "base/vector.h"
#include "primitive/base.h"

#include <math.h>

static const double TURN = 6.283185307179586476925;

bool crease_chart_turns(const crease_chart *chart, int direction)
{
    const crease_region_type type = chart->type;
    if (direction == 1)
        return type == CREASE_REGION_TORUS;
    return type == CREASE_REGION_FREEFORM ? chart->round : type != CREASE_REGION_PLANE;
}

double crease_chart_near(double angle, double other)
{
    return angle + TURN * round((other - angle) / TURN);
}

void crease_chart_at(const crease_chart *chart, const double place[3], double uv[2])
{
    double d[3];
    for (int c = 0; c < 3; c++)
        d[c] = place[c] - chart->centre[c];
    const double x = crease_vector_dot(d, chart->axes), y = crease_vector_dot(d, chart->axes + 3);
    const double z = crease_vector_dot(d, chart->axes + 6);
    const double away = hypot(x, y), angle = atan2(y, x), half = atan(chart->shape);
    uv[0] = angle < 0.0 ? angle + TURN : angle;
    switch (chart->type) {
    case CREASE_REGION_SPHERE:
        uv[1] = atan2(z, away);
        break;
    case CREASE_REGION_CYLINDER:
        uv[1] = z;
        break;
    case CREASE_REGION_CONE:
        uv[1] = (away - chart->radius) * sin(half) + z * cos(half);
        break;
    case CREASE_REGION_TORUS:
        uv[1] = crease_chart_near(atan2(z, away - chart->radius), chart->middle);
        break;
    default:
        if (chart->ball) {
            crease_ball_project((double[]){x, y, z}, uv);
            break;
        }
        uv[0] = chart->round ? uv[0] : x;
        uv[1] = chart->round ? z : y;
    }
}

void crease_chart_ball_direction(const double uv[2], double out[3])
{
    crease_ball_direction(uv, out);
}

void crease_chart_ball_at(const double vector[3], double uv[2])
{
    crease_ball_project(vector, uv);
}

void crease_chart_along(const crease_chart *chart, const double *places, size_t count, double *uv)
{
    for (size_t i = 0; i < count; i++) {
        crease_chart_at(chart, places + 3 * i, uv + 2 * i);
        for (int d = 0; d < 2 && i > 0; d++)
            if (crease_chart_turns(chart, d))
                uv[2 * i + (size_t)d] =
                    crease_chart_near(uv[2 * i + (size_t)d], uv[2 * i - 2 + (size_t)d]);
    }
}

void crease_chart_begin_at(crease_chart *chart, const double place[3])
{
    double *const x = chart->axes, *const y = x + 3, *const z = x + 6;
    double d[3];
    for (int c = 0; c < 3; c++)
        d[c] = place[c] - chart->centre[c];
    const double along = crease_vector_dot(d, z);
    for (int c = 0; c < 3; c++)
        d[c] -= along * z[c];
    if (!(crease_vector_length(d) > 1e-12 * chart->radius))
        return;
    crease_vector_normalise(d);
    for (int c = 0; c < 3; c++)
        x[c] = d[c];
    crease_vector_cross(z, x, y);
}
