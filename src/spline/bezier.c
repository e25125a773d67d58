/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "spline/bezier.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* Bezier points of a span are the polar form at its ends. */
static void extract_span(const double *knots, int order, size_t index, crease_span *out)
{
    double arguments[CREASE_ORDER_MAX];
    out->index = index;
    out->ends[0] = knots[index];
    out->ends[1] = knots[index + 1];
    for (int i = 0; i < order; i++) {
        for (int r = 0; r < order - 1; r++)
            arguments[r] = r < order - 1 - i ? out->ends[0] : out->ends[1];
        crease_basis_blossom(knots, order, index, arguments, out->extract + i * order);
    }
}

static crease_status find_spans(crease_context *context, crease_bezier *b, int direction)
{
    const int order = b->parts.order[direction];
    const size_t count = b->parts.count[direction];
    const double *const knots = b->parts.knots[direction];
    crease_span *const spans = crease_allocate(context, count + 1 - (size_t)order, sizeof *spans);
    b->spans[direction] = spans;
    if (!spans)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = (size_t)order - 1; i < count; i++)
        if (knots[i] < knots[i + 1])
            extract_span(knots, order, i, &spans[b->span_count[direction]++]);
    return CREASE_OK;
}

crease_status crease_bezier_prepare(
    crease_context *context, const crease_surface_parts *parts, crease_bezier *out)
{
    *out = (crease_bezier){.parts = *parts};
    crease_status status = find_spans(context, out, 0);
    if (status == CREASE_OK)
        status = find_spans(context, out, 1);
    if (status != CREASE_OK)
        crease_bezier_release(out);
    return status;
}

void crease_bezier_release(crease_bezier *bezier)
{
    free(bezier->spans[0]);
    free(bezier->spans[1]);
    *bezier = (crease_bezier){.parts = bezier->parts};
}

void crease_bezier_patch(
    const crease_bezier *bezier, const size_t patch[2], const double place[3], double *out)
{
    const crease_span *const u = &bezier->spans[0][patch[0]];
    const crease_span *const v = &bezier->spans[1][patch[1]];
    const size_t m = (size_t)bezier->parts.order[0];
    const size_t n = (size_t)bezier->parts.order[1];
    const size_t width = bezier->parts.count[1];
    const double *const corner =
        bezier->parts.control_points + 3 * ((u->index + 1 - m) * width + v->index + 1 - n);
    double half[3 * CREASE_ORDER_MAX * CREASE_ORDER_MAX];
    memset(half, 0, 3 * m * n * sizeof *half);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++)
            for (size_t r = 0; r < n; r++)
                for (size_t c = 0; c < 3; c++)
                    half[3 * (i * n + j) + c] +=
                        v->extract[j * n + r] * (corner[3 * (i * width + r) + c] - place[c]);
    memset(out, 0, 3 * m * n * sizeof *out);
    for (size_t i = 0; i < m; i++)
        for (size_t r = 0; r < m; r++)
            for (size_t k = 0; k < 3 * n; k++)
                out[3 * n * i + k] += u->extract[i * m + r] * half[3 * n * r + k];
}
