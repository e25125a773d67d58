/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Sheets where there are no points, where a few stray, and where there are only a few rows. */
#include "given.h"

#include "base/random.h"
#include "fit/group.h"
#include "net/gaps.h"

#include <stdlib.h>

enum { MOST = 6000 };

typedef struct scattered {
    double points[MOST][3];
    size_t count;
    double low, high; /* of the heights */
} scattered;

static void put(scattered *s, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    memcpy(s->points[s->count++], p, sizeof p);
    s->low = fmin(s->low, z);
    s->high = fmax(s->high, z);
}

/* Random places of the unit square where `there` holds, under a height. */
static scattered *given_scattered(size_t count, double noise, bool (*there)(double x, double y),
    double (*height)(double x, double y))
{
    scattered *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->low = INFINITY, s->high = -INFINITY;
    for (uint64_t i = 0; s->count < count; i++) {
        const double x = crease_random_uniform(3, 1, 2 * i);
        const double y = crease_random_uniform(3, 1, 2 * i + 1);
        if (there(x, y))
            put(s, x, y, height(x, y) + noise * crease_random_normal(3, 2, i));
    }
    return s;
}

static bool everywhere(double x, double y)
{
    (void)x, (void)y;
    return true;
}

static bool around_a_hole(double x, double y)
{
    return hypot(x - 0.55, y - 0.45) > 0.27;
}

static bool in_an_l(double x, double y)
{
    return x < 0.45 || y < 0.4;
}

static double plane(double x, double y)
{
    return 0.3 * x - 0.2 * y;
}

static double wave(double x, double y)
{
    return 0.15 * sin(9 * x + 2 * y + 4) * cos(5 * y + 4);
}

static crease_sheet *when_fitted(
    crease_context *context, const scattered *s, const crease_sheet_options *options)
{
    crease_sheet *sheet = NULL;
    crease_cloud *cloud = given_cloud_of(context, s->points[0], s->count);
    if (crease_sheet_fit(context, cloud, options, &sheet) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    crease_cloud_free(cloud);
    return sheet;
}

static crease_sheet_options as_it_is(void)
{
    crease_sheet_options options = crease_sheet_options_default();
    options.orientation = CREASE_ORIENTATION_NONE;
    return options;
}

/* How far the sheet leaves the heights of the data, in their range. */
static double overshoot(const crease_sheet *sheet, const scattered *s)
{
    enum { STEPS = 100 };
    const crease_surface *const surface = crease_sheet_surface(sheet);
    double domain[2][2], most = 0;
    for (int d = 0; d < 2; d++)
        crease_surface_domain(surface, d, domain[d]);
    for (int i = 0; i <= STEPS; i++)
        for (int j = 0; j <= STEPS; j++) {
            const double uv[2] = {domain[0][0] + (domain[0][1] - domain[0][0]) * i / STEPS,
                domain[1][0] + (domain[1][1] - domain[1][0]) * j / STEPS};
            double p[3];
            crease_surface_point(surface, uv, p);
            most = fmax(most, fmax(p[2] - s->high, s->low - p[2]));
        }
    return most / (s->high - s->low);
}

static double root_mean_square(const crease_sheet *sheet, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += pow(crease_sheet_deviations(sheet)[i], 2);
    return sqrt(sum / (double)count);
}

static void given_a_large_hole_then_the_sheet_stays_within_the_heights_around_it(void **state)
{
    crease_context *context = given_context();
    scattered *s = given_scattered(1500, 0.004, around_a_hole, wave);
    const crease_sheet_options options = as_it_is();
    crease_sheet *sheet = when_fitted(context, s, &options);
    assert_true(overshoot(sheet, s) < 0.05);
    assert_true(root_mean_square(sheet, s->count) < 0.006);
    crease_sheet_free(sheet);
    free(s);
    crease_context_free(context);
}

static void given_points_in_an_l_then_the_sheet_stays_bounded_in_its_corner(void **state)
{
    crease_context *context = given_context();
    scattered *s = given_scattered(1500, 0.004, in_an_l, wave);
    const crease_sheet_options options = as_it_is();
    crease_sheet *sheet = when_fitted(context, s, &options);
    assert_true(overshoot(sheet, s) < 0.1);
    assert_true(root_mean_square(sheet, s->count) < 0.006);
    crease_sheet_free(sheet);
    free(s);
    crease_context_free(context);
}

static void given_gaps_in_exact_data_then_the_fit_is_exact(void **state)
{
    crease_context *context = given_context();
    bool (*const places[])(double, double) = {in_an_l, around_a_hole};
    for (int i = 0; i < 2; i++) {
        scattered *s = given_scattered(1500, 0, places[i], plane);
        const crease_sheet_options options = as_it_is();
        crease_sheet *sheet = when_fitted(context, s, &options);
        assert_true(root_mean_square(sheet, s->count) < 1e-10);
        crease_sheet_free(sheet);
        free(s);
    }
    crease_context_free(context);
}

static void given_more_control_points_than_data_then_no_swing_between_the_points(void **state)
{
    crease_context *context = given_context();
    for (int noisy = 0; noisy < 2; noisy++) {
        scattered *s = given_scattered(400, noisy ? 0.02 : 0, everywhere, wave);
        crease_sheet_options options = as_it_is();
        options.net[0] = options.net[1] = 30;
        options.creases = 0;
        crease_sheet *sheet = when_fitted(context, s, &options);
        assert_true(overshoot(sheet, s) < 0.1);
        crease_sheet_free(sheet);
        free(s);
    }
    crease_context_free(context);
}

/* As on a real scan: a group far below, where the sheet has no other points. */
static void given_a_group_of_stray_points_then_it_is_set_aside(void **state)
{
    crease_context *context = given_context();
    scattered *s = given_scattered(1500, 0.002, in_an_l, wave);
    scattered *const all = malloc(sizeof *all);
    assert_non_null(all);
    memcpy(all, s, sizeof *s);
    for (uint64_t i = 0; i < 30; i++)
        put(all, 0.8 + 0.1 * crease_random_uniform(3, 3, 2 * i),
            0.8 + 0.1 * crease_random_uniform(3, 3, 2 * i + 1), -1);
    const crease_sheet_options options = as_it_is();
    crease_sheet *sheet = when_fitted(context, all, &options);
    assert_true(overshoot(sheet, s) < 0.1);
    for (size_t i = s->count; i < all->count; i++)
        assert_true(fabs(crease_sheet_deviations(sheet)[i]) > 0.5);
    crease_sheet_free(sheet);
    free(s);
    free(all);
    crease_context_free(context);
}

static void given_three_noisy_rows_then_the_crease_is_found_and_nothing_blows_up(void **state)
{
    enum { SEEDS = 6 };
    crease_context *context = given_context();
    for (int roof = 0; roof < 2; roof++) {
        double off = 0;
        for (uint64_t variant = 0; variant < SEEDS; variant++) {
            crease_sample_options options = crease_sample_options_default();
            options.across = 3, options.along = 17, options.roof = roof;
            options.noise = 0.32, options.variant = variant;
            crease_cloud *cloud = NULL;
            crease_sheet *sheet = NULL;
            assert_int_equal(crease_shape_sample(context, &options, &cloud), CREASE_OK);
            assert_int_equal(crease_sheet_fit(context, cloud, NULL, &sheet), CREASE_OK);
            const crease_accuracy a = crease_sample_accuracy(&options, sheet);
            assert_int_equal(a.lines, 1);
            assert_true(a.max < 2 * options.spacing);
            off += a.position / options.spacing / SEEDS;
            crease_sheet_free(sheet);
            crease_cloud_free(cloud);
        }
        assert_true(off < 0.15);
    }
    crease_context_free(context);
}

/* Noise that leaves no sheet with a crease near the points. */
static void given_three_rows_without_a_crease_then_the_sheet_stays_near_them(void **state)
{
    crease_context *context = given_context();
    crease_sample_options options = crease_sample_options_default();
    options.across = 3, options.along = 17, options.roof = true;
    options.noise = 0.48, options.variant = 94;
    crease_cloud *cloud = NULL;
    crease_sheet *sheet = NULL;
    assert_int_equal(crease_shape_sample(context, &options, &cloud), CREASE_OK);
    assert_int_equal(crease_sheet_fit(context, cloud, NULL, &sheet), CREASE_OK);
    const crease_accuracy a = crease_sample_accuracy(&options, sheet);
    assert_true(a.max < 4 * options.spacing);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_samples_then_gaps_are_where_no_point_is_near(void **state)
{
    crease_context *context = given_context();
    scattered *s = given_scattered(2500, 0, around_a_hole, plane);
    double *keep = calloc(s->count, sizeof *keep);
    assert_non_null(keep);
    for (size_t i = 0; i < s->count; i++)
        keep[i] = 1;
    const crease_frame frame = {.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    crease_samples samples;
    crease_layout layout = {.order = 4};
    double low[2], high[2];
    assert_int_equal(
        crease_samples_create(context, s->points[0], keep, s->count, 1, 0.018, 1e-16, &samples),
        CREASE_OK);
    crease_samples_place(&samples, &frame, low, high);
    for (int d = 0; d < 2; d++)
        layout.axis[d].low = low[d], layout.axis[d].high = high[d];
    crease_gaps gaps;
    assert_int_equal(crease_gaps_create(context, &samples, &layout, &gaps), CREASE_OK);
    for (int i = 0; i <= 50; i++)
        for (int j = 0; j <= 50; j++) {
            const double x = i / 50.0, y = j / 50.0, r = hypot(x - 0.55, y - 0.45);
            if (r > 0.28 || r < 0.1)
                assert_int_equal(crease_gaps_at(&gaps, x, y), r < 0.1);
        }
    crease_gaps_free(&gaps);
    crease_samples_free(&samples);
    free(keep);
    free(s);
    crease_context_free(context);
}

static void given_points_apart_then_groups_have_their_sizes(void **state)
{
    crease_context *context = given_context();
    const double points[8][3] = {{0, 0, 0}, {0.9, 0.9, 0.9}, {1.8, 1.8, 1.8}, {9, 0, 0}, {-5, 0, 0},
        {9.1, 0.1, 0}, {1e9, 0, 0}, {0.5, 0, 0}};
    const double keep[8] = {1, 1, 1, 1, 1, 1, 1, 0};
    const size_t sizes[8] = {3, 3, 3, 2, 1, 2, 1, 0};
    size_t found[8];
    assert_int_equal(crease_group_sizes(context, points[0], keep, 8, 1.0, found), CREASE_OK);
    assert_memory_equal(found, sizes, sizeof sizes);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_large_hole_then_the_sheet_stays_within_the_heights_around_it),
        cmocka_unit_test(given_points_in_an_l_then_the_sheet_stays_bounded_in_its_corner),
        cmocka_unit_test(given_gaps_in_exact_data_then_the_fit_is_exact),
        cmocka_unit_test(given_more_control_points_than_data_then_no_swing_between_the_points),
        cmocka_unit_test(given_a_group_of_stray_points_then_it_is_set_aside),
        cmocka_unit_test(given_three_noisy_rows_then_the_crease_is_found_and_nothing_blows_up),
        cmocka_unit_test(given_three_rows_without_a_crease_then_the_sheet_stays_near_them),
        cmocka_unit_test(given_samples_then_gaps_are_where_no_point_is_near),
        cmocka_unit_test(given_points_apart_then_groups_have_their_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
