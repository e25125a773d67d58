/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/frame.h"
#include "base/random.h"
#include "cloud/shape.h"

static const double H = 0.03125;

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

static crease_sheet *when_fitted(
    crease_context *context, const crease_cloud *cloud, const crease_sheet_options *options)
{
    crease_sheet *sheet = NULL;
    if (crease_sheet_fit(context, cloud, options, &sheet) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    return sheet;
}

static double largest_deviation(const crease_sheet *sheet)
{
    double most = 0;
    for (size_t i = 0; i < crease_sheet_point_count(sheet); i++)
        most = fmax(most, fabs(crease_sheet_deviations(sheet)[i]));
    return most;
}

static void point_of_line(const crease_sheet *sheet, size_t line, double share, double out[3])
{
    const crease_line l = crease_sheet_line(sheet, line);
    double domain[2], uv[2];
    crease_surface_domain(crease_sheet_surface(sheet), 1 - l.direction, domain);
    uv[l.direction] = l.parameter;
    uv[1 - l.direction] = domain[0] + share * (domain[1] - domain[0]);
    crease_surface_point(crease_sheet_surface(sheet), uv, out);
}

static void given_the_papers_samples_then_the_edge_is_exact(void **state)
{
    crease_context *context = given_context();
    for (int i = 0; i < 4; i++) {
        crease_cloud *cloud = given_sample(context, i & 1 ? 3 : 17, i & 1 ? 17 : 3, i & 2, 0, 0);
        crease_sheet *sheet = when_fitted(context, cloud, NULL);
        assert_int_equal(crease_sheet_line_count(sheet), 1);
        const crease_line line = crease_sheet_line(sheet, 0);
        assert_near(line.angle, 90, 1e-6);
        assert_int_equal(crease_surface_multiplicity(
                             crease_sheet_surface(sheet), line.direction, line.parameter),
            3);
        assert_true(largest_deviation(sheet) < 1e-9 * H);
        for (int end = 0; end < 2; end++) {
            double p[3];
            const double edge = i & 2 ? 0 : 1;
            point_of_line(sheet, 0, end, p);
            assert_near(hypot(p[0] - edge, p[2] - edge), 0, 1e-9 * H);
        }
        crease_sheet_free(sheet);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

static void given_the_papers_strongest_noise_then_the_crease_stays(void **state)
{
    crease_context *context = given_context();
    double sum = 0;
    enum { SEEDS = 6 };
    for (uint64_t variant = 0; variant < SEEDS; variant++) {
        crease_cloud *cloud = given_sample(context, 17, 3, true, 0.64, variant);
        crease_sheet *sheet = when_fitted(context, cloud, NULL);
        assert_int_equal(crease_sheet_line_count(sheet), 1);
        double p[3];
        point_of_line(sheet, 0, 0.5, p);
        sum += hypot(p[0], p[2]) / H;
        crease_sheet_free(sheet);
        crease_cloud_free(cloud);
    }
    assert_true(sum / SEEDS < 0.3);
    crease_context_free(context);
}

/* A roof of 0.4 x 0.6, turned and moved, with noise in all directions. */
static void given_a_noisy_roof_along_no_axis_then_errors_are_far_below_the_noise(void **state)
{
    enum { COUNT = 1500 };
    crease_context *context = given_context();
    crease_frame turn = {
        .rotation = {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6}, .origin = {10, 20, -30}};
    assert_true(crease_frame_defect(turn.rotation) < 1e-12);
    const double spacing = sqrt(0.4 * 0.6 * 1.2 / COUNT), sigma = 0.2 * spacing;
    static double points[COUNT][3];
    for (uint64_t i = 0; i < COUNT; i++) {
        const double x = 0.4 * (crease_random_uniform(1, 1, 2 * i) - 0.5) + 0.05;
        const double y = 0.6 * crease_random_uniform(1, 1, 2 * i + 1);
        const double p[3] = {x, y, 0.5 - 0.7 * fabs(x)};
        for (uint64_t c = 0; c < 3; c++)
            points[i][c] = p[c] + sigma * crease_random_normal(1, 2, 3 * i + c);
    }
    crease_frame_leave(&turn, points[0], COUNT, points[0]);
    crease_cloud *cloud = given_cloud_of(context, points[0], COUNT);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    const crease_line line = crease_sheet_line(sheet, 0);
    assert_near(line.angle, 180 - 2 * atan(0.7) * 180 / 3.14159265358979, 0.5);
    assert_true(line.standard_error > 0.001 * spacing && line.standard_error < 0.1 * spacing);
    for (int end = 0; end < 2; end++) {
        double p[3];
        point_of_line(sheet, 0, end, p);
        crease_frame_enter(&turn, p, 1, p);
        assert_near(p[0], 0, 0.15 * spacing);
        assert_near(p[2], 0.5, 0.15 * spacing);
    }
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* Two bicubic patches that meet in a crease at x = 0.3. */
static double creased(double x, double y)
{
    const double smooth = 0.2 * x * x * x - 0.3 * x * y * y + 0.1 * y * y * y + 0.4 * x * x * y;
    return smooth + (x > 0.3 ? (x - 0.3) * (0.8 + 0.3 * y + 0.5 * (x - 0.3) * y * y) : 0);
}

static void given_creased_bicubic_data_then_the_fit_is_exact(void **state)
{
    enum { SIDE = 31 };
    crease_context *context = given_context();
    static double points[SIDE * SIDE][3];
    for (int i = 0; i < SIDE * SIDE; i++) {
        points[i][0] = i / SIDE / (SIDE - 1.0) + 0.001 * ((i * 37) % 11);
        points[i][1] = i % SIDE / (SIDE - 1.0);
        points[i][2] = creased(points[i][0], points[i][1]);
    }
    crease_cloud *cloud = given_cloud_of(context, points[0], SIDE * SIDE);
    crease_sheet_options options = crease_sheet_options_default();
    options.orientation = CREASE_ORIENTATION_NONE;
    crease_sheet *sheet = when_fitted(context, cloud, &options);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    assert_true(largest_deviation(sheet) < 1e-9);
    double p[3];
    point_of_line(sheet, 0, 0.5, p);
    assert_near(p[0], 0.3, 1e-7);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* A plate with a block on it: a step, that is two crease lines, at every side of the block. */
static void given_a_block_on_a_plate_then_lines_follow_its_sides(void **state)
{
    enum { SIDE = 36 };
    crease_context *context = given_context();
    static double points[SIDE * SIDE][3];
    for (uint64_t i = 0; i < SIDE * SIDE; i++) {
        const double x = (double)(i / SIDE) / SIDE, y = (double)(i % SIDE) / SIDE;
        const bool block = x > 0.3 && x < 0.65 && y > 0.255 && y < 0.74;
        const double c = cos(0.05), s = sin(0.05);
        points[i][0] = c * x - s * y;
        points[i][1] = s * x + c * y;
        points[i][2] = (block ? 0.1 : 0) + 0.001 * crease_random_normal(3, 4, i);
    }
    crease_cloud *cloud = given_cloud_of(context, points[0], SIDE * SIDE);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    const double sides[2][2] = {{0.3, 0.65}, {0.255, 0.74}};
    for (int d = 0; d < 2; d++)
        for (int k = 0; k < 2; k++) {
            double nearest = 1;
            for (size_t l = 0; l < crease_sheet_line_count(sheet); l++) {
                double p[3];
                point_of_line(sheet, l, 0.5, p);
                const double local[2] = {
                    cos(0.05) * p[0] + sin(0.05) * p[1], cos(0.05) * p[1] - sin(0.05) * p[0]};
                nearest = fmin(nearest, fabs(local[d] - sides[d][k]));
            }
            assert_true(nearest < 1.5 / SIDE);
        }
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_smooth_surface_then_no_crease(void **state)
{
    enum { SIDE = 30 };
    crease_context *context = given_context();
    static double points[SIDE * SIDE][3];
    for (uint64_t i = 0; i < SIDE * SIDE; i++) {
        points[i][0] = (double)(i / SIDE) / SIDE;
        points[i][1] = (double)(i % SIDE) / SIDE;
        points[i][2] = 0.2 * sin(4 * points[i][0]) * cos(3 * points[i][1]) +
            0.002 * crease_random_normal(3, 4, i);
    }
    crease_cloud *cloud = given_cloud_of(context, points[0], SIDE * SIDE);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    assert_int_equal(crease_sheet_line_count(sheet), 0);
    double square = 0;
    for (size_t i = 0; i < SIDE * SIDE; i++)
        square += pow(crease_sheet_deviations(sheet)[i], 2);
    assert_near(sqrt(square) / SIDE, 0.002, 0.0004);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* A hill that a coarse net cannot follow, over 100 x 100, with a crease or without. */
static crease_sheet *when_a_hill_is_fitted(crease_context *context, double slope, uint64_t seed)
{
    enum { COUNT = 6000 };
    static double points[COUNT][3];
    for (uint64_t i = 0; i < COUNT; i++) {
        const double x = 100 * crease_random_uniform(seed, 1, 2 * i);
        const double y = 100 * crease_random_uniform(seed, 1, 2 * i + 1);
        points[i][0] = x, points[i][1] = y;
        points[i][2] = 10 * exp(-((x - 30) * (x - 30) + (y - 60) * (y - 60)) / 300) +
            slope * fmax(0, x - 75) + 0.05 * crease_random_normal(seed, 2, i);
    }
    crease_cloud *cloud = given_cloud_of(context, points[0], COUNT);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    crease_cloud_free(cloud);
    return sheet;
}

static void given_a_hill_then_no_line_stands_in_for_simple_knots(void **state)
{
    crease_context *context = given_context();
    crease_sheet *sheet = when_a_hill_is_fitted(context, 0, 1);
    assert_int_equal(crease_sheet_line_count(sheet), 0);
    crease_sheet_free(sheet);
    sheet = when_a_hill_is_fitted(context, 0.5, 7);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    assert_near(crease_sheet_line(sheet, 0).angle, 180 - atan(0.5) * 180 / 3.14159265358979, 0.5);
    crease_sheet_free(sheet);
    crease_context_free(context);
}

/* A hill beside a straight break aslant, which ends in corners of the patch's border: the surfaces
 * of its two sides meet in a curve that is not quite straight. */
static void given_a_hill_and_a_break_aslant_then_the_line_follows_the_break(void **state)
{
    enum { COUNT = 6000 };
    crease_context *context = given_context();
    static double points[COUNT][3];
    for (uint64_t i = 0; i < COUNT; i++) {
        const double x = 100 * crease_random_uniform(1, 1, 2 * i);
        const double y = 100 * crease_random_uniform(1, 1, 2 * i + 1);
        points[i][0] = x, points[i][1] = y;
        points[i][2] = 10 * exp(-((x - 30) * (x - 30) + (y - 60) * (y - 60)) / 300) +
            0.3 * fmax(0, x + 0.4 * y - 80) + 0.1 * crease_random_normal(1, 2, i);
    }
    crease_cloud *cloud = given_cloud_of(context, points[0], COUNT);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    const double angle = atan(0.3 * sqrt(1.16)) * 180 / 3.14159265358979;
    assert_near(crease_sheet_line(sheet, 0).angle, 180 - angle, 1.5);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_outliers_then_they_are_forgotten(void **state)
{
    crease_context *context = given_context();
    crease_panel_options panel = {.count = 1500, .noise = 0.1, .outliers = 0.01};
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_shape_panel(context, &panel, &cloud), CREASE_OK);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    const double spacing = sqrt(0.48 / 1500);
    double middle[3], nearest = 1;
    crease_shape_panel_point(0, 0, middle);
    for (size_t l = 0; l < crease_sheet_line_count(sheet); l++)
        for (int i = 0; i <= 200; i++) {
            double p[3], square = 0;
            point_of_line(sheet, l, i / 200.0, p);
            for (int c = 0; c < 3; c++)
                square += pow(p[c] - middle[c], 2);
            nearest = fmin(nearest, sqrt(square));
        }
    assert_true(nearest < 0.3 * spacing);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_net_then_it_has_that_size(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0, 0);
    crease_sheet_options options = crease_sheet_options_default();
    options.net[0] = 9, options.net[1] = 5;
    crease_sheet *sheet = when_fitted(context, cloud, &options);
    const crease_surface_parts parts = crease_surface_parts_of(crease_sheet_surface(sheet));
    assert_int_equal(parts.count[0], 9);
    assert_int_equal(parts.count[1], 5);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    crease_sheet_free(sheet);
    options.creases = 0;
    sheet = when_fitted(context, cloud, &options);
    assert_int_equal(crease_sheet_line_count(sheet), 0);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_other_orders_then_the_edge_is_exact_too(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0, 0);
    for (int order = 2; order <= 5; order++) {
        crease_sheet_options options = crease_sheet_options_default();
        options.order = order;
        crease_sheet *sheet = when_fitted(context, cloud, &options);
        assert_int_equal(crease_sheet_line_count(sheet), 1);
        assert_near(crease_sheet_line(sheet, 0).angle, 90, 1e-5);
        assert_true(largest_deviation(sheet) < 1e-6 * H);
        crease_sheet_free(sheet);
    }
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_any_number_of_threads_then_the_same_bytes(void **state)
{
    crease_sheet *sheets[2];
    crease_surface_parts parts[2];
    for (int i = 0; i < 2; i++) {
        crease_context *context = given_context_with_threads(i ? 4 : 1);
        crease_panel_options panel = {.count = 600, .noise = 0.2, .outliers = 0.01};
        crease_cloud *cloud = NULL;
        assert_int_equal(crease_shape_panel(context, &panel, &cloud), CREASE_OK);
        sheets[i] = when_fitted(context, cloud, NULL);
        parts[i] = crease_surface_parts_of(crease_sheet_surface(sheets[i]));
        crease_cloud_free(cloud);
        crease_context_free(context);
    }
    assert_int_equal(parts[0].count[0], parts[1].count[0]);
    assert_int_equal(parts[0].count[1], parts[1].count[1]);
    assert_memory_equal(parts[0].control_points, parts[1].control_points,
        3 * parts[0].count[0] * parts[0].count[1] * sizeof(double));
    assert_memory_equal(crease_sheet_deviations(sheets[0]), crease_sheet_deviations(sheets[1]),
        600 * sizeof(double));
    crease_sheet_free(sheets[0]);
    crease_sheet_free(sheets[1]);
}

static void given_senseless_options_or_points_then_an_error_says_what_to_give(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0, 0);
    crease_sheet *sheet = NULL;
    crease_sheet_options options = crease_sheet_options_default();
    options.order = 9;
    assert_int_equal(crease_sheet_fit(context, cloud, &options, &sheet), CREASE_ERROR_ARGUMENT);
    options = crease_sheet_options_default();
    options.net[0] = 3;
    assert_int_equal(crease_sheet_fit(context, cloud, &options, &sheet), CREASE_ERROR_ARGUMENT);
    options = crease_sheet_options_default();
    options.tolerance = -1;
    assert_int_equal(crease_sheet_fit(context, cloud, &options, &sheet), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "tolerance"));
    crease_cloud_free(cloud);
    double line[30];
    for (int i = 0; i < 30; i++)
        line[i] = i / 3 * (1 + i % 3);
    cloud = given_cloud_of(context, line, 10);
    assert_int_equal(crease_sheet_fit(context, cloud, NULL, &sheet), CREASE_ERROR_DEGENERATE);
    crease_cloud_free(cloud);
    cloud = given_cloud_of(context, line, 5);
    assert_int_equal(crease_sheet_fit(context, cloud, NULL, &sheet), CREASE_ERROR_TOO_FEW_POINTS);
    assert_null(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_no_memory_then_fitting_fails_cleanly(void **state)
{
    crease_context *context = given_context_with_threads(1);
    crease_cloud *cloud = given_sample(context, 9, 3, true, 0, 0);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; n < 100000 && status != CREASE_OK; n += 1 + n / 4) {
        crease_sheet *sheet = NULL;
        crease_context_fail_allocation(context, n);
        status = crease_sheet_fit(context, cloud, NULL, &sheet);
        assert_true(status == CREASE_ERROR_NO_MEMORY || status == CREASE_OK);
        assert_true((sheet != NULL) == (status == CREASE_OK));
        crease_sheet_free(sheet);
    }
    assert_true(n > 100);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* Roofs of any steepness whose crease runs any way. */
static void given_a_roof_without_noise_then_it_is_exact_at_any_angle(void **state)
{
    enum { COUNT = 600, ROOFS = 9 };
    static double points[COUNT][3];
    crease_context *context = given_context();
    for (int roof = 0; roof < ROOFS; roof++) {
        const double half = (15.0 + 135.0 * roof / (ROOFS - 1)) * 0.008726646259971648;
        const double turn = 0.37 * roof;
        for (uint64_t i = 0; i < COUNT; i++) {
            const double across = (crease_random_uniform(9, 0, i) - 0.5) * sin(half);
            const double along = crease_random_uniform(9, 1, i) - 0.5;
            points[i][0] = cos(turn) * across - sin(turn) * along;
            points[i][1] = sin(turn) * across + cos(turn) * along;
            points[i][2] = -fabs(across) / tan(half);
        }
        crease_cloud *cloud = given_cloud_of(context, points[0], COUNT);
        crease_sheet *sheet = when_fitted(context, cloud, NULL);
        assert_int_equal(crease_sheet_line_count(sheet), 1);
        assert_near(crease_sheet_line(sheet, 0).angle, 2 * half * 57.29577951308232, 1e-6);
        assert_true(largest_deviation(sheet) < 1e-9);
        crease_sheet_free(sheet);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_the_papers_samples_then_the_edge_is_exact),
        cmocka_unit_test(given_the_papers_strongest_noise_then_the_crease_stays),
        cmocka_unit_test(given_a_noisy_roof_along_no_axis_then_errors_are_far_below_the_noise),
        cmocka_unit_test(given_creased_bicubic_data_then_the_fit_is_exact),
        cmocka_unit_test(given_a_block_on_a_plate_then_lines_follow_its_sides),
        cmocka_unit_test(given_a_smooth_surface_then_no_crease),
        cmocka_unit_test(given_a_hill_then_no_line_stands_in_for_simple_knots),
        cmocka_unit_test(given_a_hill_and_a_break_aslant_then_the_line_follows_the_break),
        cmocka_unit_test(given_outliers_then_they_are_forgotten),
        cmocka_unit_test(given_a_net_then_it_has_that_size),
        cmocka_unit_test(given_other_orders_then_the_edge_is_exact_too),
        cmocka_unit_test(given_any_number_of_threads_then_the_same_bytes),
        cmocka_unit_test(given_senseless_options_or_points_then_an_error_says_what_to_give),
        cmocka_unit_test(given_no_memory_then_fitting_fails_cleanly),
        cmocka_unit_test(given_a_roof_without_noise_then_it_is_exact_at_any_angle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
