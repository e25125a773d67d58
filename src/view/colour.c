/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/colour.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;

typedef struct linear {
    double red, green, blue;
} linear;

/* OKLCh to linear light, by Ottosson's two matrices. */
static linear linear_of_lch(double lightness, double chroma, double hue)
{
    const double a = chroma * cos(hue * PI / 180), b = chroma * sin(hue * PI / 180);
    const double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
    const double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
    const double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
    const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
    return (linear){4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
        -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
        -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
}

static bool shown(linear c)
{
    const double slack = 1e-6;
    return c.red >= -slack && c.red <= 1 + slack && c.green >= -slack && c.green <= 1 + slack &&
        c.blue >= -slack && c.blue <= 1 + slack;
}

/* Linear light to the screen's value (IEC 61966-2-1). */
static double encode(double light)
{
    const double c = fmin(1, fmax(0, light));
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

crease_colour crease_colour_of_lch(double lightness, double chroma, double hue)
{
    double low = 0, high = chroma;
    if (!shown(linear_of_lch(lightness, chroma, hue)))
        for (int i = 0; i < 24; i++) {
            const double middle = (low + high) / 2;
            if (shown(linear_of_lch(lightness, middle, hue)))
                low = middle;
            else
                high = middle;
        }
    else
        low = chroma;
    const linear c = linear_of_lch(lightness, low, hue);
    return (crease_colour){encode(c.red), encode(c.green), encode(c.blue)};
}

/* Lightness rises evenly while the hue turns from violet over blue and green to yellow. */
static crease_colour sequential(double t)
{
    return crease_colour_of_lch(0.28 + 0.63 * t, 0.125 + 0.045 * t, 305 - 198 * t);
}

/* Lightness falls evenly from the middle; chroma grows with it. */
static crease_colour diverging(double t)
{
    const double away = fabs(2 * t - 1);
    return crease_colour_of_lch(0.955 - 0.50 * away, 0.20 * away, t < 0.5 ? 256 : 27);
}

crease_colour crease_map_at(crease_map map, double t)
{
    const double inside = fmin(1, fmax(0, t));
    return map == CREASE_MAP_DIVERGING ? diverging(inside) : sequential(inside);
}

void crease_map_table(crease_map map, uint8_t table[256][3])
{
    for (int i = 0; i < 256; i++) {
        const crease_colour c = crease_map_at(map, i / 255.0);
        table[i][0] = (uint8_t)lround(255 * c.red);
        table[i][1] = (uint8_t)lround(255 * c.green);
        table[i][2] = (uint8_t)lround(255 * c.blue);
    }
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The range of sorted values: all of them, unless a few spread it to more than three times. Values
 * of both signs have a middle, but not numbers of things. */
static crease_range range_of_sorted(const double *values, size_t count, bool numbers)
{
    crease_range range = {.lowest = 0, .highest = 1, .map = CREASE_MAP_SEQUENTIAL};
    if (count == 0)
        return range;
    const size_t cut = count / 100;
    const double lowest = values[0], highest = values[count - 1];
    const double low = values[cut], high = values[count - 1 - cut];
    const bool cuts = high > low && highest - lowest > 3 * (high - low);
    range.lowest = cuts ? low : lowest;
    range.highest = cuts ? high : highest;
    if (range.lowest < 0 && range.highest > 0 && !numbers) {
        range.map = CREASE_MAP_DIVERGING;
        range.highest = fmax(range.highest, -range.lowest);
        range.lowest = -range.highest;
    }
    if (!(range.highest > range.lowest))
        range.highest = range.lowest + fmax(1, fabs(range.lowest)) * 1e-3;
    range.below = lowest < range.lowest;
    range.above = highest > range.highest;
    return range;
}

crease_status crease_range_of_field(
    crease_context *context, const crease_field *field, size_t count, crease_range *out)
{
    double *values = crease_allocate(context, count, sizeof *values);
    if (!values)
        return CREASE_ERROR_NO_MEMORY;
    size_t finite = 0;
    for (size_t i = 0; i < count; i++) {
        const double value = crease_field_value(field, i);
        if (isfinite(value))
            values[finite++] = value;
    }
    qsort(values, finite, sizeof *values, ascending);
    *out = range_of_sorted(values, finite, field->type < CREASE_TYPE_FLOAT32);
    free(values);
    return CREASE_OK;
}

crease_colour crease_range_colour(const crease_range *range, double value)
{
    if (!isfinite(value))
        return (crease_colour){0.6, 0.6, 0.6};
    return crease_map_at(range->map, (value - range->lowest) / (range->highest - range->lowest));
}
