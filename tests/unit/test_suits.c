/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"

enum { COUNT = 6000 };

static double uniform(size_t point, int draw)
{
    return crease_random_uniform(3, point, (uint64_t)draw);
}

static double noise(size_t point)
{
    return crease_random_normal(5, point, 0);
}

typedef void surface(size_t point, double place[3]);

/* Two faces that meet at 40 degrees, noisy, with one point in a hundred anywhere. */
static void steep_roof(size_t i, double place[3])
{
    place[0] = 2 * uniform(i, 0) - 1;
    place[1] = 2 * uniform(i, 1);
    place[2] = -fabs(place[0]) * 2.75 + 0.02 * noise(i);
    if (i % 100 == 0)
        place[2] = 6 * uniform(i, 2) - 3;
}

static void ball(size_t i, double place[3])
{
    const double z = 2 * uniform(i, 0) - 1, turn = 6.283185307 * uniform(i, 1);
    place[0] = sqrt(1 - z * z) * cos(turn);
    place[1] = sqrt(1 - z * z) * sin(turn);
    place[2] = z;
}

/* Half a tube: open downwards. */
static void gutter(size_t i, double place[3])
{
    const double turn = 3.141592653 * uniform(i, 0);
    place[0] = cos(turn);
    place[1] = 3 * uniform(i, 1);
    place[2] = sin(turn);
}

/* Both sides of a slanted plate, three spacings thick, one with a tenth of the points. */
static void plate(size_t i, double place[3])
{
    const double spacing = sqrt(16.0 / COUNT);
    place[0] = 4 * uniform(i, 0);
    place[1] = 4 * uniform(i, 1);
    place[2] = 0.8 * place[0] + (i % 10 == 0 ? 3 * spacing : 0) + 0.2 * spacing * noise(i);
}

/* A block with twenty walls in it: no height between its top and its bottom is empty. */
static void block_of_walls(size_t i, double place[3])
{
    place[0] = i % 8 == 0 ? 2 * uniform(i, 0) : 0.1 * (double)(i % 20);
    place[1] = 2 * uniform(i, 1);
    place[2] = i % 8 > 0 ? 2 * uniform(i, 2) : i % 16 == 0 ? 2 : 0;
}

/* Two faces without noise: heights over their planes are rounding errors of a few values only. */
static void exact_roof(size_t i, double place[3])
{
    place[0] = 2 * uniform(i, 0) - 1;
    place[1] = 2 * uniform(i, 1);
    place[2] = -0.7 * fabs(place[0]);
}

/* The same as a file of single precision has it. */
static void rounded_roof(size_t i, double place[3])
{
    exact_roof(i, place);
    for (int c = 0; c < 3; c++)
        place[c] = (float)place[c];
}

static bool suits(crease_context *context, const crease_cloud *cloud)
{
    bool answer = false;
    assert_int_equal(crease_sheet_suits(context, cloud, &answer), CREASE_OK);
    return answer;
}

static bool surface_suits(surface *place)
{
    crease_context *context = given_context();
    static double points[3 * COUNT];
    for (size_t i = 0; i < COUNT; i++)
        place(i, points + 3 * i);
    crease_cloud *cloud = given_cloud_of(context, points, COUNT);
    const bool answer = suits(context, cloud);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return answer;
}

static void given_a_surface_in_one_layer_then_a_sheet_suits(void **state)
{
    assert_true(surface_suits(steep_roof));
    assert_true(surface_suits(gutter));
    assert_true(surface_suits(exact_roof));
    assert_true(surface_suits(rounded_roof));
}

static void given_a_surface_over_another_then_no_sheet_suits(void **state)
{
    assert_false(surface_suits(ball));
    assert_false(surface_suits(plate));
    assert_false(surface_suits(block_of_walls));
}

static void given_the_examples_then_only_the_cube_is_no_sheet(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cube = NULL, *sample = NULL, *panel = NULL;
    assert_int_equal(crease_shape_cube(context, 32, &cube), CREASE_OK);
    assert_int_equal(crease_shape_sample(context, NULL, &sample), CREASE_OK);
    assert_int_equal(crease_shape_panel(context, NULL, &panel), CREASE_OK);
    assert_false(suits(context, cube));
    assert_true(suits(context, sample));
    assert_true(suits(context, panel));
    crease_cloud_free(panel);
    crease_cloud_free(sample);
    crease_cloud_free(cube);
    crease_context_free(context);
}

static void given_points_on_a_line_then_it_is_refused(void **state)
{
    crease_context *context = given_context();
    const double points[] = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4};
    const crease_cloud_parts parts = {
        .count = 5, .points = points, .coordinate_type = CREASE_TYPE_FLOAT64};
    crease_cloud *cloud = NULL;
    bool answer = true;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    assert_int_equal(crease_sheet_suits(context, cloud, &answer), CREASE_ERROR_DEGENERATE);
    assert_false(answer);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_surface_in_one_layer_then_a_sheet_suits),
        cmocka_unit_test(given_a_surface_over_another_then_no_sheet_suits),
        cmocka_unit_test(given_the_examples_then_only_the_cube_is_no_sheet),
        cmocka_unit_test(given_points_on_a_line_then_it_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
