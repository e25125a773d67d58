/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The bending and tension matrices, cell by cell. Each cell's part is a sum of Kronecker products
 * of integrals along the two directions; a cell that has a gap in it is cut into pieces, some of
 * which lie in the gap.
 *
 * Based on: Duchon. Splines minimizing rotation-invariant semi-norms in Sobolev spaces. 1977;
 * Golub, Welsch. Calculation of Gauss quadrature rules. 1969 (the rule; its nodes by Newton's
 * method). */
#include "fit/bending.h"

#include "base/memory.h"
#include "spline/basis.h"

#include <math.h>
#include <stdlib.h>

enum { MOST = CREASE_HEIGHT_ORDER_MAX, KINDS = 3, BLOCK = KINDS * MOST * MOST, MOST_PIECES = 64 };

/* Over this many bins of the raster the tension in a gap takes a slope away. */
static const double REACH = 2.0;

/* Integrals along one direction, over whole spans and over the pieces that they are cut into. A
 * block holds [kind][a][b]: of the products of the derivatives number `kind` of functions a and b
 * of those that are not zero there. */
typedef struct strip {
    size_t spans, pieces;
    size_t *first;  /* function of each span */
    size_t *begin;  /* first piece of each span; one more than spans */
    double *middle; /* of each piece */
    double *whole;  /* a block for each span */
    double *part;   /* a block for each piece */
} strip;

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
        for (size_t kind = 0; kind < KINDS; kind++)
            for (size_t a = 0; a < width; a++)
                for (size_t b = 0; b < width; b++)
                    block[(kind * MOST + a) * MOST + b] +=
                        half * weights[g] * values[kind * width + a] * values[kind * width + b];
    }
}

/* A strip between two crease lines may be as narrow as a step is steep, and would be so stiff that
 * all else is lost in rounding: no span counts as narrower than the spacing of the points. */
static void soften(double *block, double length, double spacing)
{
    const double ratio = fmin(1.0, length / spacing);
    for (size_t i = 0; i < MOST * MOST; i++) {
        block[MOST * MOST + i] *= ratio;
        block[2 * MOST * MOST + i] *= ratio * ratio * ratio;
    }
}

static size_t pieces_of(const crease_gaps *gaps, int direction, double length)
{
    const double pieces = ceil(length / gaps->step[direction]);
    return gaps->empty == 0 || !(pieces > 1.0) ? 1 : (size_t)fmin(pieces, MOST_PIECES);
}

/* Counts spans and pieces. */
static void measure(const double *knots, int order, size_t count, const crease_gaps *gaps,
    int direction, strip *out)
{
    for (size_t span = (size_t)order - 1; span < count; span++)
        if (knots[span + 1] > knots[span]) {
            out->spans++;
            out->pieces += pieces_of(gaps, direction, knots[span + 1] - knots[span]);
        }
}

static void fill_strip(const double *knots, int order, size_t count, const crease_gaps *gaps,
    int direction, strip *out)
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
    const crease_gaps *gaps, int direction, strip *out)
{
    const double *const knots = height->knots[direction];
    *out = (strip){.spans = 0};
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

static void free_strip(strip *s)
{
    free(s->first);
    free(s->begin);
    free(s->middle);
    free(s->whole);
    free(s->part);
}

/* What a cell, or a piece of one, adds: bending times one weight plus tension times another. */
typedef struct energy {
    const double *u, *v; /* blocks */
    double bending, tension;
} energy;

static double energy_of(const energy *e, int order, size_t ua, size_t ub, size_t va, size_t vb)
{
    const double *const u = e->u + ua * MOST + ub, *const v = e->v + va * MOST + vb;
    enum { FIRST = MOST * MOST, SECOND = 2 * MOST * MOST };
    const double slope = u[FIRST] * v[0] + u[0] * v[FIRST];
    const double bend =
        order == 2 ? slope : u[SECOND] * v[0] + 2.0 * u[FIRST] * v[FIRST] + u[0] * v[SECOND];
    return e->bending * bend + e->tension * slope;
}

static void add(
    crease_system *system, double *matrix, int order, const size_t first[2], const energy *e)
{
    const size_t width = (size_t)order;
    for (size_t ua = 0; ua < width; ua++)
        for (size_t va = 0; va < width; va++) {
            const size_t a = crease_system_index(system, first[0] + ua, first[1] + va);
            for (size_t ub = 0; ub < width; ub++)
                for (size_t vb = 0; vb < width; vb++) {
                    const size_t b = crease_system_index(system, first[0] + ub, first[1] + vb);
                    if (a >= b)
                        matrix[b * system->width + (a - b)] += energy_of(e, order, ua, ub, va, vb);
                }
        }
}

static size_t empty_pieces(
    const crease_gaps *gaps, const strip *u, const strip *v, size_t iu, size_t iv)
{
    size_t empty = 0;
    for (size_t a = u->begin[iu]; a < u->begin[iu + 1]; a++)
        for (size_t b = v->begin[iv]; b < v->begin[iv + 1]; b++)
            empty += crease_gaps_at(gaps, u->middle[a], v->middle[b]);
    return empty;
}

static void add_cell(crease_system *system, int order, const crease_gaps *gaps,
    const strip strips[2], size_t iu, size_t iv)
{
    const strip *const u = &strips[0], *const v = &strips[1];
    const size_t first[2] = {u->first[iu], v->first[iv]};
    const double reach = REACH * fmax(gaps->step[0], gaps->step[1]);
    if (gaps->empty == 0 || empty_pieces(gaps, u, v, iu, iv) == 0) {
        const energy e = {u->whole + iu * BLOCK, v->whole + iv * BLOCK, 1.0, 0.0};
        add(system, system->bending, order, first, &e);
        return;
    }
    for (size_t a = u->begin[iu]; a < u->begin[iu + 1]; a++)
        for (size_t b = v->begin[iv]; b < v->begin[iv + 1]; b++) {
            const bool gap = crease_gaps_at(gaps, u->middle[a], v->middle[b]);
            const energy e = {u->part + a * BLOCK, v->part + b * BLOCK, gap ? reach * reach : 1.0,
                gap ? 1.0 : 0.0};
            add(system, gap ? system->tension : system->bending, order, first, &e);
        }
}

crease_status crease_bending_fill(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_system *system)
{
    strip strips[2] = {{.spans = 0}, {.spans = 0}};
    crease_status status = create_strip(context, height, gaps, 0, &strips[0]);
    if (status == CREASE_OK)
        status = create_strip(context, height, gaps, 1, &strips[1]);
    for (size_t iu = 0; iu < strips[0].spans && status == CREASE_OK; iu++)
        for (size_t iv = 0; iv < strips[1].spans; iv++)
            add_cell(system, height->order, gaps, strips, iu, iv);
    free_strip(&strips[0]);
    free_strip(&strips[1]);
    return status;
}
