/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "net/layout.h"

#include <string.h>

/* In spacings: nearer to the border, too few points hold the sheet beyond the line; a step is a
 * pair of lines close together. */
static const double TO_BORDER = 0.5, TO_LINE = 0.05;

size_t crease_layout_count(const crease_layout *layout, int direction)
{
    const crease_layout_axis *const axis = &layout->axis[direction];
    const size_t order = (size_t)layout->order;
    return order + (order - 1) * axis->line_count + axis->smooth;
}

/* How many of the simple knots, spread evenly over the domain, fall before t. */
static size_t smooth_before(const crease_layout_axis *axis, double t)
{
    const double length = axis->high - axis->low, parts = (double)(axis->smooth + 1);
    size_t before = 0;
    while (before < axis->smooth && axis->low + length * (double)(before + 1) / parts < t)
        before++;
    return before;
}

static double *put(double *knots, double t, size_t times)
{
    for (size_t i = 0; i < times; i++)
        *knots++ = t;
    return knots;
}

void crease_layout_knots(const crease_layout *layout, int direction, double *knots)
{
    const crease_layout_axis *const axis = &layout->axis[direction];
    const size_t order = (size_t)layout->order;
    knots = put(knots, axis->low, order);
    size_t placed = 0;
    double from = axis->low;
    for (size_t line = 0; line <= axis->line_count; line++) {
        const bool last = line == axis->line_count;
        const double to = last ? axis->high : axis->lines[line];
        const size_t until = last ? axis->smooth : smooth_before(axis, to);
        const double parts = (double)(until - placed + 1);
        for (size_t i = 1; placed < until; i++, placed++)
            *knots++ = from + (to - from) * (double)i / parts;
        knots = put(knots, to, last ? order : order - 1);
        from = to;
    }
}

bool crease_layout_add(crease_layout *layout, int direction, double at, double spacing)
{
    crease_layout_axis *const axis = &layout->axis[direction];
    const double border = TO_BORDER * spacing, gap = TO_LINE * spacing;
    if (axis->line_count == CREASE_MOST_LINES || !(at - axis->low > border) ||
        !(axis->high - at > border))
        return false;
    size_t place = 0;
    while (place < axis->line_count && axis->lines[place] < at)
        place++;
    if ((place > 0 && !(at - axis->lines[place - 1] > gap)) ||
        (place < axis->line_count && !(axis->lines[place] - at > gap)))
        return false;
    memmove(axis->lines + place + 1, axis->lines + place,
        (axis->line_count - place) * sizeof *axis->lines);
    axis->lines[place] = at;
    axis->line_count++;
    return true;
}

void crease_layout_remove(crease_layout *layout, int direction, size_t line)
{
    crease_layout_axis *const axis = &layout->axis[direction];
    axis->line_count--;
    memmove(axis->lines + line, axis->lines + line + 1,
        (axis->line_count - line) * sizeof *axis->lines);
}

void crease_layout_between(const crease_layout *layout, int direction, double t, double interval[2])
{
    const crease_layout_axis *const axis = &layout->axis[direction];
    interval[0] = axis->low;
    interval[1] = axis->high;
    for (size_t i = 0; i < axis->line_count; i++) {
        if (axis->lines[i] <= t)
            interval[0] = axis->lines[i];
        else if (axis->lines[i] < interval[1])
            interval[1] = axis->lines[i];
    }
}
