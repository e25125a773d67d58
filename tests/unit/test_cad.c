/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */

#include "given_cad.h"

#include <pthread.h>
#include <sys/stat.h>

static void given_one_patch_then_one_face_stands_in_the_file(void **state)
{
    model m = given_model();
    add_shaped(&m, 7, 6, IDENTITY, bump);
    const crease_cad_info info = when_written_and_read(&m, "patch.step");
    then_counts_are(&info, 0, 1, 4, 4, 4, 0);
    assert_string_equal(info.format, "STEP");
    assert_string_equal(info.schema, "AP242");
    assert_int_equal(info.shells, 1);
    assert_int_equal(info.closed_shells, 0);
    assert_int_equal(info.bspline_faces, 1);
    free_model(&m);
}

static void given_two_planes_then_they_share_the_edge_however_they_run(void **state)
{
    for (int turned = 0; turned < 4; turned++) {
        model m = given_model();
        add_wedge(&m, 1.0, (double[]){0, 0, 0}, turned);
        const crease_cad_info info = when_written_and_read(&m, "wedge.step");
        then_counts_are(&info, 0, 2, 7, 6, 6, 1);
        assert_int_equal(info.shells, 1);
        assert_near(info.area, 2.0, 1e-9);
        free_model(&m);
    }
}

static void given_four_patches_then_they_share_one_vertex(void **state)
{
    model m = given_model();
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            add_shaped(&m, 4, 5, (double[]){1, 0, 0, 0, 1, 0, 0, 0, 1, i, j, 0}, flat);
    const crease_cad_info info = when_written_and_read(&m, "four.step");
    then_counts_are(&info, 0, 4, 12, 9, 8, 0);
    assert_near(info.area, 4.0, 1e-9);
    free_model(&m);
}

static void given_a_closed_box_then_it_is_a_solid_of_its_volume(void **state)
{
    model m = given_model();
    add_box(&m, 2.0, (double[]){1, 2, 3});
    const crease_cad_info info = when_written_and_read(&m, "box.step");
    then_counts_are(&info, 1, 6, 12, 8, 0, 12);
    assert_int_equal(info.closed_shells, 1);
    assert_near(info.volume, 8.0, 1e-9);
    assert_near(info.area, 24.0, 1e-9);
    for (int c = 0; c < 3; c++) {
        assert_near(info.lowest[c], c + 1, 1e-6);
        assert_near(info.highest[c], c + 3, 1e-6);
    }
    free_model(&m);
}

static void given_any_format_then_the_counts_are_the_same(void **state)
{
    static const char *const names[] = {"box.step", "box.STP", "box.iges", "box.igs", "box.brep"};
    static const char *const formats[] = {"STEP", "STEP", "IGES", "IGES", "BREP"};
    for (int i = 0; i < 5; i++) {
        model m = given_model();
        add_box(&m, 2.0, (double[]){0, 0, 0});
        crease_cad_info info = when_written_and_read(&m, names[i]);
        assert_string_equal(info.format, formats[i]);
        then_counts_are(&info, 1, 6, 12, 8, 0, 12);
        assert_near(info.volume, 8.0, 1e-9);
        free_model(&m);
        m = given_model();
        add_shaped(&m, 4, 4, IDENTITY, flat);
        info = when_written_and_read(&m, names[i]);
        then_counts_are(&info, 0, 1, 4, 4, 4, 0);
        free_model(&m);
    }
}

static void given_a_knot_of_full_multiplicity_then_the_surface_is_cut_there(void **state)
{
    const double u[] = {0, 0, 0, 0, 0.25, 0.5, 0.5, 0.5, 1, 1, 1, 1},
                 v[] = {0, 0, 0, 0, 1, 1, 1, 1};
    for (int direction = 0; direction < 2; direction++) {
        model m = given_model();
        double points[8 * 4 * 3];
        for (size_t i = 0; i < 8; i++)
            for (size_t j = 0; j < 4; j++) {
                double *p = points + 3 * (direction == 0 ? i * 4 + j : j * 8 + i);
                p[0] = greville(u, 4, i);
                p[1] = (double)j / 3;
                p[2] = fabs(p[0] - 0.5);
            }
        add_surface(&m,
            direction == 0 ? &(crease_surface_parts){{4, 4}, {8, 4}, {u, v}, points}
                           : &(crease_surface_parts){{4, 4}, {4, 8}, {v, u}, points});
        const crease_cad_info info = when_written_and_read(&m, "knot.step");
        then_counts_are(&info, 0, 2, 7, 6, 6, 1);
        assert_int_equal(info.shells, 1);
        assert_near(info.area, sqrt(2.0), 1e-9);
        free_model(&m);
    }
}

static void given_a_row_three_times_then_the_surface_is_cut_there(void **state)
{
    static const char *const names[] = {"rows.step", "rows.igs", "rows.brep"};
    for (int i = 0; i < 6; i++) {
        model m = given_model();
        add_repeated_rows(&m, i % 2, 1.0);
        const crease_cad_info info = when_written_and_read(&m, names[i / 2]);
        then_counts_are(&info, 0, 2, 7, 6, 6, 1);
        assert_near(info.area, 12 * sqrt(2.0), 1e-7); /* x = 1..5, y = 1..4 */
        assert_near(info.tolerance, 1e-7, 1e-9);
        free_model(&m);
    }
}

static void given_rows_repeated_both_ways_then_there_are_four_faces(void **state)
{
    model m = given_model();
    double knots[13], points[9 * 9 * 3];
    for (int i = 0; i < 13; i++)
        knots[i] = i;
    for (size_t i = 0; i < 9; i++)
        for (size_t j = 0; j < 9; j++) {
            const double x = i < 3 ? (double)i : (i < 6 ? 3.0 : (double)i - 2);
            const double y = j < 3 ? (double)j : (j < 6 ? 3.0 : (double)j - 2);
            memcpy(points + 3 * (i * 9 + j), (double[]){x, y, fabs(x - 3) + fabs(y - 3)},
                3 * sizeof(double));
        }
    add_surface(&m, &(crease_surface_parts){{4, 4}, {9, 9}, {knots, knots}, points});
    const crease_cad_info info = when_written_and_read(&m, "both.step");
    then_counts_are(&info, 0, 4, 12, 9, 8, 4);
    assert_near(info.area, 16 * sqrt(3.0), 1e-7);
    free_model(&m);
}

/* Five rows at one place: between the two borders of the fold nothing is left. */
static void given_a_fold_without_area_then_it_is_left_out(void **state)
{
    model m = given_model();
    double knots[15], v[] = {0, 0, 0, 0, 1, 1, 1, 1}, points[11 * 4 * 3];
    for (int i = 0; i < 15; i++)
        knots[i] = i;
    for (size_t i = 0; i < 11; i++)
        for (size_t j = 0; j < 4; j++) {
            const double x = i < 3 ? (double)i : (i < 8 ? 3.0 : (double)i - 4);
            memcpy(points + 3 * (i * 4 + j), (double[]){x, (double)j / 3, -fabs(x - 3)},
                3 * sizeof(double));
        }
    add_surface(&m, &(crease_surface_parts){{4, 4}, {11, 4}, {knots, v}, points});
    const crease_cad_info info = when_written_and_read(&m, "fold.step");
    then_counts_are(&info, 0, 2, 7, 6, 6, 1);
    free_model(&m);
}

static void given_a_closed_tube_then_it_has_a_seam(void **state)
{
    static const char *const names[] = {"tube.step", "tube.igs", "tube.brep"};
    for (int i = 0; i < 3; i++) {
        model m = given_model();
        add_tube(&m, 0);
        const crease_cad_info info = when_written_and_read(&m, names[i]);
        then_counts_are(&info, 0, 1, 3, 2, 2, 0);
        free_model(&m);
    }
}

static void given_a_border_shrunk_to_a_point_then_it_is_a_vertex(void **state)
{
    static const char *const names[] = {"tip.step", "tip.igs", "tip.brep"};
    for (int i = 0; i < 9; i++) {
        model m = given_model();
        const int tips = 1 + i % 3;
        add_tube(&m, tips);
        const crease_cad_info info = when_written_and_read(&m, names[i / 3]);
        if (tips == 3)
            then_counts_are(&info, 1, 1, 1, 2, 0, 0);
        else
            then_counts_are(&info, 0, 1, 2, 2, 1, 0);
        assert_true((info.volume > 0.5) == (tips == 3));
        free_model(&m);
    }
}

static void given_a_knot_of_multiplicity_beyond_the_degree_then_the_surface_is_torn(void **state)
{
    model m = given_model();
    const double u[] = {0, 0, 1, 1, 2, 2}, v[] = {0, 0, 1, 1};
    const double points[] = {
        0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0, 5, 1, 1, 5, 2, 0, 5, 2, 1, 5};
    add_surface(&m, &(crease_surface_parts){{2, 2}, {4, 2}, {u, v}, points});
    const crease_cad_info info = when_written_and_read(&m, "torn.step");
    then_counts_are(&info, 0, 2, 8, 8, 8, 0);
    assert_int_equal(info.shells, 2);
    free_model(&m);
}

/* Too few equal rows to be given a better parameter, but no reason to refuse. */
static void given_two_equal_rows_at_a_border_then_the_face_is_valid(void **state)
{
    static const char *const names[] = {"two.step", "two.igs", "two.brep"};
    for (int i = 0; i < 3; i++) {
        model m = given_model();
        double points[4 * 4 * 3], knots[8];
        clamped_knots(4, 4, knots);
        for (size_t k = 0; k < 16; k++) {
            const double x = k < 4 ? 1.0 : (double)(k / 4);
            memcpy(points + 3 * k, (double[]){x, (double)(k % 4), x * x}, 3 * sizeof(double));
        }
        add_surface(&m, &(crease_surface_parts){{4, 4}, {4, 4}, {knots, knots}, points});
        const crease_cad_info info = when_written_and_read(&m, names[i]);
        then_counts_are(&info, 0, 1, 4, 4, 4, 0);
        free_model(&m);
    }
}

static void given_a_ring_closed_both_ways_then_it_is_a_solid(void **state)
{
    enum { AROUND = 12 };
    model m = given_model();
    double knots[AROUND + 4], points[AROUND * AROUND * 3];
    clamped_knots(4, AROUND, knots);
    for (size_t i = 0; i < AROUND; i++)
        for (size_t j = 0; j < AROUND; j++) {
            const double turn = 2 * acos(-1.0);
            const double a = turn * greville(knots, 4, i % (AROUND - 1));
            const double b = turn * greville(knots, 4, j % (AROUND - 1)), out = 3 + cos(b);
            memcpy(points + 3 * (i * AROUND + j), (double[]){out * cos(a), out * sin(a), sin(b)},
                3 * sizeof(double));
        }
    add_surface(&m, &(crease_surface_parts){{4, 4}, {AROUND, AROUND}, {knots, knots}, points});
    const crease_cad_info info = when_written_and_read(&m, "ring.step");
    then_counts_are(&info, 1, 1, 2, 1, 0, 0);
    assert_true(info.volume > 30 && info.volume < 60);
    free_model(&m);
}

static void given_one_long_border_and_two_short_ones_then_its_parts_are_shared(void **state)
{
    for (int turned = 0; turned < 2; turned++) {
        model m = given_model();
        add_shaped(&m, 5, 5, (double[]){2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, flat);
        const double y = turned ? -1 : 1, y0 = turned ? 2 : 1;
        for (int i = 0; i < 2; i++)
            add_shaped(&m, 4, 4, (double[]){1, 0, 0, 0, y, 0, 0, 0, 1, i, y0, 0}, flat);
        const crease_cad_info info = when_written_and_read(&m, "long.step");
        then_counts_are(&info, 0, 3, 10, 8, 7, 0);
        assert_int_equal(info.shells, 1);
        free_model(&m);
    }
}

static void given_borders_of_different_orders_and_knots_then_the_edge_is_shared(void **state)
{
    model m = given_model();
    add_shaped(&m, 7, 5, IDENTITY, flat);
    const double u[] = {0, 0, 2, 2}, v[] = {-1, -1, -1, 1, 1, 1};
    const double points[] = {0, 1, 0, 0, 2, 1, 0, 2, 3, 1, 1, 0, 1, 2, 1, 1, 2, 3};
    add_surface(&m, &(crease_surface_parts){{2, 3}, {2, 3}, {u, v}, points});
    const crease_cad_info info = when_written_and_read(&m, "orders.step");
    then_counts_are(&info, 0, 2, 7, 6, 6, 1);
    free_model(&m);
}

static void given_surfaces_apart_then_there_are_several_shells(void **state)
{
    static const char *const names[] = {"apart.step", "apart.igs", "apart.brep"};
    for (int i = 0; i < 3; i++) {
        model m = given_model();
        add_box(&m, 1.0, (double[]){0, 0, 0});
        add_shaped(&m, 4, 4, (double[]){1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 0, 0}, bump);
        add_box(&m, 1.0, (double[]){10, 0, 0});
        const crease_cad_info info = when_written_and_read(&m, names[i]);
        then_counts_are(&info, 2, 13, 28, 20, 4, 24);
        assert_int_equal(info.shells, 3);
        assert_int_equal(info.closed_shells, 2);
        assert_near(info.volume, 2.0, 1e-9);
        free_model(&m);
    }
}

static void given_any_size_and_place_then_the_model_is_valid_and_closed(void **state)
{
    static const double sizes[] = {1e-3, 1.0, 1e5, 1.0}, offsets[] = {0, 0, 0, 1e6};
    static const char *const names[] = {"size.step", "size.igs", "size.brep"};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            model m = given_model();
            const double s = sizes[i], o = offsets[i];
            add_box(&m, s, (double[]){o, -o, o / 2});
            crease_cad_info info = when_written_and_read(&m, names[k]);
            then_counts_are(&info, 1, 6, 12, 8, 0, 12);
            assert_near(info.volume / (s * s * s), 1.0, o > 0 ? 1e-8 : 1e-9);
            assert_near(info.highest[0] - info.lowest[0], s, 1e-6 * s + 3e-7);
            assert_true(info.tolerance < 1e-4 * s);
            free_model(&m);
            m = given_model();
            add_repeated_rows(&m, 0, s);
            info = when_written_and_read(&m, names[k]);
            then_counts_are(&info, 0, 2, 7, 6, 6, 1);
            free_model(&m);
        }
}

static void then_bytes_are_equal(const char *one, const char *other)
{
    char *a = NULL, *b = NULL;
    const size_t size = read_bytes(one, &a);
    assert_int_equal(read_bytes(other, &b), size);
    assert_memory_equal(a, b, size);
    free(a);
    free(b);
}

static void given_the_same_surfaces_then_the_bytes_are_the_same(void **state)
{
    static const char *const names[] = {"same.step", "same.igs", "same.brep"};
    assert_int_equal(mkdir(in_folder("again"), 0777), 0);
    for (int k = 0; k < 3; k++) {
        model m = given_model();
        add_box(&m, 1.0, (double[]){0, 0, 0});
        add_repeated_rows(&m, 1, 3.0);
        char again[64];
        snprintf(again, sizeof again, "again/%s", names[k]);
        when_written(&m, in_folder(names[k]));
        when_written(&m, in_folder(again));
        then_bytes_are_equal(in_folder(names[k]), in_folder(again));
        free_model(&m);
    }
}

/* Every control point stands in the file as it is, digit for digit. */
static void given_any_number_then_it_reads_back_as_it_was(void **state)
{
    model m = given_model();
    add_shaped(&m, 6, 6, (double[]){1.0 / 3, 0, 0, 0, 1e-7 / 3, 0, 0, 0, 1, 0.1, 0, 1e6 / 7}, bump);
    when_written(&m, in_folder("digits.step"));
    char *bytes = NULL;
    const size_t size = read_bytes(in_folder("digits.step"), &bytes);
    size_t kept = 0;
    for (size_t i = 0; i < size; i++)
        if (bytes[i] != '\n' && bytes[i] != ' ')
            bytes[kept++] = bytes[i];
    bytes[kept] = 0;
    const crease_surface_parts parts = crease_surface_parts_of(m.surfaces[0]);
    for (size_t i = 0; i < 36; i++) {
        const double *p = parts.control_points + 3 * i;
        char text[128];
        snprintf(text, sizeof text, "(%#.17G,%#.17G,%#.17G)", p[0], p[1], p[2]);
        assert_non_null(strstr(bytes, text));
    }
    free(bytes);
    free_model(&m);
}

static void then_it_fails(model *m, const char *path, crease_status expected, const char *word)
{
    const crease_status status =
        crease_cad_write(m->context, (const crease_surface *const *)m->surfaces, m->count, path);
    assert_int_equal(status, expected);
    assert_non_null(strstr(crease_context_message(m->context), path));
    if (!strstr(crease_context_message(m->context), word))
        fail_msg("\"%s\" lacks \"%s\"", crease_context_message(m->context), word);
}

static void given_a_name_that_will_not_do_then_a_sentence_says_so(void **state)
{
    model m = given_model();
    add_shaped(&m, 4, 4, IDENTITY, flat);
    then_it_fails(&m, in_folder("model.dwg"), CREASE_ERROR_ARGUMENT, ".step");
    then_it_fails(&m, in_folder("model"), CREASE_ERROR_ARGUMENT, ".step");
    then_it_fails(&m, in_folder("a.step/model"), CREASE_ERROR_ARGUMENT, ".step");
    then_it_fails(&m, in_folder("no/model.step"), CREASE_ERROR_CANNOT_WRITE, "cannot be written");
    m.count = 0;
    then_it_fails(&m, in_folder("model.step"), CREASE_ERROR_ARGUMENT, "no surface");
    m.count = 1;
    free_model(&m);
}

static void given_surfaces_without_area_then_nothing_is_written(void **state)
{
    model m = given_model();
    add_shaped(&m, 4, 4, (double[]){1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, flat);
    then_it_fails(&m, in_folder("line.step"), CREASE_ERROR_NUMERIC, "shrunk");
    assert_int_not_equal(access(in_folder("line.step"), F_OK), 0);
    const double u[] = {0, 1, 2}, points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    add_surface(&m, &(crease_surface_parts){{1, 1}, {2, 2}, {u, u}, points});
    then_it_fails(&m, in_folder("steps.step"), CREASE_ERROR_ARGUMENT, "order 1");
    free_model(&m);
}

static void given_a_band_with_one_side_then_a_sentence_says_so(void **state)
{
    model m = given_model();
    enum { PARTS = 3 };
    const double knots[] = {0, 0, 1, 1}, pi = acos(-1.0);
    double points[PARTS + 1][2][3];
    for (int i = 0; i <= PARTS; i++)
        for (int side = 0; side < 2; side++) {
            const double around = 2 * pi * (i % PARTS) / PARTS, tilt = pi * i / PARTS;
            const double out = (side ? 0.5 : -0.5) * cos(tilt);
            points[i][side][0] = (2 + out) * cos(around);
            points[i][side][1] = (2 + out) * sin(around);
            points[i][side][2] = (side ? 0.5 : -0.5) * sin(tilt);
        }
    memcpy(points[PARTS][0], points[0][1], sizeof points[0][0]);
    memcpy(points[PARTS][1], points[0][0], sizeof points[0][0]);
    for (int i = 0; i < PARTS; i++)
        add_surface(&m, &(crease_surface_parts){{2, 2}, {2, 2}, {knots, knots}, &points[i][0][0]});
    then_it_fails(&m, in_folder("band.step"), CREASE_ERROR_NUMERIC, "one side");
    free_model(&m);
}

static void given_a_surface_twice_then_a_sentence_says_so(void **state)
{
    model m = given_model();
    add_shaped(&m, 5, 5, IDENTITY, bump);
    add_shaped(&m, 5, 5, IDENTITY, bump);
    then_it_fails(&m, in_folder("twice.step"), CREASE_ERROR_NUMERIC, "lie on each other");
    free_model(&m);
}

static void given_memory_that_runs_out_then_every_failure_is_told(void **state)
{
    model m = given_model();
    add_repeated_rows(&m, 1, 1.0);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; status != CREASE_OK && n < 1000; n++) {
        crease_context_fail_allocation(m.context, n);
        status = crease_cad_write(m.context, (const crease_surface *const *)m.surfaces, m.count,
            in_folder("memory.step"));
        if (status != CREASE_OK)
            assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
    }
    assert_true(n > 4 && n < 1000);
    crease_context_fail_allocation(m.context, -1);
    free_model(&m);
}

static void *write_and_read_often(void *name)
{
    model m = given_model();
    add_wedge(&m, 1.0, (double[]){0, 0, 0}, 0);
    for (int i = 0; i < 5; i++) {
        const crease_cad_info info = when_written_and_read(&m, name);
        then_counts_are(&info, 0, 2, 7, 6, 6, 1);
    }
    free_model(&m);
    return NULL;
}

static void given_two_threads_with_a_context_each_then_both_are_served(void **state)
{
    pthread_t other;
    static char name[] = "thread.igs";
    assert_int_equal(pthread_create(&other, NULL, write_and_read_often, name), 0);
    static char own[] = "thread.step";
    write_and_read_often(own);
    assert_int_equal(pthread_join(other, NULL), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_one_patch_then_one_face_stands_in_the_file),
        cmocka_unit_test(given_two_planes_then_they_share_the_edge_however_they_run),
        cmocka_unit_test(given_four_patches_then_they_share_one_vertex),
        cmocka_unit_test(given_a_closed_box_then_it_is_a_solid_of_its_volume),
        cmocka_unit_test(given_any_format_then_the_counts_are_the_same),
        cmocka_unit_test(given_a_knot_of_full_multiplicity_then_the_surface_is_cut_there),
        cmocka_unit_test(given_a_row_three_times_then_the_surface_is_cut_there),
        cmocka_unit_test(given_rows_repeated_both_ways_then_there_are_four_faces),
        cmocka_unit_test(given_a_fold_without_area_then_it_is_left_out),
        cmocka_unit_test(given_a_closed_tube_then_it_has_a_seam),
        cmocka_unit_test(given_a_border_shrunk_to_a_point_then_it_is_a_vertex),
        cmocka_unit_test(given_a_knot_of_multiplicity_beyond_the_degree_then_the_surface_is_torn),
        cmocka_unit_test(given_two_equal_rows_at_a_border_then_the_face_is_valid),
        cmocka_unit_test(given_a_ring_closed_both_ways_then_it_is_a_solid),
        cmocka_unit_test(given_one_long_border_and_two_short_ones_then_its_parts_are_shared),
        cmocka_unit_test(given_borders_of_different_orders_and_knots_then_the_edge_is_shared),
        cmocka_unit_test(given_surfaces_apart_then_there_are_several_shells),
        cmocka_unit_test(given_any_size_and_place_then_the_model_is_valid_and_closed),
        cmocka_unit_test(given_the_same_surfaces_then_the_bytes_are_the_same),
        cmocka_unit_test(given_any_number_then_it_reads_back_as_it_was),
        cmocka_unit_test(given_a_name_that_will_not_do_then_a_sentence_says_so),
        cmocka_unit_test(given_surfaces_without_area_then_nothing_is_written),
        cmocka_unit_test(given_a_band_with_one_side_then_a_sentence_says_so),
        cmocka_unit_test(given_a_surface_twice_then_a_sentence_says_so),
        cmocka_unit_test(given_memory_that_runs_out_then_every_failure_is_told),
        cmocka_unit_test(given_two_threads_with_a_context_each_then_both_are_served),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
