/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Creases as polylines that share their corners. */
#include "crease/network.h"
#include "base/memory.h"
#include "write/curves.h"

#include <stdlib.h>

enum { COLUMNS = 6 };

static const char *const names[COLUMNS] = {
    "region_1", "region_2", "closed", "angle", "angle_error", "position_error"};

/* How far the polylines may be from the curves, in spacings. */
static const double TOLERANCE = 0.02;

crease_status crease_network_write(
    crease_context *context, const crease_network *network, const char *path)
{
    double *const values = crease_allocate(context, network->count, COLUMNS * sizeof *values);
    if (!values)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < network->count; i++) {
        const crease_network_crease *const crease = &network->creases[i];
        double *const row = values + COLUMNS * i;
        row[0] = crease->regions[0];
        row[1] = crease->regions[1];
        row[2] = crease->closed;
        row[3] = crease->angle;
        row[4] = crease->angle_error;
        row[5] = crease->position_error;
    }
    const crease_curve_columns columns = {COLUMNS, names, values};
    const crease_status status =
        crease_curves_write_columns(context, crease_network_curves(network), network->count,
            TOLERANCE * network->spacing, &columns, path);
    free(values);
    return status;
}
