/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The faces between the edges of an overlay. */
#ifndef CREASE_TRIM_WALK_H
#define CREASE_TRIM_WALK_H

#include "trim/overlay.h"

/* Adds loops and faces to an overlay that has edges, and leaves out the edges without one. Faces
 * narrower than least_width, in the mean, are none, unless they lie between two cuts. *sound: false
 * where loops do not close or no face is left. Errors: NO_MEMORY. */
crease_status crease_walk_faces(crease_context *context, const crease_cuts *cuts,
    double least_width, crease_overlay *overlay, bool *sound);

#endif
