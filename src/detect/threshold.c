/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A score x that cannot exceed m is looked at as x / (1 - x / m), which can: the square of a
 * tangent instead of a sine. On smooth ground its logarithm is close to normally distributed: its
 * centre follows from noise, spacing and K, its width is about 2 / sqrt(K). Both are read off the
 * lower half of all values, which edges do not reach: the median and the 16th percentile; where a
 * cloud is a mixture (flat faces beside curved ones, without noise), the width is held near its
 * theoretical value. Each point's probability under this null then goes through the step-up rule
 * for the false discovery rate. On data without noise the null is a point at zero, so a least
 * score is asked for as well.
 *
 * Based on: Benjamini, Hochberg. Controlling the false discovery rate. 1995.
 * Based on: Efron. Large-scale simultaneous hypothesis testing: the choice of a null hypothesis.
 * 2004 (the null from the data). */
#include "detect/threshold.h"

#include <math.h>

enum { BINS = CREASE_HISTOGRAM_BINS, PER_UNIT = 50 };

/* Scores are no closer to the greatest possible one than this. */
static const double rounding = 1e-12;

static const double lowest = -92.0;

static size_t bin_of(double score)
{
    const double place = score > 0 ? (log(score) - lowest) * PER_UNIT : 0;
    return place < 0 ? 0 : place < BINS ? (size_t)place : BINS - 1;
}

static double value_of(double bin)
{
    return lowest + bin / PER_UNIT;
}

/* ln(score) below which the share of all points lies, interpolated within its bin. */
static double quantile(const uint64_t *histogram, size_t count, double share)
{
    const double wanted = share * (double)count;
    double below = 0;
    for (size_t bin = 0; bin < BINS; bin++) {
        const double here = (double)histogram[bin];
        if (here > 0 && below + here >= wanted)
            return value_of((double)bin + (wanted - below) / here);
        below += here;
    }
    return 0;
}

/* The first bin so that of the points from it on, noise explains a share below the rate. */
static size_t step_up(
    const uint64_t *histogram, size_t count, double centre, double width, double rate)
{
    uint64_t found = 0, first = BINS;
    for (size_t bin = BINS; bin-- > 0;) {
        found += histogram[bin];
        const double score = (value_of((double)bin) - centre) / width;
        const double chance = 0.5 * erfc(score * 0.70710678118654752);
        if (chance * (double)count <= rate * (double)found)
            first = bin;
    }
    return first;
}

void crease_threshold_count(
    crease_histogram *histogram, double score, const crease_threshold_rule *rule)
{
    histogram->bin[bin_of(score / fmax(1 - score / rule->most, rounding))]++;
}

double crease_threshold_find(
    const crease_histogram *histogram, size_t count, const crease_threshold_rule *rule)
{
    const uint64_t *const bins = histogram->bin;
    const double centre = quantile(bins, count, 0.5);
    const double measured = fmax(centre - quantile(bins, count, 0.1587), 1.0 / PER_UNIT);
    const double width = fmin(measured, 3 / sqrt(rule->k));
    const size_t first = step_up(bins, count, centre, width, rule->rate);
    if (first == BINS)
        return INFINITY;
    const double found = exp(value_of((double)first));
    return fmax(found / (1 + found / rule->most), rule->least);
}
