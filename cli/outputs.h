/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Writing whatever was asked for, by extension. */
#ifndef CREASE_CLI_OUTPUTS_H
#define CREASE_CLI_OUTPUTS_H

#include "report.h"
#include "settings.h"
#include "target.h"

/** What a command has to write. Members for targets that it does not allow are NULL. */
typedef struct outputs {
    int allowed;               /* target_kind bits */
    const void *from;          /* what the functions below are given */
    const crease_cloud *cloud; /* for clouds, and the first layer of what is seen */
    const char *colour_by;     /* field of the cloud that colours figures, or NULL */
    /* Adds further layers. */
    crease_status (*show)(
        crease_context *context, const void *from, bool page, crease_scene *scene);
    crease_status (*cad)(crease_context *context, const void *from, const char *path);
    crease_status (*mesh)(crease_context *context, const void *from, const char *path);
    /* Writes --creases. */
    crease_status (*creases)(
        crease_context *context, report *r, const void *from, const char *path);
    const crease_cloud *points; /* for --points */
} outputs;

/** Writes every -o, --creases, --points and --report, and says so. */
crease_status outputs_write(
    crease_context *context, const settings *s, report *r, const outputs *all);

#endif
