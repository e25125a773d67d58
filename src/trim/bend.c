/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* At a corner the lines through the points on either side run in different directions. So do those
 * of a small round hole: that a corner is none may turn out later. */
#include "trim/bend.h"

#include "base/vector.h"

#include <math.h>

enum { LEAST_POINTS = 3 };

/* In spacings along the border. */
static const double WINDOW = 9.0;     /* that is looked at on either side */
static const double GUARD = 0.6;      /* of it, left out */
static const double LEAST_SIDE = 3.5; /* that there must be */
static const double BETWEEN = 5.0;    /* corners, least */

static const double LEAST_TURN = 0.52; /* radians */

struct side {
    bool known;
    double along[3];
};

/* Distance along the border from point i to another, `steps` points further. */
static double span(
    const crease_rag *rag, const double *at, double length, size_t i, ptrdiff_t steps)
{
    const ptrdiff_t n = (ptrdiff_t)rag->count, k = (ptrdiff_t)i + steps;
    if (k >= n)
        return at[k - n] + length - at[i];
    return k < 0 ? at[i] - (at[k + n] - length) : fabs(at[k] - at[i]);
}

static bool exists(const crease_rag *rag, size_t i, ptrdiff_t steps)
{
    const ptrdiff_t n = (ptrdiff_t)rag->count, k = (ptrdiff_t)i + steps;
    return rag->closed ? steps < n && steps > -n : k >= 0 && k < n;
}

static const double *point_at(const crease_rag *rag, size_t i, ptrdiff_t steps)
{
    const ptrdiff_t n = (ptrdiff_t)rag->count;
    return rag->points + 3 * (((ptrdiff_t)i + steps + n) % n);
}

/* The direction of the regression line of one side's points over their distance. */
static struct side look(
    const crease_rag *rag, const double *at, double length, size_t i, ptrdiff_t step)
{
    const double s = rag->spacing;
    const double reach = rag->closed ? fmin(WINDOW * s, 0.3 * length) : WINDOW * s;
    double mean = 0.0, far = 0.0, count = 0.0, middle[3] = {0};
    struct side side = {.known = false};
    for (int pass = 0; pass < 2; pass++)
        for (ptrdiff_t k = step; exists(rag, i, k); k += step) {
            const double x = span(rag, at, length, i, k);
            const double *const p = point_at(rag, i, k);
            if (x > reach)
                break;
            if (x < GUARD * s)
                continue;
            for (int c = 0; c < 3; c++)
                *(pass ? &side.along[c] : &middle[c]) +=
                    pass ? (x - mean / count) * (p[c] - middle[c] / count) : p[c];
            mean += pass ? 0.0 : x;
            count += pass ? 0.0 : 1.0;
            far = x;
        }
    side.known = count >= LEAST_POINTS && far >= LEAST_SIDE * s;
    for (int c = 0; c < 3; c++)
        side.along[c] *= (double)step;
    return side;
}

static double angle_between(const double a[3], const double b[3])
{
    double cross[3];
    crease_vector_cross(a, b, cross);
    return atan2(crease_vector_length(cross), crease_vector_dot(a, b));
}

/* How much the border turns at a point; 0 where it is no corner. */
static double turn_at(const crease_rag *rag, const double *at, double length, size_t i)
{
    const struct side before = look(rag, at, length, i, -1), after = look(rag, at, length, i, 1);
    const double turn =
        before.known && after.known ? angle_between(before.along, after.along) : 0.0;
    return turn < LEAST_TURN ? 0.0 : turn;
}

/* The corners are where the border turns most, of the points around. */
size_t crease_bends_find(const crease_rag *rag, const double *at, double length, size_t *corners)
{
    size_t count = 0;
    for (size_t i = 0; i < rag->count; i++) {
        const double turn = turn_at(rag, at, length, i);
        bool most = turn > 0.0;
        for (ptrdiff_t step = -1; step <= 1 && most; step += 2)
            for (ptrdiff_t k = step;
                 most && exists(rag, i, k) && span(rag, at, length, i, k) < BETWEEN * rag->spacing;
                 k += step) {
                const size_t n = rag->count;
                const size_t other = (size_t)((ptrdiff_t)i + k + (ptrdiff_t)n) % n;
                const double rival = turn_at(rag, at, length, other);
                most = rival < turn || (rival == turn && i < other);
            }
        if (most)
            corners[count++] = i;
    }
    return count;
}
