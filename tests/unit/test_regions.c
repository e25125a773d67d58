/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_faces.h"

#include "primitive/patch.h"
#include "segment/region.h"

static const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0}, z_axis[3] = {0, 0, 1};

static crease_regions *given_regions(crease_context *context, const struct faces *faces)
{
    crease_cloud *cloud = cloud_of(context, faces);
    crease_regions *regions = NULL;
    const crease_status status = crease_regions_find(context, cloud, NULL, &regions);
    if (status != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    crease_cloud_free(cloud);
    return regions;
}

/* -------------------------------------------------------------------------------------- shapes --
 */

static struct faces given_cylinder(void)
{
    struct faces faces = given_faces(0.04);
    add_cylinder(&faces, 0.5, 1);
    return faces;
}

static struct faces given_six_sides(void)
{
    return given_cube(0.04);
}

/* The profile of an L, 1 x 1, walls of 0.4, pulled along y. */
static struct faces given_bracket(void)
{
    struct faces faces = given_faces(0.035);
    add_rectangle(&faces, (double[]){0, 0, 0}, x_axis, y_axis, 1, 1);
    add_rectangle(&faces, (double[]){0, 0, 0}, z_axis, y_axis, 1, 1);
    add_rectangle(&faces, (double[]){1, 0, 0}, z_axis, y_axis, 0.4, 1);
    add_rectangle(&faces, (double[]){0, 0, 1}, x_axis, y_axis, 0.4, 1);
    add_rectangle(&faces, (double[]){0.4, 0, 0.4}, x_axis, y_axis, 0.6, 1);
    add_rectangle(&faces, (double[]){0.4, 0, 0.4}, z_axis, y_axis, 0.6, 1);
    for (int end = 0; end < 2; end++) {
        add_rectangle(&faces, (double[]){0, end, 0}, x_axis, z_axis, 1, 0.4);
        faces.face_count--;
        add_rectangle(&faces, (double[]){0, end, 0.4}, x_axis, z_axis, 0.4, 0.6);
    }
    return faces;
}

static struct faces given_torus(void)
{
    const double pi = acos(-1.0);
    struct faces faces = given_faces(0.05);
    add_face(&faces, map_torus, (double[]){1, 0.35}, 2 * pi, 2 * pi * 0.35);
    return faces;
}

static struct faces given_sphere(void)
{
    struct faces faces = given_faces(0.05);
    add_face(&faces, map_sphere, (double[]){0.7}, 2 * acos(-1.0) * 0.7, 1.4);
    return faces;
}

static struct faces given_roof(void)
{
    const double angle = acos(-1.0) / 6;
    struct faces faces = given_faces(0.03);
    add_rectangle(&faces, (double[]){0, 0, 0}, (double[]){-1, 0, 0}, y_axis, 1, 1);
    add_rectangle(
        &faces, (double[]){0, 0, 0}, (double[]){cos(angle), 0, -sin(angle)}, y_axis, 1, 1);
    return faces;
}

static void map_sheet(const double *shape, double s, double t, double out[3])
{
    out[0] = s;
    out[1] = t;
    out[2] = shape[0] * sin(1.5 * s) * cos(t + 0.5 * s);
}

static struct faces given_sheet(void)
{
    struct faces faces = given_faces(0.03);
    add_face(&faces, map_sheet, (double[]){0.12}, 2, 1.5);
    return faces;
}

/* ------------------------------------------------------------------------------------- counts --
 */

/* Share of the points that have the label of most points of their face, or that another face passes
 * within the tolerance. */
static double share_of_right_labels(const struct faces *faces, const int32_t *labels)
{
    size_t right = 0;
    for (int face = 0; face < faces->face_count; face++) {
        size_t votes[64] = {0}, most = 0;
        for (size_t i = 0; i < faces->count; i++)
            if (faces->face[i] == face && labels[i] >= 0 && labels[i] < 64)
                votes[labels[i]]++;
        for (int l = 0; l < 64; l++)
            most = votes[l] > most ? votes[l] : most;
        right += most;
    }
    return (double)right / (double)faces->count;
}

struct expectation {
    const char *name;
    struct faces (*make)(void);
    size_t regions;
    int types[CREASE_REGION_FREEFORM + 1]; /* how many of each; all -1: not said */
};

static void count_types(const crease_regions *regions, int counts[CREASE_REGION_FREEFORM + 1])
{
    memset(counts, 0, (CREASE_REGION_FREEFORM + 1) * sizeof *counts);
    for (size_t r = 0; r < crease_regions_count(regions); r++)
        counts[crease_regions_at(regions, r).type]++;
}

static void the_faces_of_solids_are_the_regions(void **state)
{
    static const struct expectation expected[] = {
        {"cube", given_six_sides, 6, {6, 0, 0, 0, 0, 0}},
        {"cylinder", given_cylinder, 3, {2, 0, 1, 0, 0, 0}},
        {"bracket", given_bracket, 8, {8, 0, 0, 0, 0, 0}},
        {"torus", given_torus, 1, {0, 0, 0, 0, 1, 0}},
        {"sphere", given_sphere, 1, {0, 1, 0, 0, 0, 0}},
        {"roof", given_roof, 2, {2, 0, 0, 0, 0, 0}},
    };
    static const double sigmas[] = {0, 0.32};
    crease_context *context = given_context();
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++)
        for (int noisy = 0; noisy < 2; noisy++) {
            struct faces faces = expected[i].make();
            add_noise(&faces, sigmas[noisy]);
            crease_regions *regions = given_regions(context, &faces);
            int types[CREASE_REGION_FREEFORM + 1];
            count_types(regions, types);
            const double right = share_of_right_labels(&faces, crease_regions_labels(regions));
            if (crease_regions_count(regions) != expected[i].regions ||
                right < (noisy ? 0.94 : 0.985))
                fail_msg("%s, noise %g: %zu regions, %g of the labels right", expected[i].name,
                    sigmas[noisy], crease_regions_count(regions), right);
            assert_memory_equal(types, expected[i].types, sizeof types);
            crease_regions_free(regions);
            free_faces(&faces);
        }
    crease_context_free(context);
}

/* Of how many pieces a free form consists is a matter of economy; that they explain it is not. */
static void a_free_form_is_explained_by_few_regions(void **state)
{
    static const double sigmas[] = {0.1, 0.4};
    crease_context *context = given_context();
    for (int i = 0; i < 2; i++) {
        struct faces faces = given_sheet();
        add_noise(&faces, sigmas[i]);
        crease_regions *regions = given_regions(context, &faces);
        size_t points = 0;
        bool free_form = false;
        assert_true(crease_regions_count(regions) <= 2);
        for (size_t r = 0; r < crease_regions_count(regions); r++) {
            const crease_region piece = crease_regions_at(regions, r);
            free_form |= piece.type == CREASE_REGION_FREEFORM && piece.parameter_count == 0;
            points += piece.point_count;
            assert_true(piece.chi < 1.2);
        }
        assert_true(free_form);
        assert_true((double)points > 0.999 * (double)faces.count);
        crease_regions_free(regions);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void the_description_of_a_region_is_its_surface(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_cylinder();
    add_noise(&faces, 0.16);
    crease_regions *regions = given_regions(context, &faces);
    assert_int_equal(crease_regions_count(regions), 3);
    const crease_region side = crease_regions_at(regions, 0), disc = crease_regions_at(regions, 1);
    assert_int_equal(side.type, CREASE_REGION_CYLINDER);
    assert_int_equal(side.parameter_count, 7);
    assert_near(side.parameters[0], 0, 0.003);
    assert_near(side.parameters[1], 0, 0.003);
    assert_near(fabs(side.parameters[5]), 1, 1e-5);
    assert_near(side.parameters[6], 0.5, 0.002);
    assert_true(side.point_count > disc.point_count);
    assert_near(side.chi, 1, 0.25);
    assert_near(side.rms, crease_regions_sigma(regions), 0.15 * side.rms);
    assert_near(crease_regions_sigma(regions), 0.16 * 0.04, 0.15 * 0.16 * 0.04);
    assert_near(crease_regions_spacing(regions), 0.04, 0.003);
    assert_int_equal(disc.type, CREASE_REGION_PLANE);
    assert_int_equal(disc.parameter_count, 6);
    double gradient[3];
    assert_near(
        fabs(crease_regions_distance(regions, 0, (double[]){0.9, 0, 7}, gradient)), 0.4, 0.02);
    assert_near(gradient[0], 1, 0.001);
    size_t labelled = 0;
    for (size_t i = 0; i < faces.count; i++)
        labelled += crease_regions_labels(regions)[i] >= 0;
    assert_int_equal(
        labelled, side.point_count + disc.point_count + crease_regions_at(regions, 2).point_count);
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

/* Waves of errors that neighbours share are not split into regions of their own. */
static void noise_that_neighbours_share_is_no_shape(void **state)
{
    static const double slopes[] = {0.2, 0.15}, sigmas[] = {0.3, 0.2};
    crease_context *context = given_context();
    for (int rounded = 0; rounded < 2; rounded++) {
        struct faces faces =
            given_scanned_plate(90, 90, slopes[rounded], sigmas[rounded], rounded ? 1 : 10);
        if (rounded)
            round_heights(&faces, 1);
        crease_regions *regions = given_regions(context, &faces);
        assert_int_equal(crease_regions_count(regions), 1);
        const crease_region plate = crease_regions_at(regions, 0);
        assert_int_equal(plate.type, CREASE_REGION_PLANE);
        assert_near(plate.rms, crease_regions_sigma(regions), 0.2 * plate.rms);
        assert_near(plate.chi, 1, 0.4);
        crease_regions_free(regions);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void outliers_belong_to_no_region(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_six_sides();
    const size_t before = faces.count;
    add_noise(&faces, 0.16);
    for (uint64_t i = 0; i < before / 50; i++)
        add_point(&faces, 2 * crease_random_uniform(4, 1, i) - 0.5,
            2 * crease_random_uniform(4, 2, i) - 0.5, 2 * crease_random_uniform(4, 3, i) - 0.5);
    crease_regions *regions = given_regions(context, &faces);
    assert_int_equal(crease_regions_count(regions), 6);
    size_t wrong = 0, missed = 0;
    for (size_t i = 0; i < faces.count; i++) {
        const double *const p = faces.points + 3 * i;
        double off = INFINITY;
        for (int c = 0; c < 3; c++)
            off = fmin(off, fmin(fabs(p[c]), fabs(p[c] - 1)));
        const bool outside =
            p[0] < -0.1 || p[0] > 1.1 || p[1] < -0.1 || p[1] > 1.1 || p[2] < -0.1 || p[2] > 1.1;
        const bool none = crease_regions_labels(regions)[i] == -1;
        wrong += i < before && none;
        missed += i >= before && !none && off > 0.1 && !outside;
    }
    assert_true(wrong < before / 500);
    assert_true(missed == 0);
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

static void size_turn_and_place_change_no_label(void **state)
{
    static const double turn[3][3] = {
        {2 / 3.0, -1 / 3.0, 2 / 3.0}, {2 / 3.0, 2 / 3.0, -1 / 3.0}, {-1 / 3.0, 2 / 3.0, 2 / 3.0}};
    crease_context *context = given_context();
    struct faces faces = given_cylinder(), moved = given_cylinder();
    add_noise(&faces, 0.2);
    for (size_t i = 0; i < faces.count; i++)
        for (size_t r = 0; r < 3; r++) {
            moved.points[3 * i + r] = 1000.0 * (double)r;
            for (size_t c = 0; c < 3; c++)
                moved.points[3 * i + r] += 37 * turn[r][c] * faces.points[3 * i + c];
        }
    crease_regions *here = given_regions(context, &faces), *there = given_regions(context, &moved);
    assert_int_equal(crease_regions_count(here), crease_regions_count(there));
    size_t map[3][3] = {{0}}, same = 0;
    for (size_t i = 0; i < faces.count; i++)
        if (crease_regions_labels(here)[i] >= 0 && crease_regions_labels(there)[i] >= 0)
            map[crease_regions_labels(here)[i]][crease_regions_labels(there)[i]]++;
    for (int r = 0; r < 3; r++)
        same += map[r][0] > map[r][1] && map[r][0] > map[r][2] ? map[r][0]
            : map[r][1] > map[r][2]                            ? map[r][1]
                                                               : map[r][2];
    assert_true((double)same > 0.995 * (double)faces.count);
    crease_regions_free(here);
    crease_regions_free(there);
    free_faces(&faces);
    free_faces(&moved);
    crease_context_free(context);
}

static void the_order_of_the_points_changes_no_label(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_six_sides(), turned = given_six_sides();
    add_noise(&faces, 0.2);
    for (size_t i = 0; i < faces.count; i++)
        memcpy(turned.points + 3 * i, faces.points + 3 * (faces.count - 1 - i), 3 * sizeof(double));
    crease_regions *a = given_regions(context, &faces), *b = given_regions(context, &turned);
    for (size_t i = 0; i < faces.count; i++)
        assert_int_equal(
            crease_regions_labels(a)[i], crease_regions_labels(b)[faces.count - 1 - i]);
    crease_regions_free(a);
    crease_regions_free(b);
    free_faces(&faces);
    free_faces(&turned);
    crease_context_free(context);
}

static void threads_do_not_change_a_bit(void **state)
{
    struct faces faces = given_bracket();
    add_noise(&faces, 0.4);
    crease_regions *first = NULL;
    for (int threads = 1; threads <= 4; threads += 3) {
        crease_context *context = given_context_with_threads(threads);
        crease_regions *regions = given_regions(context, &faces);
        if (first) {
            assert_int_equal(crease_regions_count(first), crease_regions_count(regions));
            assert_memory_equal(crease_regions_labels(first), crease_regions_labels(regions),
                faces.count * sizeof(int32_t));
            assert_memory_equal(crease_regions_normals(first), crease_regions_normals(regions),
                faces.count * 3 * sizeof(double));
            for (size_t r = 0; r < crease_regions_count(first); r++) {
                const crease_region a = crease_regions_at(first, r);
                const crease_region b = crease_regions_at(regions, r);
                assert_memory_equal(a.parameters, b.parameters, sizeof a.parameters);
                assert_true(a.rms == b.rms && a.chi == b.chi);
            }
            crease_regions_free(regions);
        } else {
            first = regions;
        }
        crease_context_free(context);
    }
    assert_int_equal(crease_regions_point_count(first), faces.count);
    crease_regions_free(first);
    free_faces(&faces);
}

static crease_status status_of(crease_context *context, const double *points, size_t count,
    const crease_regions_options *options)
{
    crease_regions *regions = NULL;
    crease_cloud *cloud = given_cloud_of(context, points, count);
    const crease_status status = crease_regions_find(context, cloud, options, &regions);
    assert_true((status == CREASE_OK) == (regions != NULL));
    crease_regions_free(regions);
    crease_cloud_free(cloud);
    return status;
}

static void what_makes_no_sense_is_refused(void **state)
{
    crease_context *context = given_context();
    double points[3 * 64];
    for (size_t i = 0; i < 192; i++)
        points[i] = i % 3 == 2 ? 0.0 : (double)(i % 3 ? i / 24 : i / 3 % 8);
    crease_regions_options options = crease_regions_options_default();
    assert_int_equal(status_of(context, points, 64, &options), CREASE_OK);
    assert_int_equal(status_of(context, points, 7, NULL), CREASE_ERROR_TOO_FEW_POINTS);
    options.least_points = 7;
    assert_int_equal(status_of(context, points, 64, &options), CREASE_ERROR_ARGUMENT);
    options = (crease_regions_options){.sigma = -1, .least_points = 8};
    assert_int_equal(status_of(context, points, 64, &options), CREASE_ERROR_ARGUMENT);
    options.sigma = NAN;
    assert_int_equal(status_of(context, points, 64, &options), CREASE_ERROR_ARGUMENT);
    for (size_t i = 0; i < 192; i++)
        points[i] = 1;
    assert_int_equal(status_of(context, points, 64, NULL), CREASE_ERROR_DEGENERATE);
    for (size_t i = 0; i < 192; i++)
        points[i] = (double)(i / 3) * (double)(1 + i % 3) / 7;
    assert_int_equal(status_of(context, points, 64, NULL), CREASE_ERROR_DEGENERATE);
    crease_context_free(context);
}

static void tiny_clouds_are_no_trouble(void **state)
{
    crease_context *context = given_context();
    for (size_t count = 8; count < 60; count += count < 30 ? 1 : 7)
        for (uint64_t variant = 0; variant < 2; variant++) {
            double points[3 * 60];
            for (size_t i = 0; i < 3 * count; i++)
                points[i] = (i % 3 == 2 && variant) ? 0 : crease_random_uniform(variant, i % 3, i);
            if (status_of(context, points, count, NULL) != CREASE_OK)
                fail_msg("%zu points: %s", count, crease_context_message(context));
        }
    crease_context_free(context);
}

static void points_in_the_same_place_are_no_trouble(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_cube(0.1);
    const size_t before = faces.count;
    for (size_t i = 0; i < before; i += 2)
        add_point(&faces, faces.points[3 * i], faces.points[3 * i + 1], faces.points[3 * i + 2]);
    crease_regions *regions = given_regions(context, &faces);
    assert_int_equal(crease_regions_count(regions), 6);
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

static void a_known_noise_is_taken(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_cube(0.08);
    crease_cloud *cloud = cloud_of(context, &faces);
    const crease_regions_options options = {.sigma = 0.01, .least_points = 20};
    crease_regions *regions = NULL;
    assert_int_equal(crease_regions_find(context, cloud, &options, &regions), CREASE_OK);
    assert_true(crease_regions_sigma(regions) == 0.01);
    for (size_t r = 0; r < crease_regions_count(regions); r++)
        assert_true(crease_regions_at(regions, r).point_count >= 20);
    crease_regions_free(regions);
    crease_cloud_free(cloud);
    free_faces(&faces);
    crease_context_free(context);
}

static void every_failed_allocation_is_reported(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_faces(0.2);
    add_face(&faces, map_sheet, (double[]){0.12}, 2, 1.5);
    add_noise(&faces, 0.05);
    crease_cloud *cloud = cloud_of(context, &faces);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    for (long n = 0; status != CREASE_OK; n += 1 + n / 12) {
        crease_regions *regions = NULL;
        crease_context_fail_allocation(context, n);
        status = crease_regions_find(context, cloud, NULL, &regions);
        crease_context_fail_allocation(context, -1);
        assert_true(status == CREASE_OK || (status == CREASE_ERROR_NO_MEMORY && !regions));
        assert_true(n < 2000);
        crease_regions_free(regions);
    }
    crease_cloud_free(cloud);
    free_faces(&faces);
    crease_context_free(context);
}

static int stop_at(void *user)
{
    int *const left = user;
    return --*left <= 0;
}

static void work_can_be_cancelled_at_any_time(void **state)
{
    struct faces faces = given_cube(0.05);
    bool finished = false;
    for (int after = 1; !finished; after += 1 + after / 4) {
        int left = after;
        crease_context_options options = crease_context_options_default();
        options.threads = 2;
        options.cancelled = stop_at;
        options.user = &left;
        crease_context *context = NULL;
        assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
        crease_cloud *cloud = cloud_of(context, &faces);
        crease_regions *regions = NULL;
        const crease_status status = crease_regions_find(context, cloud, NULL, &regions);
        finished = status == CREASE_OK;
        assert_true(finished || status == CREASE_ERROR_CANCELLED);
        assert_true(finished == (regions != NULL));
        crease_regions_free(regions);
        crease_cloud_free(cloud);
        crease_context_free(context);
    }
    free_faces(&faces);
}

/* Polynomials and splines, flat and round: heights have the slopes that differences of them show,
 * and those of a round one come again after a turn. */
static void slopes_of_patches_are_those_of_their_heights(void **state)
{
    double coefficients[CREASE_PATCH_COEFFICIENTS];
    for (size_t i = 0; i < CREASE_PATCH_COEFFICIENTS; i++)
        coefficients[i] = sin(1.7 * (double)i);
    const double turn = 2 * acos(-1.0);
    const crease_patch patches[] = {
        {.degree = 2, .low = {-2, -1}, .high = {2, 1}, .unit = {2, 2}},
        {.degree = 4, .low = {-2, -1}, .high = {2, 1}, .unit = {2, 2}},
        {.spline = true, .spans = 3, .low = {-2, -1}, .high = {1, 2}, .unit = {1, 1}},
        {.spline = true, .spans = 24, .low = {-2, -1}, .high = {22, 5}, .unit = {1, 0.25}},
        {.spline = true, .round = true, .spans = 6, .high = {turn, 3}, .unit = {turn / 6, 0.5}},
    };
    const double step = 1e-5, places[][2] = {{0.13, 0.21}, {-1.9, 0.7}, {0.9, 0.95}};
    for (size_t k = 0; k < sizeof patches / sizeof *patches; k++)
        for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
            crease_patch patch = patches[k];
            double slope[2], ignored[2];
            const double x = places[i][0], y = places[i][1];
            patch.coefficients = coefficients;
            const double height = crease_patch_at(&patch, x, y, slope);
            const double dx = crease_patch_at(&patch, x + step, y, ignored) -
                crease_patch_at(&patch, x - step, y, ignored);
            const double dy = crease_patch_at(&patch, x, y + step, ignored) -
                crease_patch_at(&patch, x, y - step, ignored);
            assert_near(dx / (2 * step), slope[0], 1e-6);
            assert_near(dy / (2 * step), slope[1], 1e-6);
            if (patch.round)
                assert_near(crease_patch_at(&patch, x + turn, y, ignored), height, 1e-9);
        }
}

/* A spline whose coefficients all are 1 is 1 everywhere: its functions sum to 1, also in the last
 * cell and on the ends. */
static void splines_sum_to_one(void **state)
{
    double coefficients[CREASE_PATCH_COEFFICIENTS], slope[2];
    for (size_t i = 0; i < CREASE_PATCH_COEFFICIENTS; i++)
        coefficients[i] = 1;
    const crease_patch patch = {
        .spline = true, .spans = 5, .high = {5, 5}, .unit = {1, 1}, .coefficients = coefficients};
    for (int i = 0; i <= 50; i++)
        for (int j = 0; j <= 50; j++) {
            assert_near(crease_patch_at(&patch, 0.1 * i, 0.1 * j, slope), 1, 1e-14);
            assert_near(slope[0], 0, 1e-14);
            assert_near(slope[1], 0, 1e-14);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_faces_of_solids_are_the_regions),
        cmocka_unit_test(a_free_form_is_explained_by_few_regions),
        cmocka_unit_test(the_description_of_a_region_is_its_surface),
        cmocka_unit_test(noise_that_neighbours_share_is_no_shape),
        cmocka_unit_test(outliers_belong_to_no_region),
        cmocka_unit_test(size_turn_and_place_change_no_label),
        cmocka_unit_test(the_order_of_the_points_changes_no_label),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(what_makes_no_sense_is_refused),
        cmocka_unit_test(tiny_clouds_are_no_trouble),
        cmocka_unit_test(points_in_the_same_place_are_no_trouble),
        cmocka_unit_test(a_known_noise_is_taken),
        cmocka_unit_test(every_failed_allocation_is_reported),
        cmocka_unit_test(work_can_be_cancelled_at_any_time),
        cmocka_unit_test(slopes_of_patches_are_those_of_their_heights),
        cmocka_unit_test(splines_sum_to_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
