/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/sharpness.h"

#include "net/gaps.h"

#include <math.h>

enum { STATIONS = 64 };

static const double BESIDE = 4.0; /* spacings */

static double slope_at(
    const crease_height *height, int direction, double across, double along, crease_side side)
{
    double uv[2], f[3];
    crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    uv[direction] = across;
    uv[1 - direction] = along;
    sides[direction] = side;
    crease_height_at(height, uv, sides, 1, f);
    return f[1 + direction];
}

/* Distance to the nearest other line or border, in lengths of the places beside, 1 at most. */
static double room_around(const crease_draft *draft, int direction, size_t line)
{
    const crease_layout_axis *const axis = &draft->layout.axis[direction];
    const double at = axis->lines[line];
    const double before = at - (line > 0 ? axis->lines[line - 1] : axis->low);
    const double behind = (line + 1 < axis->line_count ? axis->lines[line + 1] : axis->high) - at;
    return fmin(1.0, fmin(before, behind) / (BESIDE * draft->samples->spacing));
}

bool crease_sharpness_is_crease(const crease_draft *draft, int direction, size_t line)
{
    const crease_layout_axis *const over = &draft->layout.axis[1 - direction];
    const double at = draft->layout.axis[direction].lines[line];
    const double room = room_around(draft, direction, line);
    const double step = room * BESIDE * draft->samples->spacing;
    double jump = 0.0, beside = 0.0;
    for (int i = 0; i < STATIONS; i++) {
        const double along = over->low + (over->high - over->low) * (i + 0.5) / STATIONS;
        const double uv[2] = {direction == 0 ? at : along, direction == 0 ? along : at};
        if (crease_gaps_at(&draft->system.gaps, uv[0], uv[1]))
            continue;
        const crease_height *const h = &draft->height;
        const double left = slope_at(h, direction, at, along, CREASE_SIDE_LEFT);
        const double right = slope_at(h, direction, at, along, CREASE_SIDE_RIGHT);
        jump += room * fabs(right - left);
        beside += 0.5 / room *
            (fabs(left - slope_at(h, direction, at - step, along, CREASE_SIDE_RIGHT)) +
                fabs(slope_at(h, direction, at + step, along, CREASE_SIDE_LEFT) - right));
    }
    return jump > beside;
}
