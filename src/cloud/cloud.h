/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The cloud: points, normals, named fields. Internal view. */
#ifndef CREASE_CLOUD_CLOUD_H
#define CREASE_CLOUD_CLOUD_H

#include "crease/crease.h"

#include <stddef.h>

struct crease_cloud {
    size_t count;
    double *points;  /* count x 3 */
    double *normals; /* count x 3 or NULL */
    crease_field *fields;
    size_t field_count;
    crease_type coordinate_type;
};

#endif
