/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Numbers from text: correctly rounded, quick, the same in every locale. */
#ifndef CREASE_READ_NUMBER_H
#define CREASE_READ_NUMBER_H

#include <stdbool.h>

/* Reads the decimal number at text, correctly rounded (ties to even); inf, nan and their usual
 * spellings give values that are not finite, as does overflow. comma: ',' is a decimal point as
 * well. Returns the character after the number, or NULL where there is none. */
const char *crease_number_parse(const char *text, const char *end, bool comma, double *value);

#endif
