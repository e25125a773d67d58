/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Parts from points on bodies whose faces are known. */
#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */

#define given_model given_models_model /* both headers have one */
#include "given_models.h"
#undef given_model
#include "given_cad.h"

#include <limits.h>

typedef struct built {
    crease_context *context;
    crease_cloud *cloud;
    crease_regions *regions;
    crease_part *part;
} built;

/* Takes the points over. */
static built given_part_cloud(given_points from, int threads)
{
    built b = {.context = given_context_with_threads(threads)};
    b.cloud = given_cloud_of(b.context, from.points, from.count);
    free(from.points);
    free(from.labels);
    assert_int_equal(crease_regions_find(b.context, b.cloud, NULL, &b.regions), CREASE_OK);
    return b;
}

static void when_built(built *b, const crease_part_options *options)
{
    const crease_status status =
        crease_part_build(b->context, b->cloud, b->regions, NULL, options, &b->part);
    if (status != CREASE_OK)
        fail_msg("%d: %s", (int)status, crease_context_message(b->context));
}

static void free_built(built *b)
{
    crease_part_free(b->part);
    crease_regions_free(b->regions);
    crease_cloud_free(b->cloud);
    crease_context_free(b->context);
}

static built given_body_part(const given_body *body, double s, double sigma)
{
    built b = given_part_cloud(given_sample(body, s, sigma, 7), 2);
    when_built(&b, NULL);
    return b;
}

/* Points about s apart on a parallelogram. */
static void add_sheet(given_points *to, const double at[3], const double u[3], const double v[3],
    double s, uint64_t seed)
{
    const double lengths[2] = {crease_vector_length(u), crease_vector_length(v)};
    const size_t n[2] = {(size_t)ceil(lengths[0] / s), (size_t)ceil(lengths[1] / s)};
    for (size_t i = 0; i < n[0] * n[1]; i++) {
        const double a = ((double)(i / n[1]) + crease_random_uniform(seed, 1, i)) / (double)n[0];
        const double b = ((double)(i % n[1]) + crease_random_uniform(seed, 2, i)) / (double)n[1];
        double place[3];
        for (int c = 0; c < 3; c++)
            place[c] = at[c] + a * u[c] + b * v[c];
        given_point(to, place, 0);
    }
}

enum { MOST_CORNERS = 8 };

/* A body of depth 1 along y over an outline of x and z, and the rectangles (x, z, width, height)
 * that its ends consist of. */
typedef struct given_profile {
    int corners, rectangles;
    double outline[MOST_CORNERS][2], ends[3][4];
} given_profile;

/* A block of 2 x 1 x 1 with a step of 1 x 1 x 0.5 cut out of it: volume 1.5, 8 faces. */
static const given_profile step = {
    6, 2, {{0, 0}, {2, 0}, {2, 0.5}, {1, 0.5}, {1, 1}, {0, 1}}, {{0, 0, 2, 0.5}, {0, 0.5, 1, 0.5}}};
/* A block of 2 x 1 x 1 with a slot of 0.8 x 1 x 0.5: volume 1.6, 10 faces, two of them on one
 * plane. */
static const given_profile slot = {8, 3,
    {{0, 0}, {2, 0}, {2, 1}, {1.4, 1}, {1.4, 0.5}, {0.6, 0.5}, {0.6, 1}, {0, 1}},
    {{0, 0, 2, 0.5}, {0, 0.5, 0.6, 0.5}, {1.4, 0.5, 0.6, 0.5}}};

static given_points given_prism(const given_profile *of)
{
    given_points out = {0, 0, NULL, NULL};
    const double s = 0.06, depth[3] = {0, 1, 0};
    for (int i = 0; i < of->corners; i++) {
        const double *const a = of->outline[i], *const b = of->outline[(i + 1) % of->corners];
        add_sheet(&out, (double[]){a[0], 0, a[1]}, (double[]){b[0] - a[0], 0, b[1] - a[1]}, depth,
            s, (uint64_t)i);
    }
    for (int i = 0; i < 2 * of->rectangles; i++) {
        const double *const end = of->ends[i / 2];
        add_sheet(&out, (double[]){end[0], i % 2, end[1]}, (double[]){end[2], 0, 0},
            (double[]){0, 0, end[3]}, s, 10 + (uint64_t)i);
    }
    return out;
}

static void then_solid(const built *b, size_t faces, size_t edges, double volume, double within)
{
    if (crease_part_state_of(b->part) != CREASE_PART_SOLID)
        fail_msg("%s", crease_part_message(b->part));
    assert_string_equal(crease_part_message(b->part), "");
    assert_int_equal(crease_part_face_count(b->part), faces);
    assert_int_equal(crease_part_edge_count(b->part), edges);
    assert_near(crease_part_volume(b->part), volume, within);
}

static crease_cad_info when_part_written(const built *b, const char *name)
{
    crease_cad_info info;
    assert_int_equal(crease_part_write(b->context, b->part, in_folder(name)), CREASE_OK);
    assert_int_equal(crease_cad_info_read(b->context, in_folder(name), &info), CREASE_OK);
    return info;
}

static void then_written_part_is_closed(const built *b, const char *name)
{
    const crease_cad_info info = when_part_written(b, name);
    assert_true(info.valid);
    assert_int_equal(info.solids, 1);
    assert_int_equal(info.closed_shells, 1);
    assert_int_equal(info.free_edges, 0);
    assert_int_equal(info.faces, crease_part_face_count(b->part));
    assert_near(info.volume, crease_part_volume(b->part), 1e-9 * info.volume);
}

static void given_a_box_then_a_solid_with_its_faces_and_edges(void **state)
{
    const given_body box = given_box(1, 0.5, 0.75);
    built b = given_body_part(&box, 0.06, 0);
    then_solid(&b, 6, 12, 3.0, 1e-6);
    for (size_t e = 0; e < 12; e++) {
        const crease_part_edge edge = crease_part_edge_at(b.part, e);
        assert_near(edge.angle, 90.0, 1e-4);
        assert_false(edge.smooth);
        assert_true(edge.faces[0] < 6 && edge.faces[1] < 6 && edge.faces[0] != edge.faces[1]);
        const crease_curve *const curve = crease_part_curves(b.part)[e];
        double domain[2], ends[2][3];
        crease_curve_domain(curve, domain);
        for (int i = 0; i < 2; i++)
            crease_curve_evaluate(curve, domain[i], CREASE_SIDE_RIGHT, 0, ends[i]);
        assert_near(crease_vector_distance(ends[0], ends[1]), edge.length, 1e-9);
    }
    then_written_part_is_closed(&b, "box.step");
    then_written_part_is_closed(&b, "box.brep");
    free_built(&b);
}

static void given_a_box_then_faces_know_their_points(void **state)
{
    const given_body box = given_box(1, 0.5, 0.75);
    built b = given_body_part(&box, 0.06, 0);
    assert_ptr_equal(crease_part_regions(b.part), b.regions);
    double area = 0;
    size_t points = 0;
    for (size_t f = 0; f < crease_part_face_count(b.part); f++) {
        const crease_part_face face = crease_part_face_at(b.part, f);
        area += face.area;
        points += face.point_count;
        assert_true(face.most < 1e-6 && face.rms <= face.p95 && face.p95 <= face.most);
    }
    assert_near(area, 13.0, 1e-5);
    assert_int_equal(points, crease_cloud_count(b.cloud));
    const crease_mesh *const mesh = crease_part_mesh(b.part);
    assert_int_equal(crease_mesh_triangle_count(mesh), 12);
    const int32_t *const nearest = crease_part_nearest_faces(b.part);
    for (size_t i = 0; i < crease_cloud_count(b.cloud); i++) {
        assert_in_range(nearest[i], 0, 5);
        assert_near(crease_part_deviations(b.part)[i], 0, 1e-6);
    }
    free_built(&b);
}

static void given_a_noisy_box_far_away_then_a_solid_within_the_noise(void **state)
{
    const given_body box = given_box(1, 0.5, 0.75);
    given_points points = given_sample(&box, 0.06, 0.012, 7);
    for (size_t i = 0; i < 3 * points.count; i++)
        points.points[i] = 5e-3 * points.points[i] + 40.0;
    built b = given_part_cloud(points, 2);
    when_built(&b, NULL);
    then_solid(&b, 6, 12, 3.0 * 1.25e-7, 0.01 * 3.0 * 1.25e-7);
    const crease_part_face face = crease_part_face_at(b.part, 0);
    assert_near(face.rms, 5e-3 * 0.012, 5e-3 * 0.002);
    then_written_part_is_closed(&b, "far.step");
    free_built(&b);
}

static void given_a_step_then_one_edge_is_concave(void **state)
{
    built b = given_part_cloud(given_prism(&step), 2);
    when_built(&b, NULL);
    then_solid(&b, 8, 18, 1.5, 1e-5);
    size_t concave = 0;
    for (size_t e = 0; e < 18; e++)
        concave += crease_part_edge_at(b.part, e).angle > 180.0;
    assert_int_equal(concave, 1);
    then_written_part_is_closed(&b, "step.igs");
    free_built(&b);
}

static void given_lands_on_one_plane_then_they_share_it(void **state)
{
    built b = given_part_cloud(given_prism(&slot), 2);
    when_built(&b, NULL);
    then_solid(&b, 10, 24, 1.6, 0.005);
    assert_int_equal(crease_regions_count(b.regions), 10);
    size_t lands = 0;
    for (size_t f = 0; f < 10; f++)
        for (size_t g = 0; g < f; g++)
            lands += crease_part_face_at(b.part, f).region == crease_part_face_at(b.part, g).region;
    assert_int_equal(lands, 1);
    free_built(&b);
}

/* Of one wall of the slot no point is left, and half of the floor before it is in shadow. */
static void given_a_wall_in_shadow_then_its_neighbours_tell_where_it_is(void **state)
{
    given_points points = given_prism(&slot);
    size_t kept = 0;
    for (size_t i = 0; i < points.count; i++) {
        const double *const p = points.points + 3 * i;
        if (fabs(p[0] - 1.4) < 1e-9 || (p[0] > 1 && p[0] < 1.4 && fabs(p[2] - 0.5) < 1e-9))
            continue;
        memmove(points.points + 3 * kept++, p, 3 * sizeof *p);
    }
    points.count = kept;
    built b = given_part_cloud(points, 2);
    when_built(&b, NULL);
    then_solid(&b, 10, 24, 1.6, 0.01);
    const crease_regions *const used = crease_part_regions(b.part);
    assert_int_equal(crease_part_unseen_count(b.part), 1);
    assert_int_equal(crease_regions_count(b.regions), 9);
    assert_int_equal(crease_regions_count(used), 10);
    const crease_region wall = crease_regions_at(used, 9);
    assert_int_equal(wall.type, CREASE_REGION_PLANE);
    assert_int_equal(wall.point_count, 0);
    assert_near(fabs(wall.parameters[3]), 1, 1e-6);
    assert_near(wall.parameters[0], 1.4, 0.015);
    then_written_part_is_closed(&b, "shadow.step");
    free_built(&b);
}

static void given_a_rod_then_rims_and_a_seam(void **state)
{
    const given_body rod = given_rod(0.5, 1);
    built b = given_body_part(&rod, 0.06, 0.006);
    then_solid(&b, 3, 3, acos(-1) * 0.5, 0.02);
    size_t seams = 0;
    for (size_t e = 0; e < 3; e++) {
        const crease_part_edge edge = crease_part_edge_at(b.part, e);
        if (edge.faces[0] == edge.faces[1])
            seams += edge.smooth && edge.angle == 180.0;
        else
            assert_near(edge.length, acos(-1), 0.02);
    }
    assert_int_equal(seams, 1);
    then_written_part_is_closed(&b, "rod.step");
    free_built(&b);
}

static void given_a_pyramid_then_four_faces_meet_in_its_tip(void **state)
{
    const given_body pyramid = given_pyramid(4, 1);
    built exact = given_body_part(&pyramid, 0.06, 0);
    then_solid(&exact, 5, 8, 4.0 / 3.0, 1e-5);
    free_built(&exact);
    built noisy = given_body_part(&pyramid, 0.06, 0.006);
    assert_int_equal(crease_part_state_of(noisy.part), CREASE_PART_SOLID);
    assert_int_equal(crease_part_face_count(noisy.part), 5);
    then_written_part_is_closed(&noisy, "pyramid.step");
    free_built(&noisy);
}

static void given_bspline_faces_then_the_same_solid_of_splines(void **state)
{
    const given_body rod = given_rod(0.5, 1);
    built b = given_part_cloud(given_sample(&rod, 0.06, 0.006, 7), 2);
    crease_part_options options = crease_part_options_default();
    options.bspline_faces = true;
    when_built(&b, &options);
    assert_int_equal(crease_part_state_of(b.part), CREASE_PART_SOLID);
    const crease_cad_info info = when_part_written(&b, "splines.step");
    assert_true(info.valid);
    assert_int_equal(info.bspline_faces, 3);
    assert_near(info.volume, acos(-1) * 0.5, 0.02);
    free_built(&b);
}

/* A bent sheet: nothing closes. */
static void given_an_open_sheet_then_a_shell_and_the_reason(void **state)
{
    given_points points = {0, 0, NULL, NULL};
    const double corner[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    add_sheet(&points, corner, x, y, 0.04, 1);
    add_sheet(&points, corner, y, z, 0.04, 2);
    built b = given_part_cloud(points, 2);
    when_built(&b, NULL);
    if (crease_part_state_of(b.part) != CREASE_PART_SHELL)
        fail_msg("%s", crease_part_message(b.part));
    assert_int_equal(crease_part_face_count(b.part), 2);
    assert_true(crease_part_volume(b.part) == 0.0);
    size_t shared = 0, free_edges = 0;
    for (size_t e = 0; e < crease_part_edge_count(b.part); e++) {
        const crease_part_edge edge = crease_part_edge_at(b.part, e);
        if (edge.faces[1] == UINT32_MAX) {
            free_edges++;
            continue;
        }
        shared++;
        assert_near(edge.angle, 90, 1e-4);
        assert_near(edge.length, 1, 0.08);
    }
    assert_int_equal(shared, 1);
    char sentence[64];
    snprintf(sentence, sizeof sentence, "2 faces with %zu free edges", free_edges);
    assert_non_null(strstr(crease_part_message(b.part), sentence));
    const crease_cad_info info = when_part_written(&b, "sheet.step");
    assert_int_equal(info.solids, 0);
    assert_int_equal(info.faces, 2);
    assert_int_equal(info.sharp_edges, 1);
    free_built(&b);
}

static void given_one_plane_then_one_face(void **state)
{
    given_points points = {0, 0, NULL, NULL};
    add_sheet(&points, (double[]){0, 0, 0}, (double[]){1, 0, 0}, (double[]){0, 1, 1}, 0.05, 1);
    built b = given_part_cloud(points, 2);
    when_built(&b, NULL);
    assert_int_equal(crease_part_face_count(b.part), 1);
    assert_int_not_equal(crease_part_state_of(b.part), CREASE_PART_SOLID);
    assert_true(crease_part_message(b.part)[0] != 0);
    free_built(&b);
}

static void given_regions_of_another_cloud_then_a_sentence(void **state)
{
    const given_body box = given_box(1, 1, 1);
    built b = given_part_cloud(given_sample(&box, 0.2, 0, 7), 2);
    crease_cloud *other = NULL;
    const crease_cloud_parts parts = {.count = 1, .points = (double[]){0, 0, 0}};
    assert_int_equal(crease_cloud_create(b.context, &parts, &other), CREASE_OK);
    assert_int_equal(
        crease_part_build(b.context, other, b.regions, NULL, NULL, &b.part), CREASE_ERROR_ARGUMENT);
    assert_null(b.part);
    assert_non_null(strstr(crease_context_message(b.context), "find the regions of this cloud"));
    crease_cloud_free(other);
    free_built(&b);
}

static void given_an_unknown_extension_then_nothing_is_written(void **state)
{
    const given_body box = given_box(1, 1, 1);
    built b = given_body_part(&box, 0.2, 0);
    assert_int_equal(
        crease_part_write(b.context, b.part, in_folder("box.txt")), CREASE_ERROR_ARGUMENT);
    free_built(&b);
}

static void given_any_number_of_threads_then_the_same_bytes(void **state)
{
    const given_body rod = given_rod(0.5, 1);
    char *bytes[2];
    size_t sizes[2];
    for (int i = 0; i < 2; i++) {
        built b = given_part_cloud(given_sample(&rod, 0.08, 0.006, 7), 1 + 2 * i);
        when_built(&b, NULL);
        assert_int_equal(crease_part_write(b.context, b.part, in_folder("same.step")), CREASE_OK);
        sizes[i] = read_bytes(in_folder("same.step"), &bytes[i]);
        free_built(&b);
    }
    assert_int_equal(sizes[0], sizes[1]);
    assert_memory_equal(bytes[0], bytes[1], sizes[0]);
    free(bytes[0]);
    free(bytes[1]);
}

static void given_failing_allocations_then_the_build_fails_cleanly(void **state)
{
    const given_body box = given_box(1, 1, 1);
    built b = given_part_cloud(given_sample(&box, 0.2, 0, 7), 1);
    long n = 0;
    for (crease_status status = CREASE_ERROR_NO_MEMORY; status != CREASE_OK; n += 1 + n / 16) {
        crease_context_fail_allocation(b.context, n);
        status = crease_part_build(b.context, b.cloud, b.regions, NULL, NULL, &b.part);
        if (status != CREASE_OK)
            assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
        assert_true((status == CREASE_OK) == (b.part != NULL));
    }
    crease_context_fail_allocation(b.context, -1);
    assert_true(n > 10);
    free_built(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_box_then_a_solid_with_its_faces_and_edges),
        cmocka_unit_test(given_a_box_then_faces_know_their_points),
        cmocka_unit_test(given_a_noisy_box_far_away_then_a_solid_within_the_noise),
        cmocka_unit_test(given_a_step_then_one_edge_is_concave),
        cmocka_unit_test(given_lands_on_one_plane_then_they_share_it),
        cmocka_unit_test(given_a_wall_in_shadow_then_its_neighbours_tell_where_it_is),
        cmocka_unit_test(given_a_rod_then_rims_and_a_seam),
        cmocka_unit_test(given_a_pyramid_then_four_faces_meet_in_its_tip),
        cmocka_unit_test(given_bspline_faces_then_the_same_solid_of_splines),
        cmocka_unit_test(given_an_open_sheet_then_a_shell_and_the_reason),
        cmocka_unit_test(given_one_plane_then_one_face),
        cmocka_unit_test(given_regions_of_another_cloud_then_a_sentence),
        cmocka_unit_test(given_an_unknown_extension_then_nothing_is_written),
        cmocka_unit_test(given_any_number_of_threads_then_the_same_bytes),
        cmocka_unit_test(given_failing_allocations_then_the_build_fails_cleanly),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
