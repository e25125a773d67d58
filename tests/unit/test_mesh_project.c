/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "mesh/mesh.h"

enum { PLACES = 2000 };

/* The cube from 0 to 1, two triangles a side, its corners shared, seen counterclockwise from
 * outside. */
static crease_mesh unit_cube(void)
{
    static double vertices[24];
    static uint32_t triangles[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3,
        3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    for (size_t i = 0; i < 24; i++)
        vertices[i] = (double)(((i / 3) >> (i % 3)) & 1);
    return (crease_mesh){
        .vertex_count = 8, .triangle_count = 12, .vertices = vertices, .triangles = triangles};
}

static double coordinate(uint64_t draw)
{
    return 3.0 * crease_random_uniform(7, 0, draw) - 1.0;
}

/* Signed distance from the unit cube, positive outside. */
static double from_cube(const double p[3])
{
    double outside = 0.0, inside = -INFINITY;
    for (int c = 0; c < 3; c++) {
        const double away = fabs(p[c] - 0.5) - 0.5;
        outside += away > 0.0 ? away * away : 0.0;
        inside = fmax(inside, away);
    }
    return outside > 0.0 ? sqrt(outside) : inside;
}

static void given_a_cube_when_projecting_then_distances_are_exact_and_signed(void **state)
{
    crease_context *context = given_context();
    const crease_mesh mesh = unit_cube();
    static double places[3 * PLACES];
    static crease_mesh_foot feet[PLACES];
    for (size_t i = 0; i < 3 * PLACES; i++)
        places[i] = coordinate(i);
    assert_int_equal(crease_mesh_project(context, &mesh, places, PLACES, feet), CREASE_OK);
    for (size_t i = 0; i < PLACES; i++) {
        assert_near(feet[i].distance, from_cube(places + 3 * i), 1e-12);
        assert_near(from_cube(feet[i].point), 0.0, 1e-12);
        assert_true(feet[i].triangle < 12);
    }
    crease_context_free(context);
}

static void given_places_at_an_edge_when_projecting_then_the_facing_side_gives_the_sign(
    void **state)
{
    crease_context *context = given_context();
    const crease_mesh mesh = unit_cube();
    const double places[] = {1.5, 1.01, 0.5, 1.2, 1.2, 1.2, -1e-7, -1e-6, 0.5, 1, 1, 0.25};
    crease_mesh_foot feet[4];
    assert_int_equal(crease_mesh_project(context, &mesh, places, 4, feet), CREASE_OK);
    assert_near(feet[0].distance, sqrt(0.25 + 1e-4), 1e-15);
    assert_near(feet[1].distance, 0.2 * sqrt(3.0), 1e-15);
    assert_near(feet[2].distance, sqrt(1.01) * 1e-6, 1e-18);
    assert_true(feet[3].distance == 0.0);
    crease_context_free(context);
}

/* A wavy strip of many triangles, some without area. */
static crease_mesh strip(void)
{
    enum { COLUMNS = 300 };
    static double vertices[6 * COLUMNS];
    static uint32_t triangles[6 * (COLUMNS - 1)];
    for (size_t i = 0; i < 2 * COLUMNS; i++) {
        const double x = 0.01 * (double)(i / 2);
        vertices[3 * i] = i % 14 == 4 ? x - 0.01 : x;
        vertices[3 * i + 1] = 0.3 * (double)(i % 2);
        vertices[3 * i + 2] = 0.2 * sin(9.0 * x);
    }
    for (uint32_t i = 0; i < 2 * (COLUMNS - 1); i++)
        for (uint32_t corner = 0; corner < 3; corner++)
            triangles[3 * i + corner] = i + corner;
    return (crease_mesh){.vertex_count = 2 * COLUMNS,
        .triangle_count = 2 * (COLUMNS - 1),
        .vertices = vertices,
        .triangles = triangles};
}

static void given_many_triangles_when_projecting_then_one_by_one_gives_the_same(void **state)
{
    crease_context *context = given_context();
    const crease_mesh mesh = strip();
    static double places[3 * PLACES];
    static crease_mesh_foot feet[PLACES];
    for (size_t i = 0; i < 3 * PLACES; i++)
        places[i] = coordinate(i);
    assert_int_equal(crease_mesh_project(context, &mesh, places, PLACES, feet), CREASE_OK);
    for (size_t i = 0; i < 100; i++) {
        double least = INFINITY;
        for (size_t t = 0; t < mesh.triangle_count; t++) {
            const crease_mesh one = {.vertex_count = mesh.vertex_count,
                .triangle_count = 1,
                .vertices = mesh.vertices,
                .triangles = mesh.triangles + 3 * t};
            crease_mesh_foot foot;
            assert_int_equal(
                crease_mesh_project(context, &one, places + 3 * i, 1, &foot), CREASE_OK);
            least = fmin(least, fabs(foot.distance));
        }
        assert_near(fabs(feet[i].distance), least, 1e-14);
    }
    crease_context_free(context);
}

static void given_other_thread_counts_when_projecting_then_the_bytes_are_the_same(void **state)
{
    const crease_mesh mesh = strip();
    static double places[3 * PLACES];
    static crease_mesh_foot feet[2][PLACES];
    for (size_t i = 0; i < 3 * PLACES; i++)
        places[i] = coordinate(i);
    for (int i = 0; i < 2; i++) {
        crease_context *context = given_context_with_threads(i ? 4 : 1);
        assert_int_equal(crease_mesh_project(context, &mesh, places, PLACES, feet[i]), CREASE_OK);
        crease_context_free(context);
    }
    for (size_t i = 0; i < PLACES; i++) {
        assert_memory_equal(feet[0][i].point, feet[1][i].point, sizeof feet[0][i].point);
        assert_true(feet[0][i].distance == feet[1][i].distance);
        assert_int_equal(feet[0][i].triangle, feet[1][i].triangle);
    }
}

static void given_triangles_when_made_a_mesh_then_it_is_them_with_normals(void **state)
{
    crease_context *context = given_context();
    const crease_mesh cube = unit_cube();
    crease_mesh_parts parts = {.vertex_count = 8,
        .triangle_count = 12,
        .vertices = cube.vertices,
        .triangles = cube.triangles};
    crease_mesh *mesh = NULL;
    assert_int_equal(crease_mesh_from_parts(context, &parts, &mesh), CREASE_OK);
    assert_memory_equal(crease_mesh_vertices(mesh), cube.vertices, 24 * sizeof(double));
    assert_memory_equal(crease_mesh_triangles(mesh), cube.triangles, 36 * sizeof(uint32_t));
    for (size_t i = 0; i < 12; i++)
        assert_int_equal(crease_mesh_owners(mesh)[i], 0);
    for (size_t i = 0; i < 24; i++) /* outwards */
        assert_true((crease_mesh_normals(mesh)[i] > 0.1) == (cube.vertices[i] > 0.5));
    crease_mesh_free(mesh);
    parts.vertex_count = 7;
    assert_int_equal(crease_mesh_from_parts(context, &parts, &mesh), CREASE_ERROR_ARGUMENT);
    assert_null(mesh);
    crease_context_free(context);
}

static void given_bad_input_when_projecting_then_it_is_refused(void **state)
{
    crease_context *context = given_context();
    const crease_mesh none = {0}, mesh = unit_cube();
    const double places[] = {0, 0, 0, NAN, 0, 0};
    crease_mesh_foot feet[2];
    assert_int_equal(crease_mesh_project(context, &none, places, 1, feet), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_mesh_project(context, &mesh, places, 2, feet), CREASE_ERROR_VALUE);
    assert_non_null(strstr(crease_context_message(context), "point 1"));
    for (long failing = 0; failing < 5; failing++) {
        crease_context_fail_allocation(context, failing);
        assert_int_equal(
            crease_mesh_project(context, &mesh, places, 1, feet), CREASE_ERROR_NO_MEMORY);
    }
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_cube_when_projecting_then_distances_are_exact_and_signed),
        cmocka_unit_test(
            given_places_at_an_edge_when_projecting_then_the_facing_side_gives_the_sign),
        cmocka_unit_test(given_many_triangles_when_projecting_then_one_by_one_gives_the_same),
        cmocka_unit_test(given_other_thread_counts_when_projecting_then_the_bytes_are_the_same),
        cmocka_unit_test(given_triangles_when_made_a_mesh_then_it_is_them_with_normals),
        cmocka_unit_test(given_bad_input_when_projecting_then_it_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
