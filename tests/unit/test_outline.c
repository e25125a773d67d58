/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The borders of points, ragged as they are. */
#include "given.h"

#include "base/random.h"
#include "space/outline.h"

#include <stdlib.h>

enum { MOST = 9000 };

static const uint64_t SIDE = 60;
static const double S = 1.0 / 60.0;

typedef struct scene {
    crease_context *context;
    size_t count;
    double points[MOST][3], normals[MOST][3];
    crease_outline outline;
} scene;

static void put(scene *s, double x, double y)
{
    const double p[3] = {x, y, 0.0}, up[3] = {0, 0, 1};
    assert_true(s->count < MOST);
    memcpy(s->points[s->count], p, sizeof p);
    memcpy(s->normals[s->count++], up, sizeof up);
}

static bool in_square(double x, double y)
{
    (void)x, (void)y;
    return true;
}

static bool beside_a_hole(double x, double y)
{
    return hypot(x - 0.5, y - 0.5) > 0.2;
}

/* One random point in each cell of a grid over the unit square, where `there` holds. */
static scene *given_cells(bool (*there)(double x, double y))
{
    scene *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->context = given_context_with_threads(2);
    for (uint64_t i = 0; i < SIDE * SIDE; i++) {
        const double x = S * ((double)(i / SIDE) + crease_random_uniform(3, 1, i));
        const double y = S * ((double)(i % SIDE) + crease_random_uniform(3, 2, i));
        if (there(x, y))
            put(s, x, y);
    }
    return s;
}

static void when_rolled(scene *s, double radius)
{
    assert_int_equal(crease_outline_find(s->context, s->points[0], s->normals[0], s->count, NULL,
                         radius, &s->outline),
        CREASE_OK);
}

static void free_scene(scene *s)
{
    crease_outline_clear(&s->outline);
    crease_context_free(s->context);
    free(s);
}

static size_t loop_size(const scene *s, size_t loop)
{
    return s->outline.first[loop + 1] - s->outline.first[loop];
}

static const double *loop_point(const scene *s, size_t loop, size_t i)
{
    return s->points[s->outline.points[s->outline.first[loop] + i % loop_size(s, loop)]];
}

/* Positive when the loop is anticlockwise. */
static double loop_area(const scene *s, size_t loop)
{
    double area = 0.0;
    for (size_t i = 0; i < loop_size(s, loop); i++) {
        const double *const a = loop_point(s, loop, i), *const b = loop_point(s, loop, i + 1);
        area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return area;
}

static void given_a_square_then_one_loop_around_it(void **state)
{
    (void)state;
    scene *s = given_cells(in_square);
    when_rolled(s, 3 * S);
    assert_int_equal(s->outline.loop_count, 1);
    assert_true(loop_area(s, 0) > 1.0 - 4.0 * S && loop_area(s, 0) < 1.0);
    for (size_t i = 0; i < loop_size(s, 0); i++) {
        const double *const p = loop_point(s, 0, i);
        const double inside = fmin(fmin(p[0], 1.0 - p[0]), fmin(p[1], 1.0 - p[1]));
        assert_true(inside < 2.0 * S);
    }
    free_scene(s);
}

static void given_a_hole_then_a_loop_that_has_the_points_on_its_left(void **state)
{
    (void)state;
    scene *s = given_cells(beside_a_hole);
    when_rolled(s, 3 * S);
    assert_int_equal(s->outline.loop_count, 2);
    const size_t hole = loop_area(s, 0) > 0.0;
    assert_true(loop_area(s, 1 - hole) > 0.9);
    assert_near(-loop_area(s, hole), 3.14159265 * 0.04, 0.02);
    for (size_t i = 0; i < loop_size(s, hole); i++) {
        const double *const p = loop_point(s, hole, i);
        assert_true(hypot(p[0] - 0.5, p[1] - 0.5) < 0.2 + 2.0 * S);
    }
    free_scene(s);
}

static void given_seen_from_below_then_it_runs_the_other_way(void **state)
{
    (void)state;
    scene *s = given_cells(in_square);
    for (size_t i = 0; i < s->count; i++)
        s->normals[i][2] = -1.0;
    when_rolled(s, 3 * S);
    assert_int_equal(s->outline.loop_count, 1);
    assert_true(loop_area(s, 0) < -0.9);
    free_scene(s);
}

static void given_single_points_and_lines_of_them_then_they_are_left_out(void **state)
{
    (void)state;
    scene *s = given_cells(in_square);
    for (int i = 1; i <= 6; i++)
        put(s, 1.0 + 2.0 * S * i, 0.5);
    put(s, 3.0, 3.0);
    put(s, -3.0, 3.0);
    put(s, -3.0, 3.0 + S);
    when_rolled(s, 3 * S);
    assert_int_equal(s->outline.loop_count, 1);
    for (size_t i = 0; i < loop_size(s, 0); i++)
        assert_true(loop_point(s, 0, i)[0] < 1.0 + 4.0 * S);
    free_scene(s);
}

static void given_a_lattice_with_equal_points_then_its_border(void **state)
{
    (void)state;
    scene *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->context = given_context_with_threads(1);
    for (int i = 0; i <= 30; i++)
        for (int k = 0; k <= 30; k++)
            for (int twice = 0; twice < 2; twice++)
                put(s, i / 30.0, k / 30.0);
    when_rolled(s, 2.5 / 30.0);
    assert_int_equal(s->outline.loop_count, 1);
    assert_int_equal(loop_size(s, 0), 120);
    assert_near(loop_area(s, 0), 1.0, 1e-12);
    free_scene(s);
}

static void given_a_cylinder_then_two_loops_around_it(void **state)
{
    (void)state;
    scene *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->context = given_context_with_threads(2);
    for (uint64_t i = 0; i < 100 * 20; i++) {
        const double angle = 0.0628318530718 * ((double)(i / 20) + crease_random_uniform(4, 1, i));
        const double z = 0.0628 * ((double)(i % 20) + crease_random_uniform(4, 2, i));
        put(s, cos(angle), sin(angle));
        s->points[i][2] = z;
        memcpy(s->normals[i], (double[]){cos(angle), sin(angle), 0}, sizeof s->normals[i]);
    }
    when_rolled(s, 0.18);
    assert_int_equal(s->outline.loop_count, 2);
    for (size_t loop = 0; loop < 2; loop++) {
        assert_true(loop_size(s, loop) > 40);
        assert_near(fabs(loop_area(s, loop)), 3.14159265, 0.05);
    }
    free_scene(s);
}

static void given_no_point_or_one_then_no_loop(void **state)
{
    (void)state;
    scene *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->context = given_context_with_threads(1);
    put(s, 0, 0);
    when_rolled(s, 1.0);
    assert_int_equal(s->outline.loop_count, 0);
    free_scene(s);
}

static void given_any_number_of_threads_then_the_same_loops(void **state)
{
    (void)state;
    scene *one = given_cells(beside_a_hole), *other = given_cells(beside_a_hole);
    crease_context_free(other->context);
    other->context = given_context_with_threads(3);
    when_rolled(one, 2.5 * S);
    when_rolled(other, 2.5 * S);
    assert_int_equal(one->outline.loop_count, other->outline.loop_count);
    const size_t total = one->outline.first[one->outline.loop_count];
    assert_memory_equal(
        one->outline.points, other->outline.points, total * sizeof *one->outline.points);
    free_scene(one);
    free_scene(other);
}

static void given_no_memory_then_it_says_so(void **state)
{
    (void)state;
    scene *s = given_cells(beside_a_hole);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    for (long n = 0; status != CREASE_OK && n < 50; n++) {
        crease_context_fail_allocation(s->context, n);
        status = crease_outline_find(
            s->context, s->points[0], s->normals[0], s->count, NULL, 3 * S, &s->outline);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
        if (status != CREASE_OK)
            assert_null(s->outline.points);
    }
    crease_context_fail_allocation(s->context, -1);
    assert_int_equal(status, CREASE_OK);
    free_scene(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_square_then_one_loop_around_it),
        cmocka_unit_test(given_a_hole_then_a_loop_that_has_the_points_on_its_left),
        cmocka_unit_test(given_seen_from_below_then_it_runs_the_other_way),
        cmocka_unit_test(given_single_points_and_lines_of_them_then_they_are_left_out),
        cmocka_unit_test(given_a_lattice_with_equal_points_then_its_border),
        cmocka_unit_test(given_a_cylinder_then_two_loops_around_it),
        cmocka_unit_test(given_no_point_or_one_then_no_loop),
        cmocka_unit_test(given_any_number_of_threads_then_the_same_loops),
        cmocka_unit_test(given_no_memory_then_it_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
