/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "primitive/rolling.h"

#include "base/simd.h"
#include "base/vector.h"
#include "primitive/primitive.h"

#include <math.h>
#include <string.h>

enum { LANES = 8 };

static const double least_sine = 0.25; /* 14 degrees between the planes, or they make no edge */

/* The vector in the section that rises so much along each normal, as factors of the normals. */
static void solve(const crease_wedge *wedge, const double rise[2], double factors[2])
{
    const double determinant = 1.0 - wedge->cosine * wedge->cosine;
    for (int i = 0; i < 2; i++)
        factors[i] = (rise[i] - wedge->cosine * rise[1 - i]) / determinant;
}

bool crease_wedge_make(
    const crease_model *const planes[2], const double between[3], crease_wedge *out)
{
    double gradient[3], rise[2], factors[2];
    for (int i = 0; i < 2; i++) {
        rise[i] = -crease_model_distance(planes[i], between, gradient);
        const double sign = rise[i] > 0.0 ? -1.0 : 1.0;
        for (int c = 0; c < 3; c++)
            out->normals[i][c] = sign * gradient[c];
        rise[i] *= sign;
    }
    crease_vector_cross(out->normals[0], out->normals[1], out->along);
    if (!(crease_vector_length(out->along) >= least_sine))
        return false;
    crease_vector_normalise(out->along);
    out->cosine = crease_vector_dot(out->normals[0], out->normals[1]);
    solve(out, rise, factors);
    for (int c = 0; c < 3; c++)
        out->origin[c] =
            between[c] + factors[0] * out->normals[0][c] + factors[1] * out->normals[1][c];
    return true;
}

crease_section crease_wedge_section(const crease_wedge *wedge, const double place[3])
{
    double d[3];
    for (int c = 0; c < 3; c++)
        d[c] = place[c] - wedge->origin[c];
    return (crease_section){
        {crease_vector_dot(d, wedge->normals[0]), crease_vector_dot(d, wedge->normals[1])}};
}

static double length_of(const double rise[2], const double factors[2])
{
    return sqrt(fmax(rise[0] * factors[0] + rise[1] * factors[1], 0.0));
}

double crease_wedge_away(const crease_wedge *wedge, crease_section at)
{
    double factors[2];
    solve(wedge, at.height, factors);
    return length_of(at.height, factors);
}

double crease_wedge_touch(const crease_wedge *wedge)
{
    return sqrt((1.0 - wedge->cosine) / (1.0 + wedge->cosine));
}

double crease_rolling_distance(
    const crease_wedge *wedge, double radius, crease_section at, crease_rolling_part *part)
{
    const double rise[2] = {at.height[0] - radius, at.height[1] - radius};
    double factors[2];
    solve(wedge, rise, factors);
    if (factors[0] < 0.0 && factors[1] < 0.0) {
        *part = CREASE_ROLLING_ARC;
        return fabs(length_of(rise, factors) - radius);
    }
    const double away[2] = {fabs(at.height[0]), fabs(at.height[1])};
    const bool both = factors[0] >= 0.0 && factors[1] >= 0.0;
    const int nearest = both ? away[1] < away[0] : factors[0] >= 0.0;
    *part = nearest ? CREASE_ROLLING_SECOND : CREASE_ROLLING_FIRST;
    return away[nearest];
}

/* crease_rolling_distance squared, without branches. */
CREASE_INLINE double squared_distance(
    double cosine, double inverse, double radius, double first, double second)
{
    const double r0 = first - radius, r1 = second - radius;
    const double f0 = (r0 - cosine * r1) * inverse, f1 = (r1 - cosine * r0) * inverse;
    const double square = r0 * f0 + r1 * f1;
    const double arc = sqrt(square > 0.0 ? square : 0.0) - radius;
    const double a0 = first * first, a1 = second * second;
    const double nearer = a1 < a0 ? a1 : a0;
    const double beside_second = f1 >= 0.0 ? nearer : a1;
    const double above = f0 >= 0.0 ? beside_second : a0;
    const double larger = f0 > f1 ? f0 : f1;
    return larger < 0.0 ? arc * arc : above;
}

CREASE_VECTORISED double crease_rolling_cost(const crease_wedge *wedge, double radius,
    const double *first, const double *second, size_t count, double sigma, double cut)
{
    const double cosine = wedge->cosine, inverse = 1.0 / (1.0 - cosine * cosine);
    const double most = cut * sigma * sigma;
    double sums[LANES] = {0.0}, total = 0.0;
    const size_t whole = count - count % LANES;
    for (size_t i = 0; i < whole; i += LANES)
        for (size_t k = 0; k < LANES; k++) {
            const double square =
                squared_distance(cosine, inverse, radius, first[i + k], second[i + k]);
            sums[k] += square < most ? square : most;
        }
    for (size_t i = whole; i < count; i++) {
        const double square = squared_distance(cosine, inverse, radius, first[i], second[i]);
        sums[i % LANES] += square < most ? square : most;
    }
    for (size_t k = 0; k < LANES; k++)
        total += sums[k];
    return total / (sigma * sigma);
}

void crease_rolling_cylinder(
    const crease_wedge *wedge, double radius, const double beside[3], crease_model *out)
{
    const double rise[2] = {radius, radius};
    double factors[2], d[3];
    solve(wedge, rise, factors);
    for (int c = 0; c < 3; c++)
        d[c] = beside[c] - wedge->origin[c];
    const double along = crease_vector_dot(d, wedge->along);
    *out = (crease_model){.type = CREASE_REGION_CYLINDER, .radius = radius, .parameter_count = 1.0};
    memcpy(out->axes + 6, wedge->along, sizeof wedge->along);
    crease_primitive_frame(out->axes);
    for (int c = 0; c < 3; c++)
        out->centre[c] = wedge->origin[c] + along * wedge->along[c] +
            factors[0] * wedge->normals[0][c] + factors[1] * wedge->normals[1][c];
}
