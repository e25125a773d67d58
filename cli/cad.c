/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad.h"

#ifdef CREASE_HAVE_CAD
#include "crease/crease_cad.h"

bool cad_is_there(void)
{
    return true;
}

crease_status cad_check(crease_context *context, const char *path)
{
    (void)context, (void)path;
    return CREASE_OK;
}

crease_status cad_write_surfaces(
    crease_context *context, const crease_surface *const *surfaces, size_t count, const char *path)
{
    return crease_cad_write(context, surfaces, count, path);
}

crease_status cad_write_trim(crease_context *context, const crease_trim *trim, const char *path)
{
    return crease_cad_trim_write(context, trim, path);
}

crease_status cad_trim_mesh(
    crease_context *context, const crease_trim *trim, crease_mesh **out, bool *valid)
{
    const crease_status status = crease_cad_trim_mesh(context, trim, 0.0, out);
    *valid = status == CREASE_OK;
    return status == CREASE_ERROR_NUMERIC ? CREASE_OK : status;
}

static crease_status write_curves(
    crease_context *context, const crease_curve *const *curves, size_t count, const char *path)
{
    return crease_cad_curves_write(context, curves, count, path);
}
#else
bool cad_is_there(void)
{
    return false;
}

crease_status cad_check(crease_context *context, const char *path)
{
    return crease_context_fail(context, CREASE_ERROR_UNSUPPORTED,
        "%s: this build writes no CAD files; build with OpenCASCADE (CREASE_CAD=ON)", path);
}

crease_status cad_write_surfaces(
    crease_context *context, const crease_surface *const *surfaces, size_t count, const char *path)
{
    (void)surfaces, (void)count;
    return cad_check(context, path);
}

crease_status cad_write_trim(crease_context *context, const crease_trim *trim, const char *path)
{
    (void)trim;
    return cad_check(context, path);
}

crease_status cad_trim_mesh(
    crease_context *context, const crease_trim *trim, crease_mesh **out, bool *valid)
{
    (void)context, (void)trim, (void)out;
    *valid = false;
    return CREASE_OK;
}

static crease_status write_curves(
    crease_context *context, const crease_curve *const *curves, size_t count, const char *path)
{
    (void)curves, (void)count;
    return cad_check(context, path);
}
#endif

crease_status cad_write_creases(crease_context *context, report *r,
    const crease_curve *const *curves, size_t count, const char *path)
{
    if (count == 0) {
        report_line(r, "no crease to write: %s is left as it is", path);
        return CREASE_OK;
    }
    const crease_status status = write_curves(context, curves, count, path);
    if (status == CREASE_OK)
        report_line(r, "wrote %s", path);
    return status;
}
