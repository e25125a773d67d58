/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "region.h"

#include <stdio.h>

static const struct {
    const char *one, *many, *member;
} names[REGION_TYPES] = {
    [CREASE_REGION_PLANE] = {"plane", "planes", "planes"},
    [CREASE_REGION_SPHERE] = {"sphere", "spheres", "spheres"},
    [CREASE_REGION_CYLINDER] = {"cylinder", "cylinders", "cylinders"},
    [CREASE_REGION_CONE] = {"cone", "cones", "cones"},
    [CREASE_REGION_TORUS] = {"torus", "tori", "tori"},
    [CREASE_REGION_FREEFORM] = {"free form", "free forms", "free_forms"},
};

void region_counts_text(const region_counts *counts, char *text, size_t size)
{
    size_t used = 0;
    for (int i = 0; i < REGION_TYPES && used < size; i++)
        if (counts->of[i] > 0)
            used += (size_t)snprintf(text + used, size - used, "%s%zu %s", used ? ", " : "",
                counts->of[i], counts->of[i] > 1 ? names[i].many : names[i].one);
    if (!used)
        snprintf(text, size, "none");
}

void region_counts_describe(cJSON *object, const region_counts *counts)
{
    for (int i = 0; i < REGION_TYPES; i++)
        cJSON_AddNumberToObject(object, names[i].member, (double)counts->of[i]);
}

/* The errors of what the type has. */
static void describe_errors(cJSON *object, const crease_region *region)
{
    const crease_region_type type = region->type;
    cJSON_AddNumberToObject(object, "place_error", region->place_error);
    if (type == CREASE_REGION_FREEFORM)
        return;
    if (type != CREASE_REGION_SPHERE)
        cJSON_AddNumberToObject(object, type == CREASE_REGION_PLANE ? "normal_error" : "axis_error",
            region->direction_error);
    if (type != CREASE_REGION_PLANE)
        cJSON_AddNumberToObject(object, "radius_error", region->radius_error);
    if (type == CREASE_REGION_CONE)
        cJSON_AddNumberToObject(object, "slope_error", region->shape_error);
    if (type == CREASE_REGION_TORUS)
        cJSON_AddNumberToObject(object, "tube_radius_error", region->shape_error);
}

void region_describe(cJSON *object, const crease_region *region)
{
    const double *number = region->parameters;
    const crease_region_type type = region->type;
    cJSON_AddStringToObject(object, "type", names[type].one);
    if (type == CREASE_REGION_FREEFORM) {
        describe_errors(object, region);
        return;
    }
    report_vector(object, "place", number);
    number += 3;
    if (type != CREASE_REGION_SPHERE) {
        report_vector(object, type == CREASE_REGION_PLANE ? "normal" : "axis", number);
        number += 3;
    }
    if (type != CREASE_REGION_PLANE)
        cJSON_AddNumberToObject(object, "radius", *number++);
    if (type == CREASE_REGION_CONE)
        cJSON_AddNumberToObject(object, "slope", *number);
    if (type == CREASE_REGION_TORUS)
        cJSON_AddNumberToObject(object, "tube_radius", *number);
    describe_errors(object, region);
}
