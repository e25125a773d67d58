/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* LAS files of every version and point format, made here byte by byte. */
#include "given_bytes.h"

enum { ROOM = 1024, POINTS = 3 };

typedef struct las_bytes {
    unsigned char bytes[ROOM];
    size_t size;
} las_bytes;

static const size_t records[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

static void put(las_bytes *file, size_t at, uint64_t value, size_t size)
{
    for (size_t i = 0; i < size; i++)
        file->bytes[at + i] = (unsigned char)(value >> 8 * i);
}

static void put_double(las_bytes *file, size_t at, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(file, at, bits, sizeof bits);
}

/* Points (i, 10 i, -i) / 4 + (500000, 4000000, 100) with intensity 7 i; extra: bytes that a
 * producer has added to each record. */
static void given_las(las_bytes *file, int minor, int format, size_t extra)
{
    const size_t header = minor >= 4 ? 375 : 227, record = records[format] + extra;
    *file = (las_bytes){.size = header + POINTS * record};
    memcpy(file->bytes, "LASF", 4);
    file->bytes[24] = 1;
    file->bytes[25] = (unsigned char)minor;
    put(file, 94, header, 2);
    put(file, 96, header, 4);
    put(file, 104, (uint64_t)format, 1);
    put(file, 105, record, 2);
    put(file, 107, minor >= 4 ? 0 : POINTS, 4);
    const double offset[3] = {500000, 4000000, 100};
    for (size_t c = 0; c < 3; c++) {
        put_double(file, 131 + 8 * c, 0.25);
        put_double(file, 155 + 8 * c, offset[c]);
    }
    if (minor >= 4)
        put(file, 247, POINTS, 8);
    for (int i = 0; i < POINTS; i++) {
        const size_t at = header + (size_t)i * record;
        put(file, at, (uint32_t)i, 4);
        put(file, at + 4, (uint32_t)(10 * i), 4);
        put(file, at + 8, (uint32_t)-i, 4);
        put(file, at + 12, (uint64_t)(7 * i), 2);
        put(file, at + (format < 6 ? 15 : 16), format < 6 ? 0xe0 | 5 : 70, 1);
    }
}

static void given_every_point_format_then_points_and_fields_are_read(void **state)
{
    crease_context *context = given_reader();
    las_bytes file;
    for (int format = 0; format <= 10; format++)
        for (size_t extra = 0; extra < 8; extra += 7) {
            given_las(&file, format < 6 ? 2 : 4, format, extra);
            crease_cloud *cloud = when_read(context, "a.las", file.bytes, file.size);
            assert_int_equal(crease_cloud_count(cloud), POINTS);
            then_point_is(cloud, 2, 500000.5, 4000005, 99.5);
            then_field_is(cloud, "intensity", CREASE_TYPE_UINT16, 2, 14);
            then_field_is(cloud, "classification", CREASE_TYPE_UINT8, 1, format < 6 ? 5 : 70);
            crease_cloud_free(cloud);
        }
    crease_context_free(context);
}

static void given_colours_then_they_are_fields(void **state)
{
    static const struct {
        int format;
        size_t red;
    } formats[] = {{2, 20}, {3, 28}, {5, 28}, {7, 30}, {8, 30}, {10, 30}};
    crease_context *context = given_reader();
    las_bytes file;
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        const int format = formats[i].format;
        given_las(&file, 4, format, 0);
        put(&file, 375 + records[format] + formats[i].red + 2, 65535, 2);
        crease_cloud *cloud = when_read(context, "a.las", file.bytes, file.size);
        then_field_is(cloud, "red", CREASE_TYPE_UINT16, 1, 0);
        then_field_is(cloud, "green", CREASE_TYPE_UINT16, 1, 65535);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
}

static void then_las_fails(const las_bytes *file, crease_status expected, const char *part)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    assert_int_equal(
        read_bytes(context, "a.las", file->bytes, file->size, false, &cloud), expected);
    if (!strstr(crease_context_message(context), part))
        fail_msg("'%s' lacks '%s'", crease_context_message(context), part);
    crease_context_free(context);
}

static void given_wrong_las_then_a_sentence_says_what(void **state)
{
    las_bytes file;
    given_las(&file, 2, 1, 0);
    put(&file, 104, 0x81, 1);
    then_las_fails(&file, CREASE_ERROR_FORMAT, "is compressed (LAZ); give it as LAS");
    given_las(&file, 2, 1, 0);
    put(&file, 104, 11, 1);
    then_las_fails(&file, CREASE_ERROR_FORMAT, "its point format is none of LAS 1.0 to 1.4");
    given_las(&file, 2, 1, 0);
    put(&file, 105, 12, 2);
    then_las_fails(&file, CREASE_ERROR_FORMAT, "its point format is none of");
    given_las(&file, 2, 1, 0);
    put(&file, 107, 4, 4);
    then_las_fails(&file, CREASE_ERROR_TRUNCATED, "the 4 points that its header promises");
    given_las(&file, 4, 6, 0);
    put(&file, 247, UINT64_MAX, 8);
    then_las_fails(&file, CREASE_ERROR_TRUNCATED, "get the whole file");
    given_las(&file, 2, 1, 0);
    put(&file, 96, 100, 4);
    then_las_fails(&file, CREASE_ERROR_FORMAT, "its points begin inside its header");
    given_las(&file, 2, 1, 0);
    put_double(&file, 131, INFINITY);
    then_las_fails(&file, CREASE_ERROR_VALUE, "x of point 1 is not a number");
    file.size = 100;
    then_las_fails(&file, CREASE_ERROR_TRUNCATED, "ends within the header of a LAS file");
}

static void given_hostile_bytes_then_the_reader_survives(void **state)
{
    las_bytes file;
    for (int format = 3; format <= 7; format += 4) {
        given_las(&file, format < 6 ? 2 : 4, format, 0);
        then_every_truncation_is_survived("a.las", file.bytes, file.size, false);
        then_damage_is_survived("a.las", file.bytes, file.size, 3000);
        then_every_failed_allocation_is_survived("a.las", file.bytes, file.size);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_every_point_format_then_points_and_fields_are_read),
        cmocka_unit_test(given_colours_then_they_are_fields),
        cmocka_unit_test(given_wrong_las_then_a_sentence_says_what),
        cmocka_unit_test(given_hostile_bytes_then_the_reader_survives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
