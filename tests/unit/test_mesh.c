/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "spline/knots.h"
#include "spline/project.h"
#include "spline/surface.h"

typedef void net_field(double u, double v, double point[3]);

/* A bicubic clamped surface over the unit square whose net follows a field; the knot `crease` in u
 * has multiplicity 3 (none when it is 0). */
static crease_surface *surface_of(
    crease_context *context, size_t count, double crease, net_field *field)
{
    double clamped[48], knots[2][48], greville[2][48];
    static double points[3 * 40 * 40];
    crease_knots_clamped(4, count, 0.0, 1.0, clamped);
    const size_t rows =
        crease > 0.0 ? crease_knots_raise(clamped, 4, count, crease, 3, knots[0]) : count;
    if (crease <= 0.0)
        memcpy(knots[0], clamped, sizeof clamped);
    memcpy(knots[1], clamped, sizeof clamped);
    crease_knots_greville(knots[0], 4, rows, greville[0]);
    crease_knots_greville(knots[1], 4, count, greville[1]);
    for (size_t i = 0; i < rows * count; i++)
        field(greville[0][i / count], greville[1][i % count], points + 3 * i);
    const crease_surface_parts parts = {.order = {4, 4},
        .count = {rows, count},
        .knots = {knots[0], knots[1]},
        .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    return surface;
}

static void flat(double u, double v, double point[3])
{
    point[0] = 3 * u;
    point[1] = 2 * v;
    point[2] = 1;
}

static void roof(double u, double v, double point[3])
{
    point[0] = u;
    point[1] = v;
    point[2] = -fabs(u - 0.4);
}

static void hills(double u, double v, double point[3])
{
    point[0] = u;
    point[1] = v;
    point[2] = 0.2 * sin(7 * u) * cos(5 * v) + 0.3 * fabs(u - 0.4);
}

/* Not the surface of revolution itself, but a net around it: a full turn, closed. */
static void tube(double u, double v, double point[3])
{
    const double angle = 4 * acos(0.0) * u;
    point[0] = cos(angle);
    point[1] = u > 0.0 && u < 1.0 ? sin(angle) : 0.0;
    point[2] = v;
}

static void cone(double u, double v, double point[3])
{
    point[0] = u * cos(v);
    point[1] = u * sin(v);
    point[2] = u;
}

static const double *vertex(const crease_mesh *mesh, size_t triangle, int corner)
{
    return crease_mesh_vertices(mesh) +
        3 * (size_t)crease_mesh_triangles(mesh)[3 * triangle + (size_t)corner];
}

/* Twice the area as a vector. */
static void normal_of(const crease_mesh *mesh, size_t triangle, double out[3])
{
    const double *const a = vertex(mesh, triangle, 0);
    const double *const b = vertex(mesh, triangle, 1);
    const double *const c = vertex(mesh, triangle, 2);
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        out[k] = (b[l] - a[l]) * (c[m] - a[m]) - (b[m] - a[m]) * (c[l] - a[l]);
    }
}

static double area(const crease_mesh *mesh)
{
    double sum = 0;
    for (size_t i = 0; i < crease_mesh_triangle_count(mesh); i++) {
        double n[3];
        normal_of(mesh, i, n);
        sum += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    }
    return sum;
}

static crease_mesh *mesh_of(
    crease_context *context, const crease_surface *const *surfaces, size_t count, double tolerance)
{
    crease_mesh *mesh = NULL;
    assert_int_equal(crease_mesh_create(context, surfaces, count, tolerance, &mesh), CREASE_OK);
    return mesh;
}

typedef struct side {
    double ends[2][3];
} side;

static int compare_sides(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(side));
}

/* Total length of the triangle sides that no other triangle shares to the last bit. */
static double open_length(const crease_mesh *mesh)
{
    const size_t count = 3 * crease_mesh_triangle_count(mesh);
    side *sides = calloc(count, sizeof *sides);
    assert_non_null(sides);
    for (size_t i = 0; i < count; i++) {
        const double *const a = vertex(mesh, i / 3, (int)(i % 3));
        const double *const b = vertex(mesh, i / 3, (int)((i + 1) % 3));
        const bool swap = memcmp(a, b, 3 * sizeof *a) > 0;
        memcpy(sides[i].ends[0], swap ? b : a, 3 * sizeof *a);
        memcpy(sides[i].ends[1], swap ? a : b, 3 * sizeof *a);
    }
    qsort(sides, count, sizeof *sides, compare_sides);
    double length = 0;
    for (size_t i = 0, same = 1; i < count; i += same) {
        for (same = 1; i + same < count && compare_sides(&sides[i], &sides[i + same]) == 0;)
            same++;
        const double *const a = sides[i].ends[0];
        const double *const b = sides[i].ends[1];
        if (same == 1)
            length += sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
    }
    free(sides);
    return length;
}

static void given_a_plane_then_two_triangles_for_each_pair_of_spans(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 6, 0, flat);
    crease_mesh *mesh = mesh_of(context, (const crease_surface *const *)&surface, 1, 0);
    assert_int_equal(crease_mesh_triangle_count(mesh), 2 * 3 * 3);
    assert_int_equal(crease_mesh_vertex_count(mesh), 4 * 4);
    assert_near(area(mesh), 6.0, 1e-13);
    for (size_t i = 0; i < 16; i++)
        assert_near(crease_mesh_normals(mesh)[3 * i + 2], 1.0, 1e-15);
    for (size_t i = 0; i < crease_mesh_triangle_count(mesh); i++) {
        double n[3];
        normal_of(mesh, i, n);
        assert_true(n[2] > 0);
        assert_int_equal(crease_mesh_owners(mesh)[i], 0);
    }
    crease_mesh_free(mesh);
    crease_surface_free(surface);
    crease_context_free(context);
}

/* Deviation measured by projecting points of the triangles. */
static void given_a_tolerance_then_no_triangle_is_farther_from_the_surface(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 12, 0.4, hills);
    size_t before = 0;
    for (double tolerance = 1e-2; tolerance > 5e-4; tolerance /= 4) {
        crease_mesh *mesh = mesh_of(context, (const crease_surface *const *)&surface, 1, tolerance);
        const size_t count = crease_mesh_triangle_count(mesh);
        assert_true(count > before);
        before = count;
        double *points = calloc(4 * count, 3 * sizeof *points);
        crease_foot *feet = calloc(4 * count, sizeof *feet);
        assert_true(points && feet);
        static const double places[4][3] = {
            {1. / 3, 1. / 3, 1. / 3}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}};
        for (size_t i = 0; i < 4 * count; i++)
            for (int corner = 0; corner < 3; corner++)
                for (int c = 0; c < 3; c++)
                    points[3 * i + (size_t)c] +=
                        places[i % 4][corner] * vertex(mesh, i / 4, corner)[c];
        assert_int_equal(
            crease_surface_project(context, surface, points, 4 * count, feet), CREASE_OK);
        double worst = 0;
        for (size_t i = 0; i < 4 * count; i++)
            worst = fmax(worst, fabs(feet[i].distance));
        assert_true(worst <= tolerance);
        assert_true(worst > tolerance / 50);
        free(points);
        free(feet);
        crease_mesh_free(mesh);
    }
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_a_crease_inside_then_normals_stay_sharp_and_no_gap_opens(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 8, 0.4, roof);
    crease_mesh *mesh = mesh_of(context, (const crease_surface *const *)&surface, 1, 0);
    assert_near(area(mesh), sqrt(2.0), 1e-12);
    for (size_t i = 0; i < 3 * crease_mesh_triangle_count(mesh); i++) {
        const uint32_t v = crease_mesh_triangles(mesh)[i];
        double n[3];
        normal_of(mesh, i / 3, n);
        const double *const normal = crease_mesh_normals(mesh) + 3 * (size_t)v;
        assert_near(fabs(normal[0]), sqrt(0.5), 1e-12);
        assert_true(n[0] * normal[0] > 0);
    }
    const double outline = 2 + 2 * sqrt(2.0);
    assert_near(open_length(mesh), outline, 1e-12);
    crease_surface *lower = NULL, *upper = NULL;
    assert_int_equal(crease_surface_split(context, surface, 0, 0.4, &lower, &upper), CREASE_OK);
    const crease_surface *const pieces[2] = {lower, upper};
    crease_mesh *split = mesh_of(context, pieces, 2, 0);
    assert_near(open_length(split), outline, 1e-12);
    assert_int_equal(crease_mesh_vertex_count(split), crease_mesh_vertex_count(mesh));
    crease_mesh_free(split);
    crease_mesh_free(mesh);
    crease_surface_free(lower);
    crease_surface_free(upper);
    crease_surface_free(surface);
    crease_context_free(context);
}

static crease_surface *reversed(crease_context *context, const crease_surface *surface)
{
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    const size_t count = parts.count[0] * parts.count[1];
    double *points = calloc(count, 3 * sizeof *points);
    double knots[2][48];
    assert_non_null(points);
    for (size_t i = 0; i < count; i++)
        memcpy(points + 3 * i, parts.control_points + 3 * (count - 1 - i), 3 * sizeof *points);
    for (int d = 0; d < 2; d++) {
        const size_t total = parts.count[d] + (size_t)parts.order[d];
        for (size_t i = 0; i < total; i++)
            knots[d][i] = 5.0 - 2.0 * parts.knots[d][total - 1 - i];
    }
    crease_surface_parts turned = parts;
    turned.knots[0] = knots[0];
    turned.knots[1] = knots[1];
    turned.control_points = points;
    crease_surface *out = NULL;
    assert_int_equal(crease_surface_create(context, &turned, &out), CREASE_OK);
    free(points);
    return out;
}

/* Four pieces around a corner, one turned round, one with u and v exchanged: only the outline is
 * open, although each piece asks for other divisions. */
static void given_pieces_in_any_orientation_then_the_mesh_is_watertight(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 9, 0.4, hills);
    crease_surface *halves[2], *pieces[6] = {NULL};
    assert_int_equal(
        crease_surface_split(context, surface, 0, 0.4, &halves[0], &halves[1]), CREASE_OK);
    for (int i = 0; i < 2; i++)
        assert_int_equal(
            crease_surface_split(context, halves[i], 1, 0.7, &pieces[2 * i], &pieces[2 * i + 1]),
            CREASE_OK);
    pieces[4] = reversed(context, pieces[1]);
    assert_int_equal(crease_surface_transpose(context, pieces[2], &pieces[5]), CREASE_OK);
    const crease_surface *const chosen[4] = {pieces[0], pieces[4], pieces[5], pieces[3]};
    crease_mesh *mesh = mesh_of(context, chosen, 4, 1e-3);
    crease_mesh *whole = mesh_of(context, (const crease_surface *const *)&surface, 1, 1e-3);
    assert_near(open_length(mesh), open_length(whole), 2e-3);
    assert_near(area(mesh), area(whole), 1e-3);
    uint32_t last = 0;
    for (size_t i = 0; i < crease_mesh_triangle_count(mesh); i++)
        last = crease_mesh_owners(mesh)[i];
    assert_int_equal(last, 3);
    crease_mesh_free(whole);
    crease_mesh_free(mesh);
    for (int i = 0; i < 6; i++)
        crease_surface_free(pieces[i]);
    crease_surface_free(halves[0]);
    crease_surface_free(halves[1]);
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_a_surface_that_closes_then_its_seam_is_closed(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 30, 0, tube);
    crease_mesh *mesh = mesh_of(context, (const crease_surface *const *)&surface, 1, 1e-3);
    double rim = 0;
    for (int i = 0; i < 20000; i++) {
        double a[3], b[3];
        crease_surface_point(surface, (const double[2]){i / 20000.0, 0}, a);
        crease_surface_point(surface, (const double[2]){(i + 1) / 20000.0, 0}, b);
        rim += hypot(a[0] - b[0], a[1] - b[1]);
    }
    assert_near(open_length(mesh), 2 * rim, 1e-2);
    assert_near(area(mesh), rim, 1e-2);
    crease_mesh_free(mesh);
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_a_collapsed_border_then_triangles_without_area_are_left_out(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 5, 0, cone);
    crease_mesh *mesh = mesh_of(context, (const crease_surface *const *)&surface, 1, 1e-3);
    for (size_t i = 0; i < crease_mesh_triangle_count(mesh); i++) {
        double n[3];
        normal_of(mesh, i, n);
        assert_true(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 0);
    }
    for (size_t i = 0; i < crease_mesh_vertex_count(mesh); i++) {
        const double *const n = crease_mesh_normals(mesh) + 3 * i;
        assert_near(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1.0, 1e-12);
        assert_near(fabs(n[2]), sqrt(0.5), 2e-2);
    }
    crease_mesh_free(mesh);
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_any_number_of_threads_then_meshes_are_the_same_bytes(void **state)
{
    crease_mesh *meshes[2] = {NULL};
    for (int threads = 1; threads <= 4; threads++) {
        crease_context *context = given_context_with_threads(threads);
        crease_surface *surface = surface_of(context, 9, 0.4, hills);
        const int i = threads > 1;
        meshes[i] = mesh_of(context, (const crease_surface *const *)&surface, 1, 1e-3);
        if (i) {
            const size_t size = 3 * crease_mesh_vertex_count(meshes[0]) * sizeof(double);
            assert_memory_equal(
                crease_mesh_vertices(meshes[0]), crease_mesh_vertices(meshes[1]), size);
            assert_memory_equal(
                crease_mesh_normals(meshes[0]), crease_mesh_normals(meshes[1]), size);
            crease_mesh_free(meshes[1]);
        }
        crease_surface_free(surface);
        crease_context_free(context);
    }
    crease_mesh_free(meshes[0]);
}

static void given_wrong_arguments_or_no_memory_then_it_is_said(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 5, 0, hills);
    const crease_surface *const list[2] = {surface, surface};
    crease_mesh *mesh = NULL;
    assert_int_equal(crease_mesh_create(context, list, 1, -1.0, &mesh), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_mesh_create(context, list, 1, NAN, &mesh), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_mesh_create(context, list, 0, 0.0, &mesh), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_mesh_create(context, list, 1, 1e-300, &mesh), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "larger"));
    assert_int_equal(crease_mesh_create(context, list, 1, 1e-13, &mesh), CREASE_ERROR_ARGUMENT);
    int failures = 0;
    crease_context_fail_allocation(context, failures);
    while (crease_mesh_create(context, list, 2, 0.1, &mesh) == CREASE_ERROR_NO_MEMORY) {
        assert_null(mesh);
        crease_context_fail_allocation(context, ++failures);
    }
    assert_true(failures > 30);
    crease_mesh_free(mesh);
    crease_surface_free(surface);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_plane_then_two_triangles_for_each_pair_of_spans),
        cmocka_unit_test(given_a_tolerance_then_no_triangle_is_farther_from_the_surface),
        cmocka_unit_test(given_a_crease_inside_then_normals_stay_sharp_and_no_gap_opens),
        cmocka_unit_test(given_pieces_in_any_orientation_then_the_mesh_is_watertight),
        cmocka_unit_test(given_a_surface_that_closes_then_its_seam_is_closed),
        cmocka_unit_test(given_a_collapsed_border_then_triangles_without_area_are_left_out),
        cmocka_unit_test(given_any_number_of_threads_then_meshes_are_the_same_bytes),
        cmocka_unit_test(given_wrong_arguments_or_no_memory_then_it_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
