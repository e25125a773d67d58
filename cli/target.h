/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What a file name asks for, by its extension. */
#ifndef CREASE_CLI_TARGET_H
#define CREASE_CLI_TARGET_H

#include "report.h"
#include "settings.h"

typedef enum target_kind {
    TARGET_CLOUD = 1,
    TARGET_CAD = 2,
    TARGET_MESH = 4,
    TARGET_FIGURE = 8,
    TARGET_PAGE = 16,
    TARGET_REPORT = 32,
    TARGET_LINES = 64
} target_kind;

/** The kind among `allowed` (bits) that the path's extension stands for, 0 for none. */
target_kind target_of(const char *path, int allowed);

/** Checks before any work that every output has an extension among `allowed` and a folder that
 * exists, and that there is something to do. */
crease_status targets_check(crease_context *context, const settings *s, int allowed);

/** Checks one path that may be NULL. */
crease_status target_check(crease_context *context, const char *path, int allowed);

/** The last part of a path: what a figure is called. */
const char *target_name(const char *path);

/** Writes the report to the path, if there is one. */
crease_status target_write_report(crease_context *context, report *r, const char *path);

#endif
