/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cloud/cloud.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t crease_type_size(crease_type type)
{
    static const size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[type];
}

static crease_status check_points(crease_context *context, const crease_cloud_parts *parts)
{
    if (parts->count > UINT32_MAX)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "cloud: %zu points; at most %u fit one cloud, split it", parts->count, UINT32_MAX);
    if (parts->count && !parts->points)
        return crease_fail(context, CREASE_ERROR_ARGUMENT, "cloud: no points were given");
    for (size_t i = 0; i < 3 * parts->count; i++)
        if (!isfinite(parts->points[i]))
            return crease_fail(context, CREASE_ERROR_VALUE,
                "cloud: point %zu is not finite (%c = %g); remove such points", i / 3, "xyz"[i % 3],
                parts -> points[i]);
    return CREASE_OK;
}

static crease_status copy_field(
    crease_context *context, const crease_field *from, size_t count, crease_field *to)
{
    to->type = from->type;
    to->name = crease_duplicate(context, from->name, strlen(from->name) + 1, 1);
    to->values = crease_duplicate(context, from->values, count, crease_type_size(from->type));
    return to->name && to->values ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

static bool has_field(const crease_field *fields, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(fields[i].name, name) == 0)
            return true;
    return false;
}

/* Appends copies of fields to the cloud, leaving out those named in `hidden`. */
static crease_status append_fields(crease_context *context, crease_cloud *cloud,
    const crease_field *fields, size_t count, const crease_field *hidden, size_t hidden_count)
{
    for (size_t i = 0; i < count; i++) {
        if (has_field(hidden, hidden_count, fields[i].name))
            continue;
        if (has_field(cloud->fields, cloud->field_count, fields[i].name))
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "cloud: there are two fields named '%s'; rename one", fields[i].name);
        const crease_status status =
            copy_field(context, &fields[i], cloud->count, &cloud->fields[cloud->field_count++]);
        if (status != CREASE_OK)
            return status;
    }
    return CREASE_OK;
}

static crease_status copy_points(
    crease_context *context, const crease_cloud_parts *parts, crease_cloud *cloud)
{
    cloud->count = parts->count;
    cloud->coordinate_type = parts->coordinate_type;
    cloud->points = crease_duplicate(context, parts->points, 3 * parts->count, sizeof(double));
    if (!cloud->points)
        return CREASE_ERROR_NO_MEMORY;
    if (!parts->normals)
        return CREASE_OK;
    cloud->normals = crease_duplicate(context, parts->normals, 3 * parts->count, sizeof(double));
    return cloud->normals ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

/* The cloud of the parts, with further fields in front of which those of the same name yield. */
static crease_status create(crease_context *context, const crease_cloud_parts *parts,
    const crease_field *further, size_t further_count, crease_cloud **out)
{
    *out = NULL;
    crease_cloud *cloud = crease_allocate(context, 1, sizeof *cloud);
    if (!cloud)
        return CREASE_ERROR_NO_MEMORY;
    crease_status status = copy_points(context, parts, cloud);
    if (status == CREASE_OK) {
        cloud->fields =
            crease_allocate(context, parts->field_count + further_count, sizeof *cloud->fields);
        status = cloud->fields ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    }
    if (status == CREASE_OK)
        status = append_fields(
            context, cloud, parts->fields, parts->field_count, further, further_count);
    if (status == CREASE_OK)
        status = append_fields(context, cloud, further, further_count, NULL, 0);
    if (status == CREASE_OK)
        *out = cloud;
    else
        crease_cloud_free(cloud);
    return status;
}

crease_status crease_cloud_create(
    crease_context *context, const crease_cloud_parts *parts, crease_cloud **out)
{
    *out = NULL;
    const crease_status status = check_points(context, parts);
    return status == CREASE_OK ? create(context, parts, NULL, 0, out) : status;
}

crease_status crease_cloud_with_fields(crease_context *context, const crease_cloud *cloud,
    const crease_field *fields, size_t field_count, crease_cloud **out)
{
    const crease_cloud_parts parts = {.count = cloud->count,
        .points = cloud->points,
        .normals = cloud->normals,
        .fields = cloud->fields,
        .field_count = cloud->field_count,
        .coordinate_type = cloud->coordinate_type};
    return create(context, &parts, fields, field_count, out);
}

void crease_cloud_free(crease_cloud *cloud)
{
    if (!cloud)
        return;
    for (size_t i = 0; i < cloud->field_count; i++) {
        free((void *)(uintptr_t)cloud->fields[i].name);
        free((void *)(uintptr_t)cloud->fields[i].values);
    }
    free(cloud->fields);
    free(cloud->normals);
    free(cloud->points);
    free(cloud);
}

size_t crease_cloud_count(const crease_cloud *cloud)
{
    return cloud->count;
}

const double *crease_cloud_points(const crease_cloud *cloud)
{
    return cloud->points;
}

const double *crease_cloud_normals(const crease_cloud *cloud)
{
    return cloud->normals;
}

crease_type crease_cloud_coordinate_type(const crease_cloud *cloud)
{
    return cloud->coordinate_type;
}

size_t crease_cloud_field_count(const crease_cloud *cloud)
{
    return cloud->field_count;
}

crease_field crease_cloud_field(const crease_cloud *cloud, size_t index)
{
    return index < cloud->field_count ? cloud->fields[index] : (crease_field){.name = NULL};
}

crease_field crease_cloud_find_field(const crease_cloud *cloud, const char *name)
{
    for (size_t i = 0; i < cloud->field_count; i++)
        if (strcmp(cloud->fields[i].name, name) == 0)
            return cloud->fields[i];
    return (crease_field){.name = NULL};
}

double crease_field_value(const crease_field *field, size_t point)
{
    switch (field->type) {
    case CREASE_TYPE_INT8:
        return ((const int8_t *)field->values)[point];
    case CREASE_TYPE_UINT8:
        return ((const uint8_t *)field->values)[point];
    case CREASE_TYPE_INT16:
        return ((const int16_t *)field->values)[point];
    case CREASE_TYPE_UINT16:
        return ((const uint16_t *)field->values)[point];
    case CREASE_TYPE_INT32:
        return ((const int32_t *)field->values)[point];
    case CREASE_TYPE_UINT32:
        return ((const uint32_t *)field->values)[point];
    case CREASE_TYPE_FLOAT32:
        return (double)((const float *)field->values)[point];
    case CREASE_TYPE_FLOAT64:
        return ((const double *)field->values)[point];
    }
    return NAN;
}

void crease_cloud_bounds(const crease_cloud *cloud, double lowest[3], double highest[3])
{
    for (int c = 0; c < 3; c++)
        lowest[c] = highest[c] = cloud->count ? cloud->points[c] : 0.0;
    for (size_t i = 0; i < 3 * cloud->count; i++) {
        lowest[i % 3] = fmin(lowest[i % 3], cloud->points[i]);
        highest[i % 3] = fmax(highest[i % 3], cloud->points[i]);
    }
}
