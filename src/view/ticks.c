/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/ticks.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

static const char MINUS[] = "\xE2\x88\x92";

void crease_tick_print(double value, int decimals, char out[CREASE_TICK_SIZE])
{
    int64_t unit = 1;
    for (int i = 0; i < decimals; i++)
        unit *= 10;
    const double scaled = fmin(9e17, fabs(value) * (double)unit);
    const int64_t digits = (int64_t)llround(scaled);
    const char *sign = value < 0 && digits > 0 ? MINUS : "";
    if (decimals == 0)
        snprintf(out, CREASE_TICK_SIZE, "%s%lld", sign, (long long)digits);
    else
        snprintf(out, CREASE_TICK_SIZE, "%s%lld.%0*lld", sign, (long long)(digits / unit), decimals,
            (long long)(digits % unit));
}

/* The smallest of 1, 2, 5 times a power of ten that is at least `least`. */
static double round_step(double least)
{
    const double power = pow(10, floor(log10(least)));
    static const double factors[] = {1, 2, 5, 10};
    for (int i = 0; i < 3; i++)
        if (factors[i] * power >= least * (1 - 1e-9))
            return factors[i] * power;
    return 10 * power;
}

static void place(crease_ticks *ticks, double lowest, double highest, double step)
{
    const double slack = 1e-9 * step;
    const double first = ceil((lowest - slack) / step);
    for (int i = 0; i < CREASE_TICKS_MOST; i++) {
        const double value = (first + i) * step;
        if (value > highest + slack)
            break;
        ticks->values[ticks->count++] = value;
    }
}

/* Takes away what all numbers have in common when they differ only far behind. */
static void shorten(crease_ticks *ticks, double lowest, double highest, double step)
{
    double most = fmax(fabs(lowest), fabs(highest));
    if (most / step > 2e4) {
        ticks->offset = floor(lowest / (100 * step)) * 100 * step;
        most = highest - ticks->offset;
    }
    if (most >= 1e5 || most < 1e-2)
        ticks->power = 3 * (int)floor(log10(most) / 3);
}

static int decimals_of(double step)
{
    const int decimals = -(int)floor(log10(step) + 1e-9);
    return decimals < 0 ? 0 : decimals > 15 ? 15 : decimals;
}

static void write_note(crease_ticks *ticks, double step)
{
    char number[CREASE_TICK_SIZE] = "";
    if (ticks->offset != 0)
        crease_tick_print(fabs(ticks->offset), decimals_of(100 * step), number);
    snprintf(ticks->note, sizeof ticks->note, "%s%s%s",
        ticks->offset == 0      ? ""
            : ticks->offset > 0 ? " \xE2\x88\x92 "
                                : " + ",
        number, ticks->power ? " / 10" : "");
}

crease_ticks crease_ticks_between(double lowest, double highest, int wanted)
{
    crease_ticks ticks = {0};
    if (!(highest > lowest))
        return ticks;
    const double step = round_step((highest - lowest) /
        (wanted < 2           ? 2
                : wanted > 10 ? 10
                              : wanted));
    place(&ticks, lowest, highest, step);
    shorten(&ticks, lowest, highest, step);
    const double unit = pow(10, ticks.power);
    for (int i = 0; i < ticks.count; i++)
        crease_tick_print(
            (ticks.values[i] - ticks.offset) / unit, decimals_of(step / unit), ticks.labels[i]);
    write_note(&ticks, step);
    return ticks;
}
