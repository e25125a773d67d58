/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Topology of bodies whose models are exact, so that every number is known. */
#include "given_models.h"

#include "base/vector.h"
#include "topology/assembly.h"
#include "topology/cusp.h"
#include "topology/graph.h"

static const double S = 1.0 / 16;

typedef struct world {
    crease_context *context;
    crease_regions *regions;
    crease_topology *topology;
} world;

static world world_of_points(const given_body *body, given_points points, double s, double sigma)
{
    world w = {given_context(), NULL, NULL};
    w.regions = given_regions(w.context, body, points, s, sigma);
    if (crease_topology_find(w.context, w.regions, false, &w.topology) != CREASE_OK)
        fail_msg("%s", crease_context_message(w.context));
    return w;
}

static world world_of(const given_body *body, double s)
{
    return world_of_points(body, given_sample(body, s, 0, 5), s, 0);
}

static void end_world(world *w)
{
    crease_topology_free(w->topology);
    given_regions_free(w->regions);
    crease_context_free(w->context);
}

/* Keeps the points for which a function says so. */
static given_points keep(given_points from, bool (*wanted)(const double *place, int32_t label))
{
    size_t kept = 0;
    for (size_t i = 0; i < from.count; i++)
        if (wanted(from.points + 3 * i, from.labels[i])) {
            memmove(from.points + 3 * kept, from.points + 3 * i, 3 * sizeof(double));
            from.labels[kept++] = from.labels[i];
        }
    from.count = kept;
    return from;
}

/* Adds a body and its points, with labels that go on from those of the first. */
static void merge(
    given_body *body, given_points *points, const given_body *more, given_points additional)
{
    for (size_t i = 0; i < additional.count; i++)
        given_point(points, additional.points + 3 * i, additional.labels[i] + (int32_t)body->count);
    for (size_t i = 0; i < more->count; i++)
        given_add(body, more->models[i]);
    free(additional.points);
    free(additional.labels);
}

/* Every edge is on one loop of each of its two regions, and every half begins where the one before
 * ends. */
static void check_loops(const crease_topology *t)
{
    for (size_t e = 0; e < t->edge_count; e++) {
        size_t uses = 0;
        for (size_t f = 0; f < t->face_count; f++)
            for (size_t l = 0; l < t->faces[f].loop_count; l++)
                for (size_t h = 0; h < t->faces[f].loops[l].count; h++) {
                    const crease_loop *loop = &t->faces[f].loops[l];
                    const crease_half half = loop->halves[h];
                    const crease_half next = loop->halves[(h + 1) % loop->count];
                    assert_int_equal(t->edges[half.edge].vertices[half.reversed ? 0 : 1],
                        t->edges[next.edge].vertices[next.reversed ? 1 : 0]);
                    uses += half.edge == e;
                }
        assert_int_equal(uses, 2);
    }
}

static void check_counts(const crease_topology *t, size_t vertices, size_t edges, size_t faces)
{
    assert_int_equal(t->edge_count, edges);
    assert_int_equal(t->face_count, faces);
    size_t used = 0;
    for (size_t v = 0; v < t->vertex_count; v++) {
        bool any = false;
        for (size_t e = 0; e < t->edge_count; e++)
            any = any || t->edges[e].vertices[0] == (int32_t)v ||
                t->edges[e].vertices[1] == (int32_t)v;
        used += any;
    }
    assert_int_equal(used, vertices);
    for (size_t i = 0; i < t->region_count; i++)
        assert_false(t->open[i]);
    check_loops(t);
}

static const crease_face *face_of(const crease_topology *t, uint32_t region)
{
    for (size_t i = 0; i < t->face_count; i++)
        if (t->faces[i].region == region)
            return &t->faces[i];
    fail_msg("region %u has no face", region);
    return NULL;
}

/* The points of edges that are not loose lie on the surfaces of both regions. */
static void check_points(const world *w, double tolerance)
{
    for (size_t e = 0; e < w->topology->edge_count; e++)
        for (size_t i = 0; i < w->topology->edges[e].count; i++)
            for (int k = 0; k < 2; k++) {
                const crease_edge *edge = &w->topology->edges[e];
                double gradient[3];
                assert_near(crease_model_distance(&w->regions->models[edge->regions[k]],
                                edge->points + 3 * i, gradient),
                    0, tolerance);
            }
}

/* -------------------------------------------------------------------------- sharp bodies -- */

static void given_box_when_found_then_six_faces_with_four_edges_each(void **state)
{
    const given_body box = given_box(0.5, 0.4, 0.3);
    world w = world_of(&box, S);
    check_counts(w.topology, 8, 12, 6);
    check_points(&w, 1e-9);
    for (size_t i = 0; i < 6; i++) {
        const crease_face *face = &w.topology->faces[i];
        assert_int_equal(face->kind, CREASE_FACE_PATCH);
        assert_int_equal(face->loop_count, 1);
        assert_int_equal(face->loops[0].count, 4);
        const double sides[3] = {1.0, 0.8, 0.6};
        assert_near(face->loops[0].area, 0.48 / sides[face->region / 2], 1e-9);
    }
    for (size_t v = 0; v < 8; v++)
        for (int c = 0; c < 3; c++)
            assert_near(fabs(w.topology->vertices[v].place[c]), c == 0 ? 0.5 : 0.5 - 0.1 * c, 1e-9);
    end_world(&w);
}

static void given_rod_when_found_then_a_band_and_two_discs(void **state)
{
    const given_body rod = given_rod(0.4, 0.5);
    world w = world_of(&rod, S);
    check_counts(w.topology, 2, 2, 3);
    check_points(&w, 1e-9);
    const crease_face *band = face_of(w.topology, 0);
    assert_int_equal(band->kind, CREASE_FACE_BAND);
    assert_int_equal(band->direction, 0);
    assert_int_equal(band->loop_count, 2);
    for (int rim = 0; rim < 2; rim++) {
        double uv[2];
        const crease_loop *loop = &band->loops[rim];
        assert_int_equal(loop->turns[0], rim ? -1 : 1);
        assert_near(loop->uv[0], rim ? 2 * acos(-1) : 0, 1e-9);
        assert_near(loop->uv[1], rim ? 0.5 : -0.5, 1e-9);
        crease_chart_at(&w.topology->charts[0], w.topology->vertices[band->seam[rim]].place, uv);
        assert_near(sin(uv[0]), 0, 1e-9);
    }
    end_world(&w);
}

static void given_pyramids_when_found_then_their_faces_share_the_apex(void **state)
{
    for (int sides = 3; sides <= 6; sides++) {
        const given_body pyramid = given_pyramid(sides, 1.5);
        world w = world_of(&pyramid, S);
        check_counts(w.topology, (size_t)sides + 1, 2 * (size_t)sides, (size_t)sides + 1);
        end_world(&w);
    }
}

static void given_cone_when_found_then_a_cap_that_ends_in_the_apex(void **state)
{
    const double middle[3] = {0, 0, 0}, down[3] = {0, 0, -1}, base[3] = {0, 0, -0.5};
    for (int against = 0; against < 2; against++) {
        given_body cone = {.size = 0.5};
        const double axis[3] = {0, 0, against ? -1 : 1};
        given_add(&cone, given_model(CREASE_REGION_CONE, middle, axis, 0.25, against ? 0.5 : -0.5));
        given_add(&cone, given_plane(base, down));
        world w = world_of(&cone, S);
        check_counts(w.topology, 1, 1, 2);
        const crease_face *cap = face_of(w.topology, 0);
        assert_int_equal(cap->kind, CREASE_FACE_CAP);
        assert_false(cap->upper);
        assert_near(w.topology->charts[0].axes[8], -1, 1e-12);
        assert_near(w.topology->charts[0].shape, 0.5, 1e-12);
        end_world(&w);
    }
}

static void given_spheres_cut_when_found_then_patch_or_cap(void **state)
{
    const double origin[3] = {0, 0, 0}, z[3] = {0, 0, 1}, down[3] = {0, 0, -1};
    for (int i = 0; i < 2; i++) {
        const double base[3] = {0, 0, i ? -0.25 : 0.25};
        given_body ball = {.size = 0.5};
        given_add(&ball, given_model(CREASE_REGION_SPHERE, origin, z, 0.5, 0));
        given_add(&ball, given_plane(base, down));
        world w = world_of(&ball, S);
        check_counts(w.topology, 1, 1, 2);
        assert_int_equal(face_of(w.topology, 0)->kind, i ? CREASE_FACE_CAP : CREASE_FACE_PATCH);
        end_world(&w);
    }
}

static void given_whole_torus_when_found_then_one_face_without_edges(void **state)
{
    const double origin[3] = {0, 0, 0}, z[3] = {0, 0, 1};
    given_body ring = {.size = 0.7};
    given_add(&ring, given_model(CREASE_REGION_TORUS, origin, z, 0.5, 0.2));
    world w = world_of(&ring, S);
    check_counts(w.topology, 0, 0, 1);
    assert_int_equal(w.topology->faces[0].kind, CREASE_FACE_WHOLE);
    end_world(&w);
}

static bool beside_bore(const double *p, int32_t label)
{
    return p[0] * p[0] + p[1] * p[1] > 0.04 || label < 4;
}

static bool bore_wall(const double *p, int32_t label)
{
    return label == 0;
}

/* A block with a bore through its top and bottom. */
static given_points given_bore(given_body *block)
{
    given_body bore = given_rod(0.2, 0.3);
    *block = given_box(0.5, 0.5, 0.3);
    given_points points = keep(given_sample(block, S / 2, 0, 5), beside_bore);
    bore.count = 3;
    given_points wall = keep(given_sample(&bore, S / 2, 0, 6), bore_wall);
    bore.count = 1;
    merge(block, &points, &bore, wall);
    return points;
}

static world given_bored_block(void)
{
    given_body block;
    const given_points points = given_bore(&block);
    return world_of_points(&block, points, S / 2, 0);
}

static void given_bored_block_when_found_then_top_and_bottom_have_a_hole(void **state)
{
    world w = given_bored_block();
    check_counts(w.topology, 10, 14, 7);
    for (uint32_t i = 4; i < 6; i++) {
        const crease_face *face = face_of(w.topology, i);
        assert_int_equal(face->loop_count, 2);
        assert_int_equal(face->loops[0].count, 4);
        assert_int_equal(face->loops[1].count, 1);
        assert_true(face->loops[0].area > 0.9);
        assert_near(face->loops[1].area, -acos(-1) * 0.04, 0.002);
    }
    assert_int_equal(face_of(w.topology, 6)->kind, CREASE_FACE_BAND);
    end_world(&w);
}

static bool out_of_shadow(const double *p, int32_t label)
{
    const double angle = atan2(p[1], p[0]);
    return label != 6 || p[2] < 0 || (fabs(angle - 1) > 0.6 && fabs(angle + 1) > 0.6);
}

/* The wall of the bore is in shadow beside two stretches of its upper rim. */
static void given_rim_in_pieces_when_found_then_one_edge_goes_round(void **state)
{
    given_body block;
    const given_points points = keep(given_bore(&block), out_of_shadow);
    world w = world_of_points(&block, points, S / 2, 0);
    check_counts(w.topology, 10, 14, 7);
    check_points(&w, 1e-9);
    end_world(&w);
}

static bool in_light(const double *p, int32_t label)
{
    return label != 6 || p[2] < 0 || fabs(atan2(p[1], p[0]) - 1) < 1;
}

/* Beside most of its upper rim the wall of the bore is in shadow. */
static void given_third_of_a_rim_when_found_then_it_goes_round(void **state)
{
    given_body block;
    const given_points points = keep(given_bore(&block), in_light);
    world w = world_of_points(&block, points, S / 2, 0);
    check_counts(w.topology, 10, 14, 7);
    check_points(&w, 1e-9);
    end_world(&w);
}

static bool beside_shadows(const double *p, int32_t label)
{
    return label != 6 || fabs(p[0]) > 0.1;
}

/* Two sides of the wall of a bore, with shadows between them, are two regions. */
static void given_bore_in_two_regions_when_found_then_one_face(void **state)
{
    given_body block;
    const given_points points = keep(given_bore(&block), beside_shadows);
    given_add(&block, block.models[6]);
    for (size_t i = 0; i < points.count; i++)
        if (points.labels[i] == 6 && points.points[3 * i] < 0)
            points.labels[i] = 7;
    world w = world_of_points(&block, points, S / 2, 0);
    check_counts(w.topology, 10, 14, 7);
    check_points(&w, 1e-9);
    end_world(&w);
}

/* ------------------------------------------------------------------------ smooth joints -- */

static bool not_on_top(const double *p, int32_t label)
{
    return label != 1;
}

static bool upper_half(const double *p, int32_t label)
{
    return p[2] > 0.5;
}

/* A rod that a half sphere of its own radius ends. */
static void given_dome_when_found_then_a_smooth_ring_joins_rod_and_sphere(void **state)
{
    const double top[3] = {0, 0, 0.5}, z[3] = {0, 0, 1};
    given_body rod = given_rod(0.4, 0.5), ball = {.size = 1};
    given_points points = keep(given_sample(&rod, S / 2, 0, 5), not_on_top);
    for (size_t i = 0; i < points.count; i++)
        points.labels[i] = points.labels[i] ? 1 : 0;
    rod.models[1] = rod.models[2];
    rod.count = 2;
    given_add(&ball, given_model(CREASE_REGION_SPHERE, top, z, 0.4, 0));
    merge(&rod, &points, &ball, keep(given_sample(&ball, S / 2, 0, 6), upper_half));
    world w = world_of_points(&rod, points, S / 2, 0);
    check_counts(w.topology, 2, 2, 3);
    for (size_t e = 0; e < 2; e++) {
        const crease_edge *edge = &w.topology->edges[e];
        assert_int_equal(edge->smooth, edge->regions[1] == 2);
        for (size_t i = 0; i < edge->count; i++)
            assert_near(edge->points[3 * i + 2], edge->smooth ? 0.5 : -0.5, 1e-4);
    }
    assert_int_equal(face_of(w.topology, 0)->kind, CREASE_FACE_BAND);
    assert_int_equal(face_of(w.topology, 2)->kind, CREASE_FACE_CAP);
    end_world(&w);
}

static const double FILLET = 0.2;

static bool beside_fillet(const double *p, int32_t label)
{
    return p[0] < 0.5 - FILLET || p[2] < 0.5 - FILLET;
}

static bool on_fillet(const double *p, int32_t label)
{
    return p[0] > 0.5 - FILLET && p[2] > 0.5 - FILLET && fabs(p[1]) < 0.5;
}

/* A box with one edge rounded; the fillet, its last face, is tangent to the planes 1 and 5. */
static given_points given_filleted_box(double sigma, given_body *out)
{
    const double axis[3] = {0, 1, 0}, middle[3] = {0.5 - FILLET, 0, 0.5 - FILLET};
    given_body box = given_box(0.5, 0.5, 0.5), round = {.size = 1};
    given_points points = keep(given_sample(&box, S / 2, sigma, 5), beside_fillet);
    /* side faces end at the arc */
    for (size_t i = 0; i < points.count; i++)
        assert_true(points.labels[i] >= 0);
    given_add(&round, given_model(CREASE_REGION_CYLINDER, middle, axis, FILLET, 0));
    given_points arc = keep(given_sample(&round, S / 2, sigma, 6), on_fillet);
    given_body corner = given_box(0.5, 0.5, 0.5);
    given_add(&corner, round.models[0]);
    given_points ends = given_sample(&corner, S / 2, sigma, 7);
    for (size_t i = 0; i < ends.count; i++)
        if (ends.labels[i] / 2 == 1 &&
            on_fillet((double[3]){ends.points[3 * i], 0, ends.points[3 * i + 2]}, 0))
            given_point(&points, ends.points + 3 * i, ends.labels[i]);
    free(ends.points);
    free(ends.labels);
    merge(&box, &points, &round, arc);
    *out = box;
    return points;
}

static void given_filleted_box_when_found_then_smooth_edges_beside_the_fillet(void **state)
{
    given_body box;
    const given_points points = given_filleted_box(0, &box);
    world w = world_of_points(&box, points, S / 2, 0);
    check_counts(w.topology, 10, 15, 7);
    size_t smooth = 0;
    for (size_t e = 0; e < 15; e++) {
        const crease_edge *edge = &w.topology->edges[e];
        smooth += edge->smooth;
        assert_false(edge->smooth && edge->regions[1] != 6);
    }
    assert_int_equal(smooth, 2);
    check_points(&w, 1e-3 * S);
    end_world(&w);
}

static void given_fillet_tangent_by_construction_when_found_then_it_stays_as_it_is(void **state)
{
    given_body box;
    const given_points points = given_filleted_box(0.1 * S, &box);
    crease_model *const round = &box.models[6];
    round->tangent_count = 2;
    round->tangent[0] = 1;
    round->tangent[1] = 5;
    world w = world_of_points(&box, points, S / 2, 0.1 * S);
    assert_true(w.topology->charts[6].radius == round->radius);
    assert_memory_equal(w.topology->charts[6].centre, round->centre, sizeof round->centre);
    end_world(&w);
}

/* -------------------------------------------------------------------------- faces in pieces -- */

/* The border between the pieces that the top of a box is found in. */
static double border_at(double y)
{
    return 0.2 * sin(5 * y);
}

/* Gives the top, the last face of a box, two or three labels, all with its plane. */
static void split_top(given_body *box, given_points *points, int pieces)
{
    for (int i = 1; i < pieces; i++)
        given_add(box, box->models[5]);
    for (size_t i = 0; i < points->count; i++) {
        const double *const p = points->points + 3 * i;
        if (points->labels[i] == 5 && p[0] > border_at(p[1]))
            points->labels[i] = pieces == 3 && p[1] > 0 ? 7 : 6;
    }
}

static void given_face_in_two_pieces_when_found_then_the_points_say_where_it_parts(void **state)
{
    given_body box = given_box(1, 0.6, 0.5);
    given_points points = given_sample(&box, S, 0, 5);
    split_top(&box, &points, 2);
    world w = world_of_points(&box, points, S, 0);
    check_counts(w.topology, 10, 15, 7);
    size_t between = 0;
    for (size_t e = 0; e < 15; e++) {
        const crease_edge *edge = &w.topology->edges[e];
        if (edge->regions[0] != 5 || edge->regions[1] != 6)
            continue;
        between++;
        assert_true(edge->smooth);
        for (size_t i = 0; i < edge->count; i++)
            assert_near(edge->points[3 * i], border_at(edge->points[3 * i + 1]), 3.5 * S);
    }
    assert_int_equal(between, 1);
    check_points(&w, 1e-9);
    end_world(&w);
}

/* Pieces on the top of a box one beside the other, each with its plane: one at either end, one
 * below and one or two above between them. */
static void split_top_in_a_row(given_body *box, given_points *points, int pieces)
{
    for (int i = 1; i < pieces; i++)
        given_add(box, box->models[5]);
    for (size_t i = 0; i < points->count; i++) {
        const double *const p = points->points + 3 * i;
        if (points->labels[i] != 5)
            continue;
        if (fabs(p[0]) > 0.4 + 0.3 * fabs(p[1]))
            points->labels[i] = p[0] < 0 ? 6 : 7;
        else if (p[1] > 0)
            points->labels[i] = pieces == 5 && p[0] > 0 ? 9 : 8;
    }
}

static void given_face_in_four_or_five_pieces_when_found_then_edges_join_their_corners(void **state)
{
    for (int pieces = 4; pieces <= 5; pieces++) {
        given_body box = given_box(1, 0.6, 0.5);
        given_points points = given_sample(&box, S, 0, 5);
        split_top_in_a_row(&box, &points, pieces);
        world w = world_of_points(&box, points, S, 0);
        check_counts(w.topology, pieces == 4 ? 14 : 16, pieces == 4 ? 21 : 24, 5 + (size_t)pieces);
        for (int side = -1; side <= 1; side++) {
            const double corner[3] = {0.4 * side, 0, 0.5};
            double least = INFINITY;
            for (size_t v = 0; v < w.topology->vertex_count; v++)
                least = fmin(least, crease_vector_distance(w.topology->vertices[v].place, corner));
            assert_true(least < 2 * S || (side == 0 && pieces == 4));
        }
        check_points(&w, 1e-9);
        end_world(&w);
    }
}

static void given_face_in_three_pieces_when_found_then_they_meet_in_a_vertex(void **state)
{
    given_body box = given_box(1, 0.6, 0.5);
    given_points points = given_sample(&box, S, 0, 5);
    split_top(&box, &points, 3);
    world w = world_of_points(&box, points, S, 0);
    check_counts(w.topology, 12, 18, 8);
    const double corner[3] = {0, 0, 0.5};
    double least = INFINITY;
    for (size_t v = 0; v < w.topology->vertex_count; v++)
        least = fmin(least, crease_vector_distance(w.topology->vertices[v].place, corner));
    assert_true(least < 2 * S);
    check_points(&w, 1e-9);
    end_world(&w);
}

/* --------------------------------------------------------------------------- lost points -- */

static bool outside_hole(const double *p, int32_t label)
{
    return label < 5 || hypot(p[0], p[1]) > 2.6 * S;
}

static void given_pieces_around_a_hole_when_found_then_they_meet_in_it(void **state)
{
    given_body box = given_box(0.3, 0.3, 0.5);
    given_points points = keep(given_sample(&box, S, 0, 5), outside_hole);
    for (int i = 0; i < 2; i++)
        given_add(&box, box.models[5]);
    for (size_t i = 0; i < points.count; i++) {
        const double *const p = points.points + 3 * i;
        if (points.labels[i] == 5 && p[1] > 0)
            points.labels[i] = p[0] > 0 ? 7 : 6;
    }
    world w = world_of_points(&box, points, S, 0);
    check_counts(w.topology, 12, 18, 8);
    size_t inside = 0;
    for (size_t v = 0; v < w.topology->vertex_count; v++) {
        const double *const place = w.topology->vertices[v].place;
        inside += fabs(place[2] - 0.5) < 1e-9 && hypot(place[0], place[1]) < 2.6 * S;
    }
    assert_int_equal(inside, 1);
    end_world(&w);
}

static bool outside_shadow(const double *p, int32_t label)
{
    return p[0] + p[1] + p[2] < 0.95;
}

static void given_corner_without_points_when_found_then_it_is_where_edges_meet(void **state)
{
    const given_body box = given_box(0.5, 0.5, 0.5);
    const given_points points = keep(given_sample(&box, S, 0, 5), outside_shadow);
    world w = world_of_points(&box, points, S, 0);
    check_counts(w.topology, 8, 12, 6);
    check_points(&w, 1e-9);
    end_world(&w);
}

static bool off_two_edges(const double *p, int32_t label)
{
    return p[0] < 0.2 || (p[1] < 0.2 && p[2] < 0.2);
}

/* Of the three edges of a corner two have no points at all, and the third ends before it. */
static void given_two_edges_without_points_when_found_then_surfaces_tell(void **state)
{
    const given_body box = given_box(0.5, 0.5, 0.5);
    const given_points points = keep(given_sample(&box, S, 0, 5), off_two_edges);
    world w = world_of_points(&box, points, S, 0);
    check_counts(w.topology, 8, 12, 6);
    check_points(&w, 1e-9);
    end_world(&w);
}

static bool off_edge(const double *p, int32_t label)
{
    return p[0] < 0.2 || p[1] < 0.2;
}

static void given_edge_without_points_when_found_then_it_is_bridged(void **state)
{
    const given_body box = given_box(0.5, 0.5, 0.5);
    const given_points points = keep(given_sample(&box, S, 0, 5), off_edge);
    world w = world_of_points(&box, points, S, 0);
    check_counts(w.topology, 8, 12, 6);
    check_points(&w, 1e-9);
    end_world(&w);
}

static bool outside_bay(const double *p, int32_t label)
{
    const double angle = atan2(p[1], p[0]);
    return p[2] < 0.5 || angle < 0 || angle > 1;
}

static double length_between(const crease_topology *t, uint32_t a, uint32_t b)
{
    double length = 0;
    for (size_t e = 0; e < t->edge_count; e++)
        for (size_t i = 1; i < t->edges[e].count; i++)
            if (t->edges[e].regions[0] == a && t->edges[e].regions[1] == b)
                length += crease_vector_distance(
                    t->edges[e].points + 3 * i, t->edges[e].points + 3 * (i - 1));
    return length;
}

/* A rim that goes on from the few points in a bay to those around it, goes on the other way as
 * well.
 */
static void given_few_points_in_a_bay_when_found_then_no_edge_is_there_twice(void **state)
{
    const given_body rod = given_rod(1, 1);
    given_points points = keep(given_sample(&rod, S, 0, 5), outside_bay);
    const size_t dense = points.count;
    for (int i = 0; i < 18; i++) {
        const double angle = 0.375 + 0.11 * (i % 3) + 0.1 * S * (i / 3);
        const double c = cos(angle), d = sin(angle);
        given_point(&points, (double[]){c, d, 1 - 0.3 * S}, 0);
        given_point(&points, (double[]){(1 - 0.3 * S) * c, (1 - 0.3 * S) * d, 1}, 1);
    }
    world w = {given_context(), NULL, NULL};
    w.regions = given_regions(w.context, &rod, points, S, 0);
    for (size_t i = 0; i < dense; i++)
        w.regions->noise->local_spacing[i] = (float)(1.4 * S);
    assert_int_equal(crease_topology_find(w.context, w.regions, false, &w.topology), CREASE_OK);
    assert_true(fabs(length_between(w.topology, 0, 1) / (2 * acos(-1)) - 1) < 0.01);
    for (size_t r = 0; r < w.topology->region_count; r++)
        assert_false(w.topology->open[r]);
    end_world(&w);
}

/* Half a circle by steps of half a spacing, its ends beside it; and the same with a point
 * that was laid farther ahead than the next. */
static void given_steps_that_go_back_when_looked_at_then_the_edge_is_wild(void **state)
{
    crease_context *context = given_context();
    crease_edge edge = crease_edge_between(0, 1);
    for (int i = 0; i <= 24; i++) {
        const double angle = i / 8.0, aside = i % 24 == 0 ? 2 : 0;
        const double place[3] = {4 * cos(angle), 4 * sin(angle), aside};
        assert_int_equal(crease_edge_append(context, &edge, place), CREASE_OK);
    }
    assert_false(crease_edge_is_wild(&edge));
    memcpy(edge.points + 3 * 12, edge.points + 3 * 14, 3 * sizeof(double));
    assert_true(crease_edge_is_wild(&edge));
    crease_edge_clear(&edge);
    crease_context_free(context);
}

/* Adds an edge from a vertex at (1, 0, 0) to one of its own, by its points. */
static void edge_from_tip(crease_graph *graph, uint32_t other, const double *points, size_t count)
{
    crease_edge edge = crease_edge_between(other == 2 ? 1 : 0, other);
    edge.vertices[0] = 0;
    assert_int_equal(
        crease_graph_vertex(graph, points + 3 * (count - 1), &edge.vertices[1]), CREASE_OK);
    for (size_t i = 0; i < count; i++)
        assert_int_equal(crease_edge_append(graph->context, &edge, points + 3 * i), CREASE_OK);
    assert_int_equal(crease_graph_take(graph, &edge), CREASE_OK);
}

/* Two edges of a plane come to a vertex side by side and cross 1.5 spacings before it. */
static void given_edges_that_cross_before_their_vertex_when_moved_then_it_is_where_they_do(
    void **state)
{
    const double up[3] = {0, 0, 1}, along[3] = {0, 1, 0}, aslant[3] = {0.1, 1, 0};
    const double at[3] = {1 - 1.5 * S, 0, 0};
    given_body body = {.size = 2};
    given_add(&body, given_plane((double[]){0, 0, 0}, up));
    given_add(&body, given_plane((double[]){0, 0, 0}, along));
    given_add(&body, given_plane(at, aslant));
    world w = world_of_points(&body, given_sample(&body, S, 0, 5), S, 0);
    crease_topology *const t = crease_topology_create(w.context, w.regions);
    const crease_survey survey = {.regions = w.regions, .spacing = S, .sigma = 0.03 * S};
    crease_graph graph = {w.context, &survey, t};
    int32_t tip;
    assert_int_equal(crease_graph_vertex(&graph, (double[]){1, 0, 0}, &tip), CREASE_OK);
    edge_from_tip(&graph, 1, (double[]){1, 0, 0, 1 - S, 0, 0, 1 - 2 * S, 0, 0, 0, 0, 0}, 4);
    edge_from_tip(&graph, 2, (double[]){1, 0, 0, 1, 0, 1, 1, 0, 2}, 3);
    crease_edge other = crease_edge_between(0, 2);
    const double y = 0.1 * 1.5 * S, back[3] = {0, 0.1 * (1 - 1.5 * S), 0};
    other.vertices[0] = tip + 1;
    other.vertices[1] = tip;
    assert_int_equal(crease_edge_append(w.context, &other, back), CREASE_OK);
    assert_int_equal(crease_edge_append(w.context, &other, (double[]){1, -y, 0}), CREASE_OK);
    assert_int_equal(crease_graph_take(&graph, &other), CREASE_OK);
    assert_int_equal(crease_cusps_move(&graph), CREASE_OK);
    assert_true(crease_vector_distance(t->vertices[tip].place, at) < 1e-12);
    assert_int_equal(t->edges[0].count, 3);
    assert_true(crease_vector_distance(t->edges[0].points, at) < 1e-12);
    assert_int_equal(t->edges[1].count, 4);
    assert_true(crease_vector_distance(t->edges[1].points, at) < 1e-12);
    assert_int_equal(t->edges[2].count, 2);
    assert_true(crease_vector_distance(t->edges[2].points + 3, at) < 1e-12);
    crease_topology_free(t);
    end_world(&w);
}

static bool not_on_bottom(const double *p, int32_t label)
{
    return label != 2;
}

static void given_face_without_points_when_found_then_neighbours_are_open(void **state)
{
    given_body rod = given_rod(0.4, 0.5);
    const given_points points = keep(given_sample(&rod, S, 0, 5), not_on_bottom);
    rod.count = 2;
    world w = world_of_points(&rod, points, S, 0);
    assert_true(w.topology->open[0]);
    assert_false(w.topology->open[1]);
    assert_int_equal(w.topology->face_count, 1);
    end_world(&w);
}

static void given_no_regions_when_found_then_nothing(void **state)
{
    given_body box = given_box(0.5, 0.5, 0.5);
    given_points points = given_sample(&box, S, 0, 5);
    for (size_t i = 0; i < points.count; i++)
        points.labels[i] = CREASE_NO_REGION;
    box.count = 0;
    world w = world_of_points(&box, points, S, 0);
    check_counts(w.topology, 0, 0, 0);
    end_world(&w);
}

/* --------------------------------------------------------------------------------- noise -- */

static void given_noise_when_found_then_the_same_topology(void **state)
{
    const given_body rod = given_rod(0.4, 0.5), box = given_box(0.5, 0.4, 0.3);
    world w = world_of_points(&rod, given_sample(&rod, S, 0.3 * S, 5), S, 0.3 * S);
    check_counts(w.topology, 2, 2, 3);
    end_world(&w);
    w = world_of_points(&box, given_sample(&box, S, 0.3 * S, 5), S, 0.3 * S);
    check_counts(w.topology, 8, 12, 6);
    end_world(&w);
}

/* ---------------------------------------------------------------------------------- charts -- */

static void given_places_of_surfaces_when_charted_then_the_parameters_of_cad_kernels(void **state)
{
    const double u = 1.25, v = 0.5, r = 2.0, k = 0.75;
    const double frame[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double half = atan(k), outward = r + v * sin(half);
    const struct {
        crease_region_type type;
        double place[3];
    } rows[] = {
        {CREASE_REGION_PLANE, {u, v, 0}},
        {CREASE_REGION_SPHERE, {r * cos(v) * cos(u), r * cos(v) * sin(u), r * sin(v)}},
        {CREASE_REGION_CYLINDER, {r * cos(u), r * sin(u), v}},
        {CREASE_REGION_CONE, {outward * cos(u), outward * sin(u), v * cos(half)}},
        {CREASE_REGION_TORUS, {(r + k * cos(v)) * cos(u), (r + k * cos(v)) * sin(u), k * sin(v)}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        crease_chart chart = {.type = rows[i].type, .radius = r, .shape = k};
        double uv[2];
        memcpy(chart.axes, frame, sizeof frame);
        crease_chart_at(&chart, rows[i].place, uv);
        assert_near(uv[0], u, 1e-14);
        assert_near(uv[1], v, 1e-14);
    }
}

static void given_line_across_the_seam_when_charted_then_it_goes_on(void **state)
{
    crease_chart chart = {.type = CREASE_REGION_CYLINDER, .radius = 1};
    const double frame[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double places[30], uv[20];
    memcpy(chart.axes, frame, sizeof frame);
    for (size_t i = 0; i < 10; i++) {
        places[3 * i] = cos(6 + 0.2 * (double)i);
        places[3 * i + 1] = sin(6 + 0.2 * (double)i);
        places[3 * i + 2] = 0;
    }
    crease_chart_along(&chart, places, 10, uv);
    for (size_t i = 0; i < 10; i++)
        assert_near(uv[2 * i], 6 + 0.2 * (double)i, 1e-12);
}

/* -------------------------------------------------------------------------------- manners -- */

static void check_equal(const crease_topology *a, const crease_topology *b)
{
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_memory_equal(a->vertices, b->vertices, a->vertex_count * sizeof *a->vertices);
    assert_int_equal(a->edge_count, b->edge_count);
    for (size_t e = 0; e < a->edge_count; e++) {
        assert_int_equal(a->edges[e].count, b->edges[e].count);
        assert_memory_equal(
            a->edges[e].points, b->edges[e].points, 3 * a->edges[e].count * sizeof(double));
    }
}

static void given_any_number_of_threads_when_found_then_the_same_bytes(void **state)
{
    world w = given_bored_block();
    for (int threads = 1; threads <= 3; threads += 2) {
        crease_context *context = given_context_with_threads(threads);
        crease_topology *topology = NULL;
        assert_int_equal(crease_topology_find(context, w.regions, false, &topology), CREASE_OK);
        check_equal(w.topology, topology);
        crease_topology_free(topology);
        crease_context_free(context);
    }
    end_world(&w);
}

static void given_failing_memory_when_found_then_error_and_no_leak(void **state)
{
    given_body box = given_box(0.5, 0.5, 0.5);
    given_points points = keep(given_sample(&box, 2 * S, 0, 5), outside_shadow);
    split_top(&box, &points, 3);
    world w = world_of_points(&box, points, 2 * S, 0);
    crease_context *const alone = given_context_with_threads(1);
    long n = 0;
    for (;; n++) {
        crease_topology *topology = NULL;
        crease_context_fail_allocation(alone, n);
        const crease_status status = crease_topology_find(alone, w.regions, false, &topology);
        crease_context_fail_allocation(alone, -1);
        if (status == CREASE_OK) {
            check_equal(w.topology, topology);
            crease_topology_free(topology);
            break;
        }
        assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
        assert_null(topology);
    }
    assert_true(n > 100);
    crease_context_free(alone);
    end_world(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_box_when_found_then_six_faces_with_four_edges_each),
        cmocka_unit_test(given_rod_when_found_then_a_band_and_two_discs),
        cmocka_unit_test(given_pyramids_when_found_then_their_faces_share_the_apex),
        cmocka_unit_test(given_cone_when_found_then_a_cap_that_ends_in_the_apex),
        cmocka_unit_test(given_spheres_cut_when_found_then_patch_or_cap),
        cmocka_unit_test(given_whole_torus_when_found_then_one_face_without_edges),
        cmocka_unit_test(given_bored_block_when_found_then_top_and_bottom_have_a_hole),
        cmocka_unit_test(given_rim_in_pieces_when_found_then_one_edge_goes_round),
        cmocka_unit_test(given_third_of_a_rim_when_found_then_it_goes_round),
        cmocka_unit_test(given_bore_in_two_regions_when_found_then_one_face),
        cmocka_unit_test(given_dome_when_found_then_a_smooth_ring_joins_rod_and_sphere),
        cmocka_unit_test(given_filleted_box_when_found_then_smooth_edges_beside_the_fillet),
        cmocka_unit_test(given_face_in_two_pieces_when_found_then_the_points_say_where_it_parts),
        cmocka_unit_test(given_fillet_tangent_by_construction_when_found_then_it_stays_as_it_is),
        cmocka_unit_test(given_face_in_three_pieces_when_found_then_they_meet_in_a_vertex),
        cmocka_unit_test(
            given_face_in_four_or_five_pieces_when_found_then_edges_join_their_corners),
        cmocka_unit_test(given_pieces_around_a_hole_when_found_then_they_meet_in_it),
        cmocka_unit_test(given_corner_without_points_when_found_then_it_is_where_edges_meet),
        cmocka_unit_test(given_two_edges_without_points_when_found_then_surfaces_tell),
        cmocka_unit_test(given_edge_without_points_when_found_then_it_is_bridged),
        cmocka_unit_test(given_few_points_in_a_bay_when_found_then_no_edge_is_there_twice),
        cmocka_unit_test(given_steps_that_go_back_when_looked_at_then_the_edge_is_wild),
        cmocka_unit_test(
            given_edges_that_cross_before_their_vertex_when_moved_then_it_is_where_they_do),
        cmocka_unit_test(given_face_without_points_when_found_then_neighbours_are_open),
        cmocka_unit_test(given_no_regions_when_found_then_nothing),
        cmocka_unit_test(given_noise_when_found_then_the_same_topology),
        cmocka_unit_test(given_places_of_surfaces_when_charted_then_the_parameters_of_cad_kernels),
        cmocka_unit_test(given_line_across_the_seam_when_charted_then_it_goes_on),
        cmocka_unit_test(given_any_number_of_threads_when_found_then_the_same_bytes),
        cmocka_unit_test(given_failing_memory_when_found_then_error_and_no_leak),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
