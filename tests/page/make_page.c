/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Writes the page that check_page.py looks at: a roof with a sharp ridge, its data points, its
 * control net and its crease. Point 0 hovers above the others, so that it can be clicked. */
#include "crease/crease.h"

#include <math.h>
#include <stdio.h>

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

static crease_status add_roof(crease_context *context, crease_scene *scene)
{
    static const double along[] = {0, 0, 1, 2, 2}, across[] = {0, 0, 1, 1};
    static const double net[] = {
        -1, -1, -0.6, -1, 1, -0.6, 0, -1, 0, 0, 1, 0, 1, -1, -0.6, 1, 1, -0.6};
    const crease_surface_parts parts = {
        .order = {2, 2}, .count = {3, 2}, .knots = {along, across}, .control_points = net};
    crease_surface *roof = NULL;
    crease_status status = crease_surface_create(context, &parts, &roof);
    if (status == CREASE_OK)
        status = crease_scene_add_surfaces(
            context, scene, "surface", (const crease_surface *const *)&roof, 1, true);
    crease_surface_free(roof);
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
    crease_curve_free(ridge);
    return status;
}

int main(int count, char **arguments)
{
    crease_context *context = NULL;
    crease_scene *scene = NULL;
    if (count != 2 || crease_context_create(NULL, &context) != CREASE_OK)
        return 2;
    crease_status status = crease_scene_create(context, title, &scene);
    if (status == CREASE_OK)
        status = add_points(context, scene);
    if (status == CREASE_OK)
        status = add_roof(context, scene);
    if (status == CREASE_OK)
        status = add_ridge(context, scene);
    if (status == CREASE_OK)
        status = crease_page_write(context, scene, arguments[1]);
    if (status != CREASE_OK)
        fprintf(stderr, "make_page: %s\n", crease_context_message(context));
    crease_scene_free(scene);
    crease_context_free(context);
    return status == CREASE_OK ? 0 : 1;
}
