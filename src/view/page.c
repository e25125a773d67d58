/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The page is the viewer with two places filled: its title, and the data. A JSON element describes
 * the scene; each array of numbers is an element of its own, packed as view/pack.h says.
 * Coordinates are relative to the centre of the scene and divided by its scale, so that single
 * precision suffices. Everything is written as it comes: the page is never whole in memory. */
#include "base/memory.h"
#include "view/base64.h"
#include "view/markup.h"
#include "view/pack.h"
#include "view/palette.h"
#include "view/text.h"
#include "view/viewer.h"
#include "write/output.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct page {
    crease_context *context;
    const crease_scene *scene;
    crease_output *output;
    double lowest[3], highest[3], centre[3], scale;
    unsigned next_part;   /* number of the next array of numbers */
    crease_status status; /* of the numbers */
} page;

/* ------------------------------------------------------------------------------ description -- */

static void write_colour(crease_output *output, crease_colour c)
{
    crease_output_format(output, "\"colour\":\"#%02x%02x%02x\"", (unsigned)lround(255 * c.red),
        (unsigned)lround(255 * c.green), (unsigned)lround(255 * c.blue));
}

/* "name":"part-7", a part that write_parts() will write in the same order. */
static void promise_part(page *p, const char *name)
{
    crease_output_format(p->output, ",\"%s\":\"part-%u\"", name, p->next_part++);
}

static crease_status describe_field(page *p, const crease_field *field, size_t count)
{
    crease_range range;
    crease_status status = crease_range_of_field(p->context, field, count, &range);
    char *name = status == CREASE_OK ? crease_text_clean(p->context, field->name) : NULL;
    if (!name)
        return CREASE_ERROR_NO_MEMORY;
    crease_output_text(p->output, "{");
    crease_markup_member(p->output, "name", name);
    crease_output_format(p->output,
        ",\"type\":\"%s\",\"map\":\"%s\",\"lowest\":", crease_pack_of_type(field->type).name,
        range.map == CREASE_MAP_DIVERGING ? "diverging" : "sequential");
    crease_output_double(p->output, range.lowest);
    crease_output_text(p->output, ",\"highest\":");
    crease_output_double(p->output, range.highest);
    promise_part(p, "data");
    crease_output_text(p->output, "}");
    free(name);
    return CREASE_OK;
}

static crease_status describe_cloud(page *p, const crease_cloud *cloud)
{
    const size_t count = crease_cloud_count(cloud);
    crease_output_format(p->output, ",\"count\":%zu", count);
    promise_part(p, "positions");
    crease_output_text(p->output, ",\"fields\":[");
    crease_status status = CREASE_OK;
    for (size_t i = 0; status == CREASE_OK && i < crease_cloud_field_count(cloud); i++) {
        const crease_field field = crease_cloud_field(cloud, i);
        crease_output_text(p->output, i ? "," : "");
        status = describe_field(p, &field, count);
    }
    crease_output_text(p->output, "]");
    return status;
}

static void describe_mesh(page *p, const crease_mesh *mesh)
{
    crease_output_format(p->output, ",\"triangles\":%zu", crease_mesh_triangle_count(mesh));
    promise_part(p, "positions");
    promise_part(p, "normals");
    promise_part(p, "indices");
    promise_part(p, "owners");
}

static void describe_curves(page *p, const crease_layer *layer)
{
    crease_output_format(p->output, ",\"curves\":%zu,\"begins\":[", layer->items);
    for (size_t i = 0; i < layer->items; i++)
        crease_output_format(p->output, i ? ",%" PRIu32 : "%" PRIu32, layer->begins[i]);
    crease_output_text(p->output, "]");
}

/* [item, name, text or numbers] of everything that is known. */
static void describe_facts(page *p, const crease_facts *facts)
{
    crease_output_text(p->output, ",\"facts\":[");
    for (size_t i = 0; i < facts->count; i++) {
        const crease_fact *fact = &facts->all[i].fact;
        crease_output_format(p->output, i ? ",[%zu," : "[%zu,", facts->all[i].item);
        crease_markup_string(p->output, fact->name);
        crease_output_text(p->output, ",");
        if (fact->text)
            crease_markup_string(p->output, fact->text);
        else
            crease_markup_numbers(p->output, fact->numbers, fact->number_count);
        crease_output_text(p->output, "]");
    }
    crease_output_text(p->output, "]");
}

static crease_status describe_layer(page *p, size_t index)
{
    static const char *const kinds[] = {"points", "surface", "net", "curves"};
    const crease_layer *layer = &p->scene->layers[index];
    crease_status status = CREASE_OK;
    crease_output_text(p->output, index ? ",{" : "{");
    crease_markup_member(p->output, "kind", kinds[layer->kind]);
    crease_output_text(p->output, ",");
    crease_markup_member(p->output, "name", layer->name);
    crease_output_text(p->output, ",");
    write_colour(p->output, crease_palette_of_layer(p->scene, index));
    if (layer->cloud)
        status = describe_cloud(p, layer->cloud);
    if (layer->mesh)
        describe_mesh(p, layer->mesh);
    if (!layer->cloud) {
        if (layer->kind == CREASE_LAYER_NET)
            crease_output_format(p->output, ",\"count\":%zu", layer->lines.node_count);
        if (layer->kind == CREASE_LAYER_CURVES)
            describe_curves(p, layer);
        promise_part(p, "nodes");
        promise_part(p, "links");
    }
    describe_facts(p, &layer->facts);
    crease_output_text(p->output, "}");
    return status;
}

static void write_map(page *p, const char *name, crease_map map)
{
    uint8_t table[256][3];
    crease_map_table(map, table);
    crease_output_format(p->output, "\"%s\":\"", name);
    crease_base64 encoder;
    crease_base64_begin(&encoder, p->output);
    for (int i = 0; i < 256; i++)
        for (int c = 0; c < 3; c++)
            crease_base64_put(&encoder, table[i][c], 1);
    crease_base64_end(&encoder);
    crease_output_text(p->output, "\"");
}

static crease_status write_description(page *p)
{
    crease_output *output = p->output;
    crease_output_text(output, "<script type=\"application/json\" id=\"crease-scene\">{");
    crease_markup_member(output, "version", crease_version());
    crease_output_text(output, ",");
    crease_markup_member(output, "title", p->scene->title);
    crease_output_text(output, ",");
    crease_output_text(output, "\"centre\":");
    crease_markup_numbers(output, p->centre, 3);
    crease_output_text(output, ",\"scale\":");
    crease_output_double(output, p->scale);
    crease_output_text(output, ",\"lowest\":");
    crease_markup_numbers(output, p->lowest, 3);
    crease_output_text(output, ",\"highest\":");
    crease_markup_numbers(output, p->highest, 3);
    crease_output_text(output, ",\"maps\":{");
    write_map(p, "sequential", CREASE_MAP_SEQUENTIAL);
    crease_output_text(output, ",");
    write_map(p, "diverging", CREASE_MAP_DIVERGING);
    crease_output_text(output, "},\"layers\":[");
    crease_status status = CREASE_OK;
    for (size_t i = 0; status == CREASE_OK && i < p->scene->layer_count; i++)
        status = describe_layer(p, i);
    crease_output_text(output, "]}</script>\n");
    return status;
}

/* ----------------------------------------------------------------------------------- numbers -- */

/* Begins an array of its own; NULL, with the page's status set, when memory ran out. */
static crease_pack *begin_part(page *p, crease_pack_form form)
{
    crease_pack *pack = NULL;
    crease_output_format(p->output,
        "<script type=\"application/octet-stream\" id=\"part-%u\" data-form=\"%s\">",
        p->next_part++, form.name);
    if (p->status == CREASE_OK)
        p->status = crease_pack_open(p->context, p->output, form, &pack);
    return pack;
}

static void end_part(page *p, crease_pack *pack)
{
    crease_pack_close(pack);
    crease_output_text(p->output, "</script>\n");
}

static void write_positions(page *p, const double *points, size_t count)
{
    crease_pack *const pack = begin_part(p, crease_pack_lattice);
    for (size_t i = 0; pack && i < 3 * count; i++)
        crease_pack_put_coordinate(pack, (points[i] - p->centre[i % 3]) / p->scale);
    end_part(p, pack);
}

static void write_directions(page *p, const double *values, size_t count)
{
    crease_pack *const pack = begin_part(p, crease_pack_direction);
    for (size_t i = 0; pack && i < 3 * count; i++)
        crease_pack_put_coordinate(pack, values[i]);
    end_part(p, pack);
}

static void write_indices(page *p, crease_pack_form form, const uint32_t *indices, size_t count)
{
    crease_pack *const pack = begin_part(p, form);
    for (size_t i = 0; pack && i < count; i++)
        crease_pack_put(pack, indices[i]);
    end_part(p, pack);
}

static void write_field(page *p, const crease_field *field, size_t count)
{
    const bool fraction = field->type >= CREASE_TYPE_FLOAT32;
    crease_pack *const pack = begin_part(p, crease_pack_of_type(field->type));
    for (size_t i = 0; pack && i < count; i++) {
        const double value = crease_field_value(field, i);
        if (fraction)
            crease_pack_put_float(pack, (float)value);
        else
            crease_pack_put(pack, (uint32_t)(int64_t)value);
    }
    end_part(p, pack);
}

static void write_cloud(page *p, const crease_cloud *cloud)
{
    const size_t count = crease_cloud_count(cloud);
    write_positions(p, crease_cloud_points(cloud), count);
    for (size_t i = 0; i < crease_cloud_field_count(cloud); i++) {
        const crease_field field = crease_cloud_field(cloud, i);
        write_field(p, &field, count);
    }
}

static void write_mesh(page *p, const crease_mesh *mesh)
{
    const size_t vertices = crease_mesh_vertex_count(mesh);
    const size_t triangles = crease_mesh_triangle_count(mesh);
    write_positions(p, crease_mesh_vertices(mesh), vertices);
    write_directions(p, crease_mesh_normals(mesh), vertices);
    write_indices(p, crease_pack_triangles, crease_mesh_triangles(mesh), 3 * triangles);
    write_indices(p, crease_pack_of_type(CREASE_TYPE_UINT32), crease_mesh_owners(mesh), triangles);
}

static void write_layer(page *p, const crease_layer *layer)
{
    if (layer->cloud)
        write_cloud(p, layer->cloud);
    if (layer->mesh)
        write_mesh(p, layer->mesh);
    if (!layer->cloud) {
        write_positions(p, layer->lines.nodes, layer->lines.node_count);
        write_indices(p, crease_pack_links, layer->lines.links, 2 * layer->lines.link_count);
    }
}

static crease_status write_data(page *p)
{
    p->next_part = 0;
    p->status = write_description(p);
    if (p->status != CREASE_OK)
        return p->status;
    p->next_part = 0;
    for (size_t i = 0; i < p->scene->layer_count && !crease_output_failed(p->output); i++) {
        write_layer(p, &p->scene->layers[i]);
        crease_progress(p->context, (double)(i + 1) / (double)p->scene->layer_count);
    }
    return p->status;
}

/* -------------------------------------------------------------------------------------- page -- */

/* Where the marker stands in the viewer from `from` on; the build made sure that it does. */
static size_t find_marker(const char *marker, size_t from)
{
    const size_t length = strlen(marker);
    while (from + length <= crease_viewer_page_size &&
        memcmp(crease_viewer_page + from, marker, length) != 0)
        from++;
    return from;
}

static crease_status write_page(page *p)
{
    static const char title[] = "<!--crease:title-->", data[] = "<!--crease:data-->";
    const size_t at_title = find_marker(title, 0), behind_title = at_title + strlen(title);
    const size_t at_data = find_marker(data, behind_title), behind_data = at_data + strlen(data);
    crease_output_bytes(p->output, crease_viewer_page, at_title);
    crease_markup_html(p->output, p->scene->title[0] ? p->scene->title : "crease");
    crease_output_bytes(p->output, crease_viewer_page + behind_title, at_data - behind_title);
    const crease_status status = write_data(p);
    crease_output_bytes(
        p->output, crease_viewer_page + behind_data, crease_viewer_page_size - behind_data);
    return status;
}

crease_status crease_page_write(
    crease_context *context, const crease_scene *scene, const char *path)
{
    page p = {.context = context, .scene = scene, .scale = 0};
    if (!crease_scene_bounds(scene, p.lowest, p.highest))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "page: the scene shows nothing; add a cloud with points, surfaces or curves");
    for (int c = 0; c < 3; c++) {
        p.centre[c] = p.lowest[c] + (p.highest[c] - p.lowest[c]) / 2;
        p.scale = fmax(p.scale, (p.highest[c] - p.lowest[c]) / 2);
    }
    if (!(p.scale > 0))
        p.scale = 1;
    static const char *const extensions[] = {"html", "htm"};
    size_t extension = 0;
    crease_status status = crease_output_choose(context, path, extensions, 2, &extension);
    if (status != CREASE_OK)
        return status;
    crease_stage(context, "writing the page");
    status = crease_output_open(context, path, &p.output);
    if (status == CREASE_OK)
        status = write_page(&p);
    return crease_output_close(context, p.output, status);
}
