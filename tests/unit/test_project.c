/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "spline/knots.h"
#include "spline/project.h"
#include "spline/surface.h"

enum { MOST_POINTS = 4096 };

static const crease_side RIGHT[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};

static double draw(uint64_t stream, uint64_t i)
{
    return crease_random_uniform(21, stream, i);
}

typedef void height_field(double x, double y, double point[3]);

/* A clamped surface whose net is a function of the Greville abscissae over the unit square. */
static crease_surface *surface_of(
    crease_context *context, int order, size_t count, height_field *field)
{
    static double knots[128], greville[128], points[3 * 64 * 64];
    crease_knots_clamped(order, count, 0.0, 1.0, knots);
    crease_knots_greville(knots, order, count, greville);
    for (size_t i = 0; i < count * count; i++)
        field(greville[i / count], greville[i % count], points + 3 * i);
    const crease_surface_parts parts = {.order = {order, order},
        .count = {count, count},
        .knots = {knots, knots},
        .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    return surface;
}

static void plane(double x, double y, double point[3])
{
    point[0] = x;
    point[1] = y;
    point[2] = 0.5 * x;
}

static void waves(double x, double y, double point[3])
{
    point[0] = x + 0.02 * sin(40 * y);
    point[1] = y;
    point[2] = 0.25 * sin(9 * x) * cos(7 * y);
}

/* Squared distance by looking everywhere, then more closely where it was least. */
static double look_everywhere(const crease_surface *surface, const double place[3])
{
    double low[2] = {0, 0}, high[2] = {1, 1}, best = INFINITY;
    for (int round = 0; round < 4; round++) {
        double at[2] = {0, 0};
        for (int i = 0; i <= 60 * 61 + 60; i++) {
            const double uv[2] = {low[0] + (high[0] - low[0]) * (i / 61) / 60,
                low[1] + (high[1] - low[1]) * (i % 61) / 60};
            double p[3], squared = 0;
            crease_surface_point(surface, uv, p);
            for (int c = 0; c < 3; c++)
                squared += (p[c] - place[c]) * (p[c] - place[c]);
            if (squared < best) {
                best = squared;
                at[0] = uv[0];
                at[1] = uv[1];
            }
        }
        for (int d = 0; d < 2; d++) {
            const double half = (high[d] - low[d]) / 30;
            low[d] = fmax(at[d] - half, 0.0);
            high[d] = fmin(at[d] + half, 1.0);
        }
    }
    return sqrt(best);
}

static void given_a_plane_then_feet_and_signs_are_exact(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 4, 9, plane);
    double places[3 * 500];
    crease_foot feet[500];
    for (uint64_t i = 0; i < 500; i++) {
        const double x = draw(0, i), y = draw(1, i), height = 2 * draw(2, i) - 1;
        places[3 * i] = x - 0.5 * height;
        places[3 * i + 1] = y;
        places[3 * i + 2] = 0.5 * x + height;
    }
    assert_int_equal(crease_surface_project(context, surface, places, 500, feet), CREASE_OK);
    for (uint64_t i = 0; i < 500; i++) {
        assert_near(feet[i].point[0], draw(0, i), 1e-14);
        assert_near(feet[i].point[1], draw(1, i), 1e-14);
        assert_near(feet[i].distance, (2 * draw(2, i) - 1) * sqrt(1.25), 1e-14);
    }
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_places_beside_a_plane_then_feet_lie_on_its_border(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 4, 9, plane);
    const double places[6] = {0.5, -2.0, 0.25, 3.0, 1.5, 1.5};
    crease_foot feet[2];
    assert_int_equal(crease_surface_project(context, surface, places, 2, feet), CREASE_OK);
    assert_near(feet[0].point[0], 0.5, 1e-14);
    assert_true(feet[0].uv[1] == 0.0);
    assert_near(feet[0].distance, 2.0, 1e-14);
    assert_true(feet[1].uv[0] == 1.0 && feet[1].uv[1] == 1.0);
    assert_near(feet[1].point[2], 0.5, 1e-15);
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_any_place_then_nothing_on_the_surface_is_nearer(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 4, 20, waves);
    enum { COUNT = 60 };
    double places[3 * COUNT];
    crease_foot feet[COUNT];
    for (uint64_t i = 0; i < COUNT; i++) {
        places[3 * i] = 1.4 * draw(3, i) - 0.2;
        places[3 * i + 1] = 1.4 * draw(4, i) - 0.2;
        places[3 * i + 2] = 2 * draw(5, i) - 1;
    }
    assert_int_equal(crease_surface_project(context, surface, places, COUNT, feet), CREASE_OK);
    for (size_t i = 0; i < COUNT; i++) {
        const double truth = look_everywhere(surface, places + 3 * i);
        assert_true(fabs(feet[i].distance) <= truth + 1e-12);
        assert_near(fabs(feet[i].distance), truth, 1e-3);
        double p[3];
        crease_surface_point(surface, feet[i].uv, p);
        assert_memory_equal(p, feet[i].point, sizeof p);
    }
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_places_at_a_height_above_a_surface_then_they_come_back(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 5, 24, waves);
    enum { COUNT = 2000 };
    static double places[3 * COUNT];
    static crease_foot feet[COUNT];
    for (uint64_t i = 0; i < COUNT; i++) {
        const double uv[2] = {draw(6, i), draw(7, i)};
        double p[3], normal[3];
        crease_surface_point(surface, uv, p);
        crease_surface_normal(surface, uv, RIGHT, normal);
        for (int c = 0; c < 3; c++)
            places[3 * i + (size_t)c] =
                p[c] + (i % 3 ? 0.02 * (draw(8, i) - 0.5) : 0.0) * normal[c];
    }
    assert_int_equal(crease_surface_project(context, surface, places, COUNT, feet), CREASE_OK);
    for (uint64_t i = 0; i < COUNT; i++) {
        assert_near(feet[i].uv[0], draw(6, i), 1e-12);
        assert_near(feet[i].uv[1], draw(7, i), 1e-12);
        assert_near(feet[i].distance, i % 3 ? 0.02 * (draw(8, i) - 0.5) : 0.0, 1e-14);
    }
    crease_surface_free(surface);
    crease_context_free(context);
}

/* A roof over x with its ridge along y at x = 0, sloping at `slope`; the ridge is a knot of
 * multiplicity 3 or a control row that stands three times over uniform knots. */
static crease_surface *roof(crease_context *context, double slope, bool knots_repeat)
{
    static const double with_knots[9] = {-1, -0.7, -0.3, 0, 0.3, 0.7, 1, 0, 0};
    static const double with_rows[9] = {-3, -2, -1, 0, 0, 0, 1, 2, 3};
    const size_t rows = knots_repeat ? 7 : 9;
    double u[16], v[8], points[3 * 9 * 4];
    for (size_t i = 0; i < 4 * rows; i++) {
        const double x = knots_repeat ? with_knots[i / 4] : with_rows[i / 4];
        points[3 * i] = x;
        points[3 * i + 1] = (double)(i % 4) - 1.5;
        points[3 * i + 2] = -slope * fabs(x);
    }
    if (knots_repeat) {
        const double creased[11] = {-1, -1, -1, -1, 0, 0, 0, 1, 1, 1, 1};
        memcpy(u, creased, sizeof creased);
    } else {
        crease_knots_uniform(4, 9, -3.0, 3.0, u);
    }
    crease_knots_clamped(4, 4, 0.0, 1.0, v);
    const crease_surface_parts parts = {
        .order = {4, 4}, .count = {rows, 4}, .knots = {u, v}, .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    return surface;
}

/* Outside a ridge the foot is the ridge itself; so sharp a roof has faces whose own normals point
 * away from half of these places. */
static void given_places_outside_a_ridge_then_feet_lie_on_it(void **state)
{
    crease_context *context = given_context();
    for (int kind = 0; kind < 4; kind++) {
        const double slope = kind / 2 ? 8.0 : 1.0;
        crease_surface *surface = roof(context, slope, kind % 2);
        enum { COUNT = 41 };
        double places[3 * COUNT];
        crease_foot feet[COUNT];
        for (int i = 0; i < COUNT; i++) {
            const double most = atan(slope) - 0.01;
            const double angle = most * (i - COUNT / 2) / (COUNT / 2);
            places[3 * i] = 0.3 * sin(angle);
            places[3 * i + 1] = 0.02 * i - 0.4;
            places[3 * i + 2] = 0.3 * cos(angle);
        }
        assert_int_equal(crease_surface_project(context, surface, places, COUNT, feet), CREASE_OK);
        for (int i = 0; i < COUNT; i++) {
            assert_true(feet[i].uv[0] == 0.0);
            assert_near(feet[i].point[0], 0.0, 1e-15);
            assert_near(feet[i].point[1], places[3 * i + 1], 1e-13);
            assert_near(feet[i].distance, 0.3, 1e-14);
        }
        crease_surface_free(surface);
    }
    crease_context_free(context);
}

static void given_places_inside_a_roof_then_the_nearer_face_is_found(void **state)
{
    crease_context *context = given_context();
    for (int kind = 0; kind < 2; kind++) {
        crease_surface *surface = roof(context, 1.0, kind);
        const double places[6] = {0.02, 0, -0.4, -0.01, 0.3, -0.4};
        crease_foot feet[2];
        assert_int_equal(crease_surface_project(context, surface, places, 2, feet), CREASE_OK);
        assert_near(feet[0].distance, -0.38 * sqrt(0.5), 1e-13);
        assert_near(feet[1].distance, -0.39 * sqrt(0.5), 1e-13);
        assert_near(feet[0].point[0], 0.21, 1e-12);
        assert_near(feet[1].point[0], -0.205, 1e-12);
        crease_surface_free(surface);
    }
    crease_context_free(context);
}

static void quarter_pipe(double x, double y, double point[3])
{
    point[0] = cos(x * acos(0.0));
    point[1] = 2 * y;
    point[2] = sin(x * acos(0.0));
}

static void given_a_near_cylinder_then_its_axis_is_at_the_radius(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 6, 40, quarter_pipe);
    double places[3 * 20];
    crease_foot feet[20];
    for (int i = 0; i < 20; i++) {
        places[3 * i] = places[3 * i + 2] = 0.0;
        places[3 * i + 1] = 0.1 * i;
    }
    assert_int_equal(crease_surface_project(context, surface, places, 20, feet), CREASE_OK);
    for (int i = 0; i < 20; i++) {
        assert_near(fabs(feet[i].distance), 1.0, 3e-3);
        assert_near(feet[i].point[1], places[3 * i + 1], 1e-6);
        assert_near(fabs(feet[i].distance), look_everywhere(surface, places + 3 * i), 1e-9);
    }
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_places_around_a_sphere_then_the_foot_is_radial(void **state)
{
    crease_context *context = given_context();
    enum { SIDE = 24, COUNT = 300 };
    /* a cubic interpolating nothing, but close to an octant of the unit sphere */
    double knots[SIDE + 4], greville[SIDE], net[3 * SIDE * SIDE];
    crease_knots_clamped(4, SIDE, 0.1, 1.4, knots);
    crease_knots_greville(knots, 4, SIDE, greville);
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        const double a = greville[i / SIDE], b = greville[i % SIDE];
        net[3 * i] = cos(a) * cos(b);
        net[3 * i + 1] = cos(a) * sin(b);
        net[3 * i + 2] = sin(a);
    }
    const crease_surface_parts parts = {
        .order = {4, 4}, .count = {SIDE, SIDE}, .knots = {knots, knots}, .control_points = net};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    double places[3 * COUNT];
    crease_foot feet[COUNT];
    for (uint64_t i = 0; i < COUNT; i++) {
        const double a = 0.2 + 1.1 * draw(9, i), b = 0.2 + 1.1 * draw(10, i);
        const double r = 0.3 + 2 * draw(11, i);
        places[3 * i] = r * cos(a) * cos(b);
        places[3 * i + 1] = r * cos(a) * sin(b);
        places[3 * i + 2] = r * sin(a);
    }
    assert_int_equal(crease_surface_project(context, surface, places, COUNT, feet), CREASE_OK);
    for (uint64_t i = 0; i < COUNT; i++) {
        const double r = 0.3 + 2 * draw(11, i);
        assert_near(fabs(feet[i].distance), fabs(r - 1), 2e-3);
        assert_true(fabs(r - 1) < 3e-3 || (feet[i].distance < 0) == (r > 1));
        for (size_t c = 0; c < 3; c++)
            assert_near(feet[i].point[c], places[3 * i + c] / r, 2e-2);
    }
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_a_curve_then_the_nearest_of_its_points_is_found(void **state)
{
    crease_context *context = given_context();
    enum { COUNT = 14, PLACES = 50 };
    double knots[COUNT + 4], points[3 * COUNT], places[3 * PLACES];
    crease_foot feet[PLACES];
    crease_knots_clamped(4, COUNT, 0.0, 1.0, knots);
    for (size_t i = 0; i < 3 * COUNT; i++)
        points[i] = draw(12, i) + (i % 3 == 0 ? (double)i / 30 : 0);
    for (size_t i = 0; i < 3 * PLACES; i++)
        places[i] = 2 * draw(13, i) - 0.5;
    crease_curve *curve = NULL;
    assert_int_equal(crease_curve_create(context, 4, COUNT, knots, points, &curve), CREASE_OK);
    assert_int_equal(crease_curve_project(context, curve, places, PLACES, feet), CREASE_OK);
    for (size_t i = 0; i < PLACES; i++) {
        double truth = INFINITY;
        for (int k = 0; k <= 20000; k++) {
            double p[3], squared = 0;
            crease_curve_evaluate(curve, k / 20000.0, CREASE_SIDE_RIGHT, 0, p);
            for (size_t c = 0; c < 3; c++)
                squared += (p[c] - places[3 * i + c]) * (p[c] - places[3 * i + c]);
            truth = fmin(truth, sqrt(squared));
        }
        assert_true(feet[i].distance <= truth + 1e-13);
        assert_near(feet[i].distance, truth, 1e-6);
        assert_true(feet[i].uv[1] == 0.0);
    }
    crease_curve_free(curve);
    crease_context_free(context);
}

static void given_any_number_of_threads_then_feet_are_the_same_bytes(void **state)
{
    static double places[3 * MOST_POINTS];
    static crease_foot feet[2][MOST_POINTS];
    for (size_t i = 0; i < 3 * MOST_POINTS; i++)
        places[i] = draw(14, i);
    for (int threads = 1; threads <= 4; threads++) {
        crease_context *context = given_context_with_threads(threads);
        crease_surface *surface = surface_of(context, 4, 12, waves);
        assert_int_equal(
            crease_surface_project(context, surface, places, MOST_POINTS, feet[threads > 1]),
            CREASE_OK);
        if (threads > 1)
            assert_memory_equal(feet[0], feet[1], sizeof feet[0]);
        crease_surface_free(surface);
        crease_context_free(context);
    }
}

static void given_hostile_input_then_it_is_refused_or_survived(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = surface_of(context, 4, 5, plane);
    crease_foot foot;
    const double not_finite[3] = {0, NAN, 0};
    assert_int_equal(
        crease_surface_project(context, surface, not_finite, 1, &foot), CREASE_ERROR_VALUE);
    const double far[3] = {1e200, 0, 0};
    assert_int_equal(crease_surface_project(context, surface, far, 1, &foot), CREASE_OK);
    assert_int_equal(crease_surface_project(context, surface, far, 0, NULL), CREASE_OK);
    const double place[3] = {0.5, 0.5, 0.5};
    int failures = 0;
    crease_context_fail_allocation(context, failures);
    while (crease_surface_project(context, surface, place, 1, &foot) == CREASE_ERROR_NO_MEMORY)
        crease_context_fail_allocation(context, ++failures);
    assert_int_equal(failures, 6);
    crease_surface_free(surface);
    crease_context_free(context);
}

/* All control points in one place: nothing to choose, nothing to divide by. */
static void given_a_surface_that_is_a_point_then_that_point_is_the_foot(void **state)
{
    crease_context *context = given_context();
    const double knots[] = {0, 0, 0, 0, 1, 1, 1, 1};
    const double points[48] = {0};
    const crease_surface_parts parts = {
        .order = {4, 4}, .count = {4, 4}, .knots = {knots, knots}, .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    const double places[6] = {3, 4, 0, 0, 0, 0};
    crease_foot feet[2];
    assert_int_equal(crease_surface_project(context, surface, places, 2, feet), CREASE_OK);
    assert_near(feet[0].distance, 5.0, 1e-15);
    assert_near(feet[1].distance, 0.0, 0.0);
    crease_surface_free(surface);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_plane_then_feet_and_signs_are_exact),
        cmocka_unit_test(given_places_beside_a_plane_then_feet_lie_on_its_border),
        cmocka_unit_test(given_any_place_then_nothing_on_the_surface_is_nearer),
        cmocka_unit_test(given_places_at_a_height_above_a_surface_then_they_come_back),
        cmocka_unit_test(given_places_outside_a_ridge_then_feet_lie_on_it),
        cmocka_unit_test(given_places_inside_a_roof_then_the_nearer_face_is_found),
        cmocka_unit_test(given_a_near_cylinder_then_its_axis_is_at_the_radius),
        cmocka_unit_test(given_places_around_a_sphere_then_the_foot_is_radial),
        cmocka_unit_test(given_a_curve_then_the_nearest_of_its_points_is_found),
        cmocka_unit_test(given_any_number_of_threads_then_feet_are_the_same_bytes),
        cmocka_unit_test(given_hostile_input_then_it_is_refused_or_survived),
        cmocka_unit_test(given_a_surface_that_is_a_point_then_that_point_is_the_foot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
