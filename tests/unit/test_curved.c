/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Sheets with curved creases, and folded ones, against the shapes that their points were taken
 * from. */
#include "given.h"

#include <crease/crease_trim.h>

#include "base/frame.h"
#include "base/random.h"
#include "base/vector.h"
#include "fit/unroll.h"
#include "spline/sheet.h"

enum { COUNT = 3000, FEW = 1200, MANY = 20500 };

/* A place in space of a place in the unit square. */
typedef void shape_of(double u, double v, double out[3]);

static double course(double y)
{
    return 0.5 + 0.12 * sin(3.0 * y) - 0.1 * y;
}

/* A roof over the unit square whose ridge winds. */
static void roof(double u, double v, double out[3])
{
    const double off = u - course(v);
    out[0] = u;
    out[1] = v;
    out[2] = 0.15 * v * v - 0.1 * u * v - 0.6 * fabs(off) + 0.2 * off * off;
}

static const double COURSES[2][3] = {{0.3, 0.06, 3.0}, {0.7, -0.05, 4.0}};

static double one_of_two(int which, double y)
{
    return COURSES[which][0] + COURSES[which][1] * sin(COURSES[which][2] * y);
}

/* A ridge and a valley that wind each in its own way. */
static void ridge_and_valley(double u, double v, double out[3])
{
    out[0] = u;
    out[1] = v;
    out[2] = 0.1 * v * v - 0.7 * fabs(u - one_of_two(0, v)) + 0.7 * fabs(u - one_of_two(1, v));
}

/* A ridge that fades out half-way. */
static void fading(double u, double v, double out[3])
{
    const double share = fmax(0.0, 1.0 - v / 0.7);
    out[0] = u;
    out[1] = v;
    out[2] = 0.1 * v * v - 0.7 * share * share * fabs(u - course(v));
}

/* A band folded by 100 degrees at u = 0.3 and by 110 at u = 0.65, sagging along v: nowhere a height
 * field. */
static void folded(double u, double v, double out[3])
{
    const double degree = 0.017453292519943296;
    const double ends[4] = {0.0, 0.3, 0.65, 1.0};
    double angle = 0.0;
    out[0] = out[2] = 0.0;
    for (int i = 0; i < 3; i++) {
        const double length = fmin(fmax(u - ends[i], 0.0), ends[i + 1] - ends[i]);
        out[0] += length * cos(angle * degree);
        out[2] += length * sin(angle * degree);
        angle += i ? 110.0 : 100.0;
    }
    out[1] = v;
    out[2] += 0.1 * v * (1.0 - v);
}

/* A ridge that winds aslant through the square. */
static void aslant(double u, double v, double out[3])
{
    const double off = u + 0.45 * v - 0.7 - 0.05 * sin(4.0 * v);
    out[0] = u;
    out[1] = v;
    out[2] = 0.1 * v * v - 0.6 * fabs(off);
}

static crease_cloud *given_number_of_points(
    crease_context *context, shape_of *shape, size_t count, double noise)
{
    double *const points = malloc(count * 3 * sizeof *points);
    assert_non_null(points);
    for (size_t i = 0; i < count; i++) {
        /* additive recurrence: even, in no rows */
        const double u = fmod(0.5 + 0.7548776662466927 * (double)i, 1.0);
        const double v = fmod(0.5 + 0.5698402909980532 * (double)i, 1.0);
        shape(u, v, points + 3 * i);
        for (size_t c = 0; c < 3 && noise > 0.0; c++)
            points[3 * i + c] += noise * crease_random_normal(7, 1, 3 * i + c);
    }
    crease_cloud *cloud = given_cloud_of(context, points, count);
    free(points);
    return cloud;
}

static crease_cloud *given_points(crease_context *context, shape_of *shape, double noise)
{
    return given_number_of_points(context, shape, COUNT, noise);
}

static crease_sheet *when_fitted(
    crease_context *context, const crease_cloud *cloud, const crease_sheet_options *options)
{
    crease_sheet *sheet = NULL;
    if (crease_sheet_fit(context, cloud, options, &sheet) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    return sheet;
}

static bool when_asked_whether_it_carries(
    crease_context *context, const crease_cloud *cloud, const crease_sheet *sheet)
{
    crease_regions *regions = NULL;
    crease_network *network = NULL;
    bool carries = false;
    assert_int_equal(crease_regions_find(context, cloud, NULL, &regions), CREASE_OK);
    assert_int_equal(crease_network_find(context, regions, NULL, &network), CREASE_OK);
    assert_int_equal(crease_sheet_carries(context, sheet, regions, network, &carries), CREASE_OK);
    crease_network_free(network);
    crease_regions_free(regions);
    return carries;
}

static double rms_deviation(const crease_sheet *sheet)
{
    double sum = 0.0;
    for (size_t i = 0; i < crease_sheet_point_count(sheet); i++)
        sum += pow(crease_sheet_deviations(sheet)[i], 2.0);
    return sqrt(sum / (double)crease_sheet_point_count(sheet));
}

/* Places along a crease line of a sheet, ends left out. */
static void place_on_line(const crease_sheet *sheet, size_t line, int number, double out[3])
{
    const crease_line l = crease_sheet_line(sheet, line);
    double domain[2], uv[2];
    crease_surface_domain(crease_sheet_surface(sheet), 1 - l.direction, domain);
    uv[l.direction] = l.parameter;
    uv[1 - l.direction] = domain[0] + (domain[1] - domain[0]) * (number + 1) / 22.0;
    crease_surface_point(crease_sheet_surface(sheet), uv, out);
}

/* Root mean square distance of the only crease line from the ridge of the roof, across it. */
static double ridge_error(const crease_sheet *sheet)
{
    double sum = 0.0;
    for (int i = 0; i < 21; i++) {
        double p[3], q[3];
        place_on_line(sheet, 0, i, p);
        roof(course(p[1]), p[1], q);
        sum += pow(p[0] - q[0], 2.0) + pow(p[2] - q[2], 2.0);
    }
    return sqrt(sum / 21.0);
}

static void given_exact_points_of_a_winding_ridge_then_the_sheet_has_it(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_points(context, roof, 0.0);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    const crease_line line = crease_sheet_line(sheet, 0);
    assert_int_equal(
        crease_surface_multiplicity(crease_sheet_surface(sheet), line.direction, line.parameter),
        3);
    assert_near(ridge_error(sheet), 0.0, 1e-4);
    assert_near(rms_deviation(sheet), 0.0, 1e-4);
    assert_true(when_asked_whether_it_carries(context, cloud, sheet));
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_noise_then_the_ridge_is_found_within_a_fraction_of_it(void **state)
{
    const double noise = 0.004; /* a quarter of the spacing */
    crease_context *context = given_context();
    crease_cloud *cloud = given_points(context, roof, noise);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    assert_near(ridge_error(sheet), 0.0, noise);
    assert_near(rms_deviation(sheet), noise, 0.1 * noise);
    assert_true(when_asked_whether_it_carries(context, cloud, sheet));
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_more_points_than_are_explored_then_all_are_used(void **state)
{
    const double noise = 0.004;
    crease_context *context = given_context();
    crease_cloud *cloud = given_number_of_points(context, roof, MANY, noise);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    assert_int_equal(crease_sheet_point_count(sheet), MANY);
    assert_near(ridge_error(sheet), 0.0, 0.3 * noise);
    assert_near(rms_deviation(sheet), noise, 0.05 * noise);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_height_field_over_straight_lines_then_it_does_not_carry_the_ridge(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_points(context, roof, 0.004);
    crease_sheet_options options = crease_sheet_options_default();
    options.orientation = CREASE_ORIENTATION_NONE;
    options.net[0] = options.net[1] = 10;
    crease_sheet *sheet = when_fitted(context, cloud, &options);
    assert_false(when_asked_whether_it_carries(context, cloud, sheet));
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_band_folded_over_itself_then_the_sheet_follows_both_folds(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_points(context, folded, 0.0);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    bool suits = true;
    assert_int_equal(crease_sheet_suits(context, cloud, &suits), CREASE_OK);
    assert_false(suits); /* as a height field */
    assert_int_equal(crease_sheet_line_count(sheet), 2);
    for (size_t l = 0; l < 2; l++) {
        double p[3], q[2][3];
        place_on_line(sheet, l, 10, p);
        folded(0.3, p[1], q[0]);
        folded(0.65, p[1], q[1]);
        const double off[2] = {
            hypot(p[0] - q[0][0], p[2] - q[0][2]), hypot(p[0] - q[1][0], p[2] - q[1][2])};
        assert_near(fmin(off[0], off[1]), 0.0, 1e-4);
        assert_near(crease_sheet_line(sheet, l).angle, off[0] < off[1] ? 80.0 : 70.0, 0.1);
    }
    assert_near(rms_deviation(sheet), 0.0, 1e-4);
    assert_true(when_asked_whether_it_carries(context, cloud, sheet));
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_two_curved_creases_then_the_sheet_has_both(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_points(context, ridge_and_valley, 0.002);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    crease_surface **faces = NULL;
    size_t count = 0;
    assert_int_equal(crease_sheet_line_count(sheet), 2);
    assert_int_equal(crease_sheet_faces(context, sheet, &faces, &count), CREASE_OK);
    assert_int_equal(count, 3);
    for (size_t l = 0; l < 2; l++)
        for (int i = 0; i < 21; i++) {
            double p[3];
            place_on_line(sheet, l, i, p);
            const double off[2] = {p[0] - one_of_two(0, p[1]), p[0] - one_of_two(1, p[1])};
            assert_near(fmin(fabs(off[0]), fabs(off[1])), 0.0, 0.006);
        }
    crease_surfaces_free(faces, count);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_ridge_that_fades_out_then_the_line_goes_on_smoothly(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_points(context, fading, 0.002);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    const crease_surface *surface = crease_sheet_surface(sheet);
    const crease_line line = crease_sheet_line(sheet, 0);
    double domain[2];
    crease_surface_domain(surface, 1 - line.direction, domain);
    for (int i = 1; i < 20; i++) {
        double uv[2], p[3];
        uv[line.direction] = line.parameter;
        uv[1 - line.direction] = domain[0] + (domain[1] - domain[0]) * i / 20.0;
        crease_surface_point(surface, uv, p);
        if (p[1] < 0.3)
            assert_near(p[0], course(p[1]), 0.012);
        else if (p[1] > 0.7 && p[1] < 0.95)
            assert_near(crease_sheet_bend(surface, line.direction, uv), 0.0, 5.0);
    }
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* The cloud turned, scaled and moved. */
/* The longest of a derivative at the points over the shortest. */
static double stretch(const crease_sheet *sheet, size_t direction)
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const double *const uv = crease_sheet_parameters(sheet);
    double least = INFINITY, most = 0.0;
    for (size_t i = 0; i < crease_sheet_point_count(sheet); i++) {
        double out[12];
        crease_surface_evaluate(crease_sheet_surface(sheet), uv + 2 * i, sides, 1, out);
        const double length = crease_vector_length(out + (direction ? 3 : 6));
        least = fmin(least, length);
        most = fmax(most, length);
    }
    return most / least;
}

static double nearest_vertex(const crease_sheet *sheet, const crease_trim *trim, double x, double y)
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    double least = INFINITY;
    for (size_t i = 0; i < crease_trim_vertex_count(trim); i++) {
        double place[3];
        crease_surface_evaluate(
            crease_sheet_surface(sheet), crease_trim_vertices(trim) + 2 * i, sides, 0, place);
        least = fmin(least, hypot(place[0] - x, place[1] - y));
    }
    return least;
}

/* Its rectangle cannot follow the borders without being pinched: they are trimmed. */
static void given_a_ridge_aslant_then_parameters_are_nearly_lengths_and_corners_stay(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_number_of_points(context, aslant, COUNT, 0.0);
    crease_sheet *sheet = when_fitted(context, cloud, NULL);
    crease_trim *trim = NULL;
    const double spacing = sqrt(1.2 / COUNT);
    assert_int_equal(sheet->line_count, 1);
    assert_true(rms_deviation(sheet) < 0.01 * spacing);
    for (size_t d = 0; d < 2; d++)
        assert_true(stretch(sheet, d) < 2.0);
    assert_int_equal(crease_sheet_trim(context, sheet, &trim), CREASE_OK);
    assert_int_equal(crease_trim_face_count(trim), 2);
    for (int corner = 0; corner < 4; corner++)
        assert_true(nearest_vertex(sheet, trim, corner & 1, corner >> 1) < 1.5 * spacing);
    crease_trim_free(trim);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static crease_cloud *given_moved(
    crease_context *context, const crease_cloud *cloud, const crease_frame *frame, double factor)
{
    const size_t count = crease_cloud_count(cloud);
    double *const points = malloc(count * 3 * sizeof *points);
    assert_non_null(points);
    crease_frame_leave(frame, crease_cloud_points(cloud), count, points);
    for (size_t i = 0; i < 3 * count; i++)
        points[i] *= factor;
    crease_cloud *moved = given_cloud_of(context, points, count);
    free(points);
    return moved;
}

static void given_turned_and_scaled_points_then_the_ridge_comes_along(void **state)
{
    const double factor = 1000.0, noise = 0.004;
    const crease_frame frame = {{0.36, 0.48, -0.8, -0.8, 0.6, 0.0, 0.48, 0.64, 0.6}, {3, -2, 5}};
    crease_context *context = given_context();
    crease_cloud *cloud = given_points(context, roof, noise);
    crease_cloud *moved = given_moved(context, cloud, &frame, factor);
    crease_sheet *sheet = when_fitted(context, moved, NULL);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    double sum = 0.0;
    for (int i = 0; i < 21; i++) {
        double p[3], q[3];
        place_on_line(sheet, 0, i, p);
        for (int c = 0; c < 3; c++)
            p[c] /= factor;
        crease_frame_enter(&frame, p, 1, p);
        roof(course(p[1]), p[1], q);
        sum += pow(p[0] - q[0], 2.0) + pow(p[2] - q[2], 2.0);
    }
    assert_near(sqrt(sum / 21.0), 0.0, noise);
    assert_near(rms_deviation(sheet), noise * factor, 0.1 * noise * factor);
    crease_sheet_free(sheet);
    crease_cloud_free(moved);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_any_number_of_threads_then_the_sheet_is_the_same(void **state)
{
    crease_surface_parts parts[2];
    crease_sheet *sheets[2];
    crease_context *contexts[2];
    for (int i = 0; i < 2; i++) {
        contexts[i] = given_context_with_threads(i ? 4 : 1);
        crease_cloud *cloud = given_number_of_points(contexts[i], roof, FEW, 0.004);
        sheets[i] = when_fitted(contexts[i], cloud, NULL);
        parts[i] = crease_surface_parts_of(crease_sheet_surface(sheets[i]));
        crease_cloud_free(cloud);
    }
    assert_int_equal(parts[0].count[0], parts[1].count[0]);
    assert_int_equal(parts[0].count[1], parts[1].count[1]);
    assert_memory_equal(parts[0].control_points, parts[1].control_points,
        parts[0].count[0] * parts[0].count[1] * 3 * sizeof(double));
    for (int i = 0; i < 2; i++) {
        crease_sheet_free(sheets[i]);
        crease_context_free(contexts[i]);
    }
}

static void given_a_folded_band_when_unrolled_then_lengths_are_those_along_it(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_points(context, folded, 0.0);
    double *const keep = malloc(COUNT * sizeof *keep);
    double *const plane = malloc(COUNT * 2 * sizeof *plane);
    for (size_t i = 0; i < COUNT; i++)
        keep[i] = 1.0;
    assert_int_equal(
        crease_unroll(context, crease_cloud_points(cloud), COUNT, keep, plane), CREASE_OK);
    for (size_t i = 1; i < 200; i++) {
        const size_t a = i, b = COUNT - i;
        const double u = fmod(0.5 + 0.7548776662466927 * (double)a, 1.0) -
            fmod(0.5 + 0.7548776662466927 * (double)b, 1.0);
        const double v = fmod(0.5 + 0.5698402909980532 * (double)a, 1.0) -
            fmod(0.5 + 0.5698402909980532 * (double)b, 1.0);
        const double length =
            hypot(plane[2 * a] - plane[2 * b], plane[2 * a + 1] - plane[2 * b + 1]);
        assert_near(length, hypot(u, v), 0.04 + 0.1 * hypot(u, v));
    }
    free(plane);
    free(keep);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_exact_points_of_a_winding_ridge_then_the_sheet_has_it),
        cmocka_unit_test(given_noise_then_the_ridge_is_found_within_a_fraction_of_it),
        cmocka_unit_test(given_more_points_than_are_explored_then_all_are_used),
        cmocka_unit_test(given_a_height_field_over_straight_lines_then_it_does_not_carry_the_ridge),
        cmocka_unit_test(given_a_band_folded_over_itself_then_the_sheet_follows_both_folds),
        cmocka_unit_test(given_two_curved_creases_then_the_sheet_has_both),
        cmocka_unit_test(given_a_ridge_that_fades_out_then_the_line_goes_on_smoothly),
        cmocka_unit_test(given_a_ridge_aslant_then_parameters_are_nearly_lengths_and_corners_stay),
        cmocka_unit_test(given_turned_and_scaled_points_then_the_ridge_comes_along),
        cmocka_unit_test(given_any_number_of_threads_then_the_sheet_is_the_same),
        cmocka_unit_test(given_a_folded_band_when_unrolled_then_lengths_are_those_along_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
