/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Every detector behind crease_scores_compute(). The bootstrap itself: see test_detect.c. */
#include "given.h"

#include "base/random.h"
#include "detect/gauss_map.h"
#include "detect/jackknife.h"

enum { DETECTORS = CREASE_DETECTOR_GAUSS_MAP + 1 };

typedef void maker(size_t i, double point[3]);

static double draw(size_t i, uint64_t stream)
{
    return crease_random_uniform(11, stream, i);
}

static void flat(size_t i, double point[3])
{
    point[0] = draw(i, 0), point[1] = draw(i, 1), point[2] = 3;
}

static void noisy(size_t i, double point[3])
{
    point[0] = draw(i, 0), point[1] = draw(i, 1);
    point[2] = 0.002 * crease_random_normal(11, 2, i);
}

/* Two planes that meet at 90 degrees in the y axis. */
static void roof(size_t i, double point[3])
{
    const double across = 2 * draw(i, 0) - 1;
    point[0] = fmin(across, 0), point[1] = draw(i, 1), point[2] = fmin(-across, 0);
}

static void noisy_roof(size_t i, double point[3])
{
    roof(i, point);
    for (int axis = 0; axis < 3; axis++)
        point[axis] += 0.001 * crease_random_normal(11, 2 + (uint64_t)axis, i);
}

static void turned(size_t i, double point[3])
{
    double at[3];
    noisy_roof(i, at);
    point[0] = 0.36 * at[0] + 0.48 * at[1] - 0.8 * at[2];
    point[1] = -0.8 * at[0] + 0.6 * at[1];
    point[2] = 0.48 * at[0] + 0.64 * at[1] + 0.6 * at[2];
}

static void large(size_t i, double point[3])
{
    noisy_roof(i, point);
    for (int axis = 0; axis < 3; axis++)
        point[axis] *= 1024;
}

static crease_cloud *given_cloud(crease_context *context, maker *make, size_t count)
{
    double *points = malloc(count * 3 * sizeof *points);
    assert_non_null(points);
    for (size_t i = 0; i < count; i++)
        make(i, points + 3 * i);
    crease_cloud *const cloud = given_cloud_of(context, points, count);
    free(points);
    return cloud;
}

static crease_scores *given_scores(
    maker *make, size_t count, crease_detect_options options, int threads)
{
    crease_context *context = given_context_with_threads(threads);
    crease_cloud *cloud = given_cloud(context, make, count);
    crease_scores *scores = NULL;
    assert_int_equal(crease_scores_compute(context, cloud, &options, &scores), CREASE_OK);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return scores;
}

static crease_detect_options given_detector(int detector, int k)
{
    crease_detect_options options = crease_detect_options_default();
    options.detector = (crease_detector)detector;
    options.neighbours = k;
    return options;
}

static double mean_ratio(const crease_scores *a, const crease_scores *b)
{
    const size_t count = crease_scores_count(a);
    double *ratios = malloc(count * sizeof *ratios), sum = 0;
    assert_non_null(ratios);
    for (size_t i = 0; i < count; i++) {
        ratios[i] = log(crease_scores_variance(a)[i] / crease_scores_variance(b)[i]);
        sum += ratios[i];
    }
    free(ratios);
    return exp(sum / (double)count);
}

static void given_many_resamples_then_the_jackknife_is_the_bootstrap(void **state)
{
    enum { COUNT = 400, B = 2000 };
    maker *const makers[] = {noisy, noisy_roof};
    for (int m = 0; m < 2; m++)
        for (int k = 16; k <= 256; k *= 4) {
            crease_detect_options options = given_detector(CREASE_DETECTOR_BOOTSTRAP, k);
            options.resamples = B * 16 / k;
            crease_scores *bootstrap = given_scores(makers[m], COUNT, options, 2);
            options.detector = CREASE_DETECTOR_JACKKNIFE;
            crease_scores *jackknife = given_scores(makers[m], COUNT, options, 2);
            const double ratio = mean_ratio(bootstrap, jackknife);
            assert_true(ratio > 0.99 && ratio < (k == 16 ? 1.8 : k == 64 ? 1.1 : 1.03));
            crease_scores_free(bootstrap);
            crease_scores_free(jackknife);
        }
}

static void given_noise_on_a_plane_then_the_jackknife_is_the_variance_of_a_regression(void **state)
{
    enum { COUNT = 3000, K = 64 };
    crease_scores *scores =
        given_scores(noisy, COUNT, given_detector(CREASE_DETECTOR_JACKKNIFE, K), 2);
    double sum = 0;
    size_t inside = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double p[3];
        noisy(i, p);
        if (fmin(fmin(p[0], 1 - p[0]), fmin(p[1], 1 - p[1])) < 0.1)
            continue;
        sum += crease_scores_variance(scores)[i];
        inside++;
    }
    /* a disc with K points of density COUNT has the variance r^2 / 4 along each axis */
    const double squared_radius = K / (3.14159265358979 * COUNT);
    const double expected = 2 * 0.002 * 0.002 / (K * squared_radius / 4);
    assert_near(sum / (double)inside / expected, 1, 0.1);
    crease_scores_free(scores);
}

static void given_a_plane_then_every_score_is_zero(void **state)
{
    for (int detector = 0; detector < DETECTORS; detector++)
        for (int k = 4; k <= 64; k *= 4) {
            crease_scores *scores = given_scores(flat, 300, given_detector(detector, k), 2);
            for (size_t i = 0; i < 300; i++) {
                assert_true(crease_scores_variance(scores)[i] == 0);
                assert_true(crease_scores_features(scores)[i] == 0);
            }
            crease_scores_free(scores);
        }
}

/* At most one point in this many may be a feature where there is none: the null of the Gauss map is
 * less well known than that of the others. */
static size_t share_of_wrong(int detector)
{
    return detector == CREASE_DETECTOR_GAUSS_MAP ? 40 : 100;
}

static void check_roof(maker *make, int detector)
{
    enum { COUNT = 6000 };
    const double spacing = sqrt(2.0 / COUNT);
    crease_scores *scores = given_scores(make, COUNT, given_detector(detector, 16), 2);
    size_t near = 0, found = 0, far = 0, wrong = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double p[3];
        roof(i, p);
        const double away = fabs(p[0] + p[2]), open = fmin(p[1], 1 - p[1]);
        const double score = crease_scores_variance(scores)[i];
        assert_true(score >= 0 && score <= 1);
        if (away < 0.3 * spacing && open > 3 * spacing)
            near++, found += crease_scores_features(scores)[i];
        if (away > 3 * spacing)
            far++, wrong += crease_scores_features(scores)[i];
    }
    assert_true(near > 20 && far > 4000);
    assert_in_range(found, near * 9 / 10, near);
    assert_in_range(wrong, 0, far / share_of_wrong(detector));
    crease_scores_free(scores);
}

static void given_an_edge_then_every_detector_finds_it_and_nothing_else(void **state)
{
    for (int detector = 0; detector < DETECTORS; detector++) {
        check_roof(roof, detector);
        check_roof(noisy_roof, detector);
    }
}

static void given_noise_on_a_plane_then_few_points_are_features(void **state)
{
    enum { COUNT = 5000 };
    for (int detector = 0; detector < DETECTORS; detector++) {
        crease_scores *scores = given_scores(noisy, COUNT, given_detector(detector, 16), 2);
        size_t found = 0;
        for (size_t i = 0; i < COUNT; i++)
            found += crease_scores_features(scores)[i];
        assert_in_range(found, 0, COUNT / share_of_wrong(detector));
        crease_scores_free(scores);
    }
}

static void given_a_turned_or_scaled_cloud_then_scores_are_the_same(void **state)
{
    enum { COUNT = 1000 };
    for (int detector = CREASE_DETECTOR_JACKKNIFE; detector < DETECTORS; detector++) {
        const crease_detect_options options = given_detector(detector, 16);
        crease_scores *plain = given_scores(noisy_roof, COUNT, options, 2);
        crease_scores *rotated = given_scores(turned, COUNT, options, 2);
        crease_scores *scaled = given_scores(large, COUNT, options, 2);
        for (size_t i = 0; i < COUNT; i++)
            assert_near(crease_scores_variance(plain)[i], crease_scores_variance(rotated)[i],
                detector == CREASE_DETECTOR_GAUSS_MAP ? 0.02 : 1e-9);
        assert_memory_equal(
            crease_scores_variance(plain), crease_scores_variance(scaled), COUNT * sizeof(double));
        crease_scores_free(plain);
        crease_scores_free(rotated);
        crease_scores_free(scaled);
    }
}

static void given_any_number_of_threads_then_scores_are_the_same_bytes(void **state)
{
    enum { COUNT = 2000 };
    for (int detector = CREASE_DETECTOR_JACKKNIFE; detector < DETECTORS; detector++) {
        const crease_detect_options options = given_detector(detector, 12);
        crease_scores *one = given_scores(noisy_roof, COUNT, options, 1);
        crease_scores *four = given_scores(noisy_roof, COUNT, options, 4);
        assert_memory_equal(
            crease_scores_variance(one), crease_scores_variance(four), COUNT * sizeof(double));
        assert_memory_equal(crease_scores_features(one), crease_scores_features(four), COUNT);
        crease_scores_free(one);
        crease_scores_free(four);
    }
}

/* The corners of a box of 2 x 2 x 2 heights. */
static void box(size_t i, double point[3])
{
    point[0] = i & 1 ? 1 : -1, point[1] = i & 2 ? 1 : -1, point[2] = i & 4 ? 0.25 : -0.25;
}

static void given_known_points_then_their_surface_variation_is_that_of_the_textbook(void **state)
{
    crease_scores *scores = given_scores(box, 8, given_detector(CREASE_DETECTOR_VARIATION, 8), 1);
    for (size_t i = 0; i < 8; i++)
        assert_near(crease_scores_variance(scores)[i], 0.0625 / 2.0625, 1e-14);
    crease_scores_free(scores);
}

/* A point on an edge and two neighbours on each of its faces; the first face is the x y plane. */
static double separation_over(double degrees)
{
    const double c = cos(degrees * 0.017453292519943295), s = sin(degrees * 0.017453292519943295);
    const double points[5][3] = {{0, 0, 0}, {1, 1, 0}, {1, -1, 0}, {-c, 1, s}, {-c, -1, s}};
    crease_neighbourhood neighbourhood = {.k = 5};
    for (int i = 0; i < 5; i++)
        memcpy(neighbourhood.moments[i], points[i], sizeof points[i]);
    return crease_gauss_map_separation(&neighbourhood);
}

static void given_an_edge_then_the_gauss_map_falls_apart_by_its_angle(void **state)
{
    double before = 0;
    assert_true(separation_over(0) == 0);
    for (int degrees = 10; degrees <= 90; degrees += 10) {
        const double separation = separation_over(degrees);
        const double sine = sin(degrees * 0.017453292519943295);
        assert_true(separation > before && separation <= 1);
        assert_true(separation > 0.2 * sine * sine);
        before = separation;
    }
}

/* Points in pairs, and sets of neighbours that all lie on one line through the point. */
static void pairs(size_t i, double point[3])
{
    noisy(i / 2, point);
}

static void given_doubled_points_then_scores_are_finite(void **state)
{
    for (int detector = 0; detector < DETECTORS; detector++) {
        crease_scores *scores = given_scores(pairs, 600, given_detector(detector, 9), 2);
        for (size_t i = 0; i < 600; i++)
            assert_true(
                crease_scores_variance(scores)[i] >= 0 && crease_scores_variance(scores)[i] <= 1);
        crease_scores_free(scores);
    }
}

static void on_a_line(size_t i, double point[3])
{
    point[0] = (double)i, point[1] = point[2] = 0;
}

static void given_a_line_or_no_such_detector_then_it_is_refused(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context, on_a_line, 100);
    crease_scores *scores = NULL;
    for (int detector = 0; detector < DETECTORS; detector++) {
        const crease_detect_options options = given_detector(detector, 8);
        assert_int_equal(
            crease_scores_compute(context, cloud, &options, &scores), CREASE_ERROR_DEGENERATE);
        assert_null(scores);
    }
    const crease_detect_options unknown = given_detector(DETECTORS, 8);
    assert_int_equal(
        crease_scores_compute(context, cloud, &unknown, &scores), CREASE_ERROR_ARGUMENT);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_many_resamples_then_the_jackknife_is_the_bootstrap),
        cmocka_unit_test(given_noise_on_a_plane_then_the_jackknife_is_the_variance_of_a_regression),
        cmocka_unit_test(given_a_plane_then_every_score_is_zero),
        cmocka_unit_test(given_an_edge_then_every_detector_finds_it_and_nothing_else),
        cmocka_unit_test(given_noise_on_a_plane_then_few_points_are_features),
        cmocka_unit_test(given_a_turned_or_scaled_cloud_then_scores_are_the_same),
        cmocka_unit_test(given_any_number_of_threads_then_scores_are_the_same_bytes),
        cmocka_unit_test(given_known_points_then_their_surface_variation_is_that_of_the_textbook),
        cmocka_unit_test(given_an_edge_then_the_gauss_map_falls_apart_by_its_angle),
        cmocka_unit_test(given_doubled_points_then_scores_are_finite),
        cmocka_unit_test(given_a_line_or_no_such_detector_then_it_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
