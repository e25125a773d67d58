/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "spline/basis.h"
#include "spline/knots.h"

enum { MOST_COUNT = 40, MOST_KNOTS = 80 };

static double draw(uint64_t stream, uint64_t i)
{
    return crease_random_uniform(11, stream, i);
}

/* A knot vector with random steps, some of them zero, never more than `order` equal knots. */
static void random_knots(uint64_t stream, int order, size_t count, double *knots)
{
    double at = -1.0;
    int equal = 1;
    for (size_t i = 0; i < count + (size_t)order; i++) {
        const bool repeat = i > 0 && equal < order - 1 && draw(stream, 2 * i) < 0.4;
        equal = repeat ? equal + 1 : 1;
        at += repeat ? 0.0 : 0.05 + draw(stream, 2 * i + 1);
        knots[i] = at;
    }
}

static void given_any_order_and_knots_then_functions_add_up_to_one(void **state)
{
    for (int order = 1; order <= CREASE_ORDER_MAX; order++) {
        const size_t count = (size_t)order + 9;
        double knots[MOST_KNOTS], values[CREASE_ORDER_MAX];
        random_knots((uint64_t)order, order, count, knots);
        const double first = knots[order - 1];
        const double last = knots[count];
        for (int i = 0; i <= 200; i++) {
            const double t =
                crease_basis_clamp(knots, order, count, first + (last - first) * i / 200.0);
            const size_t span = crease_basis_span(knots, order, count, t, CREASE_SIDE_RIGHT);
            assert_true(knots[span] <= t && t <= knots[span + 1] && knots[span] < knots[span + 1]);
            crease_basis_values(knots, order, span, t, values);
            double sum = 0;
            for (int r = 0; r < order; r++) {
                assert_true(values[r] >= 0.0);
                sum += values[r];
            }
            assert_near(sum, 1.0, 1e-14);
        }
    }
}

/* The span's functions are polynomials, so central differences inside it converge. */
static void given_any_order_then_derivatives_are_those_of_differences(void **state)
{
    for (int order = 2; order <= 8; order++) {
        const size_t count = (size_t)order + 6;
        double knots[MOST_KNOTS];
        random_knots(100 + (uint64_t)order, order, count, knots);
        const double t = 0.5 * (knots[order - 1] + knots[count]);
        const size_t span = crease_basis_span(knots, order, count, t, CREASE_SIDE_RIGHT);
        double exact[5 * CREASE_ORDER_MAX], low[5 * CREASE_ORDER_MAX], high[5 * CREASE_ORDER_MAX];
        const double h = 1e-5;
        crease_basis_derivatives(knots, order, span, t, 4, exact);
        crease_basis_derivatives(knots, order, span, t - h, 3, low);
        crease_basis_derivatives(knots, order, span, t + h, 3, high);
        for (int i = 0; i < 4 * order; i++) {
            const double size = 1.0 + fabs(exact[i + order]) + 1e3 * fabs(exact[i]);
            assert_near(exact[i + order], (high[i] - low[i]) / (2 * h), 1e-5 * size);
        }
    }
}

/* Marsden's identity: the polar form of t^degree gives its control points. */
static void given_a_power_then_its_derivatives_come_out_exactly(void **state)
{
    for (int order = 1; order <= 9; order++) {
        const size_t count = (size_t)order + 7;
        double knots[MOST_KNOTS], points[MOST_COUNT];
        random_knots(200 + (uint64_t)order, order, count, knots);
        for (size_t i = 0; i < count; i++) {
            points[i] = 1.0;
            for (size_t r = 1; r < (size_t)order; r++)
                points[i] *= knots[i + r];
        }
        for (int sample = 0; sample < 20; sample++) {
            const double t = knots[order - 1] + (knots[count] - knots[order - 1]) * sample / 19.0;
            double basis[CREASE_ORDER_MAX * CREASE_ORDER_MAX];
            const crease_side side = sample % 2 ? CREASE_SIDE_LEFT : CREASE_SIDE_RIGHT;
            const size_t span = crease_basis_span(knots, order, count, t, side);
            crease_basis_derivatives(knots, order, span, t, order, basis);
            double factor = 1.0;
            for (int d = 0; d <= order; d++) {
                double sum = 0, size = 1.0;
                for (int r = 0; r < order; r++) {
                    const double part =
                        basis[d * order + r] * points[span + 1 - (size_t)order + (size_t)r];
                    sum += part;
                    size += fabs(part);
                }
                const double truth = d < order ? factor * pow(t, order - 1 - d) : 0.0;
                assert_near(sum, truth, 1e-13 * size);
                factor *= order - 1 - d;
            }
        }
    }
}

static void given_a_knot_then_the_side_chooses_the_span(void **state)
{
    const double knots[] = {0, 0, 0, 0, 1, 1, 1, 2, 3, 3, 3, 3};
    assert_int_equal(crease_basis_span(knots, 4, 8, 1.0, CREASE_SIDE_RIGHT), 6);
    assert_int_equal(crease_basis_span(knots, 4, 8, 1.0, CREASE_SIDE_LEFT), 3);
    assert_int_equal(crease_basis_span(knots, 4, 8, 0.0, CREASE_SIDE_LEFT), 3);
    assert_int_equal(crease_basis_span(knots, 4, 8, 3.0, CREASE_SIDE_RIGHT), 7);
    assert_int_equal(crease_basis_span(knots, 4, 8, -9.0, CREASE_SIDE_RIGHT), 3);
    assert_int_equal(crease_basis_span(knots, 4, 8, 9.0, CREASE_SIDE_LEFT), 7);
    assert_int_equal(crease_basis_span(knots, 4, 8, 2.5, CREASE_SIDE_LEFT), 7);
}

/* N_i over the knots read backwards is the mirror image. */
static void given_knots_reversed_then_functions_are_mirrored(void **state)
{
    enum { ORDER = 5, COUNT = 12 };
    double knots[MOST_KNOTS], mirrored[MOST_KNOTS], values[ORDER], others[ORDER];
    random_knots(300, ORDER, COUNT, knots);
    for (size_t i = 0; i < COUNT + ORDER; i++)
        mirrored[i] = -knots[COUNT + ORDER - 1 - i];
    for (int i = 1; i < 50; i++) {
        const double t = knots[ORDER - 1] + (knots[COUNT] - knots[ORDER - 1]) * i / 50.0;
        const size_t span = crease_basis_span(knots, ORDER, COUNT, t, CREASE_SIDE_RIGHT);
        const size_t other = crease_basis_span(mirrored, ORDER, COUNT, -t, CREASE_SIDE_LEFT);
        crease_basis_values(knots, ORDER, span, t, values);
        crease_basis_values(mirrored, ORDER, other, -t, others);
        for (int r = 0; r < ORDER; r++)
            assert_near(values[r], others[ORDER - 1 - r], 1e-14);
    }
}

static void given_wrong_knots_then_a_sentence_says_which(void **state)
{
    crease_context *context = given_context();
    const double falling[] = {0, 0, 1, 0.5, 2, 2};
    const double repeated[] = {0, 0, 1, 1, 1, 2, 2};
    const double empty[] = {0, 1, 1, 2};
    const double infinite[] = {0, 0, 1, INFINITY};
    const double fine[] = {0, 0, 1, 1};
    assert_int_equal(crease_knots_check(context, "c", 2, 4, falling), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "knot 3"));
    assert_int_equal(crease_knots_check(context, "c", 2, 5, repeated), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "more than 2 times"));
    assert_int_equal(crease_knots_check(context, "c", 2, 2, empty), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_knots_check(context, "c", 2, 2, infinite), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_knots_check(context, "c", 0, 2, fine), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_knots_check(context, "c", 17, 40, fine), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_knots_check(context, "c", 4, 3, fine), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_knots_check(context, "c", 2, 2, NULL), CREASE_ERROR_ARGUMENT);
    assert_int_equal(crease_knots_check(context, "c", 2, 2, fine), CREASE_OK);
    crease_context_free(context);
}

static void given_uniform_and_clamped_knots_then_the_domain_is_exact(void **state)
{
    double knots[MOST_KNOTS], greville[MOST_COUNT];
    crease_knots_uniform(4, 9, 0.1, 0.7, knots);
    assert_true(knots[3] == 0.1 && knots[9] == 0.7);
    for (int i = 1; i < 13; i++)
        assert_near(knots[i] - knots[i - 1], 0.1, 1e-15);
    crease_knots_clamped(4, 9, 0.1, 0.7, knots);
    assert_int_equal(crease_knots_multiplicity(knots, 13, 0.1), 4);
    assert_int_equal(crease_knots_multiplicity(knots, 13, 0.7), 4);
    assert_int_equal(crease_knots_multiplicity(knots, 13, 0.123), 0);
    crease_knots_greville(knots, 4, 9, greville);
    assert_near(greville[0], 0.1, 1e-15);
    assert_near(greville[1], 0.1 + 0.1 / 3, 1e-15);
    assert_near(greville[8], 0.7, 1e-15);
}

/* Value of a scalar spline. */
static double value(int order, size_t count, const double *knots, const double *points, double t)
{
    double basis[CREASE_ORDER_MAX];
    const size_t span = crease_basis_span(knots, order, count, t, CREASE_SIDE_RIGHT);
    crease_basis_values(knots, order, span, t, basis);
    double sum = 0;
    for (size_t r = 0; r < (size_t)order; r++)
        sum += basis[r] * points[span + 1 - (size_t)order + r];
    return sum;
}

static void given_knots_inserted_one_by_one_or_at_once_then_the_spline_is_the_same(void **state)
{
    for (int order = 1; order <= 8; order++) {
        size_t count = (size_t)order + 5;
        double knots[MOST_KNOTS], fine[MOST_KNOTS], points[MOST_COUNT], boehm[MOST_COUNT];
        random_knots(400 + (uint64_t)order, order, count, knots);
        for (size_t i = 0; i < count; i++)
            boehm[i] = points[i] = draw(401, i);
        memcpy(fine, knots, sizeof knots);
        size_t fine_count = count;
        const crease_rows rows = {1, MOST_COUNT, 1, boehm};
        for (uint64_t i = 0; i < 6; i++) {
            const double t =
                knots[order - 1] + (knots[count] - knots[order - 1]) * draw(402, i / 2 + 10);
            const int present = crease_knots_multiplicity(fine, fine_count + (size_t)order, t);
            if (present < order)
                crease_knots_insert(order, fine_count++, fine, t, &rows);
        }
        size_t first[MOST_COUNT];
        double weights[MOST_COUNT * CREASE_ORDER_MAX];
        crease_knots_prolong(order, knots, count, fine, fine_count, first, weights);
        for (size_t i = 0; i < fine_count; i++) {
            double oslo = 0, sum = 0;
            for (size_t r = 0; r < (size_t)order; r++) {
                oslo += weights[i * (size_t)order + r] * points[first[i] + r];
                sum += weights[i * (size_t)order + r];
            }
            const bool reaches =
                fine[i + 1] < knots[count] && fine[i + (size_t)order - 1] > knots[order - 1];
            const bool within =
                fine[i + 1] >= knots[order - 1] && fine[i + (size_t)order - 1] <= knots[count];
            if (reaches)
                assert_near(oslo, boehm[i], within ? 1e-14 : 1e-10);
            if (within)
                assert_near(sum, 1.0, 1e-14);
        }
        for (int i = 0; i < 60; i++) {
            const double t = knots[order - 1] + (knots[count] - knots[order - 1]) * (i + 0.5) / 60;
            assert_near(value(order, count, knots, points, t),
                value(order, fine_count, fine, boehm, t), 1e-14);
        }
    }
}

static void given_a_multiplicity_then_a_knot_is_raised_to_it(void **state)
{
    double knots[MOST_KNOTS], raised[MOST_KNOTS];
    crease_knots_clamped(4, 7, 0.0, 1.0, knots);
    assert_int_equal(crease_knots_raise(knots, 4, 7, 0.25, 3, raised), 9);
    assert_int_equal(crease_knots_multiplicity(raised, 13, 0.25), 3);
    assert_int_equal(crease_knots_raise(knots, 4, 7, 0.3, 3, raised), 10);
    assert_int_equal(crease_knots_multiplicity(raised, 14, 0.3), 3);
    assert_int_equal(crease_knots_raise(knots, 4, 7, 0.0, 3, raised), 7);
    crease_context *context = given_context();
    assert_int_equal(crease_knots_check(context, "raised", 4, 7, raised), CREASE_OK);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_any_order_and_knots_then_functions_add_up_to_one),
        cmocka_unit_test(given_any_order_then_derivatives_are_those_of_differences),
        cmocka_unit_test(given_a_power_then_its_derivatives_come_out_exactly),
        cmocka_unit_test(given_a_knot_then_the_side_chooses_the_span),
        cmocka_unit_test(given_knots_reversed_then_functions_are_mirrored),
        cmocka_unit_test(given_wrong_knots_then_a_sentence_says_which),
        cmocka_unit_test(given_uniform_and_clamped_knots_then_the_domain_is_exact),
        cmocka_unit_test(given_knots_inserted_one_by_one_or_at_once_then_the_spline_is_the_same),
        cmocka_unit_test(given_a_multiplicity_then_a_knot_is_raised_to_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
