/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Writes the page that check_page.py looks at: the two sides of a roof, its data points, their
 * control nets and its ridge, and what is known of them. Point 0 hovers above the others, so that
 * it can be clicked. make_page FILE COUNT: so many points of a wave instead, to see how long they
 * take. */
#include "crease/crease.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROWS = 17, COLUMNS = 9, POINTS = 1 + ROWS * COLUMNS };

static const char title[] = "Roof </title><img src=x onerror=\"window.hacked = 1\"> & co";

static crease_status add_points(crease_context *context, crease_scene *scene)
{
    static double points[3 * POINTS] = {-0.5, -0.5, 0.3}, variances[POINTS] = {1}, heights[POINTS];
    for (int i = 1; i < POINTS; i++) {
        points[3 * i] = ((i - 1) % ROWS - 8) / 8.0;
        points[3 * i + 1] = ((i - 1) / ROWS - 4) / 4.0;
        points[3 * i + 2] = -0.6 * fabs(points[3 * i]);
        variances[i] = exp(-20 * points[3 * i] * points[3 * i]);
    }
    for (int i = 0; i < POINTS; i++)
        heights[i] = points[3 * i + 2];
    const crease_field fields[] = {
        {"variance", CREASE_TYPE_FLOAT64, variances}, {"height <b>", CREASE_TYPE_FLOAT64, heights}};
    const crease_cloud_parts parts = {
        .count = POINTS, .points = points, .fields = fields, .field_count = 2};
    crease_cloud *cloud = NULL;
    crease_status status = crease_cloud_create(context, &parts, &cloud);
    if (status == CREASE_OK)
        status = crease_scene_add_cloud(context, scene, "data points", cloud);
    crease_cloud_free(cloud);
    return status;
}

/* Both sides of the roof slope by 0.6: their planes meet at 61.93 degrees. */
static crease_status describe_roof(crease_context *context, crease_scene *scene)
{
    crease_status status = CREASE_OK;
    for (size_t side = 0; side < 2 && status == CREASE_OK; side++) {
        const double lean = (side ? 0.6 : -0.6) / sqrt(1.36), up = 1 / sqrt(1.36);
        const crease_fact facts[] = {{.name = "type", .text = "plane"},
            {.name = "place", .numbers = {0, 0, 0}, .number_count = 3},
            {.name = "normal", .numbers = {lean, 0, up}, .number_count = 3},
            {.name = "normal_error", .numbers = {0.001, 0.002, 0}, .number_count = 3},
            {.name = "rms", .numbers = {0.0125 * (double)(side + 1)}, .number_count = 1}};
        status = crease_scene_describe(context, scene, side, facts, sizeof facts / sizeof *facts);
    }
    return status;
}

static crease_status add_roof(crease_context *context, crease_scene *scene)
{
    static const double knots[] = {0, 0, 1, 1};
    static const double nets[2][12] = {{-1, -1, -0.6, -1, 1, -0.6, 0, -1, 0, 0, 1, 0},
        {0, -1, 0, 0, 1, 0, 1, -1, -0.6, 1, 1, -0.6}};
    crease_surface *sides[2] = {NULL, NULL};
    crease_status status = CREASE_OK;
    for (int side = 0; side < 2 && status == CREASE_OK; side++) {
        const crease_surface_parts parts = {.order = {2, 2},
            .count = {2, 2},
            .knots = {knots, knots},
            .control_points = nets[side]};
        status = crease_surface_create(context, &parts, &sides[side]);
    }
    if (status == CREASE_OK)
        status = crease_scene_add_surfaces(
            context, scene, "surface", (const crease_surface *const *)sides, 2, true);
    if (status == CREASE_OK)
        status = describe_roof(context, scene);
    crease_surface_free(sides[0]);
    crease_surface_free(sides[1]);
    return status;
}

static crease_status add_ridge(crease_context *context, crease_scene *scene)
{
    static const double knots[] = {0, 0, 1, 1}, ends[] = {0, -1, 0, 0, 1, 0};
    crease_curve *ridge = NULL;
    crease_status status = crease_curve_create(context, 2, 2, knots, ends, &ridge);
    if (status == CREASE_OK)
        status = crease_scene_add_curves(
            context, scene, "crease", (const crease_curve *const *)&ridge, 1);
    const crease_fact facts[] = {{.name = "angle", .numbers = {118.07}, .number_count = 1},
        {.name = "angle_error", .numbers = {0.25}, .number_count = 1}};
    if (status == CREASE_OK)
        status = crease_scene_describe(context, scene, 0, facts, 2);
    crease_curve_free(ridge);
    return status;
}

static crease_status add_all(crease_context *context, crease_scene *scene)
{
    crease_status status = add_points(context, scene);
    if (status == CREASE_OK)
        status = add_roof(context, scene);
    return status == CREASE_OK ? add_ridge(context, scene) : status;
}

/* A wave with a little noise, in rows, as a scanner gives it. */
static crease_status add_wave(crease_context *context, crease_scene *scene, size_t count)
{
    double *points = calloc(count, 3 * sizeof *points);
    float *heights = calloc(count, sizeof *heights);
    int32_t *regions = calloc(count, sizeof *regions);
    const size_t side = (size_t)ceil(sqrt((double)count));
    crease_status status = points && heights && regions ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        const double noise = (double)((uint32_t)i * 2654435761U) / 4294967296.0 - 0.5;
        double *p = points + 3 * i;
        p[0] = 100.0 * (double)(i % side) / (double)side;
        p[1] = 100.0 * (double)(i / side) / (double)side;
        p[2] = 8 * sin(0.12 * p[0]) * cos(0.1 * p[1]) + 0.02 * noise;
        heights[i] = (float)(0.02 * noise);
        regions[i] = (int32_t)(p[0] / 20) + 5 * (int32_t)(p[1] / 20);
    }
    const crease_field fields[] = {
        {"deviation", CREASE_TYPE_FLOAT32, heights}, {"region", CREASE_TYPE_INT32, regions}};
    const crease_cloud_parts parts = {
        .count = count, .points = points, .fields = fields, .field_count = 2};
    crease_cloud *cloud = NULL;
    if (status == CREASE_OK)
        status = crease_cloud_create(context, &parts, &cloud);
    if (status == CREASE_OK)
        status = crease_scene_add_cloud(context, scene, "wave", cloud);
    crease_cloud_free(cloud);
    free(points);
    free(heights);
    free(regions);
    return status;
}

int main(int count, char **arguments)
{
    crease_context *context = NULL;
    crease_scene *scene = NULL;
    if (count < 2 || count > 3 || crease_context_create(NULL, &context) != CREASE_OK)
        return 2;
    crease_status status = crease_scene_create(context, count == 2 ? title : "wave", &scene);
    if (status == CREASE_OK)
        status = count == 2 ? add_all(context, scene)
                            : add_wave(context, scene, strtoull(arguments[2], NULL, 10));
    if (status == CREASE_OK)
        status = crease_page_write(context, scene, arguments[1]);
    if (status != CREASE_OK)
        fprintf(stderr, "make_page: %s\n", crease_context_message(context));
    crease_scene_free(scene);
    crease_context_free(context);
    return status == CREASE_OK ? 0 : 1;
}
