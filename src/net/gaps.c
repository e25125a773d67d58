/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "net/gaps.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_BINS = 256 };

static const double BIN = 3.0; /* spacings */

static size_t bin_of(const crease_gaps *gaps, int direction, double t)
{
    const double b = (t - gaps->low[direction]) / gaps->step[direction];
    const size_t bin = b > 0.0 ? (size_t)b : 0;
    return bin < gaps->count[direction] ? bin : gaps->count[direction] - 1;
}

static void set_raster(
    crease_gaps *gaps, const crease_samples *samples, const crease_layout *layout)
{
    for (int d = 0; d < 2; d++) {
        const crease_layout_axis *const axis = &layout->axis[d];
        const double length = axis->high - axis->low;
        const double bins = fmin(MOST_BINS, floor(length / (BIN * samples->spacing)));
        gaps->count[d] = bins > 1.0 ? (size_t)bins : 1;
        gaps->low[d] = axis->low;
        gaps->step[d] = length / (double)gaps->count[d];
    }
}

/* Every bin that has a marked one beside it along a direction is marked as well. */
static void widen(crease_gaps *gaps, int direction)
{
    const size_t count = gaps->count[direction], lines = gaps->count[1 - direction];
    const size_t stride = direction ? 1 : gaps->count[1], across = direction ? gaps->count[1] : 1;
    for (size_t line = 0; line < lines; line++) {
        bool *const first = gaps->near + line * across;
        bool before = false;
        for (size_t i = 0; i < count; i++) {
            const bool here = first[i * stride];
            const bool after = i + 1 < count && first[(i + 1) * stride];
            first[i * stride] = before || here || after;
            before = here;
        }
    }
}

crease_status crease_gaps_create(crease_context *context, const crease_samples *samples,
    const crease_layout *layout, crease_gaps *out)
{
    *out = (crease_gaps){.spacing = samples->spacing};
    set_raster(out, samples, layout);
    const size_t bins = out->count[0] * out->count[1];
    out->near = crease_allocate(context, bins, sizeof *out->near);
    if (!out->near)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < samples->count; i++)
        if (samples->prior[i] > 0.0)
            out->near[bin_of(out, 0, samples->points[3 * i]) * out->count[1] +
                bin_of(out, 1, samples->points[3 * i + 1])] = true;
    widen(out, 0);
    widen(out, 1);
    for (size_t i = 0; i < bins; i++)
        out->empty += !out->near[i];
    return CREASE_OK;
}

void crease_gaps_free(crease_gaps *gaps)
{
    free(gaps->near);
    *gaps = (crease_gaps){.empty = 0};
}

bool crease_gaps_at(const crease_gaps *gaps, double u, double v)
{
    return !gaps->near[bin_of(gaps, 0, u) * gaps->count[1] + bin_of(gaps, 1, v)];
}
