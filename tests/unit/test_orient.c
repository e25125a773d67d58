/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "averaging/orient.h"
#include "base/random.h"
#include "base/select.h"
#include "base/vector.h"

static crease_cloud *given_sample(
    crease_context *context, int across, int along, bool roof, double noise, uint64_t variant)
{
    crease_sample_options options = crease_sample_options_default();
    options.across = across, options.along = along, options.roof = roof;
    options.noise = noise, options.variant = variant;
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_shape_sample(context, &options, &cloud), CREASE_OK);
    return cloud;
}

static crease_oriented when_oriented(crease_context *context, const crease_cloud *cloud)
{
    crease_oriented found;
    assert_int_equal(
        crease_orient_find(context, crease_cloud_points(cloud), crease_cloud_count(cloud), &found),
        CREASE_OK);
    assert_true(crease_frame_defect(found.frame.rotation) < 1e-12);
    return found;
}

static void given_roof_samples_then_the_axes_stay_as_they_are(void **state)
{
    crease_context *context = given_context();
    for (int i = 0; i < 2; i++) {
        crease_cloud *cloud = given_sample(context, i ? 3 : 17, i ? 17 : 3, true, 0, 0);
        const crease_oriented found = when_oriented(context, cloud);
        assert_true(found.edge);
        for (int r = 0; r < 9; r++)
            assert_near(found.frame.rotation[r], r % 4 == 0, 1e-12);
        assert_near(found.point[0], 0, 1e-12);
        assert_near(found.point[2], 0, 1e-12);
        assert_near(found.frame.origin[1], 0.5, 1e-12);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

static void given_flat_samples_then_they_are_turned_by_45_degrees(void **state)
{
    crease_context *context = given_context();
    const double c = sqrt(0.5), expected[9] = {c, 0, -c, 0, 1, 0, c, 0, c};
    for (int i = 0; i < 2; i++) {
        crease_cloud *cloud = given_sample(context, i ? 3 : 17, i ? 17 : 3, false, 0, 0);
        const crease_oriented found = when_oriented(context, cloud);
        assert_true(found.edge);
        for (int r = 0; r < 9; r++)
            assert_near(found.frame.rotation[r], expected[r], 1e-12);
        assert_near(found.point[0], 1, 1e-12);
        assert_near(found.point[2], 1, 1e-12);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

static void given_noise_then_the_edge_is_still_found_where_it_is(void **state)
{
    crease_context *context = given_context();
    for (uint64_t variant = 0; variant < 20; variant++) {
        crease_cloud *cloud = given_sample(context, 17, 3, true, 0.64, variant);
        const crease_oriented found = when_oriented(context, cloud);
        assert_true(found.edge);
        assert_true(fabs(found.direction[1]) > 0.99);
        assert_near(found.point[0], 0, 0.3 / 32);
        assert_true(found.frame.rotation[8] > 0.98 && found.frame.rotation[0] > 0.98);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

/* Unit quaternion of uniform distribution, as a rotation. */
static void given_any_rotation(uint64_t draw, double m[9])
{
    double q[4], length = 0;
    for (uint64_t i = 0; i < 4; i++) {
        q[i] = crease_random_normal(5, 6, 4 * draw + i);
        length += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++)
        q[i] /= sqrt(length);
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
        2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y),
        2 * (y * z + w * x), 1 - 2 * (x * x + y * y)};
    memcpy(m, r, sizeof r);
}

static void given_an_edge_along_no_axis_then_it_becomes_y_and_z_halves_the_angle(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0, 0);
    double points[51 * 3];
    for (uint64_t draw = 0; draw < 30; draw++) {
        crease_frame turn = {.origin = {100, -200, 300}};
        given_any_rotation(draw, turn.rotation);
        crease_frame_leave(&turn, crease_cloud_points(cloud), 51, points);
        crease_oriented found;
        assert_int_equal(crease_orient_find(context, points, 51, &found), CREASE_OK);
        assert_true(found.edge);
        const double *m = found.frame.rotation;
        assert_near(fabs(crease_vector_dot(m + 3, turn.rotation + 3)), 1, 1e-9);
        assert_near(fabs(crease_vector_dot(m + 6, turn.rotation + 6)), 1, 1e-9);
        assert_true(m[8] >= -1e-9 && m[0] >= -1e-9);
    }
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_no_edge_then_the_main_axes_are_taken(void **state)
{
    crease_context *context = given_context();
    double points[400][3];
    for (int i = 0; i < 400; i++) {
        const double u = i % 20 - 9.5, v = 0.3 * (i / 20 - 9.5); /* a plane of slope 1/2 */
        points[i][0] = u;
        points[i][1] = v;
        points[i][2] = 0.5 * u + 0.001 * crease_random_normal(1, 2, (uint64_t)i);
    }
    crease_oriented found;
    assert_int_equal(crease_orient_find(context, points[0], 400, &found), CREASE_OK);
    assert_false(found.edge);
    assert_near(found.frame.rotation[6], -sqrt(0.2), 1e-3);
    assert_near(found.frame.rotation[8], sqrt(0.8), 1e-3);
    assert_near(found.frame.rotation[0], sqrt(0.8), 1e-3);
    crease_context_free(context);
}

static void given_a_rotation_then_it_is_taken_and_the_edge_is_seen_in_it(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0, 0);
    const double quarter[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1}, wrong[9] = {1, 0, 0, 0, 1, 0, 0, 0, -1};
    crease_oriented found;
    assert_int_equal(crease_orient(context, crease_cloud_points(cloud), 51,
                         CREASE_ORIENTATION_GIVEN, quarter, &found),
        CREASE_OK);
    assert_memory_equal(found.frame.rotation, quarter, sizeof quarter);
    assert_int_equal(crease_orient_edge_axis(&found), 0);
    assert_int_equal(crease_orient(context, crease_cloud_points(cloud), 51, CREASE_ORIENTATION_NONE,
                         NULL, &found),
        CREASE_OK);
    assert_int_equal(crease_orient_edge_axis(&found), 1);
    assert_int_equal(crease_orient(context, crease_cloud_points(cloud), 51,
                         CREASE_ORIENTATION_GIVEN, wrong, &found),
        CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "rotation"));
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_points_of_no_surface_then_an_error_says_so(void **state)
{
    crease_context *context = given_context();
    double line[30];
    for (int i = 0; i < 30; i++)
        line[i] = i / 3 * (1 + i % 3);
    const double same[15] = {0};
    crease_oriented found;
    assert_int_equal(crease_orient_find(context, line, 3, &found), CREASE_ERROR_TOO_FEW_POINTS);
    assert_int_equal(crease_orient_find(context, line, 10, &found), CREASE_ERROR_DEGENERATE);
    assert_non_null(strstr(crease_context_message(context), "line"));
    assert_int_equal(crease_orient_find(context, same, 5, &found), CREASE_ERROR_DEGENERATE);
    crease_context_free(context);
}

static void given_a_frame_then_leaving_it_undoes_entering_it(void **state)
{
    crease_frame frame = {.origin = {1, 2, 3}};
    given_any_rotation(1, frame.rotation);
    crease_frame_turn(&frame, 0.3);
    assert_true(crease_frame_defect(frame.rotation) < 1e-15);
    double p[3] = {-4, 5, 6};
    crease_frame_enter(&frame, p, 1, p);
    assert_near(crease_vector_length(p), sqrt(25 + 9 + 9), 1e-14);
    crease_frame_leave(&frame, p, 1, p);
    for (int c = 0; c < 3; c++)
        assert_near(p[c], c == 0 ? -4 : 4 + c, 1e-14);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void given_many_short_lists_then_selecting_is_sorting(void **state)
{
    for (uint64_t i = 0; i < 3000; i++) {
        double values[9], sorted[9];
        const size_t count = 1 + i % 9;
        for (size_t j = 0; j < count; j++)
            values[j] = sorted[j] = crease_random_below(1, i, j, 5);
        qsort(sorted, count, sizeof *sorted, ascending);
        const size_t rank = crease_random_below(2, i, 0, (uint32_t)count);
        assert_true(crease_select(values, count, rank) == sorted[rank]);
    }
}

static void given_no_memory_then_orienting_fails_cleanly(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0, 0);
    crease_oriented found;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; n < 1000 && status != CREASE_OK; n++) {
        crease_context_fail_allocation(context, n);
        status = crease_orient_find(context, crease_cloud_points(cloud), 51, &found);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
    }
    assert_true(n > 3);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_roof_samples_then_the_axes_stay_as_they_are),
        cmocka_unit_test(given_flat_samples_then_they_are_turned_by_45_degrees),
        cmocka_unit_test(given_noise_then_the_edge_is_still_found_where_it_is),
        cmocka_unit_test(given_an_edge_along_no_axis_then_it_becomes_y_and_z_halves_the_angle),
        cmocka_unit_test(given_no_edge_then_the_main_axes_are_taken),
        cmocka_unit_test(given_a_rotation_then_it_is_taken_and_the_edge_is_seen_in_it),
        cmocka_unit_test(given_points_of_no_surface_then_an_error_says_so),
        cmocka_unit_test(given_a_frame_then_leaving_it_undoes_entering_it),
        cmocka_unit_test(given_many_short_lists_then_selecting_is_sorting),
        cmocka_unit_test(given_no_memory_then_orienting_fails_cleanly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
