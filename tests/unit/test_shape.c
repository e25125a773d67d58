/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "cloud/shape.h"

static int by_coordinates(const void *a, const void *b)
{
    return memcmp(a, b, 3 * sizeof(double));
}

static void given_the_papers_cube_then_6146_different_points_on_its_faces(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cube = NULL;
    assert_int_equal(crease_shape_cube(context, 32, &cube), CREASE_OK);
    assert_int_equal(crease_cloud_count(cube), 6146);
    double points[6146][3];
    memcpy(points, crease_cloud_points(cube), sizeof points);
    for (size_t i = 0; i < 6146; i++) {
        bool on_face = false;
        for (int c = 0; c < 3; c++) {
            assert_true(points[i][c] * 32 == floor(points[i][c] * 32));
            on_face = on_face || points[i][c] == 0.0 || points[i][c] == 1.0;
        }
        assert_true(on_face);
    }
    qsort(points, 6146, sizeof points[0], by_coordinates);
    for (size_t i = 1; i < 6146; i++)
        assert_true(by_coordinates(points[i - 1], points[i]) != 0);
    crease_cloud_free(cube);
    crease_context_free(context);
}

static void given_the_roof_sample_then_points_lie_on_two_planes_at_right_angles(void **state)
{
    crease_context *context = given_context();
    crease_cloud *sample = NULL;
    assert_int_equal(crease_shape_sample(context, NULL, &sample), CREASE_OK);
    assert_int_equal(crease_cloud_count(sample), 51);
    const double *p = crease_cloud_points(sample);
    for (size_t i = 0; i < 51; i++) {
        assert_near(p[3 * i + 2], -fabs(p[3 * i]), 1e-15);
        assert_near(p[3 * i], ((double)(i % 17) - 8) / 32 / sqrt(2.0), 1e-15);
        assert_near(p[3 * i + 1], 0.5 + ((double)(i / 17) - 1) / 32, 1e-15);
    }
    crease_cloud_free(sample);
    crease_context_free(context);
}

static void given_the_flat_sample_then_points_are_those_of_the_cube(void **state)
{
    crease_context *context = given_context();
    crease_sample_options options = crease_sample_options_default();
    options.across = 3, options.along = 17, options.roof = false;
    crease_cloud *sample = NULL;
    assert_int_equal(crease_shape_sample(context, &options, &sample), CREASE_OK);
    const double *p = crease_cloud_points(sample);
    for (size_t i = 0; i < 51; i++) {
        assert_near(p[3 * i], i % 3 == 0 ? 0.96875 : 1.0, 1e-15);
        assert_near(p[3 * i + 1], 0.25 + (double)(i / 3) / 32, 1e-15);
        assert_near(p[3 * i + 2], i % 3 == 2 ? 0.96875 : 1.0, 1e-15);
    }
    crease_cloud_free(sample);
    crease_context_free(context);
}

static void given_noise_then_only_the_moved_points_move_and_only_along_z(void **state)
{
    crease_context *context = given_context();
    crease_sample_options options = crease_sample_options_default();
    crease_cloud *clean = NULL;
    assert_int_equal(crease_shape_sample(context, &options, &clean), CREASE_OK);
    const double *c = crease_cloud_points(clean);
    options.noise = 0.64;
    double square = 0.0;
    for (options.variant = 0; options.variant < 200; options.variant++) {
        crease_cloud *noisy = NULL;
        assert_int_equal(crease_shape_sample(context, &options, &noisy), CREASE_OK);
        const double *p = crease_cloud_points(noisy);
        int moved = 0;
        for (size_t i = 0; i < 51; i++) {
            moved += p[3 * i + 2] != c[3 * i + 2];
            assert_true(p[3 * i] == c[3 * i] && p[3 * i + 1] == c[3 * i + 1]);
            square += pow(p[3 * i + 2] - c[3 * i + 2], 2);
        }
        assert_int_equal(moved, 13);
        crease_cloud_free(noisy);
    }
    assert_near(sqrt(square / (200 * 13)), 0.02, 0.001);
    crease_cloud_free(clean);
    crease_context_free(context);
}

static void given_a_shift_then_the_edge_moves_within_the_points(void **state)
{
    crease_context *context = given_context();
    crease_sample_options options = crease_sample_options_default();
    options.shift = 1.0;
    crease_cloud *sample = NULL;
    assert_int_equal(crease_shape_sample(context, &options, &sample), CREASE_OK);
    double low[3], high[3];
    crease_cloud_bounds(sample, low, high);
    assert_near(low[0], -7 / 32.0 / sqrt(2.0), 1e-15);
    assert_near(high[0], 9 / 32.0 / sqrt(2.0), 1e-15);
    const crease_roof roof = crease_shape_sample_truth(&options);
    assert_near(roof.across[0], 7 / 32.0, 1e-15);
    assert_near(roof.across[1], 9 / 32.0, 1e-15);
    crease_cloud_free(sample);
    crease_context_free(context);
}

static void given_a_panel_without_noise_then_points_keep_to_its_surface(void **state)
{
    crease_context *context = given_context();
    crease_panel_options options = {.count = 500};
    crease_cloud *panel = NULL;
    assert_int_equal(crease_shape_panel(context, &options, &panel), CREASE_OK);
    const double *p = crease_cloud_points(panel);
    double origin[3], foot[3], axis[2][2][3];
    crease_shape_panel_point(0, 0, origin);
    for (int i = 0; i < 2; i++) {
        crease_shape_panel_point(i ? 0 : -0.1, i ? -0.1 : 0, axis[i][0]);
        crease_shape_panel_point(i ? 0 : 0.1, i ? 0.1 : 0, axis[i][1]);
    }
    for (size_t i = 0; i < 500; i++) {
        double local[2] = {0, 0};
        for (int a = 0; a < 2; a++)
            for (int c = 0; c < 3; c++)
                local[a] +=
                    (p[3 * i + (size_t)c] - origin[c]) * (axis[a][1][c] - axis[a][0][c]) * 5;
        crease_shape_panel_point(local[0], local[1], foot);
        for (size_t c = 0; c < 3; c++)
            assert_near(p[3 * i + c], foot[c], 1e-14);
    }
    crease_cloud *again = NULL;
    assert_int_equal(crease_shape_panel(context, &options, &again), CREASE_OK);
    assert_memory_equal(
        crease_cloud_points(panel), crease_cloud_points(again), 500 * 3 * sizeof(double));
    crease_cloud_free(again);
    crease_cloud_free(panel);
    crease_context_free(context);
}

static void given_a_bracket_without_noise_then_points_lie_on_its_surface(void **state)
{
    crease_context *context = given_context();
    const crease_bracket_options options = {.count = 5000};
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_shape_bracket(context, &options, &cloud), CREASE_OK);
    assert_int_equal(crease_cloud_count(cloud), 5000);
    for (size_t i = 0; i < 5000; i++) {
        bool inside = false, outside = false;
        for (uint64_t k = 0; k < 64; k++) {
            double near[3];
            for (uint64_t c = 0; c < 3; c++)
                near[c] = crease_cloud_points(cloud)[3 * i + c] +
                    1e-6 * (crease_random_uniform(9, i, 3 * k + c) - 0.5);
            inside = inside || crease_shape_bracket_holds(near);
            outside = outside || !crease_shape_bracket_holds(near);
        }
        assert_true(inside && outside);
    }
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_bracket_then_noise_and_outliers_are_what_was_asked_for(void **state)
{
    crease_context *context = given_context();
    crease_bracket_options options = crease_bracket_options_default();
    crease_cloud *clean = NULL, *noisy = NULL;
    options.outliers = 0.1;
    assert_int_equal(crease_shape_bracket(context, &options, &noisy), CREASE_OK);
    options.outliers = options.noise = 0;
    assert_int_equal(crease_shape_bracket(context, &options, &clean), CREASE_OK);
    const double sigma = 0.2 * sqrt(18650.0 / 30000);
    double square = 0;
    size_t kept = 0;
    for (size_t i = 0; i < 30000; i++) {
        double off = 0;
        for (size_t c = 3 * i; c < 3 * i + 3; c++)
            off += pow(crease_cloud_points(noisy)[c] - crease_cloud_points(clean)[c], 2);
        if (off < 25 * sigma * sigma) {
            square += off;
            kept++;
        }
    }
    assert_near((double)kept / 30000, 0.9, 0.01);
    assert_near(sqrt(square / (double)kept) / sigma, 1.0, 0.05);
    crease_cloud_free(clean);
    crease_cloud_free(noisy);
    crease_context_free(context);
}

static void given_senseless_options_then_an_error_says_what_to_give(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_shape_cube(context, 0, &cloud), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "intervals"));
    crease_sample_options sample = crease_sample_options_default();
    sample.moved = 52;
    assert_int_equal(crease_shape_sample(context, &sample, &cloud), CREASE_ERROR_ARGUMENT);
    sample = crease_sample_options_default();
    sample.across = 1;
    assert_int_equal(crease_shape_sample(context, &sample, &cloud), CREASE_ERROR_ARGUMENT);
    sample = crease_sample_options_default();
    sample.spacing = NAN;
    assert_int_equal(crease_shape_sample(context, &sample, &cloud), CREASE_ERROR_ARGUMENT);
    crease_panel_options panel = {.count = 3};
    assert_int_equal(crease_shape_panel(context, &panel, &cloud), CREASE_ERROR_ARGUMENT);
    assert_null(cloud);
    crease_context_free(context);
}

static void given_no_memory_then_shapes_fail_cleanly(void **state)
{
    crease_context *context = given_context();
    for (long n = 0; n < 4; n++) {
        crease_cloud *cloud = NULL;
        crease_context_fail_allocation(context, n);
        crease_status status = crease_shape_sample(context, NULL, &cloud);
        assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
        crease_context_fail_allocation(context, n < 3 ? n : 2);
        status = crease_shape_cube(context, 4, &cloud);
        assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
        crease_context_fail_allocation(context, n < 3 ? n : 2);
        status = crease_shape_panel(context, NULL, &cloud);
        assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
        crease_context_fail_allocation(context, n < 3 ? n : 2);
        status = crease_shape_bracket(context, NULL, &cloud);
        assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
    }
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_the_papers_cube_then_6146_different_points_on_its_faces),
        cmocka_unit_test(given_the_roof_sample_then_points_lie_on_two_planes_at_right_angles),
        cmocka_unit_test(given_the_flat_sample_then_points_are_those_of_the_cube),
        cmocka_unit_test(given_noise_then_only_the_moved_points_move_and_only_along_z),
        cmocka_unit_test(given_a_shift_then_the_edge_moves_within_the_points),
        cmocka_unit_test(given_a_panel_without_noise_then_points_keep_to_its_surface),
        cmocka_unit_test(given_a_bracket_without_noise_then_points_lie_on_its_surface),
        cmocka_unit_test(given_a_bracket_then_noise_and_outliers_are_what_was_asked_for),
        cmocka_unit_test(given_senseless_options_then_an_error_says_what_to_give),
        cmocka_unit_test(given_no_memory_then_shapes_fail_cleanly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
