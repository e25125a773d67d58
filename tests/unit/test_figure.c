/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Scenes and figures: what is drawn is read back from the picture. */
#include "given.h"

#include "view/scene.h"

#include <cairo.h>
#include <sys/stat.h>
#include <unistd.h>

/* ------------------------------------------------------------------------------------- given -- */

/* A scene that shows points without a name, so that it has no legend. */
static crease_scene *given_points(crease_context *context, const double *points, size_t count)
{
    crease_scene *scene = NULL;
    crease_cloud *cloud = given_cloud_of(context, points, count);
    assert_int_equal(crease_scene_create(context, NULL, &scene), CREASE_OK);
    assert_int_equal(crease_scene_add_cloud(context, scene, NULL, cloud), CREASE_OK);
    crease_cloud_free(cloud);
    return scene;
}

/* The square -1..1 at height 0. */
static crease_surface *given_square(crease_context *context)
{
    static const double knots[] = {0, 0, 1, 1};
    static const double points[] = {-1, -1, 0, -1, 1, 0, 1, -1, 0, 1, 1, 0};
    const crease_surface_parts parts = {
        .order = {2, 2}, .count = {2, 2}, .knots = {knots, knots}, .control_points = points};
    crease_surface *surface = NULL;
    assert_int_equal(crease_surface_create(context, &parts, &surface), CREASE_OK);
    return surface;
}

static void add_square(crease_context *context, crease_scene *scene, bool net)
{
    crease_surface *square = given_square(context);
    assert_int_equal(crease_scene_add_surfaces(
                         context, scene, "", (const crease_surface *const *)&square, 1, net),
        CREASE_OK);
    crease_surface_free(square);
}

static void add_line(
    crease_context *context, crease_scene *scene, const double from[3], const double to[3])
{
    static const double knots[] = {0, 0, 1, 1};
    const double points[] = {from[0], from[1], from[2], to[0], to[1], to[2]};
    crease_curve *curve = NULL;
    assert_int_equal(crease_curve_create(context, 2, 2, knots, points, &curve), CREASE_OK);
    assert_int_equal(
        crease_scene_add_curves(context, scene, "", (const crease_curve *const *)&curve, 1),
        CREASE_OK);
    crease_curve_free(curve);
}

static crease_figure_options seen_from(double azimuth, double elevation)
{
    crease_figure_options options = crease_figure_options_default();
    options.width = 400;
    options.height = 300;
    options.azimuth = azimuth;
    options.elevation = elevation;
    options.axes = false;
    return options;
}

/* --------------------------------------------------------------------------------- pictures -- */

typedef bool is_wanted(int red, int green, int blue);

static bool is_green(int red, int green, int blue)
{
    return green > red + 60 && green > blue + 40;
}

static bool is_red(int red, int green, int blue)
{
    return red > green + 60 && red > blue + 60;
}

static bool is_bluish(int red, int green, int blue)
{
    return blue > red + 15 && blue > 90 && green > 70;
}

static bool is_dark(int red, int green, int blue)
{
    return red < 110 && green < 110 && blue < 120;
}

static bool is_grey(int red, int green, int blue)
{
    return abs(red - 153) < 8 && abs(green - 153) < 8 && abs(blue - 153) < 8;
}

/* What a picture shows of one colour: how many pixels, and the box around them. */
typedef struct found {
    int count, left, right, top, bottom;
} found;

static found find(const char *path, is_wanted *wanted)
{
    cairo_surface_t *image = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    const int width = cairo_image_surface_get_width(image);
    const int height = cairo_image_surface_get_height(image);
    const int stride = cairo_image_surface_get_stride(image);
    const unsigned char *bytes = cairo_image_surface_get_data(image);
    found f = {0, width, -1, height, -1};
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const unsigned char *p = bytes + y * stride + 4 * x;
            if (!wanted(p[2], p[1], p[0]))
                continue;
            f.count++;
            f.left = x < f.left ? x : f.left;
            f.right = x > f.right ? x : f.right;
            f.top = y < f.top ? y : f.top;
            f.bottom = y > f.bottom ? y : f.bottom;
        }
    cairo_surface_destroy(image);
    return f;
}

/* Draws the scene and looks for a colour. */
static found draw(crease_context *context, const crease_scene *scene,
    const crease_figure_options *options, is_wanted *wanted)
{
    static const char path[] = "test_figure_drawn.png";
    const crease_status status = crease_figure_write(context, scene, options, path);
    if (status != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    const found f = find(path, wanted);
    unlink(path);
    return f;
}

static char *read_file(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    struct stat facts;
    assert_int_equal(fstat(fileno(file), &facts), 0);
    char *bytes = calloc(1, (size_t)facts.st_size + 1);
    assert_non_null(bytes);
    *size = fread(bytes, 1, (size_t)facts.st_size, file);
    fclose(file);
    return bytes;
}

/* ---------------------------------------------------------------------------------- geometry -- */

static void given_points_seen_from_the_front_then_they_lie_where_they_should(void **state)
{
    crease_context *context = given_context();
    const double points[] = {-1, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 1};
    crease_scene *scene = given_points(context, points, 4);
    const crease_figure_options options = seen_from(-90, 0);
    const found f = draw(context, scene, &options, is_green);
    assert_true(f.count > 30);
    assert_near(f.right - f.left, f.bottom - f.top, 1);
    assert_near((f.left + f.right) / 2.0, 200, 1.5);
    assert_near((f.top + f.bottom) / 2.0, 150, 1.5);
    assert_true(f.bottom - f.top > 200);
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_a_point_before_or_behind_a_surface_then_it_is_seen_or_hidden(void **state)
{
    crease_context *context = given_context();
    const crease_figure_options options = seen_from(-90, 60);
    const double above[] = {0, 0, 0.5}, below[] = {0, 0, -0.5}, on[] = {0.3, 0.2, 0};
    const double *const places[] = {above, below, on};
    for (int i = 0; i < 3; i++) {
        crease_scene *scene = given_points(context, places[i], 1);
        add_square(context, scene, false);
        const found f = draw(context, scene, &options, is_green);
        if (i == 1)
            assert_int_equal(f.count, 0);
        else
            assert_true(f.count > 5);
        crease_scene_free(scene);
    }
    crease_context_free(context);
}

static void given_a_large_cloud_then_a_surface_hides_its_points_too(void **state)
{
    enum { COUNT = 7000 };
    crease_context *context = given_context();
    const crease_figure_options options = seen_from(-90, 90);
    for (int side = -1; side <= 1; side += 2) {
        double *points = calloc(3 * COUNT, sizeof *points);
        for (int i = 0; i < COUNT; i++) {
            points[3 * i] = (i % 70 - 35) / 50.0;
            points[3 * i + 1] = (i / 70 - 50) / 70.0;
            points[3 * i + 2] = 0.3 * side;
        }
        crease_scene *scene = given_points(context, points, COUNT);
        add_square(context, scene, false);
        const found f = draw(context, scene, &options, is_green);
        if (side < 0)
            assert_int_equal(f.count, 0);
        else
            assert_true(f.count > 2000);
        crease_scene_free(scene);
        free(points);
    }
    crease_context_free(context);
}

static bool is_deep_green(int red, int green, int blue)
{
    return green > red + 30 && green < 110;
}

static void given_a_large_cloud_with_a_step_then_its_lower_side_is_darker_there(void **state)
{
    enum { COUNT = 90000 };
    crease_context *context = given_context();
    const crease_figure_options options = seen_from(-90, 90);
    double *points = calloc(3 * COUNT, sizeof *points);
    int deep[2];
    for (int step = 0; step < 2; step++) {
        for (int i = 0; i < COUNT; i++) {
            points[3 * i] = i % 300 / 300.0;
            points[3 * i + 1] = i / 300 / 300.0;
            points[3 * i + 2] = step && i % 300 < 150 ? -0.2 : 0;
        }
        crease_scene *scene = given_points(context, points, COUNT);
        deep[step] = draw(context, scene, &options, is_deep_green).count;
        crease_scene_free(scene);
    }
    assert_true(deep[1] > deep[0] + 100);
    free(points);
    crease_context_free(context);
}

static void given_a_crease_behind_a_surface_then_only_its_free_part_is_dark(void **state)
{
    crease_context *context = given_context();
    const crease_figure_options options = seen_from(-90, 90);
    int lengths[2];
    for (int below = 0; below < 2; below++) {
        crease_scene *scene = NULL;
        assert_int_equal(crease_scene_create(context, "", &scene), CREASE_OK);
        add_square(context, scene, false);
        const double z = below ? -0.4 : 0.4;
        add_line(context, scene, (const double[]){0, 0, z}, (const double[]){2, 0, z});
        const found f = draw(context, scene, &options, is_dark);
        lengths[below] = f.right - f.left;
        crease_scene_free(scene);
    }
    assert_true(lengths[1] > 20);
    assert_near(lengths[0], 2 * lengths[1], 6);
    crease_context_free(context);
}

static void given_a_surface_then_it_is_shaded_without_holes(void **state)
{
    crease_context *context = given_context();
    crease_scene *scene = NULL;
    assert_int_equal(crease_scene_create(context, "", &scene), CREASE_OK);
    add_square(context, scene, true);
    const crease_figure_options options = seen_from(-90, 90);
    const found f = draw(context, scene, &options, is_bluish);
    const int area = (f.right - f.left + 1) * (f.bottom - f.top + 1);
    assert_near(f.right - f.left, f.bottom - f.top, 1);
    assert_true(f.count > 0.93 * area);
    const found net = draw(context, scene, &options, is_red);
    assert_true(net.count > 100);
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_a_field_then_its_values_colour_the_points(void **state)
{
    crease_context *context = given_context();
    const double points[] = {-1, 0, 0, 0, 0, 0, 1, 0, 0}, values[] = {-1, NAN, 1};
    const crease_field field = {"deviation", CREASE_TYPE_FLOAT64, values};
    const crease_cloud_parts parts = {
        .count = 3, .points = points, .fields = &field, .field_count = 1};
    crease_cloud *cloud = NULL;
    crease_scene *scene = NULL;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    assert_int_equal(crease_scene_create(context, "", &scene), CREASE_OK);
    assert_int_equal(crease_scene_add_cloud(context, scene, "", cloud), CREASE_OK);
    crease_figure_options options = seen_from(-90, 0);
    assert_true(draw(context, scene, &options, is_green).count > 0);
    options.colour_by = "deviation";
    assert_int_equal(draw(context, scene, &options, is_green).count, 0);
    assert_true(draw(context, scene, &options, is_grey).count > 3);
    crease_scene_free(scene);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

static void given_any_view_and_any_extent_then_there_is_a_figure(void **state)
{
    static const double clouds[][6] = {{0, 0, 0, 0, 0, 0}, {5e5, 4e6, 100, 5e5 + 1, 4e6 + 1, 101},
        {0, 0, 0, 1e-9, 0, 0}, {-1e12, 0, 0, 1e12, 1e12, 3}, {0, 0, 0, 1, 1, 0}};
    static const double angles[][2] = {{0, 0}, {-90, 90}, {45, -90}, {720, 25}, {180, -30}};
    crease_context *context = given_context();
    for (size_t c = 0; c < sizeof clouds / sizeof *clouds; c++)
        for (size_t a = 0; a < sizeof angles / sizeof *angles; a++) {
            crease_scene *scene = given_points(context, clouds[c], 2);
            crease_figure_options options = seen_from(angles[a][0], angles[a][1]);
            options.axes = true;
            options.width = options.height = 160;
            const found f = draw(context, scene, &options, is_green);
            assert_true(f.count > 0);
            assert_true(f.left > 0 && f.right < 159 && f.top > 0 && f.bottom < 159);
            crease_scene_free(scene);
        }
    crease_context_free(context);
}

/* -------------------------------------------------------------------------------------- files --
 */

/* Points, a surface with its net, a crease and a title. */
static crease_scene *given_everything(crease_context *context)
{
    static const double points[] = {0, 0, 0.4, 0.5, 0.5, -0.4, -0.5, 0.2, 0.1};
    static const double values[] = {0.1, 0.2, 0.9};
    const crease_field field = {"variance", CREASE_TYPE_FLOAT64, values};
    const crease_cloud_parts parts = {
        .count = 3, .points = points, .fields = &field, .field_count = 1};
    crease_cloud *cloud = NULL;
    crease_scene *scene = NULL;
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    assert_int_equal(crease_scene_create(context, "Everything", &scene), CREASE_OK);
    assert_int_equal(crease_scene_add_cloud(context, scene, "points", cloud), CREASE_OK);
    add_square(context, scene, true);
    add_line(context, scene, (const double[]){0, -1, 0}, (const double[]){0, 1, 0});
    crease_cloud_free(cloud);
    return scene;
}

static bool contains(const char *bytes, size_t size, const char *word)
{
    for (size_t i = 0; i + strlen(word) <= size; i++)
        if (memcmp(bytes + i, word, strlen(word)) == 0)
            return true;
    return false;
}

static void given_the_same_scene_then_every_format_has_the_same_bytes(void **state)
{
    static const char *const extensions[] = {"png", "svg", "PDF"};
    static const char *const begins[] = {"\x89PNG", "<?xml", "%PDF"};
    for (int format = 0; format < 3; format++) {
        char *bytes[2];
        size_t sizes[2];
        for (int i = 0; i < 2; i++) {
            crease_context *context = given_context_with_threads(1 + 3 * i);
            crease_scene *scene = given_everything(context);
            crease_figure_options options = seen_from(-60, 25);
            options.axes = true;
            options.colour_by = "variance";
            char path[64];
            snprintf(path, sizeof path, "test_figure_same.%s", extensions[format]);
            assert_int_equal(crease_figure_write(context, scene, &options, path), CREASE_OK);
            bytes[i] = read_file(path, &sizes[i]);
            unlink(path);
            crease_scene_free(scene);
            crease_context_free(context);
        }
        assert_int_equal(strncmp(bytes[0], begins[format], strlen(begins[format])), 0);
        assert_int_equal(sizes[0], sizes[1]);
        assert_memory_equal(bytes[0], bytes[1], sizes[0]);
        if (format == 2)
            assert_true(contains(bytes[0], sizes[0], "/CreationDate (20000101000000"));
        free(bytes[0]);
        free(bytes[1]);
    }
}

static void given_several_scenes_then_they_are_panels_of_one_figure(void **state)
{
    crease_context *context = given_context();
    crease_scene *scene = given_everything(context);
    const crease_scene *const scenes[] = {scene, scene, scene};
    const crease_figure_options options[] = {seen_from(-60, 25), seen_from(0, 0), seen_from(0, 90)};
    static const char path[] = "test_figure_panels.png";
    assert_int_equal(crease_figure_panels_write(context, scenes, options, 3, 2, path), CREASE_OK);
    cairo_surface_t *image = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_image_surface_get_width(image), 800);
    assert_int_equal(cairo_image_surface_get_height(image), 600);
    cairo_surface_destroy(image);
    const found f = find(path, is_green);
    assert_true(f.left < 400 && f.right > 400 && f.top < 300 && f.bottom > 300);
    assert_int_equal(
        crease_figure_panels_write(context, scenes, NULL, 0, 2, path), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_figure_panels_write(context, scenes, NULL, 3, 0, path), CREASE_ERROR_ARGUMENT);
    unlink(path);
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_titles_from_outside_then_they_are_drawn_safely(void **state)
{
    char *longest = calloc(1, 200001);
    memset(longest, 'W', 200000);
    const char *const titles[] = {"\xFF\xC3", "a\nb", "</svg><script>", longest, "%s%n"};
    const double points[] = {0, 0, 0};
    crease_context *context = given_context();
    for (size_t i = 0; i < sizeof titles / sizeof *titles; i++) {
        crease_cloud *cloud = given_cloud_of(context, points, 1);
        crease_scene *scene = NULL;
        assert_int_equal(crease_scene_create(context, titles[i], &scene), CREASE_OK);
        assert_int_equal(crease_scene_add_cloud(context, scene, titles[i], cloud), CREASE_OK);
        const crease_figure_options options = seen_from(0, 0);
        const char path[] = "test_figure_title.svg";
        assert_int_equal(crease_figure_write(context, scene, &options, path), CREASE_OK);
        size_t size = 0;
        char *svg = read_file(path, &size);
        assert_null(strstr(svg, "<script"));
        free(svg);
        unlink(path);
        crease_scene_free(scene);
        crease_cloud_free(cloud);
    }
    crease_context_free(context);
    free(longest);
}

/* -------------------------------------------------------------------------------------- errors --
 */

static void assert_refused(crease_status expected, const char *word, const crease_scene *scene,
    crease_context *context, const crease_figure_options *options, const char *path)
{
    assert_int_equal(crease_figure_write(context, scene, options, path), expected);
    if (!strstr(crease_context_message(context), word))
        fail_msg("'%s' lacks '%s'", crease_context_message(context), word);
    assert_int_not_equal(access(path, F_OK), 0);
}

static void given_what_cannot_be_drawn_then_the_message_says_why(void **state)
{
    crease_context *context = given_context();
    crease_scene *scene = given_everything(context), *empty = NULL;
    assert_int_equal(crease_scene_create(context, "", &empty), CREASE_OK);
    crease_figure_options options = crease_figure_options_default();
    assert_refused(CREASE_ERROR_ARGUMENT, "nothing", empty, context, NULL, "test_none.png");
    assert_refused(CREASE_ERROR_ARGUMENT, "png", scene, context, NULL, "test_none.gif");
    assert_refused(
        CREASE_ERROR_CANNOT_WRITE, "no_such", scene, context, NULL, "no_such_folder/test.png");
    options.colour_by = "height";
    assert_refused(CREASE_ERROR_ARGUMENT, "variance", scene, context, &options, "test_none.png");
    options = crease_figure_options_default();
    options.width = 5;
    assert_refused(CREASE_ERROR_ARGUMENT, "5 x 900", scene, context, &options, "test_none.png");
    options = crease_figure_options_default();
    options.elevation = 91;
    assert_refused(CREASE_ERROR_ARGUMENT, "elevation", scene, context, &options, "test_none.png");
    options.elevation = NAN;
    assert_refused(CREASE_ERROR_ARGUMENT, "elevation", scene, context, &options, "test_none.png");
    assert_int_equal(
        crease_scene_add_surfaces(context, scene, "none", NULL, 0, true), CREASE_ERROR_ARGUMENT);
    assert_int_equal(
        crease_scene_add_curves(context, scene, "none", NULL, 0), CREASE_ERROR_ARGUMENT);
    crease_scene_free(scene);
    crease_scene_free(empty);
    crease_scene_free(NULL);
    crease_context_free(context);
}

static int stop(void *user)
{
    return 1;
}

static void given_a_caller_who_stops_then_there_is_no_figure(void **state)
{
    crease_context_options options = crease_context_options_default();
    crease_context *building = given_context(), *context = NULL;
    crease_scene *scene = given_everything(building);
    options.cancelled = stop;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    assert_int_equal(crease_figure_write(context, scene, NULL, "test_figure_stopped.png"),
        CREASE_ERROR_CANCELLED);
    assert_int_not_equal(access("test_figure_stopped.png", F_OK), 0);
    crease_scene_free(scene);
    crease_context_free(context);
    crease_context_free(building);
}

static void given_any_allocation_that_fails_then_no_file_and_no_leak(void **state)
{
    static const char *const paths[] = {"test_figure_memory.png", "test_figure_memory.svg"};
    crease_context *context = given_context();
    crease_scene *scene = given_everything(context);
    crease_figure_options options = seen_from(-60, 25);
    options.colour_by = "variance";
    for (int i = 0; i < 2; i++) {
        crease_status status = CREASE_ERROR_NO_MEMORY;
        for (long n = 0; status != CREASE_OK; n++) {
            crease_context_fail_allocation(context, n);
            status = crease_figure_write(context, scene, &options, paths[i]);
            crease_context_fail_allocation(context, -1);
            assert_true(status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY);
            assert_int_equal(access(paths[i], F_OK) == 0, status == CREASE_OK);
            assert_true(n < 200);
        }
        unlink(paths[i]);
    }
    crease_scene_free(scene);
    crease_context_free(context);
}

static void given_any_allocation_that_fails_then_the_scene_stays_as_it_was(void **state)
{
    crease_context *context = given_context();
    crease_surface *square = given_square(context);
    crease_scene *scene = NULL;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    for (long n = 0; status != CREASE_OK; n++) {
        crease_context_fail_allocation(context, n);
        status = crease_scene_create(context, "title", &scene);
        assert_int_equal(scene != NULL, status == CREASE_OK);
    }
    status = CREASE_ERROR_NO_MEMORY;
    for (long n = 0; status != CREASE_OK; n++) {
        assert_int_equal(scene->layer_count, 0);
        crease_context_fail_allocation(context, n);
        status = crease_scene_add_surfaces(
            context, scene, "surface", (const crease_surface *const *)&square, 1, true);
        assert_true(n < 500);
    }
    assert_int_equal(scene->layer_count, 2);
    assert_int_equal(scene->layers[1].kind, CREASE_LAYER_NET);
    assert_int_equal(scene->layers[1].lines.node_count, 4);
    assert_int_equal(scene->layers[1].lines.link_count, 4);
    crease_scene_free(scene);
    crease_surface_free(square);
    crease_context_free(context);
}

/* Fontconfig keeps one block of its configuration for good; the leak checker is told so. */
CREASE_API const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

/* Gives back what cairo keeps for later drawings. */
static int forget_fonts(void **state)
{
    cairo_debug_reset_static_data();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_points_seen_from_the_front_then_they_lie_where_they_should),
        cmocka_unit_test(given_a_point_before_or_behind_a_surface_then_it_is_seen_or_hidden),
        cmocka_unit_test(given_a_large_cloud_then_a_surface_hides_its_points_too),
        cmocka_unit_test(given_a_large_cloud_with_a_step_then_its_lower_side_is_darker_there),
        cmocka_unit_test(given_a_crease_behind_a_surface_then_only_its_free_part_is_dark),
        cmocka_unit_test(given_a_surface_then_it_is_shaded_without_holes),
        cmocka_unit_test(given_a_field_then_its_values_colour_the_points),
        cmocka_unit_test(given_any_view_and_any_extent_then_there_is_a_figure),
        cmocka_unit_test(given_the_same_scene_then_every_format_has_the_same_bytes),
        cmocka_unit_test(given_several_scenes_then_they_are_panels_of_one_figure),
        cmocka_unit_test(given_titles_from_outside_then_they_are_drawn_safely),
        cmocka_unit_test(given_what_cannot_be_drawn_then_the_message_says_why),
        cmocka_unit_test(given_a_caller_who_stops_then_there_is_no_figure),
        cmocka_unit_test(given_any_allocation_that_fails_then_no_file_and_no_leak),
        cmocka_unit_test(given_any_allocation_that_fails_then_the_scene_stays_as_it_was),
    };
    return cmocka_run_group_tests(tests, NULL, forget_fonts);
}
