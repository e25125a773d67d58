/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "averaging/mark.h"
#include "averaging/net.h"
#include "averaging/project.h"
#include "averaging/repeat.h"
#include "base/frame.h"
#include "spline/knots.h"

static const double H = 0.03125;

static crease_cloud *given_sample(
    crease_context *context, int across, int along, bool roof, double shift)
{
    crease_sample_options options = crease_sample_options_default();
    options.across = across, options.along = along, options.roof = roof, options.shift = shift;
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_shape_sample(context, &options, &cloud), CREASE_OK);
    return cloud;
}

static crease_sheet *when_fitted(
    crease_context *context, const crease_cloud *cloud, const crease_averaging_options *options)
{
    crease_sheet *sheet = NULL;
    const crease_status status = crease_averaging_fit(context, cloud, options, &sheet);
    if (status != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    return sheet;
}

static crease_tree *given_tree(crease_context *context, const double *points, size_t count)
{
    crease_tree *tree = NULL;
    assert_int_equal(crease_tree_create(context, points, count, &tree), CREASE_OK);
    return tree;
}

/* ------------------------------------------------------------------------------------- steps -- */

static void given_points_then_the_first_net_is_a_flat_grid_over_their_box(void **state)
{
    crease_context *context = given_context();
    const double points[] = {1, 5, 9, 3, 4, 8, 2, 7, 7};
    crease_net net;
    assert_int_equal(crease_net_create(context, points, 3, 5, 4, &net), CREASE_OK);
    for (size_t i = 0; i < 5; i++)
        for (size_t j = 0; j < 4; j++) {
            const double *p = net.points + 3 * (4 * i + j);
            assert_near(p[0], 1 + 0.5 * (double)i, 1e-15);
            assert_near(p[1], 4 + (double)j, 1e-15);
            assert_true(p[2] == 0);
        }
    crease_net_free(&net);
    const double wall[] = {1, 5, 9, 1, 4, 8, 1, 7, 7};
    assert_int_equal(crease_net_create(context, wall, 3, 4, 4, &net), CREASE_ERROR_DEGENERATE);
    assert_non_null(strstr(crease_context_message(context), "no extent in x"));
    crease_context_free(context);
}

/* One control point above three data points; w makes 30 % and 70 % of the two nearest. */
static void given_two_near_points_then_the_height_is_their_weighted_mean(void **state)
{
    crease_context *context = given_context();
    const double points[] = {0.1, 0, 1, -0.2, 0, 2, 5, 0, 100}, weights[] = {3, 7, 50};
    const double flat[] = {0, 1e-15, 50};
    crease_tree *tree = given_tree(context, points, 3);
    double place[] = {0, 0, 0};
    crease_net net = {.rows = 1, .columns = 1, .points = place};
    assert_int_equal(crease_net_average(context, &net, tree, points, weights, 2, 1), CREASE_OK);
    assert_near(place[2], 0.3 * 1 + 0.7 * 2, 1e-15);
    place[2] = 0;
    assert_int_equal(crease_net_average(context, &net, tree, points, flat, 2, 1), CREASE_OK);
    assert_near(place[2], 1.5, 1e-15);
    crease_tree_free(tree);
    crease_context_free(context);
}

/* From z = 0 the low points are nearest; from there the high ones are. */
static void given_further_passes_then_neighbours_are_found_anew(void **state)
{
    crease_context *context = given_context();
    const double points[] = {3, 0, 4, 3, 0, 4.1, 0, 0, 6, 0, 0, 6.1};
    const double weights[] = {1, 1, 1, 1};
    crease_tree *tree = given_tree(context, points, 4);
    double place[] = {0, 0, 0};
    crease_net net = {.rows = 1, .columns = 1, .points = place};
    assert_int_equal(crease_net_average(context, &net, tree, points, weights, 2, 1), CREASE_OK);
    assert_near(place[2], 4.05, 1e-15);
    place[2] = 0;
    assert_int_equal(crease_net_average(context, &net, tree, points, weights, 2, 2), CREASE_OK);
    assert_near(place[2], 6.05, 1e-15);
    crease_tree_free(tree);
    crease_context_free(context);
}

static void given_the_mean_of_four_then_only_above_e_a_point_is_marked(void **state)
{
    crease_context *context = given_context();
    const double points[] = {
        0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 9, 0, 0, 10, 0, 0, 11, 0, 0, 12, 0, 0};
    const double standard[] = {0.5, 0.1, 0.1, 0.1, 0.2, 0.2, 0.2, 0.21};
    crease_tree *tree = given_tree(context, points, 8);
    double places[] = {1.4, 0, 0, 10.4, 0, 0};
    crease_net net = {.rows = 1, .columns = 2, .points = places};
    uint8_t marks[2] = {9, 9};
    assert_int_equal(crease_mark(context, &net, tree, standard, 4, 0.20, marks), CREASE_OK);
    assert_int_equal(marks[0], 0); /* mean 0.2, not above */
    assert_int_equal(marks[1], 1);
    assert_int_equal(crease_mark(context, &net, tree, standard, 3, 0.20, marks), CREASE_OK);
    assert_int_equal(marks[0], 1); /* without the fourth */
    crease_tree_free(tree);
    crease_context_free(context);
}

static void given_marks_then_a_row_passes_only_above_g(void **state)
{
    const uint8_t marks[3 * 6] = {1, 1, 1, 1, 0, 0, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1};
    bool passes[3];
    assert_int_equal(crease_marked_rows(marks, 3, 6, 4, passes), 2);
    assert_false(passes[0]);
    assert_true(passes[1] && passes[2]);
}

/* Example 1 of the paper: 5 x 4 control points, the third row repeated three times: 7 x 4. */
static void given_example_1_then_the_third_row_stands_three_times(void **state)
{
    crease_context *context = given_context();
    double points[5][4][3];
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 4; j++)
            for (int c = 0; c < 3; c++)
                points[i][j][c] = 100 * (i + 1) + 10 * (j + 1) + c;
    const crease_net net = {.rows = 5, .columns = 4, .points = points[0][0]};
    const bool passes[5] = {false, false, true, false, false};
    const int expected[7] = {1, 2, 3, 3, 3, 4, 5};
    crease_net repeated;
    assert_int_equal(crease_net_repeat(context, &net, passes, 3, &repeated), CREASE_OK);
    assert_int_equal(repeated.rows, 7);
    assert_int_equal(repeated.columns, 4);
    for (size_t i = 0; i < 7; i++)
        assert_memory_equal(repeated.points + 12 * i, points[expected[i] - 1], 12 * sizeof(double));
    crease_net_free(&repeated);
    crease_context_free(context);
}

static void given_a_net_then_transposing_exchanges_rows_and_columns(void **state)
{
    crease_context *context = given_context();
    crease_net net = {.rows = 2, .columns = 3, .points = calloc(18, sizeof(double))};
    uint8_t marks[6] = {0, 1, 0, 0, 0, 1};
    for (int i = 0; i < 18; i++)
        net.points[i] = i;
    assert_int_equal(crease_net_transpose(context, &net, marks), CREASE_OK);
    assert_int_equal(net.rows, 3);
    assert_int_equal(net.columns, 2);
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 2; j++)
            assert_true(net.points[3 * (2 * i + j)] == (double)(3 * (3 * j + i)));
    const uint8_t expected[6] = {0, 0, 1, 0, 0, 1};
    assert_memory_equal(marks, expected, 6);
    crease_net_free(&net);
    crease_context_free(context);
}

static crease_surface *given_surface(crease_context *context, const double *points)
{
    double knots[4 + 5];
    crease_knots_clamped(4, 5, 0, 1, knots);
    const crease_surface_parts parts = {
        .order = {4, 4}, .count = {5, 5}, .knots = {knots, knots}, .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    return surface;
}

/* Over a net that is a plane, z is that of the plane; beyond its border, of the border. */
static void given_a_plane_net_then_projected_heights_lie_on_it(void **state)
{
    crease_context *context = given_context();
    for (int transposed = 0; transposed < 2; transposed++) {
        double net[25][3];
        for (int i = 0; i < 25; i++) {
            const double u = i / 5, v = i % 5;
            net[i][0] = transposed ? v : u;
            net[i][1] = transposed ? u : v;
            net[i][2] = 2 * net[i][0] - 3 * net[i][1] + 1;
        }
        crease_surface *surface = given_surface(context, net[0]);
        double points[] = {0.3, 0.7, 99, 2.5, 3.9, 99, 4, 0, 99, -1, 2, 99, 9, 9, 99};
        const double expected[] = {-0.5, -5.7, 9, -5, -3};
        assert_int_equal(
            crease_project_heights(context, surface, transposed, points, 5), CREASE_OK);
        for (int i = 0; i < 5; i++)
            assert_near(points[3 * i + 2], expected[i], 1e-12);
        crease_surface_free(surface);
    }
    crease_context_free(context);
}

/* ------------------------------------------------------------------------- the whole algorithm --
 */

/* The facts of the paper's own sample: two rows straddle the edge, both are repeated, and the sharp
 * ridge becomes a flat-topped chamfer, 0.07 wide. */
static void given_the_papers_sample_then_two_rows_are_repeated_and_the_ridge_is_flat(void **state)
{
    crease_context *context = given_context();
    for (int roof = 0; roof < 2; roof++) {
        crease_cloud *cloud = given_sample(context, 17, 3, roof, 0);
        crease_sheet *sheet = when_fitted(context, cloud, NULL);
        const crease_surface *surface = crease_sheet_surface(sheet);
        const crease_surface_parts parts = crease_surface_parts_of(surface);
        assert_int_equal(parts.count[0], 10);
        assert_int_equal(parts.count[1], 6);
        double local[60 * 3], rotation[9];
        crease_frame frame;
        crease_sheet_frame(sheet, rotation, frame.origin);
        memcpy(frame.rotation, rotation, sizeof rotation);
        crease_frame_enter(&frame, parts.control_points, 60, local);
        const double net_spacing = 16 * H * sqrt(0.5) / 5;
        for (int copy = 0; copy < 3; copy++)
            for (size_t j = 0; j < 6; j++) {
                assert_near(local[3 * (6 * (2 + (size_t)copy) + j)], -net_spacing / 2, 1e-12);
                assert_near(local[3 * (6 * (5 + (size_t)copy) + j)], net_spacing / 2, 1e-12);
            }
        assert_int_equal(crease_sheet_line_count(sheet), 2);
        double ends[2][3];
        for (size_t i = 0; i < 2; i++) {
            const crease_line line = crease_sheet_line(sheet, i);
            const double uv[2] = {line.parameter, 0.5};
            assert_int_equal(line.direction, 0);
            assert_near(line.angle, 135, 10);
            crease_surface_point(surface, uv, ends[i]);
        }
        double width = 0;
        for (int c = 0; c < 3; c++)
            width += pow(ends[0][c] - ends[1][c], 2);
        assert_near(sqrt(width), 0.0707, 0.0005);
        crease_sheet_free(sheet);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

static void given_a_sample_shifted_by_one_spacing_then_one_row_is_off_the_edge(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 1);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    double point[3];
    crease_surface_point(crease_sheet_surface(sheet),
        (double[2]){crease_sheet_line(sheet, 0).parameter, 0.5}, point);
    assert_near(fabs(point[0]) / H, 0.424, 0.005);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_three_points_across_then_no_row_passes(void **state)
{
    crease_context *context = given_context();
    for (int roof = 0; roof < 2; roof++) {
        crease_cloud *cloud = given_sample(context, 3, 17, roof, 0);
        crease_sheet *sheet = when_fitted(context, cloud, NULL);
        assert_int_equal(crease_sheet_line_count(sheet), 0);
        assert_int_equal(crease_surface_parts_of(crease_sheet_surface(sheet)).count[0], 6);
        crease_sheet_free(sheet);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

/* Turned by a quarter about z, with the axes taken as they are, the edge is vertical. */
static void given_a_vertical_edge_then_the_net_is_transposed(void **state)
{
    crease_context *context = given_context();
    crease_cloud *upright = given_sample(context, 17, 3, true, 0);
    crease_averaging_options options = crease_averaging_options_default();
    options.orientation = CREASE_ORIENTATION_GIVEN;
    const double quarter[9] = {0, 1, 0, -1, 0, 0, 0, 0, 1};
    memcpy(options.rotation, quarter, sizeof quarter);
    options.net[1] = 7;
    crease_sheet *sheet = when_fitted(context, upright, &options);
    const crease_surface_parts parts = crease_surface_parts_of(crease_sheet_surface(sheet));
    assert_int_equal(parts.count[1], 6);
    assert_true(crease_sheet_line_count(sheet) > 0);
    for (size_t i = 0; i < crease_sheet_line_count(sheet); i++) {
        double ends[2][3];
        const crease_line line = crease_sheet_line(sheet, i);
        assert_int_equal(line.direction, 0);
        for (int e = 0; e < 2; e++)
            crease_surface_point(
                crease_sheet_surface(sheet), (double[2]){line.parameter, e}, ends[e]);
        assert_near(fabs(ends[1][1] - ends[0][1]), 2 * H, 1e-9);
        assert_near(ends[1][0] - ends[0][0], 0, 1e-9);
    }
    crease_sheet_free(sheet);
    crease_cloud_free(upright);
    crease_context_free(context);
}

/* Step 11: the projected points have the x and y of the data (in the frame) and lie on the sheet.
 */
static void given_projection_then_points_keep_their_place_and_lie_on_the_sheet(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    const double *p = crease_cloud_points(cloud), *q = crease_sheet_projected(sheet);
    crease_foot feet[51];
    assert_int_equal(
        crease_surface_project(context, crease_sheet_surface(sheet), q, 51, feet), CREASE_OK);
    double off = 0;
    for (size_t i = 0; i < 51; i++) {
        assert_near(q[3 * i], p[3 * i], 1e-12);
        assert_near(q[3 * i + 1], p[3 * i + 1], 1e-12);
        assert_near(feet[i].distance, 0, 1e-9);
        off = fmax(off, fabs(crease_sheet_deviations(sheet)[i]));
        assert_true(crease_sheet_variance(sheet)[i] >= 0);
    }
    assert_near(off / H, 0.88, 0.05); /* the ridge is cut off */
    assert_int_equal(crease_sheet_point_count(sheet), 51);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* At a row that stands three times the first derivative across vanishes (the parametrisation stays
 * smooth) while the direction of the sheet jumps: C0 and G0 as the paper says. */
static void given_repeated_rows_then_the_derivative_vanishes_and_the_direction_jumps(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    const crease_surface *surface = crease_sheet_surface(sheet);
    const double u = crease_sheet_line(sheet, 0).parameter, step = 1e-3;
    double before[4][3], at[4][3], after[4][3];
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    crease_surface_evaluate(surface, (double[2]){u, 0.5}, sides, 1, at[0]);
    crease_surface_evaluate(surface, (double[2]){u - step, 0.5}, sides, 1, before[0]);
    crease_surface_evaluate(surface, (double[2]){u + step, 0.5}, sides, 1, after[0]);
    assert_near(hypot(at[2][0], at[2][2]), 0, 1e-12);
    assert_near(before[2][2] / before[2][0], 1, 0.15);
    assert_near(after[2][2] / after[2][0], 0, 0.05);
    assert_int_equal(crease_surface_multiplicity(surface, 0, u), 1);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_two_lines_then_three_faces_that_share_their_borders(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    crease_surface **faces = NULL;
    size_t count = 0;
    assert_int_equal(crease_sheet_faces(context, sheet, &faces, &count), CREASE_OK);
    assert_int_equal(count, 3);
    for (size_t f = 0; f + 1 < count; f++) {
        const crease_surface_parts a = crease_surface_parts_of(faces[f]);
        const crease_surface_parts b = crease_surface_parts_of(faces[f + 1]);
        assert_int_equal(a.count[1], b.count[1]);
        assert_memory_equal(a.control_points + 3 * (a.count[0] - 1) * a.count[1], b.control_points,
            3 * a.count[1] * sizeof(double));
    }
    crease_curve *curve = NULL;
    assert_int_equal(crease_sheet_line_curve(context, sheet, 1, &curve), CREASE_OK);
    double on_curve[3], on_sheet[3];
    crease_curve_evaluate(curve, 0.3, CREASE_SIDE_RIGHT, 0, on_curve);
    crease_surface_point(crease_sheet_surface(sheet),
        (double[2]){crease_sheet_line(sheet, 1).parameter, 0.3}, on_sheet);
    for (int c = 0; c < 3; c++)
        assert_near(on_curve[c], on_sheet[c], 1e-12);
    crease_curve_free(curve);
    assert_int_equal(crease_sheet_line_curve(context, sheet, 2, &curve), CREASE_ERROR_ARGUMENT);
    assert_null(curve);
    crease_surfaces_free(faces, count);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_any_number_of_threads_then_the_same_bytes(void **state)
{
    crease_sheet *sheets[2];
    for (int i = 0; i < 2; i++) {
        crease_context *context = given_context_with_threads(i ? 4 : 1);
        crease_cloud *cloud = given_sample(context, 17, 3, false, 0.3);
        sheets[i] = when_fitted(context, cloud, NULL);
        crease_cloud_free(cloud);
        crease_context_free(context);
    }
    const crease_surface_parts a = crease_surface_parts_of(crease_sheet_surface(sheets[0]));
    const crease_surface_parts b = crease_surface_parts_of(crease_sheet_surface(sheets[1]));
    assert_int_equal(a.count[0], b.count[0]);
    assert_memory_equal(
        a.control_points, b.control_points, 3 * a.count[0] * a.count[1] * sizeof(double));
    assert_memory_equal(crease_sheet_projected(sheets[0]), crease_sheet_projected(sheets[1]),
        51 * 3 * sizeof(double));
    crease_sheet_free(sheets[0]);
    crease_sheet_free(sheets[1]);
}

static void given_senseless_options_or_points_then_an_error_says_what_to_give(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0);
    crease_sheet *sheet = NULL;
    crease_averaging_options options = crease_averaging_options_default();
    options.net[0] = 3;
    assert_int_equal(crease_averaging_fit(context, cloud, &options, &sheet), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "rows of the net"));
    options = crease_averaging_options_default();
    options.multiplicity = 4;
    assert_int_equal(crease_averaging_fit(context, cloud, &options, &sheet), CREASE_ERROR_ARGUMENT);
    options = crease_averaging_options_default();
    options.mark_threshold = NAN;
    assert_int_equal(crease_averaging_fit(context, cloud, &options, &sheet), CREASE_ERROR_ARGUMENT);
    options = crease_averaging_options_default();
    options.averaging_neighbours = 52;
    assert_int_equal(
        crease_averaging_fit(context, cloud, &options, &sheet), CREASE_ERROR_TOO_FEW_POINTS);
    assert_null(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_no_memory_then_fitting_fails_cleanly(void **state)
{
    crease_context *context = given_context_with_threads(1);
    crease_cloud *cloud = given_sample(context, 17, 3, true, 0);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; n < 10000 && status != CREASE_OK; n++) {
        crease_sheet *sheet = NULL;
        crease_context_fail_allocation(context, n);
        status = crease_averaging_fit(context, cloud, NULL, &sheet);
        assert_true(status == CREASE_ERROR_NO_MEMORY || status == CREASE_OK);
        assert_true((sheet != NULL) == (status == CREASE_OK));
        if (sheet) {
            crease_surface **faces = NULL;
            size_t count = 0;
            crease_context_fail_allocation(context, 3);
            assert_int_equal(
                crease_sheet_faces(context, sheet, &faces, &count), CREASE_ERROR_NO_MEMORY);
            assert_null(faces);
        }
        crease_sheet_free(sheet);
    }
    assert_true(n > 20);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_points_then_the_first_net_is_a_flat_grid_over_their_box),
        cmocka_unit_test(given_two_near_points_then_the_height_is_their_weighted_mean),
        cmocka_unit_test(given_further_passes_then_neighbours_are_found_anew),
        cmocka_unit_test(given_the_mean_of_four_then_only_above_e_a_point_is_marked),
        cmocka_unit_test(given_marks_then_a_row_passes_only_above_g),
        cmocka_unit_test(given_example_1_then_the_third_row_stands_three_times),
        cmocka_unit_test(given_a_net_then_transposing_exchanges_rows_and_columns),
        cmocka_unit_test(given_a_plane_net_then_projected_heights_lie_on_it),
        cmocka_unit_test(given_the_papers_sample_then_two_rows_are_repeated_and_the_ridge_is_flat),
        cmocka_unit_test(given_a_sample_shifted_by_one_spacing_then_one_row_is_off_the_edge),
        cmocka_unit_test(given_three_points_across_then_no_row_passes),
        cmocka_unit_test(given_a_vertical_edge_then_the_net_is_transposed),
        cmocka_unit_test(given_projection_then_points_keep_their_place_and_lie_on_the_sheet),
        cmocka_unit_test(given_repeated_rows_then_the_derivative_vanishes_and_the_direction_jumps),
        cmocka_unit_test(given_two_lines_then_three_faces_that_share_their_borders),
        cmocka_unit_test(given_any_number_of_threads_then_the_same_bytes),
        cmocka_unit_test(given_senseless_options_or_points_then_an_error_says_what_to_give),
        cmocka_unit_test(given_no_memory_then_fitting_fails_cleanly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
