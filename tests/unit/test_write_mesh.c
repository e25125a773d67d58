/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What was written is read back here with small readers of its own. */
#include "given.h"

#include "spline/knots.h"
#include "spline/project.h"

#include <cJSON.h>
#include <dirent.h>
#include <unistd.h>

static char directory[64];

static int make_directory(void **state)
{
    snprintf(directory, sizeof directory, "/tmp/crease-mesh-XXXXXX");
    return mkdtemp(directory) ? 0 : 1;
}

/* Fails when anything but the one file of the test was left behind. */
static int remove_directory(void **state)
{
    DIR *listing = opendir(directory);
    size_t count = 0;
    for (const struct dirent *entry = readdir(listing); entry; entry = readdir(listing)) {
        char path[400];
        snprintf(path, sizeof path, "%s/%s", directory, entry->d_name);
        if (entry->d_name[0] != '.' || strstr(entry->d_name, ".tmp"))
            count += unlink(path) == 0;
    }
    closedir(listing);
    return rmdir(directory) != 0 || count > 1;
}

static const char *place(const char *name)
{
    static char path[128];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    return path;
}

/* Two pieces of a roof of unit size, far from the origin: float coordinates would lose it. */
static crease_mesh *given_mesh(crease_context *context)
{
    crease_surface *pieces[2] = {NULL};
    for (int side = 0; side < 2; side++) {
        const double line[] = {0, 0, 1, 1};
        double points[12];
        for (size_t i = 0; i < 4; i++) {
            const double x = side == 0 ? (double)(i / 2) - 1.0 : (double)(i / 2);
            points[3 * i] = 1e6 + 0.1 * x;
            points[3 * i + 1] = -2e6 + (double)(i % 2) / 3;
            points[3 * i + 2] = 3e3 - 0.1 * fabs(x);
        }
        const crease_surface_parts parts = {
            .order = {2, 2}, .count = {2, 2}, .knots = {line, line}, .control_points = points};
        assert_int_equal(crease_surface_create(context, &parts, &pieces[side]), CREASE_OK);
    }
    crease_mesh *mesh = NULL;
    const crease_surface *const list[2] = {pieces[0], pieces[1]};
    assert_int_equal(crease_mesh_create(context, list, 2, 0.01, &mesh), CREASE_OK);
    crease_surface_free(pieces[0]);
    crease_surface_free(pieces[1]);
    assert_int_equal(crease_mesh_triangle_count(mesh), 4);
    assert_int_equal(crease_mesh_vertex_count(mesh), 8);
    return mesh;
}

/* The whole file with a zero behind it; the caller frees it. */
static unsigned char *load(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    unsigned char *bytes = calloc(1 << 20, 1);
    assert_non_null(bytes);
    *size = fread(bytes, 1, (1 << 20) - 1, file);
    fclose(file);
    return bytes;
}

static uint32_t u32(const unsigned char *at)
{
    return at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static double f32(const unsigned char *at)
{
    const uint32_t bits = u32(at);
    float value = 0;
    memcpy(&value, &bits, 4);
    return (double)value;
}

static double f64(const unsigned char *at)
{
    const uint64_t bits = u32(at) | (uint64_t)u32(at + 4) << 32;
    double value = 0;
    memcpy(&value, &bits, 8);
    return value;
}

static void given_ply_then_every_number_reads_back(void **state)
{
    crease_context *context = given_context();
    crease_mesh *mesh = given_mesh(context);
    assert_int_equal(crease_mesh_write(context, mesh, place("mesh.ply")), CREASE_OK);
    size_t size = 0;
    unsigned char *bytes = load(place("mesh.ply"), &size);
    const char *const text = (const char *)bytes;
    assert_memory_equal(text, "ply\nformat binary_little_endian 1.0\n", 36);
    assert_non_null(strstr(text, "element vertex 8\nproperty double x\n"));
    assert_non_null(strstr(text, "element face 4\nproperty list uchar int vertex_indices\n"));
    const unsigned char *at = (const unsigned char *)strstr(text, "end_header\n") + 11;
    assert_int_equal(bytes + size - at, 8 * 36 + 4 * 17);
    for (size_t i = 0; i < 8; i++, at += 36)
        for (size_t c = 0; c < 3; c++) {
            assert_true(f64(at + 8 * c) == crease_mesh_vertices(mesh)[3 * i + c]);
            assert_near(f32(at + 24 + 4 * c), crease_mesh_normals(mesh)[3 * i + c], 1e-7);
        }
    for (size_t i = 0; i < 4; i++, at += 17) {
        assert_int_equal(at[0], 3);
        for (size_t c = 0; c < 3; c++)
            assert_int_equal(u32(at + 1 + 4 * c), crease_mesh_triangles(mesh)[3 * i + c]);
        assert_int_equal(u32(at + 13), crease_mesh_owners(mesh)[i]);
    }
    free(bytes);
    crease_mesh_free(mesh);
    crease_context_free(context);
}

static void given_obj_then_every_number_reads_back(void **state)
{
    crease_context *context = given_context();
    crease_mesh *mesh = given_mesh(context);
    assert_int_equal(crease_mesh_write(context, mesh, place("mesh.OBJ")), CREASE_OK);
    FILE *file = fopen(place("mesh.OBJ"), "r");
    assert_non_null(file);
    char line[256];
    size_t vertices = 0, normals = 0, faces = 0;
    unsigned group = 0;
    while (fgets(line, sizeof line, file)) {
        double p[3];
        unsigned v[6];
        if (sscanf(line, "v %lf %lf %lf", &p[0], &p[1], &p[2]) == 3)
            assert_memory_equal(p, crease_mesh_vertices(mesh) + 3 * vertices++, sizeof p);
        else if (sscanf(line, "vn %lf %lf %lf", &p[0], &p[1], &p[2]) == 3)
            assert_near(p[0], crease_mesh_normals(mesh)[3 * normals++], 1e-7);
        else if (sscanf(line, "f %u//%u %u//%u %u//%u", &v[0], &v[1], &v[2], &v[3], &v[4], &v[5]) ==
            6) {
            for (size_t c = 0; c < 6; c++)
                assert_int_equal(v[c], crease_mesh_triangles(mesh)[3 * faces + c / 2] + 1);
            assert_int_equal(group, crease_mesh_owners(mesh)[faces++] + 1);
        } else if (sscanf(line, "g surface_%u", &group) != 1) {
            assert_int_equal(line[0], '#');
        }
    }
    fclose(file);
    assert_int_equal(vertices, 8);
    assert_int_equal(normals, 8);
    assert_int_equal(faces, 4);
    crease_mesh_free(mesh);
    crease_context_free(context);
}

static int warnings = 0;

static void count_warning(void *user, const char *sentence)
{
    warnings += strstr(sentence, "PLY") != NULL;
}

static void given_stl_then_triangles_and_normals_read_back_and_rounding_is_told(void **state)
{
    crease_context_options options = crease_context_options_default();
    options.warn = count_warning;
    crease_context *context = NULL;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    crease_mesh *mesh = given_mesh(context);
    warnings = 0;
    assert_int_equal(crease_mesh_write(context, mesh, place("mesh.stl")), CREASE_OK);
    assert_int_equal(warnings, 1);
    size_t size = 0;
    unsigned char *bytes = load(place("mesh.stl"), &size);
    assert_int_equal(size, 84 + 4 * 50);
    assert_true(memcmp(bytes, "solid", 5) != 0);
    assert_int_equal(u32(bytes + 80), 4);
    for (size_t i = 0; i < 4; i++) {
        const unsigned char *const at = bytes + 84 + 50 * i;
        const double slope = crease_mesh_owners(mesh)[i] ? sqrt(0.5) : -sqrt(0.5);
        assert_near(f32(at), slope, 1e-6);
        assert_near(f32(at + 8), sqrt(0.5), 1e-6);
        for (size_t k = 0; k < 9; k++) {
            const uint32_t vertex = crease_mesh_triangles(mesh)[3 * i + k / 3];
            const double truth = crease_mesh_vertices(mesh)[3 * (size_t)vertex + k % 3];
            assert_true(f32(at + 12 + 4 * k) == (double)(float)truth);
        }
        assert_int_equal(at[48] | at[49], 0);
    }
    free(bytes);
    crease_mesh_free(mesh);
    crease_context_free(context);
}

static double number(const cJSON *array, int index)
{
    return cJSON_GetArrayItem(array, index)->valuedouble;
}

static const cJSON *item(const cJSON *object, const char *name, int index)
{
    const cJSON *const array = cJSON_GetObjectItem(object, name);
    assert_non_null(array);
    const cJSON *const found = cJSON_GetArrayItem(array, index);
    assert_non_null(found);
    return found;
}

static int field(const cJSON *object, const char *name)
{
    const cJSON *const found = cJSON_GetObjectItem(object, name);
    assert_non_null(found);
    return found->valueint;
}

/* The bytes of an accessor, after checking its view: bounds, alignment, target. */
static const unsigned char *view(const cJSON *root, int accessor, int type, int target,
    size_t element, const unsigned char *binary, size_t binary_size)
{
    const cJSON *const a = item(root, "accessors", accessor);
    const cJSON *const v = item(root, "bufferViews", field(a, "bufferView"));
    const size_t offset = (size_t)field(v, "byteOffset");
    const size_t length = (size_t)field(v, "byteLength");
    assert_int_equal(field(a, "componentType"), type);
    assert_int_equal(field(v, "target"), target);
    assert_int_equal(offset % 4, 0);
    assert_int_equal(length, element * (size_t)field(a, "count"));
    assert_true(offset + length <= binary_size);
    return binary + offset;
}

static void given_glb_then_it_is_valid_and_keeps_precision(void **state)
{
    crease_context *context = given_context();
    crease_mesh *mesh = given_mesh(context);
    assert_int_equal(crease_mesh_write(context, mesh, place("mesh.glb")), CREASE_OK);
    size_t size = 0;
    unsigned char *bytes = load(place("mesh.glb"), &size);
    assert_memory_equal(bytes, "glTF\2\0\0\0", 8);
    assert_int_equal(u32(bytes + 8), size);
    const size_t json_size = u32(bytes + 12);
    assert_int_equal(json_size % 4, 0);
    assert_memory_equal(bytes + 16, "JSON", 4);
    const unsigned char *const binary = bytes + 28 + json_size;
    const size_t binary_size = u32(binary - 8);
    assert_memory_equal(binary - 4, "BIN\0", 4);
    assert_int_equal(binary_size % 4, 0);
    assert_int_equal(28 + json_size + binary_size, size);
    cJSON *root = cJSON_ParseWithLength((const char *)bytes + 20, json_size);
    assert_non_null(root);
    assert_string_equal(
        cJSON_GetObjectItem(cJSON_GetObjectItem(root, "asset"), "version")->valuestring, "2.0");
    assert_int_equal(field(item(root, "buffers", 0), "byteLength"), binary_size);
    const unsigned char *const p = view(root, 0, 5126, 34962, 12, binary, binary_size);
    const unsigned char *const n = view(root, 1, 5126, 34962, 12, binary, binary_size);
    const unsigned char *const t = view(root, 2, 5125, 34963, 4, binary, binary_size);
    const cJSON *const move = cJSON_GetObjectItem(item(root, "nodes", 1), "translation");
    const cJSON *const low = cJSON_GetObjectItem(item(root, "accessors", 0), "min");
    const cJSON *const high = cJSON_GetObjectItem(item(root, "accessors", 0), "max");
    double least[3] = {9, 9, 9}, most[3] = {-9, -9, -9};
    for (int i = 0; i < 24; i++) {
        const double value = f32(p + 4 * i);
        assert_near(value + number(move, i % 3), crease_mesh_vertices(mesh)[i], 1e-8);
        assert_near(f32(n + 4 * i), crease_mesh_normals(mesh)[i], 1e-7);
        least[i % 3] = fmin(least[i % 3], value);
        most[i % 3] = fmax(most[i % 3], value);
    }
    for (int c = 0; c < 3; c++) {
        assert_true((float)number(low, c) == (float)least[c]);
        assert_true((float)number(high, c) == (float)most[c]);
    }
    for (size_t i = 0; i < 12; i++)
        assert_int_equal(u32(t + 4 * i), crease_mesh_triangles(mesh)[i]);
    /* the outer node turns z into y: q (0, 0, 1) q* */
    const cJSON *const q = cJSON_GetObjectItem(item(root, "nodes", 0), "rotation");
    assert_near(2 * (number(q, 1) * number(q, 2) - number(q, 0) * number(q, 3)), 1.0, 1e-15);
    assert_int_equal(number(cJSON_GetObjectItem(item(root, "nodes", 0), "children"), 0), 1);
    cJSON_Delete(root);
    free(bytes);
    crease_mesh_free(mesh);
    crease_context_free(context);
}

static void given_wrong_places_then_nothing_is_left(void **state)
{
    crease_context *context = given_context();
    crease_mesh *mesh = given_mesh(context);
    static const char *const endings[] = {"ply", "obj", "stl", "glb"};
    assert_int_equal(crease_mesh_write(context, mesh, place("mesh.step")), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), ".ply, .obj, .stl or .glb"));
    for (int i = 0; i < 4; i++) {
        char path[64];
        snprintf(path, sizeof path, "no/such/mesh.%s", endings[i]);
        assert_int_equal(crease_mesh_write(context, mesh, place(path)), CREASE_ERROR_CANNOT_WRITE);
        /* a link to a device that is always full */
        snprintf(path, sizeof path, "full.%s", endings[i]);
        assert_int_equal(symlink("/dev/full", place(path)), 0);
        assert_int_equal(crease_mesh_write(context, mesh, place(path)), CREASE_ERROR_CANNOT_WRITE);
        unlink(place(path));
        snprintf(path, sizeof path, "memory.%s", endings[i]);
        crease_context_fail_allocation(context, 0);
        assert_int_equal(crease_mesh_write(context, mesh, place(path)), CREASE_ERROR_NO_MEMORY);
        crease_context_fail_allocation(context, -1);
        assert_int_equal(access(place(path), F_OK), -1);
    }
    crease_mesh_free(mesh);
    crease_context_free(context);
}

/* Three creases that meet in one corner, to rounding: a line, an arc and another line. */
static void given_curves(crease_context *context, crease_curve *curves[3])
{
    const double line[] = {0, 0, 1, 1};
    const double arc[] = {0, 0, 0, 1, 1, 1};
    const double first[] = {5, 5, 5, 6, 5, 5};
    const double second[] = {5, 6, 5, 5, 6 + 1e-3, 5, 5, 5 + 1e-13, 5};
    const double third[] = {5 - 1e-13, 5, 5, 5, 5, 7};
    assert_int_equal(crease_curve_create(context, 2, 2, line, first, &curves[0]), CREASE_OK);
    assert_int_equal(crease_curve_create(context, 3, 3, arc, second, &curves[1]), CREASE_OK);
    assert_int_equal(crease_curve_create(context, 2, 2, line, third, &curves[2]), CREASE_OK);
}

static void free_curves(crease_curve *curves[3])
{
    for (int i = 0; i < 3; i++)
        crease_curve_free(curves[i]);
}

static void given_curves_that_meet_then_ply_shares_the_vertex(void **state)
{
    crease_context *context = given_context();
    crease_curve *curves[3];
    given_curves(context, curves);
    const crease_curve *const list[3] = {curves[0], curves[1], curves[2]};
    assert_int_equal(crease_curves_write(context, list, 3, 1e-3, place("c.ply")), CREASE_OK);
    size_t size = 0;
    unsigned char *bytes = load(place("c.ply"), &size);
    unsigned vertices = 0, edges = 0;
    assert_int_equal(
        sscanf(strstr((char *)bytes, "element vertex"), "element vertex %u", &vertices), 1);
    assert_int_equal(sscanf(strstr((char *)bytes, "element edge"), "element edge %u", &edges), 1);
    assert_int_equal(edges, vertices - 1);
    assert_true(edges > 6);
    const unsigned char *const at = (unsigned char *)strstr((char *)bytes, "end_header\n") + 11;
    const unsigned char *const pairs = at + 28 * vertices;
    assert_int_equal(bytes + size - pairs, 8 * edges);
    unsigned corner = 0, arc = 0;
    for (unsigned i = 0; i < edges; i++) {
        assert_true(u32(pairs + 8 * i) < vertices && u32(pairs + 8 * i + 4) < vertices);
        corner += u32(pairs + 8 * i) == 0 || u32(pairs + 8 * i + 4) == 0;
    }
    assert_int_equal(corner, 3);
    for (unsigned i = 0; i < vertices; i++)
        if (u32(at + 28 * i + 24) == 1) {
            const double y = f64(at + 28 * i + 8);
            assert_true(y > 5 && y <= 6.001);
            arc++;
        }
    assert_int_equal(arc, vertices - 3);
    free(bytes);
    free_curves(curves);
    crease_context_free(context);
}

/* Chords of the arc, against the curve itself. */
static void given_a_tolerance_then_chords_keep_to_it(void **state)
{
    crease_context *context = given_context();
    enum { COUNT = 9 };
    double knots[COUNT + 4], points[3 * COUNT];
    crease_knots_clamped(4, COUNT, 0, 1, knots);
    for (int i = 0; i < COUNT; i++) {
        points[3 * i] = cos(0.7 * i);
        points[3 * i + 1] = sin(0.7 * i);
        points[3 * i + 2] = 0.1 * i;
    }
    crease_curve *curve = NULL;
    assert_int_equal(crease_curve_create(context, 4, COUNT, knots, points, &curve), CREASE_OK);
    assert_int_equal(
        crease_curves_write(context, (const crease_curve *const *)&curve, 1, 1e-3, place("c.csv")),
        CREASE_OK);
    FILE *file = fopen(place("c.csv"), "r");
    assert_non_null(file);
    char line[200];
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line, "crease,x,y,z\n");
    double before[3] = {0}, worst = 0;
    int count = 0;
    for (unsigned number = 9; fgets(line, sizeof line, file); count++) {
        double p[3];
        assert_int_equal(sscanf(line, "%u,%lf,%lf,%lf", &number, &p[0], &p[1], &p[2]), 4);
        assert_int_equal(number, 0);
        double middle[3];
        crease_foot foot;
        for (int c = 0; c < 3; c++)
            middle[c] = count ? 0.5 * (p[c] + before[c]) : p[c];
        assert_int_equal(crease_curve_project(context, curve, middle, 1, &foot), CREASE_OK);
        worst = fmax(worst, foot.distance);
        memcpy(before, p, sizeof p);
    }
    fclose(file);
    assert_true(worst <= 1e-3 && worst > 1e-4);
    assert_true(count > 20 && count < 200);
    assert_near(before[2], 0.8, 0);
    crease_curve_free(curve);
    crease_context_free(context);
}

static void given_curves_then_obj_has_a_line_for_each(void **state)
{
    crease_context *context = given_context();
    crease_curve *curves[3];
    given_curves(context, curves);
    const crease_curve *const list[3] = {curves[0], curves[1], curves[2]};
    assert_int_equal(crease_curves_write(context, list, 3, 10.0, place("c.obj")), CREASE_OK);
    size_t size = 0;
    unsigned char *bytes = load(place("c.obj"), &size);
    const char *const lines = strstr((char *)bytes, "\nl ");
    assert_non_null(lines);
    assert_string_equal(lines, "\nl 1 2\nl 3 1\nl 1 4\n");
    assert_non_null(strstr((char *)bytes, "\nv 5 5 5\nv 6 5 5\nv 5 6 5\nv 5 5 7\n"));
    free(bytes);
    free_curves(curves);
    crease_context_free(context);
}

static void given_no_curves_or_wrong_arguments_then_it_is_handled(void **state)
{
    crease_context *context = given_context();
    crease_curve *curves[3];
    given_curves(context, curves);
    const crease_curve *const list[3] = {curves[0], curves[1], curves[2]};
    assert_int_equal(crease_curves_write(context, NULL, 0, 0, place("c.ply")), CREASE_OK);
    size_t size = 0;
    unsigned char *bytes = load(place("c.ply"), &size);
    assert_non_null(strstr((char *)bytes, "element vertex 0\n"));
    free(bytes);
    assert_int_equal(
        crease_curves_write(context, list, 3, -1, place("d.ply")), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_curves_write(context, list, 3, 1e-300, place("d.ply")), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_curves_write(context, list, 3, 0, place("d.stl")), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_curves_write(context, list, 3, 0, place("no/d.csv")), CREASE_ERROR_CANNOT_WRITE);
    assert_int_equal(symlink("/dev/full", place("d.obj")), 0);
    assert_int_equal(
        crease_curves_write(context, list, 3, 0, place("d.obj")), CREASE_ERROR_CANNOT_WRITE);
    unlink(place("d.obj"));
    int failures = 0;
    crease_context_fail_allocation(context, failures);
    while (crease_curves_write(context, list, 3, 0, place("c.ply")) == CREASE_ERROR_NO_MEMORY)
        crease_context_fail_allocation(context, ++failures);
    assert_true(failures >= 12);
    free_curves(curves);
    crease_context_free(context);
}

int main(void)
{
#define IN_DIRECTORY(test) cmocka_unit_test_setup_teardown(test, make_directory, remove_directory)
    const struct CMUnitTest tests[] = {
        IN_DIRECTORY(given_ply_then_every_number_reads_back),
        IN_DIRECTORY(given_obj_then_every_number_reads_back),
        IN_DIRECTORY(given_stl_then_triangles_and_normals_read_back_and_rounding_is_told),
        IN_DIRECTORY(given_glb_then_it_is_valid_and_keeps_precision),
        IN_DIRECTORY(given_wrong_places_then_nothing_is_left),
        IN_DIRECTORY(given_curves_that_meet_then_ply_shares_the_vertex),
        IN_DIRECTORY(given_a_tolerance_then_chords_keep_to_it),
        IN_DIRECTORY(given_curves_then_obj_has_a_line_for_each),
        IN_DIRECTORY(given_no_curves_or_wrong_arguments_then_it_is_handled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
