/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_bytes.h"

/* The text holds the points (1.5, 2, -3) and (4, 5.25, 6). */
static void then_two_points_are_read(const char *text)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.txt", text);
    if (crease_cloud_count(cloud) != 2)
        fail_msg("%zu points in '%s'", crease_cloud_count(cloud), text);
    then_point_is(cloud, 0, 1.5, 2, -3);
    then_point_is(cloud, 1, 4, 5.25, 6);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_every_separator_then_points_are_read(void **state)
{
    then_two_points_are_read("1.5 2 -3\n4 5.25 6\n");
    then_two_points_are_read("1.5 2 -3\n4 5.25 6");
    then_two_points_are_read("  1.5   2\t-3  \r\n\r\n4 5.25 6\r\n");
    then_two_points_are_read("1.5\t2\t-3\n4\t5.25\t6\n");
    then_two_points_are_read("1.5,2,-3\n4,5.25,6\n");
    then_two_points_are_read("1.5, 2, -3\n4, 5.25, 6\n");
    then_two_points_are_read("1.5,2,-3,\n4,5.25,6,\n");
    then_two_points_are_read("1.5;2;-3\n4;5.25;6\n");
    then_two_points_are_read("1,5;2,0;-3\n4;5,25;6\n");
    then_two_points_are_read("1,5 2,0 -3,0\n4,0 5,25 6,0\n");
    then_two_points_are_read("1,5\t2,0\t-3,0\n4,0\t5,25\t6,0\n");
}

static void given_headers_and_comments_then_points_are_read(void **state)
{
    then_two_points_are_read("x y z\n1.5 2 -3\n4 5.25 6\n");
    then_two_points_are_read("\xef\xbb\xbfX,Y,Z\n1.5,2,-3\n4,5.25,6\n");
    then_two_points_are_read("\"x\";\"y\";\"z\"\n1.5;2;-3\n4;5.25;6\n");
    then_two_points_are_read("# made by a scanner\n\n1.5 2 -3\n# pause\n4 5.25 6\n// end\n");
    then_two_points_are_read("//X Y Z\n1.5 2 -3\n4 5.25 6\n");
    then_two_points_are_read("z y x\n-3 2 1.5\n6 5.25 4\n");
    then_two_points_are_read("# z y x\n-3 2 1.5\n6 5.25 4\n");
    then_two_points_are_read("2\n1.5 2 -3\n4 5.25 6\n");
    then_two_points_are_read("id,x,y,z,kind\n1,1.5,2,-3,corner\n2,4,5.25,6,\"an, end\"\n");
    then_two_points_are_read("P1 1.5 2 -3\nP2 4 5.25 6\n");
}

static void given_named_columns_then_they_are_fields(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud =
        when_text_read(context, "a.csv", "x;y;z;intensity;Time stamp\n1;2;3;0,5;7\n4;5;6;;8\n");
    then_field_is(cloud, "intensity", CREASE_TYPE_FLOAT64, 0, 0.5);
    const crease_field field = crease_cloud_find_field(cloud, "intensity");
    assert_true(isnan(crease_field_value(&field, 1)));
    then_field_is(cloud, "Time_stamp", CREASE_TYPE_FLOAT64, 1, 8);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_colours_then_they_are_bytes(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud =
        when_text_read(context, "a.asc", "//X Y Z R G B\n1 2 3 0 128 255\n4 5 6 1 2 256\n");
    then_field_is(cloud, "G", CREASE_TYPE_UINT8, 0, 128);
    then_field_is(cloud, "B", CREASE_TYPE_FLOAT64, 1, 256);
    crease_cloud_free(cloud);
    cloud = when_text_read(context, "a.pts", "1\n1 2 3 -100 4 5 6\n");
    then_field_is(cloud, "intensity", CREASE_TYPE_FLOAT64, 0, -100);
    then_field_is(cloud, "blue", CREASE_TYPE_UINT8, 0, 6);
    crease_cloud_free(cloud);
    /* empty cells come on top of the seven numbers */
    cloud = when_text_read(context, "a.pts", "1\n1;2;3;-100;;4;5;6;;\n");
    then_field_is(cloud, "blue", CREASE_TYPE_UINT8, 0, 5);
    then_field_is(cloud, "scalar_8", CREASE_TYPE_FLOAT64, 0, 6);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_six_columns_then_unit_length_makes_normals(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.xyz", "1 2 3 0 0.6 -0.8\n4 5 6 1 0 0\n");
    assert_non_null(crease_cloud_normals(cloud));
    assert_near(crease_cloud_normals(cloud)[2], -0.8, 0);
    assert_int_equal(crease_cloud_field_count(cloud), 0);
    crease_cloud_free(cloud);
    cloud = when_text_read(context, "a.xyz", "1 2 3 0 0.6 -0.8\n4 5 6 1 0 1\n");
    assert_null(crease_cloud_normals(cloud));
    then_field_is(cloud, "scalar_5", CREASE_TYPE_FLOAT64, 0, 0.6);
    crease_cloud_free(cloud);
    cloud = when_text_read(context, "a.xyz", "x,y,z,nx,ny,nz\n1,2,3,4,5,6\n");
    assert_near(crease_cloud_normals(cloud)[2], 6, 0);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_header_alone_then_the_cloud_is_empty(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = when_text_read(context, "a.csv", "id,x,y,z\n");
    assert_int_equal(crease_cloud_count(cloud), 0);
    assert_int_equal(crease_cloud_field_count(cloud), 1);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_wrong_text_then_a_sentence_says_where(void **state)
{
    const crease_status format = CREASE_ERROR_FORMAT;
    then_text_fails("a.txt", "1 2 3\n4 5 6\n7 8\n", format, "line 3: ends after 2 columns");
    then_text_fails("a.txt", "1 2 3\n\n4 5 6 7\n", format, "line 3: has more columns (from '7'");
    then_text_fails("a.csv", "x,y,z\n1,2,3\n1,2\n", format, "line 3: ends after 2");
    then_text_fails("a.csv", "1,2,3\n1,2,3,4,5\n", format, "line 2: has more columns");
    then_text_fails(
        "a.csv", "1,2,3\n1,2,abc\n", format, "line 2: 'abc' is not a number (column 3)");
    then_text_fails("a.txt", "1 2 3\n1 0x2 3\n", format, "line 2: '0x2' is not a number");
    then_text_fails("a.txt", "1 2\n3 4\n", format, "line 1: '1 2' has 2 columns of numbers");
    then_text_fails("a.txt", "5\n", format, "no points");
    then_text_fails("a.txt", "# nothing\n", format, "no points");
    then_text_fails("a.txt", "once upon a time\nthere was\n", format, "line 2: 'there was' has");
    then_text_fails("a.csv", "x,y,z,t\n1,2,3\n", format, "line 2: has 3 columns, but the header");
    then_text_fails("a.csv", "id,t,a\n1,2,3\n", format, "no coordinate 'x'");
    then_text_fails("a.csv", "x,y,z,t,t\n1,2,3,4,5\n", format, "columns 4 and 5");
    then_text_fails(
        "a.pts", "3\n1 2 3\n1 2 3\n", CREASE_ERROR_TRUNCATED, "promises 3 points but 2");
    then_text_fails("a.pts", "1\n1 2 3\n1 2 3\n", format, "promises 1 points but 2");
    then_text_fails("a.txt", "1 2 3\n1 nan 3\n", CREASE_ERROR_VALUE, "line 2: y of point 2");
    then_text_fails("a.csv", "x,y,z\n1,2,3\n1,2,\n", CREASE_ERROR_VALUE, "line 3: z of point 2");
    then_text_fails("a.txt", "1 2 3\n1e999 2 3\n", CREASE_ERROR_VALUE, "x of point 2 is infinite");
    then_bytes_fail("a.txt", "1 2 3\n1 \0 3\n", 12, format, "line 2: '?' is not a number");
    then_bytes_fail("a.txt",
        "\xff\xfe"
        "1\0 \0",
        6, format, "16-bit");
}

/* Rows beyond one chunk of text, so that threads share the work. */
static char *given_many_rows(size_t rows, size_t *size)
{
    char *text = malloc(rows * 48);
    assert_non_null(text);
    *size = 0;
    for (size_t i = 0; i < rows; i++) {
        if (i % 1000 == 7)
            *size += (size_t)sprintf(text + *size, "# %zu\n\n", i);
        *size += (size_t)sprintf(text + *size, "%zu %.9f %.4f\n", i, (double)i * 1e-7, 0.25);
    }
    return text;
}

static void given_any_number_of_threads_then_the_same_cloud(void **state)
{
    enum { ROWS = 60000 };
    size_t size = 0;
    char *text = given_many_rows(ROWS, &size);
    assert_true(size > 4 << 18);
    for (int threads = 1; threads <= 4; threads++) {
        crease_context *context = given_reader_with_threads(threads);
        crease_cloud *cloud = when_read(context, "a.xyz", text, size);
        assert_int_equal(crease_cloud_count(cloud), ROWS);
        for (size_t i = 0; i < ROWS; i++)
            assert_true(crease_cloud_points(cloud)[3 * i] == (double)i);
        crease_cloud_free(cloud);
        crease_context_free(context);
    }
    free(text);
}

static void given_several_wrong_lines_then_the_first_is_named_by_any_number_of_threads(void **state)
{
    size_t size = 0;
    char *text = given_many_rows(60000, &size);
    text[size - 3] = 'x';
    strstr(text, "\n30000 ")[7] = 'y';
    for (int threads = 1; threads <= 4; threads++) {
        crease_context *context = given_reader_with_threads(threads);
        crease_cloud *cloud = NULL;
        assert_int_equal(
            read_bytes(context, "a.xyz", text, size, false, &cloud), CREASE_ERROR_FORMAT);
        assert_non_null(strstr(crease_context_message(context), "line 30061: "));
        crease_context_free(context);
    }
    free(text);
}

static void given_a_line_of_ten_megabytes_then_it_is_survived(void **state)
{
    enum { SIZE = 10 << 20 };
    char *text = malloc(SIZE + 1);
    assert_non_null(text);
    memset(text, '1', SIZE);
    text[SIZE] = '\0';
    memcpy(text, "1 2 3\n4 5 6 ", 12);
    then_bytes_fail("a.xyz", text, SIZE, CREASE_ERROR_FORMAT, "line 2: has more columns");
    memset(text, ' ', SIZE);
    memcpy(text, "1 2 3\n4 5", 9);
    text[SIZE - 1] = '6';
    crease_context *context = given_reader();
    crease_cloud *cloud = when_read(context, "a.xyz", text, SIZE);
    then_point_is(cloud, 1, 4, 5, 6);
    crease_cloud_free(cloud);
    crease_context_free(context);
    for (size_t i = 0; i < SIZE; i++)
        text[i] = i % 2 ? ' ' : '1';
    then_bytes_fail("a.xyz", text, SIZE, CREASE_ERROR_FORMAT, "line 1: has 5242880 columns");
    free(text);
}

static void given_hostile_bytes_then_the_reader_survives(void **state)
{
    static const char *const texts[] = {"1.5 2 3\n4 5 6\n7 8 9.25\n",
        "x,y,z,red,kind\n1,2,3,4,a\n4,5,6,7,\"b\"\n",
        "2\n# x y z nx ny nz t\n1 2 3 0 0 1 5\n4 5 6 0 1 0 7\n", "1;2;3;0;0;1\n4;5;6;0;1;0\n"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        if (i == 0)
            then_every_truncation_is_survived("a.txt", texts[i], strlen(texts[i]), true);
        crease_context *context = given_reader();
        for (size_t kept = 0; kept < strlen(texts[i]); kept++) {
            crease_cloud *cloud = NULL;
            read_bytes(context, "a.txt", texts[i], kept, false, &cloud);
            crease_cloud_free(cloud);
        }
        crease_context_free(context);
        then_damage_is_survived("a.txt", texts[i], strlen(texts[i]), 3000);
        then_every_failed_allocation_is_survived("a.txt", texts[i], strlen(texts[i]));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_every_separator_then_points_are_read),
        cmocka_unit_test(given_headers_and_comments_then_points_are_read),
        cmocka_unit_test(given_named_columns_then_they_are_fields),
        cmocka_unit_test(given_colours_then_they_are_bytes),
        cmocka_unit_test(given_six_columns_then_unit_length_makes_normals),
        cmocka_unit_test(given_a_header_alone_then_the_cloud_is_empty),
        cmocka_unit_test(given_wrong_text_then_a_sentence_says_where),
        cmocka_unit_test(given_any_number_of_threads_then_the_same_cloud),
        cmocka_unit_test(
            given_several_wrong_lines_then_the_first_is_named_by_any_number_of_threads),
        cmocka_unit_test(given_a_line_of_ten_megabytes_then_it_is_survived),
        cmocka_unit_test(given_hostile_bytes_then_the_reader_survives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
