/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The points are sorted by the cell of the net that they fall into. A cell's part of the matrix is
 * a sum of products in which the two directions stand apart, so that 100 numbers hold what 16
 * functions have in common, and goes to the matrix once. Strips of cells that are `order` apart
 * touch different control points and can be worked on at the same time; cells with very many points
 * are summed up in pieces before. */
#include "net/assemble.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/simd.h"
#include "spline/basis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Below SMALL points a thread is not worth its while; PIECE: points of a cell that are summed up at
 * a time. */
enum {
    SMALL = 20000,
    PIECE = 8192,
    AHEAD = 16,
    STREAM_SIGNS = 0x516e,
    MOST = CREASE_HEIGHT_ORDER_MAX,
    MOST_PAIRS = MOST * (MOST + 1) / 2
};

typedef struct work {
    const crease_height *height;
    const crease_observations *seen;
    crease_stencil *normal;
    double *right;
    size_t spans[2], phase;
    uint32_t *order; /* numbers of the observations, cell by cell */
    uint32_t *begin; /* of each cell in the order; one more than cells */
    size_t pieces;   /* of cells that have more than one */
    size_t *piece;   /* cell and first place in the order of each */
    double *sums;    /* of each piece: product, right sides */
    size_t used;     /* observations in the order */
    double *scratch; /* of each worker: a sum */
    size_t room;     /* numbers of a sum */
} work;

CREASE_INLINE void add_product(
    const double *restrict u, const double *restrict v, size_t pairs, double *restrict sum)
{
    for (size_t a = 0; a < pairs; a++)
        for (size_t b = 0; b < pairs; b++)
            sum[a * pairs + b] += u[a] * v[b];
}

CREASE_VECTORISED static void add_bicubic(
    const double *restrict u, const double *restrict v, double *restrict sum)
{
    add_product(u, v, 10, sum);
}

static void add_side(double values[2][MOST], size_t order, double factor, double *restrict right)
{
    for (size_t a = 0; a < order; a++)
        for (size_t b = 0; b < order; b++)
            *right++ += factor * values[0][a] * values[1][b];
}

static void add_observation(
    const work *w, size_t number, const size_t span[2], double *restrict sum)
{
    const crease_observations *const o = w->seen;
    const size_t order = (size_t)w->height->order, pairs = crease_stencil_pairs(order);
    double values[2][MOST], products[2][MOST_PAIRS];
    for (size_t d = 0; d < 2; d++) {
        const double *const knots = w->height->knots[d];
        const double t =
            crease_basis_clamp(knots, w->height->order, w->height->count[d], o->uv[2 * number + d]);
        crease_basis_values(knots, w->height->order, span[d] + order - 1, t, values[d]);
        crease_stencil_pack(values[d], order, products[d]);
    }
    const double tilt = o->tilt ? o->tilt[number] : 1.0;
    const double weight = o->weight[number] * tilt * tilt;
    for (size_t a = 0; a < pairs; a++)
        products[0][a] *= weight;
    if (order == 4)
        add_bicubic(products[0], products[1], sum);
    else
        add_product(products[0], products[1], pairs, sum);
    double *right = sum + pairs * pairs;
    for (size_t s = 0; s < o->sides; s++, right += order * order)
        add_side(values, order, weight * o->target[number * o->sides + s], right);
    if (o->probes == 0)
        return;
    uint32_t bits[4];
    crease_random_block(0, STREAM_SIGNS, o->first + number, bits);
    for (size_t s = 0; s < o->probes; s++, right += order * order)
        add_side(values, order, bits[0] >> s & 1 ? sqrt(weight) : -sqrt(weight), right);
}

/* Observations come in any order: those next in line are fetched while others are worked on. */
static void prefetch(const crease_observations *o, size_t number)
{
    __builtin_prefetch(o->uv + 2 * number);
    __builtin_prefetch(o->weight + number);
    __builtin_prefetch(o->target + number * o->sides);
    if (o->tilt)
        __builtin_prefetch(o->tilt + number);
}

/* Sums up the observations of one cell, or of a piece of it. */
static void sum_up(const work *w, size_t cell, size_t begin, size_t end, double *sum)
{
    const size_t span[2] = {cell / w->spans[1], cell % w->spans[1]};
    memset(sum, 0, w->room * sizeof *sum);
    for (size_t i = begin; i < end; i++) {
        if (i + AHEAD < w->used)
            prefetch(w->seen, w->order[i + AHEAD]);
        add_observation(w, w->order[i], span, sum);
    }
}

static void sum_pieces(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    for (size_t p = begin; p < end; p++) {
        const size_t cell = w->piece[2 * p], first = w->piece[2 * p + 1], last = w->begin[cell + 1];
        sum_up(w, cell, first, last - first < PIECE ? last : first + PIECE, w->sums + p * w->room);
    }
}

static void add_sum(const work *w, size_t cell, const double *sum)
{
    const size_t order = (size_t)w->height->order, pairs = crease_stencil_pairs(order);
    const size_t first[2] = {cell / w->spans[1], cell % w->spans[1]};
    const size_t columns = w->height->count[1], size = w->height->count[0] * columns;
    crease_stencil_add(w->normal, first, sum);
    const double *from = sum + pairs * pairs;
    for (size_t s = 0; s < w->seen->sides + w->seen->probes; s++)
        for (size_t a = 0; a < order; a++) {
            double *const to = w->right + s * size + (first[0] + a) * columns + first[1];
            for (size_t b = 0; b < order; b++)
                to[b] += *from++;
        }
}

/* Number of the first piece of a cell, or of the next one that has pieces. */
static size_t piece_of(const work *w, size_t cell)
{
    size_t low = 0, high = w->pieces;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (w->piece[2 * middle] < cell)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void assemble_strips(void *user, size_t begin, size_t end, int worker)
{
    const work *const w = user;
    double *const sum = w->scratch + (size_t)worker * w->room;
    for (size_t k = begin; k < end; k++) {
        const size_t strip = (w->phase + k * (size_t)w->height->order) * w->spans[1];
        for (size_t cell = strip; cell < strip + w->spans[1]; cell++) {
            const size_t count = w->begin[cell + 1] - w->begin[cell];
            if (count > PIECE) {
                for (size_t p = piece_of(w, cell); p < w->pieces && w->piece[2 * p] == cell; p++)
                    add_sum(w, cell, w->sums + p * w->room);
            } else if (count > 0) {
                sum_up(w, cell, w->begin[cell], w->begin[cell + 1], sum);
                add_sum(w, cell, sum);
            }
        }
    }
}

/* ------------------------------------------------------------------------------------ sorting --
 */

static void find_cells(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    const crease_height *const h = w->height;
    for (size_t i = begin; i < end; i++) {
        size_t span[2];
        for (size_t d = 0; d < 2; d++)
            span[d] = crease_basis_span(h->knots[d], h->order, h->count[d], w->seen->uv[2 * i + d],
                          CREASE_SIDE_RIGHT) +
                1 - (size_t)h->order;
        w->order[w->seen->count + i] = (uint32_t)(span[0] * w->spans[1] + span[1]);
    }
}

/* Counting sort. The second half of the order holds the cells. */
static void sort_by_cell(work *w)
{
    const size_t count = w->seen->count, cells = w->spans[0] * w->spans[1];
    const uint32_t *const cell = w->order + count;
    for (size_t i = 0; i < count; i++)
        if (w->seen->weight[i] > 0.0)
            w->begin[cell[i] + 1]++;
    for (size_t c = 0; c < cells; c++)
        w->begin[c + 1] += w->begin[c];
    const uint32_t total = w->begin[cells];
    for (size_t i = count; i-- > 0;)
        if (w->seen->weight[i] > 0.0)
            w->order[--w->begin[cell[i] + 1]] = (uint32_t)i;
    for (size_t c = 0; c < cells; c++)
        w->begin[c] = w->begin[c + 1];
    w->begin[cells] = total;
    w->used = total;
}

/* Cuts the cells with many observations into pieces and sums these up. */
static crease_status sum_large_cells(crease_context *context, work *w)
{
    const size_t cells = w->spans[0] * w->spans[1];
    for (size_t c = 0; c < cells; c++) {
        const size_t count = w->begin[c + 1] - w->begin[c];
        w->pieces += count > PIECE ? (count + PIECE - 1) / PIECE : 0;
    }
    if (w->pieces == 0)
        return CREASE_OK;
    w->piece = crease_allocate(context, w->pieces, 2 * sizeof *w->piece);
    w->sums = crease_allocate(context, w->pieces, w->room * sizeof *w->sums);
    if (!w->piece || !w->sums)
        return CREASE_ERROR_NO_MEMORY;
    size_t *piece = w->piece;
    for (size_t c = 0; c < cells; c++)
        for (size_t i = w->begin[c]; w->begin[c + 1] - w->begin[c] > PIECE && i < w->begin[c + 1];
             i += PIECE) {
            *piece++ = c;
            *piece++ = i;
        }
    return crease_parallel_for(context, w->pieces, 1, sum_pieces, w);
}

static crease_status prepare(crease_context *context, work *w)
{
    const size_t count = w->seen->count, cells = w->spans[0] * w->spans[1];
    w->order = crease_allocate(context, count, 2 * sizeof *w->order);
    w->begin = crease_allocate(context, cells + 1, sizeof *w->begin);
    w->scratch =
        crease_allocate(context, (size_t)context->options.threads, w->room * sizeof *w->scratch);
    if (!w->order || !w->begin || !w->scratch)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = crease_parallel_for(context, count, SMALL, find_cells, w);
    if (status != CREASE_OK)
        return status;
    sort_by_cell(w);
    return sum_large_cells(context, w);
}

crease_status crease_assemble(crease_context *context, const crease_height *height,
    const crease_observations *observations, crease_stencil *normal, double *right)
{
    const size_t order = (size_t)height->order, pairs = crease_stencil_pairs(order);
    work w = {.height = height,
        .seen = observations,
        .normal = normal,
        .right = right,
        .spans = {height->count[0] + 1 - order, height->count[1] + 1 - order},
        .room = pairs * pairs + (observations->sides + observations->probes) * order * order};
    crease_status status = prepare(context, &w);
    const size_t grain = observations->count < SMALL ? w.spans[0] : 1;
    for (w.phase = 0; w.phase < order && status == CREASE_OK; w.phase++)
        if (w.phase < w.spans[0])
            status = crease_parallel_for(
                context, (w.spans[0] - w.phase + order - 1) / order, grain, assemble_strips, &w);
    free(w.order);
    free(w.begin);
    free(w.scratch);
    free(w.piece);
    free(w.sums);
    return status;
}
