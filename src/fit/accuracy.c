/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/accuracy.h"

#include "base/vector.h"

#include <math.h>

enum { SECTIONS = 16, PLACES = 256 };

static const double COSINE_OF_TEN = 0.98480775301220806;

static void from_edge(const crease_roof *roof, const double point[3], double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = point[c] - roof->edge[c];
    const double along = crease_vector_dot(out, roof->direction);
    for (int c = 0; c < 3; c++)
        out[c] -= along * roof->direction[c];
}

static double distance_to_edge(const crease_roof *roof, const double point[3])
{
    double d[3];
    from_edge(roof, point, d);
    return crease_vector_length(d);
}

/* Distance to the nearer face, which ends at the edge and where the points end. */
static double distance_to_faces(const crease_roof *roof, const double point[3])
{
    double d[3], least = INFINITY;
    from_edge(roof, point, d);
    for (int k = 0; k < 2; k++) {
        const double across = crease_vector_dot(d, roof->inward[k]);
        const double held = fmin(fmax(across, 0.0), roof->across[k]);
        double rest[3];
        for (int c = 0; c < 3; c++)
            rest[c] = d[c] - held * roof->inward[k][c];
        least = fmin(least, crease_vector_length(rest));
    }
    return least;
}

static bool off_both(const crease_roof *roof, const double normal[3])
{
    for (int k = 0; k < 2; k++) {
        double face[3];
        crease_vector_cross(roof->direction, roof->inward[k], face);
        if (fabs(crease_vector_dot(face, normal)) > COSINE_OF_TEN)
            return false;
    }
    return true;
}

static void measure_line(
    const crease_surface *surface, crease_line line, const crease_roof *roof, crease_accuracy *out)
{
    double domain[2], sum = 0.0;
    crease_surface_domain(surface, 1 - line.direction, domain);
    for (int i = 0; i < SECTIONS; i++) {
        double uv[2], point[3];
        uv[line.direction] = line.parameter;
        uv[1 - line.direction] = domain[0] + (domain[1] - domain[0]) * (i + 0.5) / SECTIONS;
        crease_surface_point(surface, uv, point);
        sum += pow(distance_to_edge(roof, point), 2.0);
    }
    const double position = sqrt(sum / SECTIONS);
    if (out->position <= position)
        return;
    out->position = position;
    out->angle = line.angle;
}

/* The direction of the surface that runs across the edge. */
static int across_direction(
    const crease_surface *surface, const crease_roof *roof, double domain[2][2])
{
    double lengthwise[2];
    for (int d = 0; d < 2; d++) {
        double ends[2][3],
            uv[2] = {0.5 * (domain[0][0] + domain[0][1]), 0.5 * (domain[1][0] + domain[1][1])};
        for (int e = 0; e < 2; e++) {
            uv[d] = domain[d][e];
            crease_surface_point(surface, uv, ends[e]);
        }
        for (int c = 0; c < 3; c++)
            ends[1][c] -= ends[0][c];
        lengthwise[d] =
            fabs(crease_vector_dot(ends[1], roof->direction)) / crease_vector_length(ends[1]);
    }
    return lengthwise[0] <= lengthwise[1] ? 0 : 1;
}

/* The places of one section across the edge. */
typedef struct section {
    double length[PLACES]; /* of the sheet across the edge */
    bool off[PLACES];      /* the normal is that of neither face */
    int nearest;           /* number of the place nearest to the edge */
    double area, square, max;
} section;

static void measure_place(const crease_surface *surface, const crease_roof *roof,
    const double uv[2], int across, section *s, int i, double *closest)
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    double d[2][2][3], normal[3], both[3];
    crease_surface_evaluate(surface, uv, sides, 1, d[0][0]);
    crease_surface_normal(surface, uv, sides, normal);
    crease_vector_cross(d[1][0], d[0][1], both);
    const double off = distance_to_faces(roof, d[0][0]), piece = crease_vector_length(both);
    const double to_edge = distance_to_edge(roof, d[0][0]);
    s->area += piece;
    s->square += piece * off * off;
    s->max = fmax(s->max, off);
    s->off[i] = off_both(roof, normal);
    s->length[i] = crease_vector_length(across ? d[0][1] : d[1][0]);
    if (to_edge < *closest) {
        *closest = to_edge;
        s->nearest = i;
    }
}

static double off_length(const section *s)
{
    if (!s->off[s->nearest])
        return 0.0;
    double sum = s->length[s->nearest];
    for (int i = s->nearest - 1; i >= 0 && s->off[i]; i--)
        sum += s->length[i];
    for (int i = s->nearest + 1; i < PLACES && s->off[i]; i++)
        sum += s->length[i];
    return sum;
}

static void measure_sections(
    const crease_surface *surface, const crease_roof *roof, crease_accuracy *out)
{
    double domain[2][2], area = 0.0, square = 0.0;
    for (int d = 0; d < 2; d++)
        crease_surface_domain(surface, d, domain[d]);
    const int across = across_direction(surface, roof, domain);
    const double step = (domain[across][1] - domain[across][0]) / PLACES;
    const double stride = (domain[1 - across][1] - domain[1 - across][0]) / SECTIONS;
    for (int k = 0; k < SECTIONS; k++) {
        section s = {.nearest = 0};
        double uv[2], closest = INFINITY;
        uv[1 - across] = domain[1 - across][0] + stride * (k + 0.5);
        for (int i = 0; i < PLACES; i++) {
            uv[across] = domain[across][0] + step * (i + 0.5);
            measure_place(surface, roof, uv, across, &s, i, &closest);
        }
        out->width += step * off_length(&s) / SECTIONS;
        out->max = fmax(out->max, s.max);
        area += s.area;
        square += s.square;
    }
    out->rms = area > 0.0 ? sqrt(square / area) : 0.0;
}

crease_accuracy crease_accuracy_measure(const crease_sheet *sheet, const crease_roof *roof)
{
    const crease_surface *const surface = crease_sheet_surface(sheet);
    crease_accuracy out = {
        .lines = crease_sheet_line_count(sheet), .position = NAN, .angle = 180.0};
    for (size_t i = 0; i < out.lines; i++)
        measure_line(surface, crease_sheet_line(sheet, i), roof, &out);
    measure_sections(surface, roof, &out);
    return out;
}

crease_accuracy crease_sample_accuracy(
    const crease_sample_options *options, const crease_sheet *sheet)
{
    const crease_roof roof = crease_shape_sample_truth(options);
    return crease_accuracy_measure(sheet, &roof);
}
