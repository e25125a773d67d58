/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where models meet: the curve of two, the point of three or more. */
#ifndef CREASE_CREASE_INTERSECT_H
#define CREASE_CREASE_INTERSECT_H

#include "primitive/model.h"

/* Moves a place onto both models, the shortest way, by at most `reach`. tangent: the unit direction
 * of their common curve there, gradient of the first x gradient of the second. False, and the place
 * is lost, where they do not meet within reach or touch at less than 2.6 degrees. */
bool crease_intersection_project(
    const crease_model *const models[2], double reach, double place[3], double tangent[3]);

/* Goes on along the common curve of two models from a place on it, in the direction of the tangent,
 * by a step of `longest` or, where the curve bends, half, a quarter or an eighth of it. False where
 * the curve ends: nothing has changed. */
bool crease_intersection_step(
    const crease_model *const models[2], double longest, double place[3], double tangent[3]);

/* Moves a place by at most `reach` to where the models are nearest in the least-squares sense,
 * along directions that they determine. False when one of them stays farther away than `close`. */
bool crease_intersection_meet(
    const crease_model *const *models, size_t count, double reach, double close, double place[3]);

#endif
