/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Height fields: the bases of crease_patch and their values. */
#ifndef CREASE_SEGMENT_PATCH_H
#define CREASE_SEGMENT_PATCH_H

#include "segment/model.h"

enum {
    CREASE_PATCH_TERMS = 16, /* most basis functions that differ from 0 in one place */
    CREASE_PATCH_DEGREE = 4, /* highest degree of a polynomial */
    CREASE_PATCH_SPANS = 24, /* most spans of a spline in one direction */
    CREASE_PATCH_COEFFICIENTS = (CREASE_PATCH_SPANS + 3) * (CREASE_PATCH_SPANS + 3)
};

/* The basis functions that are not 0 in one place, with their partial derivatives. */
typedef struct crease_basis_at {
    int count;
    size_t index[CREASE_PATCH_TERMS]; /* ascending, but where a round patch begins anew */
    double value[CREASE_PATCH_TERMS], dx[CREASE_PATCH_TERMS], dy[CREASE_PATCH_TERMS];
} crease_basis_at;

/* x, y inside low..high. */
void crease_patch_basis(const crease_patch *patch, double x, double y, crease_basis_at *out);
/* The height at any place, and its slopes. */
double crease_patch_at(const crease_patch *patch, double x, double y, double slope[2]);
/* Control points along one side of a spline; those of one x or angle are together. */
size_t crease_patch_side(const crease_patch *patch);

#endif
