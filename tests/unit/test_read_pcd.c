/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_bytes.h"

#include "read/lzf.h"

/* A header of three floats; the count of points is `width` x 1. */
#define HEADER(width, data)                                                                        \
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"          \
    "TYPE F F F\nCOUNT 1 1 1\nWIDTH " width "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " width   \
    "\nDATA " data "\n"

enum { ROOM = 2048 };

typedef struct buffer {
    unsigned char bytes[ROOM];
    size_t size;
} buffer;

static void append(buffer *to, const void *bytes, size_t size)
{
    assert_true(to->size + size <= ROOM);
    memcpy(to->bytes + to->size, bytes, size);
    to->size += size;
}

static void append_u32(buffer *to, uint32_t value)
{
    const unsigned char bytes[] = {(unsigned char)value, (unsigned char)(value >> 8),
        (unsigned char)(value >> 16), (unsigned char)(value >> 24)};
    append(to, bytes, 4);
}

/* Data as one literal run after the other, with the two sizes in front. */
static void append_packed(buffer *to, const unsigned char *bytes, size_t size)
{
    append_u32(to, (uint32_t)(size + (size + 31) / 32));
    append_u32(to, (uint32_t)size);
    for (size_t i = 0; i < size; i += 32) {
        const size_t run = size - i < 32 ? size - i : 32;
        const unsigned char control = (unsigned char)(run - 1);
        append(to, &control, 1);
        append(to, bytes + i, run);
    }
}

static void given_ascii_then_points_are_read(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud =
        when_text_read(context, "a.pcd", HEADER("2", "ascii") "1 2 3\n# pause\n4 5.5 6\n");
    assert_int_equal(crease_cloud_coordinate_type(cloud), CREASE_TYPE_FLOAT32);
    then_point_is(cloud, 0, 1, 2, 3);
    then_point_is(cloud, 1, 4, 5.5, 6);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_old_headers_then_points_are_read(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.pcd",
        "# .PCD v.5\r\nVERSION .5\r\nCOLUMNS x y z\r\nSIZE 4 4 4\r\nTYPE F F F\r\n"
        "POINTS 1\r\nDATA ascii\r\n1 2 3\r\n");
    then_point_is(cloud, 0, 1, 2, 3);
    crease_cloud_free(cloud);
    cloud = when_text_read(context, "a.pcd",
        "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 0.1\n");
    then_point_is(cloud, 0, 1, 2, 0.1);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static const char many_fields[] =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z _ rgb normal_x normal_y normal_z hist label\n"
    "SIZE 4 4 4 1 4 4 4 4 2 8\nTYPE F F F U F F F F I I\nCOUNT 1 1 1 3 1 1 1 1 2 1\n"
    "WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ";

typedef struct values {
    float x, y, z;
    uint32_t rgb;
    float normal[3];
    int16_t hist[2];
    int64_t label;
} values;

static const values many_values[2] = {
    {1, 2, 3, 0x00ff8001, {0, 0, 1}, {-5, 6}, -7}, {4, 5, 6, 0xff010203, {0, 1, 0}, {7, 8}, 9}};

static void given_binary(buffer *to)
{
    to->size = 0;
    append(to, many_fields, sizeof many_fields - 1);
    append(to, "binary\n", 7);
    for (int i = 0; i < 2; i++) {
        append(to, &many_values[i], 12);
        append(to, "pad", 3);
        append(to, &many_values[i].rgb, 4);
        append(to, many_values[i].normal, 12);
        append(to, many_values[i].hist, 4);
        append(to, &many_values[i].label, 8);
    }
}

static void given_compressed(buffer *to, bool padded)
{
    buffer fields = {.size = 0};
    static const size_t offsets[] = {offsetof(values, x), offsetof(values, y), offsetof(values, z),
        SIZE_MAX, offsetof(values, rgb), offsetof(values, normal), offsetof(values, normal) + 4,
        offsetof(values, normal) + 8, offsetof(values, hist), offsetof(values, label)};
    static const size_t sizes[] = {4, 4, 4, 3, 4, 4, 4, 4, 4, 8};
    for (int field = 0; field < 10; field++)
        for (int i = 0; i < 2; i++)
            if (offsets[field] != SIZE_MAX)
                append(&fields, (const char *)&many_values[i] + offsets[field], sizes[field]);
            else if (padded)
                append(&fields, "pad", 3);
    to->size = 0;
    append(to, many_fields, sizeof many_fields - 1);
    append(to, "binary_compressed\n", 18);
    append_packed(to, fields.bytes, fields.size);
}

static void then_many_values_are_read(const buffer *file)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_read(context, "a.pcd", file->bytes, file->size);
    assert_int_equal(crease_cloud_count(cloud), 2);
    assert_int_equal(crease_cloud_field_count(cloud), 6);
    then_point_is(cloud, 0, 1, 2, 3);
    then_point_is(cloud, 1, 4, 5, 6);
    assert_near(crease_cloud_normals(cloud)[2], 1, 0);
    assert_near(crease_cloud_normals(cloud)[4], 1, 0);
    then_field_is(cloud, "red", CREASE_TYPE_UINT8, 0, 255);
    then_field_is(cloud, "green", CREASE_TYPE_UINT8, 0, 128);
    then_field_is(cloud, "blue", CREASE_TYPE_UINT8, 1, 3);
    then_field_is(cloud, "hist_0", CREASE_TYPE_INT16, 0, -5);
    then_field_is(cloud, "hist_1", CREASE_TYPE_INT16, 1, 8);
    then_field_is(cloud, "label", CREASE_TYPE_FLOAT64, 0, -7);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_many_fields_then_all_codings_agree(void **state)
{
    buffer file;
    given_binary(&file);
    then_many_values_are_read(&file);
    given_compressed(&file, false);
    then_many_values_are_read(&file);
    given_compressed(&file, true);
    then_many_values_are_read(&file);
    file.size = 0;
    append(&file, many_fields, sizeof many_fields - 1);
    static const char rows[] = "ascii\n1 2 3 0 0 0 2.34639707e-38 0 0 1 -5 6 -7\n"
                               "4 5 6 0 0 0 -1.71480857e+38 0 1 0 7 8 9\n";
    append(&file, rows, sizeof rows - 1);
    then_many_values_are_read(&file);
}

static void given_rgba_then_alpha_is_a_field(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.pcd",
        "VERSION 0.7\nFIELDS x y z rgba\nSIZE 4 4 4 4\nTYPE F F F U\nWIDTH 1\nDATA ascii\n"
        "1 2 3 4278255360\n");
    then_field_is(cloud, "alpha", CREASE_TYPE_UINT8, 0, 255);
    then_field_is(cloud, "green", CREASE_TYPE_UINT8, 0, 255);
    then_field_is(cloud, "red", CREASE_TYPE_UINT8, 0, 0);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_an_organised_cloud_with_holes_then_error_or_left_out(void **state)
{
    static const char text[] =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\n"
        "POINTS 4\nDATA ascii\n1 2 3\nnan nan nan\n4 5 6\nnan nan nan\n";
    then_text_fails("a.pcd", text, CREASE_ERROR_VALUE, "line 11: x of point 2 is not a number");
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    assert_int_equal(read_bytes(context, "a.pcd", text, sizeof text - 1, true, &cloud), CREASE_OK);
    assert_int_equal(crease_cloud_count(cloud), 2);
    then_point_is(cloud, 1, 4, 5, 6);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

#define BEGIN "VERSION 0.7\n"
#define FIELDS "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"

static void given_wrong_headers_then_a_sentence_says_where(void **state)
{
    const crease_status format = CREASE_ERROR_FORMAT;
    then_text_fails("a.pcd", BEGIN, CREASE_ERROR_TRUNCATED, "ends before DATA");
    then_text_fails("a.pcd", BEGIN "HELLO 1\n", format, "line 2: unknown word in the header: 'HE");
    then_text_fails("a.pcd", BEGIN FIELDS "WIDTH 1\nDATA zip\n", format, "kind of DATA: 'zip'");
    then_text_fails("a.pcd", BEGIN FIELDS "WIDTH -1\nDATA ascii\n", format, "line 5: WIDTH is no");
    then_text_fails(
        "a.pcd", BEGIN FIELDS "WIDTH 1\nHEIGHT x\nDATA ascii\n", format, "HEIGHT is no");
    then_text_fails("a.pcd", BEGIN FIELDS "POINTS\nDATA ascii\n", format, "POINTS is no whole");
    then_text_fails("a.pcd", BEGIN FIELDS "DATA ascii\n", format, "neither POINTS nor WIDTH");
    then_text_fails("a.pcd", BEGIN FIELDS "WIDTH 2\nHEIGHT 2\nPOINTS 3\nDATA ascii\n", format,
        "POINTS is not WIDTH times HEIGHT");
    then_text_fails("a.pcd",
        BEGIN FIELDS "WIDTH 900000000000000000\nHEIGHT 900000000000000000\nDATA ascii\n", format,
        "WIDTH is too large");
    then_text_fails("a.pcd", BEGIN "FIELDS x y\nSIZE 4\nTYPE F F\nWIDTH 1\nDATA ascii\n", format,
        "no SIZE for field 'y'");
    then_text_fails("a.pcd", BEGIN "FIELDS x y\nSIZE 4 3\nTYPE F F\nWIDTH 1\nDATA ascii\n", format,
        "no such TYPE and SIZE, of field 'y'");
    then_text_fails("a.pcd", BEGIN "FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1\nWIDTH 1\nDATA ascii\n",
        format, "no COUNT for field 'y'");
    then_text_fails("a.pcd",
        BEGIN "FIELDS x\nSIZE 4\nTYPE F\nCOUNT 4000000000\nWIDTH 1\nDATA ascii\n", format,
        "more than 2048 values");
    then_text_fails("a.pcd", BEGIN "FIELDS x y\nSIZE 4 4\nTYPE F F\nWIDTH 1\nDATA ascii\n", format,
        "no coordinate 'z'");
    then_text_fails("a.pcd", BEGIN "WIDTH 1\nDATA ascii\n", format, "no coordinate 'x'");
}

static void given_wrong_data_then_a_sentence_says_what(void **state)
{
    then_text_fails("a.pcd", HEADER("2", "ascii") "1 2 3\n", CREASE_ERROR_TRUNCATED,
        "holds 1 points where its header promises 2");
    then_text_fails("a.pcd", HEADER("1", "ascii") "1 2 3\n1 2 3\n", CREASE_ERROR_FORMAT, "holds 2");
    then_text_fails("a.pcd", HEADER("1", "ascii") "1 2\n", CREASE_ERROR_FORMAT, "line 12: ends");
    then_text_fails("a.pcd", HEADER("2", "binary") "abcdefghijkl", CREASE_ERROR_TRUNCATED, "1 poi");
    then_text_fails("a.pcd", HEADER("4000000000", "binary") "abc", CREASE_ERROR_TRUNCATED, "0 poi");
    then_text_fails("a.pcd", HEADER("1", "binary_compressed") "abc", CREASE_ERROR_TRUNCATED,
        "ends before the sizes");
    then_text_fails("a.pcd", HEADER("1", "binary_compressed") "\x05\x01\x01\x01\x0c\x01\x01\x01",
        CREASE_ERROR_TRUNCATED, "ends before the 16843013 bytes");
    const char *const header = HEADER("1", "binary_compressed");
    static const unsigned char wrong_size[] = {1, 0, 0, 0, 13, 0, 0, 0, 0};
    static const unsigned char wrong_data[] = {1, 0, 0, 0, 12, 0, 0, 0, 32};
    buffer file = {.size = 0};
    append(&file, header, strlen(header));
    append(&file, wrong_size, sizeof wrong_size);
    then_bytes_fail("a.pcd", file.bytes, file.size, CREASE_ERROR_FORMAT, "not of the size");
    file.size = strlen(header);
    append(&file, wrong_data, sizeof wrong_data);
    then_bytes_fail("a.pcd", file.bytes, file.size, CREASE_ERROR_FORMAT, "do not expand");
}

static void given_a_promise_that_no_block_can_keep_then_nothing_is_allocated(void **state)
{
    const char *const header = HEADER("300000000", "binary_compressed");
    buffer file = {.size = 0};
    append(&file, header, strlen(header));
    append_u32(&file, 4);
    append_u32(&file, 3600000000u);
    append(&file,
        "\x03"
        "abc",
        4);
    then_bytes_fail("a.pcd", file.bytes, file.size, CREASE_ERROR_FORMAT, "too short for what");
}

/* Literal "ab", then 4 bytes from 2 back ("abab"), then 9 + 2 + 1 bytes of "b" from 1 back. */
static void given_a_block_made_by_hand_then_it_expands(void **state)
{
    static const unsigned char block[] = {1, 'a', 'b', 2 << 5, 1, 7 << 5, 3, 0};
    unsigned char out[18];
    assert_true(crease_lzf_expand(block, sizeof block, out, sizeof out));
    assert_memory_equal(out, "abababbbbbbbbbbbbb", sizeof out);
    assert_false(crease_lzf_expand(block, sizeof block, out, sizeof out - 1));
    for (size_t size = 0; size < sizeof block; size++)
        assert_false(crease_lzf_expand(block, size, out, sizeof out));
    static const unsigned char before[] = {0, 'a', 1 << 5, 1};
    assert_false(crease_lzf_expand(before, sizeof before, out, 4));
    static const unsigned char far_before[] = {0, 'a', (1 << 5) + 31, 0};
    assert_false(crease_lzf_expand(far_before, sizeof far_before, out, 4));
}

static void given_random_blocks_then_nothing_is_written_outside(void **state)
{
    for (uint64_t seed = 0; seed < 20000; seed++) {
        unsigned char in[24], *out = malloc(64);
        assert_non_null(out);
        for (size_t i = 0; i < sizeof in; i++)
            in[i] = (unsigned char)(crease_random_below(seed, 1, i, 256) >> (i % 3));
        crease_lzf_expand(in, sizeof in, out, crease_random_below(seed, 2, 0, 64));
        free(out);
    }
}

static void given_hostile_bytes_then_the_reader_survives(void **state)
{
    static const char ascii[] = HEADER("2", "ascii") "1 2 3\n4 5.5 6\n";
    buffer file;
    then_every_truncation_is_survived("a.pcd", ascii, sizeof ascii - 1, true);
    then_damage_is_survived("a.pcd", ascii, sizeof ascii - 1, 3000);
    then_every_failed_allocation_is_survived("a.pcd", ascii, sizeof ascii - 1);
    for (int compressed = 0; compressed < 2; compressed++) {
        if (compressed)
            given_compressed(&file, true);
        else
            given_binary(&file);
        then_every_truncation_is_survived("a.pcd", file.bytes, file.size, false);
        then_damage_is_survived("a.pcd", file.bytes, file.size, 5000);
        then_every_failed_allocation_is_survived("a.pcd", file.bytes, file.size);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_ascii_then_points_are_read),
        cmocka_unit_test(given_old_headers_then_points_are_read),
        cmocka_unit_test(given_many_fields_then_all_codings_agree),
        cmocka_unit_test(given_rgba_then_alpha_is_a_field),
        cmocka_unit_test(given_an_organised_cloud_with_holes_then_error_or_left_out),
        cmocka_unit_test(given_wrong_headers_then_a_sentence_says_where),
        cmocka_unit_test(given_wrong_data_then_a_sentence_says_what),
        cmocka_unit_test(given_a_promise_that_no_block_can_keep_then_nothing_is_allocated),
        cmocka_unit_test(given_a_block_made_by_hand_then_it_expands),
        cmocka_unit_test(given_random_blocks_then_nothing_is_written_outside),
        cmocka_unit_test(given_hostile_bytes_then_the_reader_survives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
