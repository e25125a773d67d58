/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "stream/labelled.h"

#include "base/memory.h"
#include "cloud/cloud.h"
#include "write/cloud.h"

#include <stdlib.h>

crease_status crease_labelled_create(
    crease_context *context, const crease_labelled *like, crease_labelled *out)
{
    const size_t rows = like->at_once;
    *out = *like;
    out->results = crease_allocate(context, rows, sizeof *out->results);
    out->variance = crease_allocate(context, rows, sizeof *out->variance);
    out->features = crease_allocate(context, rows, sizeof *out->features);
    out->regions = crease_allocate(context, rows, sizeof *out->regions);
    return out->results && out->variance && out->features && out->regions ? CREASE_OK
                                                                          : CREASE_ERROR_NO_MEMORY;
}

void crease_labelled_free(crease_labelled *labelled)
{
    free(labelled->results);
    free(labelled->variance);
    free(labelled->features);
    free(labelled->regions);
    *labelled = (crease_labelled){0};
}

static crease_status begin(
    crease_context *context, crease_labelled *labelled, const crease_cloud *cloud)
{
    const crease_status status = crease_cloud_check_names(context, cloud, labelled->path);
    if (labelled->count > 0)
        crease_cloud_write_ply_header(
            labelled->output, cloud, labelled->count, labelled->normal_type);
    labelled->begun = true;
    return status;
}

crease_status crease_labelled_add(
    crease_context *context, crease_labelled *labelled, const crease_cloud *rows)
{
    crease_cloud *cloud = NULL;
    const crease_field fields[] = {{"variance", CREASE_TYPE_FLOAT32, labelled->variance},
        {"feature", CREASE_TYPE_UINT8, labelled->features},
        {"region", CREASE_TYPE_INT32, labelled->regions}};
    for (size_t i = 0; i < rows->count; i++) {
        labelled->variance[i] = labelled->results[i].variance;
        labelled->features[i] = (uint8_t)labelled->results[i].feature;
        labelled->regions[i] = labelled->results[i].region;
    }
    crease_status status = crease_cloud_with_fields(context, rows, fields, 3, &cloud);
    if (status == CREASE_OK && !labelled->begun)
        status = begin(context, labelled, cloud);
    if (status == CREASE_OK)
        crease_cloud_write_records(labelled->output, cloud, labelled->normal_type);
    crease_cloud_free(cloud);
    return status;
}
