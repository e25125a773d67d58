/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Ridges as scanners see them: sharp, or rounded over some spacings. */
#include "given_faces.h"

#include "noise/blur.h"
#include "noise/noise.h"

/* A ridge of spacing 1 along y, at x = 0 and z = 0, whose sides fall as steeply as `fall` says; it
 * is rounded with a radius. Errors along z are shared by `alike` points of a line. */
static struct faces given_ridge(double fall, double radius, size_t alike)
{
    struct faces faces = given_faces(1);
    const double length = hypot(1, fall), touch = radius * fall / length;
    for (size_t j = 0; j < 70; j++)
        for (size_t i = 0; i < 60; i++) {
            const uint64_t n = (uint64_t)faces.count;
            const double x = (double)i - 30 + 0.4 * crease_random_uniform(9, 1, n);
            const double y = (double)j + 0.4 * crease_random_uniform(9, 2, n);
            const double error = 0.25 * crease_random_normal(9, 3, i * 70 + j / alike);
            const double z =
                fabs(x) < touch ? sqrt(radius * radius - x * x) - radius * length : -fall * fabs(x);
            add_point(&faces, x, y, z + error);
        }
    return faces;
}

/* Whether a cloud is blurred; *bent: by point. */
static bool find(crease_context *context, const struct faces *faces, uint8_t *bent)
{
    crease_cloud *cloud = cloud_of(context, faces);
    crease_noise *noise = NULL;
    bool blurred = false;
    assert_int_equal(crease_noise_estimate(context, cloud, &noise), CREASE_OK);
    assert_int_equal(
        crease_blur_find(context, faces->points, faces->count, noise, &blurred, bent), CREASE_OK);
    crease_noise_free(noise);
    crease_cloud_free(cloud);
    return blurred;
}

static void given_rounded_ridge_and_shared_errors_then_it_is_where_the_ridge_is(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_ridge(1, 4, 8);
    uint8_t *bent = calloc(faces.count, 1);
    assert_true(find(context, &faces, bent));
    size_t on = 0, found = 0;
    for (size_t i = 0; i < faces.count; i++) {
        const double away = fabs(faces.points[3 * i]);
        on += away < 2;
        found += away < 2 && bent[i];
        assert_false(away > 10 && bent[i]);
    }
    assert_true(10 * found > 9 * on);
    free(bent);
    free_faces(&faces);
    crease_context_free(context);
}

static void given_sharp_ridge_or_independent_errors_or_a_plain_then_nothing_is_blurred(void **state)
{
    static const double given[3][3] = {{1, 0, 8}, {1, 4, 1}, {0, 0, 8}};
    crease_context *context = given_context();
    for (size_t i = 0; i < 3; i++) {
        struct faces faces = given_ridge(given[i][0], given[i][1], (size_t)given[i][2]);
        uint8_t *bent = calloc(faces.count, 1);
        assert_false(find(context, &faces, bent));
        free(bent);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static crease_network *network_of(
    crease_context *context, const struct faces *faces, crease_regions **regions)
{
    crease_cloud *cloud = cloud_of(context, faces);
    crease_network *network = NULL;
    assert_int_equal(crease_regions_find(context, cloud, NULL, regions), CREASE_OK);
    assert_int_equal(crease_network_find(context, *regions, NULL, &network), CREASE_OK);
    crease_cloud_free(cloud);
    return network;
}

static void given_rounded_ridge_when_found_then_one_crease_where_it_was_sharp(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_ridge(1, 4, 8);
    crease_regions *regions = NULL;
    crease_network *network = network_of(context, &faces, &regions);
    assert_int_equal(crease_regions_count(regions), 2);
    assert_int_equal(crease_network_count(network), 1);
    assert_near(crease_network_at(network, 0).angle, 90, 4);
    assert_near(crease_network_at(network, 0).length, 70, 4);
    const crease_curve *curve = crease_network_curves(network)[0];
    const double *p = crease_curve_control_points(curve);
    for (size_t i = 0; i < crease_curve_count(curve); i++)
        assert_true(hypot(p[3 * i], p[3 * i + 2]) < 1);
    for (size_t i = 0; i < faces.count; i++)
        assert_true(crease_regions_labels(regions)[i] >= 0);
    crease_network_free(network);
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

/* The lesser of two numbers, the kink where they are equal rounded over that width. */
static double round_least(double a, double b, double width)
{
    const double deep = fmax(width - fabs(a - b), 0);
    return fmin(a, b) - deep * deep / (4 * width);
}

/* A block of spacing 1 with sloping sides on a floor, all its edges rounded over 6 spacings, in
 * heights of whole numbers. */
static struct faces given_rounded_block(void)
{
    struct faces faces = given_faces(1);
    for (size_t i = 0; i < 90; i++)
        for (size_t j = 0; j < 90; j++) {
            const uint64_t n = (uint64_t)faces.count;
            const double x = (double)i - 45 + 0.4 * crease_random_uniform(9, 1, n);
            const double y = (double)j - 45 + 0.4 * crease_random_uniform(9, 2, n);
            const double side = 1.2 * round_least(36 - fabs(x), 36 - fabs(y), 6);
            const double top = round_least(side, 17, 3.6);
            const double error = 0.3 * crease_random_normal(9, 3, 90 * i + j / 8);
            add_point(&faces, x, y, -round_least(-top, 0, 3.6) + error);
        }
    round_heights(&faces, 1);
    return faces;
}

static void given_rounded_block_when_found_then_twelve_edges_and_eight_corners(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_rounded_block();
    crease_regions *regions = NULL;
    crease_network *network = network_of(context, &faces, &regions);
    assert_int_equal(crease_regions_count(regions), 6);
    assert_int_equal(crease_network_count(network), 12);
    assert_int_equal(crease_network_corner_count(network), 8);
    for (size_t i = 0; i < 8; i++) {
        const crease_corner corner = crease_network_corner(network, i);
        const bool above = corner.position[2] > 8;
        assert_int_equal(corner.valence, 3);
        assert_near(corner.position[2], above ? 17 : 0, 1);
        for (int c = 0; c < 2; c++)
            assert_near(fabs(corner.position[c]), above ? 36 - 17 / 1.2 : 36, 1.5);
    }
    crease_network_free(network);
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

static void given_fillet_wider_than_any_blur_when_found_then_it_stays_round(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_ridge(1, 20, 8);
    crease_regions *regions = NULL;
    crease_network *network = network_of(context, &faces, &regions);
    assert_int_equal(crease_network_count(network), 0);
    crease_network_free(network);
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_rounded_ridge_and_shared_errors_then_it_is_where_the_ridge_is),
        cmocka_unit_test(
            given_sharp_ridge_or_independent_errors_or_a_plain_then_nothing_is_blurred),
        cmocka_unit_test(given_rounded_ridge_when_found_then_one_crease_where_it_was_sharp),
        cmocka_unit_test(given_rounded_block_when_found_then_twelve_edges_and_eight_corners),
        cmocka_unit_test(given_fillet_wider_than_any_blur_when_found_then_it_stays_round),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
