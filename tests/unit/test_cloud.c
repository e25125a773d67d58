/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

static const double points[] = {1, 2, 3, -4, 5, 6, 7, -8, 9};
static const double normals[] = {0, 0, 1, 0, 1, 0, 1, 0, 0};
static const uint8_t marks[] = {1, 0, 255};
static const float heights[] = {0.5f, -1.5f, 2.5f};

static const crease_field fields[] = {
    {"mark", CREASE_TYPE_UINT8, marks}, {"height", CREASE_TYPE_FLOAT32, heights}};

static crease_cloud_parts given_parts(void)
{
    return (crease_cloud_parts){.count = 3,
        .points = points,
        .normals = normals,
        .fields = fields,
        .field_count = 2,
        .coordinate_type = CREASE_TYPE_FLOAT32};
}

static crease_cloud *given_cloud(crease_context *context)
{
    const crease_cloud_parts parts = given_parts();
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    return cloud;
}

static void given_parts_then_the_cloud_holds_copies_of_them(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context);
    assert_int_equal(crease_cloud_count(cloud), 3);
    assert_int_equal(crease_cloud_coordinate_type(cloud), CREASE_TYPE_FLOAT32);
    assert_ptr_not_equal(crease_cloud_points(cloud), points);
    assert_memory_equal(crease_cloud_points(cloud), points, sizeof points);
    assert_memory_equal(crease_cloud_normals(cloud), normals, sizeof normals);
    assert_int_equal(crease_cloud_field_count(cloud), 2);
    const crease_field field = crease_cloud_find_field(cloud, "height");
    assert_ptr_not_equal(field.values, heights);
    assert_near(crease_field_value(&field, 2), 2.5, 0);
    assert_string_equal(crease_cloud_field(cloud, 0).name, "mark");
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_a_field_that_is_not_there_then_its_name_is_null(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context);
    assert_null(crease_cloud_field(cloud, 2).name);
    assert_null(crease_cloud_find_field(cloud, "Mark").name);
    crease_cloud_free(cloud);
    crease_cloud_free(NULL);
    crease_context_free(context);
}

static void given_points_then_bounds_hold_them(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context);
    double lowest[3], highest[3];
    crease_cloud_bounds(cloud, lowest, highest);
    const double expected[] = {-4, -8, 3, 7, 5, 9};
    assert_memory_equal(lowest, expected, sizeof lowest);
    assert_memory_equal(highest, expected + 3, sizeof highest);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_no_points_then_the_cloud_is_empty(void **state)
{
    crease_context *context = given_context();
    const crease_cloud_parts parts = {.coordinate_type = CREASE_TYPE_FLOAT64};
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    assert_int_equal(crease_cloud_count(cloud), 0);
    assert_null(crease_cloud_normals(cloud));
    double lowest[3], highest[3];
    crease_cloud_bounds(cloud, lowest, highest);
    assert_near(lowest[0], 0, 0);
    assert_near(highest[2], 0, 0);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void then_parts_fail(
    const crease_cloud_parts *parts, crease_status status, const char *words)
{
    crease_context *context = given_context();
    crease_cloud *cloud = (crease_cloud *)&context;
    assert_int_equal(crease_cloud_create(context, parts, &cloud), status);
    assert_null(cloud);
    if (!strstr(crease_context_message(context), words))
        fail_msg("'%s' should hold '%s'", crease_context_message(context), words);
    crease_context_free(context);
}

static void given_wrong_parts_then_a_sentence_says_what(void **state)
{
    crease_cloud_parts parts = given_parts();
    const double wrong[] = {1, 2, 3, 4, NAN, 6, 7, 8, INFINITY};
    parts.points = wrong;
    then_parts_fail(&parts, CREASE_ERROR_VALUE, "point 1 is not finite (y = nan)");
    parts.points = NULL;
    then_parts_fail(&parts, CREASE_ERROR_ARGUMENT, "no points were given");
    parts = given_parts();
    const crease_field twice[] = {fields[0], fields[1], fields[0]};
    parts.fields = twice;
    parts.field_count = 3;
    then_parts_fail(&parts, CREASE_ERROR_ARGUMENT, "two fields named 'mark'");
    parts.count = (size_t)UINT32_MAX + 1;
    then_parts_fail(&parts, CREASE_ERROR_ARGUMENT, "at most 4294967295 fit");
}

static void given_further_fields_then_those_of_the_same_name_are_replaced(void **state)
{
    crease_context *context = given_context();
    crease_cloud *cloud = given_cloud(context), *more = NULL;
    const double variance[] = {0.1, 0.2, 0.3};
    const int16_t other[] = {-1, -2, -3};
    const crease_field further[] = {
        {"variance", CREASE_TYPE_FLOAT64, variance}, {"mark", CREASE_TYPE_INT16, other}};
    assert_int_equal(crease_cloud_with_fields(context, cloud, further, 2, &more), CREASE_OK);
    assert_int_equal(crease_cloud_field_count(more), 3);
    crease_field field = crease_cloud_find_field(more, "mark");
    assert_int_equal(field.type, CREASE_TYPE_INT16);
    assert_near(crease_field_value(&field, 1), -2, 0);
    field = crease_cloud_find_field(more, "height");
    assert_near(crease_field_value(&field, 0), 0.5, 0);
    assert_memory_equal(crease_cloud_normals(more), normals, sizeof normals);
    field = crease_cloud_find_field(cloud, "mark");
    assert_near(crease_field_value(&field, 2), 255, 0);
    crease_cloud_free(cloud);
    crease_cloud_free(more);
    crease_context_free(context);
}

static void given_every_type_then_size_and_value_are_right(void **state)
{
    static const int8_t i8 = -100;
    static const uint8_t u8 = 200;
    static const int16_t i16 = -30000;
    static const uint16_t u16 = 60000;
    static const int32_t i32 = -2000000000;
    static const uint32_t u32 = 4000000000u;
    static const float f32 = 0.1f;
    static const double f64 = 0.1;
    const struct {
        crease_field field;
        size_t size;
        double value;
    } cases[] = {{{"a", CREASE_TYPE_INT8, &i8}, 1, -100}, {{"a", CREASE_TYPE_UINT8, &u8}, 1, 200},
        {{"a", CREASE_TYPE_INT16, &i16}, 2, -30000}, {{"a", CREASE_TYPE_UINT16, &u16}, 2, 60000},
        {{"a", CREASE_TYPE_INT32, &i32}, 4, -2e9}, {{"a", CREASE_TYPE_UINT32, &u32}, 4, 4e9},
        {{"a", CREASE_TYPE_FLOAT32, &f32}, 4, (double)0.1f},
        {{"a", CREASE_TYPE_FLOAT64, &f64}, 8, 0.1}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(crease_type_size(cases[i].field.type), cases[i].size);
        assert_near(crease_field_value(&cases[i].field, 0), cases[i].value, 0);
    }
}

static void given_memory_that_runs_out_then_nothing_is_leaked(void **state)
{
    crease_context *context = given_context();
    const crease_cloud_parts parts = given_parts();
    crease_cloud *cloud = NULL;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; status != CREASE_OK; n++) {
        crease_context_fail_allocation(context, n);
        status = crease_cloud_create(context, &parts, &cloud);
        assert_true(status == CREASE_OK || (status == CREASE_ERROR_NO_MEMORY && !cloud));
    }
    assert_int_equal(n, 9); /* eight allocations, then none fails */
    crease_cloud_free(cloud);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_parts_then_the_cloud_holds_copies_of_them),
        cmocka_unit_test(given_a_field_that_is_not_there_then_its_name_is_null),
        cmocka_unit_test(given_points_then_bounds_hold_them),
        cmocka_unit_test(given_no_points_then_the_cloud_is_empty),
        cmocka_unit_test(given_wrong_parts_then_a_sentence_says_what),
        cmocka_unit_test(given_further_fields_then_those_of_the_same_name_are_replaced),
        cmocka_unit_test(given_every_type_then_size_and_value_are_right),
        cmocka_unit_test(given_memory_that_runs_out_then_nothing_is_leaked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
