/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Colours come packed, as text or as bytes; a cloud has them as bytes red, green, blue. */
#ifndef CREASE_READ_COLOUR_H
#define CREASE_READ_COLOUR_H

#include "read/columns.h"

/* Doubles named as colours become bytes where all of them are whole numbers 0..255. survey: of the
 * whole file, when these are some of its rows, or NULL. */
crease_status crease_colours_narrow(
    crease_context *context, crease_columns *columns, crease_survey *survey);
/* Whether there are columns that are named as colours. */
bool crease_colours_named(const crease_columns *columns);
/* Splits `rgb` or `rgba`, 4 bytes of whatever type, into red, green, blue and alpha, unless fields
 * of those names are there already. */
crease_status crease_colours_unpack(crease_context *context, crease_columns *columns);

#endif
