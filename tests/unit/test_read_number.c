/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "given.h"

#include "base/random.h"
#include "read/number.h"

#include <inttypes.h>

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* The tests run in the C locale, where strtod is the reference. */
static void check(const char *text)
{
    double value = 0;
    const char *end = text + strlen(text);
    const char *after = crease_number_parse(text, end, false, &value);
    if (after != end)
        fail_msg("'%s' is not read to its end", text);
    const double expected = strtod(text, NULL);
    if (bits_of(value) != bits_of(expected))
        fail_msg("'%s' reads as %.17g, expected %.17g", text, value, expected);
}

static uint64_t draw64(uint64_t stream, uint64_t i)
{
    uint32_t out[4];
    crease_random_block(11, stream, i, out);
    return (uint64_t)out[0] << 32 | out[1];
}

static double draw_any_double(uint64_t i)
{
    const uint64_t bits = draw64(1, i);
    double value;
    memcpy(&value, &bits, sizeof value);
    return isfinite(value) ? value : 1.5;
}

static void given_random_doubles_then_17_and_15_digits_read_as_strtod_reads_them(void **state)
{
    char text[64];
    for (uint64_t i = 0; i < 100000; i++) {
        const double value = draw_any_double(i);
        snprintf(text, sizeof text, "%.17g", value);
        check(text);
        snprintf(text, sizeof text, "%.15g", value);
        check(text);
    }
}

static void given_a_million_numbers_of_usual_size_then_they_read_as_strtod_reads_them(void **state)
{
    char text[64];
    for (uint64_t i = 0; i < 1000000; i++) {
        const uint64_t draw = draw64(2, i);
        const double value = ((double)(int64_t)draw64(3, i)) * 1e-19 * (double)(1 + draw % 1000);
        snprintf(text, sizeof text, "%.*f", (int)((draw >> 32) % 18), value);
        check(text);
    }
}

static void given_digits_and_exponents_at_random_then_they_read_as_strtod_reads_them(void **state)
{
    char text[128];
    for (uint64_t i = 0; i < 60000; i++) {
        const uint64_t draw = draw64(4, i);
        const int length = snprintf(text, sizeof text, "%s%" PRIu64 ".%0*" PRIu64,
            draw & 1 ? "-" : "", draw64(5, i) >> (draw % 64), (int)((draw >> 8) % 40),
            draw64(6, i) >> (draw >> 16) % 64);
        if (draw & 2)
            snprintf(text + length, sizeof text - (size_t)length, "e%d",
                (int)((draw >> 24) % 680) - 345);
        check(text);
    }
}

/* The exact middle between two doubles: m + 1/2 times 2^e has few digits for small e. */
static void given_halfway_cases_then_ties_go_to_even(void **state)
{
    char text[1200];
    for (uint64_t i = 0; i < 20000; i++) {
        const uint64_t mantissa = draw64(7, i) >> 11 | UINT64_C(1) << 52;
        const int exponent = (int)(draw64(8, i) % 8);
        snprintf(text, sizeof text, "%" PRIu64 "%s", mantissa, i % 3 == 0 ? ".5" : ".50");
        if (i % 3 == 1)
            strcat(text, "000000000000000000000000000000000000000000000000001");
        if (i % 3 == 2)
            snprintf(text, sizeof text, "%" PRIu64 ".4999999999999999999999999999", mantissa);
        check(text);
        snprintf(
            text, sizeof text, "%" PRIu64 "e0", (mantissa >> 9 << 10 | UINT64_C(1) << 9) + i % 2);
        check(text);
        snprintf(text, sizeof text, "%.60f", ldexp((double)mantissa, -53 - exponent));
        check(text);
    }
}

static void given_the_borders_of_double_then_the_right_side_is_taken(void **state)
{
    static const char *const texts[] = {"0", "-0", "0.0", "-0e999", "1e400", "-1e400", "1e-400",
        "1e999999999999999999999", "1e-999999999999999999999", "0e999999999999999999",
        "1.7976931348623157e308", "1.7976931348623158e308", "1.7976931348623159e308",
        "179769313486231580793e289", "4.9406564584124654e-324", "2.4703282292062327e-324",
        "2.4703282292062328e-324", "2.2250738585072011e-308", "2.2250738585072014e-308",
        "2.2250738585072012e-308", "9007199254740993", "9007199254740992.9999999999999999999",
        "1e22", "1e23", "1e27", "1e28", "123456789012345678e27", "1234567890123456789e-27",
        "18446744073709551615", "18446744073709551616", "5.", ".5", "+.5e-1",
        "00000000000000000012", "0.000000000000000000000000000000000000001", "1E5", "1e+5"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++)
        check(texts[i]);
}

/* 2^-1074 + 2^-1075 to its last digit needs 767 digits; one more digit breaks the tie. */
static void given_more_digits_than_decide_then_they_still_decide(void **state)
{
    char text[3000];
    for (int e = 1000; e <= 1074; e += 37) {
        snprintf(text, sizeof text, "%.1100f", ldexp(1.0, -e));
        check(text);
        memset(text, '0', sizeof text);
        memcpy(text, "0.", 2);
        const int length = snprintf(text + 2, sizeof text - 2, "5%0*d", 2000, 1);
        assert_true(length > 1900);
        check(text);
    }
    snprintf(text, sizeof text, "9007199254740993.%02000d", 0);
    check(text);
    snprintf(text, sizeof text, "9007199254740993.%02000d", 1);
    check(text);
    memset(text, '7', 2999);
    text[2999] = '\0';
    check(text);
}

static double parse(const char *text, size_t *used)
{
    double value = 42;
    const char *after = crease_number_parse(text, text + strlen(text), false, &value);
    *used = after ? (size_t)(after - text) : 0;
    return value;
}

static void given_values_that_are_not_finite_then_every_spelling_is_known(void **state)
{
    static const char *const nans[] = {"nan", "NaN", "-nan", "NAN(ind)", "-nan(ind)", "1.#QNAN",
        "1.#IND", "-1.#IND000", "1.#SNAN"};
    static const char *const infinities[] = {"inf", "-Inf", "INFINITY", "-infinity", "1.#INF"};
    size_t used = 0;
    for (size_t i = 0; i < sizeof nans / sizeof nans[0]; i++) {
        assert_true(isnan(parse(nans[i], &used)));
        assert_int_equal(used, strlen(nans[i]));
    }
    for (size_t i = 0; i < sizeof infinities / sizeof infinities[0]; i++) {
        const double value = parse(infinities[i], &used);
        assert_true(isinf(value) && (value < 0) == (infinities[i][0] == '-'));
        assert_int_equal(used, strlen(infinities[i]));
    }
}

static void given_no_number_then_none_is_read(void **state)
{
    static const char *const texts[] = {"", "-", "+", ".", "-.", "e5", "x", "--1", "in", "na", ","};
    size_t used = 1;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        parse(texts[i], &used);
        assert_int_equal(used, 0);
    }
    parse("1e", &used);
    assert_int_equal(used, 1);
    parse("1e+x", &used);
    assert_int_equal(used, 1);
    parse("0x10", &used);
    assert_int_equal(used, 1);
    parse("1,5", &used);
    assert_int_equal(used, 1);
}

static void given_a_decimal_comma_then_it_is_read_where_it_is_allowed(void **state)
{
    const char *text = "-12,5;";
    double value = 0;
    assert_ptr_equal(crease_number_parse(text, text + 6, true, &value), text + 5);
    assert_near(value, -12.5, 0);
}

static void given_an_end_inside_a_number_then_nothing_behind_it_is_read(void **state)
{
    const char *text = "123456789012345678901234567890e55";
    for (size_t length = 1; length <= strlen(text); length++) {
        char *copy = malloc(length);
        assert_non_null(copy);
        memcpy(copy, text, length);
        double value = 0;
        const char *after = crease_number_parse(copy, copy + length, false, &value);
        assert_true(after > copy && after <= copy + length);
        free(copy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(given_random_doubles_then_17_and_15_digits_read_as_strtod_reads_them),
        cmocka_unit_test(given_a_million_numbers_of_usual_size_then_they_read_as_strtod_reads_them),
        cmocka_unit_test(given_digits_and_exponents_at_random_then_they_read_as_strtod_reads_them),
        cmocka_unit_test(given_halfway_cases_then_ties_go_to_even),
        cmocka_unit_test(given_the_borders_of_double_then_the_right_side_is_taken),
        cmocka_unit_test(given_more_digits_than_decide_then_they_still_decide),
        cmocka_unit_test(given_values_that_are_not_finite_then_every_spelling_is_known),
        cmocka_unit_test(given_no_number_then_none_is_read),
        cmocka_unit_test(given_a_decimal_comma_then_it_is_read_where_it_is_allowed),
        cmocka_unit_test(given_an_end_inside_a_number_then_nothing_behind_it_is_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
