/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What an outline need not look at. */
#include "given.h"

#include "base/random.h"
#include "space/hollow.h"
#include "space/outline.h"

enum { COUNT = 3000 };

typedef struct scene {
    crease_context *context;
    size_t count;
    double places[COUNT][2];
    unsigned char hollow[COUNT];
} scene;

/* Random points in the unit square, about a spacing of 0.018, with a hole and some far away. */
static scene *given_places(uint64_t seed)
{
    scene *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->context = given_context();
    for (uint64_t i = 0; s->count < COUNT - 4; i++) {
        const double x = crease_random_uniform(seed, 1, i), y = crease_random_uniform(seed, 2, i);
        if (hypot(x - 0.4, y - 0.6) < 0.15)
            continue;
        s->places[s->count][0] = x;
        s->places[s->count++][1] = y;
    }
    for (int i = 0; i < 4; i++, s->count++) {
        s->places[s->count][0] = 2.0 + 0.01 * i;
        s->places[s->count][1] = -1.0 - 0.01 * (i % 2);
    }
    return s;
}

static void when_told(scene *s, double radius)
{
    assert_int_equal(
        crease_hollow_find(s->context, s->places[0], s->count, radius, s->hollow), CREASE_OK);
}

static size_t count_of(const scene *s, crease_hollow kind)
{
    size_t count = 0;
    for (size_t i = 0; i < s->count; i++)
        count += s->hollow[i] == kind;
    return count;
}

static void free_scene(scene *s)
{
    crease_context_free(s->context);
    free(s);
}

static void find_outline(const scene *s, double radius, crease_outline *out)
{
    double points[COUNT][3] = {{0}}, normals[COUNT][3] = {{0}};
    for (size_t i = 0; i < s->count; i++) {
        memcpy(points[i], s->places[i], sizeof s->places[i]);
        normals[i][2] = 1.0;
    }
    assert_int_equal(
        crease_outline_find(s->context, points[0], normals[0], s->count, NULL, radius, out),
        CREASE_OK);
}

static void given_most_points_are_not_looked_at_then_the_same_outline(void **state)
{
    for (uint64_t seed = 0; seed < 6; seed++) {
        scene *s = given_places(seed);
        const double radius = 0.03 + 0.008 * (double)seed;
        crease_outline all, flat;
        find_outline(s, radius, &all);
        assert_int_equal(
            crease_outline_find_flat(s->context, s->places[0], s->count, radius, &flat), CREASE_OK);
        assert_true(all.loop_count >= 2);
        assert_int_equal(all.loop_count, flat.loop_count);
        assert_memory_equal(all.first, flat.first, (all.loop_count + 1) * sizeof *all.first);
        assert_memory_equal(
            all.points, flat.points, all.first[all.loop_count] * sizeof *all.points);
        crease_outline_clear(&all);
        crease_outline_clear(&flat);
        free_scene(s);
    }
}

static void given_a_point_that_is_far_then_none_that_is_touched_is_within_two_radii(void **state)
{
    scene *s = given_places(7);
    const double radius = 0.04;
    when_told(s, radius);
    assert_true(count_of(s, CREASE_HOLLOW_FAR) > 100);
    for (size_t i = 0; i < s->count; i++)
        for (size_t k = 0; k < s->count; k++)
            if (s->hollow[i] == CREASE_HOLLOW_FAR && s->hollow[k] == CREASE_HOLLOW_TOUCHED)
                assert_true(hypot(s->places[i][0] - s->places[k][0],
                                s->places[i][1] - s->places[k][1]) >= 2.0 * radius);
    free_scene(s);
}

static void given_very_sparse_points_or_one_then_all_may_be_touched(void **state)
{
    scene *s = given_places(1);
    when_told(s, 1e-6);
    assert_int_equal(count_of(s, CREASE_HOLLOW_TOUCHED), s->count);
    s->count = 1;
    when_told(s, 0.1);
    assert_int_equal(count_of(s, CREASE_HOLLOW_TOUCHED), 1);
    s->count = 0;
    when_told(s, 0.1);
    crease_outline outline;
    assert_int_equal(
        crease_outline_find_flat(s->context, s->places[0], 0, 0.1, &outline), CREASE_OK);
    assert_int_equal(outline.loop_count, 0);
    crease_outline_clear(&outline);
    free_scene(s);
}

static void given_no_memory_then_it_says_so(void **state)
{
    scene *s = given_places(2);
    crease_outline outline;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; status != CREASE_OK && n < 50; n++) {
        crease_context_fail_allocation(s->context, n);
        status = crease_outline_find_flat(s->context, s->places[0], s->count, 0.04, &outline);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
    }
    crease_context_fail_allocation(s->context, -1);
    assert_int_equal(status, CREASE_OK);
    assert_true(n > 8);
    crease_outline_clear(&outline);
    free_scene(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_most_points_are_not_looked_at_then_the_same_outline),
        cmocka_unit_test(given_a_point_that_is_far_then_none_that_is_touched_is_within_two_radii),
        cmocka_unit_test(given_very_sparse_points_or_one_then_all_may_be_touched),
        cmocka_unit_test(given_no_memory_then_it_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
