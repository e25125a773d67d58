/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_models.h"

#include "crease/intersect.h"

static const double ORIGIN[3] = {0, 0, 0};
static const double X[3] = {1, 0, 0}, Y[3] = {0, 1, 0}, Z[3] = {0, 0, 1};

/* Marches from a place beside the curve until it is back, at most 100000 steps; calls `check` on
 * each point. Returns the length of the way. */
static double march(const crease_model *const models[2], double step, const double from[3],
    void (*check)(const double place[3]))
{
    double place[3] = {from[0], from[1], from[2]}, tangent[3], length = 0;
    assert_true(crease_intersection_project(models, 1, place, tangent));
    const double start[3] = {place[0], place[1], place[2]};
    for (int i = 0; i < 100000; i++) {
        const double before[3] = {place[0], place[1], place[2]};
        check(place);
        assert_true(crease_intersection_step(models, step, place, tangent));
        assert_near(crease_vector_length(tangent), 1, 1e-12);
        const double moved = crease_vector_distance(before, place);
        assert_true(moved > 0.05 * step && moved < 1.5 * step);
        length += moved;
        const double rest[3] = {start[0] - place[0], start[1] - place[1], start[2] - place[2]};
        if (length > 3 * step && crease_vector_length(rest) < 0.6 * step)
            return length + crease_vector_dot(rest, tangent);
    }
    fail_msg("the march did not come back");
    return 0;
}

static void given_two_planes_when_projected_then_on_their_line(void **state)
{
    const double normal[3] = {1, 0, 2}, place[3] = {0.5, 0, 0};
    const crease_model a = given_plane(ORIGIN, Z), b = given_plane(place, normal);
    const crease_model *const models[2] = {&a, &b};
    double at[3] = {0.4, 7, 0.2}, tangent[3];
    assert_true(crease_intersection_project(models, 1, at, tangent));
    assert_near(at[0], 0.5, 1e-12);
    assert_near(at[1], 7, 1e-12);
    assert_near(at[2], 0, 1e-12);
    assert_near(fabs(tangent[1]), 1, 1e-12);
    assert_true(crease_intersection_step(models, 0.25, at, tangent));
    assert_near(fabs(at[1] - 7), 0.25, 1e-12);
}

static void given_nearly_parallel_planes_when_projected_then_refused(void **state)
{
    const double normal[3] = {0.03, 0, 1};
    const crease_model a = given_plane(ORIGIN, Z), b = given_plane(ORIGIN, normal);
    const crease_model *const models[2] = {&a, &b};
    double at[3] = {0.1, 0, 0}, tangent[3];
    assert_false(crease_intersection_project(models, 1, at, tangent));
}

static void given_planes_that_meet_far_away_when_projected_then_refused(void **state)
{
    const double normal[3] = {1, 0, 1};
    const crease_model a = given_plane(ORIGIN, Z), b = given_plane(ORIGIN, normal);
    const crease_model *const models[2] = {&a, &b};
    double at[3] = {5, 0, 0}, tangent[3];
    assert_false(crease_intersection_project(models, 1, at, tangent));
}

static void given_plane_tangent_to_cylinder_when_projected_then_refused(void **state)
{
    const double top[3] = {0, 0, 1};
    const crease_model a = given_plane(top, Z);
    const crease_model b = given_model(CREASE_REGION_CYLINDER, ORIGIN, X, 1, 0);
    const crease_model *const models[2] = {&a, &b};
    double at[3] = {0, 0.01, 1}, tangent[3];
    assert_false(crease_intersection_project(models, 1, at, tangent));
}

static void on_circle(const double p[3])
{
    assert_near(hypot(p[0], p[1]), 1, 1e-9);
    assert_near(p[2], 0.25, 1e-9);
}

static void given_plane_across_cylinder_when_marched_then_circle(void **state)
{
    const double place[3] = {3, 4, 0.25}, from[3] = {1.05, 0, 0.2};
    const crease_model a = given_plane(place, Z);
    const crease_model b = given_model(CREASE_REGION_CYLINDER, ORIGIN, Z, 1, 0);
    const crease_model *const models[2] = {&a, &b};
    assert_near(march(models, 0.01, from, on_circle), 2 * acos(-1), 1e-4);
}

static void on_ellipse(const double p[3])
{
    assert_near(p[0] * p[0] + p[1] * p[1], 1, 1e-9);
    assert_near(p[2], 0.75 * p[0], 1e-9);
}

static void given_slanted_plane_when_marched_then_ellipse(void **state)
{
    const double normal[3] = {-0.75, 0, 1}, from[3] = {0, 1, 0.1};
    const crease_model a = given_plane(ORIGIN, normal);
    const crease_model b = given_model(CREASE_REGION_CYLINDER, ORIGIN, Z, 1, 0);
    const crease_model *const models[2] = {&a, &b};
    /* half-axes 1 and 1.25; perimeter by Ramanujan's second formula, good to 1e-9 here */
    const double h = (0.25 / 2.25) * (0.25 / 2.25);
    const double perimeter = acos(-1) * 2.25 * (1 + 3 * h / (10 + sqrt(4 - 3 * h)));
    assert_near(march(models, 0.01, from, on_ellipse), perimeter, 1e-4);
}

static void on_tee(const double p[3])
{
    assert_near(p[1] * p[1] + p[2] * p[2], 1, 1e-9);
    assert_near(p[0] * p[0] + p[1] * p[1], 0.25, 1e-9);
}

static void given_two_cylinders_when_marched_then_ring_of_a_tee(void **state)
{
    const double from[3] = {0.5, 0, 1};
    const crease_model a = given_model(CREASE_REGION_CYLINDER, ORIGIN, X, 1, 0);
    const crease_model b = given_model(CREASE_REGION_CYLINDER, ORIGIN, Z, 0.5, 0);
    const crease_model *const models[2] = {&a, &b};
    double length = 0; /* of (cos t / 2, sin t / 2, sqrt(1 - sin(t)^2 / 4)) */
    for (int i = 0; i < 100000; i++) {
        const double t = 2 * acos(-1) * (i + 0.5) / 100000;
        const double slope = -sin(t) * cos(t) / 4 / sqrt(1 - sin(t) * sin(t) / 4);
        length += sqrt(0.25 + slope * slope) * 2 * acos(-1) / 100000;
    }
    assert_near(march(models, 0.01, from, on_tee), length, 1e-3);
}

static void on_cone(const double p[3])
{
    const double height = p[2] + 1; /* above the apex */
    assert_near(p[0] * p[0] + p[1] * p[1], 0.25 * height * height, 1e-9);
    assert_near(p[2], 0.5 * p[0], 1e-9);
}

static void given_cone_and_plane_when_marched_then_ellipse(void **state)
{
    const double normal[3] = {-0.5, 0, 1}, from[3] = {0, 0.5, 0};
    const crease_model a = given_plane(ORIGIN, normal);
    const crease_model b = given_model(CREASE_REGION_CONE, ORIGIN, Z, 0.5, 0.5);
    const crease_model *const models[2] = {&a, &b};
    assert_true(march(models, 0.01, from, on_cone) > 3);
}

static void on_cap(const double p[3])
{
    assert_near(hypot(p[0], p[1]), 0.8, 1e-9);
    assert_near(p[2], 0.6, 1e-9);
}

static void given_sphere_and_plane_when_marched_then_circle(void **state)
{
    const double place[3] = {0, 0, 0.6}, from[3] = {0.8, 0.1, 0.6};
    const crease_model a = given_model(CREASE_REGION_SPHERE, ORIGIN, Z, 1, 0);
    const crease_model b = given_plane(place, Z);
    const crease_model *const models[2] = {&a, &b};
    assert_near(march(models, 0.01, from, on_cap), 2 * acos(-1) * 0.8, 1e-4);
}

static void on_small_circle(const double p[3])
{
    assert_near(hypot(p[0], p[1]), 0.01, 1e-9);
}

static void given_circle_as_small_as_a_step_when_marched_then_steps_are_shorter(void **state)
{
    const double from[3] = {0.01, 0, 0};
    const crease_model a = given_plane(ORIGIN, Z);
    const crease_model b = given_model(CREASE_REGION_CYLINDER, ORIGIN, Z, 0.01, 0);
    const crease_model *const models[2] = {&a, &b};
    assert_near(march(models, 0.01, from, on_small_circle), 2 * acos(-1) * 0.01, 1e-3);
}

static void given_end_of_a_curve_when_stepped_then_nothing_changes(void **state)
{
    const double top[3] = {0, 0, 1}, normal[3] = {0, 0.01, 1};
    const crease_model a = given_plane(top, normal);
    const crease_model b = given_model(CREASE_REGION_SPHERE, ORIGIN, Z, 1, 0);
    const crease_model *const models[2] = {&a, &b};
    double at[3] = {0.3, 0.2, 0.9}, tangent[3] = {1, 0, 0};
    const double before[3] = {0.3, 0.2, 0.9};
    assert_false(crease_intersection_step(models, 0.01, at, tangent));
    assert_memory_equal(at, before, sizeof at);
    assert_true(tangent[0] == 1);
}

static void given_three_planes_when_met_then_their_corner(void **state)
{
    const double place[3] = {0.1, 0.2, 0.3};
    const crease_model planes[3] = {
        given_plane(place, X), given_plane(place, Y), given_plane(place, Z)};
    const crease_model *const models[3] = {&planes[0], &planes[1], &planes[2]};
    double at[3] = {0.15, 0.1, 0.35};
    assert_true(crease_intersection_meet(models, 3, 1, 1e-9, at));
    for (int c = 0; c < 3; c++)
        assert_near(at[c], place[c], 1e-12);
}

static void given_pyramids_when_met_then_their_apex(void **state)
{
    for (int sides = 4; sides <= 9; sides++) {
        const given_body body = given_pyramid(sides, 1);
        const crease_model *models[MOST_FACES];
        for (int i = 0; i < sides; i++)
            models[i] = &body.models[i];
        double at[3] = {0.1, -0.05, 0.45};
        assert_true(crease_intersection_meet(models, (size_t)sides, 1, 1e-9, at));
        assert_near(at[0], 0, 1e-12);
        assert_near(at[1], 0, 1e-12);
        assert_near(at[2], 0.5, 1e-12);
    }
}

static void given_cylinder_and_two_planes_when_met_then_on_all(void **state)
{
    const crease_model all[3] = {given_plane(ORIGIN, Z), given_plane(ORIGIN, Y),
        given_model(CREASE_REGION_CYLINDER, ORIGIN, Z, 1, 0)};
    const crease_model *const models[3] = {&all[0], &all[1], &all[2]};
    double at[3] = {0.9, 0.1, 0.1};
    assert_true(crease_intersection_meet(models, 3, 1, 1e-9, at));
    assert_near(at[0], 1, 1e-9);
    assert_near(at[1], 0, 1e-9);
    assert_near(at[2], 0, 1e-9);
}

static void given_parallel_planes_when_met_then_refused(void **state)
{
    const double high[3] = {0, 0, 1};
    const crease_model all[3] = {
        given_plane(ORIGIN, Z), given_plane(high, Z), given_plane(ORIGIN, Y)};
    const crease_model *const models[3] = {&all[0], &all[1], &all[2]};
    double at[3] = {0, 0, 0.2};
    assert_false(crease_intersection_meet(models, 3, 2, 0.1, at));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_two_planes_when_projected_then_on_their_line),
        cmocka_unit_test(given_nearly_parallel_planes_when_projected_then_refused),
        cmocka_unit_test(given_planes_that_meet_far_away_when_projected_then_refused),
        cmocka_unit_test(given_plane_tangent_to_cylinder_when_projected_then_refused),
        cmocka_unit_test(given_plane_across_cylinder_when_marched_then_circle),
        cmocka_unit_test(given_slanted_plane_when_marched_then_ellipse),
        cmocka_unit_test(given_two_cylinders_when_marched_then_ring_of_a_tee),
        cmocka_unit_test(given_cone_and_plane_when_marched_then_ellipse),
        cmocka_unit_test(given_sphere_and_plane_when_marched_then_circle),
        cmocka_unit_test(given_circle_as_small_as_a_step_when_marched_then_steps_are_shorter),
        cmocka_unit_test(given_end_of_a_curve_when_stepped_then_nothing_changes),
        cmocka_unit_test(given_three_planes_when_met_then_their_corner),
        cmocka_unit_test(given_pyramids_when_met_then_their_apex),
        cmocka_unit_test(given_cylinder_and_two_planes_when_met_then_on_all),
        cmocka_unit_test(given_parallel_planes_when_met_then_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
