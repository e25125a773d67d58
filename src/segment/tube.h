/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The frames of round height fields: free forms that turn too far for a height over a plane. */
#ifndef CREASE_SEGMENT_TUBE_H
#define CREASE_SEGMENT_TUBE_H

#include "segment/model.h"
#include "segment/sample.h"

/* Lays z along the axis that the sample's points surround, relative to its origin. False when there
 * is none that they all face away from, or all towards, within 70 degrees. */
bool crease_tube_frame(const crease_sample *sample, crease_model *model);

#endif
