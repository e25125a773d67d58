/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Parts whose faces touch each other, which no intersection of surfaces finds: they follow the
 * topology of the points. */
#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */

#define given_model given_models_model /* both headers have one */
#include "given_models.h"
#undef given_model
#include "given_cad.h"

static const double S = 0.04;

/* A part of exact regions. */
typedef struct built {
    crease_context *context;
    crease_cloud *cloud;
    crease_regions *regions;
    crease_part *part;
} built;

static built build(const given_body *body, given_points points)
{
    built b = {.context = given_context_with_threads(1)};
    b.cloud = given_cloud_of(b.context, points.points, points.count);
    b.regions = given_regions(b.context, body, points, S, 0);
    b.regions->sizes = calloc(body->count, sizeof *b.regions->sizes);
    b.regions->labels_by_index = points.labels;
    for (size_t i = 0; i < points.count; i++)
        b.regions->sizes[points.labels[i]]++;
    if (crease_part_build(b.context, b.cloud, b.regions, NULL, NULL, &b.part) != CREASE_OK)
        fail_msg("%s", crease_context_message(b.context));
    return b;
}

static void end(built *b)
{
    crease_part_free(b->part);
    free(b->regions->sizes);
    given_regions_free(b->regions);
    crease_cloud_free(b->cloud);
    crease_context_free(b->context);
}

static given_points keep(given_points from, bool (*wanted)(const double *place, int32_t label))
{
    size_t kept = 0;
    for (size_t i = 0; i < from.count; i++)
        if (wanted(from.points + 3 * i, from.labels[i])) {
            memmove(from.points + 3 * kept, from.points + 3 * i, 3 * sizeof(double));
            from.labels[kept++] = from.labels[i];
        }
    from.count = kept;
    return from;
}

static void add(given_points *to, given_points from, int32_t label)
{
    for (size_t i = 0; i < from.count; i++)
        given_point(to, from.points + 3 * i, label < 0 ? from.labels[i] : label);
    free(from.points);
    free(from.labels);
}

static void then_solids(const built *b, size_t solids, size_t shells, size_t faces, double volume)
{
    crease_cad_info info;
    if (crease_part_state_of(b->part) != CREASE_PART_SOLID)
        fail_msg("%s", crease_part_message(b->part));
    assert_int_equal(crease_part_solid_count(b->part), solids);
    assert_int_equal(crease_part_face_count(b->part), faces);
    assert_near(crease_part_volume(b->part), volume, 1e-4 * volume);
    assert_int_equal(crease_part_write(b->context, b->part, in_folder("part.step")), CREASE_OK);
    assert_int_equal(crease_cad_info_read(b->context, in_folder("part.step"), &info), CREASE_OK);
    assert_true(info.valid);
    assert_int_equal(info.solids, solids);
    assert_int_equal(info.closed_shells, shells);
    assert_near(info.volume, volume, 1e-4 * volume);
}

static void then_solid(const built *b, size_t faces, size_t edges, size_t vertices, double volume)
{
    crease_cad_info info;
    if (crease_part_state_of(b->part) != CREASE_PART_SOLID)
        fail_msg("%s", crease_part_message(b->part));
    assert_int_equal(crease_part_face_count(b->part), faces);
    assert_near(crease_part_volume(b->part), volume, 1e-4 * volume);
    assert_int_equal(crease_part_write(b->context, b->part, in_folder("part.step")), CREASE_OK);
    assert_int_equal(crease_cad_info_read(b->context, in_folder("part.step"), &info), CREASE_OK);
    assert_true(info.valid);
    assert_int_equal(info.closed_shells, 1);
    assert_int_equal(info.free_edges, 0);
    assert_int_equal(info.faces, faces);
    assert_int_equal(info.edges, edges);
    assert_int_equal(info.vertices, vertices);
    assert_true(info.tolerance < 0.01 * S);
    assert_near(info.volume, volume, 1e-4 * volume);
}

static bool not_on_top(const double *p, int32_t label)
{
    return label != 1;
}

static bool upper_half(const double *p, int32_t label)
{
    return p[2] > 0.5;
}

/* Edges: a rim, a smooth ring, a seam of the rod and one of the sphere. */
static void given_dome_when_built_then_a_solid_of_three_faces(void **state)
{
    const double top[3] = {0, 0, 0.5}, z[3] = {0, 0, 1};
    given_body rod = given_rod(0.4, 0.5), ball = {.size = 1};
    given_points points = keep(given_sample(&rod, S, 0, 5), not_on_top);
    given_add(&ball, given_models_model(CREASE_REGION_SPHERE, top, z, 0.4, 0));
    add(&points, keep(given_sample(&ball, S, 0, 6), upper_half), 1);
    rod.models[1] = ball.models[0];
    built b = build(&rod, points);
    then_solid(&b, 3, 4, 3, acos(-1) * 0.16 * (1 + 2 * 0.4 / 3));
    end(&b);
}

static bool inside_slot(const double *p, int32_t label)
{
    return fabs(p[0]) < 0.4 || label > 3;
}

static bool round_end(const double *p, int32_t label)
{
    return fabs(p[0]) > 0.4;
}

/* A plate with half round ends: two planes and two cylinders that touch, top and bottom. */
static void given_slot_shaped_plate_when_built_then_a_solid_of_six_faces(void **state)
{
    const double z[3] = {0, 0, 1};
    const given_body box = given_box(0.4, 0.3, 0.2), rod = given_rod(0.3, 0.2);
    given_body plate = box;
    given_points points = {0, 0, NULL, NULL};
    add(&points, keep(given_sample(&box, S, 0, 5), inside_slot), -1);
    size_t kept = 0;
    for (size_t i = 0; i < points.count; i++) /* without the flat ends */
        if (points.labels[i] > 1) {
            memmove(points.points + 3 * kept, points.points + 3 * i, 3 * sizeof(double));
            points.labels[kept++] = points.labels[i];
        }
    points.count = kept;
    for (int side = 0; side < 2; side++) {
        const double middle[3] = {side ? 0.4 : -0.4, 0, 0};
        given_points end_points = given_sample(&rod, S, 0, 7 + (uint64_t)side);
        plate.models[side] = given_models_model(CREASE_REGION_CYLINDER, middle, z, 0.3, 0);
        for (size_t i = 0; i < end_points.count; i++) {
            end_points.points[3 * i] += middle[0];
            end_points.labels[i] = end_points.labels[i] == 0 ? side
                : end_points.labels[i] == 1                  ? 5
                                                             : 4;
            if (side ? end_points.points[3 * i] < 0.4 : end_points.points[3 * i] > -0.4)
                end_points.labels[i] = -1;
        }
        for (size_t i = 0; i < end_points.count; i++)
            if (end_points.labels[i] >= 0 && round_end(end_points.points + 3 * i, 0))
                given_point(&points, end_points.points + 3 * i, end_points.labels[i]);
        free(end_points.points);
        free(end_points.labels);
    }
    built b = build(&plate, points);
    then_solid(&b, 6, 12, 8, 0.4 * (0.8 * 0.6 + acos(-1) * 0.09));
    end(&b);
}

static void add_sphere(given_body *to, given_points *points, const double centre[3], double radius)
{
    const double z[3] = {0, 0, 1};
    const int32_t label = (int32_t)to->count;
    given_body ball = {.size = 1};
    const double origin[3] = {0, 0, 0};
    given_add(&ball, given_models_model(CREASE_REGION_SPHERE, origin, z, radius, 0));
    given_points on = given_sample(&ball, S, 0, 6);
    for (size_t i = 0; i < on.count; i++)
        for (int c = 0; c < 3; c++)
            on.points[3 * i + (size_t)c] += centre[c];
    add(points, on, label);
    given_add(to, given_models_model(CREASE_REGION_SPHERE, centre, z, radius, 0));
}

/* A box with a void in which a ball lies, and another ball beside it. */
static void given_bodies_apart_and_within_when_built_then_three_solids(void **state)
{
    const double middle[3] = {0, 0, 0}, beside[3] = {1.5, 0.2, 0.1};
    given_body all = given_box(0.7, 0.6, 0.65);
    given_points points = given_sample(&all, S, 0, 5);
    add_sphere(&all, &points, middle, 0.5);
    add_sphere(&all, &points, middle, 0.3);
    add_sphere(&all, &points, beside, 0.4);
    built b = build(&all, points);
    const double ball = 4.0 / 3.0 * acos(-1);
    then_solids(&b, 3, 4, 9, 8 * 0.7 * 0.6 * 0.65 + ball * (0.027 + 0.064 - 0.125));
    end(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_dome_when_built_then_a_solid_of_three_faces),
        cmocka_unit_test(given_slot_shaped_plate_when_built_then_a_solid_of_six_faces),
        cmocka_unit_test(given_bodies_apart_and_within_when_built_then_three_solids),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
