/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/vector.h"
#include "crease/curve.h"

enum { MOST = 4096 };

static double points[3 * MOST];

static double turn(double share)
{
    return 2 * acos(-1) * share;
}

static crease_curve *fitted(crease_context *context, size_t count, bool closed, double tolerance)
{
    crease_curve *curve = NULL;
    assert_int_equal(
        crease_curve_fit(context, points, count, closed, tolerance, &curve), CREASE_OK);
    return curve;
}

static void given_circle(size_t count, double share)
{
    for (size_t i = 0; i < count; i++) {
        const double t = turn(share * (double)i / (double)count);
        points[3 * i] = cos(t);
        points[3 * i + 1] = sin(t);
        points[3 * i + 2] = 0.5;
    }
}

/* Greatest distance of 1000 places of a curve from the circle. */
static double off_circle(const crease_curve *curve)
{
    double domain[2], most = 0;
    crease_curve_domain(curve, domain);
    for (int i = 0; i <= 1000; i++) {
        double p[3];
        const double t = domain[0] + (domain[1] - domain[0]) * i / 1000;
        crease_curve_evaluate(curve, t, CREASE_SIDE_RIGHT, 0, p);
        most = fmax(most, fmax(fabs(hypot(p[0], p[1]) - 1), fabs(p[2] - 0.5)));
    }
    return most;
}

static void given_straight_points_when_fitted_then_one_span_exactly(void **state)
{
    crease_context *context = given_context();
    for (size_t i = 0; i < 100; i++)
        for (size_t c = 0; c < 3; c++)
            points[3 * i + c] = (double)(c + 1) * (double)i / 99 - 7;
    crease_curve *curve = fitted(context, 100, false, 1e-3);
    assert_int_equal(crease_curve_count(curve), 4);
    double domain[2], p[3];
    crease_curve_domain(curve, domain);
    assert_near(domain[1] - domain[0], sqrt(14), 1e-12);
    for (int i = 0; i <= 10; i++) {
        crease_curve_evaluate(curve, domain[1] * i / 10, CREASE_SIDE_RIGHT, 0, p);
        for (int c = 0; c < 3; c++)
            assert_near(p[c], (c + 1) * i / 10.0 - 7, 1e-9);
    }
    crease_curve_free(curve);
    crease_context_free(context);
}

static void given_two_points_when_fitted_then_segment(void **state)
{
    crease_context *context = given_context();
    const double two[6] = {1, 2, 3, 1, 2, 5};
    crease_curve *curve = NULL;
    assert_int_equal(crease_curve_fit(context, two, 2, false, 1e-3, &curve), CREASE_OK);
    double p[3];
    crease_curve_evaluate(curve, 1, CREASE_SIDE_RIGHT, 0, p);
    assert_near(p[2], 4, 1e-6);
    crease_curve_free(curve);
    crease_context_free(context);
}

static void given_open_arc_when_fitted_then_ends_are_exact(void **state)
{
    crease_context *context = given_context();
    given_circle(200, 0.7);
    crease_curve *curve = fitted(context, 200, false, 1e-5);
    assert_true(off_circle(curve) < 2e-5);
    const double *control = crease_curve_control_points(curve);
    const size_t last = crease_curve_count(curve) - 1;
    assert_memory_equal(control, points, 3 * sizeof(double));
    assert_memory_equal(control + 3 * last, points + 3 * 199, 3 * sizeof(double));
    assert_true(crease_curve_count(curve) < 60);
    crease_curve_free(curve);
    crease_context_free(context);
}

static void given_ring_when_fitted_then_closed_and_smooth(void **state)
{
    crease_context *context = given_context();
    for (size_t count = 8; count <= 1024; count *= 2) {
        given_circle(count, 1);
        crease_curve *curve = fitted(context, count, true, 1e-4);
        double domain[2], first[9], last[9];
        crease_curve_domain(curve, domain);
        crease_curve_evaluate(curve, domain[0], CREASE_SIDE_RIGHT, 2, first);
        crease_curve_evaluate(curve, domain[1], CREASE_SIDE_LEFT, 2, last);
        assert_memory_equal(first, last, 3 * sizeof(double));
        for (int c = 3; c < 9; c++)
            assert_near(first[c], last[c], 1e-6);
        assert_true(off_circle(curve) < (count <= 16 ? 0.02 : 2e-4));
        assert_true(crease_curve_count(curve) <= count / 2 + 3);
        crease_curve_free(curve);
    }
    crease_context_free(context);
}

static void given_rough_points_when_fitted_then_at_most_a_span_for_two(void **state)
{
    crease_context *context = given_context();
    for (size_t i = 0; i < 101; i++) {
        points[3 * i] = (double)i;
        points[3 * i + 1] = i % 3 ? 0 : 1;
        points[3 * i + 2] = (double)(i % 2);
    }
    crease_curve *curve = fitted(context, 101, false, 1e-9);
    assert_int_equal(crease_curve_count(curve), 53);
    crease_curve_free(curve);
    crease_context_free(context);
}

static void given_equal_points_when_fitted_then_error(void **state)
{
    crease_context *context = given_context();
    memset(points, 0, sizeof points);
    crease_curve *curve = NULL;
    assert_int_equal(
        crease_curve_fit(context, points, 10, false, 1e-3, &curve), CREASE_ERROR_NUMERIC);
    assert_null(curve);
    assert_non_null(strstr(crease_context_message(context), "the same"));
    crease_context_free(context);
}

static void given_scaled_points_when_fitted_then_scaled_curve(void **state)
{
    crease_context *context = given_context();
    given_circle(100, 0.9);
    crease_curve *one = fitted(context, 100, false, 1e-4);
    for (size_t i = 0; i < 300; i++)
        points[i] *= 1024;
    crease_curve *other = fitted(context, 100, false, 1024e-4);
    assert_int_equal(crease_curve_count(one), crease_curve_count(other));
    for (size_t i = 0; i < 3 * crease_curve_count(one); i++)
        assert_near(crease_curve_control_points(other)[i],
            1024 * crease_curve_control_points(one)[i], 1e-9);
    crease_curve_free(one);
    crease_curve_free(other);
    crease_context_free(context);
}

static void given_failing_memory_when_fitted_then_error_and_no_leak(void **state)
{
    crease_context *context = given_context();
    given_circle(64, 1);
    long n = 0;
    for (;; n++) {
        crease_curve *curve = NULL;
        crease_context_fail_allocation(context, n);
        const crease_status status = crease_curve_fit(context, points, 64, true, 1e-4, &curve);
        crease_context_fail_allocation(context, -1);
        if (status == CREASE_OK) {
            crease_curve_free(curve);
            break;
        }
        assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
        assert_null(curve);
    }
    assert_true(n >= 5);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_straight_points_when_fitted_then_one_span_exactly),
        cmocka_unit_test(given_two_points_when_fitted_then_segment),
        cmocka_unit_test(given_open_arc_when_fitted_then_ends_are_exact),
        cmocka_unit_test(given_ring_when_fitted_then_closed_and_smooth),
        cmocka_unit_test(given_rough_points_when_fitted_then_at_most_a_span_for_two),
        cmocka_unit_test(given_equal_points_when_fitted_then_error),
        cmocka_unit_test(given_scaled_points_when_fitted_then_scaled_curve),
        cmocka_unit_test(given_failing_memory_when_fitted_then_error_and_no_leak),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
