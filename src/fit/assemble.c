/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The sum over the points. They are sorted into spans along the first direction; spans that are
 * `order` apart touch different unknowns, so they can be worked on at the same time, and every
 * number is a sum in one order for any number of threads. */
#include "fit/system.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "spline/basis.h"

#include <stdlib.h>
#include <string.h>

/* Below this number of samples a thread is not worth its while. */
enum { SMALL = 20000 };

typedef struct work {
    crease_system *system;
    const crease_height *height;
    const crease_samples *samples;
    uint32_t *order; /* numbers of the samples, span by span */
    size_t *begin;   /* of each span in the order; one more than spans */
    size_t phase;
} work;

static void add_sample(const work *w, size_t i, double *local, size_t *index)
{
    const crease_samples *const s = w->samples;
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const size_t order = (size_t)w->height->order, size = order * order;
    crease_support support;
    crease_height_support(w->height, s->uv + 2 * i, sides, 0, &support);
    const bool upright = w->system->stride[1] == 1;
    for (size_t k = 0; k < size; k++) {
        const size_t a = upright ? k / order : k % order, b = upright ? k % order : k / order;
        local[k] = support.values[0][a] * support.values[1][b];
        index[k] = crease_system_index(w->system, support.first[0] + a, support.first[1] + b);
    }
    const double weight = s->weight[i] * s->tilt[i] * s->tilt[i];
    for (size_t b = 0; b < size; b++) {
        const double scaled = weight * local[b];
        double *const column = w->system->normal + index[b] * w->system->width;
        w->system->right[index[b]] += scaled * s->target[i];
        for (size_t a = b; a < size; a++)
            column[index[a] - index[b]] += scaled * local[a];
    }
}

static void assemble_spans(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    double local[CREASE_HEIGHT_ORDER_MAX * CREASE_HEIGHT_ORDER_MAX];
    size_t index[CREASE_HEIGHT_ORDER_MAX * CREASE_HEIGHT_ORDER_MAX];
    for (size_t k = begin; k < end; k++) {
        const size_t span = w->phase + k * (size_t)w->height->order;
        for (size_t i = w->begin[span]; i < w->begin[span + 1]; i++)
            if (w->samples->weight[w->order[i]] > 0.0)
                add_sample(w, w->order[i], local, index);
    }
}

static size_t span_of(const work *w, size_t sample)
{
    const crease_height *const h = w->height;
    return crease_basis_span(
               h->knots[0], h->order, h->count[0], w->samples->uv[2 * sample], CREASE_SIDE_RIGHT) -
        ((size_t)h->order - 1);
}

/* Counting sort. */
static void sort_samples(work *w, size_t spans)
{
    for (size_t i = 0; i < w->samples->count; i++)
        w->begin[span_of(w, i) + 1]++;
    for (size_t s = 0; s < spans; s++)
        w->begin[s + 1] += w->begin[s];
    for (size_t i = w->samples->count; i-- > 0;)
        w->order[--w->begin[span_of(w, i) + 1]] = (uint32_t)i;
    for (size_t s = 0; s < spans; s++)
        w->begin[s] = w->begin[s + 1];
    w->begin[spans] = w->samples->count;
}

crease_status crease_system_assemble(crease_context *context, crease_system *system,
    const crease_height *height, const crease_samples *samples)
{
    const size_t order = (size_t)height->order, spans = height->count[0] + 1 - order;
    work w = {.system = system,
        .height = height,
        .samples = samples,
        .order = crease_allocate(context, samples->count, sizeof *w.order),
        .begin = crease_allocate(context, spans + 1, sizeof *w.begin)};
    crease_status status = w.order && w.begin ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        sort_samples(&w, spans);
        memset(system->normal, 0, system->size * system->width * sizeof *system->normal);
        memset(system->right, 0, system->size * sizeof *system->right);
    }
    const size_t grain = samples->count < SMALL ? spans : 1;
    for (w.phase = 0; w.phase < order && status == CREASE_OK; w.phase++)
        if (w.phase < spans)
            status = crease_parallel_for(
                context, (spans - w.phase + order - 1) / order, grain, assemble_spans, &w);
    free(w.order);
    free(w.begin);
    return status;
}
