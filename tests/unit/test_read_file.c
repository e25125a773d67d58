/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Files: which format they are, and those that cannot be read at all. */
#include "given_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *file_name(const char *end)
{
    static char name[80];
    snprintf(name, sizeof name, "test_read_file_%ld%s", (long)getpid(), end);
    return name;
}

static const char *given_file(const char *end, const void *bytes, size_t size)
{
    FILE *file = fopen(file_name(end), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    return file_name(end);
}

static void then_format_is(const char *end, const char *text, const char *format)
{
    const char *path = given_file(end, text, strlen(text));
    const char *found = crease_file_format(path);
    unlink(path);
    if (strcmp(found ? found : "nothing", format ? format : "nothing") != 0)
        fail_msg("'%s' is taken for %s", text, found ? found : "nothing");
}

#define IGES_LINE                                                                                  \
    "                                                                        S      1\n"

static void given_signatures_then_they_win_over_the_extension(void **state)
{
    static const struct {
        const char *text, *format;
    } files[] = {{"ply\nformat ascii 1.0\n", "PLY"}, {"ply\r\n", "PLY"},
        {"# .PCD v0.7\nVERSION 0.7\n", "PCD"}, {"VERSION 0.7\nFIELDS x\n", "PCD"},
        {"# made by\nv 1 2 3\n", "OBJ"}, {"solid a\n facet normal 0 0 1\n", "STL"},
        {"solid a\nendsolid a\n", "STL"}, {"OFF\n1 0 0\n", "OFF"}, {"COFF\n1 0 0\n", "OFF"},
        {"ISO-10303-21;\n", "STEP"}, {IGES_LINE, "IGES"}, {"DBRep_DrawableShape\n", "BREP"},
        {"CASCADE Topology V1\n", "BREP"}, {"glTF\2", "GLB"}, {"<!DOCTYPE html>\n", "HTML"},
        {"<html>\n", "HTML"}, {"<html lang='en'>\n", "HTML"}, {"{\n\"a\": 1}", "JSON"},
        {"\x89PNG\r\n", "PNG"}, {"%PDF-1.7\n", "PDF"}, {"PK\3\4", "ZIP"},
        {"\x7f"
         "ELF\1",
            "ELF"},
        {"\x1f\x8b\x08", "GZIP"}, {"<?xml version='1.0'?>\n", "XML"}, {"\xff\xd8\xff", "JPEG"},
        {"LASF\1", "LAS"}, {"<svg width='1'>\n", "SVG"}};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        then_format_is(".xyz", files[i].text, files[i].format);
        then_format_is("", files[i].text, files[i].format);
    }
}

static void given_no_signature_then_the_extension_decides(void **state)
{
    then_format_is(".xyz", "1 2 3\n", "XYZ");
    then_format_is(".CSV", "a,b,c\n", "XYZ");
    then_format_is(".stl", "nothing known\n", "STL");
    then_format_is(".ply", "1 2 3\n", "PLY");
    then_format_is(".dat", "# a comment\n1,5;2;3\n", "XYZ");
    then_format_is(".dat", "nothing known\n", NULL);
    then_format_is("", "", NULL);
    assert_null(crease_file_format("no such file.ply"));
    assert_null(crease_file_format("/dev/zero"));
    assert_null(crease_file_format("."));
}

static void then_path_fails(const char *path, crease_status status, const char *words)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = (crease_cloud *)&context;
    const crease_status found = crease_cloud_read(context, path, NULL, &cloud);
    assert_null(cloud);
    const char *message = crease_context_message(context);
    if (found != status || !strstr(message, words))
        fail_msg("status %d: '%s' should hold '%s'", found, message, words);
    crease_context_free(context);
}

static void given_paths_that_cannot_be_read_then_a_sentence_says_why(void **state)
{
    then_path_fails("no such file.ply", CREASE_ERROR_NO_SUCH_FILE, "no such file.ply: there is no");
    then_path_fails("", CREASE_ERROR_NO_SUCH_FILE, "there is no such file");
    then_path_fails(".", CREASE_ERROR_CANNOT_READ, "is a directory, not a file");
    then_path_fails("/dev/zero", CREASE_ERROR_CANNOT_READ, "is a device, not a file");
    const char *path = given_file(".ply", "", 0);
    then_path_fails(path, CREASE_ERROR_TRUNCATED, "is empty");
    if (chmod(path, 0) == 0 && access(path, R_OK) != 0)
        then_path_fails(path, CREASE_ERROR_CANNOT_READ, "no permission");
    unlink(path);
}

static void given_files_that_are_no_clouds_then_the_sentence_names_what_they_are(void **state)
{
    const char *path = given_file(".step", "ISO-10303-21;\n", 14);
    then_path_fails(path, CREASE_ERROR_FORMAT, "is a CAD model (STEP), not a cloud; give");
    unlink(path);
    path = given_file(".xyz", "\x89PNG\r\n\x1a\n", 8);
    then_path_fails(path, CREASE_ERROR_FORMAT, "is a picture (PNG), not a cloud; give");
    unlink(path);
    path = given_file(".odd", "something else\n", 15);
    then_path_fails(path, CREASE_ERROR_FORMAT, "is no cloud that is known here");
    unlink(path);
}

static void given_a_file_then_it_is_read(void **state)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    const char *path = given_file(".xyz", "1 2 3\n", 6);
    assert_int_equal(crease_cloud_read(context, path, NULL, &cloud), CREASE_OK);
    unlink(path);
    then_point_is(cloud, 0, 1, 2, 3);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

/* Reads "-" with this file, which is closed, in the place of standard input. */
static crease_status read_standard_input(crease_context *context, int file, crease_cloud **out)
{
    const int saved = dup(STDIN_FILENO);
    assert_true(dup2(file, STDIN_FILENO) == STDIN_FILENO);
    close(file);
    const crease_status status = crease_cloud_read(context, "-", NULL, out);
    if (saved >= 0) {
        dup2(saved, STDIN_FILENO);
        close(saved);
    }
    return status;
}

static void given_standard_input_then_it_is_read_to_its_end(void **state)
{
    enum { SIZE = 300000 };
    char *text = malloc(SIZE);
    assert_non_null(text);
    size_t size = 0, count = 0;
    for (; size + 30 < SIZE; count++)
        size += (size_t)sprintf(text + size, "%zu 2 3\n", count);
    const char *path = given_file(".in", text, size);
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    assert_int_equal(read_standard_input(context, open(path, O_RDONLY), &cloud), CREASE_OK);
    unlink(path);
    assert_int_equal(crease_cloud_count(cloud), count);
    then_point_is(cloud, count - 1, (double)(count - 1), 2, 3);
    crease_cloud_free(cloud);
    crease_context_free(context);
    free(text);
}

static void given_an_empty_pipe_then_standard_input_is_empty(void **state)
{
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    close(ends[1]);
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    assert_int_equal(read_standard_input(context, ends[0], &cloud), CREASE_ERROR_TRUNCATED);
    assert_non_null(strstr(crease_context_message(context), "standard input: is empty"));
    crease_context_free(context);
}

static void given_a_named_pipe_then_its_format_is_not_asked_for(void **state)
{
    const char *path = file_name(".fifo");
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_null(crease_file_format(path));
    unlink(path);
}

static int stop(void *user)
{
    return 1;
}

static void given_a_caller_who_stops_then_reading_ends(void **state)
{
    crease_context_options options = crease_context_options_default();
    options.cancelled = stop;
    crease_context *context = NULL;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    const char *path = given_file(".xyz", "1 2 3\n", 6);
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_cloud_read(context, path, NULL, &cloud), CREASE_ERROR_CANCELLED);
    assert_null(cloud);
    unlink(path);
    crease_context_free(context);
}

static void given_memory_that_runs_out_then_reading_says_so(void **state)
{
    crease_context *context = given_reader();
    const char *path = given_file(".xyz", "1 2 3\n", 6);
    crease_cloud *cloud = NULL;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    for (long n = 0; status != CREASE_OK; n++) {
        assert_true(n < 100);
        crease_context_fail_allocation(context, n);
        status = crease_cloud_read(context, path, NULL, &cloud);
        assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
    }
    crease_cloud_free(cloud);
    unlink(path);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_signatures_then_they_win_over_the_extension),
        cmocka_unit_test(given_no_signature_then_the_extension_decides),
        cmocka_unit_test(given_paths_that_cannot_be_read_then_a_sentence_says_why),
        cmocka_unit_test(given_files_that_are_no_clouds_then_the_sentence_names_what_they_are),
        cmocka_unit_test(given_a_file_then_it_is_read),
        cmocka_unit_test(given_standard_input_then_it_is_read_to_its_end),
        cmocka_unit_test(given_an_empty_pipe_then_standard_input_is_empty),
        cmocka_unit_test(given_a_named_pipe_then_its_format_is_not_asked_for),
        cmocka_unit_test(given_a_caller_who_stops_then_reading_ends),
        cmocka_unit_test(given_memory_that_runs_out_then_reading_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
