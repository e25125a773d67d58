/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cloud/cloud.h"
#include "facets/draw.h"
#include "read/formats.h"

crease_read_options crease_read_options_default(void)
{
    return (crease_read_options){.mesh_points = -1};
}

crease_status crease_source_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    const crease_format *format =
        crease_format_find(source->path, source->bytes, source->size, source->size);
    if (format && format->read)
        return format->read(context, source, options, out);
    if (format)
        return crease_fail(context, CREASE_ERROR_FORMAT,
            "%s: is %s, not a cloud; give points as PLY, PCD, XYZ, TXT, CSV, ASC, PTS, LAS, OBJ, "
            "STL or "
            "OFF",
            source->name, format->description);
    return crease_fail(context, CREASE_ERROR_FORMAT,
        "%s: is no cloud that is known here; give points as PLY, PCD, XYZ, TXT, CSV, ASC, PTS, "
        "OBJ, STL or OFF",
        source->name);
}

/* Puts points drawn on a mesh in the place of its vertices, where that is asked for or these alone
 * do not tell its faces. Where vertices were left out the faces are not known by their numbers any
 * more. */
static crease_status draw(crease_context *context, crease_facets *facets,
    const crease_read_options *options, crease_cloud **cloud)
{
    const size_t triangles = facets->triangle_count, vertices = facets->vertex_count;
    crease_cloud *drawn = NULL;
    if (!triangles || (options->mesh_points < 0 && crease_facets_dense(facets)))
        return CREASE_OK;
    const crease_status status = crease_facets_draw(context, facets, options->mesh_points, &drawn);
    if (status != CREASE_OK)
        return status;
    crease_cloud_free(*cloud);
    *cloud = drawn;
    if (options->mesh_points < 0)
        crease_warn(context,
            "%s: is a mesh, and its %zu vertices alone do not tell its shape: %zu points are drawn "
            "on its "
            "%zu triangles (--mesh-points 0: the vertices)",
            facets->name, vertices, drawn->count, triangles);
    return CREASE_OK;
}

crease_status crease_source_faces(crease_context *context, const crease_source *source,
    const crease_cloud *cloud, crease_facets *out)
{
    const crease_format *const format =
        crease_format_find(source->path, source->bytes, source->size, source->size);
    *out = (crease_facets){.name = source->name};
    if (!format->faces)
        return CREASE_OK;
    crease_status status =
        crease_facets_begin(context, out, source->name, cloud->points, cloud->count);
    if (status == CREASE_OK)
        status = format->faces(context, source, out);
    if (status != CREASE_OK)
        crease_facets_free(out);
    return status;
}

static crease_status draw_on_faces(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **cloud)
{
    crease_facets facets;
    if (options->mesh_points == 0 || options->skip_invalid)
        return CREASE_OK;
    crease_status status = crease_source_faces(context, source, *cloud, &facets);
    if (status == CREASE_OK)
        status = draw(context, &facets, options, cloud);
    crease_facets_free(&facets);
    return status;
}

crease_status crease_cloud_read(crease_context *context, const char *path,
    const crease_read_options *options, crease_cloud **out)
{
    *out = NULL;
    const crease_read_options chosen = options ? *options : crease_read_options_default();
    crease_source source;
    crease_stage(context, "reading");
    crease_status status = crease_source_open(context, path, &source);
    if (status != CREASE_OK)
        return status;
    status = crease_source_read(context, &source, &chosen, out);
    if (status == CREASE_OK)
        status = draw_on_faces(context, &source, &chosen, out);
    if (status != CREASE_OK) {
        crease_cloud_free(*out);
        *out = NULL;
    }
    crease_source_free(&source);
    return status;
}
