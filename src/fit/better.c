/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/better.h"

#include "base/vector.h"

#include <math.h>

enum { PLACES = 64 };

static const double MOST_APART = 2.0;  /* spacings that a point's distance counts, at most */
static const double NEGLIGIBLE = 1e-9; /* spacings */
static const double ALIKE = 1.1;       /* mean distances, in shares, of which none is the better */

static double mean_distance(const crease_sheet *sheet, double spacing)
{
    const double most = MOST_APART * spacing;
    double sum = 0.0;
    for (size_t i = 0; i < sheet->point_count; i++)
        sum += fmin(fabs(sheet->deviations[i]), most);
    return sum / (double)sheet->point_count + NEGLIGIBLE * spacing;
}

static double score(const crease_sheet *sheet, double mean)
{
    const crease_surface_parts parts = crease_surface_parts_of(sheet->surface);
    const double n = (double)sheet->point_count;
    return 2.0 * n * log(mean) + (double)(parts.count[0] * parts.count[1]) * log(n);
}

/* Whether both sides of a surface are seen along z. */
static bool turns_over(const crease_surface *surface, const double z[3])
{
    double domain[2][2];
    size_t up = 0;
    for (int d = 0; d < 2; d++)
        crease_surface_domain(surface, d, domain[d]);
    for (int i = 0; i < PLACES; i++)
        for (int j = 0; j < PLACES; j++) {
            const double uv[2] = {domain[0][0] + (domain[0][1] - domain[0][0]) * (i + 0.5) / PLACES,
                domain[1][0] + (domain[1][1] - domain[1][0]) * (j + 0.5) / PLACES};
            const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
            double normal[3];
            crease_surface_normal(surface, uv, sides, normal);
            up += crease_vector_dot(normal, z) > 0.0;
        }
    return up > 0 && up < (size_t)PLACES * PLACES;
}

bool crease_better_height(
    const crease_sheet *height, const crease_sheet *curved, const double z[3], double spacing)
{
    const double mean = mean_distance(height, spacing), other = mean_distance(curved, spacing);
    return score(height, mean) < score(curved, other) ||
        (mean < ALIKE * other && turns_over(curved->surface, z));
}
