/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The page: what a browser would read from it is read back here. */
#include "given.h"

#include "view/base64.h"

#include <cjson/cJSON.h>
#include <locale.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

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
    snprintf(opening, sizeof opening, "id=\"%s\"", id);
    const char *begin = strstr(page, opening);
    assert_non_null(begin);
    begin = strchr(begin, '>') + 1;
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

/* How an array is packed, by the name of its form. */
typedef struct form {
    const char *name;
    size_t components, bytes;
    bool differences;
    double unit; /* of fractions; 0: whole numbers or bits */
} form;

static form form_of(const char *page, const char *id)
{
    static const form forms[] = {{"lattice", 3, 3, true, 1.0 / 8388607},
        {"direction", 3, 2, true, 1.0 / 32767}, {"links", 2, 4, true, 0},
        {"triangles", 3, 4, true, 0}, {"uint8", 1, 1, true, 0}, {"int32", 1, 4, true, 0},
        {"uint32", 1, 4, true, 0}, {"float32", 1, 4, false, 0}};
    char opening[64];
    snprintf(opening, sizeof opening, "id=\"%s\" data-form=\"", id);
    const char *name = strstr(page, opening);
    assert_non_null(name);
    name += strlen(opening);
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (strncmp(name, forms[i].name, strlen(forms[i].name)) == 0 &&
            name[strlen(forms[i].name)] == '"')
            return forms[i];
    fail_msg("unknown form: %.20s", name);
    return forms[0];
}

/* The next number of a component: its bytes stand a block's size apart. */
static uint32_t unpack_one(const uint8_t *bytes, size_t apart, form f, uint32_t *last)
{
    uint32_t value = 0;
    for (size_t b = 0; b < f.bytes; b++)
        value |= (uint32_t)bytes[b * apart] << 8 * b;
    if (!f.differences)
        return value;
    const uint32_t difference = value & 1 ? ~(value >> 1) : value >> 1;
    return *last += difference;
}

/* The numbers of an array, as the viewer unpacks them: 4 bytes each, of bytes one. */
static size_t unpack(const uint8_t *bytes, size_t size, form f, void *out)
{
    enum { BLOCK = 4096 };
    uint32_t last[3] = {0};
    const size_t tuples = size / (f.components * f.bytes);
    for (size_t i = 0; i < tuples * f.components; i++) {
        const size_t tuple = i / f.components, c = i % f.components, first = tuple / BLOCK * BLOCK;
        const size_t apart = tuples - first < BLOCK ? tuples - first : BLOCK;
        const uint8_t *at = bytes + (first * f.components + c * apart) * f.bytes + (tuple - first);
        const uint32_t value = unpack_one(at, apart, f, &last[c]);
        const unsigned spare = 32 - 8 * (unsigned)f.bytes;
        if (f.unit > 0)
            ((float *)out)[i] = (float)((int32_t)(value << spare) >> spare) * (float)f.unit;
        else if (f.bytes == 1)
            ((uint8_t *)out)[i] = (uint8_t)value;
        else
            ((uint32_t *)out)[i] = value;
    }
    return tuples * f.components;
}

/* The numbers of a part, how many there are. */
static size_t part(const char *page, const cJSON *of, const char *name, void *out)
{
    static uint8_t packed[1 << 20], bytes[1 << 20];
    const cJSON *id = cJSON_GetObjectItem(of, name);
    assert_true(cJSON_IsString(id));
    char *text = element(page, id->valuestring);
    uLongf size = sizeof bytes;
    assert_int_equal(uncompress(bytes, &size, packed, decode(text, packed, sizeof packed)), Z_OK);
    free(text);
    return unpack(bytes, size, form_of(page, id->valuestring), out);
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
    assert_int_equal(part(page, points, "positions", positions), 9);
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
    assert_int_equal(part(page, deviation, "data", deviations), 3);
    assert_near((double)deviations[0], -0.5, 0);
    assert_true(isnan(deviations[1]));
    assert_string_equal(string(deviation, "map"), "diverging");
    assert_near(number(deviation, "lowest"), -0.5, 0);
    assert_near(number(deviation, "highest"), 0.5, 0);
    assert_int_equal(part(page, ring, "data", rings), 3);
    assert_string_equal(string(ring, "type"), "int32");
    assert_int_equal(rings[0], -7);
    assert_int_equal(rings[2], 2000000011);
    const cJSON *feature = cJSON_GetArrayItem(fields, 2);
    assert_int_equal(part(page, feature, "data", features), 3);
    assert_int_equal(features[2], 255);
    assert_string_equal(string(feature, "name"), "</script>");
    cJSON_Delete(json);
    free(page);
    crease_scene_free(scene);
    crease_context_free(context);
}

/* More points than a block holds, so that every kind of block is there. */
static void given_many_points_then_every_one_comes_back(void **state)
{
    enum { COUNT = 10001 };
    crease_context *context = given_context();
    static double points[3 * COUNT];
    static int32_t rings[COUNT];
    static float positions[3 * COUNT];
    static uint32_t back[COUNT];
    for (int i = 0; i < COUNT; i++) {
        points[3 * i] = sin(i);
        points[3 * i + 1] = cos(3.0 * i);
        points[3 * i + 2] = i % 2 ? 1 : -1;
        rings[i] = (int32_t)((uint32_t)i * 2654435761U);
    }
    const crease_field field = {"ring", CREASE_TYPE_INT32, rings};
    const crease_cloud_parts parts = {
        .count = COUNT, .points = points, .fields = &field, .field_count = 1};
    crease_cloud *cloud = NULL;
    crease_scene *scene = NULL;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    assert_int_equal(crease_scene_create(context, "many", &scene), CREASE_OK);
    assert_int_equal(crease_scene_add_cloud(context, scene, "points", cloud), CREASE_OK);
    char *page = write_page(context, scene);
    cJSON *json = describe(page);
    const cJSON *layer = cJSON_GetArrayItem(cJSON_GetObjectItem(json, "layers"), 0);
    assert_int_equal(part(page, layer, "positions", positions), 3 * COUNT);
    const cJSON *centre = cJSON_GetObjectItem(json, "centre");
    for (int i = 0; i < 3 * COUNT; i++)
        assert_near(cJSON_GetArrayItem(centre, i % 3)->valuedouble +
                number(json, "scale") * (double)positions[i],
            points[i], 2e-7);
    const cJSON *ring = cJSON_GetArrayItem(cJSON_GetObjectItem(layer, "fields"), 0);
    assert_int_equal(part(page, ring, "data", back), COUNT);
    for (int i = 0; i < COUNT; i++)
        assert_int_equal((int32_t)back[i], rings[i]);
    cJSON_Delete(json);
    free(page);
    crease_scene_free(scene);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_facts_then_they_stand_with_their_layer(void **state)
{
    crease_context *context = given_context();
    crease_scene *scene = given_scene(context, "facts");
    const crease_fact facts[] = {{.name = "type", .text = "</script>"},
        {.name = "place", .numbers = {1e6, NAN, 0.1}, .number_count = 3},
        {.name = "radius", .numbers = {2.5}, .number_count = 1}};
    assert_int_equal(crease_scene_describe(context, scene, 0, facts, 3), CREASE_OK);
    assert_int_equal(crease_scene_describe(context, scene, 7, facts + 2, 1), CREASE_OK);
    char *page = write_page(context, scene);
    cJSON *json = describe(page);
    const cJSON *layers = cJSON_GetObjectItem(json, "layers");
    for (int i = 0; i < 3; i++)
        assert_int_equal(
            cJSON_GetArraySize(cJSON_GetObjectItem(cJSON_GetArrayItem(layers, i), "facts")), 0);
    const cJSON *curves = cJSON_GetArrayItem(layers, 3);
    const cJSON *told = cJSON_GetObjectItem(curves, "facts");
    assert_int_equal(cJSON_GetArraySize(told), 4);
    const cJSON *type = cJSON_GetArrayItem(told, 0), *place = cJSON_GetArrayItem(told, 1);
    assert_string_equal(cJSON_GetArrayItem(type, 2)->valuestring, "</script>");
    assert_near(cJSON_GetArrayItem(cJSON_GetArrayItem(place, 2), 0)->valuedouble, 1e6, 0);
    assert_true(cJSON_IsNull(cJSON_GetArrayItem(cJSON_GetArrayItem(place, 2), 1)));
    assert_int_equal(cJSON_GetArrayItem(cJSON_GetArrayItem(told, 3), 0)->valueint, 7);
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(curves, "begins")), 1);
    cJSON_Delete(json);
    free(page);
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_facts_of_nothing_or_too_many_numbers_then_a_sentence(void **state)
{
    crease_context *context = given_context();
    crease_scene *empty = NULL, *scene = given_scene(context, "facts");
    const crease_fact fact = {.name = "many", .number_count = 9};
    assert_int_equal(crease_scene_create(context, "", &empty), CREASE_OK);
    assert_int_equal(crease_scene_describe(context, empty, 0, &fact, 1), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "nothing to describe"));
    assert_int_equal(crease_scene_describe(context, scene, 0, &fact, 1), CREASE_ERROR_ARGUMENT);
    assert_non_null(strstr(crease_context_message(context), "9 numbers"));
    crease_scene_free(empty);
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_a_surface_with_its_net_then_facts_are_the_surfaces(void **state)
{
    crease_context *context = given_context();
    static const double knots[] = {0, 0, 1, 1};
    static const double net[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
    const crease_surface_parts parts = {
        .order = {2, 2}, .count = {2, 2}, .knots = {knots, knots}, .control_points = net};
    crease_surface *surface = NULL;
    crease_scene *scene = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    assert_int_equal(crease_scene_create(context, "sheet", &scene), CREASE_OK);
    assert_int_equal(crease_scene_add_surfaces(
                         context, scene, "sheet", (const crease_surface *const *)&surface, 1, true),
        CREASE_OK);
    const crease_fact fact = {.name = "rms", .numbers = {0.5}, .number_count = 1};
    assert_int_equal(crease_scene_describe(context, scene, 0, &fact, 1), CREASE_OK);
    char *page = write_page(context, scene);
    cJSON *json = describe(page);
    const cJSON *layers = cJSON_GetObjectItem(json, "layers");
    static uint32_t corners[3 << 10], owners[1 << 10];
    const cJSON *mesh = cJSON_GetArrayItem(layers, 0);
    assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(mesh, "facts")), 1);
    assert_int_equal(
        cJSON_GetArraySize(cJSON_GetObjectItem(cJSON_GetArrayItem(layers, 1), "facts")), 0);
    assert_int_equal(part(page, mesh, "indices", corners), 3 * (size_t)number(mesh, "triangles"));
    assert_int_equal(part(page, mesh, "owners", owners), (size_t)number(mesh, "triangles"));
    float normals[64 * 3];
    const size_t count = part(page, mesh, "normals", normals);
    for (size_t i = 0; i < count; i += 3)
        assert_near(fabs((double)normals[i + 2]), 1, 1e-6);
    for (size_t i = 0; i < 3 * (size_t)number(mesh, "triangles"); i++)
        assert_true(corners[i] < count / 3);
    cJSON_Delete(json);
    free(page);
    crease_surface_free(surface);
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
        assert_true(n < 200);
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
        cmocka_unit_test(given_many_points_then_every_one_comes_back),
        cmocka_unit_test(given_facts_then_they_stand_with_their_layer),
        cmocka_unit_test(given_facts_of_nothing_or_too_many_numbers_then_a_sentence),
        cmocka_unit_test(given_a_surface_with_its_net_then_facts_are_the_surfaces),
        cmocka_unit_test(given_names_that_try_to_break_out_then_they_stay_text),
        cmocka_unit_test(given_a_page_then_it_loads_nothing_and_keeps_the_licence_inside),
        cmocka_unit_test(given_any_threads_and_locale_then_the_same_bytes),
        cmocka_unit_test(given_what_cannot_be_written_then_no_page),
        cmocka_unit_test(given_bytes_then_base64_is_that_of_the_standard),
        cmocka_unit_test(given_more_bytes_than_the_encoder_holds_then_none_is_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
