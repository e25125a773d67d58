/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#ifndef CREASE_FIT_BENDING_H
#define CREASE_FIT_BENDING_H

#include "fit/system.h"

/* Fills the bending matrix of a system (see there) that is otherwise zero. */
crease_status crease_bending_fill(
    crease_context *context, const crease_height *height, crease_system *system);

#endif
