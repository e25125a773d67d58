/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_faces.h"

#include "base/symmetric.h"
#include "noise/noise.h"

static crease_noise *given_noise(crease_context *context, const struct faces *faces)
{
    crease_cloud *cloud = cloud_of(context, faces);
    crease_noise *noise = NULL;
    assert_int_equal(crease_noise_estimate(context, cloud, &noise), CREASE_OK);
    crease_cloud_free(cloud);
    return noise;
}

static struct faces given_square(double spacing)
{
    struct faces faces = given_faces(spacing);
    add_rectangle(&faces, (double[]){5, 6, 7}, (double[]){0.6, 0.8, 0}, (double[]){0, 0, 1}, 2, 1);
    return faces;
}

static struct faces given_tube(double spacing)
{
    struct faces faces = given_faces(spacing);
    add_face(&faces, map_cylinder, (double[]){0.5}, acos(-1.0), 1);
    return faces;
}

static void sigma_is_that_of_the_noise(void **state)
{
    static struct faces (*const shapes[])(double) = {given_square, given_tube, given_cube};
    static const double sigmas[] = {0.08, 0.16, 0.32, 0.64};
    crease_context *context = given_context();
    for (size_t shape = 0; shape < 3; shape++)
        for (size_t i = 0; i < 4; i++) {
            struct faces faces = shapes[shape](0.025);
            add_noise(&faces, sigmas[i]);
            crease_noise *noise = given_noise(context, &faces);
            const double sigma = sigmas[i] * faces.spacing;
            assert_near(crease_noise_sigma(noise), sigma, 0.2 * sigma);
            crease_noise_free(noise);
            free_faces(&faces);
        }
    crease_context_free(context);
}

static void exact_clouds_have_the_least_sigma(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_cube(0.04);
    crease_noise *noise = given_noise(context, &faces);
    assert_near(crease_noise_sigma(noise), 0.03 * crease_noise_spacing(noise), 1e-12);
    crease_noise_free(noise);
    free_faces(&faces);
    crease_context_free(context);
}

static void spacing_is_the_root_of_the_area_of_a_point(void **state)
{
    static struct faces (*const shapes[])(double) = {given_square, given_tube, given_cube};
    crease_context *context = given_context();
    for (size_t shape = 0; shape < 3; shape++)
        for (int i = 0; i < 3; i++) {
            struct faces faces = shapes[shape](0.025);
            add_noise(&faces, 0.32 * i);
            crease_noise *noise = given_noise(context, &faces);
            const double truth = sqrt(faces.area / (double)faces.count);
            assert_near(crease_noise_spacing(noise), truth, 0.07 * truth);
            crease_noise_free(noise);
            free_faces(&faces);
        }
    crease_context_free(context);
}

/* Share of the cube's points whose normal is more than 15 degrees off that of their face. */
static double share_of_wrong_normals(const struct faces *cube, const crease_noise *noise)
{
    size_t wrong = 0;
    for (size_t i = 0; i < cube->count; i++)
        wrong += fabs(crease_noise_normals(noise)[3 * i + (size_t)cube->face[i] / 2]) <
            cos(15 * acos(-1.0) / 180);
    return (double)wrong / (double)cube->count;
}

static void normals_beside_edges_are_those_of_the_own_side(void **state)
{
    crease_context *context = given_context();
    static const double sigmas[] = {0, 0.16, 0.32}, shares[] = {0.04, 0.09, 0.16};
    for (int i = 0; i < 3; i++) {
        struct faces faces = given_cube(0.04);
        add_noise(&faces, sigmas[i]);
        crease_noise *noise = given_noise(context, &faces);
        const double share = share_of_wrong_normals(&faces, noise);
        if (share > shares[i])
            fail_msg("sigma %g: %g of the normals are wrong", sigmas[i], share);
        crease_noise_free(noise);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void both_sides_of_a_thin_wall_are_told_apart(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_faces(0.02);
    for (int side = 0; side < 2; side++)
        add_rectangle(
            &faces, (double[]){0, 0, 0.044 * side}, (double[]){1, 0, 0}, (double[]){0, 1, 0}, 1, 1);
    add_noise(&faces, 0.05);
    crease_noise *noise = given_noise(context, &faces);
    assert_near(crease_noise_sigma(noise), 0.001, 0.0007);
    crease_noise_free(noise);
    free_faces(&faces);
    crease_context_free(context);
}

/* The other wall comes into the larger windows only, by which shared errors are found. */
static void walls_a_few_spacings_thick_are_no_shared_noise(void **state)
{
    static const double thicknesses[] = {3.5, 3.8, 4, 4.3, 5, 7}, sigmas[] = {0.05, 0.2, 0.3};
    crease_context *context = given_context();
    for (int i = 0; i < 18; i++) {
        const double sigma = sigmas[i % 3];
        struct faces faces = given_faces(0.02);
        for (int side = 0; side < 2; side++)
            add_rectangle(&faces, (double[]){0, 0, 0.02 * thicknesses[i / 3] * side},
                (double[]){1, 0, 0}, (double[]){0, 1, 0}, 1, 1);
        add_noise(&faces, sigma);
        crease_noise *noise = given_noise(context, &faces);
        if (!(crease_noise_sigma(noise) < 1.25 * 0.02 * sigma))
            fail_msg("walls %g thick, noise %g: %g", thicknesses[i / 3], sigma,
                crease_noise_sigma(noise) / 0.02);
        crease_noise_free(noise);
        free_faces(&faces);
    }
    crease_context_free(context);
}

/* Bars so narrow that larger windows lie across their edges. */
static void narrow_faces_without_noise_have_none(void **state)
{
    static const double widths[] = {8.5, 9, 10, 11, 12, 14};
    crease_context *context = given_context();
    for (int i = 0; i < 6; i++) {
        const double width = 0.02 * widths[i];
        struct faces faces = given_faces(0.02);
        for (int side = 0; side < 2; side++) {
            add_rectangle(&faces, (double[]){0, 0, width * side}, (double[]){1, 0, 0},
                (double[]){0, 1, 0}, 1, width);
            add_rectangle(&faces, (double[]){0, width * side, 0}, (double[]){1, 0, 0},
                (double[]){0, 0, 1}, 1, width);
        }
        crease_noise *noise = given_noise(context, &faces);
        if (!(crease_noise_sigma(noise) < 0.04 * 0.02))
            fail_msg("bar %g wide: %g", widths[i], crease_noise_sigma(noise) / 0.02);
        crease_noise_free(noise);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void independent_errors_are_not_taken_for_shared_ones(void **state)
{
    static struct faces (*const shapes[])(double) = {given_square, given_tube, given_cube};
    crease_context *context = given_context();
    for (size_t shape = 0; shape < 3; shape++)
        for (int i = 0; i < 4; i++) {
            struct faces faces = shapes[shape](0.025);
            add_noise(&faces, 0.16 * i);
            crease_noise *noise = given_noise(context, &faces);
            assert_true(noise->alike == 1.0);
            crease_noise_free(noise);
            free_faces(&faces);
        }
    crease_context_free(context);
}

/* A zigzag of strips, a flat end beside it: most of the larger windows lie across folds. */
static struct faces given_folds(double width)
{
    struct faces faces = given_faces(0.025);
    for (int i = 0; i < 24; i++) {
        const bool up = i % 2 == 0;
        add_rectangle(&faces, (double[]){0.8 * width * i, 0, up ? 0 : 0.6 * width},
            (double[]){0.8, 0, up ? 0.6 : -0.6}, (double[]){0, 1, 0}, width, 1);
    }
    add_rectangle(&faces, (double[]){0.8 * width * 24, 0, 0}, (double[]){1, 0, 0},
        (double[]){0, 1, 0}, 0.7, 1);
    add_noise(&faces, 0.16);
    return faces;
}

static void folds_are_no_shared_errors(void **state)
{
    crease_context *context = given_context();
    for (int spacings = 8; spacings <= 16; spacings += 2) {
        struct faces faces = given_folds(0.025 * spacings);
        crease_noise *noise = given_noise(context, &faces);
        const double sigma = 0.16 * faces.spacing;
        assert_true(noise->alike == 1.0);
        assert_near(crease_noise_sigma(noise), sigma, 0.25 * sigma);
        crease_noise_free(noise);
        free_faces(&faces);
    }
    crease_context_free(context);
}

/* Small windows follow errors that ten points of a scan line share, and leave half of the noise. */
static void errors_along_scan_lines_are_found(void **state)
{
    static const double sigmas[] = {0.1, 0.2, 0.3};
    crease_context *context = given_context();
    for (size_t i = 0; i < 3; i++) {
        struct faces faces = given_scanned_plate(120, 120, 0.2, sigmas[i], 10);
        crease_noise *noise = given_noise(context, &faces);
        const double sigma = sigmas[i] * cos(atan(0.2));
        assert_near(crease_noise_sigma(noise), sigma, 0.2 * sigma);
        assert_true(noise->alike > 3 && noise->alike < 20);
        crease_noise_free(noise);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void terraces_of_rounded_depths_are_no_thin_walls(void **state)
{
    static const double slopes[] = {0.08, 0.15, 0.15}, sigmas[] = {0.2, 0.2, 0};
    crease_context *context = given_context();
    for (size_t i = 0; i < 3; i++) {
        struct faces faces = given_scanned_plate(90, 90, slopes[i], sigmas[i], 1);
        round_heights(&faces, 1);
        crease_noise *noise = given_noise(context, &faces);
        const double sigma = sqrt(1.0 / 12 + sigmas[i] * sigmas[i]) * cos(atan(slopes[i]));
        assert_near(crease_noise_sigma(noise), sigma, 0.2 * sigma);
        assert_true(noise->alike >= 3);
        crease_noise_free(noise);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void threads_do_not_change_a_bit(void **state)
{
    struct faces faces = given_cube(0.04);
    add_noise(&faces, 0.3);
    crease_noise *first = NULL;
    for (int threads = 1; threads <= 4; threads *= 2) {
        crease_context *context = given_context_with_threads(threads);
        crease_noise *noise = given_noise(context, &faces);
        if (!first) {
            first = noise;
        } else {
            assert_true(crease_noise_sigma(first) == crease_noise_sigma(noise));
            assert_true(crease_noise_spacing(first) == crease_noise_spacing(noise));
            assert_memory_equal(crease_noise_normals(first), crease_noise_normals(noise),
                faces.count * 3 * sizeof(double));
            crease_noise_free(noise);
        }
        crease_context_free(context);
    }
    assert_int_equal(crease_noise_count(first), faces.count);
    crease_noise_free(first);
    free_faces(&faces);
}

static void size_and_place_do_not_matter(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_cube(0.05);
    add_noise(&faces, 0.2);
    crease_noise *here = given_noise(context, &faces);
    for (size_t i = 0; i < 3 * faces.count; i++)
        faces.points[i] = 0x1p100 * faces.points[i];
    crease_noise *large = given_noise(context, &faces);
    assert_near(crease_noise_spacing(large) * 0x1p-100, crease_noise_spacing(here), 1e-12);
    assert_near(crease_noise_sigma(large) * 0x1p-100, crease_noise_sigma(here), 1e-12);
    for (size_t i = 0; i < 3 * faces.count; i++)
        faces.points[i] = 0x1p-100 * faces.points[i] + 1e6;
    crease_noise *far = given_noise(context, &faces);
    assert_near(crease_noise_sigma(far), crease_noise_sigma(here), 1e-6);
    crease_noise_free(here);
    crease_noise_free(large);
    crease_noise_free(far);
    free_faces(&faces);
    crease_context_free(context);
}

static crease_status status_of(crease_context *context, const double *points, size_t count)
{
    crease_noise *noise = NULL;
    crease_cloud *cloud = given_cloud_of(context, points, count);
    const crease_status status = crease_noise_estimate(context, cloud, &noise);
    assert_true((status == CREASE_OK) == (noise != NULL));
    crease_noise_free(noise);
    crease_cloud_free(cloud);
    return status;
}

static void points_without_a_surface_are_refused(void **state)
{
    crease_context *context = given_context();
    double points[3 * 40];
    for (size_t i = 0; i < 120; i++)
        points[i] = 3.5;
    assert_int_equal(status_of(context, points, 40), CREASE_ERROR_DEGENERATE);
    for (size_t i = 0; i < 120; i++)
        points[i] = (double)(i / 3) * (double)(1 + i % 3) / 7;
    assert_int_equal(status_of(context, points, 40), CREASE_ERROR_DEGENERATE);
    assert_non_null(strstr(crease_context_message(context), "line"));
    for (size_t i = 0; i < 120; i++)
        points[i] = i % 3 == 2 ? 0 : crease_random_uniform(1, i % 3, i);
    assert_int_equal(status_of(context, points, 3), CREASE_ERROR_TOO_FEW_POINTS);
    for (size_t count = 4; count <= 40; count++)
        if (status_of(context, points, count) != CREASE_OK)
            fail_msg("%zu points: %s", count, crease_context_message(context));
    crease_context_free(context);
}

static void every_failed_allocation_is_reported(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_cube(0.08);
    crease_cloud *cloud = cloud_of(context, &faces);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    for (long n = 0; status != CREASE_OK; n++) {
        crease_noise *noise = NULL;
        crease_context_fail_allocation(context, n);
        status = crease_noise_estimate(context, cloud, &noise);
        crease_context_fail_allocation(context, -1);
        assert_true(status == CREASE_OK || (status == CREASE_ERROR_NO_MEMORY && !noise));
        assert_true(n < 100);
        crease_noise_free(noise);
    }
    crease_cloud_free(cloud);
    free_faces(&faces);
    crease_context_free(context);
}

static void axes_of_a_matrix_make_it_again(void **state)
{
    for (uint64_t n = 0; n < 200; n++) {
        double vectors[3][3], matrix[6] = {0}, again[6] = {0}, values[3], axes[9];
        for (int r = 0; r < 3; r++) {
            for (int c = 0; c < 3; c++)
                vectors[r][c] = crease_random_normal(3, n, (uint64_t)(3 * r + c));
            crease_symmetric_add(matrix, n % 4 == 3 && r > 0 ? 0.0 : 1.0, vectors[r]);
        }
        crease_symmetric_axes(matrix, values, axes);
        assert_true(values[0] <= values[1] && values[1] <= values[2]);
        for (int r = 0; r < 3; r++)
            crease_symmetric_add(again, values[r], axes + 3 * r);
        for (int k = 0; k < 6; k++)
            assert_near(again[k], matrix[k], 1e-13 * (1 + values[2]));
    }
}

/* A banded system of n unknowns whose diagonal outweighs the rest. */
static void solve_banded(int n, int band, bool definite)
{
    const size_t size = (size_t)n;
    double *matrix = calloc(size * size, sizeof *matrix);
    double *truth = calloc(size, sizeof *truth), *right = calloc(size, sizeof *right);
    for (int i = 0; i < n; i++) {
        truth[i] = sin(i + 1.0);
        for (int j = i > band ? i - band : 0; j <= i; j++)
            matrix[n * i + j] = matrix[n * j + i] = i == j ? 3 * band : cos(i * j + 1.0);
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++)
            right[i] += matrix[n * i + j] * truth[j];
    matrix[(n + 1) * (n / 2)] *= definite ? 1 : -1;
    assert_int_equal(crease_symmetric_factor(matrix, size, size, (size_t)band), definite);
    if (definite)
        crease_symmetric_solve(matrix, size, size, (size_t)band, right);
    for (int i = 0; i < n && definite; i++)
        assert_near(right[i], truth[i], 1e-13);
    free(matrix);
    free(truth);
    free(right);
}

/* Narrow matrices, and wide ones, whose rows are multiplied in lanes: bands below, at and above a
 * multiple of these. */
static void factors_solve_banded_systems(void **state)
{
    static const int cases[][2] = {{12, 3}, {6, 6}, {15, 14}, {16, 15}, {40, 7}, {100, 33}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        solve_banded(cases[i][0], cases[i][1], true);
        solve_banded(cases[i][0], cases[i][1], false);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sigma_is_that_of_the_noise),
        cmocka_unit_test(exact_clouds_have_the_least_sigma),
        cmocka_unit_test(spacing_is_the_root_of_the_area_of_a_point),
        cmocka_unit_test(normals_beside_edges_are_those_of_the_own_side),
        cmocka_unit_test(both_sides_of_a_thin_wall_are_told_apart),
        cmocka_unit_test(walls_a_few_spacings_thick_are_no_shared_noise),
        cmocka_unit_test(narrow_faces_without_noise_have_none),
        cmocka_unit_test(independent_errors_are_not_taken_for_shared_ones),
        cmocka_unit_test(folds_are_no_shared_errors),
        cmocka_unit_test(errors_along_scan_lines_are_found),
        cmocka_unit_test(terraces_of_rounded_depths_are_no_thin_walls),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(size_and_place_do_not_matter),
        cmocka_unit_test(points_without_a_surface_are_refused),
        cmocka_unit_test(every_failed_allocation_is_reported),
        cmocka_unit_test(axes_of_a_matrix_make_it_again),
        cmocka_unit_test(factors_solve_banded_systems),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
