/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Three ways to the same correctly rounded double, the quickest that is exact:
 *  1. digits below 2^53 and a power of ten up to 10^22: both are doubles, one operation rounds once
 *     (Based on: Clinger. How to read floating point numbers accurately. 1990.);
 *  2. up to 19 digits and a power of ten up to 10^27: a product or quotient of 128 bits with a
 *     sticky bit for what is left over;
 *  3. everything else: long division of big integers. */
#include "read/number.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;

enum {
    MOST_QUICK_DIGITS = 19,
    MOST_FIVES = 27,     /* 5^27 is the last that fits 64 bits */
    MOST_DIGITS = 800,   /* 767 digits decide every tie; the rest counts as "a little more" */
    MOST_EXPONENT = 310, /* 10^310 is infinite */
    LEAST_EXPONENT = -345,
    BIG_WORDS = 192
};

static const uint64_t fives[MOST_FIVES + 1] = {1, 5, 25, 125, 625, 3125, 15625, 78125, 390625,
    1953125, 9765625, 48828125, 244140625, 1220703125, 6103515625, 30517578125, 152587890625,
    762939453125, 3814697265625, 19073486328125, 95367431640625, 476837158203125, 2384185791015625,
    11920928955078125, 59604644775390625, 298023223876953125, 1490116119384765625,
    7450580596923828125};

/* The double nearest to mantissa * 2^exponent, plus a little when sticky. The top bit of the
 * mantissa is set. */
static double rounded(uint64_t mantissa, int exponent, bool sticky)
{
    const int biased = exponent + 63 + 1023;
    const int dropped = biased >= 1 ? 11 : 12 - biased;
    if (dropped > 64)
        return 0.0;
    uint64_t bits = dropped < 64 ? mantissa >> dropped : 0;
    const uint64_t rest = dropped < 64 ? mantissa << (64 - dropped) : mantissa;
    const uint64_t half = UINT64_C(1) << 63;
    bits += rest > half || (rest == half && (sticky || (bits & 1)));
    bits += (uint64_t)(biased >= 1 ? biased - 1 : 0) << 52;
    if (biased > 2046 || bits >= UINT64_C(0x7ff) << 52)
        return INFINITY;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static double from_product(uint64_t digits, int exponent)
{
    wide product = (wide)digits * fives[exponent];
    int shift = 0;
    while (!(product >> 127)) {
        const uint64_t top = (uint64_t)(product >> 64);
        const int step = top ? __builtin_clzll(top) : 64;
        product <<= step;
        shift += step;
    }
    return rounded((uint64_t)(product >> 64), 64 - shift + exponent, (uint64_t)product != 0);
}

static double from_quotient(uint64_t digits, int exponent)
{
    const int up = __builtin_clzll(digits);
    const int down = __builtin_clzll(fives[-exponent]);
    const wide numerator = (wide)(digits << up) << 63;
    const uint64_t denominator = fives[-exponent] << down;
    const uint64_t quotient = (uint64_t)(numerator / denominator);
    const bool sticky = (wide)quotient * denominator != numerator;
    const int shift = __builtin_clzll(quotient);
    return rounded(quotient << shift, -63 + down - up + exponent - shift, sticky);
}

/* At most 19 digits and a power of ten within 10^27. */
static double from_digits(uint64_t digits, int exponent)
{
    static const double tens[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11,
        1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (digits == 0)
        return 0.0;
    if (digits <= UINT64_C(1) << 53 && exponent >= -22 && exponent <= 22)
        return exponent < 0 ? (double)digits / tens[-exponent] : (double)digits * tens[exponent];
    return exponent < 0 ? from_quotient(digits, exponent) : from_product(digits, exponent);
}

/* ----------------------------------------------------------------------------- big integers -- */

typedef struct big {
    uint32_t words[BIG_WORDS]; /* lowest first; zero above count */
    int count;
} big;

static void big_multiply_add(big *number, uint32_t factor, uint32_t summand)
{
    uint64_t carry = summand;
    for (int i = 0; i < number->count; i++) {
        carry += (uint64_t)number->words[i] * factor;
        number->words[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry)
        number->words[number->count++] = (uint32_t)carry;
}

static void big_multiply_by_fives(big *number, int exponent)
{
    for (; exponent >= 13; exponent -= 13)
        big_multiply_add(number, (uint32_t)fives[13], 0);
    big_multiply_add(number, (uint32_t)fives[exponent], 0);
}

static int big_length(const big *number)
{
    return 32 * number->count - __builtin_clz(number->words[number->count - 1]);
}

static void big_shift(big *number, int bits)
{
    const int whole = bits / 32, part = bits % 32;
    for (int i = number->count; i >= 0; i--) {
        const uint64_t upper = i < number->count ? number->words[i] : 0;
        const uint64_t lower = i ? number->words[i - 1] : 0;
        number->words[i + whole] = (uint32_t)(((upper << 32 | lower) << part) >> 32);
    }
    memset(number->words, 0, (size_t)whole * sizeof number->words[0]);
    number->count += whole + 1;
    while (number->count && !number->words[number->count - 1])
        number->count--;
}

static bool big_less(const big *a, const big *b)
{
    if (a->count != b->count)
        return a->count < b->count;
    for (int i = a->count - 1; i >= 0; i--)
        if (a->words[i] != b->words[i])
            return a->words[i] < b->words[i];
    return false;
}

static void big_subtract(big *a, const big *b)
{
    int64_t borrow = 0;
    for (int i = 0; i < a->count; i++) {
        borrow += (int64_t)a->words[i] - (i < b->count ? b->words[i] : 0);
        a->words[i] = (uint32_t)borrow;
        borrow >>= 32;
    }
    while (a->count && !a->words[a->count - 1])
        a->count--;
}

/* The digits as an integer; the power of ten of the last digit taken is added to *exponent. Digits
 * beyond MOST_DIGITS only say that there is a little more: a last digit 1. */
static big big_from_text(const char *text, const char *end, int64_t *exponent)
{
    big number = {.count = 0};
    int digits = 0;
    bool fraction = false, more = false;
    for (; text < end; text++) {
        if (*text < '0' || *text > '9') {
            fraction = true;
            continue;
        }
        *exponent -= fraction;
        if (digits < MOST_DIGITS) {
            big_multiply_add(&number, 10, (uint32_t)(*text - '0'));
            digits += number.count > 0;
        } else {
            more = more || *text != '0';
            *exponent += 1;
        }
    }
    if (more) {
        big_multiply_add(&number, 10, 1);
        *exponent -= 1;
    }
    return number;
}

/* numerator / denominator * 2^exponent by long division in base 2. */
static double big_divide(big *numerator, big *denominator, int exponent)
{
    const int shift = big_length(numerator) - big_length(denominator);
    if (shift >= 0)
        big_shift(denominator, shift);
    else
        big_shift(numerator, -shift);
    uint64_t quotient = 0;
    int scale = shift + exponent + 1;
    while (!(quotient >> 63)) {
        const bool one = !big_less(numerator, denominator);
        if (one)
            big_subtract(numerator, denominator);
        quotient = quotient << 1 | one;
        big_shift(numerator, 1);
        scale--;
    }
    return rounded(quotient, scale, numerator->count > 0);
}

/* The digits text..end, with a decimal point somewhere, times 10^exponent. */
static double from_text(const char *text, const char *end, int64_t exponent)
{
    big numerator = big_from_text(text, end, &exponent);
    if (!numerator.count)
        return 0.0;
    const double magnitude = 0.30103 * big_length(&numerator) + (double)exponent;
    if (magnitude > MOST_EXPONENT)
        return INFINITY;
    if (magnitude < LEAST_EXPONENT)
        return 0.0;
    big denominator = {.words = {1}, .count = 1};
    big_multiply_by_fives(
        exponent < 0 ? &denominator : &numerator, (int)(exponent < 0 ? -exponent : exponent));
    return big_divide(&numerator, &denominator, (int)exponent);
}

/* ---------------------------------------------------------------------------------- reading -- */

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Eight digits at once, for processors whose first byte is the lowest.
 * Based on: Lemire. Quickly parsing eight digits. 2018. */
static bool eight_digits(const char *text, uint64_t *digits)
{
    uint64_t block;
    memcpy(&block, text, sizeof block);
    if (((block & UINT64_C(0xf0f0f0f0f0f0f0f0)) |
            (((block + UINT64_C(0x0606060606060606)) & UINT64_C(0xf0f0f0f0f0f0f0f0)) >> 4)) !=
        UINT64_C(0x3333333333333333))
        return false;
    block -= UINT64_C(0x3030303030303030);
    block = block * 10 + (block >> 8);
    block = ((block & UINT64_C(0x000000ff000000ff)) * UINT64_C(0x000f424000000064) +
                ((block >> 16) & UINT64_C(0x000000ff000000ff)) * UINT64_C(0x0000271000000001)) >>
        32;
    *digits = *digits * 100000000 + block;
    return true;
}

/* Appends the digits at text to *digits, modulo 2^64. */
static const char *scan_digits(const char *text, const char *end, uint64_t *digits)
{
    if (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
        while (end - text >= 8 && eight_digits(text, digits))
            text += 8;
    for (; text < end && is_digit(*text); text++)
        *digits = *digits * 10 + (uint64_t)(*text - '0');
    return text;
}

/* Reads the exponent after 'e' when there is one. */
static const char *scan_exponent(const char *text, const char *end, int64_t *exponent)
{
    if (text == end || (*text | 0x20) != 'e')
        return text;
    const char *at = text + 1;
    const bool negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+'))
        at++;
    if (at == end || !is_digit(*at))
        return text;
    int64_t size = 0;
    for (; at < end && is_digit(*at); at++)
        size = size < 1000000000 ? 10 * size + (*at - '0') : size;
    *exponent += negative ? -size : size;
    return at;
}

static const char *match(const char *text, const char *end, const char *word)
{
    for (; *word; word++, text++)
        if (text == end || (*text | 0x20) != *word)
            return NULL;
    return text;
}

/* inf, infinity, nan, nan(...), in any case. */
static const char *scan_name(const char *text, const char *end, double *value)
{
    const char *after = match(text, end, "inf");
    if (after) {
        *value = INFINITY;
        const char *longer = match(after, end, "inity");
        return longer ? longer : after;
    }
    after = match(text, end, "nan");
    if (!after)
        return NULL;
    *value = NAN;
    const char *closing =
        after < end && *after == '(' ? memchr(after, ')', (size_t)(end - after)) : NULL;
    return closing ? closing + 1 : after;
}

/* What some C libraries wrote for values that are not finite: 1.#INF, 1.#QNAN, 1.#IND000. */
static const char *scan_hash(const char *text, const char *end, double *value)
{
    *value = match(text + 1, end, "inf") ? INFINITY : NAN;
    while (++text < end && (is_digit(*text) || ((*text | 0x20) >= 'a' && (*text | 0x20) <= 'z')))
        ;
    return text;
}

static size_t significant(const char *text, const char *end)
{
    size_t digits = 0;
    for (; text < end; text++)
        digits += is_digit(*text) && (digits || *text != '0');
    return digits;
}

static const char *parse_unsigned(const char *text, const char *end, bool comma, double *value)
{
    uint64_t digits = 0;
    const char *at = scan_digits(text, end, &digits);
    int64_t count = at - text;
    int64_t exponent = 0;
    if (at < end && (*at == '.' || (comma && *at == ','))) {
        const char *fraction = at + 1;
        at = scan_digits(fraction, end, &digits);
        exponent = fraction - at;
        count += at - fraction;
        if (at == fraction && at < end && *at == '#')
            return scan_hash(at, end, value);
    }
    if (count == 0)
        return scan_name(text, end, value);
    const char *const last = at;
    const int64_t point = exponent;
    at = scan_exponent(at, end, &exponent);
    const bool quick = count <= MOST_QUICK_DIGITS || significant(text, last) <= MOST_QUICK_DIGITS;
    if (quick && exponent >= -MOST_FIVES && exponent <= MOST_FIVES)
        *value = from_digits(digits, (int)exponent);
    else
        *value = from_text(text, last, exponent - point);
    return at;
}

const char *crease_number_parse(const char *text, const char *end, bool comma, double *value)
{
    const bool negative = text < end && *text == '-';
    if (text < end && (*text == '-' || *text == '+'))
        text++;
    *value = 0.0;
    const char *after = parse_unsigned(text, end, comma, value);
    if (negative)
        *value = -*value;
    return after;
}
