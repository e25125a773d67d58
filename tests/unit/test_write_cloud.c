/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given_bytes.h"

#include <unistd.h>

enum { MOST_POINTS = 64 };

static const char *const formats[] = {"ply", "pcd", "xyz", "txt", "csv", "asc", "pts"};
enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

static const char *file_name(const char *extension)
{
    static char name[64];
    snprintf(name, sizeof name, "test_write_cloud_%ld.%s", (long)getpid(), extension);
    return name;
}

/* Any finite number whose square is finite, of every size, some of them special. */
static double draw_number(uint64_t seed, uint64_t i)
{
    static const double special[] = {0.0, -0.0, 5e-324, -2.5e-310, 1e150, 0.1, 1.0, 123456789.0};
    uint32_t bits[4];
    crease_random_block(seed, 0, i, bits);
    if (bits[2] % 8 == 0)
        return special[bits[3] % 8];
    if (bits[2] % 8 < 4)
        return crease_random_normal(seed, 1, i);
    const uint64_t all = (uint64_t)bits[0] << 32 | bits[1];
    double value;
    memcpy(&value, &all, sizeof value);
    return fabs(value) <= 1e150 ? value : 1.0 / 3.0;
}

/* A cloud of random size and contents; what the format cannot tell is left out of it. */
typedef struct random_cloud {
    double points[3 * MOST_POINTS], normals[3 * MOST_POINTS];
    unsigned char values[8][8 * MOST_POINTS];
    crease_field fields[8];
    crease_cloud_parts parts;
} random_cloud;

static void draw_field(random_cloud *cloud, uint64_t seed, size_t index)
{
    static const char *const names[] = {"a", "variance", "c_2", "D", "red", "intensity", "g", "h"};
    cloud->fields[index] = (crease_field){.name = names[index],
        .type = (crease_type)crease_random_below(seed, 9, index, 8),
        .values = cloud->values[index]};
    for (size_t i = 0; i < 8 * MOST_POINTS; i++)
        cloud->values[index][i] = (unsigned char)crease_random_below(seed, 10 + index, i, 256);
}

static void draw_cloud(random_cloud *cloud, uint64_t seed)
{
    const bool floats = seed % 2;
    for (size_t i = 0; i < 3 * MOST_POINTS; i++) {
        const double point = draw_number(seed, i), normal = draw_number(seed, 1000 + i);
        cloud->points[i] = floats ? (double)(float)fmod(point, 1e30) : point;
        cloud->normals[i] = seed % 3 ? (double)(float)fmod(normal, 1e30) : normal;
    }
    for (size_t i = 0; i < 8; i++)
        draw_field(cloud, seed, i);
    cloud->parts = (crease_cloud_parts){.count = crease_random_below(seed, 20, 0, MOST_POINTS),
        .points = cloud->points,
        .normals = seed % 5 < 2 ? cloud->normals : NULL,
        .fields = cloud->fields,
        .field_count = crease_random_below(seed, 20, 1, 8),
        .coordinate_type = floats ? CREASE_TYPE_FLOAT32 : CREASE_TYPE_FLOAT64};
}

static bool same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

/* The same in the type in which it was written; every "not a number" is the same one in text. */
static void then_same_value(double written, double read, crease_type type)
{
    if (type == CREASE_TYPE_FLOAT32)
        read = (double)(float)read;
    if (!(isnan(written) && isnan(read)) && !same_bits(written, read))
        fail_msg("%.17g was written, %.17g read", written, read);
}

static void then_same_fields(const crease_cloud *written, const crease_cloud *read, bool binary)
{
    for (size_t i = 0; i < crease_cloud_field_count(written); i++) {
        const crease_field field = crease_cloud_field(written, i);
        const crease_field back = crease_cloud_find_field(read, field.name);
        assert_non_null(back.name);
        const size_t count = crease_cloud_count(written);
        if (binary) {
            assert_int_equal(back.type, field.type);
            assert_memory_equal(back.values, field.values, count * crease_type_size(field.type));
        }
        for (size_t point = 0; point < count; point++)
            then_same_value(
                crease_field_value(&field, point), crease_field_value(&back, point), field.type);
    }
}

static void then_same_cloud(const crease_cloud *written, const crease_cloud *read, bool binary)
{
    const crease_type type = crease_cloud_coordinate_type(written);
    const size_t count = crease_cloud_count(written);
    assert_int_equal(crease_cloud_count(read), count);
    assert_int_equal(crease_cloud_field_count(read), crease_cloud_field_count(written));
    if (binary)
        assert_int_equal(crease_cloud_coordinate_type(read), type);
    const double *normals = crease_cloud_normals(written), *back = crease_cloud_normals(read);
    assert_true(!normals == !back);
    bool single = true;
    for (size_t i = 0; normals && i < 3 * count; i++)
        single = single && same_bits((double)(float)normals[i], normals[i]);
    for (size_t i = 0; i < 3 * count; i++) {
        then_same_value(crease_cloud_points(written)[i], crease_cloud_points(read)[i], type);
        if (normals)
            then_same_value(
                normals[i], back[i], single ? CREASE_TYPE_FLOAT32 : CREASE_TYPE_FLOAT64);
    }
    then_same_fields(written, read, binary);
}

static crease_cloud *when_written_and_read(
    crease_context *context, const crease_cloud *cloud, const char *path)
{
    crease_cloud *read = NULL;
    if (crease_cloud_write(context, cloud, path) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    if (crease_cloud_read(context, path, NULL, &read) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    unlink(path);
    return read;
}

static void given_random_clouds_then_what_is_read_is_what_was_written(void **state)
{
    crease_context *context = given_context();
    random_cloud *drawn = malloc(sizeof *drawn);
    assert_non_null(drawn);
    for (uint64_t seed = 0; seed < 140; seed++) {
        const size_t format = seed % FORMAT_COUNT;
        draw_cloud(drawn, seed);
        const bool header = format != 2 && format != 6;
        if (!drawn->parts.count && (!header || format >= 2))
            drawn->parts.count = 1; /* rows of numbers need a row */
        crease_cloud *cloud = NULL;
        assert_int_equal(crease_cloud_create(context, &drawn->parts, &cloud), CREASE_OK);
        crease_cloud *read = when_written_and_read(context, cloud, file_name(formats[format]));
        then_same_cloud(cloud, read, format < 2);
        crease_cloud_free(read);
        crease_cloud_free(cloud);
    }
    free(drawn);
    crease_context_free(context);
}

static crease_cloud *given_small_cloud(crease_context *context)
{
    static const double points[] = {0.5, 0.1f, -3, 4, 5, 1e-7f};
    static const double normals[] = {0, 0, 1, 0.6, 0, 0.8};
    static const uint8_t feature[] = {0, 255};
    static const crease_field field = {"feature", CREASE_TYPE_UINT8, feature};
    const crease_cloud_parts parts = {.count = 2,
        .points = points,
        .normals = normals,
        .fields = &field,
        .field_count = 1,
        .coordinate_type = CREASE_TYPE_FLOAT32};
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    return cloud;
}

static void then_file_begins(const char *path, const char *text)
{
    char begin[512] = "";
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(begin, 1, sizeof begin - 1, file);
    fclose(file);
    unlink(path);
    if (size < strlen(text) || memcmp(begin, text, strlen(text)) != 0)
        fail_msg("'%s' does not begin '%s'", begin, text);
}

static void given_each_format_then_the_file_looks_as_it_should(void **state)
{
    static const char *const texts[] = {
        "ply\nformat binary_little_endian 1.0\ncomment crease ",
        "# .PCD v0.7",
        "# x y z nx ny nz feature\n0.5 0.1 -3 0 0 1 0\n4 5 1e-07 0.6 0 0.8 255\n",
        "x y z nx ny nz feature\n0.5 0.1 -3 0 0 1 0\n",
        "x,y,z,nx,ny,nz,feature\n0.5,0.1,-3,0,0,1,0\n",
        "x y z nx ny nz feature\n0.5 0.1 -3 0 0 1 0\n",
        "2\n# x y z nx ny nz feature\n0.5 0.1 -3 0 0 1 0\n",
    };
    crease_context *context = given_context();
    crease_cloud *cloud = given_small_cloud(context);
    for (size_t i = 0; i < FORMAT_COUNT; i++) {
        assert_int_equal(crease_cloud_write(context, cloud, file_name(formats[i])), CREASE_OK);
        then_file_begins(file_name(formats[i]), texts[i]);
    }
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_points_alone_then_xyz_is_plain(void **state)
{
    crease_context *context = given_context();
    const double points[] = {1, 2, 0.1};
    crease_cloud *cloud = given_cloud_of(context, points, 1);
    assert_int_equal(crease_cloud_write(context, cloud, file_name("XYZ")), CREASE_OK);
    then_file_begins(file_name("XYZ"), "1 2 0.1\n");
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_name_without_a_known_extension_then_a_usage_error_lists_them(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_small_cloud(context);
    assert_int_equal(crease_cloud_write(context, cloud, "a.docx"), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), ".ply"));
    assert_non_null(strstr(crease_context_message(context), ".pts"));
    assert_int_equal(
        crease_cloud_write(context, cloud, "/no/such/dir/a.ply"), CREASE_ERROR_CANNOT_WRITE);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_field_names_that_would_not_read_back_then_an_error(void **state)
{
    static const char *const names[] = {
        "x", "nz", "normal_x", "two words", "a,b", "", "1.5", "inf"};
    crease_context *context = given_context();
    crease_cloud *cloud = given_small_cloud(context);
    const double values[] = {1, 2};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const crease_field field = {names[i], CREASE_TYPE_FLOAT64, values};
        crease_cloud *more = NULL;
        assert_int_equal(crease_cloud_with_fields(context, cloud, &field, 1, &more), CREASE_OK);
        assert_int_equal(
            crease_cloud_write(context, more, file_name("ply")), CREASE_ERROR_ARGUMENT);
        assert_int_not_equal(access(file_name("ply"), F_OK), 0);
        crease_cloud_free(more);
    }
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_memory_that_runs_out_then_nothing_is_written(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_small_cloud(context);
    for (size_t i = 0; i < FORMAT_COUNT; i++) {
        crease_context_fail_allocation(context, 0);
        assert_int_equal(
            crease_cloud_write(context, cloud, file_name(formats[i])), CREASE_ERROR_NO_MEMORY);
        assert_int_not_equal(access(file_name(formats[i]), F_OK), 0);
    }
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_random_clouds_then_what_is_read_is_what_was_written),
        cmocka_unit_test(given_each_format_then_the_file_looks_as_it_should),
        cmocka_unit_test(given_points_alone_then_xyz_is_plain),
        cmocka_unit_test(given_a_name_without_a_known_extension_then_a_usage_error_lists_them),
        cmocka_unit_test(given_field_names_that_would_not_read_back_then_an_error),
        cmocka_unit_test(given_memory_that_runs_out_then_nothing_is_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
