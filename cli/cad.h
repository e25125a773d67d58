/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* CAD files, in a program that may have been built without them. */
#ifndef CREASE_CLI_CAD_H
#define CREASE_CLI_CAD_H

#include "report.h"

#include "crease/crease_trim.h"

/** Whether the program was built with CAD files. */
bool cad_is_there(void);
/** Fails with a sentence when the program was built without CAD files. */
crease_status cad_check(crease_context *context, const char *path);
crease_status cad_write_surfaces(
    crease_context *context, const crease_surface *const *surfaces, size_t count, const char *path);
crease_status cad_write_trim(crease_context *context, const crease_trim *trim, const char *path);
/** The triangles of a trimmed sheet, unless out is NULL. *valid is false, and there is no error, in
 * a program without CAD files, and when OpenCASCADE finds fault with it: then it had better be left
 * whole. */
crease_status cad_trim_mesh(
    crease_context *context, const crease_trim *trim, crease_mesh **out, bool *valid);
/** Writes creases; where there are none it only says so, for CAD files cannot be empty. */
crease_status cad_write_creases(crease_context *context, report *r,
    const crease_curve *const *curves, size_t count, const char *path);

#endif
