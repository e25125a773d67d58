/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Sheets that end where their points do: areas, holes, edges shared, what OpenCASCADE says. */
#include "given.h"

#include "base/random.h"
#include "crease/crease_cad.h"

#include <stdlib.h>
#include <unistd.h>

enum { MOST = 12000 };

static const uint64_t SIDE = 50;
static const double S = 1.0 / 50.0;
static const double PI = 3.14159265358979323846;

typedef struct scene {
    crease_context *context;
    size_t count;
    double points[MOST][3];
    crease_cloud *cloud;
    crease_sheet *sheet;
    crease_trim *trim;
    crease_mesh *mesh;
} scene;

typedef bool region(double x, double y);
typedef double height(double x, double y);

static double wave(double x, double y)
{
    return 0.1 * sin(3.0 * x) + 0.05 * y * y;
}

static double roof(double x, double y)
{
    const double across = (x - 0.5) * cos(0.35) + (y - 0.5) * sin(0.35);
    return -0.5 * fabs(across);
}

static double level_roof(double x, double y)
{
    (void)y;
    return -0.5 * fabs(x - 0.5);
}

static bool square(double x, double y)
{
    (void)x, (void)y;
    return true;
}

static bool ring(double x, double y)
{
    const double r = hypot(x - 0.5, y - 0.5);
    return r < 0.5 && r > 0.2;
}

static bool beside_a_hole(double x, double y)
{
    return hypot(x - 0.5, y - 0.5) > 0.2;
}

/* A hole as long as one missing point and its neighbours make it. */
static bool but_for_two(double x, double y)
{
    return fabs(x - 0.5) > 1.0 * S || fabs(y - 0.5) > 1.0 * S;
}

/* A random place in each cell of a grid over the unit square, where the region has it. */
static scene *given(region *has, height *z)
{
    scene *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->context = given_context();
    for (uint64_t i = 0; i < SIDE * SIDE; i++) {
        const double x = S * ((double)(i / SIDE) + crease_random_uniform(5, 1, i));
        const double y = S * ((double)(i % SIDE) + crease_random_uniform(5, 2, i));
        if (!has(x, y))
            continue;
        s->points[s->count][0] = x;
        s->points[s->count][1] = y;
        s->points[s->count++][2] = z(x, y);
    }
    s->cloud = given_cloud_of(s->context, s->points[0], s->count);
    return s;
}

static void when_trimmed(scene *s)
{
    assert_int_equal(crease_sheet_fit(s->context, s->cloud, NULL, &s->sheet), CREASE_OK);
    assert_int_equal(crease_sheet_trim(s->context, s->sheet, &s->trim), CREASE_OK);
    assert_int_equal(crease_cad_trim_mesh(s->context, s->trim, 0.0, &s->mesh), CREASE_OK);
}

static void free_scene(scene *s)
{
    crease_mesh_free(s->mesh);
    crease_trim_free(s->trim);
    crease_sheet_free(s->sheet);
    crease_cloud_free(s->cloud);
    crease_context_free(s->context);
    free(s);
}

/* Area of the mesh, seen along z. */
static double area_of(const scene *s)
{
    const double *const p = crease_mesh_vertices(s->mesh);
    const uint32_t *t = crease_mesh_triangles(s->mesh);
    double area = 0.0;
    for (size_t i = 0; i < crease_mesh_triangle_count(s->mesh); i++, t += 3) {
        const double *const a = p + 3 * (size_t)t[0], *const b = p + 3 * (size_t)t[1];
        const double *const c = p + 3 * (size_t)t[2];
        area += 0.5 * fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    }
    return area;
}

static size_t holes_of(const scene *s)
{
    size_t holes = 0;
    for (size_t f = 0; f < crease_trim_face_count(s->trim); f++)
        holes += crease_trim_loop_count(s->trim, f) - 1;
    return holes;
}

static size_t shared_edges(const scene *s)
{
    size_t count = 0;
    for (size_t i = 0; i < crease_trim_edge_count(s->trim); i++) {
        const crease_trim_edge edge = crease_trim_edge_at(s->trim, i);
        count += edge.faces[0] >= 0 && edge.faces[1] >= 0;
    }
    return count;
}

/* Every point is on a face, or about a spacing beside one. */
static void then_points_are_on_it(const scene *s)
{
    crease_mesh_foot *const feet = calloc(s->count, sizeof *feet);
    size_t beside = 0;
    assert_non_null(feet);
    assert_int_equal(
        crease_mesh_project(s->context, s->mesh, s->points[0], s->count, feet), CREASE_OK);
    for (size_t i = 0; i < s->count; i++) {
        assert_true(fabs(feet[i].distance) < 1.2 * S);
        beside += fabs(feet[i].distance) > 0.5 * S;
    }
    assert_true(beside < s->count / 200);
    free(feet);
}

static crease_cad_info written(const scene *s, const char *extension)
{
    char path[64];
    crease_cad_info info;
    snprintf(path, sizeof path, "/tmp/crease-trim-%d.%s", (int)getpid(), extension);
    assert_int_equal(crease_cad_trim_write(s->context, s->trim, path), CREASE_OK);
    assert_int_equal(crease_cad_info_read(s->context, path, &info), CREASE_OK);
    remove(path);
    assert_true(info.valid);
    return info;
}

static void given_a_ring_then_its_area_and_one_hole(void **state)
{
    scene *s = given(ring, wave);
    when_trimmed(s);
    assert_false(crease_trim_is_whole(s->trim));
    assert_int_equal(crease_trim_face_count(s->trim), 1);
    assert_int_equal(holes_of(s), 1);
    /* the border is known to a third of a spacing */
    assert_near(area_of(s), PI * (0.25 - 0.04), 0.35 * S * 2.0 * PI * 0.7);
    then_points_are_on_it(s);
    const crease_cad_info info = written(s, "step");
    assert_int_equal(info.faces, 1);
    assert_int_equal(info.free_edges, 2);
    free_scene(s);
}

static void given_a_roof_with_a_hole_across_then_faces_share_the_crease(void **state)
{
    static const char *const extensions[] = {"step", "iges", "brep"};
    scene *s = given(beside_a_hole, roof);
    when_trimmed(s);
    assert_false(crease_trim_is_whole(s->trim));
    assert_int_equal(crease_trim_face_count(s->trim), 2);
    assert_int_equal(shared_edges(s), 2);
    assert_int_equal(crease_trim_crease_count(s->trim), 2);
    assert_near(area_of(s), 1.0 - PI * 0.04, 0.35 * S * (4.0 + 2.0 * PI * 0.2));
    then_points_are_on_it(s);
    for (size_t i = 0; i < 3; i++) {
        const crease_cad_info info = written(s, extensions[i]);
        assert_int_equal(info.faces, 2);
        assert_int_equal(info.sharp_edges, i == 1 ? info.sharp_edges : 2);
    }
    free_scene(s);
}

/* The crease ends at the border. */
static void given_creases_then_they_end_where_the_points_do(void **state)
{
    scene *s = given(beside_a_hole, roof);
    when_trimmed(s);
    double length = 0.0;
    for (size_t i = 0; i < crease_trim_crease_count(s->trim); i++) {
        const crease_curve *const curve = crease_trim_creases(s->trim)[i];
        double domain[2], a[3], b[3];
        crease_curve_domain(curve, domain);
        crease_curve_evaluate(curve, domain[0], CREASE_SIDE_RIGHT, 0, a);
        crease_curve_evaluate(curve, domain[1], CREASE_SIDE_LEFT, 0, b);
        length += hypot(b[0] - a[0], b[1] - a[1]);
    }
    assert_near(length, 1.0 / cos(0.35) - 0.4, 3.0 * S);
    free_scene(s);
}

static void given_points_that_fill_the_rectangle_then_it_stays_whole(void **state)
{
    region *const regions[] = {square, but_for_two};
    for (size_t i = 0; i < 2; i++) {
        scene *s = given(regions[i], level_roof);
        when_trimmed(s);
        assert_true(crease_trim_is_whole(s->trim));
        assert_int_equal(crease_trim_face_count(s->trim), 2);
        assert_int_equal(holes_of(s), 0);
        assert_int_equal(crease_trim_edge_count(s->trim), 7);
        assert_int_equal(written(s, "step").faces, 2);
        free_scene(s);
    }
}

static void given_a_hole_inside_a_full_rectangle_then_its_sides_stay(void **state)
{
    scene *s = given(beside_a_hole, level_roof);
    double domain[2];
    size_t on_sides = 0;
    when_trimmed(s);
    assert_false(crease_trim_is_whole(s->trim));
    for (size_t i = 0; i < crease_trim_edge_count(s->trim); i++) {
        const crease_trim_edge edge = crease_trim_edge_at(s->trim, i);
        const double *const p = crease_curve_control_points(edge.curve);
        const size_t last = 3 * (crease_curve_count(edge.curve) - 1);
        for (int d = 0; d < 2; d++) {
            crease_surface_domain(crease_sheet_surface(s->sheet), d, domain);
            on_sides += crease_curve_order(edge.curve) == 2 && p[d] == p[last + (size_t)d] &&
                (p[d] == domain[0] || p[d] == domain[1]);
        }
    }
    assert_int_equal(on_sides, 6); /* two sides are cut by the crease */
    free_scene(s);
}

static void given_the_papers_sheet_then_it_stays_whole(void **state)
{
    scene *s = given(ring, wave);
    assert_int_equal(crease_averaging_fit(s->context, s->cloud, NULL, &s->sheet), CREASE_OK);
    assert_int_equal(crease_sheet_trim(s->context, s->sheet, &s->trim), CREASE_OK);
    assert_true(crease_trim_is_whole(s->trim));
    assert_null(crease_sheet_parameters(s->sheet));
    free_scene(s);
}

static void given_one_or_more_threads_then_the_same_trimming(void **state)
{
    double vertices[2][64];
    size_t counts[2];
    for (int i = 0; i < 2; i++) {
        scene *s = given(beside_a_hole, roof);
        crease_context_free(s->context);
        s->context = given_context_with_threads(i ? 3 : 1);
        when_trimmed(s);
        counts[i] = crease_trim_vertex_count(s->trim);
        assert_true(2 * counts[i] <= 64);
        memcpy(vertices[i], crease_trim_vertices(s->trim), 2 * counts[i] * sizeof(double));
        free_scene(s);
    }
    assert_int_equal(counts[0], counts[1]);
    assert_memory_equal(vertices[0], vertices[1], 2 * counts[0] * sizeof(double));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_ring_then_its_area_and_one_hole),
        cmocka_unit_test(given_a_roof_with_a_hole_across_then_faces_share_the_crease),
        cmocka_unit_test(given_creases_then_they_end_where_the_points_do),
        cmocka_unit_test(given_points_that_fill_the_rectangle_then_it_stays_whole),
        cmocka_unit_test(given_a_hole_inside_a_full_rectangle_then_its_sides_stay),
        cmocka_unit_test(given_the_papers_sheet_then_it_stays_whole),
        cmocka_unit_test(given_one_or_more_threads_then_the_same_trimming),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
