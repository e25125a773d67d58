/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "noise/footing.h"

static const double spacing = 0.02;
static const double sigma = 0.32 * 0.02;

typedef void maker(size_t i, double point[3]);

static double draw(size_t i, uint64_t stream)
{
    return crease_random_uniform(5, stream, i);
}

static double noise(size_t i, uint64_t stream)
{
    return sigma * crease_random_normal(5, stream, i);
}

/* A jittered grid of rows of 50 points: even as scans are. */
static void grid(size_t i, double *u, double *v)
{
    *u = spacing * ((double)(i % 50) + 0.8 * draw(i, 0));
    *v = spacing * ((double)(i / 50) + 0.8 * draw(i, 1));
}

static void plane(size_t i, double point[3])
{
    grid(i, point, point + 1);
    point[2] = noise(i, 2);
}

static void exact_plane(size_t i, double point[3])
{
    grid(i, point, point + 1);
    point[2] = 0;
}

static const double radius = 0.25;

static void cylinder(size_t i, double point[3])
{
    double along;
    grid(i, &along, point + 1);
    const double angle = along / radius, from = radius + noise(i, 2);
    point[0] = from * cos(angle), point[2] = from * sin(angle);
}

/* Two planes at 90 degrees, their edge along y, noise in all directions. */
static void roof(size_t i, double point[3])
{
    double across;
    grid(i, &across, point + 1);
    across -= 0.5;
    point[0] = fmin(across, 0) + noise(i, 2);
    point[1] += noise(i, 3);
    point[2] = fmin(-across, 0) + noise(i, 4);
}

static double roof_distance(const double p[3])
{
    const double level = p[0] <= 0 ? fabs(p[2]) : hypot(p[0], p[2]);
    const double upright = p[2] <= 0 ? fabs(p[0]) : hypot(p[0], p[2]);
    return fmin(level, upright);
}

/* Every hundredth point lies anywhere in the box around the roof. */
static void roof_with_outliers(size_t i, double point[3])
{
    roof(i, point);
    if (i % 100)
        return;
    point[0] = -0.5 + draw(i, 5), point[2] = -0.5 + draw(i, 6);
}

static crease_cloud *given_cloud(crease_context *context, maker *make, size_t count)
{
    double *points = malloc(count * 3 * sizeof *points),
           *normals = malloc(count * 3 * sizeof *points);
    int32_t *numbers = malloc(count * sizeof *numbers);
    crease_cloud *cloud = NULL;
    assert_true(points && normals && numbers);
    for (size_t i = 0; i < count; i++) {
        make(i, points + 3 * i);
        numbers[i] = (int32_t)i;
        for (size_t c = 0; c < 3; c++)
            normals[3 * i + c] = (double)(i + c);
    }
    const crease_field field = {"number", CREASE_TYPE_INT32, numbers};
    const crease_cloud_parts parts = {.count = count,
        .points = points,
        .normals = normals,
        .fields = &field,
        .field_count = 1,
        .coordinate_type = CREASE_TYPE_FLOAT32};
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    free(points);
    free(normals);
    free(numbers);
    return cloud;
}

static crease_filtered *given_filtered(
    maker *make, size_t count, const crease_filter_options *options, int threads)
{
    crease_context *context = given_context_with_threads(threads);
    crease_cloud *cloud = given_cloud(context, make, count);
    crease_filtered *filtered = NULL;
    assert_int_equal(crease_cloud_filter(context, cloud, options, &filtered), CREASE_OK);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return filtered;
}

static const double *points_of(const crease_filtered *filtered)
{
    return crease_cloud_points(crease_filtered_cloud(filtered));
}

static bool inside(size_t i, size_t count)
{
    const size_t column = i % 50, row = i / 50;
    return column >= 5 && column < 45 && row >= 5 && row < count / 50 - 5;
}

static void given_noise_on_a_plane_then_it_falls_as_the_window_says(void **state)
{
    enum { COUNT = 2500 };
    crease_filtered *filtered = given_filtered(plane, COUNT, NULL, 2);
    double sum = 0;
    size_t used = 0;
    for (size_t i = 0; i < COUNT; i++)
        if (inside(i, COUNT)) {
            const double z = points_of(filtered)[3 * i + 2];
            sum += z * z;
            used++;
        }
    /* weights (1 - r^2)^2 over 64 points: sum w^2 / (sum w)^2 = 9 / (5 x 64) for a plane */
    const double expected = sigma * sqrt(9.0 / (5 * 64));
    assert_near(sqrt(sum / (double)used) / expected, 1, 0.3);
    assert_near(crease_filtered_sigma(filtered) / sigma, 1, 0.1);
    assert_near(crease_filtered_movement(filtered) / sigma, 1, 0.1);
    assert_near(crease_filtered_spacing(filtered) / spacing, 1, 0.1);
    assert_true(crease_filtered_sigma_after(filtered) < 0.3 * sigma);
    assert_int_equal(crease_filtered_outlier_count(filtered), 0);
    crease_filtered_free(filtered);
}

static void given_noise_on_a_cylinder_then_it_falls_and_the_radius_hardly_shrinks(void **state)
{
    enum { COUNT = 2500 };
    crease_filtered *filtered = given_filtered(cylinder, COUNT, NULL, 2);
    double sum = 0, mean = 0;
    size_t used = 0;
    for (size_t i = 0; i < COUNT; i++)
        if (inside(i, COUNT)) {
            const double *p = points_of(filtered) + 3 * i;
            const double off = hypot(p[0], p[2]) - radius;
            sum += off * off, mean += off;
            used++;
        }
    assert_true(sqrt(sum / (double)used) < 0.45 * sigma);
    assert_true(fabs(mean / (double)used) < 0.35 * sigma);
    crease_filtered_free(filtered);
}

static void given_no_noise_then_nothing_moves(void **state)
{
    crease_filtered *filtered = given_filtered(exact_plane, 2000, NULL, 2);
    for (size_t i = 0; i < 2000; i++)
        assert_near(points_of(filtered)[3 * i + 2], 0, 1e-12);
    assert_true(crease_filtered_movement(filtered) < 1e-12);
    crease_filtered_free(filtered);
}

static void given_an_edge_then_points_beside_it_come_closer_to_the_faces(void **state)
{
    enum { COUNT = 2500 };
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context, roof, COUNT);
    crease_filtered *filtered = given_filtered(roof, COUNT, NULL, 2);
    double before[2] = {0}, after[2] = {0};
    size_t counts[2] = {0};
    for (size_t i = 0; i < COUNT; i++) {
        const double *p = crease_cloud_points(cloud) + 3 * i, *q = points_of(filtered) + 3 * i;
        const int away = hypot(p[0], p[2]) > spacing;
        if (!inside(i, COUNT))
            continue;
        before[away] += pow(roof_distance(p), 2);
        after[away] += pow(roof_distance(q), 2);
        counts[away]++;
    }
    assert_true(counts[0] > 60 && counts[1] > 1000);
    assert_true(sqrt(after[0] / before[0]) < 0.8);
    assert_true(sqrt(after[1] / before[1]) < 0.35);
    crease_filtered_free(filtered);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_outliers_then_they_are_marked_and_stay(void **state)
{
    enum { COUNT = 2500 };
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context, roof_with_outliers, COUNT);
    crease_filtered *filtered = given_filtered(roof_with_outliers, COUNT, NULL, 2);
    const uint8_t *outliers = crease_filtered_outliers(filtered);
    const crease_field field = crease_cloud_find_field(crease_filtered_cloud(filtered), "outlier");
    size_t far = 0, found = 0, wrong = 0;
    for (size_t i = 0; i < COUNT; i++) {
        const double *p = crease_cloud_points(cloud) + 3 * i;
        const bool is_far = i % 100 == 0 && roof_distance(p) > 2 * spacing;
        far += is_far;
        found += is_far && outliers[i];
        wrong += i % 100 && outliers[i];
        assert_true(crease_field_value(&field, i) == outliers[i]);
        if (outliers[i])
            assert_memory_equal(p, points_of(filtered) + 3 * i, 3 * sizeof *p);
    }
    assert_true(far > 15);
    assert_int_equal(found, far);
    assert_in_range(wrong, 0, 1);
    assert_in_range(crease_filtered_outlier_count(filtered), found, COUNT / 100 + wrong);
    crease_filtered_free(filtered);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_outliers_to_be_removed_then_the_rest_keeps_its_fields_and_order(void **state)
{
    enum { COUNT = 2500 };
    crease_filter_options options = crease_filter_options_default();
    options.remove_outliers = true;
    crease_filtered *all = given_filtered(roof_with_outliers, COUNT, NULL, 2);
    crease_filtered *rest = given_filtered(roof_with_outliers, COUNT, &options, 2);
    const crease_cloud *cloud = crease_filtered_cloud(rest);
    const crease_field number = crease_cloud_find_field(cloud, "number");
    assert_null(crease_cloud_find_field(cloud, "outlier").name);
    assert_int_equal(crease_cloud_coordinate_type(cloud), CREASE_TYPE_FLOAT32);
    size_t next = 0;
    for (size_t i = 0; i < COUNT; i++) {
        if (crease_filtered_outliers(all)[i])
            continue;
        assert_true(crease_field_value(&number, next) == (double)i);
        assert_true(crease_cloud_normals(cloud)[3 * next] == (double)i);
        assert_memory_equal(points_of(all) + 3 * i, points_of(rest) + 3 * next, 24);
        next++;
    }
    assert_int_equal(next, crease_cloud_count(cloud));
    assert_int_equal(next, COUNT - crease_filtered_outlier_count(rest));
    crease_filtered_free(all);
    crease_filtered_free(rest);
}

static void given_no_passes_then_outliers_are_found_and_nothing_moves(void **state)
{
    crease_filter_options options = crease_filter_options_default();
    options.passes = 0;
    crease_filtered *filtered = given_filtered(roof_with_outliers, 2500, &options, 2);
    assert_true(crease_filtered_movement(filtered) == 0);
    assert_true(crease_filtered_outlier_count(filtered) > 15);
    crease_filtered_free(filtered);
}

static void given_a_known_noise_then_it_is_used(void **state)
{
    crease_filter_options options = crease_filter_options_default();
    options.sigma = 2 * sigma;
    crease_filtered *filtered = given_filtered(plane, 1000, &options, 2);
    assert_true(crease_filtered_sigma(filtered) == 2 * sigma);
    crease_filtered_free(filtered);
}

static void given_any_number_of_threads_then_the_points_are_the_same_bytes(void **state)
{
    enum { COUNT = 2000 };
    crease_filtered *one = given_filtered(roof_with_outliers, COUNT, NULL, 1);
    crease_filtered *four = given_filtered(roof_with_outliers, COUNT, NULL, 4);
    assert_memory_equal(points_of(one), points_of(four), 3 * COUNT * sizeof(double));
    assert_memory_equal(crease_filtered_outliers(one), crease_filtered_outliers(four), COUNT);
    crease_filtered_free(one);
    crease_filtered_free(four);
}

static void doubled(size_t i, double point[3])
{
    plane(i / 2, point);
}

static void line(size_t i, double point[3])
{
    point[0] = (double)i, point[1] = point[2] = 0;
}

static crease_status status_of(maker *make, size_t count, const crease_filter_options *options)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context, make, count);
    crease_filtered *filtered = NULL;
    const crease_status status = crease_cloud_filter(context, cloud, options, &filtered);
    assert_true((status == CREASE_OK) == (filtered != NULL));
    assert_true((status == CREASE_OK) == (crease_context_message(context)[0] == 0));
    crease_filtered_free(filtered);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return status;
}

static void given_few_doubled_or_lined_up_points_then_it_works_or_says_why(void **state)
{
    assert_int_equal(status_of(plane, 3, NULL), CREASE_ERROR_TOO_FEW_POINTS);
    assert_int_equal(status_of(plane, 4, NULL), CREASE_OK);
    assert_int_equal(status_of(plane, 30, NULL), CREASE_OK);
    assert_int_equal(status_of(doubled, 600, NULL), CREASE_OK);
    assert_int_equal(status_of(line, 100, NULL), CREASE_ERROR_DEGENERATE);
}

static void given_options_out_of_range_then_each_is_refused(void **state)
{
    const crease_filter_options bad[] = {{.neighbours = 24, .outlier_sigmas = 5},
        {.neighbours = 257, .outlier_sigmas = 5}, {.neighbours = 48, .outlier_sigmas = 0},
        {.neighbours = 48, .outlier_sigmas = NAN},
        {.neighbours = 48, .outlier_sigmas = 5, .passes = -1},
        {.neighbours = 48, .outlier_sigmas = 5, .passes = 11},
        {.neighbours = 48, .outlier_sigmas = 5, .sigma = -1},
        {.neighbours = 48, .outlier_sigmas = 5, .sigma = INFINITY}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_int_equal(status_of(plane, 100, &bad[i]), CREASE_ERROR_ARGUMENT);
    crease_filtered_free(NULL);
}

static void given_a_failing_allocation_then_no_memory_and_no_leak(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context, roof_with_outliers, 300);
    for (int removing = 0; removing < 2; removing++) {
        crease_filter_options options = crease_filter_options_default();
        options.remove_outliers = removing;
        crease_filtered *filtered = NULL;
        crease_status status = CREASE_ERROR_NO_MEMORY;
        long n = 0;
        for (; n < 200 && status != CREASE_OK; n++) {
            crease_context_fail_allocation(context, n);
            status = crease_cloud_filter(context, cloud, &options, &filtered);
            assert_true(status == CREASE_OK || (status == CREASE_ERROR_NO_MEMORY && !filtered));
        }
        assert_in_range(n, 20, 199);
        crease_filtered_free(filtered);
    }
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_noise_on_a_plane_then_it_falls_as_the_window_says),
        cmocka_unit_test(given_noise_on_a_cylinder_then_it_falls_and_the_radius_hardly_shrinks),
        cmocka_unit_test(given_no_noise_then_nothing_moves),
        cmocka_unit_test(given_an_edge_then_points_beside_it_come_closer_to_the_faces),
        cmocka_unit_test(given_outliers_then_they_are_marked_and_stay),
        cmocka_unit_test(given_outliers_to_be_removed_then_the_rest_keeps_its_fields_and_order),
        cmocka_unit_test(given_no_passes_then_outliers_are_found_and_nothing_moves),
        cmocka_unit_test(given_a_known_noise_then_it_is_used),
        cmocka_unit_test(given_any_number_of_threads_then_the_points_are_the_same_bytes),
        cmocka_unit_test(given_few_doubled_or_lined_up_points_then_it_works_or_says_why),
        cmocka_unit_test(given_options_out_of_range_then_each_is_refused),
        cmocka_unit_test(given_a_failing_allocation_then_no_memory_and_no_leak),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
