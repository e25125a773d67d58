/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "detect/bootstrap.h"
#include "detect/eigen.h"
#include "detect/scores.h"
#include "detect/standardise.h"

/* ------------------------------------------------------------------------------- the oracle -- */

/* Eigenvalues on the diagonal of a, eigenvectors in the columns of v, by Jacobi's rotations. */
static void jacobi(double a[3][3], double v[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            v[i][j] = i == j;
    for (int sweep = 0; sweep < 60; sweep++) {
        const int p = sweep % 3 == 2, q = sweep % 3 == 0 ? 1 : 2;
        if (a[p][q] == 0)
            continue;
        const double angle = 0.5 * atan2(2 * a[p][q], a[q][q] - a[p][p]);
        const double c = cos(angle), s = sin(angle);
        for (int i = 0; i < 3; i++) {
            const double x = a[i][p], y = a[i][q];
            a[i][p] = c * x - s * y, a[i][q] = s * x + c * y;
        }
        for (int i = 0; i < 3; i++) {
            const double x = a[p][i], y = a[q][i];
            a[p][i] = c * x - s * y, a[q][i] = s * x + c * y;
            const double left = v[i][p], right = v[i][q];
            v[i][p] = c * left - s * right, v[i][q] = s * left + c * right;
        }
    }
}

static void smallest(double a[3][3], double normal[3], double values[3])
{
    double v[3][3];
    jacobi(a, v);
    int least = 0;
    for (int i = 0; i < 3; i++) {
        values[i] = a[i][i];
        least = a[i][i] < a[least][least] ? i : least;
    }
    for (int i = 0; i < 3; i++)
        normal[i] = v[i][least];
}

/* Normal of count points by principal components; false when they lie on a line. */
static bool plain_normal(const double (*points)[3], size_t count, double normal[3])
{
    double mean[3] = {0}, a[3][3] = {{0}}, values[3];
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++)
            mean[axis] += points[i][axis] / (double)count;
    for (size_t i = 0; i < count; i++)
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                a[r][c] += (points[i][r] - mean[r]) * (points[i][c] - mean[c]);
    smallest(a, normal, values);
    const double most = fmax(values[0], fmax(values[1], values[2]));
    const double sum = values[0] + values[1] + values[2];
    const double least = fmin(values[0], fmin(values[1], values[2]));
    return sum - most - least > 1e-9 * most;
}

/* Eq. 4 as it stands, with other random numbers. */
static double plain_variance(const double (*points)[3], size_t k, size_t resamples)
{
    double own[3], sum[3] = {0}, squares = 0;
    double(*drawn)[3] = malloc(k * sizeof *drawn);
    assert_true(plain_normal(points, k, own));
    for (uint64_t b = 0, draw = 0; b < resamples;) {
        double n[3];
        for (size_t i = 0; i < k; i++)
            memcpy(drawn[i], points[(size_t)(crease_random_uniform(99, 5, draw++) * (double)k)],
                sizeof drawn[i]);
        if (!plain_normal((const double(*)[3])drawn, k, n))
            continue;
        const double sign = n[0] * own[0] + n[1] * own[1] + n[2] * own[2] < 0 ? -1 : 1;
        for (int axis = 0; axis < 3; axis++)
            sum[axis] += sign * n[axis];
        squares += 1;
        b++;
    }
    free(drawn);
    const double b = (double)resamples;
    return (squares - (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / b) / (b - 1);
}

/* ------------------------------------------------------------------------------- the clouds -- */

typedef void maker(size_t i, double point[3]);

static double draw(size_t i, uint64_t stream)
{
    return crease_random_uniform(3, stream, i);
}

/* The surface of the unit cube. */
static void cube(size_t i, double point[3])
{
    const size_t face = i % 6, axis = face / 2;
    point[axis] = (double)(face % 2);
    point[(axis + 1) % 3] = draw(i, 1);
    point[(axis + 2) % 3] = draw(i, 2);
}

static void flat(size_t i, double point[3])
{
    point[0] = draw(i, 1), point[1] = draw(i, 2), point[2] = 0.125;
}

static void oblique(size_t i, double point[3])
{
    const double u = draw(i, 1), v = draw(i, 2);
    point[0] = 0.6 * u - 0.48 * v + 3, point[1] = 0.8 * u + 0.36 * v, point[2] = 0.8 * v - 2;
}

static void plane_lattice(size_t i, double point[3])
{
    point[0] = (double)(i % 20), point[1] = (double)(i / 20), point[2] = 0;
}

static void noisy_plane(size_t i, double point[3])
{
    flat(i, point);
    point[2] += 0.002 * crease_random_normal(3, 4, i);
}

static void wave(size_t i, double point[3])
{
    flat(i, point);
    point[2] = 0.1 * sin(6 * point[0]) + 0.001 * crease_random_normal(3, 4, i);
}

static void turned(size_t i, double point[3])
{
    double p[3];
    wave(i, p);
    point[0] = 0.6 * p[0] - 0.48 * p[1] + 0.64 * p[2];
    point[1] = 0.8 * p[0] + 0.36 * p[1] - 0.48 * p[2];
    point[2] = 0.8 * p[1] + 0.6 * p[2];
}

static void small(size_t i, double point[3])
{
    wave(i, point);
    for (int axis = 0; axis < 3; axis++)
        point[axis] *= 0x1p-30;
}

static void doubled(size_t i, double point[3])
{
    wave(i / 3, point);
}

static void equal(size_t i, double point[3])
{
    point[0] = point[1] = point[2] = 0.1;
}

static void line(size_t i, double point[3])
{
    for (int axis = 0; axis < 3; axis++)
        point[axis] = (double)(i * (size_t)(axis + 1)) / 8;
}

static crease_cloud *given_cloud(crease_context *context, maker *make, size_t count)
{
    double *points = malloc(count * 3 * sizeof *points);
    for (size_t i = 0; i < count; i++)
        make(i, points + 3 * i);
    crease_cloud *cloud = given_cloud_of(context, points, count);
    free(points);
    return cloud;
}

static crease_scores *given_scores(maker *make, size_t count, int k, int resamples, int threads)
{
    crease_context *context = given_context_with_threads(threads);
    crease_cloud *cloud = given_cloud(context, make, count);
    crease_detect_options options = crease_detect_options_default();
    options.neighbours = k;
    options.resamples = resamples;
    crease_scores *scores = NULL;
    assert_int_equal(crease_scores_compute(context, cloud, &options, &scores), CREASE_OK);
    assert_int_equal(crease_scores_count(scores), count);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return scores;
}

/* ----------------------------------------------------------------------------------- tests -- */

static void assert_smallest(double a[3][3], double tolerance)
{
    crease_matrices matrices;
    crease_directions found;
    memset(&matrices, 0, sizeof matrices);
    matrices.xx[5] = a[0][0], matrices.xy[5] = a[0][1], matrices.xz[5] = a[0][2];
    matrices.yy[5] = a[1][1], matrices.yz[5] = a[1][2], matrices.zz[5] = a[2][2];
    crease_eigen_smallest(&matrices, 6, &found);
    const double v[3] = {found.x[5], found.y[5], found.z[5]};
    double diagonal[3][3], normal[3], values[3];
    memcpy(diagonal, a, sizeof diagonal);
    smallest(diagonal, normal, values);
    const double least = fmin(values[0], fmin(values[1], values[2]));
    const double trace = values[0] + values[1] + values[2];
    assert_near(v[0] * v[0] + v[1] * v[1] + v[2] * v[2], 1, 1e-14);
    for (int i = 0; i < 3; i++)
        assert_near(
            a[i][0] * v[0] + a[i][1] * v[1] + a[i][2] * v[2], least * v[i], tolerance * trace);
}

/* A = R diag(values) R' for a rotation R made of three angles. */
static void given_matrix(const double values[3], uint64_t number, double a[3][3])
{
    double r[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int axis = 0; axis < 3; axis++) {
        const double angle = 6.3 * crease_random_uniform(1, number, (uint64_t)axis);
        const int p = axis, q = (axis + 1) % 3;
        for (int i = 0; i < 3; i++) {
            const double x = r[i][p], y = r[i][q];
            r[i][p] = cos(angle) * x - sin(angle) * y;
            r[i][q] = sin(angle) * x + cos(angle) * y;
        }
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            a[i][j] = 0;
            for (int m = 0; m < 3; m++)
                a[i][j] += r[i][m] * values[m] * r[j][m];
        }
}

static void given_any_eigenvalues_then_the_vector_of_the_smallest_is_found(void **state)
{
    const double cases[][3] = {{0, 1, 1}, {0, 1, 2}, {1e-3, 1, 3}, {1, 2, 3}, {0.9, 1, 1.1},
        {0.99, 1, 5}, {0.999999, 1, 5}, {1, 1, 5}, {1, 1, 1}, {0, 0, 1}, {0, 1e-6, 1},
        {1e-12, 1e-6, 1}, {5e8, 7e8, 8e8}, {0, 3e-200, 5e-200}, {0, 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (uint64_t number = 0; number < 200; number++) {
            double a[3][3];
            given_matrix(cases[i], number, a);
            assert_smallest(a, cases[i][1] - cases[i][0] > 0.2 * cases[i][2] ? 1e-13 : 1e-7);
        }
}

static void given_diagonal_matrices_then_an_axis_is_found_exactly(void **state)
{
    for (int axis = 0; axis < 3; axis++) {
        double a[3][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
        a[axis][axis] = 0;
        crease_matrices matrices;
        memset(&matrices, 0, sizeof matrices);
        matrices.xx[0] = a[0][0], matrices.yy[0] = a[1][1], matrices.zz[0] = a[2][2];
        crease_directions found;
        crease_eigen_smallest(&matrices, 1, &found);
        const double v[3] = {found.x[0], found.y[0], found.z[0]};
        for (int i = 0; i < 3; i++)
            assert_true(fabs(v[i]) == (i == axis));
        assert_near(found.spread[0], 0.25, 1e-15);
    }
}

static void given_numbers_then_mean_and_variance_are_eq_3_and_4(void **state)
{
    const double x[] = {1, 2, 3, 6}, y[] = {0, 0, 4, 4};
    const double *const values[] = {x, y};
    double mean[2];
    crease_bootstrap_mean(values, 2, 4, mean);
    assert_near(mean[0], 3, 1e-15);
    assert_near(mean[1], 2, 1e-15);
    assert_near(crease_bootstrap_variance(values, 1, 4, mean), 14.0 / 3, 1e-15);
    assert_near(crease_bootstrap_variance(values, 2, 4, mean), 30.0 / 3, 1e-14);
}

/* The bootstrap variance of a mean is known: the plain variance (1 / k) over k. */
static void given_the_mean_as_statistic_then_its_variance_is_that_of_the_textbook(void **state)
{
    enum { RESAMPLES = 40000 };
    double *means = malloc(RESAMPLES * sizeof *means);
    uint32_t words[CREASE_MOST_WORDS];
    uint8_t members[256];
    for (int k = 5; k <= 256; k = 3 * k + 1) {
        for (uint64_t b = 0; b < RESAMPLES; b++) {
            crease_bootstrap_draw(17, 4, b, 1, k, words);
            crease_bootstrap_members(words, k, members);
            means[b] = 0;
            for (int i = 0; i < k; i++)
                means[b] += (double)members[i] * members[i] / k;
        }
        double mean, centre = 0, spread = 0;
        const double *const values[] = {means};
        crease_bootstrap_mean(values, 1, RESAMPLES, &mean);
        for (int i = 0; i < k; i++)
            centre += (double)i * i / k;
        for (int i = 0; i < k; i++)
            spread += (i * i - centre) * (i * i - centre) / k;
        assert_near(mean / centre, 1, 0.02);
        assert_near(crease_bootstrap_variance(values, 1, RESAMPLES, &mean) / (spread / k), 1, 0.05);
    }
    free(means);
}

static void given_any_sample_size_then_members_are_uniform(void **state)
{
    enum { RESAMPLES = 3000 };
    uint32_t words[CREASE_MOST_WORDS];
    uint8_t members[256];
    for (int k = 1; k <= 256; k++) {
        double counts[256] = {0}, chi_squared = 0;
        const uint64_t resamples = RESAMPLES / (uint64_t)k + 20;
        assert_true(crease_bootstrap_words(k) <= CREASE_MOST_WORDS);
        for (uint64_t b = 0; b < resamples; b++) {
            crease_bootstrap_draw(2, 8, b, 1, k, words);
            crease_bootstrap_members(words, k, members);
            for (int i = 0; i < k; i++) {
                assert_true(members[i] < k);
                counts[members[i]]++;
            }
        }
        for (int i = 0; i < k; i++)
            chi_squared += (counts[i] - (double)resamples) * (counts[i] - (double)resamples);
        assert_in_range(chi_squared / (double)resamples, 0, k + 6 * sqrt(2 * k) + 6);
    }
}

static void given_resamples_drawn_together_then_they_are_those_drawn_alone(void **state)
{
    uint32_t together[10 * CREASE_MOST_WORDS], alone[CREASE_MOST_WORDS];
    for (int k = 4; k <= 256; k += 63) {
        const size_t words = crease_bootstrap_words(k);
        crease_bootstrap_draw(2, 8, 30, 10, k, together);
        for (size_t b = 0; b < 10; b++) {
            crease_bootstrap_draw(2, 8, 30 + b, 1, k, alone);
            assert_memory_equal(alone, together + b * words, words * sizeof *alone);
        }
    }
}

/* Distance of a point on the cube's surface to the nearest edge. */
static double edge_distance(const double point[3])
{
    double most = 0, away[3], sum = 0;
    for (int axis = 0; axis < 3; axis++) {
        away[axis] = fmin(point[axis], 1 - point[axis]);
        sum += away[axis];
        most = fmax(most, away[axis]);
    }
    return sum - most;
}

static void given_a_cube_then_edges_stand_out_and_faces_are_flat(void **state)
{
    enum { COUNT = 12000 };
    crease_scores *scores = given_scores(cube, COUNT, 16, 100, 2);
    size_t near = 0, missed = 0, far = 0, wrong = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double point[3];
        cube(i, point);
        const double away = edge_distance(point);
        const double variance = crease_scores_variance(scores)[i];
        const bool feature = crease_scores_features(scores)[i];
        assert_in_range(feature, 0, 1);
        if (away > 0.12) {
            const size_t axis = i % 6 / 2;
            far++, wrong += feature;
            assert_true(variance < 1e-25);
            assert_near(fabs(crease_scores_normals(scores)[3 * i + axis]), 1, 1e-12);
        } else if (away < 0.002) {
            near++, missed += !feature;
            assert_true(variance > 1e-3);
        }
    }
    assert_true(near > 80 && far > 5000);
    assert_int_equal(wrong, 0);
    assert_true(missed < near / 4);
    crease_scores_free(scores);
}

static double largest(const crease_scores *scores)
{
    double most = 0;
    for (size_t i = 0; i < crease_scores_count(scores); i++)
        most = fmax(most, crease_scores_variance(scores)[i]);
    return most;
}

static size_t features(const crease_scores *scores)
{
    size_t found = 0;
    for (size_t i = 0; i < crease_scores_count(scores); i++)
        found += crease_scores_features(scores)[i];
    return found;
}

static void given_a_perfect_plane_then_the_variance_is_zero(void **state)
{
    const struct {
        maker *make;
        double most;
    } cases[] = {{flat, 0}, {plane_lattice, 0}, {oblique, 0}};
    for (int k = 4; k <= 64; k *= 4)
        for (size_t i = 0; i < 3; i++) {
            crease_scores *scores = given_scores(cases[i].make, 400, k, 50, 2);
            assert_true(largest(scores) <= cases[i].most);
            assert_int_equal(features(scores), 0);
            crease_scores_free(scores);
        }
}

static void given_noise_on_a_smooth_surface_then_few_points_are_features(void **state)
{
    enum { COUNT = 8000 };
    crease_scores *plane = given_scores(noisy_plane, COUNT, 16, 100, 2);
    crease_scores *curved = given_scores(wave, COUNT, 16, 100, 2);
    assert_true(largest(plane) > 1e-4);
    assert_true(features(plane) < COUNT / 200);
    assert_true(features(curved) < COUNT / 100);
    crease_scores_free(plane);
    crease_scores_free(curved);
}

/* A closed half-cylinder: flat and curved ground without noise, and edges between them. */
static void half_cylinder(size_t i, double point[3])
{
    const double angle = 3.14159265358979 * draw(i, 1), radius = i % 3 ? 1 : sqrt(draw(i, 3));
    point[0] = radius * cos(angle), point[1] = radius * sin(angle);
    point[2] = i % 3 ? 2 * draw(i, 2) : i % 6 ? 0 : 2;
}

static void given_flat_and_curved_ground_then_only_edges_are_features(void **state)
{
    enum { COUNT = 15000 };
    crease_scores *scores = given_scores(half_cylinder, COUNT, 16, 100, 2);
    size_t near = 0, found = 0, far = 0, wrong = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double p[3];
        half_cylinder(i, p);
        const double height = fmin(p[2], 2 - p[2]), away = 1 - sqrt(p[0] * p[0] + p[1] * p[1]);
        const double open = fabs(p[1]); /* where the sheet ends */
        if (open > 0.2 && fmax(height, away) > 0.2)
            far++, wrong += crease_scores_features(scores)[i];
        if (open > 0.2 && fmax(height, away) < 0.004)
            near++, found += crease_scores_features(scores)[i];
    }
    assert_true(far > 5000 && wrong < far / 100);
    assert_true(near > 20 && found * 4 > near * 3);
    crease_scores_free(scores);
}

static void given_a_rotated_cloud_then_the_variance_is_the_same(void **state)
{
    enum { COUNT = 1500 };
    crease_scores *plain = given_scores(wave, COUNT, 16, 60, 2);
    crease_scores *rotated = given_scores(turned, COUNT, 16, 60, 2);
    for (size_t i = 0; i < COUNT; i++)
        assert_near(crease_scores_variance(plain)[i], crease_scores_variance(rotated)[i], 1e-9);
    crease_scores_free(plain);
    crease_scores_free(rotated);
}

static void given_a_scaled_cloud_then_the_variance_is_the_same(void **state)
{
    enum { COUNT = 1500 };
    crease_scores *plain = given_scores(wave, COUNT, 16, 60, 2);
    crease_scores *scaled = given_scores(small, COUNT, 16, 60, 2);
    assert_memory_equal(
        crease_scores_variance(plain), crease_scores_variance(scaled), COUNT * sizeof(double));
    crease_scores_free(plain);
    crease_scores_free(scaled);
}

static void given_any_number_of_threads_then_scores_are_the_same_bytes(void **state)
{
    enum { COUNT = 3000 };
    crease_scores *one = given_scores(cube, COUNT, 12, 40, 1);
    for (int threads = 2; threads <= 4; threads += 2) {
        crease_scores *more = given_scores(cube, COUNT, 12, 40, threads);
        assert_memory_equal(one->variance, more->variance, COUNT * sizeof(double));
        assert_memory_equal(one->normals, more->normals, 3 * COUNT * sizeof(double));
        assert_memory_equal(one->features, more->features, COUNT);
        crease_scores_free(more);
    }
    crease_scores_free(one);
}

static void given_many_resamples_then_the_variance_is_that_of_a_plain_bootstrap(void **state)
{
    enum { COUNT = 300 };
    const int ks[] = {4, 9, 16, 40};
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context, wave, COUNT);
    for (size_t n = 0; n < 4; n++) {
        const size_t k = (size_t)ks[n];
        crease_neighbours *neighbours = NULL;
        assert_int_equal(crease_neighbours_find(context, cloud, ks[n], &neighbours), CREASE_OK);
        crease_scores *scores = given_scores(wave, COUNT, ks[n], 5000, 2);
        for (size_t i = 5; i < COUNT; i += 97) {
            double points[40][3];
            for (size_t j = 0; j < k; j++)
                memcpy(points[j],
                    crease_cloud_points(cloud) + 3 * crease_neighbours_of(neighbours, i)[j],
                    sizeof points[j]);
            const double plain = plain_variance((const double(*)[3])points, k, 6000);
            assert_near(crease_scores_variance(scores)[i] / plain, 1, k < 16 ? 0.5 : 0.1);
        }
        crease_scores_free(scores);
        crease_neighbours_free(neighbours);
    }
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_neighbourhood_then_the_mean_lies_between_the_resampled_normals(void **state)
{
    enum { COUNT = 16 };
    double memory[3 * 200];
    uint32_t pending[200], positions[COUNT];
    crease_resamples room = {200, {memory, memory + 200, memory + 400}, pending};
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context, wave, COUNT);
    crease_tree *tree = NULL;
    assert_int_equal(
        crease_tree_create(context, crease_cloud_points(cloud), COUNT, &tree), CREASE_OK);
    for (uint32_t i = 0; i < COUNT; i++)
        positions[i] = i;
    crease_neighbourhood neighbourhood;
    crease_normal_bootstrap found;
    crease_principal principal;
    crease_neighbourhood_fill(tree, positions, COUNT, &neighbourhood);
    crease_principal_compute(&neighbourhood, &principal);
    assert_false(principal.degenerate);
    assert_true(crease_normal_bootstrap_compute(&neighbourhood, &principal, 1, 2, &room, &found));
    double length = 0, along = 0;
    for (int axis = 0; axis < 3; axis++) {
        length += found.mean[axis] * found.mean[axis];
        along += found.mean[axis] * principal.normal[axis];
    }
    assert_true(along > 0 && length <= 1);
    assert_near(found.variance, (1 - length) * 200 / 199, 1e-12); /* of unit vectors */
    crease_tree_free(tree);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static crease_status status_of(maker *make, size_t count, int k, int resamples, double rate)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context, make, count);
    const crease_detect_options options = {k, resamples, rate, CREASE_DETECTOR_BOOTSTRAP};
    crease_scores *scores = NULL;
    const crease_status status = crease_scores_compute(context, cloud, &options, &scores);
    assert_true((status == CREASE_OK) == (scores != NULL));
    assert_true((status == CREASE_OK) == (crease_context_message(context)[0] == 0));
    crease_scores_free(scores);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return status;
}

static void given_points_that_span_no_surface_then_the_cloud_is_degenerate(void **state)
{
    assert_int_equal(status_of(equal, 100, 8, 20, 0.05), CREASE_ERROR_DEGENERATE);
    assert_int_equal(status_of(line, 100, 8, 20, 0.05), CREASE_ERROR_DEGENERATE);
    assert_int_equal(status_of(equal, 4, 4, 20, 0.05), CREASE_ERROR_DEGENERATE);
    assert_int_equal(status_of(wave, 4, 4, 20, 0.05), CREASE_OK);
}

static void given_duplicate_points_then_scores_are_finite(void **state)
{
    crease_scores *scores = given_scores(doubled, 900, 9, 30, 2);
    for (size_t i = 0; i < 900; i++) {
        const double *normal = crease_scores_normals(scores) + 3 * i;
        const double variance = crease_scores_variance(scores)[i];
        assert_true(variance >= 0 && variance <= 1.1);
        assert_near(
            normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2], 1, 1e-12);
    }
    crease_scores_free(scores);
}

static void given_options_out_of_range_then_each_is_refused(void **state)
{
    assert_int_equal(status_of(cube, 50, 3, 20, 0.05), CREASE_ERROR_ARGUMENT);
    assert_int_equal(status_of(cube, 500, 257, 20, 0.05), CREASE_ERROR_ARGUMENT);
    assert_int_equal(status_of(cube, 50, 8, 1, 0.05), CREASE_ERROR_ARGUMENT);
    assert_int_equal(status_of(cube, 50, 8, 10001, 0.05), CREASE_ERROR_ARGUMENT);
    assert_int_equal(status_of(cube, 50, 8, 20, -0.1), CREASE_ERROR_ARGUMENT);
    assert_int_equal(status_of(cube, 50, 8, 20, NAN), CREASE_ERROR_ARGUMENT);
    assert_int_equal(status_of(cube, 7, 8, 20, 0.05), CREASE_ERROR_TOO_FEW_POINTS);
    assert_int_equal(status_of(cube, 300, 256, 2, 1), CREASE_OK);
    crease_scores_free(NULL);
}

static void given_a_failing_allocation_then_no_memory_and_no_leak(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context, cube, 200);
    crease_scores *scores = NULL;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; n < 100 && status != CREASE_OK; n++) {
        crease_context_fail_allocation(context, n);
        status = crease_scores_compute(context, cloud, NULL, &scores);
        assert_true(status == CREASE_OK || (status == CREASE_ERROR_NO_MEMORY && !scores));
    }
    assert_in_range(n, 15, 99);
    crease_scores_free(scores);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_values_then_standard_scores_have_mean_0_and_deviation_1(void **state)
{
    const double values[] = {2, 4, 4, 4, 5, 5, 7, 9};
    double plain[8], positive[8], sum = 0, squares = 0;
    crease_standardise(values, 8, false, plain);
    crease_standardise(values, 8, true, positive);
    for (int i = 0; i < 8; i++) {
        sum += plain[i];
        squares += plain[i] * plain[i];
        assert_near(positive[i], plain[i] - plain[0], 1e-15);
    }
    assert_near(sum, 0, 1e-14);
    assert_near(squares, 7, 1e-14);
    assert_true(positive[0] == 0);
}

static void given_equal_values_then_standard_scores_are_zero(void **state)
{
    double values[7];
    for (int i = 0; i < 7; i++)
        values[i] = 0.1;
    crease_standardise(values, 7, true, values);
    for (int i = 0; i < 7; i++)
        assert_true(values[i] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_any_eigenvalues_then_the_vector_of_the_smallest_is_found),
        cmocka_unit_test(given_diagonal_matrices_then_an_axis_is_found_exactly),
        cmocka_unit_test(given_numbers_then_mean_and_variance_are_eq_3_and_4),
        cmocka_unit_test(given_the_mean_as_statistic_then_its_variance_is_that_of_the_textbook),
        cmocka_unit_test(given_any_sample_size_then_members_are_uniform),
        cmocka_unit_test(given_resamples_drawn_together_then_they_are_those_drawn_alone),
        cmocka_unit_test(given_a_cube_then_edges_stand_out_and_faces_are_flat),
        cmocka_unit_test(given_a_perfect_plane_then_the_variance_is_zero),
        cmocka_unit_test(given_noise_on_a_smooth_surface_then_few_points_are_features),
        cmocka_unit_test(given_flat_and_curved_ground_then_only_edges_are_features),
        cmocka_unit_test(given_a_rotated_cloud_then_the_variance_is_the_same),
        cmocka_unit_test(given_a_scaled_cloud_then_the_variance_is_the_same),
        cmocka_unit_test(given_any_number_of_threads_then_scores_are_the_same_bytes),
        cmocka_unit_test(given_many_resamples_then_the_variance_is_that_of_a_plain_bootstrap),
        cmocka_unit_test(given_a_neighbourhood_then_the_mean_lies_between_the_resampled_normals),
        cmocka_unit_test(given_points_that_span_no_surface_then_the_cloud_is_degenerate),
        cmocka_unit_test(given_duplicate_points_then_scores_are_finite),
        cmocka_unit_test(given_options_out_of_range_then_each_is_refused),
        cmocka_unit_test(given_a_failing_allocation_then_no_memory_and_no_leak),
        cmocka_unit_test(given_values_then_standard_scores_have_mean_0_and_deviation_1),
        cmocka_unit_test(given_equal_values_then_standard_scores_are_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
