/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Cairo counts the surfaces of a whole process and writes the count into SVG files as part of
 * identifiers. Here they are counted anew, so that the same drawing gives the same bytes. */
#ifndef CREASE_VIEW_NUMBERING_H
#define CREASE_VIEW_NUMBERING_H

#include "write/output.h"

/* Writes an SVG text with the identifiers surface<n>, image<n>, mask<n> and the like renamed to 1,
 * 2, ... in the order in which the numbers first appear. */
void crease_numbering_write(crease_output *output, const char *text, size_t size);

#endif
