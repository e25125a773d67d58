/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* From a cloud to its creases, by the defaults. */
#include "given_models.h"

static const double S = 1.0 / 20;

typedef struct world {
    crease_context *context;
    given_points points;
    crease_regions *regions;
    crease_network *network;
} world;

static world world_of_points(given_points points, int threads)
{
    world w = {given_context_with_threads(threads), points, NULL, NULL};
    crease_cloud *cloud = given_cloud_of(w.context, points.points, points.count);
    if (crease_regions_find(w.context, cloud, NULL, &w.regions) != CREASE_OK ||
        crease_network_find(w.context, w.regions, NULL, &w.network) != CREASE_OK)
        fail_msg("%s", crease_context_message(w.context));
    crease_cloud_free(cloud);
    return w;
}

static world world_of(const given_body *body, double sigma)
{
    return world_of_points(given_sample(body, S, sigma * S, 11), 2);
}

static void end_world(world *w)
{
    crease_network_free(w->network);
    crease_regions_free(w->regions);
    free(w->points.points);
    free(w->points.labels);
    crease_context_free(w->context);
}

static size_t features_of(const world *w)
{
    size_t count = 0;
    for (size_t i = 0; i < w->points.count; i++)
        count += crease_network_features(w->network)[i];
    return count;
}

/* Distance of a place from the edges of the cube of side 1. */
static double from_cube_edges(const double p[3])
{
    double from[3];
    for (int c = 0; c < 3; c++)
        from[c] = fabs(fabs(p[c]) - 0.5);
    const double least = fmin(hypot(from[0], from[1]), hypot(from[1], from[2]));
    return fmin(least, hypot(from[0], from[2]));
}

/* Root mean square distance of the curves from the edges of the cube. */
static double rms_from_cube(const crease_network *network)
{
    double squares = 0;
    for (size_t i = 0; i < crease_network_count(network); i++)
        for (int k = 0; k <= 50; k++) {
            const crease_curve *curve = crease_network_curves(network)[i];
            double domain[2], place[3];
            crease_curve_domain(curve, domain);
            crease_curve_evaluate(
                curve, domain[0] + (domain[1] - domain[0]) * k / 50, CREASE_SIDE_RIGHT, 0, place);
            squares += pow(from_cube_edges(place), 2);
        }
    return sqrt(squares / (51 * (double)crease_network_count(network)));
}

static void given_noisy_cube_when_found_then_edges_as_sure_as_they_say(void **state)
{
    const given_body body = given_box(0.5, 0.5, 0.5);
    world w = world_of(&body, 0.32);
    assert_int_equal(crease_network_count(w.network), 12);
    assert_int_equal(crease_network_corner_count(w.network), 8);
    double angles = 0, angle_errors = 0, errors = 0;
    for (size_t i = 0; i < 12; i++) {
        const crease_network_crease crease = crease_network_at(w.network, i);
        assert_near(crease.angle, 90, 1);
        assert_near(crease.length, 1, 0.5 * S);
        angles += pow(crease.angle - 90, 2) / 12;
        angle_errors += pow(crease.angle_error, 2) / 12;
        errors += pow(crease.position_error, 2) / 12;
    }
    const double rms = rms_from_cube(w.network);
    assert_true(rms < 0.1 * S);
    /* both from twelve numbers or so that depend on each other: no better than a factor */
    assert_true(rms / sqrt(errors) > 0.4 && rms / sqrt(errors) < 2);
    assert_true(sqrt(angles / angle_errors) > 0.4 && sqrt(angles / angle_errors) < 2);
    for (size_t i = 0; i < 8; i++) {
        const crease_corner corner = crease_network_corner(w.network, i);
        assert_int_equal(corner.valence, 3);
        for (int c = 0; c < 3; c++)
            assert_near(fabs(corner.position[c]), 0.5, 0.2 * S);
    }
    end_world(&w);
}

static void given_noisy_cube_when_found_then_features_beside_edges(void **state)
{
    const given_body body = given_box(0.5, 0.5, 0.5);
    world w = world_of(&body, 0.16);
    size_t wrong = 0, right = 0;
    for (size_t i = 0; i < w.points.count; i++) {
        const bool feature = crease_network_features(w.network)[i];
        const double away = from_cube_edges(w.points.points + 3 * i);
        right += feature && away < S;
        wrong += feature != (away < S);
    }
    assert_true(wrong < right / 25);
    end_world(&w);
}

static void given_rod_when_found_then_two_rings_and_no_seam(void **state)
{
    const given_body body = given_rod(0.4, 0.5);
    world w = world_of(&body, 0.2);
    assert_int_equal(crease_regions_count(w.regions), 3);
    assert_int_equal(crease_network_count(w.network), 2);
    for (size_t i = 0; i < 2; i++) {
        assert_true(crease_network_at(w.network, i).closed);
        assert_near(crease_network_at(w.network, i).angle, 90, 1);
    }
    end_world(&w);
}

/* Two sheets without noise over the unit squares beside y = 0, which bend towards their crease. */
static double height_of(double x, double y)
{
    const double wave = 0.1 * cos(5 * x);
    return y < 0 ? wave - 0.9 * y * (1 - x) * (1 - x) - 0.5 * y * y
                 : wave + 1.2 * y * x * x + 0.4 * y - 0.8 * y * y;
}

static given_points given_sheets(int side)
{
    given_points points = {0, 0, NULL, NULL};
    for (int i = 0; i < 2 * side * side; i++) {
        const uint64_t draw = (uint64_t)i;
        const double x = (i % side + crease_random_uniform(6, 1, draw)) / side;
        const double y = (i / side + crease_random_uniform(6, 2, draw)) / side - 1;
        const double place[3] = {x, y, height_of(x, y)};
        given_point(&points, place, 0);
    }
    return points;
}

static void given_curved_sheets_when_found_then_crease_where_they_meet(void **state)
{
    const int side = 40;
    world w = world_of_points(given_sheets(side), 2);
    assert_int_equal(crease_network_count(w.network), 1);
    const crease_curve *curve = crease_network_curves(w.network)[0];
    double domain[2], squares = 0;
    crease_curve_domain(curve, domain);
    for (int k = 0; k <= 100; k++) {
        double place[3];
        crease_curve_evaluate(
            curve, domain[0] + (domain[1] - domain[0]) * k / 100, CREASE_SIDE_RIGHT, 0, place);
        squares += (pow(place[1], 2) + pow(place[2] - height_of(place[0], 0), 2)) / 101;
    }
    assert_true(sqrt(squares) * side < 0.15);
    end_world(&w);
}

static void given_few_points_on_a_wavy_sheet_when_found_then_no_crease(void **state)
{
    const double turn = 2 * acos(-1);
    for (uint64_t seed = 1; seed <= 4; seed++) {
        given_points points = {0, 0, NULL, NULL};
        for (uint64_t i = 0; i < 800; i++) {
            const double x = crease_random_uniform(seed, 1, i);
            const double y = crease_random_uniform(seed, 2, i);
            const double place[3] = {x, y, 0.1 * sin(turn * x) * cos(turn * y)};
            given_point(&points, place, 0);
        }
        world w = world_of_points(points, 2);
        assert_int_equal(crease_network_count(w.network), 0);
        end_world(&w);
    }
}

static void given_torus_and_sphere_when_found_then_no_crease(void **state)
{
    const double origin[3] = {0, 0, 0}, z[3] = {0.3, 0.1, 1};
    for (int noise = 0; noise < 3; noise++)
        for (int kind = 0; kind < 2; kind++) {
            given_body body = {.size = 1};
            given_add(&body,
                kind ? given_model(CREASE_REGION_TORUS, origin, z, 0.5, 0.2)
                     : given_model(CREASE_REGION_SPHERE, origin, z, 0.5, 0));
            world w = world_of(&body, 0.3 * noise);
            assert_int_equal(crease_network_count(w.network), 0);
            assert_int_equal(features_of(&w), 0);
            end_world(&w);
        }
}

static void given_open_sheet_when_found_then_its_border_is_no_crease(void **state)
{
    const double origin[3] = {0, 0, 0}, z[3] = {0.3, 0.1, 1};
    given_body body = {.size = 0.5};
    given_add(&body, given_plane(origin, z));
    world w = world_of(&body, 0.3);
    assert_int_equal(crease_network_count(w.network), 0);
    assert_int_equal(features_of(&w), 0);
    end_world(&w);
}

static void given_pyramid_when_found_then_four_creases_meet(void **state)
{
    const given_body body = given_pyramid(4, 1);
    world w = world_of(&body, 0.1);
    assert_int_equal(crease_network_count(w.network), 8);
    assert_int_equal(crease_network_corner_count(w.network), 5);
    size_t four = 0;
    for (size_t i = 0; i < 5; i++)
        four += crease_network_corner(w.network, i).valence == 4;
    assert_int_equal(four, 1);
    end_world(&w);
}

static void given_outliers_when_found_then_the_same_creases(void **state)
{
    const given_body body = given_box(0.5, 0.5, 0.5);
    given_points points = given_sample(&body, S, 0.16 * S, 3);
    for (uint64_t i = 0; i < 30; i++) {
        double place[3];
        for (uint64_t c = 0; c < 3; c++)
            place[c] = 1.2 * crease_random_uniform(4, c, i) - 0.6;
        given_point(&points, place, -1);
    }
    world w = world_of_points(points, 2);
    assert_int_equal(crease_network_count(w.network), 12);
    assert_int_equal(crease_network_corner_count(w.network), 8);
    assert_true(rms_from_cube(w.network) < 0.1 * S);
    end_world(&w);
}

static void given_any_number_of_threads_when_found_then_the_same_bytes(void **state)
{
    const given_body body = given_rod(0.4, 0.3);
    world one = world_of_points(given_sample(&body, S, 0.3 * S, 11), 1);
    world four = world_of_points(given_sample(&body, S, 0.3 * S, 11), 4);
    assert_int_equal(crease_network_count(one.network), crease_network_count(four.network));
    assert_memory_equal(crease_network_features(one.network), crease_network_features(four.network),
        one.points.count);
    for (size_t i = 0; i < crease_network_count(one.network); i++) {
        const crease_curve *a = crease_network_curves(one.network)[i];
        const crease_curve *b = crease_network_curves(four.network)[i];
        assert_int_equal(crease_curve_count(a), crease_curve_count(b));
        assert_memory_equal(crease_curve_control_points(a), crease_curve_control_points(b),
            3 * sizeof(double) * crease_curve_count(a));
    }
    end_world(&one);
    end_world(&four);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_noisy_cube_when_found_then_edges_as_sure_as_they_say),
        cmocka_unit_test(given_noisy_cube_when_found_then_features_beside_edges),
        cmocka_unit_test(given_rod_when_found_then_two_rings_and_no_seam),
        cmocka_unit_test(given_curved_sheets_when_found_then_crease_where_they_meet),
        cmocka_unit_test(given_few_points_on_a_wavy_sheet_when_found_then_no_crease),
        cmocka_unit_test(given_torus_and_sphere_when_found_then_no_crease),
        cmocka_unit_test(given_open_sheet_when_found_then_its_border_is_no_crease),
        cmocka_unit_test(given_pyramid_when_found_then_four_creases_meet),
        cmocka_unit_test(given_outliers_when_found_then_the_same_creases),
        cmocka_unit_test(given_any_number_of_threads_when_found_then_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
