/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A disc that touches a point and holds none: the directions of its centre make free arcs around
 * the point. Where one ends the disc touches a second point as well, and goes on around that. */
#include "space/outline.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"
#include "space/nearest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FEWEST = 14, FEW = 40, MOST = 4096, GRAIN = 512 };

static const double TURN = 6.283185307179586476925;
static const double LEAST_ARC = 1e-9;      /* radians */
static const double SAME_PLACE = 1e-9;     /* of the radius */
static const double LEAST_AGREEMENT = 0.2; /* cosine between normals of one side of a surface */
static const double SAME_DISC = 0.7;       /* radians between its directions, seen from one point */

/* Directions in which a neighbour is in the disc's way. */
struct shade {
    double begin, end;
    uint32_t neighbour;
};

/* Free directions, from one neighbour to the next. */
struct arc {
    uint32_t point, from, to;
    double begin, end;
};

struct search {
    const crease_tree *tree;
    const double *points, *normals;
    size_t count;
    const bool *touched; /* NULL: any point may be */
    double radius;
    size_t *arc_counts; /* of each point, then where its arcs begin */
    struct arc *arcs;   /* NULL while they are counted */
    struct scratch *scratch;
};

struct scratch {
    uint32_t found[MOST];
    double squared[FEW];
    struct shade shades[MOST];
};

/* ----------------------------------------------------------------------------------- arcs -- */

static void make_frame(const double normal[3], double x[3], double y[3])
{
    int least = 0;
    for (int c = 1; c < 3; c++)
        least = fabs(normal[c]) < fabs(normal[least]) ? c : least;
    const double axis[3] = {least == 0, least == 1, least == 2};
    crease_vector_cross(axis, normal, x);
    crease_vector_normalise(x);
    crease_vector_cross(normal, x, y);
}

static double direction_of(const double x[3], const double y[3], const double d[3])
{
    const double angle = atan2(crease_vector_dot(d, y), crease_vector_dot(d, x));
    return angle < 0.0 ? angle + TURN : angle;
}

static int by_begin(const void *a, const void *b)
{
    const struct shade *const x = a, *const y = b;
    if (x->begin != y->begin)
        return x->begin < y->begin ? -1 : 1;
    return (x->neighbour > y->neighbour) - (x->neighbour < y->neighbour);
}

/* The shades of a point's neighbours, in order; 0 when it has none of its own, as an equal point
 * before it has. */
static size_t make_shades(
    const struct search *s, uint32_t point, const uint32_t *near, size_t count, struct shade *out)
{
    const double *const p = s->points + 3 * (size_t)point;
    const double *const normal = s->normals + 3 * (size_t)point;
    double x[3], y[3];
    size_t made = 0;
    make_frame(normal, x, y);
    for (size_t i = 0; i < count; i++) {
        const double *const q = s->points + 3 * (size_t)near[i];
        const double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
        const double away = hypot(crease_vector_dot(d, x), crease_vector_dot(d, y));
        if (near[i] == point || away >= 2.0 * s->radius ||
            crease_vector_dot(s->normals + 3 * (size_t)near[i], normal) < LEAST_AGREEMENT)
            continue;
        if (away < SAME_PLACE * s->radius) {
            if (near[i] < point)
                return 0;
            continue;
        }
        const double half = acos(away / (2.0 * s->radius));
        double begin = direction_of(x, y, d) - half;
        begin += begin < 0.0 ? TURN : 0.0;
        out[made++] = (struct shade){begin, begin + 2.0 * half, near[i]};
    }
    qsort(out, made, sizeof *out, by_begin);
    return made;
}

/* What the shades leave free; writes arcs unless out is NULL. */
static size_t free_arcs(uint32_t point, const struct shade *shades, size_t count, struct arc *out)
{
    size_t made = 0, last = 0;
    for (size_t i = 1; i < count; i++)
        last = shades[i].end > shades[last].end ? i : last;
    double reach = count ? shades[last].end - TURN : 0.0;
    uint32_t from = count ? shades[last].neighbour : 0;
    for (size_t i = 0; i < count; i++) {
        if (shades[i].begin > reach + LEAST_ARC) {
            if (out)
                out[made] = (struct arc){point, from, shades[i].neighbour, reach, shades[i].begin};
            made++;
        }
        if (shades[i].end > reach) {
            reach = shades[i].end;
            from = shades[i].neighbour;
        }
    }
    return made;
}

/* Most points lie inside: their nearest neighbours alone leave nothing free. */
static bool is_among(const struct search *s, uint32_t point, int most, struct scratch *scratch)
{
    const int few = s->tree->count < (size_t)most ? (int)s->tree->count : most;
    crease_tree_nearest_place(s->tree, s->points + 3 * (size_t)point, CREASE_NO_POSITION, few,
        scratch->found, scratch->squared);
    for (int i = 0; i < few; i++)
        scratch->found[i] = s->tree->index[scratch->found[i]];
    const size_t shades = make_shades(s, point, scratch->found, (size_t)few, scratch->shades);
    return shades > 0 && free_arcs(point, scratch->shades, shades, NULL) == 0;
}

static bool is_inside(const struct search *s, uint32_t point, struct scratch *scratch)
{
    return is_among(s, point, FEWEST, scratch) || is_among(s, point, FEW, scratch);
}

static void search_points(void *user, size_t begin, size_t end, int worker)
{
    const struct search *const s = user;
    struct scratch *const scratch = s->scratch + worker;
    for (size_t i = begin; i < end; i++) {
        const uint32_t point = (uint32_t)i;
        size_t found = 0;
        if (s->touched && !s->touched[i])
            continue;
        if (s->arcs ? s->arc_counts[i + 1] == s->arc_counts[i] : is_inside(s, point, scratch))
            continue;
        crease_tree_within(
            s->tree, s->points + 3 * i, 2.0 * s->radius, MOST, scratch->found, &found);
        const size_t shades =
            make_shades(s, point, scratch->found, found < MOST ? found : MOST, scratch->shades);
        const size_t arcs =
            free_arcs(point, scratch->shades, shades, s->arcs ? s->arcs + s->arc_counts[i] : NULL);
        if (!s->arcs)
            s->arc_counts[i + 1] = arcs;
    }
}

static crease_status find_arcs(crease_context *context, struct search *s)
{
    crease_status status = crease_parallel_for(context, s->count, GRAIN, search_points, s);
    if (status != CREASE_OK)
        return status;
    for (size_t i = 0; i < s->count; i++)
        s->arc_counts[i + 1] += s->arc_counts[i];
    s->arcs = crease_allocate(context, s->arc_counts[s->count], sizeof *s->arcs);
    if (!s->arcs)
        return CREASE_ERROR_NO_MEMORY;
    return crease_parallel_for(context, s->count, GRAIN, search_points, s);
}

/* ---------------------------------------------------------------------------------- loops -- */

/* The arc of the next point that begins with the disc with which this one ends. */
static size_t next_arc(const struct search *s, const struct arc *arc)
{
    const double *const p = s->points + 3 * (size_t)arc->point;
    const double *const q = s->points + 3 * (size_t)arc->to;
    double x[3], y[3], d[3], least = SAME_DISC;
    size_t next = SIZE_MAX;
    make_frame(s->normals + 3 * (size_t)arc->point, x, y);
    for (int c = 0; c < 3; c++)
        d[c] = p[c] + s->radius * (cos(arc->end) * x[c] + sin(arc->end) * y[c]) - q[c];
    make_frame(s->normals + 3 * (size_t)arc->to, x, y);
    const double centre = direction_of(x, y, d);
    for (size_t i = s->arc_counts[arc->to]; i < s->arc_counts[arc->to + 1]; i++) {
        const double away = fabs(remainder(s->arcs[i].begin - centre, TURN)) -
            (s->arcs[i].from == arc->point ? SAME_DISC : 0.0);
        if (away < least) {
            least = away;
            next = i;
        }
    }
    return next;
}

/* Without lines of single points, along which the disc goes there and back. */
static size_t without_spikes(uint32_t *loop, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        loop[kept++] = loop[i];
        if (kept >= 3 && loop[kept - 1] == loop[kept - 3])
            kept -= 2;
    }
    size_t begin = 0;
    while (kept - begin > 2 && loop[begin + 1] == loop[kept - 1]) {
        begin++;
        kept--;
    }
    memmove(loop, loop + begin, (kept - begin) * sizeof *loop);
    return kept - begin;
}

/* Follows the arcs from one on into `loop`; the points of the loop that it comes to, 0 for none. */
static size_t follow(const struct search *s, size_t arc, size_t *passed, uint32_t *loop)
{
    const size_t mark = arc + 1;
    size_t count = 0, begin = 0;
    for (size_t at = arc; passed[at] != mark; at = next_arc(s, &s->arcs[at])) {
        passed[at] = mark;
        loop[count++] = s->arcs[at].point;
        const size_t next = next_arc(s, &s->arcs[at]);
        if (next == SIZE_MAX || (passed[next] != 0 && passed[next] != mark))
            return 0;
        if (passed[next] == mark)
            while (loop[begin] != s->arcs[next].point)
                begin++;
    }
    memmove(loop, loop + begin, (count - begin) * sizeof *loop);
    return without_spikes(loop, count - begin);
}

static crease_status link_arcs(crease_context *context, const struct search *s, crease_outline *out)
{
    const size_t arc_count = s->arc_counts[s->count];
    size_t *const passed = crease_allocate(context, arc_count, sizeof *passed);
    out->first = crease_allocate(context, arc_count / 3 + 2, sizeof *out->first);
    out->points = crease_allocate(context, arc_count, sizeof *out->points);
    crease_status status = passed && out->first && out->points ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < arc_count && status == CREASE_OK; i++) {
        size_t *const first = &out->first[out->loop_count];
        const size_t count = passed[i] ? 0 : follow(s, i, passed, out->points + *first);
        if (count < 3)
            continue;
        first[1] = first[0] + count;
        out->loop_count++;
    }
    free(passed);
    return status;
}

crease_status crease_outline_find(crease_context *context, const double *points,
    const double *normals, size_t count, const bool *touched, double radius, crease_outline *out)
{
    struct search s = {
        .points = points, .normals = normals, .count = count, .touched = touched, .radius = radius};
    crease_tree *tree = NULL;
    *out = (crease_outline){.loop_count = 0};
    crease_status status = crease_tree_create(context, points, count, &tree);
    s.tree = tree;
    s.arc_counts = crease_allocate(context, count + 1, sizeof *s.arc_counts);
    s.scratch =
        crease_allocate(context, (size_t)crease_context_threads(context), sizeof *s.scratch);
    if (status == CREASE_OK && (!s.arc_counts || !s.scratch))
        status = CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = find_arcs(context, &s);
    if (status == CREASE_OK)
        status = link_arcs(context, &s, out);
    if (status != CREASE_OK)
        crease_outline_clear(out);
    free(s.arc_counts);
    free(s.scratch);
    free(s.arcs);
    crease_tree_free(tree);
    return status;
}

void crease_outline_clear(crease_outline *outline)
{
    free(outline->first);
    free(outline->points);
    *outline = (crease_outline){.loop_count = 0};
}
