/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Reading the command's input and telling about it. */
#ifndef CREASE_CLI_INPUT_H
#define CREASE_CLI_INPUT_H

#include "report.h"
#include "settings.h"

/** Reads the only input as a cloud, notes it in the report, and prints a line about it. */
crease_status input_read(crease_context *context, const settings *s, report *r, crease_cloud **out);
/** The only input's path, or a usage error that says that `what` is missing. */
crease_status input_path(
    crease_context *context, const settings *s, const char *what, const char **out);
/** Adds count and bounds of the points of a file that is not held to the report; returns the
 * object.
 */
cJSON *input_describe_parts(
    report *r, size_t count, const double lowest[3], const double highest[3]);
/** Adds count, bounds and fields of a cloud to the report. */
void input_describe(report *r, const crease_cloud *cloud);

#endif
