/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What height fields are over that turn too far for a plane: an axis, or a centre. */
#ifndef CREASE_PRIMITIVE_BASE_H
#define CREASE_PRIMITIVE_BASE_H

#include "primitive/model.h"
#include "primitive/sample.h"

/* Lays z along the axis that the sample's points surround, relative to its origin. False when there
 * is none that they all face away from, or all towards, within 70 degrees. */
bool crease_tube_frame(const crease_sample *sample, crease_model *model);
/* The same for the centre that they surround, but for a gap where z is lowest. */
bool crease_ball_frame(const crease_sample *sample, crease_model *model);

/* Directions from a centre by their stereographic projection, from where z is lowest, in units of
 * the radius at the opposite side. Of a place in the frame, and back to a unit vector. */
void crease_ball_project(const double place[3], double out[2]);
void crease_ball_direction(const double at[2], double out[3]);
/* How much smaller than in the projection lengths are at distance 1 from the centre. */
double crease_ball_scale(const double at[2]);

#endif
