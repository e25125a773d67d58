/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "write/decimal.h"

#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DECIMALS = 9 };

static const double ten_to[MOST_DECIMALS + 1] = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

static bool reads_back(double read, double value, bool single)
{
    return single ? (float)read == (float)value : read == value;
}

static size_t print_scaled(int64_t scaled, int decimals, bool negative, char *out)
{
    char digits[24];
    const int count = snprintf(digits, sizeof digits, "%0*" PRId64, decimals + 1, scaled);
    const size_t whole = (size_t)(count - decimals);
    size_t length = 0;
    if (negative)
        out[length++] = '-';
    memcpy(out + length, digits, whole);
    length += whole;
    if (decimals) {
        out[length++] = '.';
        memcpy(out + length, digits + whole, (size_t)decimals);
        length += (size_t)decimals;
    }
    out[length] = '\0';
    return length;
}

/* Few decimals, as measured numbers mostly have: with an integer below 2^53 over a power of ten
 * below 10^22 the division rounds as a correct reader does. Returns 0 when that is not enough.
 * Based on: Clinger. How to read floating point numbers accurately. 1990. */
static size_t print_short(double value, bool single, char *out)
{
    const double size = fabs(value);
    for (int decimals = 0; decimals <= MOST_DECIMALS; decimals++) {
        const double scaled = rint(size * ten_to[decimals]);
        if (!(scaled < 9007199254740992.0))
            return 0;
        if (reads_back(scaled / ten_to[decimals], size, single))
            return print_scaled((int64_t)scaled, decimals, signbit(value) != 0, out);
    }
    return 0;
}

/* Copies a number printed by the C library, its decimal point (any bytes) made a point. */
static size_t copy_with_point(const char *from, char *out)
{
    size_t length = 0;
    for (; *from; from++) {
        const bool plain = (*from >= '0' && *from <= '9') || strchr("+-e", *from);
        if (plain)
            out[length++] = *from;
        else if (length && out[length - 1] != '.')
            out[length++] = '.';
    }
    out[length] = '\0';
    return length;
}

static size_t print(double value, bool single, char *out)
{
    if (!isfinite(value))
        return (size_t)snprintf(
            out, CREASE_DECIMAL_SIZE, "%s", isnan(value) ? "nan" : (value > 0 ? "inf" : "-inf"));
    if (value == 0.0 || fabs(value) >= 1e-4) {
        const size_t length = print_short(value, single, out);
        if (length)
            return length;
    }
    char text[CREASE_DECIMAL_SIZE];
    const int most = single ? 9 : 17;
    for (int digits = single ? 6 : 15; digits <= most; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (reads_back(strtod(text, NULL), value, single))
            break;
    }
    return copy_with_point(text, out);
}

size_t crease_decimal_print(double value, char out[CREASE_DECIMAL_SIZE])
{
    return print(value, false, out);
}

size_t crease_decimal_print_float(float value, char out[CREASE_DECIMAL_SIZE])
{
    return print((double)value, true, out);
}
