/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#define _XOPEN_SOURCE 700 /* mkdtemp, nftw */

#include "given_cad.h"

#include <fcntl.h>

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

/* The numbers of a file in metres are those of the same file in millimetres. */
static void given_a_file_in_metres_then_lengths_are_in_metres(void **state)
{
    model m = given_model();
    add_box(&m, 2.0, (double[]){1, 0, 0});
    when_written(&m, in_folder("unit.step"));
    char *bytes = NULL;
    const size_t size = read_bytes(in_folder("unit.step"), &bytes);
    bytes[size] = 0;
    char *prefix = strstr(bytes, ".MILLI.");
    assert_non_null(prefix);
    memcpy(prefix, "$      ", 7);
    write_bytes(in_folder("unit.step"), bytes, size);
    free(bytes);
    const crease_cad_info info = when_read(&m, in_folder("unit.step"));
    then_counts_are(&info, 1, 6, 12, 8, 0, 12);
    assert_near(info.volume, 8.0, 1e-9);
    assert_near(info.area, 24.0, 1e-9);
    assert_near(info.highest[0], 3.0, 1e-6);
    free_model(&m);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_spoiled_files_then_sentences_come_and_nothing_is_printed),
        cmocka_unit_test(given_a_file_in_metres_then_lengths_are_in_metres),
        cmocka_unit_test(given_no_cad_file_then_a_sentence_says_so),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
