/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The parts of a figure: colours, ticks, camera, text, identifiers. */
#include "given.h"

#include "view/camera.h"
#include "view/colour.h"
#include "view/numbering.h"
#include "view/text.h"
#include "view/ticks.h"

#include <locale.h>
#include <unistd.h>

/* Lightness as the eye sees it (CIE 1976 L*, 0..100), found from the screen's values by a way of
 * its own. */
static double lightness_of(crease_colour c)
{
    const double encoded[3] = {c.red, c.green, c.blue};
    const double weights[3] = {0.2126, 0.7152, 0.0722};
    double y = 0;
    for (int i = 0; i < 3; i++)
        y += weights[i] *
            (encoded[i] <= 0.04045 ? encoded[i] / 12.92 : pow((encoded[i] + 0.055) / 1.055, 2.4));
    return y > 0.008856 ? 116 * cbrt(y) - 16 : 903.3 * y;
}

static void given_the_sequential_map_then_lightness_rises_evenly(void **state)
{
    double last = lightness_of(crease_map_at(CREASE_MAP_SEQUENTIAL, 0));
    const double all = lightness_of(crease_map_at(CREASE_MAP_SEQUENTIAL, 1)) - last;
    assert_true(all > 60);
    for (int i = 1; i <= 20; i++) {
        const double now = lightness_of(crease_map_at(CREASE_MAP_SEQUENTIAL, i / 20.0));
        assert_true(now - last > 0.5 * all / 20);
        assert_true(now - last < 1.6 * all / 20);
        last = now;
    }
}

static void given_the_diverging_map_then_its_middle_is_white_and_its_sides_mirror(void **state)
{
    const crease_colour middle = crease_map_at(CREASE_MAP_DIVERGING, 0.5);
    assert_true(fmin(middle.red, fmin(middle.green, middle.blue)) > 0.92);
    const crease_colour low = crease_map_at(CREASE_MAP_DIVERGING, 0.02);
    const crease_colour high = crease_map_at(CREASE_MAP_DIVERGING, 0.98);
    assert_true(low.blue > low.red + 0.4);
    assert_true(high.red > high.blue + 0.4);
    for (int i = 0; i <= 10; i++)
        assert_near(lightness_of(crease_map_at(CREASE_MAP_DIVERGING, 0.5 - i / 20.0)),
            lightness_of(crease_map_at(CREASE_MAP_DIVERGING, 0.5 + i / 20.0)), 8);
}

static void given_any_lightness_chroma_and_hue_then_the_colour_can_be_shown(void **state)
{
    for (int hue = 0; hue < 360; hue += 15)
        for (int l = 0; l <= 10; l++) {
            const crease_colour c = crease_colour_of_lch(l / 10.0, 0.4, hue);
            assert_true(c.red >= 0 && c.red <= 1);
            assert_true(c.green >= 0 && c.green <= 1);
            assert_true(c.blue >= 0 && c.blue <= 1);
        }
    const crease_colour grey = crease_colour_of_lch(0.6, 0, 77);
    assert_near(grey.red, grey.green, 1e-3);
    assert_near(grey.red, grey.blue, 1e-3);
    assert_near(crease_colour_of_lch(1, 0, 0).red, 1, 1e-3);
}

static crease_range range_of(const double *values, size_t count)
{
    crease_context *context = given_context();
    const crease_field field = {"value", CREASE_TYPE_FLOAT64, values};
    crease_range range;
    assert_int_equal(crease_range_of_field(context, &field, count, &range), CREASE_OK);
    crease_context_free(context);
    return range;
}

static void given_values_of_one_sign_then_the_range_is_theirs_and_sequential(void **state)
{
    const double values[] = {3, NAN, 0.5, 2, INFINITY};
    const crease_range range = range_of(values, 5);
    assert_near(range.lowest, 0.5, 0);
    assert_near(range.highest, 3, 0);
    assert_int_equal(range.map, CREASE_MAP_SEQUENTIAL);
    assert_false(range.below || range.above);
    const crease_colour none = crease_range_colour(&range, NAN);
    assert_true(none.red == none.green && none.green == none.blue);
}

static void given_values_of_both_signs_then_the_range_is_even_about_zero(void **state)
{
    const double values[] = {-1, 0.25, 0.5};
    const crease_range range = range_of(values, 3);
    assert_near(range.lowest, -1, 0);
    assert_near(range.highest, 1, 0);
    assert_int_equal(range.map, CREASE_MAP_DIVERGING);
}

static void given_a_few_far_values_then_the_range_leaves_them_out_and_says_so(void **state)
{
    double values[1000];
    for (int i = 0; i < 1000; i++)
        values[i] = 1 + i / 1000.0;
    values[500] = 1e6;
    const crease_range range = range_of(values, 1000);
    assert_true(range.highest < 2);
    assert_true(range.above);
    assert_true(range.below);
}

static void given_equal_or_no_values_then_the_range_is_still_a_range(void **state)
{
    const double same[] = {7, 7, 7};
    const crease_range range = range_of(same, 3);
    assert_true(range.highest > range.lowest);
    const crease_range empty = range_of(same, 0);
    assert_true(empty.highest > empty.lowest);
}

static void given_no_memory_then_no_range(void **state)
{
    crease_context *context = given_context();
    const double values[] = {1, 2};
    const crease_field field = {"value", CREASE_TYPE_FLOAT64, values};
    crease_range range;
    crease_context_fail_allocation(context, 0);
    assert_int_equal(crease_range_of_field(context, &field, 2, &range), CREASE_ERROR_NO_MEMORY);
    crease_context_free(context);
}

static void given_an_interval_then_ticks_are_round_and_inside(void **state)
{
    const crease_ticks ticks = crease_ticks_between(-0.5, 0.5, 5);
    assert_int_equal(ticks.count, 5);
    assert_near(ticks.values[0], -0.4, 1e-15);
    assert_string_equal(ticks.labels[0],
        "\xE2\x88\x92"
        "0.4");
    assert_string_equal(ticks.labels[2], "0.0");
    assert_string_equal(ticks.note, "");
    assert_int_equal(crease_ticks_between(1, 1, 5).count, 0);
    assert_int_equal(crease_ticks_between(NAN, 1, 5).count, 0);
}

static void given_intervals_of_any_size_then_ticks_are_few_and_differ(void **state)
{
    for (int power = -12; power <= 12; power++)
        for (int wanted = 2; wanted <= 10; wanted++) {
            const double size = 1.7 * pow(10, power);
            const crease_ticks ticks = crease_ticks_between(3 * size, 4 * size, wanted);
            assert_in_range(ticks.count, 1, CREASE_TICKS_MOST);
            for (int i = 1; i < ticks.count; i++)
                assert_string_not_equal(ticks.labels[i - 1], ticks.labels[i]);
        }
}

static void given_coordinates_far_from_the_origin_then_the_note_tells_the_offset(void **state)
{
    const crease_ticks ticks = crease_ticks_between(500000.1, 500000.9, 4);
    assert_near(ticks.offset, 500000, 1e-6);
    assert_string_equal(ticks.labels[0], "0.2");
    assert_string_equal(ticks.note, " \xE2\x88\x92 500000");
}

static void given_small_values_then_they_are_shown_as_multiples_of_a_power(void **state)
{
    const crease_ticks ticks = crease_ticks_between(0, 4e-4, 4);
    assert_int_equal(ticks.power, -6);
    assert_string_equal(ticks.labels[1], "100");
    assert_string_equal(ticks.note, " / 10");
}

static void given_a_locale_with_commas_then_numbers_keep_their_point(void **state)
{
    char number[CREASE_TICK_SIZE];
    setlocale(LC_ALL, "de_DE.UTF-8");
    crease_tick_print(-1234.0625, 3, number);
    setlocale(LC_ALL, "C");
    assert_string_equal(number,
        "\xE2\x88\x92"
        "1234.063");
    crease_tick_print(-0.0001, 2, number);
    assert_string_equal(number, "0.00");
}

static void given_a_camera_in_front_then_x_goes_right_z_up_and_y_away(void **state)
{
    const double centre[3] = {1, 2, 3};
    crease_camera camera = crease_camera_at(-90, 0, centre);
    camera.scale = 10;
    camera.x = 100;
    camera.y = 200;
    const double place[3] = {2, 4, 6};
    const crease_spot spot = crease_camera_project(&camera, place);
    assert_near(spot.x, 110, 1e-12);
    assert_near(spot.y, 170, 1e-12);
    assert_near(spot.depth, 20, 1e-12);
}

static void given_any_camera_then_lengths_are_kept(void **state)
{
    const double centre[3] = {0.3, -0.2, 0.9};
    for (int i = 0; i < 50; i++) {
        const crease_camera camera = crease_camera_at(37 * i, 180.0 * i / 49 - 90, centre);
        const double place[3] = {1.3, 1.8, 2.9};
        const crease_spot spot = crease_camera_project(&camera, place);
        assert_near(spot.x * spot.x + spot.y * spot.y + spot.depth * spot.depth, 9, 1e-12);
    }
}

static void assert_cleaned(const char *text, const char *expected)
{
    crease_context *context = given_context();
    char *clean = crease_text_clean(context, text);
    assert_string_equal(clean, expected);
    free(clean);
    crease_context_free(context);
}

static void given_text_from_outside_then_what_is_left_is_printable_utf8(void **state)
{
    assert_cleaned(NULL, "");
    assert_cleaned("plain </script> & text", "plain </script> & text");
    assert_cleaned("a\nb\tc\x7F", "a b c ");
    assert_cleaned(
        "\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x99\x82", "\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x99\x82");
    assert_cleaned("\xFFz", "\xEF\xBF\xBDz");
    assert_cleaned("\xC3", "\xEF\xBF\xBD");
    assert_cleaned("\xC0\x80", "\xEF\xBF\xBD\xEF\xBF\xBD");
    assert_cleaned("\xED\xA0\x80", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
    assert_cleaned("a\xE2\x80\xA8z", "a z");
}

/* What crease_numbering_write makes of a text. */
static void number(const char *text, char *out, size_t size)
{
    const char path[] = "test_view_numbering.svg";
    crease_context *context = given_context();
    crease_output *output = NULL;
    assert_int_equal(crease_output_open(context, path, &output), CREASE_OK);
    crease_numbering_write(output, text, strlen(text));
    assert_int_equal(crease_output_close(context, output, CREASE_OK), CREASE_OK);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    out[fread(out, 1, size - 1, file)] = 0;
    fclose(file);
    unlink(path);
    crease_context_free(context);
}

static void given_the_counters_of_a_process_then_identifiers_start_again_at_one(void **state)
{
    char out[200];
    number("<g id=\"surface163\"/><image id=\"image9\"/><use xlink:href=\"#image9\"/>", out, 200);
    assert_string_equal(
        out, "<g id=\"surface1\"/><image id=\"image2\"/><use xlink:href=\"#image2\"/>");
    number("<g id=\"glyph0-1\"/> #surface i #", out, 200);
    assert_string_equal(out, "<g id=\"glyph0-1\"/> #surface i #");
    number("", out, 200);
    assert_string_equal(out, "");
    number("#image7", out, 200);
    assert_string_equal(out, "#image1");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_the_sequential_map_then_lightness_rises_evenly),
        cmocka_unit_test(given_the_diverging_map_then_its_middle_is_white_and_its_sides_mirror),
        cmocka_unit_test(given_any_lightness_chroma_and_hue_then_the_colour_can_be_shown),
        cmocka_unit_test(given_values_of_one_sign_then_the_range_is_theirs_and_sequential),
        cmocka_unit_test(given_values_of_both_signs_then_the_range_is_even_about_zero),
        cmocka_unit_test(given_a_few_far_values_then_the_range_leaves_them_out_and_says_so),
        cmocka_unit_test(given_equal_or_no_values_then_the_range_is_still_a_range),
        cmocka_unit_test(given_no_memory_then_no_range),
        cmocka_unit_test(given_an_interval_then_ticks_are_round_and_inside),
        cmocka_unit_test(given_intervals_of_any_size_then_ticks_are_few_and_differ),
        cmocka_unit_test(given_coordinates_far_from_the_origin_then_the_note_tells_the_offset),
        cmocka_unit_test(given_small_values_then_they_are_shown_as_multiples_of_a_power),
        cmocka_unit_test(given_a_locale_with_commas_then_numbers_keep_their_point),
        cmocka_unit_test(given_a_camera_in_front_then_x_goes_right_z_up_and_y_away),
        cmocka_unit_test(given_any_camera_then_lengths_are_kept),
        cmocka_unit_test(given_text_from_outside_then_what_is_left_is_printable_utf8),
        cmocka_unit_test(given_the_counters_of_a_process_then_identifiers_start_again_at_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
