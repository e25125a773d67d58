/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The vertices of OBJ, STL and OFF. */
#include "given_bytes.h"

#define WITH_SIZE(text) text, sizeof(text) - 1

/* --------------------------------------------------------------------------------------- obj -- */

static void given_obj_then_vertices_are_read(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.obj",
        "# a triangle\nmtllib a.mtl\no part\nv 1 2 3\nv  4 5.5 6\r\nvt 0 0\nv 7 8 9\n"
        "vn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n");
    assert_int_equal(crease_cloud_count(cloud), 3);
    assert_null(crease_cloud_normals(cloud));
    then_point_is(cloud, 1, 4, 5.5, 6);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_obj_with_a_normal_for_each_vertex_then_they_are_read(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud =
        when_text_read(context, "a.obj", "v 1 2 3\nvn 0 0 1\nv 4 5 6\nvn 0 1 0\n");
    assert_non_null(crease_cloud_normals(cloud));
    assert_near(crease_cloud_normals(cloud)[4], 1, 0);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_obj_with_colours_or_weights_then_they_are_told_apart(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.obj", "v 1 2 3 0.25 0.5 1\n");
    then_field_is(cloud, "green", CREASE_TYPE_FLOAT64, 0, 0.5);
    crease_cloud_free(cloud);
    cloud = when_text_read(context, "a.obj", "v 1 2 3 1.0\n");
    assert_int_equal(crease_cloud_field_count(cloud), 0);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_wrong_obj_then_a_sentence_says_where(void **state)
{
    const crease_status format = CREASE_ERROR_FORMAT;
    then_text_fails("a.obj", "o part\nf 1 2 3\n", format, "its vertices have 0 numbers");
    then_text_fails("a.obj", "v 1 2\n", format, "its vertices have 2 numbers");
    then_text_fails("a.obj", "v 1 2 3\nf 1 1 1\nv 1 2\n", format, "line 3: ends after 2");
    then_text_fails("a.obj", "v 1 2 3\nv 1 2 x\n", format, "line 2: 'x' is not a number");
    then_text_fails("a.obj", "v 1 2 3\nv 1 2 inf\n", CREASE_ERROR_VALUE, "line 2: z of point 2");
}

/* --------------------------------------------------------------------------------------- stl -- */

static const char ascii_stl[] =
    "solid part\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
    "   vertex 0 1 0\n  endloop\n endfacet\n facet normal 0 0 1\n  outer loop\n"
    "   vertex 1 0 0\n   vertex 1 1 0\n   vertex -0 1 0\n  endloop\n endfacet\nendsolid part\n";

static void then_square_is_read(const char *name, const void *bytes, size_t size, crease_type type)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_read(context, name, bytes, size);
    assert_int_equal(crease_cloud_count(cloud), 4);
    assert_int_equal(crease_cloud_coordinate_type(cloud), type);
    then_point_is(cloud, 0, 0, 0, 0);
    then_point_is(cloud, 1, 1, 0, 0);
    then_point_is(cloud, 2, 0, 1, 0);
    then_point_is(cloud, 3, 1, 1, 0);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

enum { BINARY_SIZE = 84 + 2 * 50 };

/* A square of two triangles. */
static void given_binary_stl(unsigned char bytes[BINARY_SIZE], const char *header)
{
    static const float corners[2][9] = {
        {0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, -0.0f, 1, 0}};
    memset(bytes, 0, BINARY_SIZE);
    memcpy(bytes, header, strlen(header));
    bytes[80] = 2;
    for (size_t i = 0; i < 2; i++)
        memcpy(bytes + 84 + 50 * i + 12, corners[i], sizeof corners[i]);
}

static void given_stl_then_corners_are_merged(void **state)
{
    unsigned char bytes[BINARY_SIZE];
    then_square_is_read("a.stl", ascii_stl, sizeof ascii_stl - 1, CREASE_TYPE_FLOAT64);
    given_binary_stl(bytes, "made by hand");
    then_square_is_read("a.stl", bytes, BINARY_SIZE, CREASE_TYPE_FLOAT32);
    given_binary_stl(bytes, "solid but binary");
    then_square_is_read("a.stl", bytes, BINARY_SIZE, CREASE_TYPE_FLOAT32);
    then_square_is_read("part", bytes, BINARY_SIZE, CREASE_TYPE_FLOAT32);
}

static void given_many_triangles_then_every_place_is_there_once(void **state)
{
    enum { SIDE = 40, TRIANGLES = SIDE * SIDE };
    unsigned char *bytes = calloc(1, 84 + TRIANGLES * 50);
    assert_non_null(bytes);
    const uint32_t count = TRIANGLES;
    memcpy(bytes + 80, &count, 4);
    for (size_t i = 0; i < TRIANGLES; i++) {
        const float x = (float)(i % SIDE), y = (float)(i / SIDE);
        const float corners[9] = {x, y, 0, x + 1, y, 0, x, y + 1, 0};
        memcpy(bytes + 84 + 50 * i + 12, corners, sizeof corners);
    }
    crease_context *context = given_reader();
    crease_cloud *cloud = when_read(context, "a.stl", bytes, 84 + TRIANGLES * 50);
    assert_int_equal(crease_cloud_count(cloud), (SIDE + 1) * (SIDE + 1) - 1);
    crease_cloud_free(cloud);
    crease_context_free(context);
    free(bytes);
}

static void given_wrong_stl_then_a_sentence_says_what(void **state)
{
    unsigned char bytes[BINARY_SIZE + 50];
    given_binary_stl(bytes, "solid but binary");
    then_bytes_fail("a.stl", bytes, BINARY_SIZE - 1, CREASE_ERROR_TRUNCATED,
        "holds 1 triangles where its header promises 2");
    then_bytes_fail("a.stl", bytes, 50, CREASE_ERROR_TRUNCATED, "within the header");
    memset(bytes + BINARY_SIZE, 0, 50);
    then_bytes_fail("a.stl", bytes, BINARY_SIZE + 50, CREASE_ERROR_FORMAT, "holds 3 triangles");
    memset(bytes + 80, 0xff, 4);
    then_bytes_fail("a.stl", bytes, BINARY_SIZE, CREASE_ERROR_TRUNCATED, "promises 4294967295");
    given_binary_stl(bytes, "x");
    memcpy(bytes + 84 + 50 + 12 + 12 + 8, &(const float){NAN}, 4);
    then_bytes_fail(
        "a.stl", bytes, BINARY_SIZE, CREASE_ERROR_VALUE, "byte 158: z of point 4 is not a number");
    then_text_fails("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\n",
        CREASE_ERROR_TRUNCATED, "endsolid");
    then_text_fails("a.stl", "solid a\nfacet\nvertex 1 2 3\nvertex 1 2\nvertex 4 5 6\nendsolid\n",
        CREASE_ERROR_FORMAT, "line 4: ends after 2");
}

/* --------------------------------------------------------------------------------------- off -- */

static void given_off_of_every_kind_then_vertices_are_read(void **state)
{
    static const struct {
        const char *text;
        size_t size;
        bool normals;
        size_t fields;
    } files[] = {
        {WITH_SIZE("OFF\n2 1 0\n1 2 3\n4 5 6\n2 0 1\n"), false, 0},
        {WITH_SIZE("OFF 2 0 0 # counts\n# comment\n\n1 2 3 # first\n4 5 6\n"), false, 0},
        {WITH_SIZE("# comment\nCOFF\n2 0 0\n1 2 3 255 0 0 255\n4 5 6 0 1 2 3\n"), false, 4},
        {WITH_SIZE("COFF\n2 0 0\n1 2 3 0.5 0 0\n4 5 6 0 1 1\n"), false, 3},
        {WITH_SIZE("NOFF\n2 0 0\n1 2 3 0 0 1\n4 5 6 0 1 0\n"), true, 0},
        {WITH_SIZE("STCNOFF\n2 0 0\n1 2 3 0 0 1 1 1 1 0 0\n4 5 6 0 1 0 1 1 1 1 1\n"), true, 5},
        {WITH_SIZE("OFF BINARY\n\0\0\0\2\0\0\0\0\0\0\0\0\x3f\x80\0\0\x40\0\0\0\x40\x40\0\0"
                   "\x40\x80\0\0\x40\xa0\0\0\x40\xc0\0\0"),
            false, 0},
    };
    crease_context *context = given_reader();
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        crease_cloud *cloud = when_read(context, "a.off", files[i].text, files[i].size);
        assert_int_equal(crease_cloud_count(cloud), 2);
        assert_true((crease_cloud_normals(cloud) != NULL) == files[i].normals);
        assert_int_equal(crease_cloud_field_count(cloud), files[i].fields);
        then_point_is(cloud, 0, 1, 2, 3);
        then_point_is(cloud, 1, 4, 5, 6);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

static void given_wrong_off_then_a_sentence_says_where(void **state)
{
    const crease_status format = CREASE_ERROR_FORMAT, truncated = CREASE_ERROR_TRUNCATED;
    then_text_fails("a.off", "OFF\n", truncated, "ends before");
    then_text_fails("a.off", "4OFF\n1 0 0\n1 2 3 4\n", format, "3 dimensions: '4OFF'");
    then_text_fails("a.off", "1 2 3\n", format, "line 1: is no OFF");
    then_text_fails("a.off", "OFF\n-2 0 0\n", format, "line 2: the count of vertices");
    then_text_fails("a.off", "OFF\n2\n", format, "line 2: the count of faces");
    then_text_fails("a.off", "OFF\n2 0 0\n1 2 3\n", truncated, "before the 2 vertices");
    then_text_fails("a.off", "OFF\n4000000000 0 0\n1 2 3\n", truncated, "4000000000");
    then_text_fails("a.off", "OFF\n1 0 0\n1 2 3\n4 5 6\n", format, "more than the 1 vertices");
    then_text_fails("a.off", "OFF\n1 0 0\n1 2\n", format, "line 3: a vertex has 2 numbers");
    then_text_fails("a.off", "OFF\n2 0 0\n1 2 3\n4 x 6\n", format, "line 4: 'x' is not");
    then_text_fails("a.off", "OFF BINARY\nabc", truncated, "ends before");
    then_bytes_fail(
        "a.off", WITH_SIZE("OFF BINARY\n\xff\0\0\2\0\0\0\0\0\0\0\0"), format, "byte 11");
    then_bytes_fail(
        "a.off", WITH_SIZE("OFF BINARY\n\x7f\0\0\2\0\0\0\0\0\0\0\0"), truncated, "2130");
}

/* ----------------------------------------------------------------------------------- hostile -- */

static void given_hostile_bytes_then_the_readers_survive(void **state)
{
    unsigned char binary[BINARY_SIZE];
    given_binary_stl(binary, "made by hand");
    const struct {
        const char *name;
        const void *bytes;
        size_t size;
        bool loose;
    } files[] = {{"a.obj", WITH_SIZE("v 1 2 3\nvn 0 0 1\nv 4 5.5 6\nvn 0 1 0\n"), true},
        {"a.stl", WITH_SIZE(ascii_stl), false}, {"a.stl", binary, sizeof binary, false},
        {"a.off", WITH_SIZE("COFF\n2 1 0\n1 2 3 4 5 6\n4 5.25 6 7 8 9\n2 0 1\n"), true},
        {"a.off",
            WITH_SIZE("OFF BINARY\n\0\0\0\1\0\0\0\0\0\0\0\0\x3f\x80\0\0\x40\0\0\0\x40\x40\0\0"),
            false}};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        then_every_truncation_is_survived(
            files[i].name, files[i].bytes, files[i].size, files[i].loose);
        then_damage_is_survived(files[i].name, files[i].bytes, files[i].size, 3000);
        then_every_failed_allocation_is_survived(files[i].name, files[i].bytes, files[i].size);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_obj_then_vertices_are_read),
        cmocka_unit_test(given_obj_with_a_normal_for_each_vertex_then_they_are_read),
        cmocka_unit_test(given_obj_with_colours_or_weights_then_they_are_told_apart),
        cmocka_unit_test(given_wrong_obj_then_a_sentence_says_where),
        cmocka_unit_test(given_stl_then_corners_are_merged),
        cmocka_unit_test(given_many_triangles_then_every_place_is_there_once),
        cmocka_unit_test(given_wrong_stl_then_a_sentence_says_what),
        cmocka_unit_test(given_off_of_every_kind_then_vertices_are_read),
        cmocka_unit_test(given_wrong_off_then_a_sentence_says_where),
        cmocka_unit_test(given_hostile_bytes_then_the_readers_survive),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
