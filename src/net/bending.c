/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The energies cell by cell. Each cell's part is a sum of products of integrals along the two
 * directions; a cell that has a gap in it is cut into pieces, some of which lie in the gap.
 *
 * Based on: Duchon. Splines minimizing rotation-invariant semi-norms in Sobolev spaces. 1977;
 * Golub, Welsch. Calculation of Gauss quadrature rules. 1969 (the rule; its nodes by Newton's
 * method). */
#include "net/bending.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/simd.h"
#include "spline/basis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST = CREASE_HEIGHT_ORDER_MAX,
    KINDS = 3,
    PAIRS = MOST * (MOST + 1) / 2,
    BLOCK = KINDS * PAIRS,
    MOST_PIECES = 64,
    SMALL = 4096 /* spans of a direction times those of the other: too few for threads */
};

/* Over this many bins of the raster the tension in a gap takes a slope away. */
static const double REACH = 2.0;

/* Nodes and weights of the Gauss-Legendre rule with n points on [-1, 1]. */
static void gauss_rule(int n, double *nodes, double *weights)
{
    for (int i = 0; i < n; i++) {
        double x = cos(3.14159265358979324 * (i + 0.75) / (n + 0.5)), slope = 1.0;
        for (int step = 0; step < 10; step++) {
            double before = 1.0, value = x;
            for (int k = 2; k <= n; k++) {
                const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
                before = value;
                value = next;
            }
            slope = n * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        nodes[i] = x;
        weights[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
}

static void integrate(
    const double *knots, int order, size_t span, const double interval[2], double *block)
{
    double nodes[MOST], weights[MOST], values[KINDS * MOST];
    const size_t width = (size_t)order;
    const double half = 0.5 * (interval[1] - interval[0]);
    gauss_rule(order, nodes, weights);
    for (size_t g = 0; g < width; g++) {
        const double t = interval[0] + half * (1.0 + nodes[g]);
        crease_basis_derivatives(knots, order, span, t, KINDS - 1, values);
        for (size_t kind = 0; kind < KINDS; kind++) {
            double products[PAIRS];
            crease_stencil_pack(values + kind * width, width, products);
            for (size_t i = 0; i < crease_stencil_pairs(width); i++)
                block[kind * PAIRS + i] += half * weights[g] * products[i];
        }
    }
}

/* A strip between two crease lines may be as narrow as a step is steep, and would be so stiff that
 * all else is lost in rounding: no span counts as narrower than the spacing of the points. */
static void soften(double *block, double length, double spacing)
{
    const double ratio = fmin(1.0, length / spacing);
    for (size_t i = 0; i < PAIRS; i++) {
        block[PAIRS + i] *= ratio;
        block[2 * PAIRS + i] *= ratio * ratio * ratio;
    }
}

static size_t pieces_of(const crease_gaps *gaps, int direction, double length)
{
    const double pieces = ceil(length / gaps->step[direction]);
    return gaps->empty == 0 || !(pieces > 1.0) ? 1 : (size_t)fmin(pieces, MOST_PIECES);
}

/* Counts spans and pieces. */
static void measure(const double *knots, int order, size_t count, const crease_gaps *gaps,
    int direction, crease_strip *out)
{
    for (size_t span = (size_t)order - 1; span < count; span++)
        if (knots[span + 1] > knots[span]) {
            out->spans++;
            out->pieces += pieces_of(gaps, direction, knots[span + 1] - knots[span]);
        }
}

static void fill_strip(const double *knots, int order, size_t count, const crease_gaps *gaps,
    int direction, crease_strip *out)
{
    size_t s = 0, piece = 0;
    for (size_t span = (size_t)order - 1; span < count; span++) {
        const double length = knots[span + 1] - knots[span];
        if (!(length > 0.0))
            continue;
        const size_t pieces = pieces_of(gaps, direction, length);
        out->first[s] = span + 1 - (size_t)order;
        integrate(knots, order, span, knots + span, out->whole + s * BLOCK);
        soften(out->whole + s * BLOCK, length, gaps->spacing);
        for (size_t i = 0; i < pieces; i++, piece++) {
            const double ends[2] = {knots[span] + length * (double)i / (double)pieces,
                knots[span] + length * (double)(i + 1) / (double)pieces};
            out->middle[piece] = 0.5 * (ends[0] + ends[1]);
            integrate(knots, order, span, ends, out->part + piece * BLOCK);
            soften(out->part + piece * BLOCK, length, gaps->spacing);
        }
        out->begin[++s] = piece;
    }
}

static crease_status create_strip(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, int direction, crease_strip *out)
{
    const double *const knots = height->knots[direction];
    *out = (crease_strip){.spans = 0};
    measure(knots, height->order, height->count[direction], gaps, direction, out);
    out->first = crease_allocate(context, out->spans, sizeof *out->first);
    out->begin = crease_allocate(context, out->spans + 1, sizeof *out->begin);
    out->middle = crease_allocate(context, out->pieces, sizeof *out->middle);
    out->whole = crease_allocate(context, out->spans, BLOCK * sizeof *out->whole);
    out->part = crease_allocate(context, out->pieces, BLOCK * sizeof *out->part);
    if (!out->first || !out->begin || !out->middle || !out->whole || !out->part)
        return CREASE_ERROR_NO_MEMORY;
    fill_strip(knots, height->order, height->count[direction], gaps, direction, out);
    return CREASE_OK;
}

static void free_strip(crease_strip *s)
{
    free(s->first);
    free(s->begin);
    free(s->middle);
    free(s->whole);
    free(s->part);
}

/* Adds what a cell, or a piece of one, costs. u, v: its blocks. */
static void add_energy(const crease_bending *bending, const double *u, const double *v,
    double weight, double tension, double *product)
{
    enum { FIRST = PAIRS, SECOND = 2 * PAIRS };
    const size_t pairs = crease_stencil_pairs((size_t)bending->order);
    const double mixed = bending->order == 2 ? 0.0 : 2.0 * weight;
    const double slopes = bending->order == 2 ? weight + tension : tension;
    const double bends = bending->order == 2 ? 0.0 : weight;
    for (size_t a = 0; a < pairs; a++) {
        const double value = bends * u[SECOND + a] + slopes * u[FIRST + a];
        const double slope = mixed * u[FIRST + a] + slopes * u[a], bend = bends * u[a];
        for (size_t b = 0; b < pairs; b++)
            product[a * pairs + b] += value * v[b] + slope * v[FIRST + b] + bend * v[SECOND + b];
    }
}

static bool has_gap(const crease_bending *bending, size_t iu, size_t iv)
{
    const crease_strip *const u = &bending->strip[0], *const v = &bending->strip[1];
    for (size_t a = u->begin[iu]; a < u->begin[iu + 1] && bending->gaps.empty > 0; a++)
        for (size_t b = v->begin[iv]; b < v->begin[iv + 1]; b++)
            if (crease_gaps_at(&bending->gaps, u->middle[a], v->middle[b]))
                return true;
    return false;
}

/* Sum of the diagonal of a block's three kinds. */
static void trace_block(const double *block, size_t order, double out[KINDS])
{
    for (size_t kind = 0; kind < KINDS; kind++) {
        out[kind] = 0.0;
        for (size_t a = 0, at = 0; a < order; at += order - a, a++)
            out[kind] += block[kind * PAIRS + at];
    }
}

/* Traces of a cell's bending and tension; see add_energy(). */
static void trace_energy(
    const crease_bending *bending, const double *u, const double *v, double out[2])
{
    double p[KINDS], q[KINDS];
    trace_block(u, (size_t)bending->order, p);
    trace_block(v, (size_t)bending->order, q);
    out[1] = p[1] * q[0] + p[0] * q[1];
    out[0] = bending->order == 2 ? out[1] : p[2] * q[0] + 2.0 * p[1] * q[1] + p[0] * q[2];
}

static void trace_cell(const crease_bending *e, size_t iu, size_t iv, double traces[2])
{
    const crease_strip *const u = &e->strip[0], *const v = &e->strip[1];
    const double reach = REACH * fmax(e->gaps.step[0], e->gaps.step[1]);
    double cell[2];
    if (!has_gap(e, iu, iv)) {
        trace_energy(e, u->whole + iu * BLOCK, v->whole + iv * BLOCK, cell);
        traces[0] += cell[0];
        return;
    }
    for (size_t a = u->begin[iu]; a < u->begin[iu + 1]; a++)
        for (size_t b = v->begin[iv]; b < v->begin[iv + 1]; b++) {
            trace_energy(e, u->part + a * BLOCK, v->part + b * BLOCK, cell);
            if (crease_gaps_at(&e->gaps, u->middle[a], v->middle[b]))
                traces[1] += reach * reach * cell[0] + cell[1];
            else
                traces[0] += cell[0];
        }
}

void crease_bending_traces(const crease_bending *bending, double traces[2])
{
    traces[0] = traces[1] = 0.0;
    for (size_t iu = 0; iu < bending->strip[0].spans; iu++)
        for (size_t iv = 0; iv < bending->strip[1].spans; iv++)
            trace_cell(bending, iu, iv, traces);
}

typedef struct work {
    const crease_bending *bending;
    double weight, tension;
    crease_stencil *stencil;
    size_t phase, apart;
} work;

static void add_cell(const work *w, size_t iu, size_t iv)
{
    const crease_bending *const e = w->bending;
    const crease_strip *const u = &e->strip[0], *const v = &e->strip[1];
    const size_t first[2] = {u->first[iu], v->first[iv]};
    const double reach = REACH * fmax(e->gaps.step[0], e->gaps.step[1]);
    const size_t pairs = crease_stencil_pairs((size_t)e->order);
    double product[PAIRS * PAIRS];
    memset(product, 0, pairs * pairs * sizeof *product);
    if (!has_gap(e, iu, iv)) {
        add_energy(e, u->whole + iu * BLOCK, v->whole + iv * BLOCK, w->weight, 0.0, product);
    } else {
        for (size_t a = u->begin[iu]; a < u->begin[iu + 1]; a++)
            for (size_t b = v->begin[iv]; b < v->begin[iv + 1]; b++) {
                const bool gap = crease_gaps_at(&e->gaps, u->middle[a], v->middle[b]);
                add_energy(e, u->part + a * BLOCK, v->part + b * BLOCK,
                    gap ? reach * reach * w->tension : w->weight, gap ? w->tension : 0.0, product);
            }
    }
    crease_stencil_add(w->stencil, first, product);
}

static void add_strips(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    for (size_t k = begin; k < end; k++)
        for (size_t iv = 0; iv < w->bending->strip[1].spans; iv++)
            add_cell(w, w->phase + k * w->apart, iv);
}

/* ------------------------------------------------------------------------- nets without gaps -- */

/* Integrals of products over a whole direction, by kind: [kind][step + degree][function], of each
 * function with the one that stands `step` after it. */
static void join_strip(const crease_strip *strip, size_t order, size_t count, double *bands)
{
    const size_t degree = order - 1, band = (2 * order - 1) * count;
    for (size_t s = 0; s < strip->spans; s++)
        for (size_t kind = 0; kind < KINDS; kind++) {
            const double *pair = strip->whole + s * BLOCK + kind * PAIRS;
            double *const to = bands + kind * band;
            for (size_t a = strip->first[s]; a < strip->first[s] + order; a++)
                for (size_t step = 0; a + step < strip->first[s] + order; step++, pair++) {
                    to[(degree + step) * count + a] += *pair;
                    if (step > 0)
                        to[(degree - step) * count + a + step] += *pair;
                }
        }
}

CREASE_VECTORISED static void add_row(const double *const bands[KINDS], const double factors[KINDS],
    size_t count, double *restrict row)
{
    for (size_t j = 0; j < count; j++)
        row[j] += factors[0] * bands[0][j] + factors[1] * bands[1][j] + factors[2] * bands[2][j];
}

static void add_joined(const crease_bending *e, const double *u, const double *v, double weight,
    crease_stencil *stencil)
{
    const size_t order = stencil->order, degree = order - 1, *const count = stencil->count;
    const size_t along = (2 * order - 1) * count[0], across = (2 * order - 1) * count[1];
    const bool slopes = e->order == 2;
    for (size_t i = 0; i < count[0]; i++)
        for (size_t k = 0; k < stencil->width; k++) {
            const size_t di = (k + degree) / (2 * degree + 1);
            const size_t shift = k + degree - di * (2 * degree + 1);
            const double *const p = u + (degree + di) * count[0] + i;
            const double *const bands[KINDS] = {v + shift * count[1], v + across + shift * count[1],
                v + 2 * across + shift * count[1]};
            const double factors[KINDS] = {weight * p[slopes ? along : 2 * along],
                weight * (slopes ? p[0] : 2.0 * p[along]), slopes ? 0.0 : weight * p[0]};
            add_row(
                bands, factors, count[1], stencil->values + (i * stencil->width + k) * count[1]);
        }
}

static crease_status add_without_gaps(
    crease_context *context, const crease_bending *bending, double weight, crease_stencil *stencil)
{
    const size_t order = stencil->order, size = KINDS * (2 * order - 1);
    double *u = crease_allocate(context, stencil->count[0], size * sizeof *u);
    double *v = crease_allocate(context, stencil->count[1], size * sizeof *v);
    const crease_status status = u && v ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        join_strip(&bending->strip[0], order, stencil->count[0], u);
        join_strip(&bending->strip[1], order, stencil->count[1], v);
        add_joined(bending, u, v, weight, stencil);
    }
    free(u);
    free(v);
    return status;
}

crease_status crease_bending_add(crease_context *context, const crease_bending *bending,
    double weight, double tension, crease_stencil *stencil)
{
    work w = {.bending = bending,
        .weight = weight,
        .tension = tension,
        .stencil = stencil,
        .apart = (size_t)bending->order};
    if (bending->gaps.empty == 0)
        return add_without_gaps(context, bending, weight, stencil);
    const size_t spans = bending->strip[0].spans;
    const size_t grain = spans * bending->strip[1].spans < SMALL ? spans : 1;
    crease_status status = CREASE_OK;
    for (; w.phase < w.apart && w.phase < spans && status == CREASE_OK; w.phase++)
        status = crease_parallel_for(
            context, (spans - w.phase + w.apart - 1) / w.apart, grain, add_strips, &w);
    return status;
}

crease_status crease_bending_create(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_bending *out)
{
    *out = (crease_bending){.order = height->order, .block = BLOCK, .gaps = *gaps};
    crease_status status = CREASE_OK;
    for (int d = 0; d < 2 && status == CREASE_OK; d++)
        status = create_strip(context, height, gaps, d, &out->strip[d]);
    if (status != CREASE_OK)
        crease_bending_free(out);
    return status;
}

void crease_bending_free(crease_bending *bending)
{
    free_strip(&bending->strip[0]);
    free_strip(&bending->strip[1]);
    *bending = (crease_bending){.order = 0};
}
