/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_faces.h"

#include "base/vector.h"
#include "primitive/rolling.h"
#include "segment/region.h"

static const double y_axis[3] = {0, 1, 0};
static const double SPACING = 0.04;

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

/* ------------------------------------------------------------------------------------ shapes -- */

/* Takes out the points of the last face that are beyond a rounded edge x = z = 1, for y up to the
 * end; on the box's faces only those that the fillet itself replaces. */
static void cut_edge(struct faces *faces, size_t begin, double radius, double end)
{
    size_t kept = begin;
    for (size_t i = begin; i < faces->count; i++) {
        const double *const p = faces->points + 3 * i;
        const double x = p[0] - (1 - radius), z = p[2] - (1 - radius);
        const bool gone = p[1] < end && x > 0 && z > 0 && hypot(x, z) > radius;
        if (gone)
            continue;
        memmove(faces->points + 3 * kept, p, 3 * sizeof *p);
        faces->face[kept++] = faces->face[i];
    }
    faces->count = kept;
}

/* shape: radius; about the axis x = z = 1 - radius, from the top to the side. */
static void map_arc(const double *shape, double s, double t, double out[3])
{
    out[0] = 1 - shape[0] + shape[0] * sin(s / shape[0]);
    out[1] = t;
    out[2] = 1 - shape[0] + shape[0] * cos(s / shape[0]);
}

/* The unit cube, the edge x = z = 1 rounded for y from 0 to the end: when that is below 1, a wall
 * closes the fillet there and the edge goes on sharp. */
static struct faces given_rounded(double spacing, double radius, double end)
{
    struct faces faces = given_cube(spacing);
    const double x_axis[3] = {1, 0, 0}, z_axis[3] = {0, 0, 1};
    cut_edge(&faces, 0, radius, end >= 1 ? 2 : end);
    add_face(&faces, map_arc, &radius, radius * acos(-1.0) / 2, end);
    if (end < 1) {
        const size_t begin = faces.count;
        add_rectangle(
            &faces, (double[]){1 - radius, end, 1 - radius}, x_axis, z_axis, radius, radius);
        size_t kept = begin;
        for (size_t i = begin; i < faces.count; i++) {
            double *const p = faces.points + 3 * i;
            if (hypot(p[0] - 1 + radius, p[2] - 1 + radius) < radius)
                continue;
            memmove(faces.points + 3 * kept++, p, 3 * sizeof *p);
        }
        faces.count = kept;
    }
    return faces;
}

/* The unit cube with the edge x = z = 1 cut off. */
static struct faces given_chamfered(double leg)
{
    struct faces faces = given_cube(SPACING);
    const double root = sqrt(0.5);
    size_t kept = 0;
    for (size_t i = 0; i < faces.count; i++) {
        const double *const p = faces.points + 3 * i;
        if (p[0] + p[2] > 2 - leg)
            continue;
        memmove(faces.points + 3 * kept, p, 3 * sizeof *p);
        faces.face[kept++] = faces.face[i];
    }
    faces.count = kept;
    add_rectangle(
        &faces, (double[]){1 - leg, 0, 1}, (double[]){root, 0, -root}, y_axis, leg / root, 1);
    return faces;
}

/* Two squares under an angle, a fillet between them, along y; an open sheet. */
static struct faces given_bend(double angle, double radius)
{
    struct faces faces = given_faces(SPACING);
    const double turn = acos(-1.0) - angle, half = 0.5 * turn;
    for (int side = -1; side <= 1; side += 2) {
        const double foot[3] = {side * radius * sin(half), 0, radius * cos(half)};
        add_rectangle(&faces, foot, (double[]){side * cos(half), 0, -sin(half)}, y_axis, 1, 1);
    }
    const size_t begin = faces.count;
    add_face(&faces, map_arc, &radius, radius * turn, 1);
    for (size_t i = begin; i < faces.count; i++) {
        double *const p = faces.points + 3 * i;
        const double x = p[0] - 1 + radius, z = p[2] - 1 + radius;
        p[0] = cos(half) * x - sin(half) * z;
        p[2] = sin(half) * x + cos(half) * z;
    }
    return faces;
}

/* ----------------------------------------------------------------------------------- fillets -- */

static size_t count_fillets(const crease_regions *regions, crease_region *last)
{
    size_t count = 0;
    for (size_t r = 0; r < crease_regions_count(regions); r++) {
        const crease_region region = crease_regions_at(regions, r);
        assert_true((region.tangent[0] < 0) == (region.tangent[1] < 0));
        if (region.tangent[0] < 0)
            continue;
        *last = region;
        count++;
    }
    return count;
}

static void assert_tangent(const crease_regions *regions, const crease_region *fillet)
{
    assert_int_equal(fillet->type, CREASE_REGION_CYLINDER);
    assert_true(fillet->tangent[0] != fillet->tangent[1]);
    for (int i = 0; i < 2; i++) {
        const crease_region plane = crease_regions_at(regions, (size_t)fillet->tangent[i]);
        double gradient[3];
        assert_int_equal(plane.type, CREASE_REGION_PLANE);
        assert_near(fabs(crease_regions_distance(
                        regions, (size_t)fillet->tangent[i], fillet->parameters, gradient)),
            fillet->parameters[6], 1e-9);
        assert_near(crease_vector_dot(gradient, fillet->parameters + 3), 0, 1e-9);
    }
}

static void a_rounded_edge_is_an_exactly_tangent_cylinder(void **state)
{
    static const double sigmas[] = {0, 0.16, 0.32, 0.64}, tolerances[] = {1e-3, 0.02, 0.04, 0.08};
    crease_context *context = given_context();
    for (int i = 0; i < 4; i++) {
        const double radius = i % 2 ? 0.3 : 0.25;
        struct faces faces = given_rounded(SPACING, radius, 1);
        add_noise(&faces, sigmas[i]);
        crease_regions *regions = given_regions(context, &faces);
        crease_region fillet;
        if ((i < 3 && crease_regions_count(regions) != 7) || count_fillets(regions, &fillet) != 1)
            fail_msg("noise %g: %zu regions", sigmas[i], crease_regions_count(regions));
        assert_tangent(regions, &fillet);
        assert_int_equal(crease_regions_snap(context, regions), CREASE_OK);
        assert_int_equal(count_fillets(regions, &fillet), 1);
        assert_tangent(regions, &fillet); /* still, as its planes have moved */
        if (fabs(fillet.parameters[6] / radius - 1) > tolerances[i])
            fail_msg("noise %g: radius %g for %g", sigmas[i], fillet.parameters[6], radius);
        crease_regions_free(regions);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void bends_of_any_angle_are_found(void **state)
{
    static const double angles[] = {50, 120, 140};
    crease_context *context = given_context();
    for (int i = 0; i < 3; i++)
        for (int noisy = 0; noisy < (angles[i] < 130 ? 2 : 1); noisy++) {
            struct faces faces = given_bend(angles[i] * acos(-1.0) / 180, 0.3);
            add_noise(&faces, noisy ? 0.3 : 0);
            crease_regions *regions = given_regions(context, &faces);
            crease_region fillet;
            if (crease_regions_count(regions) != 3 || count_fillets(regions, &fillet) != 1)
                fail_msg(
                    "%g degrees, %d: %zu regions", angles[i], noisy, crease_regions_count(regions));
            assert_tangent(regions, &fillet);
            assert_near(fillet.parameters[6], 0.3, noisy ? 0.015 : 1e-4);
            crease_regions_free(regions);
            free_faces(&faces);
        }
    crease_context_free(context);
}

static void a_fillet_ends_where_the_edge_becomes_sharp(void **state)
{
    static const double sigmas[] = {0, 0.16, 0.32};
    crease_context *context = given_context();
    for (int i = 0; i < 3; i++) {
        struct faces faces = given_rounded(SPACING, 0.3, 0.6);
        add_noise(&faces, sigmas[i]);
        crease_regions *regions = given_regions(context, &faces);
        crease_region fillet;
        if (count_fillets(regions, &fillet) != 1)
            fail_msg("noise %g: %zu regions", sigmas[i], crease_regions_count(regions));
        assert_tangent(regions, &fillet);
        assert_near(fillet.parameters[6], 0.3, 0.01);
        const int32_t *const labels = crease_regions_labels(regions);
        size_t beyond = 0, on = 0;
        for (size_t r = 0; r < crease_regions_count(regions); r++)
            if (crease_regions_at(regions, r).tangent[0] >= 0)
                for (size_t k = 0; k < faces.count; k++) {
                    on += labels[k] == (int32_t)r;
                    beyond +=
                        labels[k] == (int32_t)r && faces.points[3 * k + 1] > 0.6 + 4 * SPACING;
                }
        assert_true(on > 150);
        assert_int_equal(beyond, 0);
        crease_regions_free(regions);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void a_chamfer_stays_a_plane(void **state)
{
    static const double sigmas[] = {0, 0.16, 0.32};
    crease_context *context = given_context();
    for (int i = 0; i < 3; i++) {
        struct faces faces = given_chamfered(0.3);
        add_noise(&faces, sigmas[i]);
        crease_regions *regions = given_regions(context, &faces);
        crease_region fillet;
        assert_int_equal(crease_regions_count(regions), 7);
        assert_int_equal(count_fillets(regions, &fillet), 0);
        for (size_t r = 0; r < 7; r++)
            assert_int_equal(crease_regions_at(regions, r).type, CREASE_REGION_PLANE);
        crease_regions_free(regions);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void a_sharp_edge_gets_no_fillet(void **state)
{
    static const double sigmas[] = {0, 0.32, 0.64};
    crease_context *context = given_context();
    for (int i = 0; i < 3; i++) {
        struct faces faces = given_cube(SPACING);
        add_noise(&faces, sigmas[i]);
        crease_regions *regions = given_regions(context, &faces);
        crease_region fillet;
        assert_int_equal(crease_regions_count(regions), 6);
        assert_int_equal(count_fillets(regions, &fillet), 0);
        crease_regions_free(regions);
        free_faces(&faces);
    }
    crease_context_free(context);
}

static void threads_do_not_change_a_bit(void **state)
{
    struct faces faces = given_rounded(SPACING, 0.3, 1);
    add_noise(&faces, 0.64);
    crease_regions *first = NULL;
    for (int threads = 1; threads <= 4; threads += 3) {
        crease_context *context = given_context_with_threads(threads);
        crease_regions *regions = given_regions(context, &faces);
        if (first) {
            assert_int_equal(crease_regions_count(first), crease_regions_count(regions));
            assert_memory_equal(crease_regions_labels(first), crease_regions_labels(regions),
                faces.count * sizeof(int32_t));
            for (size_t r = 0; r < crease_regions_count(first); r++) {
                const crease_region a = crease_regions_at(first, r);
                const crease_region b = crease_regions_at(regions, r);
                assert_memory_equal(a.parameters, b.parameters, sizeof a.parameters);
                assert_memory_equal(a.tangent, b.tangent, sizeof a.tangent);
            }
            crease_regions_free(regions);
        } else {
            first = regions;
        }
        crease_context_free(context);
    }
    crease_regions_free(first);
    free_faces(&faces);
}

static void every_failed_allocation_is_reported(void **state)
{
    crease_context *context = given_context();
    struct faces faces = given_rounded(0.09, 0.4, 1);
    crease_cloud *cloud = cloud_of(context, &faces);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    for (long n = 0; status != CREASE_OK; n += 1 + n / 8) {
        crease_regions *regions = NULL;
        crease_context_fail_allocation(context, n);
        status = crease_regions_find(context, cloud, NULL, &regions);
        crease_context_fail_allocation(context, -1);
        assert_true(status == CREASE_OK || (status == CREASE_ERROR_NO_MEMORY && !regions));
        crease_region fillet;
        if (regions)
            assert_int_equal(count_fillets(regions, &fillet), 1);
        crease_regions_free(regions);
    }
    crease_cloud_free(cloud);
    free_faces(&faces);
    crease_context_free(context);
}

/* -------------------------------------------------------------------------------- the profile --
 */

static crease_model given_plane(double x, double y, double z, double offset)
{
    crease_model plane = {.type = CREASE_REGION_PLANE, .axes = {[6] = x, y, z}};
    crease_vector_normalise(plane.axes + 6);
    for (int c = 0; c < 3; c++)
        plane.centre[c] = offset * plane.axes[6 + c];
    return plane;
}

static void the_ball_touches_both_planes(void **state)
{
    const crease_model a = given_plane(1, 2, 0.5, 3), b = given_plane(-2, 0.3, 1, -1);
    const crease_model *const planes[2] = {&a, &b};
    for (int side = 0; side < 4; side++) {
        const double between[3] = {side & 1 ? 20 : -20, side & 2 ? 15 : -15, 1};
        crease_wedge wedge;
        crease_model ball;
        double gradient[3];
        assert_true(crease_wedge_make(planes, between, &wedge));
        crease_rolling_cylinder(&wedge, 0.7, between, &ball);
        for (int i = 0; i < 2; i++) {
            assert_near(fabs(crease_model_distance(planes[i], ball.centre, gradient)), 0.7, 1e-12);
            assert_near(crease_vector_dot(gradient, ball.axes + 6), 0, 1e-12);
            const double here = crease_model_distance(planes[i], ball.centre, gradient);
            assert_true((here > 0) == (crease_model_distance(planes[i], between, gradient) > 0));
        }
        const double d[3] = {
            between[0] - ball.centre[0], between[1] - ball.centre[1], between[2] - ball.centre[2]};
        assert_near(crease_vector_dot(d, wedge.along), 0, 1e-9);
    }
    assert_false(crease_wedge_make(
        (const crease_model *const[]){&a, &a}, y_axis, &(crease_wedge){.cosine = 0}));
}

static void the_profile_is_plane_arc_plane(void **state)
{
    const crease_model a = given_plane(1, 0, 0, 0), b = given_plane(0, 0, 1, 0);
    const crease_model *const planes[2] = {&a, &b};
    const double between[3] = {1, 1, 1}, root = sqrt(0.5);
    crease_rolling_part part;
    crease_wedge wedge;
    assert_true(crease_wedge_make(planes, between, &wedge));
    assert_near(crease_wedge_touch(&wedge), 1, 1e-12);
    crease_section at = crease_wedge_section(&wedge, (double[]){0.1, 5, 3});
    assert_near(at.height[0], 0.1, 1e-12);
    assert_near(crease_wedge_away(&wedge, at), hypot(0.1, 3), 1e-12);
    assert_near(crease_rolling_distance(&wedge, 2, at, &part), 0.1, 1e-12);
    assert_int_equal(part, CREASE_ROLLING_FIRST);
    at = crease_wedge_section(&wedge, (double[]){3, 5, -0.2});
    assert_near(crease_rolling_distance(&wedge, 2, at, &part), 0.2, 1e-12);
    assert_int_equal(part, CREASE_ROLLING_SECOND);
    at = crease_wedge_section(&wedge, (double[]){0, 5, 0});
    assert_near(crease_rolling_distance(&wedge, 2, at, &part), 2 / root - 2, 1e-12);
    assert_int_equal(part, CREASE_ROLLING_ARC);
    assert_near(crease_rolling_distance(&wedge, 0, at, &part), 0, 1e-12);
    at = crease_wedge_section(&wedge, (double[]){2.5, 5, 2.2});
    assert_near(crease_rolling_distance(&wedge, 2, at, &part), 2.2, 1e-12);
    assert_int_equal(part, CREASE_ROLLING_SECOND);
}

/* The cost of many places is the sum of what the distances of each say, for any number of places,
 * sharp and blunt wedges, and radii from none to some that reach beyond the places. */
static void the_cost_of_a_profile_is_that_of_its_distances(void **state)
{
    enum { COUNT = 43 };
    const crease_model plane = given_plane(0, 0, 1, 0);
    const crease_model others[] = {
        given_plane(1, 0, 0, 0), given_plane(1, 0, 0.9, 0.2), given_plane(1, 0.3, -0.8, -0.1)};
    const double between[3] = {2, 0, 1}, sigma = 0.3, most = 9;
    for (size_t o = 0; o < sizeof others / sizeof *others; o++) {
        const crease_model *const planes[2] = {&plane, &others[o]};
        double heights[2][COUNT], cost = 0;
        crease_wedge wedge;
        crease_rolling_part part;
        assert_true(crease_wedge_make(planes, between, &wedge));
        for (int r = 0; r < 5; r++, cost = 0)
            for (size_t i = 0; i < COUNT; i++) {
                const double radius = 0.8 * r, t = (double)i;
                const double place[3] = {3 * sin(t), 2 * cos(2 * t), 3 * cos(t)};
                const crease_section at = crease_wedge_section(&wedge, place);
                const double d = crease_rolling_distance(&wedge, radius, at, &part) / sigma;
                heights[0][i] = at.height[0];
                heights[1][i] = at.height[1];
                cost += fmin(d * d, most);
                assert_near(
                    crease_rolling_cost(&wedge, radius, heights[0], heights[1], i + 1, sigma, most),
                    cost, 1e-9 * (1 + cost));
            }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rounded_edge_is_an_exactly_tangent_cylinder),
        cmocka_unit_test(bends_of_any_angle_are_found),
        cmocka_unit_test(a_fillet_ends_where_the_edge_becomes_sharp),
        cmocka_unit_test(a_chamfer_stays_a_plane),
        cmocka_unit_test(a_sharp_edge_gets_no_fillet),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(every_failed_allocation_is_reported),
        cmocka_unit_test(the_ball_touches_both_planes),
        cmocka_unit_test(the_profile_is_plane_arc_plane),
        cmocka_unit_test(the_cost_of_a_profile_is_that_of_its_distances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
