/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/scene.h"

#include "base/memory.h"
#include "view/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

crease_status crease_scene_create(crease_context *context, const char *title, crease_scene **out)
{
    *out = NULL;
    crease_scene *scene = crease_allocate(context, 1, sizeof *scene);
    if (!scene)
        return CREASE_ERROR_NO_MEMORY;
    scene->title = crease_text_clean(context, title);
    if (!scene->title) {
        crease_scene_free(scene);
        return CREASE_ERROR_NO_MEMORY;
    }
    *out = scene;
    return CREASE_OK;
}

static void clear_layer(crease_layer *layer)
{
    free(layer->name);
    crease_cloud_free(layer->cloud);
    crease_mesh_free(layer->mesh);
    crease_polylines_free(&layer->lines);
    crease_facts_free(&layer->facts);
    free(layer->begins);
}

void crease_scene_free(crease_scene *scene)
{
    if (!scene)
        return;
    for (size_t i = 0; i < scene->layer_count; i++)
        clear_layer(&scene->layers[i]);
    free(scene->layers);
    free(scene->title);
    free(scene);
}

/* Begins a layer at the end of the scene; finish_layer() takes it away again on failure. */
static crease_layer *begin_layer(crease_context *context, crease_scene *scene,
    crease_layer_kind kind, const char *name, size_t items)
{
    crease_layer *layers =
        crease_reallocate(context, scene->layers, scene->layer_count + 1, sizeof *layers);
    if (!layers)
        return NULL;
    scene->layers = layers;
    char *clean = crease_text_clean(context, name);
    if (!clean)
        return NULL;
    crease_layer *layer = &layers[scene->layer_count++];
    *layer = (crease_layer){.kind = kind, .name = clean, .items = items};
    return layer;
}

static crease_status finish_layer(crease_scene *scene, crease_status status)
{
    if (status != CREASE_OK)
        clear_layer(&scene->layers[--scene->layer_count]);
    return status;
}

crease_status crease_scene_add_cloud(
    crease_context *context, crease_scene *scene, const char *name, const crease_cloud *cloud)
{
    crease_layer *layer = begin_layer(context, scene, CREASE_LAYER_POINTS, name, 1);
    if (!layer)
        return CREASE_ERROR_NO_MEMORY;
    return finish_layer(scene, crease_cloud_with_fields(context, cloud, NULL, 0, &layer->cloud));
}

static crease_status check_count(crease_context *context, const char *what, size_t count)
{
    if (count > 0)
        return CREASE_OK;
    return crease_fail(
        context, CREASE_ERROR_ARGUMENT, "scene: a layer without %s; give at least one", what);
}

/* Lines of constant parameter: eight cells a side for one surface, fewer when there are many. */
static crease_status add_parameter_lines(crease_context *context, crease_layer *layer,
    const crease_surface *const *surfaces, size_t count)
{
    const int cells = (int)fmax(1, round(8 / sqrt((double)count)));
    crease_status status = CREASE_OK;
    for (size_t i = 0; status == CREASE_OK && i < count; i++)
        status = crease_polylines_add_surface(context, &layer->lines, surfaces[i], cells);
    return status;
}

crease_status crease_scene_add_nets(crease_context *context, crease_scene *scene, const char *name,
    const crease_surface *const *surfaces, size_t count)
{
    char title[160];
    if (count == 0)
        return check_count(context, "nets", count);
    snprintf(title, sizeof title, "%s control net", name ? name : "");
    crease_layer *layer = begin_layer(context, scene, CREASE_LAYER_NET, title, count);
    crease_status status = layer ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (!layer)
        return status;
    for (size_t i = 0; status == CREASE_OK && i < count; i++)
        status = crease_polylines_add_net(context, &layer->lines, surfaces[i]);
    return finish_layer(scene, status);
}

crease_status crease_scene_add_surfaces(crease_context *context, crease_scene *scene,
    const char *name, const crease_surface *const *surfaces, size_t count, bool nets)
{
    crease_status status = check_count(context, "surfaces", count);
    if (status != CREASE_OK)
        return status;
    crease_layer *layer = begin_layer(context, scene, CREASE_LAYER_SURFACE, name, count);
    if (!layer)
        return CREASE_ERROR_NO_MEMORY;
    status = crease_mesh_create(context, surfaces, count, 0, &layer->mesh);
    if (status == CREASE_OK)
        status = add_parameter_lines(context, layer, surfaces, count);
    status = finish_layer(scene, status);
    if (status != CREASE_OK || !nets)
        return status;
    status = crease_scene_add_nets(context, scene, name, surfaces, count);
    return status == CREASE_OK ? status : finish_layer(scene, status);
}

static size_t owner_count(const crease_mesh *mesh)
{
    const size_t triangles = crease_mesh_triangle_count(mesh);
    const uint32_t *const owners = crease_mesh_owners(mesh);
    size_t count = 0;
    for (size_t i = 0; i < triangles; i++)
        count = owners[i] >= count ? (size_t)owners[i] + 1 : count;
    return count;
}

crease_status crease_scene_add_mesh(
    crease_context *context, crease_scene *scene, const char *name, const crease_mesh *mesh)
{
    const crease_mesh_parts parts = {.vertex_count = crease_mesh_vertex_count(mesh),
        .triangle_count = crease_mesh_triangle_count(mesh),
        .vertices = crease_mesh_vertices(mesh),
        .triangles = crease_mesh_triangles(mesh),
        .owners = crease_mesh_owners(mesh)};
    crease_status status = check_count(context, "triangles", parts.triangle_count);
    if (status != CREASE_OK)
        return status;
    crease_layer *layer =
        begin_layer(context, scene, CREASE_LAYER_SURFACE, name, owner_count(mesh));
    if (!layer)
        return CREASE_ERROR_NO_MEMORY;
    status = crease_mesh_from_parts(context, &parts, &layer->mesh);
    if (status == CREASE_OK)
        status = crease_polylines_add_borders(context, &layer->lines, layer->mesh);
    return finish_layer(scene, status);
}

crease_status crease_scene_add_curves(crease_context *context, crease_scene *scene,
    const char *name, const crease_curve *const *curves, size_t count)
{
    crease_status status = check_count(context, "curves", count);
    if (status != CREASE_OK)
        return status;
    crease_layer *layer = begin_layer(context, scene, CREASE_LAYER_CURVES, name, count);
    if (!layer)
        return CREASE_ERROR_NO_MEMORY;
    layer->begins = crease_allocate(context, count, sizeof *layer->begins);
    status = layer->begins ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; status == CREASE_OK && i < count; i++) {
        layer->begins[i] = (uint32_t)layer->lines.link_count;
        status = crease_polylines_add_curve(context, &layer->lines, curves[i]);
    }
    return finish_layer(scene, status);
}

crease_status crease_scene_describe(crease_context *context, crease_scene *scene, size_t item,
    const crease_fact *facts, size_t count)
{
    size_t index = scene->layer_count;
    while (index > 0 && scene->layers[index - 1].kind == CREASE_LAYER_NET)
        index--;
    if (index == 0)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "scene: there is nothing to describe; add a cloud, surfaces or curves first");
    for (size_t i = 0; i < count; i++)
        if (facts[i].number_count > sizeof facts[i].numbers / sizeof *facts[i].numbers)
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "scene: a fact of %zu numbers; give 8 at most", facts[i].number_count);
    return crease_facts_add(context, &scene->layers[index - 1].facts, item, facts, count);
}

static void widen(
    const double *points, size_t count, bool *any, double lowest[3], double highest[3])
{
    for (size_t i = 0; i < 3 * count; i++) {
        const size_t c = i % 3;
        lowest[c] = *any || i >= 3 ? fmin(lowest[c], points[i]) : points[i];
        highest[c] = *any || i >= 3 ? fmax(highest[c], points[i]) : points[i];
    }
    *any = *any || count > 0;
}

bool crease_scene_bounds(const crease_scene *scene, double lowest[3], double highest[3])
{
    bool any = false;
    for (size_t i = 0; i < scene->layer_count; i++) {
        const crease_layer *layer = &scene->layers[i];
        if (layer->cloud)
            widen(crease_cloud_points(layer->cloud), crease_cloud_count(layer->cloud), &any, lowest,
                highest);
        if (layer->mesh)
            widen(crease_mesh_vertices(layer->mesh), crease_mesh_vertex_count(layer->mesh), &any,
                lowest, highest);
        widen(layer->lines.nodes, layer->lines.node_count, &any, lowest, highest);
    }
    return any;
}
