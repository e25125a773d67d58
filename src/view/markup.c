/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/markup.h"

#include <math.h>
#include <string.h>

void crease_markup_html(crease_output *output, const char *text)
{
    for (; *text; text++)
        if (strchr("<>&\"'", *text))
            crease_output_format(output, "&#%d;", *text);
        else
            crease_output_bytes(output, text, 1);
}

void crease_markup_string(crease_output *output, const char *text)
{
    crease_output_text(output, "\"");
    for (; *text; text++)
        if (strchr("<>&\"'\\", *text))
            crease_output_format(output, "\\u%04x", (unsigned)*text);
        else
            crease_output_bytes(output, text, 1);
    crease_output_text(output, "\"");
}

void crease_markup_number(crease_output *output, double value)
{
    if (isfinite(value))
        crease_output_double(output, value);
    else
        crease_output_text(output, "null");
}

void crease_markup_numbers(crease_output *output, const double *values, size_t count)
{
    crease_output_text(output, "[");
    for (size_t i = 0; i < count; i++) {
        crease_output_text(output, i ? "," : "");
        crease_markup_number(output, values[i]);
    }
    crease_output_text(output, "]");
}

void crease_markup_member(crease_output *output, const char *name, const char *text)
{
    crease_output_format(output, "\"%s\":", name);
    crease_markup_string(output, text);
}
