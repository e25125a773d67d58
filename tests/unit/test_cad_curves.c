/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Curves as edges in CAD files. */
#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */

#include "given_cad.h"

enum { MOST_CURVES = 16, MOST_POINTS = 16 };

typedef struct wires {
    crease_context *context;
    crease_curve *curves[MOST_CURVES];
    size_t count;
} wires;

static wires given_wires(void)
{
    wires w = {0};
    assert_int_equal(crease_context_create(NULL, &w.context), CREASE_OK);
    return w;
}

static void free_wires(wires *w)
{
    for (size_t i = 0; i < w->count; i++)
        crease_curve_free(w->curves[i]);
    crease_context_free(w->context);
}

static void add_curve(
    wires *w, int order, size_t count, const double *knots, const double *control_points)
{
    const crease_status status = crease_curve_create(
        w->context, order, count, knots, control_points, &w->curves[w->count++]);
    assert_int_equal(status, CREASE_OK);
}

/* A clamped cubic of seven control points from a to b that sags between them. */
static void add_arc(wires *w, const double a[3], const double b[3])
{
    const double knots[] = {0, 0, 0, 0, 0.2, 0.5, 0.7, 1, 1, 1, 1};
    double points[7][3];
    for (int i = 0; i < 7; i++)
        for (int c = 0; c < 3; c++)
            points[i][c] =
                i == 6 ? b[c] : a[c] + (b[c] - a[c]) * i / 6 + (i > 0 ? 0.03 * (i % 3) : 0.0) / 7;
    add_curve(w, 4, 7, knots, &points[0][0]);
}

/* Of the box from 0 0 0 to 1 2 3; every second runs against its axis. */
static void add_box_edges(wires *w)
{
    for (int axis = 0; axis < 3; axis++)
        for (int corner = 0; corner < 4; corner++) {
            const int second = (axis + 1) % 3, third = (axis + 2) % 3;
            double ends[2][3];
            for (int end = 0; end < 2; end++) {
                ends[end][axis] = end * (axis + 1.0);
                ends[end][second] = corner % 2 * (second + 1.0);
                ends[end][third] = corner / 2 * (third + 1.0);
            }
            add_arc(w, ends[corner % 2], ends[1 - corner % 2]);
        }
}

static crease_status when_written_to(wires *w, const char *path)
{
    return crease_cad_curves_write(
        w->context, (const crease_curve *const *)w->curves, w->count, path);
}

static void then_file_holds(wires *w, const char *name, size_t edges, size_t vertices)
{
    crease_cad_info info;
    if (when_written_to(w, in_folder(name)) != CREASE_OK ||
        crease_cad_info_read(w->context, in_folder(name), &info) != CREASE_OK)
        fail_msg("%s", crease_context_message(w->context));
    assert_true(info.valid);
    assert_int_equal(info.edges, edges);
    assert_int_equal(info.wire_edges, edges);
    assert_int_equal(info.vertices, vertices);
    assert_int_equal(info.faces, 0);
}

static void given_edges_of_a_box_then_they_share_its_corners(void **state)
{
    static const char *const names[] = {"box.step", "box.stp", "box.brep"};
    wires w = given_wires();
    add_box_edges(&w);
    for (int i = 0; i < 3; i++)
        then_file_holds(&w, names[i], 12, 8);
    then_file_holds(&w, "box.igs", 12, 24); /* curves there know no vertices */
    free_wires(&w);
}

static void given_a_closed_curve_then_it_has_one_vertex(void **state)
{
    const double knots[] = {0, 0, 0, 0, 1, 2, 3, 3, 3, 3};
    const double points[] = {0, 0, 0, 1, 0, 0, 1, 1, 1, -1, 1, 1, -1, 0, 0, 0, 0, 0};
    wires w = given_wires();
    add_curve(&w, 4, 6, knots, points);
    then_file_holds(&w, "ring.step", 1, 1);
    then_file_holds(&w, "ring.brep", 1, 1);
    free_wires(&w);
}

static void given_a_curve_with_a_kink_then_it_is_cut_there(void **state)
{
    const double knots[] = {0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1};
    const double even[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    double bent[7][3], repeated[7][3];
    for (int i = 0; i < 7; i++) {
        const int step = i < 2 ? i : i < 5 ? 2 : i - 2; /* one control point three times */
        memcpy(bent[i], (double[]){i, abs(i - 3), 5}, sizeof bent[i]);
        memcpy(repeated[i], (double[]){step, abs(step - 2), 9}, sizeof repeated[i]);
    }
    wires w = given_wires();
    add_curve(&w, 4, 7, knots, &bent[0][0]);
    then_file_holds(&w, "kink.step", 2, 3);
    add_curve(&w, 4, 7, even, &repeated[0][0]);
    then_file_holds(&w, "rows.step", 4, 6);
    free_wires(&w);
}

static void given_ends_of_any_knots_then_curves_meet_in_them(void **state)
{
    const double loose[] = {0, 1, 2, 3, 4, 5, 6, 7}, line[] = {0, 0, 9, 9};
    const double points[] = {0, 0, 0, 3, 0, 0, 3, 3, 0, 6, 3, 0};
    double ends[2][3];
    wires w = given_wires();
    add_curve(&w, 4, 4, loose, points);
    crease_curve_evaluate(w.curves[0], 4, CREASE_SIDE_LEFT, 0, ends[0]);
    memcpy(ends[1], (double[]){9, 9, 9}, sizeof ends[1]);
    add_curve(&w, 2, 2, line, &ends[0][0]);
    then_file_holds(&w, "loose.step", 2, 3);
    free_wires(&w);
}

/* Lengths from a thousandth to a million: what is one corner depends on the size. */
static void given_any_size_then_corners_are_shared(void **state)
{
    for (double size = 1e-3; size < 1e7; size *= 1e3) {
        wires w = given_wires();
        const double apex[3] = {1e3 * size, 0, 0};
        for (int i = 0; i < 5; i++)
            add_arc(&w, apex, (double[]){(1e3 + cos(i)) * size, sin(i) * size, size});
        then_file_holds(&w, "size.step", 5, 6);
        free_wires(&w);
    }
}

/* The text without blanks and line ends. */
static char *squeezed(const char *path)
{
    char *bytes = NULL;
    const size_t size = read_bytes(path, &bytes);
    size_t kept = 0;
    for (size_t i = 0; i < size; i++)
        if (bytes[i] != '\n' && bytes[i] != ' ')
            bytes[kept++] = bytes[i];
    bytes[kept] = 0;
    return bytes;
}

static void given_any_curve_then_its_numbers_stand_in_the_file(void **state)
{
    wires w = given_wires();
    add_arc(&w, (double[]){1.0 / 3, 1e-7 / 7, 1e6 / 11}, (double[]){2.0 / 3, 0.1, -0.7});
    assert_int_equal(when_written_to(&w, in_folder("digits.step")), CREASE_OK);
    char *bytes = squeezed(in_folder("digits.step"));
    for (size_t i = 0; i < 7; i++) {
        const double *p = crease_curve_control_points(w.curves[0]) + 3 * i;
        char text[128];
        snprintf(text, sizeof text, "(%#.17G,%#.17G,%#.17G)", p[0], p[1], p[2]);
        assert_non_null(strstr(bytes, text));
    }
    char knots[256];
    snprintf(knots, sizeof knots, "(4,1,1,1,4),(%#.17G,%#.17G,%#.17G,%#.17G,%#.17G)", 0., .2, .5,
        .7, 1.);
    assert_non_null(strstr(bytes, knots));
    free(bytes);
    free_wires(&w);
}

static void given_the_same_curves_then_the_bytes_are_the_same(void **state)
{
    static const char *const names[] = {"same.step", "same.igs", "same.brep"};
    for (int k = 0; k < 3; k++) {
        char *bytes[2];
        size_t size[2];
        for (int i = 0; i < 2; i++) {
            wires w = given_wires();
            add_box_edges(&w);
            assert_int_equal(when_written_to(&w, in_folder(names[k])), CREASE_OK);
            size[i] = read_bytes(in_folder(names[k]), &bytes[i]);
            free_wires(&w);
        }
        assert_int_equal(size[0], size[1]);
        assert_memory_equal(bytes[0], bytes[1], size[0]);
        free(bytes[0]);
        free(bytes[1]);
    }
}

static void then_it_fails(wires *w, const char *path, crease_status expected, const char *word)
{
    assert_int_equal(when_written_to(w, path), expected);
    assert_non_null(strstr(crease_context_message(w->context), path));
    if (!strstr(crease_context_message(w->context), word))
        fail_msg("\"%s\" lacks \"%s\"", crease_context_message(w->context), word);
    assert_int_not_equal(access(path, F_OK), 0);
}

static void given_what_cannot_be_written_then_a_sentence_says_so(void **state)
{
    const double knots[] = {0, 0, 1, 1}, steps[] = {0, 1, 2}, points[] = {1, 2, 3, 1, 2, 3};
    wires w = given_wires();
    then_it_fails(&w, in_folder("none.step"), CREASE_ERROR_ARGUMENT, "no curve");
    add_curve(&w, 2, 2, knots, points);
    then_it_fails(&w, in_folder("point.step"), CREASE_ERROR_NUMERIC, "shrunk");
    then_it_fails(&w, in_folder("point.dxf"), CREASE_ERROR_ARGUMENT, ".step");
    add_arc(&w, (double[]){0, 0, 0}, (double[]){1, 0, 0});
    then_it_fails(&w, in_folder("no/a.step"), CREASE_ERROR_CANNOT_WRITE, "cannot be written");
    then_file_holds(&w, "one.step", 1, 2);
    add_curve(&w, 1, 2, steps, points);
    then_it_fails(&w, in_folder("order.step"), CREASE_ERROR_ARGUMENT, "curve 3 is of order 1");
    free_wires(&w);
}

static void given_memory_that_runs_out_then_every_failure_is_told(void **state)
{
    wires w = given_wires();
    add_box_edges(&w);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; status != CREASE_OK && n < 1000; n++) {
        crease_context_fail_allocation(w.context, n);
        status = when_written_to(&w, in_folder("memory.step"));
        if (status != CREASE_OK)
            assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
    }
    assert_true(n > 4 && n < 1000);
    crease_context_fail_allocation(w.context, -1);
    free_wires(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_edges_of_a_box_then_they_share_its_corners),
        cmocka_unit_test(given_a_closed_curve_then_it_has_one_vertex),
        cmocka_unit_test(given_a_curve_with_a_kink_then_it_is_cut_there),
        cmocka_unit_test(given_ends_of_any_knots_then_curves_meet_in_them),
        cmocka_unit_test(given_any_size_then_corners_are_shared),
        cmocka_unit_test(given_any_curve_then_its_numbers_stand_in_the_file),
        cmocka_unit_test(given_the_same_curves_then_the_bytes_are_the_same),
        cmocka_unit_test(given_what_cannot_be_written_then_a_sentence_says_so),
        cmocka_unit_test(given_memory_that_runs_out_then_every_failure_is_told),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
