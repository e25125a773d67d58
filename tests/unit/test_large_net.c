/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The normal equations of nets with many control points, and what solves them. */
#include "given.h"

#include "base/memory.h"
#include "base/random.h"
#include "net/level.h"
#include "net/system.h"

#include <stdlib.h>

static crease_context *given_threads(int threads)
{
    crease_context_options options = crease_context_options_default();
    options.threads = threads;
    crease_context *context = NULL;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    return context;
}

/* A net over the unit square; a crease at 0.4 along the first direction when asked for. */
static crease_height given_net(
    crease_context *context, int order, size_t rows, size_t columns, bool crease)
{
    crease_layout layout = {.order = order,
        .axis = {
            {.low = 0, .high = 1, .line_count = crease, .lines = {0.4}}, {.low = 0, .high = 1}}};
    layout.axis[0].smooth = rows - crease_layout_count(&layout, 0);
    layout.axis[1].smooth = columns - crease_layout_count(&layout, 1);
    crease_height height;
    assert_int_equal(crease_height_create(context, &layout, &height), CREASE_OK);
    assert_int_equal(height.count[0], rows);
    return height;
}

typedef struct data {
    double *uv, *weight, *target;
    crease_observations seen;
} data;

static double cubic(double x, double y)
{
    return 0.3 + x * x * x - 2 * x * y * y + 0.5 * y + (x > 0.4 ? (x - 0.4) * (1 + y) : 0);
}

static data given_data(size_t count, size_t sides, double noise)
{
    data d = {calloc(count, 16), calloc(count, 8), calloc(count, 8 * sides), {0}};
    assert_true(d.uv && d.weight && d.target);
    for (size_t i = 0; i < count; i++) {
        for (size_t c = 0; c < 2; c++)
            d.uv[2 * i + c] = crease_random_uniform(5, c, i);
        d.weight[i] = i % 7 ? 0.5 + crease_random_uniform(5, 2, i) : 0.0;
        for (size_t s = 0; s < sides; s++)
            d.target[i * sides + s] = (1.0 + (double)s) * cubic(d.uv[2 * i], d.uv[2 * i + 1]) +
                noise * crease_random_normal(5, 3 + s, i);
    }
    d.seen = (crease_observations){
        .count = count, .sides = sides, .uv = d.uv, .weight = d.weight, .target = d.target};
    return d;
}

static void release(data *d)
{
    free(d->uv);
    free(d->weight);
    free(d->target);
}

static crease_gaps given_no_gaps(double spacing)
{
    crease_gaps gaps = {.count = {1, 1}, .step = {1, 1}, .spacing = spacing};
    gaps.near = calloc(1, sizeof *gaps.near);
    assert_non_null(gaps.near);
    gaps.near[0] = true;
    return gaps;
}

/* All values of the basis at a place, most of them zero. */
static void values_at(const crease_height *h, const double *uv, double *out)
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    crease_support s;
    memset(out, 0, h->count[0] * h->count[1] * sizeof *out);
    crease_height_support(h, uv, sides, 0, &s);
    for (size_t a = 0; a < (size_t)h->order; a++)
        for (size_t b = 0; b < (size_t)h->order; b++)
            out[(s.first[0] + a) * h->count[1] + s.first[1] + b] = s.values[0][a] * s.values[1][b];
}

static void given_points_then_the_sum_is_that_of_every_point(void **state)
{
    enum { POINTS = 400, ROWS = 12, COLUMNS = 9, SIZE = ROWS * COLUMNS };
    crease_context *context = given_context();
    for (int order = 2; order <= 5; order++) {
        crease_height h = given_net(context, order, ROWS, COLUMNS, true);
        data d = given_data(POINTS, 2, 0.1);
        crease_stencil normal;
        double right[2 * SIZE] = {0}, truth[2 * SIZE] = {0}, x[SIZE], y[SIZE], image[SIZE] = {0};
        assert_int_equal(crease_stencil_create(context, order, h.count, &normal), CREASE_OK);
        assert_int_equal(crease_assemble(context, &h, &d.seen, &normal, right), CREASE_OK);
        for (size_t i = 0; i < SIZE; i++)
            x[i] = crease_random_normal(6, 0, i);
        for (size_t i = 0; i < POINTS; i++) {
            double basis[SIZE], f = 0;
            values_at(&h, d.uv + 2 * i, basis);
            for (size_t k = 0; k < SIZE; k++)
                f += basis[k] * x[k];
            for (size_t k = 0; k < SIZE; k++) {
                image[k] += d.weight[i] * basis[k] * f;
                for (size_t s = 0; s < 2; s++)
                    truth[s * SIZE + k] += d.weight[i] * basis[k] * d.target[2 * i + s];
            }
        }
        assert_int_equal(crease_stencil_multiply(context, &normal, x, y), CREASE_OK);
        for (size_t k = 0; k < SIZE; k++)
            assert_near(y[k], image[k], 1e-11);
        for (size_t k = 0; k < 2 * SIZE; k++)
            assert_near(right[k], truth[k], 1e-11);
        crease_stencil_free(&normal);
        crease_height_free(&h);
        release(&d);
    }
    crease_context_free(context);
}

static void given_points_in_two_pieces_then_the_sum_is_the_same(void **state)
{
    enum { POINTS = 3000, SIDE = 20, SIZE = SIDE * SIDE };
    crease_context *context = given_context();
    crease_height h = given_net(context, 4, SIDE, SIDE, false);
    data d = given_data(POINTS, 1, 0.1);
    crease_stencil whole, pieces;
    static double right[2][SIZE];
    assert_int_equal(crease_stencil_create(context, 4, h.count, &whole), CREASE_OK);
    assert_int_equal(crease_stencil_create(context, 4, h.count, &pieces), CREASE_OK);
    assert_int_equal(crease_assemble(context, &h, &d.seen, &whole, right[0]), CREASE_OK);
    crease_observations first = d.seen, second = d.seen;
    first.count = 1000, second.count -= 1000;
    second.uv += 2000, second.weight += 1000, second.target += 1000;
    assert_int_equal(crease_assemble(context, &h, &first, &pieces, right[1]), CREASE_OK);
    assert_int_equal(crease_assemble(context, &h, &second, &pieces, right[1]), CREASE_OK);
    for (size_t i = 0; i < whole.count[0] * whole.count[1] * whole.width; i++)
        assert_near(pieces.values[i], whole.values[i], 1e-12);
    for (size_t i = 0; i < SIZE; i++)
        assert_near(right[1][i], right[0][i], 1e-12);
    crease_stencil_free(&whole);
    crease_stencil_free(&pieces);
    crease_height_free(&h);
    release(&d);
    crease_context_free(context);
}

/* x^T P^T A P y = (P x)^T A (P y), P y being the same spline over more knots. */
static void given_a_coarser_net_then_its_matrix_is_that_of_the_same_points(void **state)
{
    enum { POINTS = 2000 };
    crease_context *context = given_context();
    crease_height h = given_net(context, 4, 23, 18, true);
    crease_gaps gaps = given_no_gaps(0.02);
    data d = given_data(POINTS, 1, 0.1);
    crease_level fine, coarse;
    crease_stencil normal, again;
    bool coarser;
    assert_int_equal(crease_level_create(context, &h, &gaps, &fine), CREASE_OK);
    assert_int_equal(crease_level_coarser(context, &fine, &gaps, &coarse, &coarser), CREASE_OK);
    assert_true(coarser && coarse.count[0] < 17 && coarse.count[1] < 13);
    double *right = calloc(fine.size + coarse.size, sizeof *right);
    assert_non_null(right);
    assert_int_equal(crease_stencil_create(context, 4, fine.count, &normal), CREASE_OK);
    assert_int_equal(crease_stencil_create(context, 4, coarse.count, &again), CREASE_OK);
    assert_int_equal(crease_assemble(context, &h, &d.seen, &normal, right), CREASE_OK);
    assert_int_equal(
        crease_assemble(context, &coarse.height, &d.seen, &again, right + fine.size), CREASE_OK);
    fine.normal = &normal;
    assert_int_equal(crease_level_carry(context, &fine, &coarse), CREASE_OK);
    for (size_t i = 0; i < again.count[0] * again.count[1] * again.width; i++)
        assert_near(coarse.own.values[i], again.values[i], 1e-11);
    crease_level_restrict(&fine, &coarse, right);
    for (size_t i = 0; i < coarse.size; i++)
        assert_near(coarse.b[i], right[fine.size + i], 1e-11);
    crease_stencil_free(&normal);
    crease_stencil_free(&again);
    crease_level_free(&fine);
    crease_level_free(&coarse);
    crease_gaps_free(&gaps);
    crease_height_free(&h);
    release(&d);
    free(right);
    crease_context_free(context);
}

typedef struct outcome {
    crease_height height;
    crease_system system;
} outcome;

static outcome when_solved(
    crease_context *context, crease_height height, const data *d, double spacing, double lambda)
{
    outcome out = {.height = height};
    crease_gaps gaps = given_no_gaps(spacing);
    bool solvable = false;
    assert_int_equal(crease_system_create(context, &out.height, 1, &gaps, &out.system), CREASE_OK);
    assert_int_equal(crease_system_add(context, &out.system, &out.height, &d->seen), CREASE_OK);
    assert_int_equal(crease_system_factor(context, &out.system, lambda, &solvable), CREASE_OK);
    assert_true(solvable);
    assert_int_equal(crease_system_solve(context, &out.system, out.height.coefficients), CREASE_OK);
    return out;
}

static void release_outcome(outcome *o)
{
    crease_system_free(&o->system);
    crease_height_free(&o->height);
}

static double rms(const crease_height *h, const data *d)
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    double sum = 0, all = 0;
    for (size_t i = 0; i < d->seen.count; i++) {
        double f[3];
        crease_height_at(h, d->uv + 2 * i, sides, 0, f);
        sum += d->weight[i] * pow(f[0] - d->target[i], 2);
        all += d->weight[i];
    }
    return sqrt(sum / all);
}

static void given_creased_cubic_data_then_a_large_net_is_exact(void **state)
{
    crease_context *context = given_context();
    data d = given_data(30000, 1, 0);
    outcome o = when_solved(context, given_net(context, 4, 110, 80, true), &d, 0.006, 1e-13);
    assert_non_null(o.system.multigrid);
    assert_true(rms(&o.height, &d) < 1e-9);
    release_outcome(&o);
    release(&d);
    crease_context_free(context);
}

/* The same least-squares problem by elimination, in one band, as a truth. */
static void given_noisy_data_then_iterations_reach_the_least_sum_of_squares(void **state)
{
    crease_context *context = given_context();
    data d = given_data(30000, 1, 0.05);
    outcome iterated = when_solved(context, given_net(context, 4, 110, 80, true), &d, 0.006, 1e-7);
    assert_non_null(iterated.system.multigrid);
    const crease_system *const s = &iterated.system;
    crease_stencil whole;
    const size_t stride[2] = {80, 1}, width = 3 * 80 + 4;
    double *band = calloc(s->size * width, sizeof *band), *x = calloc(s->size, sizeof *x);
    assert_true(band && x);
    assert_int_equal(crease_stencil_create(context, 4, s->count, &whole), CREASE_OK);
    crease_stencil_copy(&s->normal, &whole);
    const double share = 1e-7 * crease_stencil_trace(&s->normal) / s->traces[0];
    assert_int_equal(crease_bending_add(context, &s->energy, share, 0, &whole), CREASE_OK);
    crease_stencil_band(&whole, stride, width, band);
    memcpy(x, s->right, s->size * sizeof *x);
    for (size_t j = 0; j < s->size; j++) { /* Cholesky, column by column */
        double *const column = band + j * width;
        const size_t below = s->size - j < width ? s->size - j : width;
        const double pivot = sqrt(column[0]);
        assert_true(pivot > 0);
        for (size_t i = 0; i < below; i++)
            column[i] /= pivot;
        x[j] /= column[0];
        for (size_t i = 1; i < below; i++) {
            x[j + i] -= column[i] * x[j];
            for (size_t k = i; k < below && column[i] != 0; k++)
                band[(j + i) * width + k - i] -= column[i] * column[k];
        }
    }
    for (size_t j = s->size; j-- > 0;) {
        for (size_t i = 1; i < width && j + i < s->size; i++)
            x[j] -= band[j * width + i] * x[j + i];
        x[j] /= band[j * width];
    }
    const double found = rms(&iterated.height, &d);
    memcpy(iterated.height.coefficients, x, s->size * sizeof *x);
    /* iterations stop by the penalised sum, of which this is the larger part */
    assert_near(found, rms(&iterated.height, &d), 1e-4 * found);
    crease_stencil_free(&whole);
    free(band);
    free(x);
    release_outcome(&iterated);
    release(&d);
    crease_context_free(context);
}

static void given_any_number_of_threads_then_the_bytes_are_the_same(void **state)
{
    data d = given_data(15000, 1, 0.05);
    double *first = NULL;
    for (int threads = 1; threads <= 3; threads += 2) {
        crease_context *context = given_threads(threads);
        outcome o = when_solved(context, given_net(context, 4, 90, 100, true), &d, 0.008, 1e-6);
        double freedom;
        assert_int_equal(crease_system_freedom(context, &o.system, &freedom), CREASE_OK);
        assert_true(freedom > 100 && freedom < (double)o.system.size);
        o.height.coefficients[0] += freedom;
        const size_t bytes = o.system.size * sizeof *first;
        if (first)
            assert_memory_equal(first, o.height.coefficients, bytes);
        else
            first = crease_duplicate(context, o.height.coefficients, o.system.size, sizeof *first);
        assert_non_null(first);
        release_outcome(&o);
        crease_context_free(context);
    }
    free(first);
    release(&d);
}

/* Four control points for each point: between these the sheet stays among them. */
static void given_fewer_points_than_control_points_then_the_sheet_stays_within_them(void **state)
{
    enum { POINTS = 5000, SIDE = 150 };
    crease_context *context = given_context();
    data d = given_data(POINTS, 1, 0);
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < POINTS; i++) {
        d.weight[i] = 1;
        d.target[i] = -fabs(d.uv[2 * i] - 0.3 + 0.4 * (d.uv[2 * i + 1] - 0.5));
        low = fmin(low, d.target[i]);
        high = fmax(high, d.target[i]);
    }
    outcome o = when_solved(context, given_net(context, 4, SIDE, SIDE, false), &d, 0.014, 1e-9);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        assert_true(o.height.coefficients[i] > low - 0.2 * (high - low) &&
            o.height.coefficients[i] < high + 0.2 * (high - low));
    release_outcome(&o);
    release(&d);
    crease_context_free(context);
}

static void given_a_failing_allocation_then_the_system_says_so(void **state)
{
    crease_context *context = given_context();
    crease_height h = given_net(context, 4, 100, 100, true);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; status != CREASE_OK && n < 1000; n++) {
        crease_gaps gaps = given_no_gaps(0.01);
        crease_system system;
        crease_context_fail_allocation(context, n);
        status = crease_system_create(context, &h, 1, &gaps, &system);
        crease_context_fail_allocation(context, -1);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
        crease_system_free(&system);
    }
    assert_true(n > 50 && n < 1000);
    crease_height_free(&h);
    crease_context_free(context);
}

/* A roof along no axis in 160 x 160 control points: the crease stays sharp and exact. */
static void given_a_large_net_for_a_sheet_then_its_crease_is_exact(void **state)
{
    enum { POINTS = 6000 };
    crease_context *context = given_context();
    static double points[POINTS][3];
    for (size_t i = 0; i < POINTS; i++) {
        points[i][0] = crease_random_uniform(8, 0, i) - 0.5;
        points[i][1] = crease_random_uniform(8, 1, i) - 0.5;
        points[i][2] = -fabs(0.9396926207859084 * points[i][0] + 0.3420201433256687 * points[i][1]);
    }
    const crease_cloud_parts parts = {
        .count = POINTS, .points = points[0], .coordinate_type = CREASE_TYPE_FLOAT64};
    crease_cloud *cloud = NULL;
    crease_sheet *sheet = NULL;
    crease_sheet_options options = crease_sheet_options_default();
    options.net[0] = options.net[1] = 100;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    assert_int_equal(crease_sheet_fit(context, cloud, &options, &sheet), CREASE_OK);
    assert_int_equal(crease_surface_parts_of(crease_sheet_surface(sheet)).count[0], 100);
    assert_int_equal(crease_surface_parts_of(crease_sheet_surface(sheet)).count[1], 100);
    assert_int_equal(crease_sheet_line_count(sheet), 1);
    for (size_t i = 0; i < POINTS; i++)
        assert_true(fabs(crease_sheet_deviations(sheet)[i]) < 1e-6); /* corners pull a little */
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_points_then_the_sum_is_that_of_every_point),
        cmocka_unit_test(given_points_in_two_pieces_then_the_sum_is_the_same),
        cmocka_unit_test(given_a_coarser_net_then_its_matrix_is_that_of_the_same_points),
        cmocka_unit_test(given_creased_cubic_data_then_a_large_net_is_exact),
        cmocka_unit_test(given_noisy_data_then_iterations_reach_the_least_sum_of_squares),
        cmocka_unit_test(given_any_number_of_threads_then_the_bytes_are_the_same),
        cmocka_unit_test(given_fewer_points_than_control_points_then_the_sheet_stays_within_them),
        cmocka_unit_test(given_a_failing_allocation_then_the_system_says_so),
        cmocka_unit_test(given_a_large_net_for_a_sheet_then_its_crease_is_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
