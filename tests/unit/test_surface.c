/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "spline/knots.h"
#include "spline/surface.h"

static const crease_side RIGHT[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
static const crease_side LEFT_U[2] = {CREASE_SIDE_LEFT, CREASE_SIDE_RIGHT};

static double draw(uint64_t i)
{
    return crease_random_uniform(5, 0, i);
}

/* A surface of random control points around a grid; knots as given. */
static crease_surface *random_surface(
    crease_context *context, const int order[2], const size_t count[2], double *const knots[2])
{
    double points[3 * 400];
    for (size_t i = 0; i < count[0] * count[1]; i++) {
        points[3 * i] = (double)(i / count[1]) + draw(3 * i);
        points[3 * i + 1] = (double)(i % count[1]) + draw(3 * i + 1);
        points[3 * i + 2] = draw(3 * i + 2);
    }
    const crease_surface_parts parts = {.order = {order[0], order[1]},
        .count = {count[0], count[1]},
        .knots = {knots[0], knots[1]},
        .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    return surface;
}

/* Orders 4 x 3, one clamped and one uniform direction. */
static crease_surface *given_surface(crease_context *context)
{
    static double u[12], v[10];
    crease_knots_clamped(4, 8, 0.0, 5.0, u);
    crease_knots_uniform(3, 7, -1.0, 2.0, v);
    double *const knots[2] = {u, v};
    return random_surface(context, (int[2]){4, 3}, (size_t[2]){8, 7}, knots);
}

static void then_same_surface(const crease_surface *a, const crease_surface *b, double tolerance)
{
    double u[2], v[2];
    crease_surface_domain(a, 0, u);
    crease_surface_domain(a, 1, v);
    for (int i = 0; i <= 23; i++)
        for (int j = 0; j <= 17; j++) {
            const double uv[2] = {u[0] + (u[1] - u[0]) * i / 23, v[0] + (v[1] - v[0]) * j / 17};
            double one[12], two[12];
            crease_surface_evaluate(a, uv, RIGHT, 1, one);
            crease_surface_evaluate(b, uv, RIGHT, 1, two);
            for (int c = 0; c < 12; c++)
                assert_near(one[c], two[c], tolerance);
        }
}

static void given_a_surface_then_it_is_the_sum_of_equation_1(void **state)
{
    crease_context *context = given_context();
    const double knots[] = {0, 0, 0, 0, 1, 1, 1, 1};
    double points[48];
    for (int i = 0; i < 48; i++)
        points[i] = draw((uint64_t)i);
    const crease_surface_parts parts = {
        .order = {4, 4}, .count = {4, 4}, .knots = {knots, knots}, .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    const double u = 0.3, v = 0.8;
    const double in_u[4] = {pow(1 - u, 3), 3 * u * pow(1 - u, 2), 3 * u * u * (1 - u), u * u * u};
    const double in_v[4] = {pow(1 - v, 3), 3 * v * pow(1 - v, 2), 3 * v * v * (1 - v), v * v * v};
    double truth[3] = {0}, point[3];
    for (int i = 0; i < 16; i++)
        for (int c = 0; c < 3; c++)
            truth[c] += in_u[i / 4] * in_v[i % 4] * points[3 * i + c];
    crease_surface_point(surface, (const double[2]){u, v}, point);
    for (int c = 0; c < 3; c++)
        assert_near(point[c], truth[c], 1e-15);
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_a_surface_then_mixed_derivatives_are_those_of_differences(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    const double uv[2] = {2.4, 0.6}, h = 1e-5;
    double at[48], near[4][27];
    crease_surface_evaluate(surface, uv, RIGHT, 3, at);
    for (int i = 0; i < 4; i++) {
        const double moved[2] = {uv[0] +
                (i == 0          ? h
                        : i == 1 ? -h
                                 : 0),
            uv[1] +
                (i == 2          ? h
                        : i == 3 ? -h
                                 : 0)};
        crease_surface_evaluate(surface, moved, RIGHT, 2, near[i]);
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            for (int c = 0; c < 3; c++) {
                const int i = 3 * (3 * a + b) + c;
                const double in_u = (near[0][i] - near[1][i]) / (2 * h);
                const double in_v = (near[2][i] - near[3][i]) / (2 * h);
                assert_near(at[3 * (4 * (a + 1) + b) + c], in_u, 1e-8);
                assert_near(at[3 * (4 * a + b + 1) + c], in_v, 1e-8);
            }
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_a_point_outside_the_domain_then_the_border_is_taken(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    double inside[3], outside[3];
    crease_surface_point(surface, (const double[2]){5.0, -1.0}, inside);
    crease_surface_point(surface, (const double[2]){7.0, -3.0}, outside);
    assert_memory_equal(inside, outside, sizeof inside);
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_an_affine_map_of_the_net_then_the_surface_is_mapped(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    const double map[3][4] = {{0.3, -1, 2, 4}, {1, 1, 0.5, -2}, {0, 0.7, -0.2, 9}};
    crease_surface_parts parts = crease_surface_parts_of(surface);
    double points[3 * 56];
    for (size_t i = 0; i < 168; i++) {
        const double *const p = parts.control_points + i / 3 * 3;
        const double *const row = map[i % 3];
        points[i] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    }
    parts.control_points = points;
    crease_surface *mapped = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &mapped), CREASE_OK);
    for (int i = 0; i < 100; i++) {
        const double uv[2] = {i % 10 * 0.55, i / 10 * 0.33 - 1};
        double p[3], q[3];
        crease_surface_point(surface, uv, p);
        crease_surface_point(mapped, uv, q);
        for (int c = 0; c < 3; c++)
            assert_near(
                q[c], map[c][0] * p[0] + map[c][1] * p[1] + map[c][2] * p[2] + map[c][3], 1e-13);
    }
    crease_surface_free(surface);
    crease_surface_free(mapped);
    crease_context_free(context);
}

/* A plane over every supporting direction: no point of the surface lies beyond the net. */
static void given_any_direction_then_the_surface_stays_in_the_hull_of_its_net(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    for (uint64_t k = 0; k < 20; k++) {
        const double way[3] = {draw(900 + k) - 0.5, draw(930 + k) - 0.5, draw(960 + k) - 0.5};
        double most = -INFINITY;
        for (size_t i = 0; i < 56; i++) {
            const double *const p = parts.control_points + 3 * i;
            most = fmax(most, way[0] * p[0] + way[1] * p[1] + way[2] * p[2]);
        }
        for (int i = 0; i < 400; i++) {
            double p[3];
            crease_surface_point(
                surface, (const double[2]){i % 20 * 5.0 / 19, i / 20 * 3.0 / 19 - 1}, p);
            assert_true(way[0] * p[0] + way[1] * p[1] + way[2] * p[2] <= most + 1e-13);
        }
    }
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_insertion_or_clamping_then_the_surface_is_unchanged(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    for (int direction = 0; direction < 2; direction++)
        for (int times = 0; times <= 2; times++) {
            crease_surface *fine = NULL;
            const double t = direction == 0 ? 2.3 : crease_surface_parts_of(surface).knots[1][4];
            assert_int_equal(
                crease_surface_insert_knot(context, surface, direction, t, times, &fine),
                CREASE_OK);
            assert_int_equal(
                crease_surface_multiplicity(fine, direction, t), times + (direction == 0 ? 0 : 1));
            then_same_surface(surface, fine, 1e-13);
            crease_surface_free(fine);
        }
    crease_surface *clamped = NULL;
    assert_int_equal(crease_surface_clamp(context, surface, &clamped), CREASE_OK);
    assert_int_equal(crease_surface_multiplicity(clamped, 1, -1.0), 3);
    assert_int_equal(crease_surface_multiplicity(clamped, 1, 2.0), 3);
    assert_int_equal(crease_surface_parts_of(clamped).count[0], 8);
    assert_int_equal(crease_surface_parts_of(clamped).count[1], 7);
    then_same_surface(surface, clamped, 1e-13);
    crease_surface_free(clamped);
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_finer_knots_then_the_surface_is_unchanged(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    double knots[20];
    size_t count =
        crease_knots_raise(crease_surface_parts_of(surface).knots[0], 4, 8, 1.7, 2, knots);
    crease_knots_insert(4, count++, knots, 4.2, NULL);
    crease_surface *fine = NULL;
    assert_int_equal(crease_surface_refine(context, surface, 0, knots, count, &fine), CREASE_OK);
    assert_int_equal(crease_surface_parts_of(fine).count[0], 11);
    then_same_surface(surface, fine, 1e-13);
    crease_surface_free(fine);
    crease_surface_free(surface);
    crease_context_free(context);
}

/* The border control points of a row (direction 0: first or last row) of a surface. */
static const double *border(const crease_surface *surface, int direction, bool last, size_t i)
{
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    const size_t at = last ? parts.count[direction] - 1 : 0;
    return parts.control_points +
        3 * (direction == 0 ? at * parts.count[1] + i : i * parts.count[1] + at);
}

static void given_a_split_then_the_pieces_share_their_border_exactly(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    for (int direction = 0; direction < 2; direction++) {
        crease_surface *lower = NULL, *upper = NULL;
        const double t = direction == 0 ? 1.9 : 1.0;
        assert_int_equal(
            crease_surface_split(context, surface, direction, t, &lower, &upper), CREASE_OK);
        const crease_surface_parts parts = crease_surface_parts_of(lower);
        for (size_t i = 0; i < parts.count[1 - direction]; i++)
            assert_memory_equal(border(lower, direction, true, i),
                border(upper, direction, false, i), 3 * sizeof(double));
        for (int end = 0; end < 2; end++) {
            const crease_surface *const piece = end ? upper : lower;
            double domain[2];
            crease_surface_domain(piece, direction, domain);
            assert_true(domain[1 - end] == t);
            for (int d = 0; d < 2; d++)
                for (int e = 0; e < 2; e++) {
                    crease_surface_domain(piece, d, domain);
                    assert_int_equal(crease_surface_multiplicity(piece, d, domain[e]),
                        crease_surface_parts_of(piece).order[d]);
                }
        }
        for (int i = 0; i <= 20; i++)
            for (int j = 0; j <= 20; j++) {
                const double uv[2] = {i / 4.0, j * 0.15 - 1.0};
                double one[3], two[3];
                crease_surface_point(surface, uv, one);
                crease_surface_point(uv[direction] < t ? lower : upper, uv, two);
                for (int c = 0; c < 3; c++)
                    assert_near(one[c], two[c], 1e-13);
            }
        crease_surface_free(lower);
        crease_surface_free(upper);
    }
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_two_transpositions_then_nothing_has_changed(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    crease_surface *once = NULL, *twice = NULL;
    assert_int_equal(crease_surface_transpose(context, surface, &once), CREASE_OK);
    assert_int_equal(crease_surface_transpose(context, once, &twice), CREASE_OK);
    double a[3], b[3];
    crease_surface_point(surface, (const double[2]){1.2, 0.3}, a);
    crease_surface_point(once, (const double[2]){0.3, 1.2}, b);
    for (int c = 0; c < 3; c++)
        assert_near(a[c], b[c], 1e-14);
    const crease_surface_parts one = crease_surface_parts_of(surface);
    const crease_surface_parts two = crease_surface_parts_of(twice);
    assert_memory_equal(one.order, two.order, sizeof one.order);
    assert_memory_equal(one.count, two.count, sizeof one.count);
    assert_memory_equal(one.knots[0], two.knots[0], 12 * sizeof(double));
    assert_memory_equal(one.knots[1], two.knots[1], 10 * sizeof(double));
    assert_memory_equal(one.control_points, two.control_points, 168 * sizeof(double));
    crease_surface_free(surface);
    crease_surface_free(once);
    crease_surface_free(twice);
    crease_context_free(context);
}

static void given_a_parameter_then_the_isocurve_lies_in_the_surface(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    for (int direction = 0; direction < 2; direction++) {
        crease_curve *curve = NULL;
        assert_int_equal(
            crease_surface_isocurve(context, surface, direction, 1.3, CREASE_SIDE_RIGHT, &curve),
            CREASE_OK);
        double domain[2];
        crease_curve_domain(curve, domain);
        for (int i = 0; i <= 10; i++) {
            const double t = domain[0] + (domain[1] - domain[0]) * i / 10;
            const double uv[2] = {direction == 0 ? 1.3 : t, direction == 0 ? t : 1.3};
            double a[3], b[3];
            crease_surface_point(surface, uv, a);
            crease_curve_evaluate(curve, t, CREASE_SIDE_RIGHT, 0, b);
            for (int c = 0; c < 3; c++)
                assert_near(a[c], b[c], 1e-14);
        }
        crease_curve_free(curve);
    }
    crease_surface_free(surface);
    crease_context_free(context);
}

/* Largest jump of derivative number d in u over the knot line u = t. */
static double jump(const crease_surface *surface, double t, int d)
{
    double most = 0;
    for (int j = 0; j <= 10; j++) {
        double left[48], right[48];
        const double uv[2] = {t, j / 10.0};
        crease_surface_evaluate(surface, uv, LEFT_U, 3, left);
        crease_surface_evaluate(surface, uv, RIGHT, 3, right);
        for (int c = 0; c < 3; c++)
            most = fmax(most, fabs(left[12 * d + c] - right[12 * d + c]));
    }
    return most;
}

/* The paper: multiplicity alpha lowers continuity to C^(k - alpha - 1). */
static void given_a_knot_of_multiplicity_then_continuity_falls_as_the_paper_says(void **state)
{
    crease_context *context = given_context();
    for (int multiplicity = 1; multiplicity <= 3; multiplicity++) {
        double u[20], v[20], clamped[20];
        crease_knots_clamped(4, 6, 0.0, 1.0, clamped);
        const size_t count = crease_knots_raise(clamped, 4, 6, 0.45, multiplicity, u);
        crease_knots_clamped(4, 6, 0.0, 1.0, v);
        double *const knots[2] = {u, v};
        crease_surface *surface =
            random_surface(context, (int[2]){4, 4}, (size_t[2]){count, 6}, knots);
        for (int d = 0; d < 3; d++) {
            if (d <= 3 - multiplicity)
                assert_true(jump(surface, 0.45, d) < 1e-11);
            else
                assert_true(jump(surface, 0.45, d) > 0.1);
        }
        double left[12], right[12];
        crease_surface_evaluate(surface, (const double[2]){0.45, 0.5}, LEFT_U, 1, left);
        crease_surface_evaluate(surface, (const double[2]){0.45, 0.5}, RIGHT, 1, right);
        assert_true(fabs(left[6]) > 1e-2 && fabs(right[6]) > 1e-2);
        crease_surface_free(surface);
    }
    crease_context_free(context);
}

/* A roof whose ridge row of control points stands three times over uniform knots, as in Example 1:
 * 7 x 4 net from 5 x 4, heights |x| downwards. */
static crease_surface *given_repeated_row(crease_context *context)
{
    static const double x[7] = {-2, -1, 0, 0, 0, 1, 2};
    double points[84], u[11], v[8];
    for (size_t i = 0; i < 28; i++) {
        points[3 * i] = x[i / 4];
        points[3 * i + 1] = (double)(i % 4);
        points[3 * i + 2] = -fabs(x[i / 4]);
    }
    crease_knots_uniform(4, 7, 0.0, 4.0, u);
    crease_knots_uniform(4, 4, 0.0, 1.0, v);
    const crease_surface_parts parts = {
        .order = {4, 4}, .count = {7, 4}, .knots = {u, v}, .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    return surface;
}

static void given_a_row_three_times_then_the_parametrisation_is_smooth_and_the_shape_sharp(
    void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_repeated_row(context);
    for (int d = 0; d < 3; d++)
        assert_true(jump(surface, 2.0, d) < 1e-13);
    assert_true(jump(surface, 2.0, 3) > 0.1);
    double at[48];
    const double uv[2] = {2.0, 0.5};
    crease_surface_evaluate(surface, uv, RIGHT, 3, at);
    for (int c = 0; c < 3; c++) {
        assert_near(at[12 + c], 0.0, 1e-15);
        assert_near(at[24 + c], 0.0, 1e-15);
    }
    assert_near(at[0], 0.0, 1e-15);
    assert_near(at[2], 0.0, 1e-15);
    double left[3], right[3];
    crease_surface_normal(surface, uv, LEFT_U, left);
    crease_surface_normal(surface, uv, RIGHT, right);
    assert_near(left[0], -sqrt(0.5), 1e-12);
    assert_near(right[0], sqrt(0.5), 1e-12);
    assert_near(left[2], sqrt(0.5), 1e-12);
    assert_near(right[2], sqrt(0.5), 1e-12);
    assert_near(left[1], 0.0, 1e-12);
    crease_surface_free(surface);
    crease_context_free(context);
}

/* A cone-like patch: the border u = 0 is one point, so S_v vanishes there. */
static void given_a_collapsed_border_then_the_normal_is_the_limit(void **state)
{
    crease_context *context = given_context();
    const double line[] = {0, 0, 1, 1};
    const double points[] = {1e4, 0, 5, 1e4, 0, 5, 1e4 + 1, 0, 4, 1e4, 1, 4};
    const crease_surface_parts parts = {
        .order = {2, 2}, .count = {2, 2}, .knots = {line, line}, .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    double normal[3];
    crease_surface_normal(surface, (const double[2]){0, 0.5}, RIGHT, normal);
    for (int c = 0; c < 3; c++)
        assert_near(normal[c], sqrt(1.0 / 3.0), 1e-12);
    crease_surface_free(surface);
    const double collapsed[] = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
    const crease_surface_parts needle = {
        .order = {2, 2}, .count = {2, 2}, .knots = {line, line}, .control_points = collapsed};
    assert_int_equal(crease_surface_create(context, &needle, &surface), CREASE_OK);
    crease_surface_normal(surface, (const double[2]){0.5, 0.5}, RIGHT, normal);
    assert_true(normal[0] == 0.0 && normal[1] == 0.0 && normal[2] == 0.0);
    crease_surface_free(surface);
    crease_context_free(context);
}

static void given_a_curve_then_points_and_derivatives_are_right(void **state)
{
    crease_context *context = given_context();
    const double knots[] = {0, 0, 0, 2, 2, 2};
    const double points[] = {0, 0, 0, 1, 2, 0, 3, 0, 1};
    crease_curve *curve = NULL;
    assert_int_equal(crease_curve_create(context, 3, 3, knots, points, &curve), CREASE_OK);
    double at[12];
    crease_curve_evaluate(curve, 1.0, CREASE_SIDE_RIGHT, 3, at);
    const double truth[12] = {1.25, 1, 0.25, 1.5, 0, 0.5, 0.5, -2, 0.5, 0, 0, 0};
    for (int i = 0; i < 12; i++)
        assert_near(at[i], truth[i], 1e-14);
    assert_int_equal(crease_curve_order(curve), 3);
    assert_int_equal(crease_curve_count(curve), 3);
    assert_memory_equal(crease_curve_knots(curve), knots, sizeof knots);
    assert_memory_equal(crease_curve_control_points(curve), points, sizeof points);
    double domain[2];
    crease_curve_domain(curve, domain);
    assert_true(domain[0] == 0.0 && domain[1] == 2.0);
    crease_curve_free(curve);
    const double bad[] = {0, 0, 0, 1, NAN, 0, 3, 0, 1};
    assert_int_equal(crease_curve_create(context, 3, 3, knots, bad, &curve), CREASE_ERROR_ARGUMENT);
    assert_null(curve);
    assert_int_equal(
        crease_curve_create(context, 3, 3, knots, NULL, &curve), CREASE_ERROR_ARGUMENT);
    crease_context_free(context);
}

static void given_wrong_arguments_then_each_is_refused(void **state)
{
    crease_context *context = given_context();
    crease_surface *surface = given_surface(context);
    crease_surface *out = surface, *upper = surface;
    assert_int_equal(
        crease_surface_insert_knot(context, surface, 2, 1.0, 1, &out), CREASE_ERROR_ARGUMENT);
    assert_null(out);
    assert_int_equal(
        crease_surface_insert_knot(context, surface, 0, 5.1, 1, &out), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_surface_insert_knot(context, surface, 0, 5.0, 1, &out), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_surface_insert_knot(context, surface, 0, 1.0, 4, &out), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_surface_insert_knot(context, surface, 0, 1.0, -1, &out), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_surface_split(context, surface, 0, 5.0, &out, &upper), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_surface_split(context, surface, 0, NAN, &out, &upper), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_surface_split(context, surface, 5, 1.0, &out, &upper), CREASE_ERROR_ARGUMENT);
    assert_null(upper);
    crease_surface_parts parts = crease_surface_parts_of(surface);
    parts.control_points = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &out), CREASE_ERROR_ARGUMENT);
    parts = crease_surface_parts_of(surface);
    parts.count[1] = 2;
    assert_int_equal(crease_surface_create(context, &parts, &out), CREASE_ERROR_ARGUMENT);
    assert_null(out);
    crease_surface_free(surface);
    crease_context_free(context);
}

static crease_status use_everything(crease_context *context)
{
    crease_surface *surface = NULL, *fine = NULL, *lower = NULL, *upper = NULL;
    crease_curve *curve = NULL;
    const double knots[] = {0, 0, 1, 2, 2};
    const double points[27] = {0};
    const crease_surface_parts parts = {
        .order = {2, 2}, .count = {3, 3}, .knots = {knots, knots}, .control_points = points};
    crease_status status = crease_surface_create(context, &parts, &surface);
    if (status == CREASE_OK)
        status = crease_surface_transpose(context, surface, &fine);
    crease_surface_free(fine);
    if (status == CREASE_OK)
        status = crease_surface_refine(context, surface, 1, knots, 3, &fine);
    crease_surface_free(status == CREASE_OK ? fine : NULL);
    if (status == CREASE_OK)
        status = crease_surface_split(context, surface, 0, 0.5, &lower, &upper);
    if (status == CREASE_OK)
        status = crease_surface_isocurve(context, surface, 0, 0.5, CREASE_SIDE_LEFT, &curve);
    crease_surface_free(surface);
    crease_surface_free(lower);
    crease_surface_free(upper);
    crease_curve_free(curve);
    return status;
}

static void given_any_allocation_that_fails_then_no_memory_is_reported_and_none_lost(void **state)
{
    crease_context *context = given_context();
    int failures = 0;
    crease_context_fail_allocation(context, failures);
    while (use_everything(context) == CREASE_ERROR_NO_MEMORY)
        crease_context_fail_allocation(context, ++failures);
    assert_true(failures > 30);
    crease_context_fail_allocation(context, -1);
    assert_int_equal(use_everything(context), CREASE_OK);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_surface_then_it_is_the_sum_of_equation_1),
        cmocka_unit_test(given_a_surface_then_mixed_derivatives_are_those_of_differences),
        cmocka_unit_test(given_a_point_outside_the_domain_then_the_border_is_taken),
        cmocka_unit_test(given_an_affine_map_of_the_net_then_the_surface_is_mapped),
        cmocka_unit_test(given_any_direction_then_the_surface_stays_in_the_hull_of_its_net),
        cmocka_unit_test(given_insertion_or_clamping_then_the_surface_is_unchanged),
        cmocka_unit_test(given_finer_knots_then_the_surface_is_unchanged),
        cmocka_unit_test(given_a_split_then_the_pieces_share_their_border_exactly),
        cmocka_unit_test(given_two_transpositions_then_nothing_has_changed),
        cmocka_unit_test(given_a_parameter_then_the_isocurve_lies_in_the_surface),
        cmocka_unit_test(given_a_knot_of_multiplicity_then_continuity_falls_as_the_paper_says),
        cmocka_unit_test(
            given_a_row_three_times_then_the_parametrisation_is_smooth_and_the_shape_sharp),
        cmocka_unit_test(given_a_collapsed_border_then_the_normal_is_the_limit),
        cmocka_unit_test(given_a_curve_then_points_and_derivatives_are_right),
        cmocka_unit_test(given_wrong_arguments_then_each_is_refused),
        cmocka_unit_test(given_any_allocation_that_fails_then_no_memory_is_reported_and_none_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
