/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions united across smooth joins, and whether a sheet has the creases of a cloud. */
#include "given.h"

#include "base/random.h"
#include "snap/coarser.h"

#include <stdlib.h>

enum { SIDE = 36 };

typedef struct scene {
    crease_context *context;
    crease_cloud *cloud;
    crease_regions *regions;
    crease_network *network;
    crease_sheet *sheet;
} scene;

/* What a cloud is drawn from. */
typedef struct draw {
    uint64_t seed, side;
    double noise;
    bool turned;
} draw;

/* Turns a point by 40 degrees about x, then by 70 about z. */
static void turn(double p[3])
{
    const double y = 0.76604444 * p[1] - 0.64278761 * p[2];
    const double z = 0.64278761 * p[1] + 0.76604444 * p[2];
    const double x = 0.34202014 * p[0] - 0.93969262 * y;
    p[1] = 0.93969262 * p[0] + 0.34202014 * y;
    p[0] = x;
    p[2] = z;
}

/* One random point in each cell of a grid over the unit square, under a height; none where that is
 * infinite. */
static scene given_drawn(double (*height)(double x, double y), draw d)
{
    scene s = {.context = given_context_with_threads(2)};
    double(*const points)[3] = calloc(d.side * d.side, sizeof *points);
    const double side = (double)d.side;
    size_t count = 0;
    assert_non_null(points);
    for (uint64_t i = 0; i < d.side * d.side; i++) {
        const double x = ((double)(i / d.side) + crease_random_uniform(d.seed, 1, i)) / side;
        const double y = ((double)(i % d.side) + crease_random_uniform(d.seed, 2, i)) / side;
        const double z = height(x, y) + d.noise * crease_random_normal(d.seed, 3, i);
        if (isfinite(z))
            memcpy(points[count++], (double[]){x, y, z}, sizeof points[0]);
    }
    for (size_t i = 0; i < count && d.turned; i++)
        turn(points[i]);
    s.cloud = given_cloud_of(s.context, points[0], count);
    free(points);
    return s;
}

static scene given_heights(double (*height)(double x, double y), double noise)
{
    return given_drawn(height, (draw){.seed = 3, .side = SIDE, .noise = noise});
}

static size_t when_divided(scene *s, bool united)
{
    crease_regions_options options = crease_regions_options_default();
    options.united = united;
    crease_regions_free(s->regions);
    assert_int_equal(crease_regions_find(s->context, s->cloud, &options, &s->regions), CREASE_OK);
    return crease_regions_count(s->regions);
}

static bool when_carried(scene *s)
{
    bool carries = false;
    when_divided(s, true);
    assert_int_equal(crease_network_find(s->context, s->regions, NULL, &s->network), CREASE_OK);
    assert_int_equal(crease_sheet_fit(s->context, s->cloud, NULL, &s->sheet), CREASE_OK);
    assert_int_equal(
        crease_sheet_carries(s->context, s->sheet, s->regions, s->network, &carries), CREASE_OK);
    return carries;
}

static void free_scene(scene *s)
{
    crease_sheet_free(s->sheet);
    crease_network_free(s->network);
    crease_regions_free(s->regions);
    crease_cloud_free(s->cloud);
    crease_context_free(s->context);
}

static double roof(double x, double y)
{
    (void)y;
    return -fabs(x - 0.5);
}

/* Three planes whose creases meet inside at 120 degrees. */
static double star(double x, double y)
{
    const double a = x - 0.5, b = y - 0.5;
    return fmax(a, fmax(-0.5 * a + 0.8660254 * b, -0.5 * a - 0.8660254 * b));
}

static double hip_roof(double x, double y)
{
    return fmin(fmin(y, 1.0 - y), fmin(1.5 * x, 1.5 * (1.0 - x)));
}

/* A hill and, aslant, a straight break line that is cut by a lake. */
static double terrain(double x, double y)
{
    if (hypot(x - 0.6, y - 0.25) < 0.1)
        return INFINITY;
    return 0.1 * exp(-(pow(x - 0.3, 2.0) + pow(y - 0.6, 2.0)) / 0.03) +
        0.5 * fmax(0.0, x + 0.4 * y - 0.8);
}

static double waves(double x, double y)
{
    return 0.06 * sin(5.0 * x + 1.0) * cos(4.0 * y);
}

static double waves_with_a_crease(double x, double y)
{
    return waves(x, y) + fmax(0.0, x - 0.5 - 0.1 * sin(4.0 * y));
}

static void given_waves_then_one_region_when_united(void **state)
{
    (void)state;
    scene s = given_heights(waves, 0.002);
    const size_t apart = when_divided(&s, false), united = when_divided(&s, true);
    assert_true(united <= apart);
    assert_int_equal(united, 1);
    free_scene(&s);
}

/* A rod whose flat side goes on into it without an angle. */
static double flat_rod(double x, double y)
{
    (void)y;
    return x < 0.5 ? 0.0 : sqrt(1.0 - (x - 0.5) * (x - 0.5)) - 1.0;
}

static void given_regions_then_those_united_are_the_same_as_found_so(void **state)
{
    (void)state;
    scene s = given_heights(flat_rod, 0.002);
    const size_t united = when_divided(&s, true), apart = when_divided(&s, false);
    crease_regions *coarser = NULL, *again = NULL;
    assert_true(united < apart);
    assert_int_equal(crease_regions_find_coarser(s.context, s.regions, &coarser), CREASE_OK);
    assert_int_equal(crease_regions_count(coarser), united);
    assert_int_equal(crease_regions_point_count(coarser), crease_cloud_count(s.cloud));
    assert_int_equal(crease_regions_find_coarser(s.context, coarser, &again), CREASE_OK);
    assert_null(again);
    crease_regions_free(coarser);
    free_scene(&s);
}

static void given_failing_memory_when_united_then_error_and_no_leak(void **state)
{
    (void)state;
    scene s = given_drawn(flat_rod, (draw){.seed = 3, .side = 12, .noise = 0.002});
    crease_context *const alone = given_context_with_threads(1);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    when_divided(&s, false);
    for (long n = 0; status != CREASE_OK; n++) {
        crease_regions *coarser = NULL;
        crease_context_fail_allocation(alone, n);
        status = crease_regions_find_coarser(alone, s.regions, &coarser);
        crease_context_fail_allocation(alone, -1);
        assert_true(status == CREASE_OK ? n > 10 : status == CREASE_ERROR_NO_MEMORY);
        assert_true((coarser != NULL) == (status == CREASE_OK));
        crease_regions_free(coarser);
    }
    crease_context_free(alone);
    free_scene(&s);
}

static void given_a_crease_then_two_regions_even_when_united(void **state)
{
    (void)state;
    scene s = given_heights(waves_with_a_crease, 0.002);
    assert_int_equal(when_divided(&s, true), 2);
    free_scene(&s);
}

static void given_planes_then_uniting_changes_nothing(void **state)
{
    (void)state;
    scene s = given_heights(star, 0.002);
    assert_int_equal(when_divided(&s, true), 3);
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(crease_regions_at(s.regions, i).type, CREASE_REGION_PLANE);
    free_scene(&s);
}

/* A cylinder without the points of a band wider than nearest neighbours reach across. */
static double arch_with_a_gap(double x, double y)
{
    return fabs(y - 0.4) < 1.3 / SIDE ? INFINITY : sqrt(1.0 - (x - 0.5) * (x - 0.5));
}

static void given_a_gap_in_the_points_then_one_region_on_both_sides(void **state)
{
    (void)state;
    for (int noisy = 0; noisy < 2; noisy++) {
        scene s = given_heights(arch_with_a_gap, 0.003 * noisy);
        assert_int_equal(when_divided(&s, false), 1);
        assert_int_equal(crease_regions_at(s.regions, 0).type, CREASE_REGION_CYLINDER);
        free_scene(&s);
    }
}

/* A plane with a ridge across it. */
static double ridge(double x, double y)
{
    (void)x;
    return fmax(0.0, 0.1 - fabs(y - 0.5));
}

static void given_a_ridge_then_the_plane_on_either_side_is_a_region(void **state)
{
    (void)state;
    for (int noisy = 0; noisy < 2; noisy++) {
        scene s = given_heights(ridge, 0.003 * noisy);
        assert_int_equal(when_divided(&s, false), 4);
        free_scene(&s);
    }
}

/* A plane and, at an angle to it, a surface that winds ever more: primitives fit it nearly where it
 * hardly does. */
static double plane_and_twist(double x, double y)
{
    return fmax(0.0, x - 0.55) * (1.0 + 0.6 * pow(y, 8.0));
}

static void given_an_exact_plane_then_what_fits_nearly_is_no_plane(void **state)
{
    (void)state;
    scene s = given_heights(plane_and_twist, 0.0);
    assert_int_equal(when_divided(&s, false), 2);
    size_t forms = 0;
    for (size_t i = 0; i < 2; i++)
        forms += crease_regions_at(s.regions, i).type == CREASE_REGION_FREEFORM;
    assert_int_equal(forms, 1);
    free_scene(&s);
}

static void given_a_roof_then_the_sheet_carries_its_crease(void **state)
{
    (void)state;
    scene s = given_heights(roof, 0.002);
    assert_true(when_carried(&s));
    free_scene(&s);
}

static void given_creases_that_meet_inside_then_no_sheet_carries_them(void **state)
{
    (void)state;
    scene s = given_heights(star, 0.002);
    assert_false(when_carried(&s));
    free_scene(&s);
}

static void given_a_break_line_aslant_then_the_sheet_carries_it(void **state)
{
    (void)state;
    static const draw draws[] = {{.seed = 4, .side = 80, .noise = 0.0006},
        {.seed = 5, .side = 80, .noise = 0.0018},
        {.seed = 6, .side = 80, .noise = 0.0012, .turned = true}};
    for (size_t i = 0; i < sizeof draws / sizeof *draws; i++) {
        scene s = given_drawn(terrain, draws[i]);
        assert_true(when_carried(&s));
        free_scene(&s);
    }
}

static void given_a_hip_roof_then_no_sheet_carries_its_creases(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        scene s = given_drawn(
            hip_roof, (draw){.seed = seed, .side = SIDE, .noise = 0.006, .turned = seed == 3});
        assert_false(when_carried(&s));
        free_scene(&s);
    }
}

static double shallow_roof(double x, double y)
{
    (void)y;
    return -0.25 * fabs(x - 0.5);
}

static double shifted; /* spacings */

static double shifted_roof(double x, double y)
{
    return shallow_roof(x - shifted / SIDE, y);
}

/* Whether the sheet of a roof carries the crease of one that many spacings beside it. */
static bool when_beside(scene *s, double spacings, double noise)
{
    bool carries = false;
    shifted = spacings;
    scene beside = given_heights(shifted_roof, noise);
    when_divided(&beside, true);
    assert_int_equal(
        crease_network_find(beside.context, beside.regions, NULL, &beside.network), CREASE_OK);
    assert_int_equal(
        crease_sheet_carries(s->context, s->sheet, beside.regions, beside.network, &carries),
        CREASE_OK);
    free_scene(&beside);
    return carries;
}

static void given_a_line_beside_the_crease_then_it_may_be_as_far_off_as_no_point_tells(void **state)
{
    (void)state;
    for (int noisy = 0; noisy < 2; noisy++) {
        const double noise = noisy ? 0.006 : 0.0006;
        scene s = given_heights(shallow_roof, noise);
        assert_int_equal(crease_sheet_fit(s.context, s.cloud, NULL, &s.sheet), CREASE_OK);
        assert_int_equal(when_beside(&s, 0.75, noise), noisy);
        assert_false(when_beside(&s, 1.5, noise));
        free_scene(&s);
    }
}

static void given_no_crease_then_any_sheet_will_do(void **state)
{
    (void)state;
    scene s = given_heights(waves, 0.002);
    assert_true(when_carried(&s));
    free_scene(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_waves_then_one_region_when_united),
        cmocka_unit_test(given_regions_then_those_united_are_the_same_as_found_so),
        cmocka_unit_test(given_failing_memory_when_united_then_error_and_no_leak),
        cmocka_unit_test(given_a_crease_then_two_regions_even_when_united),
        cmocka_unit_test(given_planes_then_uniting_changes_nothing),
        cmocka_unit_test(given_a_gap_in_the_points_then_one_region_on_both_sides),
        cmocka_unit_test(given_a_ridge_then_the_plane_on_either_side_is_a_region),
        cmocka_unit_test(given_an_exact_plane_then_what_fits_nearly_is_no_plane),
        cmocka_unit_test(given_a_roof_then_the_sheet_carries_its_crease),
        cmocka_unit_test(given_creases_that_meet_inside_then_no_sheet_carries_them),
        cmocka_unit_test(given_a_break_line_aslant_then_the_sheet_carries_it),
        cmocka_unit_test(given_a_hip_roof_then_no_sheet_carries_its_creases),
        cmocka_unit_test(
            given_a_line_beside_the_crease_then_it_may_be_as_far_off_as_no_point_tells),
        cmocka_unit_test(given_no_crease_then_any_sheet_will_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
