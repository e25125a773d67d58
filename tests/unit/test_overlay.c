/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions of the plane, cut along its axes: areas, faces and the edges that they share. */
#include "given.h"

#include "trim/overlay.h"

enum { MOST_CORNERS = 64 };

typedef struct scene {
    crease_context *context;
    crease_frontier frontier;
    double cuts[2][4];
    crease_cuts given;
    crease_overlay overlay;
    bool sound;
} scene;

/* Rings of straight arcs, one for each side; ring r has sizes[r] corners. */
static scene given_rings(const double (*corners)[2], const size_t *sizes, size_t count)
{
    scene s = {.context = given_context()};
    size_t arcs = 0, from = 0;
    for (size_t r = 0; r < count; r++)
        arcs += sizes[r];
    assert_int_equal(
        crease_frontier_create(s.context, count, arcs, 2 * arcs, &s.frontier), CREASE_OK);
    for (size_t r = 0; r < count; r++) {
        for (size_t i = 0; i < sizes[r]; i++) {
            memcpy(s.frontier.places + 4 * (from + i), corners[from + i], 2 * sizeof(double));
            memcpy(s.frontier.places + 4 * (from + i) + 2, corners[from + (i + 1) % sizes[r]],
                2 * sizeof(double));
            s.frontier.first_place[from + i + 1] = 2 * (from + i + 1);
        }
        from += sizes[r];
        s.frontier.first_arc[r + 1] = from;
    }
    return s;
}

/* A square of side 4 with a square hole of side 2 in it. */
static scene given_a_frame(void)
{
    static const double corners[][2] = {
        {0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}};
    return given_rings(corners, (size_t[]){4, 4}, 2);
}

static void when_cut(
    scene *s, size_t along_x, const double *x, size_t along_y, const double *y, double least_width)
{
    memcpy(s->cuts[0], x, along_x * sizeof *x);
    memcpy(s->cuts[1], y, along_y * sizeof *y);
    s->given = (crease_cuts){{along_x, along_y}, {s->cuts[0], s->cuts[1]}};
    assert_int_equal(crease_overlay_find(
                         s->context, &s->frontier, &s->given, least_width, &s->overlay, &s->sound),
        CREASE_OK);
}

static void free_scene(scene *s)
{
    crease_frontier_clear(&s->frontier);
    crease_overlay_clear(&s->overlay);
    crease_context_free(s->context);
}

static double face_area(const crease_overlay *o, size_t face)
{
    const crease_overlay_face *const f = &o->faces[face];
    double area = 0.0;
    for (size_t i = o->first_half[f->first_loop]; i < o->first_half[f->first_loop + f->loop_count];
         i++) {
        const crease_overlay_edge *const e = &o->edges[o->halves[i] / 2];
        for (size_t k = 0; k + 1 < e->count; k++) {
            const double *const p = o->places + 2 * (e->first + k);
            area += ((o->halves[i] & 1) ? -0.5 : 0.5) * (p[0] * p[3] - p[1] * p[2]);
        }
    }
    return area;
}

static size_t shared_edges(const crease_overlay *o)
{
    size_t count = 0;
    for (size_t i = 0; i < o->edge_count; i++)
        count += o->edges[i].faces[0] >= 0 && o->edges[i].faces[1] >= 0;
    return count;
}

/* Loops are closed, every edge knows its faces, and ends of edges are nodes. */
static void then_it_holds_together(const crease_overlay *o)
{
    for (size_t loop = 0; loop < o->loop_count; loop++)
        for (size_t i = o->first_half[loop]; i < o->first_half[loop + 1]; i++) {
            const size_t next = i + 1 < o->first_half[loop + 1] ? i + 1 : o->first_half[loop];
            const crease_overlay_half a = o->halves[i], b = o->halves[next];
            assert_int_equal(o->edges[a / 2].nodes[!(a & 1)], o->edges[b / 2].nodes[(b & 1) != 0]);
        }
    for (size_t i = 0; i < o->edge_count; i++) {
        const crease_overlay_edge *const e = &o->edges[i];
        for (size_t end = 0; end < 2; end++)
            assert_memory_equal(o->nodes + 2 * (size_t)e->nodes[end],
                o->places + 2 * (e->first + (end ? e->count - 1 : 0)), 2 * sizeof(double));
        assert_true(e->faces[0] >= 0 || e->faces[1] >= 0);
        assert_true(e->direction < 0 || e->faces[0] >= 0 || e->faces[1] >= 0);
    }
}

static void given_no_cut_then_one_face_with_its_hole(void **state)
{
    scene s = given_a_frame();
    when_cut(&s, 0, (double[]){0}, 0, (double[]){0}, 0.1);
    assert_true(s.sound);
    then_it_holds_together(&s.overlay);
    assert_int_equal(s.overlay.face_count, 1);
    assert_int_equal(s.overlay.faces[0].loop_count, 2);
    assert_near(face_area(&s.overlay, 0), 12.0, 1e-12);
    free_scene(&s);
}

static void given_a_cut_through_the_hole_then_two_faces_share_two_edges(void **state)
{
    scene s = given_a_frame();
    when_cut(&s, 1, (double[]){1.5}, 0, (double[]){0}, 0.1);
    assert_true(s.sound);
    then_it_holds_together(&s.overlay);
    assert_int_equal(s.overlay.face_count, 2);
    assert_int_equal(shared_edges(&s.overlay), 2);
    assert_near(face_area(&s.overlay, 0) + face_area(&s.overlay, 1), 12.0, 1e-12);
    for (size_t f = 0; f < 2; f++) {
        assert_int_equal(s.overlay.faces[f].loop_count, 1);
        assert_near(face_area(&s.overlay, f), s.overlay.faces[f].cell[0] ? 7.0 : 5.0, 1e-12);
    }
    free_scene(&s);
}

static void given_cuts_in_both_directions_then_they_meet_in_one_node(void **state)
{
    scene s = given_a_frame();
    when_cut(&s, 2, (double[]){0.5, 2.0}, 1, (double[]){0.25}, 0.01);
    assert_true(s.sound);
    then_it_holds_together(&s.overlay);
    /* 3 columns x 2 rows; the hole cuts the wide cell above in the middle in two, each with a leg
     */
    assert_int_equal(s.overlay.face_count, 6);
    double area = 0.0;
    size_t meetings = 0;
    for (size_t f = 0; f < s.overlay.face_count; f++)
        area += face_area(&s.overlay, f);
    for (size_t i = 0; i < s.overlay.node_count; i++)
        meetings += s.overlay.nodes[2 * i + 1] == 0.25 &&
            (s.overlay.nodes[2 * i] == 0.5 || s.overlay.nodes[2 * i] == 2.0);
    assert_near(area, 12.0, 1e-12);
    assert_int_equal(meetings, 2);
    free_scene(&s);
}

static void given_a_corner_on_a_cut_then_it_is_the_node(void **state)
{
    static const double corners[][2] = {{2, 0}, {4, 2}, {2, 4}, {0, 2}};
    scene s = given_rings(corners, (size_t[]){4}, 1);
    when_cut(&s, 1, (double[]){2.0}, 1, (double[]){2.0}, 0.1);
    assert_true(s.sound);
    then_it_holds_together(&s.overlay);
    assert_int_equal(s.overlay.face_count, 4);
    assert_int_equal(s.overlay.node_count, 5);
    assert_int_equal(s.overlay.edge_count, 8);
    for (size_t f = 0; f < 4; f++)
        assert_near(face_area(&s.overlay, f), 2.0, 1e-12);
    free_scene(&s);
}

static void given_a_sliver_beyond_a_cut_then_it_is_left_out(void **state)
{
    static const double corners[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    scene s = given_rings(corners, (size_t[]){4}, 1);
    when_cut(&s, 1, (double[]){3.8}, 0, (double[]){0}, 0.5);
    assert_true(s.sound);
    then_it_holds_together(&s.overlay);
    assert_int_equal(s.overlay.face_count, 1);
    assert_int_equal(shared_edges(&s.overlay), 0);
    assert_near(face_area(&s.overlay, 0), 3.8 * 4.0, 1e-12);
    free_scene(&s);
}

static void given_rings_that_cross_then_they_are_not_simple(void **state)
{
    static const double bow[][2] = {{0, 0}, {4, 4}, {4, 0}, {0, 4}};
    static const double apart[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {3, 3}, {3, 5}, {5, 5}};
    bool simple = true;
    scene s = given_rings(bow, (size_t[]){4}, 1);
    assert_int_equal(crease_frontier_is_simple(s.context, &s.frontier, &simple), CREASE_OK);
    assert_false(simple);
    free_scene(&s);
    s = given_rings(apart, (size_t[]){4, 3}, 2);
    assert_int_equal(crease_frontier_is_simple(s.context, &s.frontier, &simple), CREASE_OK);
    assert_false(simple);
    free_scene(&s);
    s = given_a_frame();
    assert_int_equal(crease_frontier_is_simple(s.context, &s.frontier, &simple), CREASE_OK);
    assert_true(simple);
    free_scene(&s);
}

static void given_a_hole_alone_then_it_is_no_border(void **state)
{
    static const double corners[][2] = {{0, 0}, {0, 4}, {4, 4}, {4, 0}};
    scene s = given_rings(corners, (size_t[]){4}, 1);
    when_cut(&s, 0, (double[]){0}, 0, (double[]){0}, 0.1);
    assert_false(s.sound);
    assert_int_equal(s.overlay.face_count, 0);
    free_scene(&s);
}

static void given_failing_allocations_then_each_is_reported(void **state)
{
    scene s = given_a_frame();
    crease_status status = CREASE_ERROR_NO_MEMORY;
    const double x = 1.5, y = 2.5;
    s.given = (crease_cuts){{1, 1}, {&x, &y}};
    int failed = 0;
    for (int n = 0; status != CREASE_OK; n++) {
        atomic_store(&s.context->allocations, n);
        status = crease_overlay_find(s.context, &s.frontier, &s.given, 0.1, &s.overlay, &s.sound);
        atomic_store(&s.context->allocations, -1);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
        failed += status != CREASE_OK;
    }
    assert_true(failed > 10);
    assert_true(s.sound);
    free_scene(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_no_cut_then_one_face_with_its_hole),
        cmocka_unit_test(given_a_cut_through_the_hole_then_two_faces_share_two_edges),
        cmocka_unit_test(given_cuts_in_both_directions_then_they_meet_in_one_node),
        cmocka_unit_test(given_a_corner_on_a_cut_then_it_is_the_node),
        cmocka_unit_test(given_a_sliver_beyond_a_cut_then_it_is_left_out),
        cmocka_unit_test(given_rings_that_cross_then_they_are_not_simple),
        cmocka_unit_test(given_a_hole_alone_then_it_is_no_border),
        cmocka_unit_test(given_failing_allocations_then_each_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
