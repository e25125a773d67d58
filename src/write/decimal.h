/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Numbers as text: the shortest decimal that reads back as the same number, with a point whatever
 * the locale of the host program is. */
#ifndef CREASE_WRITE_DECIMAL_H
#define CREASE_WRITE_DECIMAL_H

#include <stddef.h>

enum { CREASE_DECIMAL_SIZE = 48 };

/* Prints a double so that it reads back exactly; returns the length. Not finite: nan, inf, -inf. */
size_t crease_decimal_print(double value, char out[CREASE_DECIMAL_SIZE]);
/* The same for a float: fewer digits suffice. */
size_t crease_decimal_print_float(float value, char out[CREASE_DECIMAL_SIZE]);

#endif
