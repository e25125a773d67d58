/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Files of text that are read some rows at a time: the parts make the whole. */
#include "given_bytes.h"

#include "read/rows.h"

#include <unistd.h>

enum { COUNT = 5000, ROOM = COUNT * 160 };

typedef struct scene {
    crease_context *context;
    char path[64], *text;
    size_t size;
} scene;

static void put(scene *s, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    s->size += (size_t)vsnprintf(s->text + s->size, ROOM - s->size, format, arguments);
    va_end(arguments);
    assert_true(s->size < ROOM);
}

static scene given_file(const char *name)
{
    scene s = {.context = given_reader(), .text = malloc(ROOM)};
    snprintf(s.path, sizeof s.path, "rows_%d_%s", (int)getpid(), name);
    assert_non_null(s.text);
    return s;
}

static void save(const scene *s)
{
    FILE *const file = fopen(s->path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(s->text, 1, s->size, file), s->size);
    assert_int_equal(fclose(file), 0);
}

static crease_status open_rows(const scene *s, bool skip_invalid, crease_rows **out)
{
    const crease_read_options options = {.skip_invalid = skip_invalid};
    save(s);
    const crease_status status = crease_rows_open(s->context, s->path, &options, out);
    remove(s->path); /* it stays open */
    return status;
}

static void free_scene(scene *s)
{
    crease_context_free(s->context);
    free(s->text);
}

static double number(uint64_t stream, int i)
{
    return crease_random_uniform(7, stream, (uint64_t)i);
}

static void then_part_is(const crease_cloud *whole, size_t first, const crease_cloud *part)
{
    const size_t count = crease_cloud_count(part);
    assert_true(first + count <= crease_cloud_count(whole));
    assert_memory_equal(crease_cloud_points(whole) + 3 * first, crease_cloud_points(part),
        3 * count * sizeof(double));
    assert_int_equal(crease_cloud_coordinate_type(whole), crease_cloud_coordinate_type(part));
    assert_int_equal(!crease_cloud_normals(whole), !crease_cloud_normals(part));
    if (crease_cloud_normals(part))
        assert_memory_equal(crease_cloud_normals(whole) + 3 * first, crease_cloud_normals(part),
            3 * count * sizeof(double));
    assert_int_equal(crease_cloud_field_count(whole), crease_cloud_field_count(part));
    for (size_t f = 0; f < crease_cloud_field_count(whole); f++) {
        const crease_field a = crease_cloud_field(whole, f), b = crease_cloud_field(part, f);
        assert_string_equal(a.name, b.name);
        assert_int_equal(a.type, b.type);
        for (size_t i = 0; i < count; i++) {
            const double x = crease_field_value(&a, first + i), y = crease_field_value(&b, i);
            assert_true(x == y || (isnan(x) && isnan(y)));
        }
    }
}

/* Read by so many rows at a time, and once from the middle. */
static void then_parts_make_the_whole(scene *s, bool skip_invalid)
{
    static const size_t steps[] = {7, 1000, 1024, 4097, 100000};
    crease_cloud *whole = NULL;
    crease_rows *rows = NULL;
    assert_int_equal(
        read_bytes(s->context, s->path, s->text, s->size, skip_invalid, &whole), CREASE_OK);
    if (open_rows(s, skip_invalid, &rows) != CREASE_OK)
        fail_msg("%s", crease_context_message(s->context));
    const size_t total = crease_rows_count(rows);
    assert_int_equal(total, COUNT);
    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
        size_t count = 0;
        for (size_t at = 0; at < total; at += steps[k]) {
            crease_cloud *part = NULL;
            const size_t some = total - at < steps[k] ? total - at : steps[k];
            if (crease_rows_read(s->context, rows, at, some, &part) != CREASE_OK)
                fail_msg("%s", crease_context_message(s->context));
            then_part_is(whole, count, part);
            count += crease_cloud_count(part);
            crease_cloud_free(part);
        }
        assert_int_equal(count, crease_cloud_count(whole));
    }
    crease_rows_close(rows);
    crease_cloud_free(whole);
    free_scene(s);
}

static void put_ply_header(scene *s, int count)
{
    put(s, "ply\nformat ascii 1.0\ncomment by a test\nelement vertex %d\nproperty float x\n",
        count);
    put(s,
        "property float y\nproperty float z\nproperty list uchar int more\nproperty uchar red\n");
}

static void given_ascii_ply_then_its_parts_make_the_whole(void **state)
{
    scene s = given_file("a.ply");
    put_ply_header(&s, COUNT);
    put(&s, "element face 1\nproperty list uchar int vertex_index\nend_header\n");
    for (int i = 0; i < COUNT; i++)
        put(&s, "%s%.9g %.9g %g 2 1 %d %d\r\n", i % 100 ? "" : "\n\n", number(1, i), number(2, i),
            i % 1000 == 77 ? NAN : 0.5, i, i % 256);
    put(&s, "3 0 1 2\n");
    then_parts_make_the_whole(&s, true);
}

static void given_rows_of_text_then_their_parts_make_the_whole(void **state)
{
    scene s = given_file("a.csv");
    put(&s, "\xef\xbb\xbf# a scan\nx;y;z;kind;time;red;green\n");
    for (int i = 0; i < COUNT; i++) {
        if (i % 300 == 10)
            put(&s, "// pause\n   \n");
        put(&s, "%.17g;%.17g;%g;", number(1, i), number(2, i), 1e-3 * i);
        put(&s, i % 5 ? "\"a b\";%d;%d;%g\n" : "edge;;%d;%g\n", i % 5 ? i : i % 256, i % 256,
            i == 4321 ? 0.5 : 1.0); /* green: whole numbers but for one row */
    }
    s.size--; /* without the last line's end */
    then_parts_make_the_whole(&s, false);
}

static void given_unit_vectors_in_some_parts_alone_then_they_are_no_normals(void **state)
{
    for (int odd = 0; odd < 2; odd++) {
        scene s = given_file("a.xyz");
        put(&s, "%d\n", COUNT);
        for (int i = 0; i < COUNT; i++)
            put(&s, "%.17g %.17g 1 0 %g 0\n", number(1, i), number(2, i),
                odd && i == 4999 ? 2.0 : 1.0);
        then_parts_make_the_whole(&s, false);
    }
}

static void then_it_is_refused(scene *s, crease_status expected, const char *sentence)
{
    crease_rows *rows = NULL;
    assert_int_equal(open_rows(s, false, &rows), expected);
    assert_null(rows);
    if (!strstr(crease_context_message(s->context), sentence))
        fail_msg("'%s' without '%s'", crease_context_message(s->context), sentence);
    free_scene(s);
}

static void given_another_number_of_rows_than_promised_then_it_is_refused(void **state)
{
    for (int more = -1; more <= 1; more += 2) {
        scene ply = given_file("b.ply"), xyz = given_file("b.pts");
        put_ply_header(&ply, 10 - more);
        put(&ply, "end_header\n");
        put(&xyz, "%d\n", 10 - more);
        for (int i = 0; i < 10; i++) {
            put(&ply, "1 2 %d 0 7\n", i);
            put(&xyz, "1 2 %d\n", i);
        }
        const crease_status status = more < 0 ? CREASE_ERROR_TRUNCATED : CREASE_ERROR_FORMAT;
        then_it_is_refused(&ply, status, more < 0 ? "get the whole file" : "mend the header");
        then_it_is_refused(&xyz, status, more < 0 ? "get the whole file" : "mend the header");
    }
}

static void given_a_fault_far_behind_then_its_line_is_told(void **state)
{
    scene s = given_file("c.csv");
    put(&s, "x,y,z,red\n");
    for (int i = 0; i < COUNT; i++)
        put(&s, i == 4000 ? "1,2,three,4\n" : "%d,2,3,4\n", i);
    then_it_is_refused(&s, CREASE_ERROR_FORMAT, "line 4002: 'three' is not a number");
}

static void given_lines_without_end_then_they_are_refused(void **state)
{
    scene s = given_file("d.xyz");
    put(&s, "1 2 3\n4 5 6\n");
    free(s.text);
    s.text = calloc(3 << 20, 1);
    assert_non_null(s.text);
    s.size = 3 << 20;
    memset(s.text, '7', s.size);
    memcpy(s.text, "1 2 3\n4 5 6\n7 8 ", 16);
    then_it_is_refused(&s, CREASE_ERROR_UNSUPPORTED, "line 3: has more than a million characters");
}

static void given_no_memory_then_it_says_so(void **state)
{
    scene s = given_file("e.csv");
    put(&s, "x,y,z,red\n");
    for (int i = 0; i < 3000; i++)
        put(&s, "%d,2,3,4\n", i);
    save(&s);
    const crease_read_options options = crease_read_options_default();
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; status != CREASE_OK && n < 200; n++) {
        crease_rows *rows = NULL;
        crease_cloud *part = NULL;
        crease_context_fail_allocation(s.context, n);
        status = crease_rows_open(s.context, s.path, &options, &rows);
        if (status == CREASE_OK)
            status = crease_rows_read(s.context, rows, 1500, 1000, &part);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
        crease_cloud_free(part);
        crease_rows_close(rows);
    }
    crease_context_fail_allocation(s.context, -1);
    assert_int_equal(status, CREASE_OK);
    assert_true(n > 10);
    remove(s.path);
    free_scene(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_ascii_ply_then_its_parts_make_the_whole),
        cmocka_unit_test(given_rows_of_text_then_their_parts_make_the_whole),
        cmocka_unit_test(given_unit_vectors_in_some_parts_alone_then_they_are_no_normals),
        cmocka_unit_test(given_another_number_of_rows_than_promised_then_it_is_refused),
        cmocka_unit_test(given_a_fault_far_behind_then_its_line_is_told),
        cmocka_unit_test(given_lines_without_end_then_they_are_refused),
        cmocka_unit_test(given_no_memory_then_it_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
