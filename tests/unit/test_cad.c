/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */

#include "given.h"

#include "crease/crease_cad.h"

#include <fcntl.h>
#include <ftw.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST = 16 };

static char folder[] = "/tmp/crease-cad-XXXXXX";

/* ------------------------------------------------------------------------------------- given -- */

typedef struct model {
    crease_context *context;
    crease_surface *surfaces[MOST];
    size_t count;
} model;

static model given_model(void)
{
    return (model){.context = given_context()};
}

static void free_model(model *m)
{
    for (size_t i = 0; i < m->count; i++)
        crease_surface_free(m->surfaces[i]);
    crease_context_free(m->context);
}

static const char *in_folder(const char *name)
{
    static _Thread_local char path[4][256];
    static _Thread_local int turn = 0;
    turn = (turn + 1) % 4;
    snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

static void add_surface(model *m, const crease_surface_parts *parts)
{
    assert_true(m->count < MOST);
    assert_int_equal(crease_surface_create(m->context, parts, &m->surfaces[m->count++]), CREASE_OK);
}

static void clamped_knots(int order, size_t count, double *knots)
{
    const size_t inner = count - (size_t)order;
    for (size_t i = 0; i < count + (size_t)order; i++) {
        const double t = ((double)i - order + 1) / ((double)inner + 1);
        knots[i] = fmin(fmax(t, 0.0), 1.0);
    }
}

static double greville(const double *knots, int order, size_t i)
{
    double sum = 0;
    for (int k = 1; k < order; k++)
        sum += knots[i + (size_t)k];
    return sum / (order - 1);
}

/* A place in space for a place in the unit square. */
typedef void shape_of(double u, double v, double out[3]);

/* A bicubic surface over given knots whose control points are the shape at the Greville places:
 * the shape itself where that is bilinear. */
static void add_over_knots(model *m, const double *u, size_t rows, const double *v, size_t columns,
    const double frame[12], shape_of *shape)
{
    double points[3 * 256];
    assert_true(rows * columns <= 256);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) {
            double at[3], *out = points + 3 * (i * columns + j);
            shape(greville(u, 4, i), greville(v, 4, j), at);
            for (int c = 0; c < 3; c++)
                out[c] =
                    frame[9 + c] + frame[c] * at[0] + frame[3 + c] * at[1] + frame[6 + c] * at[2];
        }
    add_surface(m, &(crease_surface_parts){{4, 4}, {rows, columns}, {u, v}, points});
}

static void flat(double u, double v, double out[3])
{
    out[0] = u;
    out[1] = v;
    out[2] = 0;
}

static void bump(double u, double v, double out[3])
{
    flat(u, v, out);
    out[2] = 0.3 * sin(3 * u) * cos(2 * v);
}

/* frame: images of x, y, z, then the origin. */
static void add_shaped(
    model *m, size_t rows, size_t columns, const double frame[12], shape_of *shape)
{
    double u[32], v[32];
    clamped_knots(4, rows, u);
    clamped_knots(4, columns, v);
    add_over_knots(m, u, rows, v, columns, frame, shape);
}

static const double IDENTITY[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

/* Two planes at a right angle that meet along y; the second one runs as `turned` says: bit 0
 * reverses the common border, bit 1 puts the border on the other side. */
static void add_wedge(model *m, double size, const double origin[3], int turned)
{
    const double s = size, *o = origin;
    add_shaped(m, 5, 4, (double[]){s, 0, 0, 0, s, 0, 0, 0, s, o[0], o[1], o[2]}, flat);
    const double y = turned & 1 ? -s : s, y0 = turned & 1 ? s : 0;
    const double z = turned & 2 ? -s : s, z0 = turned & 2 ? s : 0;
    add_shaped(m, 6, 4, (double[]){0, 0, z, 0, y, 0, 1, 0, 0, o[0], o[1] + y0, o[2] + z0}, flat);
}

static void add_box(model *m, double size, const double origin[3])
{
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            double frame[12] = {0};
            frame[(axis + 1) % 3] = size;
            frame[3 + (axis + 2) % 3] = size;
            frame[6 + axis] = size;
            for (int c = 0; c < 3; c++)
                frame[9 + c] = origin[c] + (c == axis && side ? size : 0);
            add_shaped(m, 4 + (size_t)axis % 2, 4 + (size_t)axis % 2, frame, flat);
        }
}

/* -------------------------------------------------------------------------------------- when -- */

static void when_written(model *m, const char *path)
{
    const crease_status status =
        crease_cad_write(m->context, (const crease_surface *const *)m->surfaces, m->count, path);
    if (status != CREASE_OK)
        fail_msg("%d: %s", (int)status, crease_context_message(m->context));
}

static crease_cad_info when_read(model *m, const char *path)
{
    crease_cad_info info;
    const crease_status status = crease_cad_info_read(m->context, path, &info);
    if (status != CREASE_OK)
        fail_msg("%d: %s", (int)status, crease_context_message(m->context));
    return info;
}

static crease_cad_info when_written_and_read(model *m, const char *name)
{
    when_written(m, in_folder(name));
    return when_read(m, in_folder(name));
}

/* -------------------------------------------------------------------------------------- then -- */

static void then_counts_are(const crease_cad_info *info, size_t solids, size_t faces, size_t edges,
    size_t vertices, size_t free_edges, size_t sharp_edges)
{
    assert_true(info->valid);
    assert_int_equal(info->solids, solids);
    assert_int_equal(info->faces, faces);
    assert_int_equal(info->edges, edges);
    assert_int_equal(info->vertices, vertices);
    assert_int_equal(info->free_edges, free_edges);
    assert_int_equal(info->sharp_edges, sharp_edges);
}

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
        m.count = 1;
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

/* A roof whose ridge row stands three times over uniform knots that are not clamped: the averaging
 * method's result. Its rows lie at x = i, z = -|x - ridge|. */
static void add_repeated_rows(model *m, int direction, double scale)
{
    double knots[2][16], points[9 * 6 * 3];
    for (int i = 0; i < 16; i++)
        knots[0][i] = knots[1][i] = 10 + 0.5 * i;
    for (size_t i = 0; i < 9; i++)
        for (size_t j = 0; j < 6; j++) {
            double *p = points + 3 * (direction == 0 ? i * 6 + j : j * 9 + i);
            const double row = i < 3 ? (double)i : (i < 6 ? 3.0 : (double)i - 2);
            p[0] = scale * row;
            p[1] = scale * (double)j;
            p[2] = -scale * fabs(row - 3.0);
        }
    const size_t rows = direction == 0 ? 9 : 6, columns = direction == 0 ? 6 : 9;
    add_surface(m, &(crease_surface_parts){{4, 4}, {rows, columns}, {knots[0], knots[1]}, points});
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

/* A tube around the z axis, closed in u; its radius falls to zero at the ends that `tip` names. */
static void add_tube(model *m, int tips)
{
    enum { ROUND = 8 };
    double u[16], v[8], points[12 * 4 * 3];
    clamped_knots(4, 12, u);
    clamped_knots(4, 4, v);
    for (size_t i = 0; i < 12; i++)
        for (size_t j = 0; j < 4; j++) {
            const double angle = 2 * acos(-1.0) * greville(u, 4, i % 11);
            const bool tip = (j == 0 && tips & 1) || (j == 3 && tips & 2);
            const double radius = tip ? 0.0 : 1.0;
            memcpy(points + 3 * (i * 4 + j),
                (double[]){radius * cos(angle), radius * sin(angle), (double)j / 3},
                3 * sizeof(double));
        }
    add_surface(m, &(crease_surface_parts){{4, 4}, {12, 4}, {u, v}, points});
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
            assert_near(info.volume / (s * s * s), 1.0, o > 0 ? 1e-6 : 1e-9);
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

static size_t read_bytes(const char *path, char **bytes)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    const size_t size = (size_t)ftell(file);
    rewind(file);
    *bytes = malloc(size + 1);
    assert_int_equal(fread(*bytes, 1, size, file), size);
    fclose(file);
    return size;
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

/* Sends what the process prints to a file while the work is done; returns its size. */
static long printed_by(void (*work)(void))
{
    fflush(NULL);
    const int out = dup(1), err = dup(2);
    const int file = open(in_folder("printed"), O_CREAT | O_RDWR | O_TRUNC, 0666);
    dup2(file, 1);
    dup2(file, 2);
    work();
    fflush(NULL);
    dup2(out, 1);
    dup2(err, 2);
    const long size = (long)lseek(file, 0, SEEK_END);
    close(file);
    close(out);
    close(err);
    return size;
}

static void write_bytes(const char *path, const char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

/* Reads beginnings of a file, and the file with bytes changed: no crash, and never silence about
 * what is missing. */
static void read_spoiled(void)
{
    static const char *const names[] = {"spoil.step", "spoil.igs", "spoil.brep"};
    model m = given_model();
    add_wedge(&m, 1.0, (double[]){0, 0, 0}, 0);
    crease_cad_info info;
    for (int k = 0; k < 3; k++) {
        const char *path = in_folder(names[k]);
        when_written(&m, path);
        char *bytes = NULL;
        const size_t size = read_bytes(path, &bytes);
        for (size_t part = 0; part < 6; part++) {
            write_bytes(path, bytes, size * part / 6);
            const crease_status status = crease_cad_info_read(m.context, path, &info);
            assert_int_equal(crease_status_kind(status), CREASE_KIND_INPUT);
            assert_non_null(strstr(crease_context_message(m.context), path));
        }
        for (size_t i = 0; i < 8; i++) {
            const size_t at = size / 4 + i * (size / 2) / 8;
            const char old = bytes[at];
            bytes[at] = (char)("9,(#'.;\n"[i]);
            write_bytes(path, bytes, size);
            (void)crease_cad_info_read(m.context, path, &info);
            bytes[at] = old;
        }
        free(bytes);
    }
    free_model(&m);
}

static void given_spoiled_files_then_sentences_come_and_nothing_is_printed(void **state)
{
    assert_int_equal(printed_by(read_spoiled), 0);
}

static void then_reading_fails(const char *path, crease_status expected, const char *word)
{
    crease_context *context = given_context();
    crease_cad_info info;
    assert_int_equal(crease_cad_info_read(context, path, &info), expected);
    assert_int_equal(info.faces, 0);
    if (!strstr(crease_context_message(context), word))
        fail_msg("\"%s\" lacks \"%s\"", crease_context_message(context), word);
    crease_context_free(context);
}

static void given_no_cad_file_then_a_sentence_says_so(void **state)
{
    then_reading_fails(in_folder("none.step"), CREASE_ERROR_NO_SUCH_FILE, "no such file");
    then_reading_fails(folder, CREASE_ERROR_CANNOT_READ, "directory");
    write_bytes(in_folder("text.step"), "hello\n", 6);
    then_reading_fails(in_folder("text.step"), CREASE_ERROR_FORMAT, "no CAD file");
    write_bytes(in_folder("text.txt"), "1 2 3\n", 6);
    then_reading_fails(in_folder("text.txt"), CREASE_ERROR_FORMAT, "no CAD file");
    static const char empty[] =
        "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n";
    write_bytes(in_folder("empty.step"), empty, sizeof empty - 1);
    then_reading_fails(in_folder("empty.step"), CREASE_ERROR_FORMAT, "");
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *walk)
{
    return remove(path);
}

static int make_folder(void **state)
{
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    return nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
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
        cmocka_unit_test(given_one_long_border_and_two_short_ones_then_its_parts_are_shared),
        cmocka_unit_test(given_borders_of_different_orders_and_knots_then_the_edge_is_shared),
        cmocka_unit_test(given_surfaces_apart_then_there_are_several_shells),
        cmocka_unit_test(given_any_size_and_place_then_the_model_is_valid_and_closed),
        cmocka_unit_test(given_the_same_surfaces_then_the_bytes_are_the_same),
        cmocka_unit_test(given_any_number_then_it_reads_back_as_it_was),
        cmocka_unit_test(given_a_name_that_will_not_do_then_a_sentence_says_so),
        cmocka_unit_test(given_surfaces_without_area_then_nothing_is_written),
        cmocka_unit_test(given_a_band_with_one_side_then_a_sentence_says_so),
        cmocka_unit_test(given_memory_that_runs_out_then_every_failure_is_told),
        cmocka_unit_test(given_two_threads_with_a_context_each_then_both_are_served),
        cmocka_unit_test(given_spoiled_files_then_sentences_come_and_nothing_is_printed),
        cmocka_unit_test(given_no_cad_file_then_a_sentence_says_so),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
