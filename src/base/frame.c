/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/frame.h"

#include <math.h>

void crease_frame_enter(const crease_frame *frame, const double *from, size_t count, double *to)
{
    const double *const m = frame->rotation, *const o = frame->origin;
    for (size_t i = 0; i < count; i++, from += 3, to += 3) {
        const double d[3] = {from[0] - o[0], from[1] - o[1], from[2] - o[2]};
        for (int r = 0; r < 3; r++)
            to[r] = m[3 * r] * d[0] + m[3 * r + 1] * d[1] + m[3 * r + 2] * d[2];
    }
}

void crease_frame_leave(const crease_frame *frame, const double *from, size_t count, double *to)
{
    const double *const m = frame->rotation, *const o = frame->origin;
    for (size_t i = 0; i < count; i++, from += 3, to += 3) {
        const double d[3] = {from[0], from[1], from[2]};
        for (int c = 0; c < 3; c++)
            to[c] = o[c] + m[c] * d[0] + m[3 + c] * d[1] + m[6 + c] * d[2];
    }
}

void crease_frame_turn(crease_frame *frame, double angle)
{
    const double c = cos(angle), s = sin(angle);
    double *const m = frame->rotation;
    for (int i = 0; i < 3; i++) {
        const double x = m[i], y = m[3 + i];
        m[i] = c * x + s * y;
        m[3 + i] = c * y - s * x;
    }
}

double crease_frame_defect(const double m[9])
{
    double worst = 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double *const a = m + 3 * i, *const b = m + 3 * j;
            const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            worst = fmax(worst, fabs(dot - (i == j)));
        }
    const double determinant = m[0] * (m[4] * m[8] - m[5] * m[7]) -
        m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
    return determinant > 0.0 && isfinite(worst) ? worst : INFINITY;
}
