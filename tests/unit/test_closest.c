/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The closest places of a height field are those of the surface that it is. */
#include "given.h"

#include "base/random.h"
#include "fit/closest.h"

enum { COUNT = 3000 };

typedef struct sheet {
    crease_layout layout;
    crease_height height;
    crease_frame frame;
    crease_surface *surface;
} sheet;

/* A wavy height over the unit square, turned in space; a crease at 0.4. */
static sheet given_sheet(crease_context *context, int order, double waves)
{
    sheet s = {.layout = {.order = order,
                   .axis = {{.low = 0, .high = 1, .line_count = 1, .lines = {0.4}, .smooth = 9},
                       {.low = 0, .high = 1, .smooth = 12}}},
        .frame = {.rotation = {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6},
            .origin = {10, 20, -30}}};
    assert_int_equal(crease_height_create(context, &s.layout, &s.height), CREASE_OK);
    for (size_t i = 0; i < s.height.count[0] * s.height.count[1]; i++)
        s.height.coefficients[i] = waves * crease_random_normal(3, 0, i) +
            0.1 * (double)(i / s.height.count[1] % 7) / (double)s.height.count[0];
    assert_int_equal(crease_height_surface(context, &s.height, &s.frame, &s.surface), CREASE_OK);
    return s;
}

static void release(sheet *s)
{
    crease_surface_free(s->surface);
    crease_height_free(&s->height);
}

/* Some points on the sheet, some near, some far, some beside it. */
static void given_points(const sheet *s, double *points)
{
    for (size_t i = 0; i < COUNT; i++) {
        const double uv[2] = {1.1 * crease_random_uniform(4, 0, i) - 0.05,
            i % 5 ? crease_random_uniform(4, 1, i) : (double)(i % 2)};
        const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
        static const double off[4] = {0.0, 1e-3, 0.03, 0.5};
        double f[3];
        crease_height_at(&s->height, uv, sides, 0, f);
        points[3 * i] = i % 11 ? uv[0] : 0.4;
        points[3 * i + 1] = uv[1];
        points[3 * i + 2] = f[0] + off[i % 4] * crease_random_normal(4, 2, i);
    }
    crease_frame_leave(&s->frame, points, COUNT, points);
}

static crease_status find_feet(
    crease_context *context, const sheet *s, const double *points, crease_foot *feet)
{
    crease_closest *closest = NULL;
    crease_status status =
        crease_closest_create(context, &s->height, &s->layout, &s->frame, s->surface, &closest);
    if (status == CREASE_OK)
        status = crease_closest_feet(context, closest, points, COUNT, feet);
    crease_closest_free(closest);
    return status;
}

static void given_a_height_then_its_feet_are_those_of_the_surface(void **state)
{
    static double points[3 * COUNT];
    static crease_foot feet[COUNT], truth[COUNT];
    crease_context *context = given_context();
    for (int order = 2; order <= 5; order++)
        for (int rough = 0; rough < 2; rough++) {
            sheet s = given_sheet(context, order, rough ? 0.1 : 0.002);
            given_points(&s, points);
            assert_int_equal(find_feet(context, &s, points, feet), CREASE_OK);
            assert_int_equal(
                crease_surface_project(context, s.surface, points, COUNT, truth), CREASE_OK);
            for (size_t i = 0; i < COUNT; i++) {
                assert_near(feet[i].distance, truth[i].distance, 1e-12);
                double p[3];
                crease_surface_point(s.surface, feet[i].uv, p);
                for (int c = 0; c < 3; c++)
                    assert_near(feet[i].point[c], p[c], 1e-13);
            }
            release(&s);
        }
    crease_context_free(context);
}

static void given_any_number_of_threads_then_the_bytes_are_the_same(void **state)
{
    static double points[3 * COUNT];
    static crease_foot feet[2][COUNT];
    for (int threads = 1; threads <= 2; threads++) {
        crease_context *context = given_context_with_threads(threads);
        sheet s = given_sheet(context, 4, 0.02);
        given_points(&s, points);
        assert_int_equal(find_feet(context, &s, points, feet[threads - 1]), CREASE_OK);
        release(&s);
        crease_context_free(context);
    }
    assert_memory_equal(feet[0], feet[1], sizeof feet[0]);
}

static void given_a_failing_allocation_then_it_says_so(void **state)
{
    static double points[3 * COUNT];
    static crease_foot feet[COUNT];
    crease_context *context = given_context();
    sheet s = given_sheet(context, 4, 0.02);
    given_points(&s, points);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; status != CREASE_OK && n < 100; n++) {
        crease_context_fail_allocation(context, n);
        status = find_feet(context, &s, points, feet);
        crease_context_fail_allocation(context, -1);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
    }
    assert_true(n > 3 && n < 100);
    release(&s);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_height_then_its_feet_are_those_of_the_surface),
        cmocka_unit_test(given_any_number_of_threads_then_the_bytes_are_the_same),
        cmocka_unit_test(given_a_failing_allocation_then_it_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
