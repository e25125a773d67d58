/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Smooth lines along ragged borders whose true course is known. */
#include "given.h"

#include "base/random.h"
#include "base/vector.h"
#include "trim/contour.h"

#include <stdlib.h>

enum { MOST = 4000 };

static const double TURN = 6.283185307179586476925;

typedef struct ragged {
    crease_context *context;
    size_t count;
    double points[MOST][3], normals[MOST][3];
    crease_contour contour;
} ragged;

static ragged *given_nothing(void)
{
    ragged *r = calloc(1, sizeof *r);
    assert_non_null(r);
    r->context = given_context_with_threads(1);
    return r;
}

/* Raggedness as of points that fill the inside: up to `rag` inwards, and noise. */
static void put(ragged *r, double x, double y, const double inward[2], double rag, double noise)
{
    const uint64_t draw = r->count;
    const double depth =
        rag * crease_random_uniform(9, 1, draw) + noise * crease_random_normal(9, 2, draw);
    const double p[3] = {x + depth * inward[0], y + depth * inward[1], 0}, up[3] = {0, 0, 1};
    assert_true(r->count < MOST);
    memcpy(r->points[r->count], p, sizeof p);
    memcpy(r->normals[r->count++], up, sizeof up);
}

/* Anticlockwise around corners, a point for each unit. */
static void put_sides(
    ragged *r, const double (*corners)[2], size_t count, bool closed, double rag, double noise)
{
    for (size_t k = 0; k + !closed < count; k++) {
        const double *const a = corners[k], *const b = corners[(k + 1) % count];
        const double length = hypot(b[0] - a[0], b[1] - a[1]);
        const double along[2] = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
        const double inward[2] = {-along[1], along[0]};
        for (double t = 0.5; t < length; t += 1.0)
            put(r, a[0] + t * along[0], a[1] + t * along[1], inward, rag, noise);
    }
}

static void put_circle(ragged *r, double radius, double rag, double noise)
{
    const int n = (int)(TURN * radius);
    for (int i = 0; i < n; i++) {
        const double angle = TURN * i / n, inward[2] = {-cos(angle), -sin(angle)};
        put(r, radius * cos(angle), radius * sin(angle), inward, rag, noise);
    }
}

static void when_fitted(ragged *r, bool closed)
{
    const crease_rag rag = {.count = r->count,
        .points = r->points[0],
        .normals = r->normals[0],
        .closed = closed,
        .spacing = 1.0};
    assert_int_equal(crease_contour_fit(r->context, &rag, &r->contour), CREASE_OK);
}

static void free_ragged(ragged *r)
{
    crease_contour_clear(&r->contour);
    crease_context_free(r->context);
    free(r);
}

static const double *end_of(const crease_stretch *stretch, bool last)
{
    return stretch->points + (last ? 3 * (stretch->count - 1) : 0);
}

static double off_corner(const ragged *r, const double corner[2])
{
    double least = INFINITY;
    for (size_t i = 0; i < r->contour.count; i++) {
        const double *const p = end_of(&r->contour.items[i], false);
        least = fmin(least, hypot(p[0] - corner[0], p[1] - corner[1]));
    }
    return least;
}

/* How far the points of a stretch are off the straight line between its ends. */
static double sag(const crease_stretch *stretch)
{
    const double *const a = end_of(stretch, false), *const b = end_of(stretch, true);
    const double length = crease_vector_distance(a, b);
    double most = 0.0;
    for (size_t i = 0; i < stretch->count; i++) {
        const double *const p = stretch->points + 3 * i;
        most = fmax(
            most, fabs((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / length);
    }
    return most;
}

static void then_it_hangs_together(const ragged *r)
{
    const size_t count = r->contour.count;
    for (size_t i = 0; i + !r->contour.closed < count; i++)
        assert_near(crease_vector_distance(end_of(&r->contour.items[i], true),
                        end_of(&r->contour.items[(i + 1) % count], false)),
            0.0, 1e-9);
}

static const double rectangle[4][2] = {{0, 0}, {60, 0}, {60, 35}, {0, 35}};
static const double notched[8][2] = {
    {0, 0}, {60, 0}, {60, 40}, {40, 40}, {40, 20}, {20, 20}, {20, 40}, {0, 40}};

static void given_an_exact_rectangle_then_exact_corners(void **state)
{
    (void)state;
    ragged *r = given_nothing();
    put_sides(r, rectangle, 4, true, 0.0, 0.0);
    when_fitted(r, true);
    assert_true(r->contour.closed);
    assert_int_equal(r->contour.count, 4);
    for (int i = 0; i < 4; i++) {
        assert_near(off_corner(r, rectangle[i]), 0.0, 1e-6);
        assert_near(sag(&r->contour.items[i]), 0.0, 1e-6);
    }
    then_it_hangs_together(r);
    free_ragged(r);
}

static void given_a_ragged_rectangle_then_straight_sides_along_its_outermost_points(void **state)
{
    (void)state;
    ragged *r = given_nothing();
    put_sides(r, rectangle, 4, true, 1.0, 0.0);
    when_fitted(r, true);
    assert_int_equal(r->contour.count, 4);
    for (int i = 0; i < 4; i++) {
        assert_true(off_corner(r, rectangle[i]) < 0.75);
        assert_near(sag(&r->contour.items[i]), 0.0, 1e-6);
    }
    for (int i = 0; i < 4; i++) { /* outside the mean of the points, which is 0.5 within */
        const double *const a = end_of(&r->contour.items[i], false);
        const double *const b = end_of(&r->contour.items[i], true);
        const double x = 0.5 * (a[0] + b[0]), y = 0.5 * (a[1] + b[1]);
        const double within = fmin(fmin(x, 60 - x), fmin(y, 35 - y));
        assert_true(within > -0.1 && within < 0.4);
    }
    then_it_hangs_together(r);
    free_ragged(r);
}

static void given_a_notched_plate_then_corners_both_ways(void **state)
{
    (void)state;
    ragged *r = given_nothing();
    put_sides(r, notched, 8, true, 0.6, 0.1);
    when_fitted(r, true);
    assert_int_equal(r->contour.count, 8);
    for (int i = 0; i < 8; i++)
        assert_true(off_corner(r, notched[i]) < 0.75);
    then_it_hangs_together(r);
    free_ragged(r);
}

static void then_a_circle(const ragged *r, double radius, double from, double to)
{
    assert_int_equal(r->contour.count, 1);
    const crease_stretch *const all = &r->contour.items[0];
    assert_near(crease_vector_distance(end_of(all, false), end_of(all, true)), 0.0, 1e-6);
    for (size_t i = 0; i < all->count; i++) {
        const double at = hypot(all->points[3 * i], all->points[3 * i + 1]);
        assert_true(at - radius > from && at - radius < to);
    }
}

static void given_a_circle_then_no_corner(void **state)
{
    (void)state;
    for (double radius = 6; radius < 100; radius *= 2.5) {
        ragged *r = given_nothing();
        put_circle(r, radius, 0.0, 0.0);
        when_fitted(r, true);
        then_a_circle(r, radius, -0.01, 0.01);
        free_ragged(r);
    }
}

static void given_a_ragged_circle_then_the_outer_half_of_its_points(void **state)
{
    (void)state;
    for (double radius = 10; radius < 100; radius *= 2.5) {
        ragged *r = given_nothing();
        put_circle(r, radius, 0.8, 0.1);
        when_fitted(r, true);
        then_a_circle(r, radius, -0.65, 0.35);
        free_ragged(r);
    }
}

static void given_an_open_line_then_it_keeps_its_ends_free(void **state)
{
    (void)state;
    ragged *r = given_nothing();
    put_sides(r, rectangle, 3, false, 0.5, 0.1);
    when_fitted(r, false);
    assert_false(r->contour.closed);
    assert_int_equal(r->contour.count, 2);
    assert_true(off_corner(r, rectangle[1]) < 0.75);
    assert_near(end_of(&r->contour.items[0], false)[0], 0.5, 0.5);
    assert_near(end_of(&r->contour.items[1], true)[1], 34.5, 0.5);
    then_it_hangs_together(r);
    free_ragged(r);
}

static void given_few_points_then_a_line_all_the_same(void **state)
{
    (void)state;
    for (size_t count = 3; count < 9; count++) {
        ragged *r = given_nothing();
        put_sides(r, (const double[][2]){{0, 0}, {(double)count, 0}}, 2, false, 0.0, 0.0);
        when_fitted(r, false);
        assert_int_equal(r->contour.count, 1);
        assert_near(sag(&r->contour.items[0]), 0.0, 1e-6);
        free_ragged(r);
    }
}

static void given_no_memory_then_it_says_so(void **state)
{
    (void)state;
    ragged *r = given_nothing();
    const crease_rag rag = {
        .points = r->points[0], .normals = r->normals[0], .closed = true, .spacing = 1.0};
    put_sides(r, rectangle, 4, true, 0.5, 0.1);
    crease_rag all = rag;
    all.count = r->count;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    for (long n = 0; status != CREASE_OK && n < 200; n++) {
        crease_context_fail_allocation(r->context, n);
        status = crease_contour_fit(r->context, &all, &r->contour);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
    }
    crease_context_fail_allocation(r->context, -1);
    assert_int_equal(status, CREASE_OK);
    free_ragged(r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_an_exact_rectangle_then_exact_corners),
        cmocka_unit_test(given_a_ragged_rectangle_then_straight_sides_along_its_outermost_points),
        cmocka_unit_test(given_a_notched_plate_then_corners_both_ways),
        cmocka_unit_test(given_a_circle_then_no_corner),
        cmocka_unit_test(given_a_ragged_circle_then_the_outer_half_of_its_points),
        cmocka_unit_test(given_an_open_line_then_it_keeps_its_ends_free),
        cmocka_unit_test(given_few_points_then_a_line_all_the_same),
        cmocka_unit_test(given_no_memory_then_it_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
