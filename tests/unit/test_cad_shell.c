/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Open shells from points on a few faces whose borders are known. */
#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */

#define given_model given_models_model /* both headers have one */
#include "given_models.h"
#undef given_model
#include "given_cad.h"

typedef struct built {
    crease_context *context;
    crease_cloud *cloud;
    crease_regions *regions;
    crease_part *part;
} built;

enum { MOST_PLACES = 30000 };

typedef struct places {
    size_t count;
    double (*points)[3];
} places;

static places given_places(void)
{
    places out = {0, malloc(MOST_PLACES * sizeof *out.points)};
    assert_non_null(out.points);
    return out;
}

/* One random point in each cell of side s on a parallelogram, where `there` holds, if given. */
static void add_parallelogram(places *to, const double at[3], const double u[3], const double v[3],
    double s, bool (*there)(double a, double b))
{
    const size_t n = (size_t)ceil(crease_vector_length(u) / s);
    const size_t m = (size_t)ceil(crease_vector_length(v) / s);
    for (size_t i = 0; i < n * m; i++) {
        const double a = ((double)(i / m) + crease_random_uniform(1, 1, to->count + i)) / (double)n;
        const double b = ((double)(i % m) + crease_random_uniform(1, 2, to->count + i)) / (double)m;
        if (there && !there(a, b))
            continue;
        assert_true(to->count < MOST_PLACES);
        for (int c = 0; c < 3; c++)
            to->points[to->count][c] = at[c] + a * u[c] + b * v[c];
        to->count++;
    }
}

static void add_noise(places *to, double sigma)
{
    for (size_t i = 0; i < to->count; i++)
        for (size_t c = 0; c < 3; c++)
            to->points[i][c] += sigma * crease_random_normal(2, 1, 3 * i + c);
}

/* Takes the places over. */
static built when_built(places from)
{
    built b = {.context = given_context_with_threads(2)};
    const crease_cloud_parts parts = {.count = from.count, .points = from.points[0]};
    crease_part_options options = crease_part_options_default();
    options.open = true;
    assert_int_equal(crease_cloud_create(b.context, &parts, &b.cloud), CREASE_OK);
    free(from.points);
    assert_int_equal(crease_regions_find(b.context, b.cloud, NULL, &b.regions), CREASE_OK);
    const crease_status status =
        crease_part_build(b.context, b.cloud, b.regions, NULL, &options, &b.part);
    if (status != CREASE_OK)
        fail_msg("%d: %s", (int)status, crease_context_message(b.context));
    return b;
}

static void free_built(built *b)
{
    crease_part_free(b->part);
    crease_regions_free(b->regions);
    crease_cloud_free(b->cloud);
    crease_context_free(b->context);
}

/* Free edges run along the border only: everything else is shared by two faces. */
static void then_shell(
    built *b, size_t faces, size_t sharp, size_t rims, double area, double within)
{
    if (crease_part_state_of(b->part) != CREASE_PART_SHELL)
        fail_msg("%s", crease_part_message(b->part));
    assert_int_equal(crease_part_face_count(b->part), faces);
    assert_int_equal(crease_part_edge_count(b->part), sharp + rims);
    double sum = 0.0;
    for (size_t f = 0; f < faces; f++)
        sum += crease_part_face_at(b->part, f).area;
    assert_near(sum, area, within);
    crease_cad_info info;
    assert_int_equal(crease_part_write(b->context, b->part, in_folder("shell.step")), CREASE_OK);
    assert_int_equal(crease_cad_info_read(b->context, in_folder("shell.step"), &info), CREASE_OK);
    assert_true(info.valid);
    assert_int_equal(info.solids, 0);
    assert_int_equal(info.shells, 1);
    assert_int_equal(info.faces, faces);
    assert_int_equal(info.free_edges, rims);
    assert_int_equal(info.sharp_edges, sharp);
}

static bool below_diagonal(double a, double b)
{
    return a + b < 1.0;
}

/* Four planes that meet in a point inside, open below. */
static places given_roof(double s)
{
    places out = given_places();
    const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (int i = 0; i < 4; i++) {
        const double *const a = corners[i], *const b = corners[(i + 1) % 4];
        add_parallelogram(&out, a, (double[]){b[0] - a[0], b[1] - a[1], 0},
            (double[]){0.5 - a[0], 0.5 - a[1], 0.4}, s, below_diagonal);
    }
    return out;
}

static void given_a_pyramid_then_four_faces_that_meet_in_its_top(void **state)
{
    (void)state;
    built b = when_built(given_roof(0.025));
    then_shell(&b, 4, 4, 4, 4 * 0.5 * hypot(0.5, 0.4), 0.02);
    for (size_t e = 0; e < 8; e++) {
        const crease_part_edge edge = crease_part_edge_at(b.part, e);
        const double length = edge.faces[1] == UINT32_MAX ? 1.0 : sqrt(0.66);
        assert_near(edge.length, length, 0.03);
    }
    free_built(&b);
}

static void given_noise_then_the_same_faces_within_it(void **state)
{
    (void)state;
    places noisy = given_roof(0.025);
    add_noise(&noisy, 0.005);
    built b = when_built(noisy);
    then_shell(&b, 4, 4, 4, 4 * 0.5 * hypot(0.5, 0.4), 0.05);
    for (size_t f = 0; f < 4; f++)
        assert_near(crease_part_face_at(b.part, f).rms, 0.005, 0.001);
    free_built(&b);
}

static void given_a_panel_folded_by_120_degrees_then_two_faces(void **state)
{
    (void)state;
    places folded = given_places();
    const double across[3] = {1, 0, 0};
    add_parallelogram(&folded, (double[]){0, 0, 0}, across, (double[]){0, 1, 0}, 0.03, NULL);
    add_parallelogram(
        &folded, (double[]){0, 0, 0}, across, (double[]){0, 0.5, sqrt(0.75)}, 0.03, NULL);
    built b = when_built(folded);
    then_shell(&b, 2, 1, 6, 2.0, 0.04);
    free_built(&b);
}

/* A corner of a box, seen from inside. */
static void given_three_planes_then_creases_that_meet_inside(void **state)
{
    (void)state;
    places box = given_places();
    const double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; i++)
        add_parallelogram(&box, (double[]){0, 0, 0}, axes[i], axes[(i + 1) % 3], 0.03, NULL);
    built b = when_built(box);
    then_shell(&b, 3, 3, 6, 3.0, 0.04);
    free_built(&b);
}

static bool beside_holes(double a, double b)
{
    return hypot(a - 0.3, b - 0.5) > 0.15 && (fabs(a - 0.7) > 0.12 || fabs(b - 0.5) > 0.2);
}

static void given_a_panel_with_holes_then_a_face_with_them(void **state)
{
    (void)state;
    places panel = given_places();
    add_parallelogram(&panel, (double[]){0, 0, 0}, (double[]){1, 0, 0}, (double[]){0, 1, 0}, 0.0125,
        beside_holes);
    built b = when_built(panel);
    then_shell(&b, 1, 0, 4 + 1 + 4, 1.0 - 0.0225 * 3.14159265 - 0.24 * 0.4, 0.015);
    free_built(&b);
}

static void given_a_rolled_sheet_then_a_cylinder_with_two_rims(void **state)
{
    (void)state;
    places pipe = given_places();
    for (uint64_t i = 0; i < 160 * 50; i++) {
        const double angle = 0.039269908 * ((double)(i / 50) + crease_random_uniform(5, 1, i));
        pipe.points[pipe.count][0] = cos(angle);
        pipe.points[pipe.count][1] = sin(angle);
        pipe.points[pipe.count++][2] = 0.04 * ((double)(i % 50) + crease_random_uniform(5, 2, i));
    }
    built b = when_built(pipe);
    assert_int_equal(crease_part_state_of(b.part), CREASE_PART_SHELL);
    assert_int_equal(crease_part_face_count(b.part), 1);
    assert_near(crease_part_face_at(b.part, 0).area, 2 * 6.2831853, 0.15);
    crease_cad_info info;
    assert_int_equal(crease_part_write(b.context, b.part, in_folder("pipe.step")), CREASE_OK);
    assert_int_equal(crease_cad_info_read(b.context, in_folder("pipe.step"), &info), CREASE_OK);
    assert_true(info.valid);
    assert_int_equal(info.free_edges, 2);
    free_built(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_pyramid_then_four_faces_that_meet_in_its_top),
        cmocka_unit_test(given_noise_then_the_same_faces_within_it),
        cmocka_unit_test(given_a_panel_folded_by_120_degrees_then_two_faces),
        cmocka_unit_test(given_three_planes_then_creases_that_meet_inside),
        cmocka_unit_test(given_a_panel_with_holes_then_a_face_with_them),
        cmocka_unit_test(given_a_rolled_sheet_then_a_cylinder_with_two_rims),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
