/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The points are binned across the line looked for, in a few strips along it. At every border of
 * bins, in every strip, two planes are fitted to the windows on either side, and one surface that
 * is quadratic across to both; the gain is the difference of their log likelihoods, n log(RSS),
 * less what the two further parameters cost. Bins hold moments, so a window of any width is a
 * difference of two prefix sums. */
#include "fit/scan.h"

#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BASIS = 5, MOMENTS = BASIS * (BASIS + 1) / 2, MOST_BINS = 400, MOST_STRIPS = 8, WIDTHS = 3 };
enum { LEAST_POINTS = 8, SUPPRESSED = 3, PER_DIRECTION = CREASE_MOST_CANDIDATES / 2 };

static const int WIDTH[WIDTHS] = {4, 8, 16};
static const double SIGNIFICANT = 12.0;
static const double NEGLIGIBLE = 0.02; /* residuals, in spacings, that no one asks about */

/* Symmetric moments of (1, s, t, s^2, z), upper triangle row by row. */
typedef struct moments {
    double m[MOMENTS];
} moments;

typedef struct profile {
    size_t bins, strips;
    double width, spacing, low[2], centre[3], strip;
    moments *sums; /* strips x (bins + 1): of all bins before */
    double *gain;  /* bins + 1: over all strips */
    double *part;  /* strips x (bins + 1) */
} profile;

static size_t slot(size_t row, size_t column)
{
    return row * BASIS - row * (row + 1) / 2 + column;
}

static moments difference(const moments *a, const moments *b)
{
    moments d;
    for (int i = 0; i < MOMENTS; i++)
        d.m[i] = a->m[i] - b->m[i];
    return d;
}

/* Residual sum of squares of z explained by the first n of (1, s, t, s^2): eliminates one after the
 * other. coefficients: n of them, or NULL. */
static double residual_sum(const moments *source, size_t n, double *coefficients)
{
    double a[BASIS][BASIS];
    for (size_t r = 0; r < BASIS; r++)
        for (size_t c = r; c < BASIS; c++)
            a[r][c] = a[c][r] = source->m[slot(r, c)];
    double scale[BASIS];
    bool used[BASIS] = {false};
    for (size_t r = 0; r < BASIS; r++)
        scale[r] = a[r][r];
    for (size_t p = 0; p < n; p++) {
        used[p] = a[p][p] > 1e-12 * scale[p] && a[p][p] > 0.0;
        for (size_t r = p + 1; r < BASIS && used[p]; r++) {
            const double factor = a[r][p] / a[p][p];
            for (size_t c = p; c < BASIS; c++)
                a[r][c] -= factor * a[p][c];
        }
    }
    for (size_t p = n; coefficients && p-- > 0;) {
        double sum = a[p][BASIS - 1];
        for (size_t c = p + 1; c < n; c++)
            sum -= a[p][c] * coefficients[c];
        coefficients[p] = used[p] ? sum / a[p][p] : 0.0;
    }
    return fmax(0.0, a[BASIS - 1][BASIS - 1]);
}

static const moments *sums_at(const profile *p, size_t strip, size_t border)
{
    return &p->sums[strip * (p->bins + 1) + border];
}

/* Moments of the windows of w bins left and right of a border; false when there is too little. */
static bool windows(const profile *p, size_t strip, size_t border, size_t w, moments side[2])
{
    const size_t from = border > w ? border - w : 0;
    const size_t to = border + w < p->bins ? border + w : p->bins;
    side[0] = difference(sums_at(p, strip, border), sums_at(p, strip, from));
    side[1] = difference(sums_at(p, strip, to), sums_at(p, strip, border));
    return side[0].m[0] >= LEAST_POINTS && side[1].m[0] >= LEAST_POINTS;
}

/* The gain of a border in a strip over all widths, and the windows of the best one. */
static double best_gain(const profile *p, size_t strip, size_t border, moments best[2])
{
    double most = 0.0;
    for (int i = 0; i < WIDTHS; i++) {
        moments side[2], both;
        if (!windows(p, strip, border, (size_t)WIDTH[i], side))
            continue;
        for (int m = 0; m < MOMENTS; m++)
            both.m[m] = side[0].m[m] + side[1].m[m];
        const double n = both.m[0], least = n * pow(NEGLIGIBLE * p->spacing, 2.0);
        const double one = residual_sum(&both, 4, NULL) + least;
        const double two =
            residual_sum(&side[0], 3, NULL) + residual_sum(&side[1], 3, NULL) + least;
        const double gain = n * log(one / two) - 2.0 * log(n);
        if (gain > most) {
            most = gain;
            memcpy(best, side, sizeof side);
        }
    }
    return most;
}

static void turn_point(const double *point, double angle, int direction, double out[3])
{
    const double c = cos(angle), s = sin(angle);
    const double xy[2] = {c * point[0] + s * point[1], c * point[1] - s * point[0]};
    out[0] = xy[direction];
    out[1] = xy[1 - direction];
    out[2] = point[2];
}

/* Bin and strip of a turned point, and its coordinates about the centre. */
static void locate(const profile *p, double point[3], size_t *bin, size_t *strip)
{
    const double b = (point[0] - p->low[0]) / p->width, s = (point[1] - p->low[1]) / p->strip;
    *bin = b > 0.0 ? (size_t)b : 0;
    *strip = s > 0.0 ? (size_t)s : 0;
    *bin = *bin < p->bins ? *bin : p->bins - 1;
    *strip = *strip < p->strips ? *strip : p->strips - 1;
    for (int c = 0; c < 3; c++)
        point[c] -= p->centre[c];
}

static void set_grid(profile *p, const crease_samples *samples, double angle, int direction)
{
    double high[3], low[3], sum = 0.0;
    for (int c = 0; c < 3; c++)
        low[c] = INFINITY, high[c] = -INFINITY;
    for (size_t i = 0; i < samples->count; i++) {
        double q[3];
        turn_point(samples->points + 3 * i, angle, direction, q);
        for (int c = 0; c < 3 && samples->prior[i] > 0.0; c++) {
            low[c] = fmin(low[c], q[c]);
            high[c] = fmax(high[c], q[c]);
        }
        sum += samples->prior[i] * q[2];
    }
    const double length = high[0] - low[0], along = high[1] - low[1];
    p->spacing = samples->spacing;
    p->width = fmax(1.5 * p->spacing, length / MOST_BINS);
    const double bins = ceil(length / p->width), strips = along / (8.0 * p->spacing);
    p->bins = bins > 1.0 ? (size_t)fmin(bins, MOST_BINS) : 1;
    p->strips = strips > 1.0 ? (size_t)fmin(strips, MOST_STRIPS) : 1;
    p->strip = fmax(along / (double)p->strips, p->spacing);
    for (int c = 0; c < 2; c++) {
        p->low[c] = low[c];
        p->centre[c] = 0.5 * (low[c] + high[c]);
    }
    p->centre[2] = sum / samples->used;
}

static void add_point(moments *m, const double q[3])
{
    const double basis[BASIS] = {1.0, q[0], q[1], q[0] * q[0], q[2]};
    for (size_t r = 0, k = 0; r < BASIS; r++)
        for (size_t c = r; c < BASIS; c++)
            m->m[k++] += basis[r] * basis[c];
}

static void fill(profile *p, const crease_samples *samples, double angle, int direction)
{
    const size_t borders = p->bins + 1;
    memset(p->sums, 0, p->strips * borders * sizeof *p->sums);
    memset(p->gain, 0, borders * sizeof *p->gain);
    for (size_t i = 0; i < samples->count; i++) {
        double q[3];
        size_t bin, strip;
        if (!(samples->prior[i] > 0.0))
            continue;
        turn_point(samples->points + 3 * i, angle, direction, q);
        locate(p, q, &bin, &strip);
        add_point(&p->sums[strip * borders + bin + 1], q);
    }
    for (size_t s = 0; s < p->strips; s++)
        for (size_t b = 1; b < borders; b++)
            for (int m = 0; m < MOMENTS; m++)
                p->sums[s * borders + b].m[m] += p->sums[s * borders + b - 1].m[m];
    for (size_t s = 0; s < p->strips; s++)
        for (size_t b = 1; b + 1 < borders; b++) {
            moments unused[2];
            p->part[s * borders + b] = best_gain(p, s, b, unused);
            p->gain[b] += p->part[s * borders + b];
        }
}

static crease_status create(crease_context *context, profile *p)
{
    *p = (profile){0};
    p->sums = crease_allocate(context, MOST_STRIPS * (MOST_BINS + 1), sizeof *p->sums);
    p->gain = crease_allocate(context, MOST_BINS + 1, sizeof *p->gain);
    p->part = crease_allocate(context, MOST_STRIPS * (MOST_BINS + 1), sizeof *p->part);
    return p->sums && p->gain && p->part ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

static void release(profile *p)
{
    free(p->sums);
    free(p->gain);
    free(p->part);
}

/* The highest border, taken out with those around it. */
static double take_peak(profile *p, size_t *border)
{
    *border = 0;
    for (size_t b = 1; b <= p->bins; b++)
        if (p->gain[b] > p->gain[*border])
            *border = b;
    const double gain = p->gain[*border];
    const size_t from = *border > SUPPRESSED ? *border - SUPPRESSED : 0;
    for (size_t b = from; b <= p->bins && b <= *border + SUPPRESSED; b++)
        p->gain[b] = 0.0;
    return gain;
}

/* --------------------------------------------------------------------------- bend or step -- */

/* Where the planes beside a border meet, the mean over strips; false when they mostly do not meet
 * near it: there the height jumps. */
static bool meet(const profile *p, size_t border, double *at)
{
    const double here = p->low[0] + p->width * (double)border - p->centre[0];
    double near_gain = 0.0, all = 0.0, sum = 0.0;
    for (size_t s = 0; s < p->strips; s++) {
        moments side[2];
        double c[2][3];
        const double gain = best_gain(p, s, border, side);
        if (!(gain > 0.0))
            continue;
        for (int k = 0; k < 2; k++)
            residual_sum(&side[k], 3, c[k]);
        const double t = p->low[1] + p->strip * ((double)s + 0.5) - p->centre[1];
        const double jump = c[1][0] - c[0][0] + (c[1][2] - c[0][2]) * t;
        const double place = -jump / (c[1][1] - c[0][1]);
        all += gain;
        if (fabs(place - here) <= 2.0 * p->width) {
            near_gain += gain;
            sum += gain * place;
        }
    }
    *at = near_gain > 0.0 ? sum / near_gain + p->centre[0] : here + p->centre[0];
    return near_gain > 0.5 * all;
}

/* A point near a step: where it lies across, and whether it belongs to the plane beyond. */
typedef struct member {
    double across;
    bool beyond;
} member;

static int by_place(const void *a, const void *b)
{
    const double x = ((const member *)a)->across, y = ((const member *)b)->across;
    return (x > y) - (x < y);
}

static size_t gather(
    const profile *p, const crease_samples *samples, int direction, size_t border, member *out)
{
    double planes[MOST_STRIPS][2][3];
    bool present[MOST_STRIPS];
    for (size_t s = 0; s < p->strips; s++) {
        moments side[2];
        present[s] = best_gain(p, s, border, side) > 0.0;
        for (int k = 0; k < 2 && present[s]; k++)
            residual_sum(&side[k], 3, planes[s][k]);
    }
    size_t count = 0;
    for (size_t i = 0; i < samples->count; i++) {
        double q[3], off[2];
        size_t bin, strip;
        turn_point(samples->points + 3 * i, 0.0, direction, q);
        locate(p, q, &bin, &strip);
        if (!(samples->prior[i] > 0.0) || bin + 3 < border || bin > border + 2 || !present[strip])
            continue;
        for (int k = 0; k < 2; k++) {
            const double *const c = planes[strip][k];
            off[k] = fabs(q[2] - c[0] - c[1] * q[0] - c[2] * q[1]);
        }
        out[count++] = (member){.across = q[0] + p->centre[0], .beyond = off[1] < off[0]};
    }
    return count;
}

/* The step between the last point before and the first one beyond the cut that puts the fewest
 * points on the wrong side. */
static void cut(member *members, size_t count, double least, double at[2])
{
    qsort(members, count, sizeof *members, by_place);
    size_t wrong = 0, best = 0, fewest;
    for (size_t i = 0; i < count; i++)
        wrong += !members[i].beyond;
    fewest = wrong;
    for (size_t i = 0; i < count; i++) {
        wrong = members[i].beyond ? wrong + 1 : wrong - 1;
        if (wrong < fewest) {
            fewest = wrong;
            best = i + 1;
        }
    }
    at[0] = members[best > 0 ? best - 1 : 0].across;
    at[1] = members[best < count ? best : count - 1].across;
    const double middle = 0.5 * (at[0] + at[1]), half = fmax(0.5 * (at[1] - at[0]), least);
    at[0] = middle - half;
    at[1] = middle + half;
}

static void describe(const profile *p, const crease_samples *samples, size_t border,
    member *members, crease_candidate *out)
{
    out->count = 1;
    if (meet(p, border, &out->at[0]))
        return;
    const size_t count = gather(p, samples, out->direction, border, members);
    if (count == 0)
        return;
    out->count = 2;
    cut(members, count, 0.1 * p->spacing, out->at);
}

static void insert(crease_candidate *candidates, size_t *count, const crease_candidate *one)
{
    size_t place = *count;
    for (; place > 0 && candidates[place - 1].gain < one->gain; place--)
        candidates[place] = candidates[place - 1];
    candidates[place] = *one;
    ++*count;
}

crease_status crease_scan(crease_context *context, const crease_samples *samples,
    crease_candidate candidates[CREASE_MOST_CANDIDATES], size_t *count)
{
    *count = 0;
    profile p;
    member *members = crease_allocate(context, samples->count, sizeof *members);
    crease_status status = create(context, &p);
    if (!members)
        status = CREASE_ERROR_NO_MEMORY;
    for (int direction = 0; direction < 2 && status == CREASE_OK; direction++) {
        set_grid(&p, samples, 0.0, direction);
        fill(&p, samples, 0.0, direction);
        for (int i = 0; i < PER_DIRECTION; i++) {
            size_t border;
            crease_candidate one = {.direction = direction, .gain = take_peak(&p, &border)};
            if (one.gain < SIGNIFICANT)
                break;
            describe(&p, samples, border, members, &one);
            insert(candidates, count, &one);
        }
    }
    free(members);
    release(&p);
    return status;
}

/* ------------------------------------------------------------------------------------- turn -- */

static double alignment(profile *p, const crease_samples *samples, double angle)
{
    double total = 0.0;
    for (int direction = 0; direction < 2; direction++) {
        set_grid(p, samples, angle, direction);
        fill(p, samples, angle, direction);
        for (int i = 0; i < 4; i++) {
            size_t border;
            total += take_peak(p, &border);
        }
    }
    return total;
}

crease_status crease_scan_turn(
    crease_context *context, const crease_samples *samples, double *angle)
{
    const double degree = 0.017453292519943296;
    const struct {
        double reach, step;
    } rounds[] = {{45.0, 3.0}, {2.0, 1.0}, {0.75, 0.25}};
    profile p;
    crease_status status = create(context, &p);
    double best = 0.0, centre = 0.0, highest = SIGNIFICANT;
    for (size_t r = 0; r < sizeof rounds / sizeof rounds[0] && status == CREASE_OK; r++) {
        const int steps = (int)(rounds[r].reach / rounds[r].step);
        for (int i = -steps; i <= steps && status == CREASE_OK; i++) {
            const double now = centre + i * rounds[r].step * degree;
            const double value = alignment(&p, samples, now);
            if (value > highest) {
                highest = value;
                best = now;
            }
            if (crease_cancelled(context))
                status = crease_fail_cancelled(context);
        }
        centre = best;
    }
    *angle = best;
    release(&p);
    return status;
}
