/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Standard errors of a fit beside the scatter of many fits. */
#include "given.h"

#include "base/random.h"
#include "fit/covariance.h"
#include "fit/lines.h"

enum { SIDE = 20, COUNT = SIDE * SIDE, FITS = 150, SEEDS = 12 };

static const double SIGMA = 0.01;

/* Two cubic faces that meet in a crease at x = 0.4. */
static double height_at(double x, double y)
{
    return 0.2 * x * x * y + 0.1 * y * y * y + (x > 0.4 ? (x - 0.4) * (1.0 + 0.3 * y) : 0.0);
}

/* A grid of points that is shaken a little, the same each time, and noise of this number. */
static void given_points(uint64_t number, double *points)
{
    for (size_t i = 0; i < COUNT; i++) {
        double *const p = points + 3 * i;
        p[0] = ((double)(i / SIDE) + crease_random_uniform(1, 0, i)) / SIDE;
        p[1] = ((double)(i % SIDE) + crease_random_uniform(1, 1, i)) / SIDE;
        p[2] = height_at(p[0], p[1]) + SIGMA * crease_random_normal(2, number, i);
    }
}

/* The fit to one set of points, next to no smoothing. Frees nothing. */
static void when_fitted(
    crease_context *context, const double *points, crease_samples *samples, crease_draft *draft)
{
    static double keep[COUNT];
    for (size_t i = 0; i < COUNT; i++)
        keep[i] = 1.0;
    assert_int_equal(
        crease_samples_create(context, points, keep, COUNT, 1, 1.0 / SIDE, 1e-16, samples),
        CREASE_OK);
    *draft = (crease_draft){.samples = samples,
        .frame = {.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}},
        .layout = {.order = 4, .axis = {{.line_count = 1, .lines = {0.4}}, {.smooth = 1}}},
        .fixed_lambda = 1e-12};
    crease_draft_place(draft);
    assert_int_equal(crease_draft_fit(context, draft, 3, CREASE_CHOICE_NONE), CREASE_OK);
    draft->redescending = true;
    assert_int_equal(crease_lines_refine(context, draft, 6, false), CREASE_OK);
}

/* Errors along the normal, of heights straight over the points. */
static void given_many_fits_then_their_scatter_is_what_the_errors_say(void **state)
{
    static double points[3 * COUNT], errors[COUNT], told[COUNT], squares[COUNT];
    double line_square = 0.0, line_told = 0.0;
    crease_context *context = given_context();
    for (uint64_t k = 0; k < FITS; k++) {
        crease_samples samples;
        crease_draft draft;
        crease_covariance covariance;
        double lines[2 * CREASE_MOST_LINES];
        given_points(k, points);
        when_fitted(context, points, &samples, &draft);
        assert_int_equal(crease_covariance_create(context, &draft, false, &covariance), CREASE_OK);
        assert_int_equal(crease_covariance_points(context, &covariance, errors), CREASE_OK);
        crease_covariance_lines(&covariance, lines);
        line_square += pow(draft.layout.axis[0].lines[0] - 0.4, 2) / FITS;
        line_told += lines[0] * lines[0] / FITS;
        for (size_t i = 0; i < COUNT; i++) {
            const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
            double f[3];
            crease_height_at(&draft.height, points + 3 * i, sides, 0, f);
            squares[i] += pow(f[0] - height_at(points[3 * i], points[3 * i + 1]), 2) / FITS;
            told[i] += errors[i] * errors[i] / FITS;
        }
        crease_covariance_free(&covariance);
        crease_draft_free(&draft);
        crease_samples_free(&samples);
    }
    assert_near(sqrt(line_told / line_square), 1.0, 0.2);
    double sum = 0.0;
    size_t off = 0;
    for (size_t i = 0; i < COUNT; i++) {
        sum += sqrt(told[i] / squares[i]) / COUNT;
        off += fabs(sqrt(told[i] / squares[i]) - 1.0) < 0.25 ? 0 : 1;
    }
    assert_near(sum, 1.0, 0.05); /* 6 % is the error of the scatter at one point */
    assert_true(off < COUNT / 20);
    crease_context_free(context);
}

/* Through the whole fit: the errors cover the true deviation, and shrink as the points grow. */
static void given_a_sheet_then_its_errors_tell_how_far_off_it_is(void **state)
{
    enum { MANY = 1600 };
    static double points[3 * MANY];
    crease_context *context = given_context();
    const crease_sheet_options options = {
        .orientation = CREASE_ORIENTATION_NONE, .order = 4, .creases = 1, .smoothing = -1.0};
    double square[2] = {0}, told[2] = {0};
    for (uint64_t k = 0; k < SEEDS; k++) {
        const size_t large = k % 2, count = large ? MANY : MANY / 4;
        for (size_t i = 0; i < count; i++) {
            double *const p = points + 3 * i;
            p[0] = crease_random_uniform(k, 3, i) - 0.5;
            p[1] = crease_random_uniform(k, 4, i);
            p[2] = 0.5 - 0.5 * fabs(p[0]) + SIGMA * crease_random_normal(k, 5, i);
        }
        crease_sheet *sheet = NULL;
        crease_cloud *cloud = given_cloud_of(context, points, count);
        assert_int_equal(crease_sheet_fit(context, cloud, &options, &sheet), CREASE_OK);
        const double *const errors = crease_sheet_standard_errors(sheet);
        assert_non_null(errors);
        for (size_t i = 0; i < count; i++) {
            const double *const foot = crease_sheet_projected(sheet) + 3 * i;
            square[large] +=
                pow((foot[2] - 0.5 + 0.5 * fabs(foot[0])) / sqrt(1.25), 2) / (double)count;
            told[large] += errors[i] * errors[i] / (double)count;
        }
        crease_sheet_free(sheet);
        crease_cloud_free(cloud);
    }
    for (int i = 0; i < 2; i++)
        assert_near(log(told[i] / square[i]), 0.0, log(3.0));
    assert_near(sqrt(told[0] / told[1]), 2.0, 0.5); /* four times the points */
    crease_context_free(context);
}

static void given_a_large_net_then_no_errors_are_known(void **state)
{
    static double points[3 * COUNT];
    crease_context *context = given_context();
    given_points(0, points);
    const crease_cloud_parts parts = {
        .count = COUNT, .points = points, .coordinate_type = CREASE_TYPE_FLOAT64};
    crease_cloud *cloud = NULL;
    crease_sheet *sheet = NULL;
    crease_sheet_options options = crease_sheet_options_default();
    options.orientation = CREASE_ORIENTATION_NONE;
    options.net[0] = options.net[1] = 70;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    assert_int_equal(crease_sheet_fit(context, cloud, &options, &sheet), CREASE_OK);
    assert_null(crease_sheet_standard_errors(sheet));
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_many_fits_then_their_scatter_is_what_the_errors_say),
        cmocka_unit_test(given_a_sheet_then_its_errors_tell_how_far_off_it_is),
        cmocka_unit_test(given_a_large_net_then_no_errors_are_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
