/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Text and numbers within HTML and JSON. Texts are clean (view/text.h). */
#ifndef CREASE_VIEW_MARKUP_H
#define CREASE_VIEW_MARKUP_H

#include "write/output.h"

/* Text within HTML. */
void crease_markup_html(crease_output *output, const char *text);
/* A JSON string that holds nothing an HTML parser could act upon. */
void crease_markup_string(crease_output *output, const char *text);
/* A JSON number; null when it is not finite. */
void crease_markup_number(crease_output *output, double value);
/* A JSON array of numbers. */
void crease_markup_numbers(crease_output *output, const double *values, size_t count);
/* "name":"text" */
void crease_markup_member(crease_output *output, const char *name, const char *text);

#endif
