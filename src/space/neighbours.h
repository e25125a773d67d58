/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The K nearest neighbours of every point of a cloud (eq. 2 of the paper). Internal view. */
#ifndef CREASE_SPACE_NEIGHBOURS_H
#define CREASE_SPACE_NEIGHBOURS_H

#include "base/context.h"

struct crease_neighbours {
    size_t count;
    int k;
    uint32_t *indices; /* count x k */
};

/* Makes room for k neighbours of so many points. */
crease_status crease_neighbours_create(
    crease_context *context, size_t count, int k, crease_neighbours **out);

#endif
