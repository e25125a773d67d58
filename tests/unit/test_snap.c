/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_faces.h"

#include "base/vector.h"
#include "snap/body.h"
#include "snap/cluster.h"
#include "snap/joint.h"

static const double x_axis[3] = {1, 0, 0}, y_axis[3] = {0, 1, 0};

static crease_regions *given_regions(crease_context *context, const struct faces *faces)
{
    crease_cloud *cloud = cloud_of(context, faces);
    crease_regions *regions = NULL;
    if (crease_regions_find(context, cloud, NULL, &regions) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    crease_cloud_free(cloud);
    return regions;
}

/* Snaps and returns how many items of a kind there are. */
static size_t count_of(const crease_regions *regions, crease_snap_kind kind)
{
    size_t count = 0;
    for (size_t i = 0; i < crease_regions_snap_count(regions); i++)
        count += crease_regions_snap_at(regions, i).kind == kind;
    return count;
}

static double worst_rms(const crease_regions *regions)
{
    double worst = 0;
    for (size_t i = 0; i < crease_regions_count(regions); i++)
        worst = fmax(worst, crease_regions_at(regions, i).rms);
    return worst;
}

static void move_from(struct faces *faces, size_t begin, const double by[3])
{
    for (size_t i = begin; i < faces->count; i++)
        for (size_t c = 0; c < 3; c++)
            faces->points[3 * i + c] += by[c];
}

/* -------------------------------------------------------------------------------------- bodies --
 */

static void the_sides_of_a_cube_become_exact(void **state)
{
    static const double sigmas[] = {0.0, 0.16, 0.5};
    crease_context *context = given_context();
    for (int s = 0; s < 3; s++) {
        struct faces faces = given_cube(0.04);
        add_noise(&faces, sigmas[s]);
        crease_regions *regions = given_regions(context, &faces);
        assert_int_equal(crease_regions_count(regions), 6);
        assert_int_equal(crease_regions_snap_count(regions), 0);
        const double before = worst_rms(regions);
        crease_region fitted[6];
        for (size_t i = 0; i < 6; i++)
            fitted[i] = crease_regions_at(regions, i);
        assert_int_equal(crease_regions_snap(context, regions), CREASE_OK);
        assert_int_equal(count_of(regions, CREASE_SNAP_PARALLEL), 3);
        assert_int_equal(count_of(regions, CREASE_SNAP_PERPENDICULAR), 3);
        for (size_t i = 0; i < 6; i++)
            for (size_t k = 0; k < i; k++) {
                const crease_region a = crease_regions_at(regions, i);
                const crease_region b = crease_regions_at(regions, k);
                const double cosine = fabs(crease_vector_dot(a.parameters + 3, b.parameters + 3));
                assert_near(cosine, cosine > 0.5 ? 1 : 0, 1e-13);
                assert_true(a.direction_error > 0 && a.direction_error < 1);
                assert_true(a.place_error > 0 && a.place_error < 0.01);
            }
        for (size_t i = 0; i < 6; i++) { /* what is known is what was known */
            const crease_region now = crease_regions_at(regions, i);
            assert_near(now.direction_error / fitted[i].direction_error, 1, 0.01);
            assert_near(now.place_error / fitted[i].place_error, 1, 0.01);
        }
        assert_true(worst_rms(regions) < 1.01 * before + 1e-5);
        crease_regions_free(regions);
        free_faces(&faces);
    }
    crease_context_free(context);
}

/* Two steps of a shaft, and their three discs. */
static struct faces given_shaft(void)
{
    const double root = sqrt(acos(-1.0));
    struct faces faces = given_faces(0.04);
    add_cylinder(&faces, 0.6, 0.8);
    const size_t begin = faces.count;
    add_face(&faces, map_cylinder, (double[]){0.35}, 2 * acos(-1.0) * 0.35, 0.9);
    add_face(&faces, map_disc, (double[]){0.35, 0.9}, root * 0.35, root * 0.35);
    move_from(&faces, begin, (double[]){0, 0, 0.8});
    return faces;
}

static void the_steps_of_a_shaft_become_coaxial(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_shaft();
    add_noise(&faces, 0.2);
    crease_regions *regions = given_regions(context, &faces);
    assert_int_equal(crease_regions_snap(context, regions), CREASE_OK);
    assert_int_equal(count_of(regions, CREASE_SNAP_PARALLEL), 1);
    assert_int_equal(count_of(regions, CREASE_SNAP_COAXIAL), 1);
    assert_int_equal(count_of(regions, CREASE_SNAP_EQUAL_RADII), 0);
    crease_region round[2];
    size_t count = 0;
    for (size_t i = 0; i < crease_regions_count(regions); i++) {
        const crease_region region = crease_regions_at(regions, i);
        if (region.type == CREASE_REGION_CYLINDER && count < 2)
            round[count++] = region;
    }
    assert_int_equal(count, 2);
    double d[3], beside[3];
    for (int c = 0; c < 3; c++)
        d[c] = round[1].parameters[c] - round[0].parameters[c];
    crease_vector_cross(d, round[0].parameters + 3, beside);
    assert_true(crease_vector_length(beside) < 1e-12);
    assert_near(crease_vector_length(d), 0.85, 0.1);
    assert_near(fmax(round[0].parameters[6], round[1].parameters[6]), 0.6, 0.002);
    assert_near(fmin(round[0].parameters[6], round[1].parameters[6]), 0.35, 0.002);
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

/* Pins beside each other on one plane. */
static void pins_of_one_radius_become_equal_and_others_do_not(void **state)
{
    static const double radii[] = {0.3, 0.33, 0.3};
    crease_context *context = given_context();
    struct faces faces = given_faces(0.03);
    for (int i = 0; i < 3; i++) {
        const size_t begin = faces.count;
        add_cylinder(&faces, radii[i], 0.6);
        move_from(&faces, begin, (double[]){1.5 * i, 0, 0});
    }
    add_noise(&faces, 0.2);
    crease_regions *regions = given_regions(context, &faces);
    assert_int_equal(crease_regions_snap(context, regions), CREASE_OK);
    assert_int_equal(count_of(regions, CREASE_SNAP_EQUAL_RADII), 1);
    assert_int_equal(count_of(regions, CREASE_SNAP_COAXIAL), 0);
    for (size_t i = 0; i < crease_regions_snap_count(regions); i++) {
        const crease_snap snap = crease_regions_snap_at(regions, i);
        if (snap.kind != CREASE_SNAP_EQUAL_RADII)
            continue;
        assert_int_equal(snap.region_count, 2);
        const crease_region a = crease_regions_at(regions, snap.regions[0]);
        const crease_region b = crease_regions_at(regions, snap.regions[1]);
        assert_true(a.parameters[6] == b.parameters[6]);
        assert_near(a.parameters[6], 0.3, 0.001);
    }
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

/* ------------------------------------------------------------------------------------ mirrors --
 */

/* A unit cube with a boss on top, its axis this far from the middle. */
static struct faces given_boss(double aside)
{
    const double root = sqrt(acos(-1.0));
    struct faces faces = given_cube(0.03);
    const size_t begin = faces.count;
    add_face(&faces, map_cylinder, (double[]){0.25}, 2 * acos(-1.0) * 0.25, 0.5);
    add_face(&faces, map_disc, (double[]){0.25, 0.5}, root * 0.25, root * 0.25);
    move_from(&faces, begin, (double[]){0.5 + aside, 0.5, 1});
    return faces;
}

/* How far the axis of the one cylinder is from the middle between the planes across a direction. */
static double off_middle(const crease_regions *regions, size_t along)
{
    double apart[3] = {0}, normal[3] = {0};
    int planes = 0, axes = 0;
    for (size_t i = 0; i < crease_regions_count(regions); i++) {
        const crease_region region = crease_regions_at(regions, i);
        const bool is_axis = region.type == CREASE_REGION_CYLINDER;
        const bool is_plane =
            region.type == CREASE_REGION_PLANE && fabs(region.parameters[3 + along]) > 0.9;
        for (size_t c = 0; c < 3; c++)
            apart[c] += (is_axis ? 1 : is_plane ? -0.5 : 0) * region.parameters[c];
        if (is_plane)
            memcpy(normal, region.parameters + 3, sizeof normal);
        planes += is_plane;
        axes += is_axis;
    }
    assert_int_equal(planes, 2);
    assert_int_equal(axes, 1);
    return fabs(crease_vector_dot(apart, normal));
}

static void a_boss_in_the_middle_is_made_so_and_one_beside_it_is_not(void **state)
{
    static const double asides[] = {0, 0.02}; /* the errors are some 0.001 */
    crease_context *context = given_context();
    for (int k = 0; k < 2; k++) {
        struct faces faces = given_boss(asides[k]);
        add_noise(&faces, 0.3);
        crease_regions *regions = given_regions(context, &faces);
        const double before = off_middle(regions, 1);
        assert_true(before > 1e-6 && before < 0.01);
        assert_int_equal(crease_regions_snap(context, regions), CREASE_OK);
        assert_int_equal(count_of(regions, CREASE_SNAP_SYMMETRIC), k == 0 ? 2 : 1);
        for (size_t i = 0; i < crease_regions_snap_count(regions); i++) {
            const crease_snap snap = crease_regions_snap_at(regions, i);
            if (snap.kind == CREASE_SNAP_SYMMETRIC)
                assert_int_equal(snap.region_count, 3);
        }
        assert_near(off_middle(regions, 1), 0, 1e-13);
        assert_near(off_middle(regions, 0), asides[k], k == 0 ? 1e-13 : 0.005);
        crease_regions_free(regions);
        free_faces(&faces);
    }
    crease_context_free(context);
}

/* A roof of two slopes over a floor, between two gables. */
static void the_slopes_of_a_roof_become_mirror_images(void **state)
{
    static const double turns[] = {0, 0.02}; /* radians; the errors are some 0.001 */
    const double slope = 0.6, floor_axis[3] = {0, 0, 1};
    crease_context *context = given_context();
    for (int k = 0; k < 2; k++) {
        const double other = slope + turns[k];
        struct faces faces = given_faces(0.03);
        add_rectangle(&faces, (double[]){-1, 0, 0}, x_axis, y_axis, 2, 1.5);
        add_rectangle(&faces, (double[]){-1, 0, 0.5}, (double[]){cos(slope), 0, sin(slope)}, y_axis,
            1.2, 1.5);
        add_rectangle(&faces, (double[]){1, 0, 0.5}, (double[]){-cos(other), 0, sin(other)}, y_axis,
            1.2, 1.5);
        add_rectangle(&faces, (double[]){-1, -0.5, -1}, x_axis, floor_axis, 2, 1);
        add_noise(&faces, 0.2);
        crease_regions *regions = given_regions(context, &faces);
        assert_int_equal(crease_regions_count(regions), 4);
        assert_int_equal(crease_regions_snap(context, regions), CREASE_OK);
        double cosines[2] = {0}, level[3] = {0};
        int found = 0;
        for (size_t i = 0; i < 4; i++) {
            const crease_region region = crease_regions_at(regions, i);
            if (fabs(region.parameters[5]) > 0.99)
                memcpy(level, region.parameters + 3, sizeof level);
        }
        for (size_t i = 0; i < 4; i++) {
            const crease_region region = crease_regions_at(regions, i);
            const double cosine = fabs(crease_vector_dot(region.parameters + 3, level));
            if (cosine > 0.5 && cosine < 0.99 && found < 2)
                cosines[found++] = cosine;
        }
        assert_int_equal(found, 2);
        assert_int_equal(count_of(regions, CREASE_SNAP_SYMMETRIC), k == 0 ? 1 : 0);
        if (k == 0)
            assert_near(cosines[0], cosines[1], 1e-13);
        else
            assert_true(fabs(cosines[0] - cosines[1]) > 0.005);
        crease_regions_free(regions);
        free_faces(&faces);
    }
    crease_context_free(context);
}

/* Values 1.0, 3.2 and 2.0 with variances 0.01, 0.03 and 0.02: the third in the middle. */
static void relations_move_values_by_what_is_known_of_them(void **state)
{
    static const double at[] = {1.0, 3.2, 2.0}, variance[] = {0.01, 0.03, 0.02};
    static const double middle[] = {0.5, 0.5, -1}, far_off[] = {1, -1, 0};
    crease_context *context = given_context();
    crease_joint joint;
    assert_int_equal(crease_joint_make(context, 3, &joint), CREASE_OK);
    for (int i = 0; i < 3; i++) {
        joint.at[i] = at[i];
        joint.covariance[4 * i] = variance[i];
    }
    assert_false(crease_joint_condition(&joint, far_off)); /* 2.2 of an error of 0.2 */
    assert_near(joint.at[0], 1.0, 0);
    assert_true(crease_joint_condition(&joint, middle));
    /* off by 0.1 with variance 0.0025 + 0.0075 + 0.02 = 0.03 */
    assert_near(joint.at[0], 1.0 - 0.1 * 0.005 / 0.03, 1e-15);
    assert_near(joint.at[1], 3.2 - 0.1 * 0.015 / 0.03, 1e-15);
    assert_near(joint.at[2], 2.0 + 0.1 * 0.02 / 0.03, 1e-15);
    assert_true(crease_joint_condition(&joint, middle)); /* met already */
    crease_joint_clear(&joint);
    crease_context_free(context);
}

static void what_is_clearly_not_so_stays(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_faces(0.02);
    const double tilt = 0.01; /* radians; the errors are some 0.0005 */
    add_rectangle(&faces, (double[]){0, 0, 0}, x_axis, y_axis, 1, 1);
    add_rectangle(&faces, (double[]){0, 0, 0}, (double[]){sin(tilt), 0, cos(tilt)}, y_axis, 1, 1);
    add_rectangle(&faces, (double[]){0, 0, 1}, (double[]){cos(tilt), 0, sin(tilt)}, y_axis, 1, 1);
    add_noise(&faces, 0.1);
    crease_regions *regions = given_regions(context, &faces);
    assert_int_equal(crease_regions_count(regions), 3);
    crease_region before[3];
    for (size_t i = 0; i < 3; i++)
        before[i] = crease_regions_at(regions, i);
    assert_int_equal(crease_regions_snap(context, regions), CREASE_OK);
    assert_int_equal(crease_regions_snap_count(regions), 0);
    for (size_t i = 0; i < 3; i++) {
        const crease_region after = crease_regions_at(regions, i);
        assert_memory_equal(before[i].parameters, after.parameters, sizeof after.parameters);
    }
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

static void snapping_again_changes_nothing(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_shaft();
    add_noise(&faces, 0.2);
    crease_regions *regions = given_regions(context, &faces);
    assert_int_equal(crease_regions_snap(context, regions), CREASE_OK);
    const size_t count = crease_regions_snap_count(regions);
    crease_region before[8];
    for (size_t i = 0; i < crease_regions_count(regions); i++)
        before[i] = crease_regions_at(regions, i);
    assert_int_equal(crease_regions_snap(context, regions), CREASE_OK);
    assert_int_equal(crease_regions_snap_count(regions), count);
    for (size_t i = 0; i < crease_regions_count(regions); i++) {
        const crease_region after = crease_regions_at(regions, i);
        for (size_t k = 0; k < after.parameter_count; k++)
            assert_near(after.parameters[k], before[i].parameters[k], 1e-9);
    }
    crease_regions_free(regions);
    free_faces(&faces);
    crease_context_free(context);
}

/* -------------------------------------------------------------------------------------- values --
 */

static bool listed_value(void *user, size_t item, size_t leader, crease_value *out)
{
    (void)leader;
    *out = ((const crease_value *)user)[item];
    return true;
}

static void values_within_their_errors_are_one(void **state)
{
    crease_value values[] = {{{1.00, 0}, {0.01, 0, 0}}, {{1.15, 0}, {0.01, 0, 0}},
        {{2.00, 0}, {0.01, 0, 0}}, {{1.05, 0}, {0.0001, 0, 0}}, {{9, 0}, {0, 0, 0}}};
    crease_context *context = given_context();
    crease_clusters found;
    assert_int_equal(crease_clusters_find(context, 5, 1, listed_value, values, &found), CREASE_OK);
    assert_true(found.of[0] == found.of[3] && found.of[1] == found.of[3]);
    assert_true(found.of[2] != found.of[3] && found.of[2] >= 0);
    const crease_cluster *const all = &found.items[found.of[3]];
    assert_int_equal(all->size, 3);
    /* weights 100, 100, 10000 */
    assert_near(all->mean.at[0], (100 * 1.00 + 100 * 1.15 + 1e4 * 1.05) / 10200, 1e-12);
    assert_near(all->mean.covariance[0], 1 / 10200.0, 1e-12);
    crease_clusters_clear(&found);
    crease_context_free(context);
}

/* A sphere whose height and radius are correlated: with the height given, the radius follows. */
static void conditions_carry_the_rest_along(void **state)
{
    crease_model sphere = {.type = CREASE_REGION_SPHERE, .radius = 2};
    sphere.axes[0] = sphere.axes[4] = sphere.axes[8] = 1;
    for (int k = 0; k < 8; k++) /* variances 1; lower triangle, row by row */
        sphere.covariance[k * (k + 1) / 2 + k] = 1;
    sphere.covariance[6 * 7 / 2 + 2] = 0.5;
    crease_body body = crease_body_of(&sphere);
    double along[1][3] = {{0, 0, 1}};
    const crease_functions moves = crease_body_moves(&body, 1, along);
    assert_true(crease_body_condition(&body, &moves, (double[]){0.2, 0}));
    assert_near(body.model.centre[2], 0.2, 1e-15);
    assert_near(body.model.radius, 2.1, 1e-15);
    assert_near(body.covariance[6 * 8 + 6], 0.75, 1e-15);
    assert_near(body.covariance[2 * 8 + 2], 0, 1e-15);
    assert_false(crease_body_condition(&body, &moves, (double[]){0.2, 0}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sides_of_a_cube_become_exact),
        cmocka_unit_test(the_steps_of_a_shaft_become_coaxial),
        cmocka_unit_test(pins_of_one_radius_become_equal_and_others_do_not),
        cmocka_unit_test(a_boss_in_the_middle_is_made_so_and_one_beside_it_is_not),
        cmocka_unit_test(the_slopes_of_a_roof_become_mirror_images),
        cmocka_unit_test(relations_move_values_by_what_is_known_of_them),
        cmocka_unit_test(what_is_clearly_not_so_stays),
        cmocka_unit_test(snapping_again_changes_nothing),
        cmocka_unit_test(values_within_their_errors_are_one),
        cmocka_unit_test(conditions_carry_the_rest_along),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
