/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The page: what a browser would read from it is read back here. */
#include "given.h"

#include "view/base64.h"

#include <cjson/cJSON.h>
#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>

static const char path[] = "test_page_written.html";
static const char hostile[] = "</title></script><script>alert(1)</script><!--\"'&\xFF";

/* ------------------------------------------------------------------------------------- given -- */

/* Far from the origin, with a field of every kind and a name that tries to break out. */
static crease_cloud *given_cloud(crease_context *context)
{
    static const double points[] = {1e6, 0, -1, 1e6 + 1, 2, -1, 1e6 + 0.25, 1, 3};
    static const double deviations[] = {-0.5, NAN, 0.25};
    static const int32_t rings[] = {-7, 0, 2000000011};
    static const uint8_t features[] = {0, 1, 255};
    const crease_field fields[] = {{"deviation", CREASE_TYPE_FLOAT64, deviations},
        {"ring", CREASE_TYPE_INT32, rings}, {"</script>", CREASE_TYPE_UINT8, features}};
    const crease_cloud_parts parts = {
        .count = 3, .points = points, .fields = fields, .field_count = 3};
    crease_cloud *cloud = NULL;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    return cloud;
}

static crease_scene *given_scene(crease_context *context, const char *title)
{
    static const double knots[] = {0, 0, 1, 1};
    static const double net[] = {1e6, 0, 0, 1e6, 1, 0, 1e6 + 1, 0, 0, 1e6 + 1, 1, 0};
    const crease_surface_parts parts = {
        .order = {2, 2}, .count = {2, 2}, .knots = {knots, knots}, .control_points = net};
    crease_cloud *cloud = given_cloud(context);
    crease_surface *surface = NULL;
    crease_curve *curve = NULL;
    crease_scene *scene = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    assert_int_equal(crease_curve_create(context, 2, 2, knots, net, &curve), CREASE_OK);
    assert_int_equal(crease_scene_create(context, title, &scene), CREASE_OK);
    assert_int_equal(crease_scene_add_cloud(context, scene, title, cloud), CREASE_OK);
    assert_int_equal(crease_scene_add_surfaces(
                         context, scene, "sheet", (const crease_surface *const *)&surface, 1, true),
        CREASE_OK);
    assert_int_equal(
        crease_scene_add_curves(context, scene, "crease", (const crease_curve *const *)&curve, 1),
        CREASE_OK);
    crease_curve_free(curve);
    crease_surface_free(surface);
    crease_cloud_free(cloud);
    return scene;
}

/* ---------------------------------------------------------------------------------- the page -- */

static char *read_page(void)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    struct stat facts;
    assert_int_equal(fstat(fileno(file), &facts), 0);
    char *text = calloc(1, (size_t)facts.st_size + 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, (size_t)facts.st_size, file), facts.st_size);
    fclose(file);
    return text;
}

static char *write_page(crease_context *context, const crease_scene *scene)
{
    if (crease_page_write(context, scene, path) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    char *text = read_page();
    unlink(path);
    return text;
}

/* The text of the element with this identifier; the caller frees it. */
static char *element(const char *page, const char *id)
{
    char opening[64];
    snprintf(opening, sizeof opening, "id=\"%s\">", id);
    const char *begin = strstr(page, opening);
    assert_non_null(begin);
    begin += strlen(opening);
    const char *end = strstr(begin, "</script>");
    assert_non_null(end);
    char *text = calloc(1, (size_t)(end - begin) + 1);
    memcpy(text, begin, (size_t)(end - begin));
    return text;
}

static int digit(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = strchr(digits, c);
    assert_true(c && at);
    return (int)(at - digits);
}

/* The bytes of a base64 text. */
static size_t decode(const char *text, uint8_t *out, size_t room)
{
    size_t count = 0;
    uint32_t bits = 0;
    int held = 0;
    assert_int_equal(strlen(text) % 4, 0);
    for (; *text && *text != '='; text++) {
        bits = bits << 6 | (uint32_t)digit(*text);
        held += 6;
        if (held >= 8) {
            held -= 8;
            assert_true(count < room);
            out[count++] = (uint8_t)(bits >> held & 0xFF);
        }
    }
    return count;
}

static size_t part(const char *page, const cJSON *of, const char *name, void *out, size_t room)
{
    const cJSON *id = cJSON_GetObjectItem(of, name);
    assert_true(cJSON_IsString(id));
    char *text = element(page, id->valuestring);
    const size_t size = decode(text, out, room);
    free(text);
    return size;
}

static cJSON *describe(const char *page)
{
    char *text = element(page, "crease-scene");
    cJSON *scene = cJSON_Parse(text);
    assert_non_null(scene);
    free(text);
    return scene;
}

static double number(const cJSON *of, const char *name)
{
    const cJSON *item = cJSON_GetObjectItem(of, name);
    assert_true(cJSON_IsNumber(item));
    return item->valuedouble;
}

static const char *string(const cJSON *of, const char *name)
{
    const cJSON *item = cJSON_GetObjectItem(of, name);
    assert_true(cJSON_IsString(item));
    return item->valuestring;
}

static int count_of(const char *text, const char *word)
{
    int count = 0;
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word))
        count++;
    return count;
}

/* -------------------------------------------------------------------------------------- tests --
 */

static void given_a_scene_then_the_page_describes_every_layer(void **state)
{
    crease_context *context = given_context();
    crease_scene *scene = given_scene(context, "A wedge");
    char *page = write_page(context, scene);
    cJSON *json = describe(page);
    assert_string_equal(string(json, "title"), "A wedge");
    assert_non_null(strstr(page, "<title>A wedge</title>"));
    const cJSON *layers = cJSON_GetObjectItem(json, "layers");
    assert_int_equal(cJSON_GetArraySize(layers), 4);
    static const char *const kinds[] = {"points", "surface", "net", "curves"};
    for (int i = 0; i < 4; i++)
        assert_string_equal(string(cJSON_GetArrayItem(layers, i), "kind"), kinds[i]);
    assert_int_equal(number(cJSON_GetArrayItem(layers, 0), "count"), 3);
    assert_true(number(cJSON_GetArrayItem(layers, 1), "triangles") >= 2);
    assert_int_equal(number(cJSON_GetArrayItem(layers, 2), "count"), 4);
    assert_int_equal(number(cJSON_GetArrayItem(layers, 3), "curves"), 1);
    cJSON_Delete(json);
    free(page);
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_points_far_away_then_their_positions_keep_single_precision(void **state)
{
    crease_context *context = given_context();
    crease_scene *scene = given_scene(context, "far");
    char *page = write_page(context, scene);
    cJSON *json = describe(page);
    const cJSON *points = cJSON_GetArrayItem(cJSON_GetObjectItem(json, "layers"), 0);
    float positions[9];
    assert_int_equal(part(page, points, "positions", positions, sizeof positions), 36);
    const double expected[] = {1e6, 0, -1, 1e6 + 1, 2, -1, 1e6 + 0.25, 1, 3};
    const cJSON *centre = cJSON_GetObjectItem(json, "centre");
    for (int i = 0; i < 9; i++)
        assert_near(cJSON_GetArrayItem(centre, i % 3)->valuedouble +
                number(json, "scale") * (double)positions[i],
            expected[i], 1e-6);
    assert_near(number(json, "scale"), 2, 0);
    cJSON_Delete(json);
    free(page);
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_fields_then_values_types_and_ranges_are_there(void **state)
{
    crease_context *context = given_context();
    crease_scene *scene = given_scene(context, "fields");
    char *page = write_page(context, scene);
    cJSON *json = describe(page);
    const cJSON *points = cJSON_GetArrayItem(cJSON_GetObjectItem(json, "layers"), 0);
    const cJSON *fields = cJSON_GetObjectItem(points, "fields");
    const cJSON *deviation = cJSON_GetArrayItem(fields, 0), *ring = cJSON_GetArrayItem(fields, 1);
    float deviations[3];
    int32_t rings[3];
    uint8_t features[3];
    assert_int_equal(part(page, deviation, "data", deviations, sizeof deviations), 12);
    assert_near((double)deviations[0], -0.5, 0);
    assert_true(isnan(deviations[1]));
    assert_string_equal(string(deviation, "map"), "diverging");
    assert_near(number(deviation, "lowest"), -0.5, 0);
    assert_near(number(deviation, "highest"), 0.5, 0);
    assert_int_equal(part(page, ring, "data", rings, sizeof rings), 12);
    assert_string_equal(string(ring, "type"), "int32");
    assert_int_equal(rings[0], -7);
    assert_int_equal(rings[2], 2000000011);
    const cJSON *feature = cJSON_GetArrayItem(fields, 2);
    assert_int_equal(part(page, feature, "data", features, sizeof features), 3);
    assert_int_equal(features[2], 255);
    assert_string_equal(string(feature, "name"), "</script>");
    cJSON_Delete(json);
    free(page);
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_names_that_try_to_break_out_then_they_stay_text(void **state)
{
    crease_context *context = given_context();
    crease_scene *plain = given_scene(context, "plain"), *evil = given_scene(context, hostile);
    char *expected = write_page(context, plain), *page = write_page(context, evil);
    assert_int_equal(count_of(page, "<script"), count_of(expected, "<script"));
    assert_int_equal(count_of(page, "</script"), count_of(expected, "</script"));
    assert_int_equal(count_of(page, "<!--"), count_of(expected, "<!--"));
    assert_int_equal(count_of(page, "</title"), 1);
    assert_null(strstr(page, "alert(1)</"));
    cJSON *json = describe(page);
    assert_string_equal(
        string(json, "title"), "</title></script><script>alert(1)</script><!--\"'&\xEF\xBF\xBD");
    cJSON_Delete(json);
    free(page);
    free(expected);
    crease_scene_free(plain);
    crease_scene_free(evil);
    crease_context_free(context);
}

static void given_a_page_then_it_loads_nothing_and_keeps_the_licence_inside(void **state)
{
    crease_context *context = given_context();
    crease_scene *scene = given_scene(context, "alone");
    char *page = write_page(context, scene);
    assert_non_null(strstr(page, "default-src 'none'"));
    assert_null(strstr(page, "<script src"));
    assert_null(strstr(page, "<link"));
    assert_null(strstr(page, "<!--crease:"));
    assert_non_null(strstr(page, "The MIT License"));
    free(page);
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_any_threads_and_locale_then_the_same_bytes(void **state)
{
    char *pages[2];
    for (int i = 0; i < 2; i++) {
        setlocale(LC_ALL, i ? "de_DE.UTF-8" : "C");
        crease_context *context = given_context_with_threads(1 + 3 * i);
        crease_scene *scene = given_scene(context, "same");
        pages[i] = write_page(context, scene);
        crease_scene_free(scene);
        crease_context_free(context);
    }
    setlocale(LC_ALL, "C");
    assert_int_equal(strlen(pages[0]), strlen(pages[1]));
    assert_int_equal(strcmp(pages[0], pages[1]), 0);
    free(pages[0]);
    free(pages[1]);
}

static void given_what_cannot_be_written_then_no_page(void **state)
{
    crease_context *context = given_context();
    crease_scene *scene = given_scene(context, ""), *empty = NULL;
    assert_int_equal(crease_scene_create(context, "", &empty), CREASE_OK);
    assert_int_equal(crease_page_write(context, empty, path), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "nothing"));
    assert_int_equal(crease_page_write(context, scene, "test_page.pdf"), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_page_write(context, scene, "no_such_folder/a.html"), CREASE_ERROR_CANNOT_WRITE);
    assert_int_not_equal(access(path, F_OK), 0);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    for (long n = 0; status != CREASE_OK; n++) {
        crease_context_fail_allocation(context, n);
        status = crease_page_write(context, scene, path);
        assert_int_equal(access(path, F_OK) == 0, status == CREASE_OK);
        assert_true(n < 50);
    }
    unlink(path);
    crease_scene_free(scene);
    crease_scene_free(empty);
    crease_context_free(context);
}

/* Known answers: RFC 4648, section 10. */
static void given_bytes_then_base64_is_that_of_the_standard(void **state)
{
    static const char *const expected[] = {
        "", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    crease_context *context = given_context();
    for (size_t length = 0; length <= 6; length++) {
        crease_output *output = NULL;
        crease_base64 encoder;
        assert_int_equal(crease_output_open(context, path, &output), CREASE_OK);
        crease_base64_begin(&encoder, output);
        for (size_t i = 0; i < length; i++)
            crease_base64_put(&encoder, (uint32_t) "foobar"[i], 1);
        crease_base64_end(&encoder);
        assert_int_equal(crease_output_close(context, output, CREASE_OK), CREASE_OK);
        char *text = read_page();
        assert_string_equal(text, expected[length]);
        free(text);
    }
    unlink(path);
    crease_context_free(context);
}

static void given_more_bytes_than_the_encoder_holds_then_none_is_lost(void **state)
{
    enum { COUNT = 5000 };
    crease_context *context = given_context();
    crease_output *output = NULL;
    crease_base64 encoder;
    assert_int_equal(crease_output_open(context, path, &output), CREASE_OK);
    crease_base64_begin(&encoder, output);
    for (uint32_t i = 0; i < COUNT; i++)
        crease_base64_put(&encoder, i * 2654435761U, 4);
    crease_base64_end(&encoder);
    assert_int_equal(crease_output_close(context, output, CREASE_OK), CREASE_OK);
    char *text = read_page();
    static uint8_t bytes[4 * COUNT];
    assert_int_equal(decode(text, bytes, sizeof bytes), 4 * COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        const uint8_t *b = &bytes[4 * i];
        const uint32_t value =
            (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
        assert_int_equal(value, i * 2654435761U);
    }
    free(text);
    unlink(path);
    crease_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_a_scene_then_the_page_describes_every_layer),
        cmocka_unit_test(given_points_far_away_then_their_positions_keep_single_precision),
        cmocka_unit_test(given_fields_then_values_types_and_ranges_are_there),
        cmocka_unit_test(given_names_that_try_to_break_out_then_they_stay_text),
        cmocka_unit_test(given_a_page_then_it_loads_nothing_and_keeps_the_licence_inside),
        cmocka_unit_test(given_any_threads_and_locale_then_the_same_bytes),
        cmocka_unit_test(given_what_cannot_be_written_then_no_page),
        cmocka_unit_test(given_bytes_then_base64_is_that_of_the_standard),
        cmocka_unit_test(given_more_bytes_than_the_encoder_holds_then_none_is_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
