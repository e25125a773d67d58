/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The outline of points in a plane, from those that an empty disc may touch and those in its way.
 */
#include "base/memory.h"
#include "space/hollow.h"
#include "space/outline.h"

#include <stdlib.h>
#include <string.h>

struct few {
    size_t count;
    double *points, *normals; /* count x 3 */
    bool *touched;
    uint32_t *number; /* among all points */
};

static crease_status gather(crease_context *context, const double *places, size_t count,
    const unsigned char *hollow, struct few *out)
{
    for (size_t i = 0; i < count; i++)
        out->count += hollow[i] != CREASE_HOLLOW_FAR;
    out->points = crease_allocate(context, out->count, 6 * sizeof *out->points);
    out->touched = crease_allocate(context, out->count, sizeof *out->touched);
    out->number = crease_allocate(context, out->count, sizeof *out->number);
    if (!out->points || !out->touched || !out->number)
        return CREASE_ERROR_NO_MEMORY;
    out->normals = out->points + 3 * out->count;
    for (size_t i = 0, k = 0; i < count; i++) {
        if (hollow[i] == CREASE_HOLLOW_FAR)
            continue;
        memcpy(out->points + 3 * k, places + 2 * i, 2 * sizeof *out->points);
        out->normals[3 * k + 2] = 1.0;
        out->touched[k] = hollow[i] == CREASE_HOLLOW_TOUCHED;
        out->number[k++] = (uint32_t)i;
    }
    return CREASE_OK;
}

crease_status crease_outline_find_flat(
    crease_context *context, const double *places, size_t count, double radius, crease_outline *out)
{
    struct few few = {.count = 0};
    unsigned char *const hollow = crease_allocate(context, count, sizeof *hollow);
    *out = (crease_outline){.loop_count = 0};
    crease_status status = hollow ? crease_hollow_find(context, places, count, radius, hollow)
                                  : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = gather(context, places, count, hollow, &few);
    free(hollow);
    if (status == CREASE_OK)
        status = crease_outline_find(
            context, few.points, few.normals, few.count, few.touched, radius, out);
    for (size_t i = 0; status == CREASE_OK && i < out->first[out->loop_count]; i++)
        out->points[i] = few.number[out->points[i]];
    free(few.points);
    free(few.touched);
    free(few.number);
    return status;
}
