/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Sheets of points that come in batches, or from a file in parts. */
#include "given.h"

#include "base/random.h"
#include "crease/crease_stream.h"
#include "fit/sum.h"

#include <unistd.h>

enum { POINTS = 30000, SAMPLED = 5000 };

/* Two planes that meet at right angles in a line turned by 20 degrees, over a unit square; noise
 * along z. */
static double *given_roof(size_t count, double noise)
{
    double *const points = calloc(count, 3 * sizeof *points);
    assert_non_null(points);
    for (size_t i = 0; i < count; i++) {
        const double x = crease_random_uniform(9, 0, i) - 0.5;
        const double y = crease_random_uniform(9, 1, i) - 0.5;
        points[3 * i] = x;
        points[3 * i + 1] = y;
        points[3 * i + 2] = -fabs(cos(0.35) * x + sin(0.35) * y) +
            (noise > 0.0 ? noise * crease_random_normal(9, 2, i) : 0.0);
    }
    return points;
}

static crease_sheet_sum *given_sum(
    crease_context *context, const double *points, size_t rows, size_t columns)
{
    crease_cloud *const sample = given_cloud_of(context, points, SAMPLED);
    crease_sheet_options options = crease_sheet_options_default();
    options.net[0] = rows;
    options.net[1] = columns;
    crease_sheet_sum *sum = NULL;
    assert_int_equal(crease_sheet_sum_create(context, sample, &options, &sum), CREASE_OK);
    crease_cloud_free(sample);
    return sum;
}

static crease_sheet *when_solved(crease_context *context, crease_sheet_sum *sum,
    const double *points, size_t count, size_t batch)
{
    crease_sheet *sheet = NULL;
    for (size_t at = 0; at < count; at += batch)
        assert_int_equal(crease_sheet_sum_widen(context, sum, points + 3 * at,
                             count - at < batch ? count - at : batch),
            CREASE_OK);
    do {
        crease_sheet_free(sheet);
        for (size_t at = 0; at < count; at += batch)
            assert_int_equal(crease_sheet_sum_add(context, sum, points + 3 * at,
                                 count - at < batch ? count - at : batch),
                CREASE_OK);
        assert_int_equal(crease_sheet_sum_count(sum), count);
        assert_int_equal(crease_sheet_sum_solve(context, sum, &sheet), CREASE_OK);
    } while (crease_sheet_sum_wants_more(sum));
    return sheet;
}

static double root_mean_square(crease_context *context, const crease_sheet_sum *sum,
    const double *points, size_t count, double *most)
{
    double *const distances = calloc(count, sizeof *distances), total = 0;
    assert_non_null(distances);
    assert_int_equal(crease_sheet_sum_distances(context, sum, points, count, distances), CREASE_OK);
    *most = 0;
    for (size_t i = 0; i < count; i++) {
        total += distances[i] * distances[i];
        *most = fmax(*most, fabs(distances[i]));
    }
    free(distances);
    return sqrt(total / (double)count);
}

static void given_exact_points_then_a_small_net_is_exact(void **state)
{
    crease_context *context = given_context();
    double *points = given_roof(POINTS, 0), most;
    crease_sheet_sum *sum = given_sum(context, points, 7, 7);
    crease_sheet *sheet = when_solved(context, sum, points, POINTS, 7001);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    assert_near(crease_sheet_line(sheet, 0).angle, 90, 1e-6);
    assert_true(root_mean_square(context, sum, points, POINTS, &most) < 1e-12);
    assert_true(most < 1e-9);
    crease_sheet_free(sheet);
    crease_sheet_sum_free(sum);
    free(points);
    crease_context_free(context);
}

static void given_a_net_for_iterations_then_it_is_that_of_the_points(void **state)
{
    const double noise = 0.3 / sqrt(POINTS);
    crease_context *context = given_context();
    double *points = given_roof(POINTS, noise), most;
    crease_sheet_sum *sum = given_sum(context, points, 90, 90);
    crease_sheet *sheet = when_solved(context, sum, points, POINTS, POINTS);
    const crease_surface_parts parts = crease_surface_parts_of(crease_sheet_surface(sheet));
    assert_int_equal(parts.count[0], 90);
    assert_int_equal(crease_sheet_point_count(sheet), SAMPLED);
    /* the scatter along the normal, of which few parameters explain next to nothing */
    assert_near(
        root_mean_square(context, sum, points, POINTS, &most) / (noise * sqrt(0.5)), 1, 0.03);
    for (size_t i = 0; i < 3; i++) { /* on both sides: half the noise, a net of few free numbers */
        const double places[3][2] = {{0.3, 0.2}, {-0.3, 0.1}, {0.0, -0.3}};
        const double x = places[i][0], y = places[i][1];
        const double truth[3] = {x, y, -fabs(cos(0.35) * x + sin(0.35) * y)};
        double distance;
        assert_int_equal(crease_sheet_sum_distances(context, sum, truth, 1, &distance), CREASE_OK);
        assert_near(distance, 0, 0.5 * noise);
    }
    /* also while points are added for another one */
    double before[5], after[5];
    assert_int_equal(crease_sheet_sum_distances(context, sum, points, 5, before), CREASE_OK);
    assert_int_equal(crease_sheet_sum_add(context, sum, points, 500), CREASE_OK);
    assert_int_equal(crease_sheet_sum_distances(context, sum, points, 5, after), CREASE_OK);
    for (int i = 0; i < 5; i++)
        assert_near(after[i], before[i], 1e-12);
    crease_sheet_free(sheet);
    crease_sheet_sum_free(sum);
    free(points);
    crease_context_free(context);
}

static void given_other_batches_then_the_sheet_is_the_same(void **state)
{
    crease_context *context = given_context();
    double *points = given_roof(POINTS, 1e-3);
    const size_t batches[2] = {POINTS, 997};
    crease_sheet *sheets[2];
    for (size_t i = 0; i < 2; i++) {
        crease_sheet_sum *sum = given_sum(context, points, 20, 20);
        sheets[i] = when_solved(context, sum, points, POINTS, batches[i]);
        crease_sheet_sum_free(sum);
    }
    const crease_surface_parts one = crease_surface_parts_of(crease_sheet_surface(sheets[0]));
    const crease_surface_parts two = crease_surface_parts_of(crease_sheet_surface(sheets[1]));
    for (size_t i = 0; i < 3 * one.count[0] * one.count[1]; i++)
        assert_near(one.control_points[i], two.control_points[i], 1e-8);
    crease_sheet_free(sheets[0]);
    crease_sheet_free(sheets[1]);
    free(points);
    crease_context_free(context);
}

static void given_any_number_of_threads_then_the_bytes_are_the_same(void **state)
{
    double *points = given_roof(POINTS, 1e-3);
    double *controls[2];
    for (int i = 0; i < 2; i++) {
        crease_context *context = given_context_with_threads(i ? 3 : 1);
        crease_sheet_sum *sum = given_sum(context, points, 90, 90);
        crease_sheet *sheet = when_solved(context, sum, points, POINTS, 10000);
        const crease_surface_parts parts = crease_surface_parts_of(crease_sheet_surface(sheet));
        controls[i] = malloc(90 * 90 * 3 * sizeof(double));
        assert_non_null(controls[i]);
        memcpy(controls[i], parts.control_points, 90 * 90 * 3 * sizeof(double));
        crease_sheet_free(sheet);
        crease_sheet_sum_free(sum);
        crease_context_free(context);
    }
    assert_memory_equal(controls[0], controls[1], 90 * 90 * 3 * sizeof(double));
    free(controls[0]);
    free(controls[1]);
    free(points);
}

static void given_outliers_far_away_then_the_rectangle_stays(void **state)
{
    crease_context *context = given_context();
    double *points = given_roof(POINTS, 0), domain[2];
    crease_sheet_sum *sum = given_sum(context, points, 7, 7);
    for (size_t i = SAMPLED + 1; i < POINTS; i += 500) {
        points[3 * i] = 50;
        points[3 * i + 2] = -30;
    }
    crease_sheet *sheet = when_solved(context, sum, points, POINTS, POINTS);
    crease_surface_domain(crease_sheet_surface(sheet), 0, domain);
    assert_true(domain[1] - domain[0] < 1.5);
    const double truth[3] = {0.3, 0.2, -fabs(cos(0.35) * 0.3 + sin(0.35) * 0.2)};
    double distance;
    assert_int_equal(crease_sheet_sum_distances(context, sum, truth, 1, &distance), CREASE_OK);
    assert_near(distance, 0, 1e-9);
    crease_sheet_free(sheet);
    crease_sheet_sum_free(sum);
    free(points);
    crease_context_free(context);
}

static void given_a_wrong_order_or_value_then_it_is_told(void **state)
{
    crease_context *context = given_context();
    double *points = given_roof(POINTS, 0), distance;
    crease_sheet_sum *sum = given_sum(context, points, 7, 7);
    crease_sheet *sheet = NULL;
    assert_int_equal(crease_sheet_sum_solve(context, sum, &sheet), CREASE_ERROR_ARGUMENT);
    assert_null(sheet);
    assert_int_equal(
        crease_sheet_sum_distances(context, sum, points, 1, &distance), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_sheet_sum_add(context, sum, points, 0), CREASE_OK);
    assert_int_equal(crease_sheet_sum_count(sum), 0);
    const double bad[3] = {0, NAN, 0};
    assert_int_equal(crease_sheet_sum_widen(context, sum, bad, 1), CREASE_ERROR_VALUE);
    assert_int_equal(crease_sheet_sum_add(context, sum, bad, 1), CREASE_ERROR_VALUE);
    assert_int_equal(crease_sheet_sum_add(context, sum, points, POINTS), CREASE_OK);
    assert_int_equal(crease_sheet_sum_widen(context, sum, points, 1), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_sheet_sum_solve(context, sum, &sheet), CREASE_OK);
    crease_sheet_free(sheet);
    crease_sheet_sum_free(sum);
    crease_sheet_sum_free(NULL);
    free(points);
    crease_context_free(context);
}

static void given_a_file_then_all_its_points_are_fitted_and_measured(void **state)
{
    char folder[] = "/tmp/crease-test-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/in.ply", folder);
    crease_context *context = given_context();
    double *points = given_roof(POINTS, 1e-3);
    crease_cloud *cloud = given_cloud_of(context, points, POINTS), *sample;
    assert_int_equal(crease_cloud_write(context, cloud, path), CREASE_OK);
    crease_fit_stream_options options = crease_fit_stream_options_default();
    crease_fit_stream_summary summary;
    crease_sheet *sheet;
    options.memory = 12000000;
    options.sheet.net[0] = options.sheet.net[1] = 12;
    assert_int_equal(
        crease_sheet_fit_stream(context, path, &options, &summary, &sample, &sheet), CREASE_OK);
    assert_int_equal(summary.count, POINTS);
    assert_int_equal(summary.sampled, crease_cloud_count(sample));
    assert_true(summary.sampled < POINTS / 2);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    assert_near(summary.rms, 1e-3 * sqrt(0.5), 2e-5);
    assert_near(summary.p95, 1.96e-3 * sqrt(0.5), 4e-5);
    assert_near(summary.mean, 0, 2e-5);
    assert_true(summary.most > 3e-3 * sqrt(0.5) && summary.most < 6e-3);
    assert_near(summary.lowest[0], -0.5, 1e-3);
    crease_sheet_free(sheet);
    crease_cloud_free(sample);
    options.sheet.net[0] = options.sheet.net[1] = 2048;
    assert_int_equal(crease_sheet_fit_stream(context, path, &options, &summary, &sample, &sheet),
        CREASE_ERROR_ARGUMENT);
    assert_null(sheet);
    crease_cloud_free(cloud);
    free(points);
    crease_context_free(context);
    unlink(path);
    assert_int_equal(rmdir(folder), 0);
}

/* The sheet so far as another process has it. */
static crease_sheet_sum *given_copy(crease_context *context, const crease_sheet_sum *sum)
{
    crease_sheet_sum *copy = NULL;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    char *bytes = NULL;
    size_t size = 0;
    assert_int_equal(crease_sheet_sum_pack(context, sum, &bytes, &size), CREASE_OK);
    for (long n = 0; status != CREASE_OK; n++) {
        crease_context_fail_allocation(context, n);
        status = crease_sheet_sum_unpack(context, bytes, &copy);
        crease_context_fail_allocation(context, -1);
        assert_true(n < 1000 && (status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY));
    }
    free(bytes);
    return copy;
}

/* One round, every batch observed by a copy. */
static crease_sheet *when_shared_out(crease_context *context, crease_sheet_sum *sum,
    const double *points, size_t count, size_t batch)
{
    double *const numbers = calloc(batch, CREASE_OBSERVED * sizeof *numbers);
    crease_sheet *sheet = NULL;
    assert_non_null(numbers);
    assert_int_equal(crease_sheet_sum_begin(context, sum), CREASE_OK);
    for (size_t at = 0; at < count; at += batch) {
        const size_t some = count - at < batch ? count - at : batch;
        crease_sheet_sum *const copy = given_copy(context, sum);
        assert_int_equal(
            crease_sheet_sum_observe(context, copy, points + 3 * at, some, numbers), CREASE_OK);
        assert_int_equal(crease_sheet_sum_take(context, sum, numbers, some), CREASE_OK);
        crease_sheet_sum_free(copy);
    }
    assert_int_equal(crease_sheet_sum_solve(context, sum, &sheet), CREASE_OK);
    free(numbers);
    return sheet;
}

static void given_points_observed_elsewhere_then_the_sheet_is_the_same_bytes(void **state)
{
    enum { COUNT = 12000, BATCH = 5000 };
    crease_context *context = given_context_with_threads(1);
    double *points = given_roof(COUNT, 1e-3), a[7] = {0}, b[7] = {0};
    crease_sheet_sum *alone = given_sum(context, points, 9, 11);
    crease_sheet_sum *shared = given_sum(context, points, 9, 11),
                     *copy = given_copy(context, shared);
    crease_sheet *one = NULL;
    assert_int_equal(crease_sheet_sum_widen(context, alone, points, COUNT), CREASE_OK);
    assert_int_equal(crease_sheet_sum_widen(context, copy, points, COUNT), CREASE_OK);
    shared->all = copy->all;
    for (size_t at = 0; at < COUNT; at += BATCH)
        assert_int_equal(crease_sheet_sum_add(context, alone, points + 3 * at,
                             COUNT - at < BATCH ? COUNT - at : BATCH),
            CREASE_OK);
    assert_int_equal(crease_sheet_sum_solve(context, alone, &one), CREASE_OK);
    crease_sheet *other = when_shared_out(context, shared, points, COUNT, BATCH);
    const crease_surface_parts p = crease_surface_parts_of(crease_sheet_surface(one));
    const crease_surface_parts q = crease_surface_parts_of(crease_sheet_surface(other));
    assert_memory_equal(p.control_points, q.control_points, 9 * 11 * 3 * sizeof(double));
    crease_sheet_sum_free(copy);
    copy = given_copy(context, shared);
    assert_int_equal(crease_sheet_sum_distances(context, alone, points, 7, a), CREASE_OK);
    assert_int_equal(crease_sheet_sum_distances(context, copy, points, 7, b), CREASE_OK);
    assert_memory_equal(a, b, sizeof a);
    crease_sheet_free(one);
    crease_sheet_free(other);
    crease_sheet_sum_free(copy);
    crease_sheet_sum_free(alone);
    crease_sheet_sum_free(shared);
    free(points);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_exact_points_then_a_small_net_is_exact),
        cmocka_unit_test(given_a_net_for_iterations_then_it_is_that_of_the_points),
        cmocka_unit_test(given_other_batches_then_the_sheet_is_the_same),
        cmocka_unit_test(given_any_number_of_threads_then_the_bytes_are_the_same),
        cmocka_unit_test(given_outliers_far_away_then_the_rectangle_stays),
        cmocka_unit_test(given_a_wrong_order_or_value_then_it_is_told),
        cmocka_unit_test(given_points_observed_elsewhere_then_the_sheet_is_the_same_bytes),
        cmocka_unit_test(given_a_file_then_all_its_points_are_fitted_and_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
