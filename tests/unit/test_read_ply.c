/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_bytes.h"

#define HEADER(format, count)                                                                      \
    "ply\nformat " format " 1.0\nelement vertex " count                                            \
    "\nproperty float x\nproperty float y\nproperty float z\nend_header\n"

/* A header and bytes behind it. */
static size_t join(unsigned char *out, const char *header, const void *body, size_t size)
{
    const size_t length = strlen(header);
    memcpy(out, header, length);
    memcpy(out + length, body, size);
    return length + size;
}

static void given_ascii_then_points_are_read(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud =
        when_text_read(context, "a.ply", HEADER("ascii", "2") "1 2.5 -3e2\n.5 0 +7\n");
    assert_int_equal(crease_cloud_count(cloud), 2);
    assert_int_equal(crease_cloud_coordinate_type(cloud), CREASE_TYPE_FLOAT32);
    assert_null(crease_cloud_normals(cloud));
    then_point_is(cloud, 0, 1, 2.5, -300);
    then_point_is(cloud, 1, 0.5, 0, 7);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_floats_in_ascii_then_they_are_floats(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.ply", HEADER("ascii", "1") "0.1 0.2 0.3\n");
    then_point_is(cloud, 0, (double)0.1f, (double)0.2f, (double)0.3f);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_every_spelling_of_every_type_then_fields_keep_their_types(void **state)
{
    static const struct {
        const char *name;
        crease_type type;
    } types[] = {{"char", CREASE_TYPE_INT8}, {"int8", CREASE_TYPE_INT8},
        {"uchar", CREASE_TYPE_UINT8}, {"uint8", CREASE_TYPE_UINT8}, {"short", CREASE_TYPE_INT16},
        {"int16", CREASE_TYPE_INT16}, {"ushort", CREASE_TYPE_UINT16},
        {"uint16", CREASE_TYPE_UINT16}, {"int", CREASE_TYPE_INT32}, {"int32", CREASE_TYPE_INT32},
        {"uint", CREASE_TYPE_UINT32}, {"uint32", CREASE_TYPE_UINT32},
        {"float", CREASE_TYPE_FLOAT32}, {"float32", CREASE_TYPE_FLOAT32},
        {"double", CREASE_TYPE_FLOAT64}, {"float64", CREASE_TYPE_FLOAT64},
        {"int64", CREASE_TYPE_FLOAT64}, {"uint64", CREASE_TYPE_FLOAT64}};
    crease_context *context = given_reader();
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        char text[400];
        snprintf(text, sizeof text,
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
            "property double z\nproperty %s value\nend_header\n1 2 3 100\n",
            types[i].name);
        crease_cloud *cloud = when_text_read(context, "a.ply", text);
        assert_int_equal(crease_cloud_coordinate_type(cloud), CREASE_TYPE_FLOAT64);
        then_field_is(cloud, "value", types[i].type, 0, 100);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

static const char all_types[] =
    "element vertex 1\nproperty char a\nproperty double x\nproperty uchar b\nproperty float y\n"
    "property short c\nproperty ushort d\nproperty int z\nproperty uint e\nproperty int64 f\n"
    "end_header\n";

static void then_all_types_are_read(const char *format, const unsigned char *body, size_t size)
{
    unsigned char bytes[600];
    char header[500];
    snprintf(header, sizeof header, "ply\nformat %s 1.0\n%s", format, all_types);
    crease_context *context = given_reader();
    crease_cloud *cloud = when_read(context, "a.ply", bytes, join(bytes, header, body, size));
    then_point_is(cloud, 0, 1.5, -2.25, -7);
    then_field_is(cloud, "a", CREASE_TYPE_INT8, 0, -2);
    then_field_is(cloud, "b", CREASE_TYPE_UINT8, 0, 200);
    then_field_is(cloud, "c", CREASE_TYPE_INT16, 0, -300);
    then_field_is(cloud, "d", CREASE_TYPE_UINT16, 0, 65535);
    then_field_is(cloud, "e", CREASE_TYPE_UINT32, 0, 4000000000.0);
    then_field_is(cloud, "f", CREASE_TYPE_FLOAT64, 0, -1);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_every_type_in_both_binaries_then_values_agree(void **state)
{
    static const unsigned char big[] = {0xfe, 0x3f, 0xf8, 0, 0, 0, 0, 0, 0, 200, 0xc0, 0x10, 0, 0,
        0xfe, 0xd4, 0xff, 0xff, 0xff, 0xff, 0xff, 0xf9, 0xee, 0x6b, 0x28, 0, 0xff, 0xff, 0xff, 0xff,
        0xff, 0xff, 0xff, 0xff};
    static const unsigned char little[] = {0xfe, 0, 0, 0, 0, 0, 0, 0xf8, 0x3f, 200, 0, 0, 0x10,
        0xc0, 0xd4, 0xfe, 0xff, 0xff, 0xf9, 0xff, 0xff, 0xff, 0, 0x28, 0x6b, 0xee, 0xff, 0xff, 0xff,
        0xff, 0xff, 0xff, 0xff, 0xff};
    then_all_types_are_read("binary_big_endian", big, sizeof big);
    then_all_types_are_read("binary_little_endian", little, sizeof little);
}

static void given_normals_then_they_are_normals_and_parts_of_them_fields(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float nx\nproperty float x\n"
        "property float y\nproperty float z\nproperty float ny\nproperty float nz\nend_header\n"
        "0 1 2 3 0 1\n");
    assert_non_null(crease_cloud_normals(cloud));
    assert_near(crease_cloud_normals(cloud)[2], 1, 0);
    assert_int_equal(crease_cloud_field_count(cloud), 0);
    crease_cloud_free(cloud);
    cloud = when_text_read(context, "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float nx\nproperty float x\n"
        "property float y\nproperty float z\nproperty float ny\nend_header\n0 1 2 3 4\n");
    assert_null(crease_cloud_normals(cloud));
    then_field_is(cloud, "ny", CREASE_TYPE_FLOAT32, 0, 4);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static const char lists_around[] =
    "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nobj_info x\r\nelement face 2\r\n"
    "property list uchar int vertex_indices  \r\nelement vertex 2\r\nproperty float x\r\n"
    "property list uint8 float32 extra\r\nproperty float y\r\nproperty float z\r\n"
    "element tristrips 1\r\nproperty list int int vertex_indices\r\nend_header\r\n"
    "3 0 1 0\r\n4 0 1 0 1\r\n\r\n1 2 9 9 2 3\r\n4 0 5 6\r\n6 0 1 0 -1 1 0\r\n";

static void given_lists_everywhere_and_crlf_then_they_are_passed_over(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.ply", lists_around);
    assert_int_equal(crease_cloud_count(cloud), 2);
    assert_int_equal(crease_cloud_field_count(cloud), 0);
    then_point_is(cloud, 0, 1, 2, 3);
    then_point_is(cloud, 1, 4, 5, 6);
    assert_string_equal(last_warning, "");
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static const char binary_lists[] =
    "ply\nformat binary_little_endian 1.0\nelement face 2\nproperty list uchar short i\n"
    "element grid 1\nproperty int a\nelement vertex 2\nproperty uchar x\n"
    "property list ushort uchar extra\nproperty uchar y\nproperty uchar z\nend_header\n"
    "\x02"
    "aabb"
    "\x01"
    "cc"
    "dddd"
    "\x01\x03\x00"
    "eee"
    "\x02\x03"
    "\x04\x00\x00\x05\x06";

static void given_binary_lists_then_they_are_passed_over(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_read(context, "a.ply", binary_lists, sizeof binary_lists - 1);
    then_point_is(cloud, 0, 1, 2, 3);
    then_point_is(cloud, 1, 4, 5, 6);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_no_vertices_then_the_cloud_is_empty(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.ply", HEADER("binary_little_endian", "0"));
    assert_int_equal(crease_cloud_count(cloud), 0);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_wrong_headers_then_a_sentence_says_where(void **state)
{
    const crease_status format = CREASE_ERROR_FORMAT;
    then_text_fails("a.ply", "solid\n", format, "line 1: does not begin with 'ply'");
    then_text_fails("a.ply", "ply\nformat ascii 1.0\n", CREASE_ERROR_TRUNCATED, "end_header");
    then_text_fails(
        "a.ply", "ply\nformat ebcdic 1.0\n", format, "line 2: unknown format: 'ebcdic'");
    then_text_fails("a.ply", "ply\nelement vertex -1\n", format, "line 2: the count");
    then_text_fails("a.ply", "ply\nelement vertex\n", format, "line 2: the count");
    then_text_fails("a.ply", "ply\nelement\n", format, "line 2: an element without");
    then_text_fails("a.ply", "ply\nproperty float x\n", format, "before the first element");
    then_text_fails("a.ply", "ply\nelement vertex 1\nproperty quad x\n", format, "'quad'");
    then_text_fails("a.ply", "ply\nelement vertex 1\nproperty float\n", format, "without a name");
    then_text_fails(
        "a.ply", "ply\nelement vertex 1\nproperty list float int i\n", format, "whole number");
    then_text_fails("a.ply", "ply\nelement vertex 1\nproperty list int\n", format, "unknown type");
    then_text_fails("a.ply", "ply\nhello\n", format, "unknown word in the header: 'hello'");
    then_text_fails(
        "a.ply", "ply\nelement face 0\nend_header\n", format, "no line with the format");
    then_text_fails(
        "a.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n", format, "'vertex'");
    then_text_fails("a.ply",
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty int x\nproperty int y\nend_header\n",
        format, "no coordinate 'z'");
    then_text_fails("a.ply",
        "ply\nformat ascii 1.0\nelement vertex 0\nproperty int x\nproperty int y\nproperty int z\n"
        "property int x\nend_header\n",
        format, "both named 'x'");
}

static void given_wrong_rows_then_a_sentence_says_where(void **state)
{
    const crease_status format = CREASE_ERROR_FORMAT;
    then_text_fails("a.ply", HEADER("ascii", "2") "1 2 3\n1 2\n", format, "line 9: ends after 2");
    then_text_fails("a.ply", HEADER("ascii", "2") "1 2 3\n1 2 3 4\n", format, "line 9: has more");
    then_text_fails("a.ply", HEADER("ascii", "1") "1 x 3\n", format, "line 8: 'x' is not a number");
    then_text_fails("a.ply", HEADER("ascii", "1") "1 2z 3\n", format, "'2z' is not a number");
    then_text_fails("a.ply", HEADER("ascii", "3") "1 2 3\n1 2 3\n", CREASE_ERROR_TRUNCATED,
        "has 2 of the 3 points");
    then_text_fails("a.ply", HEADER("ascii", "1") "1 2 3\n4 5 6\n", format, "more than the 1");
    then_text_fails("a.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty uchar x\nproperty int y\n"
        "property int z\nproperty uchar red\nend_header\n1 2 3 256\n",
        format, "line 9: '256' does not fit the type of 'red'");
}

static void given_huge_counts_then_nothing_of_that_size_is_allocated(void **state)
{
    then_text_fails("a.ply", HEADER("ascii", "4000000000") "1 2 3\n", CREASE_ERROR_TRUNCATED,
        "1 of the 4000000000");
    then_text_fails("a.ply", HEADER("binary_little_endian", "9000000000000000000") "abc",
        CREASE_ERROR_TRUNCATED, "ends before the 9000000000000000000");
    then_text_fails("a.ply", HEADER("ascii", "99999999999999999999"), CREASE_ERROR_FORMAT,
        "is no whole number");
    then_text_fails("a.ply",
        "ply\nformat binary_little_endian 1.0\nelement face 9000000000000000000\n"
        "property list int int i\nelement vertex 0\nproperty int x\nproperty int y\n"
        "property int z\nend_header\n1234",
        CREASE_ERROR_TRUNCATED, "'face'");
}

static void given_too_many_properties_then_they_are_refused_before_they_take_memory(void **state)
{
    enum { SIZE = 60000 };
    char *text = malloc(SIZE);
    assert_non_null(text);
    size_t size = (size_t)sprintf(text, "ply\nformat ascii 1.0\nelement vertex 0\n");
    for (int i = 0; i < 2049; i++)
        size += (size_t)sprintf(text + size, "property int a%d\n", i);
    then_bytes_fail("a.ply", text, size, CREASE_ERROR_FORMAT, "line 2052: more than 2048");
    free(text);
}

static void given_a_list_of_negative_length_then_a_sentence_says_where(void **state)
{
    static const char bytes[] =
        "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list char int i\n"
        "element vertex 0\nproperty int x\nproperty int y\nproperty int z\nend_header\n\xff";
    then_bytes_fail("a.ply", bytes, sizeof bytes - 1, CREASE_ERROR_FORMAT, "has -1 entries");
}

static void given_points_that_are_not_finite_then_error_or_left_out(void **state)
{
    static const char text[] = HEADER("ascii", "4") "1 2 3\n4 nan 6\n-inf 2 3\n7 8 9\n";
    then_text_fails("a.ply", text, CREASE_ERROR_VALUE,
        "line 9: y of point 2 is not a number; mend it, or leave such points out with "
        "--skip-invalid");
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    assert_int_equal(read_bytes(context, "a.ply", text, sizeof text - 1, true, &cloud), CREASE_OK);
    assert_int_equal(crease_cloud_count(cloud), 2);
    then_point_is(cloud, 1, 7, 8, 9);
    assert_non_null(strstr(last_warning, "2 of 4 points"));
    crease_cloud_free(cloud);
    crease_context_free(context);
    static const char huge[] =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
        "property double z\nend_header\n1e300 0 5e-324\n";
    then_text_fails("a.ply", huge, CREASE_ERROR_VALUE, "x of point 1 is beyond 1e150");
}

static void given_a_binary_point_that_is_infinite_then_its_byte_is_named(void **state)
{
    static const char header[] = HEADER("binary_little_endian", "2");
    static const float body[] = {1, 2, 3, 4, INFINITY, 6};
    unsigned char bytes[300];
    const size_t size = join(bytes, header, body, sizeof body);
    char words[64];
    snprintf(words, sizeof words, "byte %zu: y of point 2 is infinite", sizeof header - 1 + 12);
    then_bytes_fail("a.ply", bytes, size, CREASE_ERROR_VALUE, words);
}

static void given_more_bytes_than_promised_then_a_point_is_an_error_and_less_a_warning(void **state)
{
    static const char text[] = HEADER("binary_little_endian", "1") "abcdefghijkl\n";
    crease_context *context = given_reader();
    crease_cloud_free(when_text_read(context, "a.ply", text));
    assert_non_null(strstr(last_warning, "1 bytes behind"));
    crease_context_free(context);
    then_text_fails("a.ply", HEADER("binary_little_endian", "1") "abcdefghijklabcdefghijkl",
        CREASE_ERROR_FORMAT, "more than the 1");
}

static void given_hostile_bytes_then_every_reader_survives(void **state)
{
    static const char ascii[] = HEADER("ascii", "3") "1.25 2 3\n4 5 6\n7.5 8.125 9.75\n";
    then_every_truncation_is_survived("a.ply", ascii, sizeof ascii - 1, true);
    then_every_truncation_is_survived("a.ply", lists_around, sizeof lists_around - 1, true);
    then_every_truncation_is_survived("a.ply", binary_lists, sizeof binary_lists - 1, false);
    then_damage_is_survived("a.ply", ascii, sizeof ascii - 1, 3000);
    then_damage_is_survived("a.ply", lists_around, sizeof lists_around - 1, 3000);
    then_damage_is_survived("a.ply", binary_lists, sizeof binary_lists - 1, 3000);
    then_every_failed_allocation_is_survived("a.ply", ascii, sizeof ascii - 1);
    then_every_failed_allocation_is_survived("a.ply", binary_lists, sizeof binary_lists - 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_ascii_then_points_are_read),
        cmocka_unit_test(given_floats_in_ascii_then_they_are_floats),
        cmocka_unit_test(given_every_spelling_of_every_type_then_fields_keep_their_types),
        cmocka_unit_test(given_every_type_in_both_binaries_then_values_agree),
        cmocka_unit_test(given_normals_then_they_are_normals_and_parts_of_them_fields),
        cmocka_unit_test(given_lists_everywhere_and_crlf_then_they_are_passed_over),
        cmocka_unit_test(given_binary_lists_then_they_are_passed_over),
        cmocka_unit_test(given_no_vertices_then_the_cloud_is_empty),
        cmocka_unit_test(given_wrong_headers_then_a_sentence_says_where),
        cmocka_unit_test(given_wrong_rows_then_a_sentence_says_where),
        cmocka_unit_test(given_huge_counts_then_nothing_of_that_size_is_allocated),
        cmocka_unit_test(given_too_many_properties_then_they_are_refused_before_they_take_memory),
        cmocka_unit_test(given_a_list_of_negative_length_then_a_sentence_says_where),
        cmocka_unit_test(given_points_that_are_not_finite_then_error_or_left_out),
        cmocka_unit_test(given_a_binary_point_that_is_infinite_then_its_byte_is_named),
        cmocka_unit_test(
            given_more_bytes_than_promised_then_a_point_is_an_error_and_less_a_warning),
        cmocka_unit_test(given_hostile_bytes_then_every_reader_survives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
