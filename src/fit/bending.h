/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#ifndef CREASE_FIT_BENDING_H
#define CREASE_FIT_BENDING_H

#include "fit/system.h"

/* Fills the bending and tension matrices of a system (see there) that are otherwise zero. */
crease_status crease_bending_fill(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_system *system);

#endif
