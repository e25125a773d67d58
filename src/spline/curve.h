/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#ifndef CREASE_SPLINE_CURVE_H
#define CREASE_SPLINE_CURVE_H

#include "base/context.h"

struct crease_curve {
    int order;
    size_t count;
    double *knots;          /* count + order */
    double *control_points; /* count x 3 */
};

#endif
