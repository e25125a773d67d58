/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Meshes: their faces in each format, and points drawn on the faces that they approximate. */
#include "given_bytes.h"

#include "facets/draw.h"
#include "facets/shading.h"
#include "facets/sides.h"

static const double TURN = 0.017453292519943295;

/* ----------------------------------------------------------------------------------- meshes -- */

static void add(crease_facets *facets, crease_context *context, const int *corners, size_t count)
{
    crease_polygon polygon = {0};
    for (size_t i = 0; i < count; i++)
        assert_int_equal(crease_facets_add(context, facets, &polygon, corners[i]), CREASE_OK);
}

static crease_facets given_cube(crease_context *context)
{
    static const int faces[6][4] = {
        {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    double vertices[24];
    for (int i = 0; i < 8; i++)
        for (int c = 0; c < 3; c++)
            vertices[3 * i + c] = i >> c & 1;
    crease_facets facets = {0};
    assert_int_equal(crease_facets_begin(context, &facets, "cube", vertices, 8), CREASE_OK);
    for (int i = 0; i < 6; i++)
        add(&facets, context, faces[i], 4);
    return facets;
}

/* A prism of radius 1 and height 1 with so many sides; every third one is inside out when turned.
 */
static crease_facets given_prism(crease_context *context, int sides, bool turned)
{
    double vertices[6 * 400];
    for (int i = 0; i < 2 * sides; i++) {
        const double angle = 360. / sides * (i / 2) * TURN;
        memcpy(vertices + 3 * i, (const double[3]){cos(angle), sin(angle), i % 2},
            3 * sizeof *vertices);
    }
    crease_facets facets = {0};
    assert_int_equal(
        crease_facets_begin(context, &facets, "prism", vertices, 2 * (size_t)sides), CREASE_OK);
    int ends[2][400];
    for (int i = 0; i < sides; i++) {
        const int a = 2 * i, b = 2 * ((i + 1) % sides);
        const int out[4] = {a, b, b + 1, a + 1}, in[4] = {a, a + 1, b + 1, b};
        add(&facets, context, turned && i % 3 == 0 ? in : out, 4);
        ends[0][i] = 2 * (sides - 1 - i);
        ends[1][i] = 2 * i + 1;
    }
    add(&facets, context, ends[0], (size_t)sides);
    add(&facets, context, ends[1], (size_t)sides);
    return facets;
}

static crease_cloud *when_drawn(crease_context *context, crease_facets *facets, int wanted)
{
    crease_cloud *cloud = NULL;
    if (crease_facets_draw(context, facets, wanted, &cloud) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    crease_facets_free(facets);
    return cloud;
}

/* How far the points of the wall of a prism are from the cylinder, at most. */
static double off_cylinder(const crease_cloud *cloud)
{
    double most = 0;
    size_t wall = 0;
    for (size_t i = 0; i < crease_cloud_count(cloud); i++) {
        const double *const p = crease_cloud_points(cloud) + 3 * i;
        const double radius = hypot(p[0], p[1]);
        if (p[2] < 1e-12 || p[2] > 1 - 1e-12)
            continue;
        wall++;
        most = fmax(most, fabs(radius - 1));
    }
    assert_true(wall > crease_cloud_count(cloud) / 3);
    return most;
}

/* ------------------------------------------------------------------------------------ drawn -- */

static void given_a_cube_then_points_lie_evenly_on_it(void **state)
{
    crease_context *context = given_context();
    crease_facets facets = given_cube(context);
    assert_false(crease_facets_dense(&facets));
    crease_cloud *cloud = when_drawn(context, &facets, 3000);
    const double *const points = crease_cloud_points(cloud);
    const size_t count = crease_cloud_count(cloud);
    assert_true(count > 2700 && count < 3300);
    for (size_t i = 0; i < count; i++) {
        double off = 1;
        for (int c = 0; c < 3; c++)
            off = fmin(
                off, fmin(fabs(points[3 * i + (size_t)c]), fabs(points[3 * i + (size_t)c] - 1)));
        assert_near(off, 0, 1e-15);
    }
    uint32_t nearest[2];
    double squared[2];
    crease_tree *tree = NULL;
    assert_int_equal(crease_tree_create(context, points, count, &tree), CREASE_OK);
    for (size_t i = 0; i < count; i++) {
        crease_tree_nearest(context, tree, points + 3 * i, 1, 2, nearest, squared);
        assert_true(sqrt(squared[1]) > 0.7 * sqrt(6. / 3000) && sqrt(squared[1]) < 0.2);
    }
    crease_tree_free(tree);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_facets_of_a_cylinder_then_points_lie_on_the_cylinder(void **state)
{
    crease_context *context = given_context();
    for (int sides = 24; sides <= 72; sides += 24) {
        const double sagitta = 1 - cos(180. / sides * TURN);
        for (int turned = 0; turned < 2; turned++) {
            crease_facets facets = given_prism(context, sides, turned);
            crease_cloud *cloud = when_drawn(context, &facets, 4000);
            assert_true(off_cylinder(cloud) < 0.02 * sagitta);
            crease_cloud_free(cloud);
        }
    }
    crease_context_free(context);
}

static void given_a_prism_then_its_sides_stay_flat(void **state)
{
    crease_context *context = given_context();
    crease_facets facets = given_prism(context, 8, false);
    crease_cloud *cloud = when_drawn(context, &facets, 4000);
    assert_near(off_cylinder(cloud), 1 - cos(22.5 * TURN), 1e-3);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* A plane that goes on into a quarter of a cylinder of radius 1 with facets of 10 degrees. */
static void given_a_plane_beside_a_fillet_then_it_stays_flat(void **state)
{
    enum { STEPS = 9 };
    double vertices[6 * (STEPS + 2)];
    for (int i = 0; i < 2 * (STEPS + 2); i++) {
        const int step = i / 2 - 1;
        const double angle = 10 * step * TURN;
        memcpy(vertices + 3 * i,
            step < 0 ? (const double[3]){-4, i % 2, 1}
                     : (const double[3]){sin(angle), i % 2, cos(angle)},
            3 * sizeof *vertices);
    }
    crease_context *context = given_context();
    crease_facets facets = {0};
    crease_facets_begin(context, &facets, "fillet", vertices, 2 * (STEPS + 2));
    for (int i = 0; i <= STEPS; i++)
        add(&facets, context, (const int[4]){2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1}, 4);
    crease_cloud *cloud = when_drawn(context, &facets, 3000);
    for (size_t i = 0; i < crease_cloud_count(cloud); i++) {
        const double *const p = crease_cloud_points(cloud) + 3 * i;
        if (p[0] < 0)
            assert_near(p[2], 1, 1e-15);
        else
            assert_near(hypot(p[0], p[2]), 1, 0.03 * (1 - cos(5 * TURN)));
    }
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_narrow_faces_then_more_points_are_drawn(void **state)
{
    crease_context *context = given_context();
    crease_facets cube = given_cube(context), plate = given_cube(context);
    for (size_t i = 0; i < plate.vertex_count; i++)
        plate.vertices[3 * i] *= 0.04;
    crease_cloud *few = when_drawn(context, &cube, -1), *many = when_drawn(context, &plate, -1);
    assert_true(crease_cloud_count(few) > 9000 && crease_cloud_count(few) < 11000);
    assert_true(crease_cloud_count(many) > 11000 && crease_cloud_count(many) < 100000);
    crease_cloud_free(few);
    crease_cloud_free(many);
    crease_context_free(context);
}

static void given_a_seed_then_the_points_are_the_same(void **state)
{
    crease_cloud *clouds[2];
    for (int i = 0; i < 2; i++) {
        crease_context *context = given_context_with_threads(i + 1);
        crease_facets facets = given_prism(context, 30, false);
        clouds[i] = when_drawn(context, &facets, 1000);
        crease_context_free(context);
    }
    assert_int_equal(crease_cloud_count(clouds[0]), crease_cloud_count(clouds[1]));
    assert_memory_equal(crease_cloud_points(clouds[0]), crease_cloud_points(clouds[1]),
        24 * crease_cloud_count(clouds[0]));
    crease_cloud_free(clouds[0]);
    crease_cloud_free(clouds[1]);
}

static void given_thousands_of_even_triangles_then_the_vertices_do(void **state)
{
    enum { SIDE = 80 };
    crease_context *context = given_context();
    double vertices[3 * SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++)
        memcpy(vertices + 3 * i, (const double[3]){i % SIDE, i / SIDE, 0}, 3 * sizeof *vertices);
    crease_facets facets = {0};
    crease_facets_begin(context, &facets, "grid", vertices, SIDE * SIDE);
    for (int i = 0; i < SIDE - 1; i++)
        for (int j = 0; j < SIDE - 1; j++) {
            const int at = i * SIDE + j;
            add(&facets, context, (const int[4]){at, at + 1, at + SIDE + 1, at + SIDE}, 4);
        }
    assert_true(crease_facets_dense(&facets));
    crease_facets_free(&facets);
    crease_context_free(context);
}

static void given_three_triangles_at_a_side_then_none_is_opposite(void **state)
{
    static const double vertices[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0};
    crease_context *context = given_context();
    crease_facets facets = {0};
    crease_facets_begin(context, &facets, "book", vertices, 5);
    for (int i = 2; i < 5; i++)
        add(&facets, context, (const int[3]){0, 1, i}, 3);
    uint32_t opposite[9];
    assert_int_equal(crease_sides_find(context, &facets, opposite), CREASE_OK);
    for (int i = 0; i < 9; i++)
        assert_int_equal(opposite[i], CREASE_SIDE_NONE);
    crease_facets_free(&facets);
    crease_context_free(context);
}

static void given_no_memory_then_drawing_says_so(void **state)
{
    crease_context *context = given_context();
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; status != CREASE_OK && n < 200; n++) {
        crease_facets facets = given_cube(context);
        crease_cloud *cloud = NULL;
        crease_context_fail_allocation(context, n);
        status = crease_facets_draw(context, &facets, 100, &cloud);
        crease_context_fail_allocation(context, -1);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
        crease_cloud_free(cloud);
        crease_facets_free(&facets);
    }
    assert_true(n > 15 && n < 200);
    crease_context_free(context);
}

/* ------------------------------------------------------------------------------------ files -- */

static crease_status read_mesh(crease_context *context, const char *name, const void *bytes,
    size_t size, int points, crease_cloud **out)
{
    char path[64];
    snprintf(path, sizeof path, "test_facets_%s", name);
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    const crease_read_options options = {.mesh_points = points};
    const crease_status status = crease_cloud_read(context, path, &options, out);
    assert_true((status == CREASE_OK) == (*out != NULL));
    remove(path);
    return status;
}

/* Half a unit square and its other half, whose triangles have these bytes. */
static void then_square_is_drawn_on(const char *name, const void *bytes, size_t size)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    if (read_mesh(context, name, bytes, size, 400, &cloud) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    double lower = 0;
    assert_true(crease_cloud_count(cloud) > 340 && crease_cloud_count(cloud) < 460);
    for (size_t i = 0; i < crease_cloud_count(cloud); i++) {
        const double *const p = crease_cloud_points(cloud) + 3 * i;
        assert_true(p[0] >= 0 && p[0] <= 1 && p[1] >= 0 && p[1] <= 1);
        assert_near(p[2], 0, 0);
        lower += p[0] + p[1] < 1;
    }
    assert_near(lower / (double)crease_cloud_count(cloud), 0.5, 0.05);
    crease_cloud_free(cloud);
    assert_int_equal(read_mesh(context, name, bytes, size, 0, &cloud), CREASE_OK);
    assert_int_equal(crease_cloud_count(cloud), 4);
    crease_cloud_free(cloud);
    assert_int_equal(read_mesh(context, name, bytes, size, -1, &cloud), CREASE_OK);
    assert_true(crease_cloud_count(cloud) > 9000);
    assert_non_null(strstr(last_warning, "its 4 vertices alone do not tell its shape"));
    crease_cloud_free(cloud);
    crease_context_free(context);
}

#define WITH_SIZE(text) text, sizeof(text) - 1

static void given_a_mesh_of_every_format_then_points_are_drawn_on_its_faces(void **state)
{
    then_square_is_drawn_on("a.obj",
        WITH_SIZE("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1 # a half\n"
                  "v 1 1 0\nf -3//1 -1//1 -2//1\n"));
    then_square_is_drawn_on(
        "b.off", WITH_SIZE("OFF\n4 1 0\n0 0 0\n1 0 0\n# four\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n"));
    then_square_is_drawn_on("c.off",
        WITH_SIZE("OFF BINARY\n\0\0\0\4\0\0\0\2\0\0\0\0"
                  "\0\0\0\0\0\0\0\0\0\0\0\0"
                  "\x3f\x80\0\0\0\0\0\0\0\0\0\0"
                  "\x3f\x80\0\0\x3f\x80\0\0\0\0\0\0"
                  "\0\0\0\0\x3f\x80\0\0\0\0\0\0"
                  "\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\3\0\0\0\0"
                  "\0\0\0\3\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0\1\x3f\x80\0\0"));
    then_square_is_drawn_on("d.stl",
        WITH_SIZE("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                  "vertex 0 1 0\nendloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\n"
                  "vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"));
    then_square_is_drawn_on("e.ply",
        WITH_SIZE("ply\nformat ascii 1.0\nelement tag 1\nproperty list uchar int ids\n"
                  "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                  "element face 2\nproperty uchar flag\nproperty list uchar int vertex_indices\n"
                  "end_header\n2 7 8\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n\n9 3 0 1 3\n9 3 1 2 3\n"));
    then_square_is_drawn_on("f.ply",
        WITH_SIZE("ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty float x\n"
                  "property float y\nproperty float z\nelement face 1\n"
                  "property list uchar ushort vertex_index\nproperty list uchar float texcoord\n"
                  "end_header\n"
                  "\0\0\0\0\0\0\0\0\0\0\0\0"
                  "\x3f\x80\0\0\0\0\0\0\0\0\0\0"
                  "\x3f\x80\0\0\x3f\x80\0\0\0\0\0\0"
                  "\0\0\0\0\x3f\x80\0\0\0\0\0\0"
                  "\4\0\0\0\1\0\2\0\3"
                  "\1\x3f\x80\0\0"));
}

static void then_mesh_fails(
    const char *name, const void *bytes, size_t size, crease_status status, const char *words)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    const crease_status found = read_mesh(context, name, bytes, size, -1, &cloud);
    const char *const message = crease_context_message(context);
    if (found != status || !strstr(message, words) || !strstr(message, name))
        fail_msg("status %d, expected %d; '%s' should hold '%s'", found, status, message, words);
    crease_context_free(context);
}

static void given_wrong_faces_then_a_sentence_says_what(void **state)
{
    then_mesh_fails("a.obj", WITH_SIZE("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), CREASE_ERROR_FORMAT,
        "vertex 3, counted from 0, of 3");
    then_mesh_fails("a.obj", WITH_SIZE("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n"), CREASE_ERROR_FORMAT,
        "has vertex -1");
    then_mesh_fails("a.off", WITH_SIZE("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        CREASE_ERROR_TRUNCATED, "before the 2 faces");
    then_mesh_fails("a.off", WITH_SIZE("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"),
        CREASE_ERROR_FORMAT, "line 6: a corner of a face is no whole number");
    then_mesh_fails("a.ply",
        WITH_SIZE("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                  "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"),
        CREASE_ERROR_FORMAT, "line 13: a face ends before its list does");
    then_mesh_fails("a.obj", WITH_SIZE("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), CREASE_ERROR_VALUE,
        "have no area");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_cube_then_points_lie_evenly_on_it),
        cmocka_unit_test(given_facets_of_a_cylinder_then_points_lie_on_the_cylinder),
        cmocka_unit_test(given_a_prism_then_its_sides_stay_flat),
        cmocka_unit_test(given_a_plane_beside_a_fillet_then_it_stays_flat),
        cmocka_unit_test(given_narrow_faces_then_more_points_are_drawn),
        cmocka_unit_test(given_a_seed_then_the_points_are_the_same),
        cmocka_unit_test(given_thousands_of_even_triangles_then_the_vertices_do),
        cmocka_unit_test(given_three_triangles_at_a_side_then_none_is_opposite),
        cmocka_unit_test(given_no_memory_then_drawing_says_so),
        cmocka_unit_test(given_a_mesh_of_every_format_then_points_are_drawn_on_its_faces),
        cmocka_unit_test(given_wrong_faces_then_a_sentence_says_what),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
