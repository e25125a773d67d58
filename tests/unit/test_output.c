/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "write/decimal.h"
#include "write/output.h"

#include <dirent.h>
#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>

static char directory[64];
static char target[96];

static int make_directory(void **state)
{
    snprintf(directory, sizeof directory, "/tmp/crease-output-XXXXXX");
    if (!mkdtemp(directory))
        return 1;
    snprintf(target, sizeof target, "%s/file.txt", directory);
    return 0;
}

static size_t count_files(void)
{
    size_t count = 0;
    DIR *listing = opendir(directory);
    assert_non_null(listing);
    for (const struct dirent *entry = readdir(listing); entry; entry = readdir(listing))
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(listing);
    return count;
}

static int remove_directory(void **state)
{
    unlink(target);
    return rmdir(directory);
}

static void then_file_holds(const char *path, const char *expected)
{
    char text[256] = "";
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    assert_int_equal(size, strlen(expected));
    assert_string_equal(text, expected);
}

static crease_status write_text(crease_context *context, const char *path, const char *text)
{
    crease_output *output = NULL;
    const crease_status status = crease_output_open(context, path, &output);
    if (status != CREASE_OK)
        return status;
    crease_output_text(output, text);
    return crease_output_close(context, output, CREASE_OK);
}

static void given_a_target_then_it_appears_only_at_the_close(void **state)
{
    crease_context *context = given_context();
    crease_output *output = NULL;
    assert_int_equal(crease_output_open(context, target, &output), CREASE_OK);
    crease_output_format(output, "%d %s\n", 12, "twelve");
    crease_output_double(output, -0.1);
    crease_output_text(output, " ");
    crease_output_float(output, 0.1F);
    assert_int_equal(access(target, F_OK), -1);
    char beside[256];
    assert_true(crease_output_temporary_name(target, beside, sizeof beside));
    assert_int_equal(access(beside, F_OK), 0);
    assert_string_equal(crease_output_path(output), beside);
    assert_int_equal(crease_output_close(context, output, CREASE_OK), CREASE_OK);
    then_file_holds(target, "12 twelve\n-0.1 0.1");
    assert_int_equal(count_files(), 1);
    crease_context_free(context);
}

static void given_binary_numbers_then_bytes_are_little_endian(void **state)
{
    crease_context *context = given_context();
    crease_output *output = NULL;
    assert_int_equal(crease_output_open(context, target, &output), CREASE_OK);
    crease_output_binary_u16(output, 0x4241);
    crease_output_binary_u32(output, 0x46454443);
    crease_output_binary_f32(output, 0x1.8a8886p+7F);        /* 0x43454443 */
    crease_output_binary_f64(output, 0x1.1424344454647p+21); /* 0x4141424344454647 */
    assert_int_equal(crease_output_close(context, output, CREASE_OK), CREASE_OK);
    then_file_holds(target, "ABCDEFCDECGFEDCBAA");
    crease_context_free(context);
}

static void given_a_failure_then_the_old_file_stays_and_nothing_is_beside_it(void **state)
{
    crease_context *context = given_context();
    assert_int_equal(write_text(context, target, "old"), CREASE_OK);
    assert_int_equal(chmod(target, 0640), 0);
    crease_output *output = NULL;
    assert_int_equal(crease_output_open(context, target, &output), CREASE_OK);
    crease_output_text(output, "new");
    assert_int_equal(
        crease_output_close(context, output, CREASE_ERROR_NUMERIC), CREASE_ERROR_NUMERIC);
    then_file_holds(target, "old");
    assert_int_equal(count_files(), 1);
    assert_int_equal(write_text(context, target, "new"), CREASE_OK);
    then_file_holds(target, "new");
    struct stat info;
    assert_int_equal(stat(target, &info), 0);
    assert_int_equal(info.st_mode & 0777, 0640);
    crease_context_free(context);
}

static void given_a_symbolic_link_then_its_target_is_replaced(void **state)
{
    crease_context *context = given_context();
    char name[96];
    snprintf(name, sizeof name, "%s/link", directory);
    assert_int_equal(write_text(context, target, "old"), CREASE_OK);
    assert_int_equal(symlink("file.txt", name), 0);
    assert_int_equal(write_text(context, name, "through"), CREASE_OK);
    then_file_holds(target, "through");
    struct stat info;
    assert_int_equal(lstat(name, &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    unlink(name);
    crease_context_free(context);
}

static int stop_now = 0;

static int stop(void *user)
{
    return stop_now;
}

static void given_a_cancelled_context_then_nothing_is_left(void **state)
{
    crease_context_options options = crease_context_options_default();
    options.cancelled = stop;
    crease_context *context = NULL;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    crease_output *output = NULL;
    stop_now = 0;
    assert_int_equal(crease_output_open(context, target, &output), CREASE_OK);
    crease_output_text(output, "something");
    stop_now = 1;
    assert_int_equal(crease_output_close(context, output, CREASE_OK), CREASE_ERROR_CANCELLED);
    assert_int_equal(count_files(), 0);
    crease_context_free(context);
}

static void given_places_that_cannot_be_written_then_a_sentence_says_why(void **state)
{
    crease_context *context = given_context();
    char path[128];
    snprintf(path, sizeof path, "%s/missing/file.txt", directory);
    assert_int_equal(write_text(context, path, "x"), CREASE_ERROR_CANNOT_WRITE);
    assert_non_null(strstr(crease_context_message(context), "make the directory"));
    assert_int_equal(write_text(context, directory, "x"), CREASE_ERROR_CANNOT_WRITE);
    assert_non_null(strstr(crease_context_message(context), "name of a file"));
    assert_int_equal(write_text(context, "/dev/full", "x"), CREASE_ERROR_CANNOT_WRITE);
    assert_non_null(strstr(crease_context_message(context), "free some space"));
    assert_int_equal(write_text(context, "", "x"), CREASE_ERROR_CANNOT_WRITE);
    crease_context_fail_allocation(context, 0);
    assert_int_equal(write_text(context, target, "x"), CREASE_ERROR_NO_MEMORY);
    assert_int_equal(count_files(), 0);
    crease_context_free(context);
}

static void given_a_device_then_it_is_written_and_stays_a_device(void **state)
{
    crease_context *context = given_context();
    assert_int_equal(write_text(context, "/dev/null", "x"), CREASE_OK);
    struct stat info;
    assert_int_equal(stat("/dev/null", &info), 0);
    assert_true(S_ISCHR(info.st_mode));
    crease_context_free(context);
}

static void given_a_name_of_full_length_then_it_can_be_written(void **state)
{
    crease_context *context = given_context();
    char path[400];
    const int length = snprintf(path, sizeof path, "%s/", directory);
    memset(path + length, 'n', 255);
    path[length + 255] = '\0';
    assert_int_equal(write_text(context, path, "x"), CREASE_OK);
    then_file_holds(path, "x");
    unlink(path);
    crease_context_free(context);
}

static void given_more_than_the_buffer_then_every_byte_arrives(void **state)
{
    enum { COUNT = 50000 };
    crease_context *context = given_context();
    crease_output *output = NULL;
    assert_int_equal(crease_output_open(context, target, &output), CREASE_OK);
    for (uint32_t i = 0; i < COUNT; i++)
        crease_output_binary_u32(output, i);
    static char block[100000];
    crease_output_bytes(output, block, sizeof block);
    assert_int_equal(crease_output_close(context, output, CREASE_OK), CREASE_OK);
    FILE *file = fopen(target, "rb");
    assert_non_null(file);
    for (uint32_t i = 0; i < COUNT; i++) {
        unsigned char bytes[4] = {0};
        assert_int_equal(fread(bytes, 1, 4, file), 4);
        assert_int_equal(bytes[0] | bytes[1] << 8 | bytes[2] << 16, i);
    }
    assert_int_equal(fread(block, 1, sizeof block, file), sizeof block);
    assert_int_equal(fgetc(file), EOF);
    fclose(file);
    crease_context_free(context);
}

static void given_an_extension_then_it_is_found_or_all_are_named(void **state)
{
    static const char *const extensions[] = {"ply", "obj", "glb"};
    crease_context *context = given_context();
    size_t choice = 9;
    assert_int_equal(crease_output_choose(context, "a.b/x.OBJ", extensions, 3, &choice), CREASE_OK);
    assert_int_equal(choice, 1);
    const char *const wrong[] = {"x.stl", "x", "a.ply/x", "", "x."};
    for (size_t i = 0; i < 5; i++)
        assert_int_equal(
            crease_output_choose(context, wrong[i], extensions, 3, &choice), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), ".ply, .obj or .glb"));
    crease_context_free(context);
}

static void then_prints(double value, const char *expected)
{
    char text[CREASE_DECIMAL_SIZE];
    assert_int_equal(crease_decimal_print(value, text), strlen(expected));
    assert_string_equal(text, expected);
}

static void given_numbers_then_the_shortest_text_is_printed(void **state)
{
    then_prints(0.0, "0");
    then_prints(-0.0, "-0");
    then_prints(0.1, "0.1");
    then_prints(-1234.5, "-1234.5");
    then_prints(0.0001, "0.0001");
    then_prints(1e-5, "1e-05");
    then_prints(1e300, "1e+300");
    then_prints(1.0 / 3.0, "0.3333333333333333");
    then_prints(9007199254740991.0, "9007199254740991");
    then_prints(NAN, "nan");
    then_prints(-INFINITY, "-inf");
}

static void given_any_number_then_it_reads_back_in_any_locale(void **state)
{
    const char *const locales[] = {"C", "de_DE.UTF-8", "ps_AF.UTF-8"};
    for (uint64_t i = 0; i < 30000; i++) {
        setlocale(LC_NUMERIC, locales[i % 3]);
        const double magnitude = 600.0 * crease_random_uniform(1, 0, i) - 300.0;
        const double value =
            pow(10.0, magnitude / (double)(1 + i % 60)) * crease_random_normal(1, 1, i);
        char text[CREASE_DECIMAL_SIZE];
        crease_decimal_print(value, text);
        char single[CREASE_DECIMAL_SIZE];
        crease_decimal_print_float((float)value, single);
        setlocale(LC_NUMERIC, "C");
        assert_true(strtod(text, NULL) == value);
        assert_true((float)strtod(single, NULL) == (float)value);
    }
}

int main(void)
{
#define IN_DIRECTORY(test) cmocka_unit_test_setup_teardown(test, make_directory, remove_directory)
    const struct CMUnitTest tests[] = {
        IN_DIRECTORY(given_a_target_then_it_appears_only_at_the_close),
        IN_DIRECTORY(given_binary_numbers_then_bytes_are_little_endian),
        IN_DIRECTORY(given_a_failure_then_the_old_file_stays_and_nothing_is_beside_it),
        IN_DIRECTORY(given_a_symbolic_link_then_its_target_is_replaced),
        IN_DIRECTORY(given_a_cancelled_context_then_nothing_is_left),
        IN_DIRECTORY(given_places_that_cannot_be_written_then_a_sentence_says_why),
        IN_DIRECTORY(given_a_device_then_it_is_written_and_stays_a_device),
        IN_DIRECTORY(given_a_name_of_full_length_then_it_can_be_written),
        IN_DIRECTORY(given_more_than_the_buffer_then_every_byte_arrives),
        cmocka_unit_test(given_an_extension_then_it_is_found_or_all_are_named),
        cmocka_unit_test(given_numbers_then_the_shortest_text_is_printed),
        cmocka_unit_test(given_any_number_then_it_reads_back_in_any_locale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
