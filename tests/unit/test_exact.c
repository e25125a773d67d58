/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points without noise on two pieces of polynomials: the sheet is these pieces, however they are
 * turned. */
#include "given.h"

#include "base/random.h"

enum { POINTS = 700 };

static const double degree = 0.017453292519943296;

/* A rotation about an axis that is none of the cloud's. */
static void turn_in_space(double *points, size_t count, double angle)
{
    const double axis[3] = {0.36, -0.48, 0.8}, c = cos(angle), s = sin(angle);
    for (size_t i = 0; i < count; i++) {
        double *const p = points + 3 * i, q[3] = {p[0], p[1], p[2]};
        const double along = (axis[0] * q[0] + axis[1] * q[1] + axis[2] * q[2]) * (1 - c);
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3, m = (k + 2) % 3;
            p[k] = c * q[k] + s * (axis[l] * q[m] - axis[m] * q[l]) + along * axis[k] + 2;
        }
    }
}

/* Over a unit square, the crease turned in it: heights of two pieces, planes or bicubics. */
static void set_points(
    double *points, size_t count, double dihedral, double turn, bool bicubic, double noise)
{
    const double slope = tan((90 - dihedral / 2) * degree), c = cos(turn), s = sin(turn);
    for (size_t i = 0; i < count; i++) {
        const double u = crease_random_uniform(4, 0, i) - 0.5;
        const double v = crease_random_uniform(4, 1, i) - 0.5;
        double z = -slope * fabs(u);
        if (bicubic)
            z += 0.1 *
                (3 * v * v * v - v + 2 * u * u * v +
                    (u < 0 ? 4 * u * u * v * v * v - 3 * u * u * u
                           : 2 * u * u + u * v + 5 * u * u * u * v * v));
        points[3 * i] = c * u - s * v;
        points[3 * i + 1] = s * u + c * v;
        points[3 * i + 2] = z + (noise > 0 ? noise * crease_random_normal(4, 2, i) : 0);
    }
}

static crease_sheet *when_fitted(
    crease_context *context, const double *points, size_t count, const crease_sheet_options *o)
{
    crease_sheet *sheet = NULL;
    crease_cloud *cloud = given_cloud_of(context, points, count);
    assert_int_equal(crease_sheet_fit(context, cloud, o, &sheet), CREASE_OK);
    crease_cloud_free(cloud);
    return sheet;
}

static double farthest(const crease_sheet *sheet)
{
    double most = 0;
    for (size_t i = 0; i < crease_sheet_point_count(sheet); i++)
        most = fmax(most, fabs(crease_sheet_deviations(sheet)[i]));
    return most;
}

static void given_two_pieces_then_the_sheet_is_exact_however_they_are_turned(void **state)
{
    static double points[3 * POINTS];
    crease_context *context = given_context();
    const double dihedrals[] = {30, 75, 110, 150};
    for (int d = 0; d < 4; d++)
        for (int i = 0; i < 4; i++) {
            set_points(points, POINTS, dihedrals[d], (7.5 + 25 * i) * degree, i % 2 == 0, 0);
            if (i > 1)
                turn_in_space(points, POINTS, 0.4 + d);
            crease_sheet *sheet = when_fitted(context, points, POINTS, NULL);
            const crease_surface_parts parts = crease_surface_parts_of(crease_sheet_surface(sheet));
            assert_int_equal(crease_sheet_line_count(sheet), 1);
            if (!(farthest(sheet) < 2e-13))
                fail_msg("%g degrees, turned %d times: %g off", dihedrals[d], i, farthest(sheet));
            if (i % 2 == 0)
                assert_int_equal(parts.count[0] * parts.count[1], 28);
            else
                assert_near(crease_sheet_line(sheet, 0).angle, dihedrals[d], 1e-6);
            crease_sheet_free(sheet);
        }
    crease_context_free(context);
}

static void given_a_net_then_it_is_exact_in_it(void **state)
{
    static double points[3 * POINTS];
    crease_context *context = given_context();
    crease_sheet_options options = crease_sheet_options_default();
    options.net[0] = options.net[1] = 9;
    set_points(points, POINTS, 90, 20 * degree, true, 0);
    turn_in_space(points, POINTS, 1);
    crease_sheet *sheet = when_fitted(context, points, POINTS, &options);
    assert_int_equal(crease_surface_parts_of(crease_sheet_surface(sheet)).count[1], 9);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    assert_true(farthest(sheet) < 2e-13);
    crease_sheet_free(sheet);
    crease_context_free(context);
}

static void given_other_orders_then_pieces_of_their_degree_are_exact(void **state)
{
    static double points[3 * POINTS];
    crease_context *context = given_context();
    crease_sheet_options options = crease_sheet_options_default();
    for (options.order = 3; options.order <= 8; options.order++) {
        set_points(points, POINTS, 100, 35 * degree, options.order >= 4, 0);
        turn_in_space(points, POINTS, 2);
        crease_sheet *sheet = when_fitted(context, points, POINTS, &options);
        const crease_surface_parts parts = crease_surface_parts_of(crease_sheet_surface(sheet));
        assert_int_equal(parts.order[0], options.order);
        assert_int_equal(parts.order[1], options.order);
        if (!(farthest(sheet) < 1e-8))
            fail_msg("order %d: %g off", options.order, farthest(sheet));
        crease_sheet_free(sheet);
    }
    crease_context_free(context);
}

static void given_noise_then_nothing_is_taken_for_exact(void **state)
{
    static double points[3 * POINTS];
    crease_context *context = given_context();
    set_points(points, POINTS, 100, 35 * degree, true, 1e-6);
    crease_sheet *sheet = when_fitted(context, points, POINTS, NULL);
    assert_true(farthest(sheet) > 1e-7);
    assert_true(farthest(sheet) < 1e-3);
    crease_sheet_free(sheet);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_two_pieces_then_the_sheet_is_exact_however_they_are_turned),
        cmocka_unit_test(given_a_net_then_it_is_exact_in_it),
        cmocka_unit_test(given_other_orders_then_pieces_of_their_degree_are_exact),
        cmocka_unit_test(given_noise_then_nothing_is_taken_for_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
