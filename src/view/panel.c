/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/panel.h"

#include "base/memory.h"
#include "view/key.h"
#include "view/lettering.h"
#include "view/palette.h"
#include "view/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* More dots than this become part of the picture instead of one drawn circle each. */
enum { DRAWN_DOTS_MOST = 6000, PICTURE_SAMPLES = 3, SHORT_TEXT = 200, SHADES = 512 };
static const double FONT = 21, MARGIN = 18; /* in 1/1200 of a panel's width */

/* All that the steps of drawing one panel share. */
typedef struct drawing {
    crease_canvas canvas;
    const crease_panel *panel;
    crease_axes axes;
    crease_range range; /* of the field that colours the points */
    crease_legend legend;
    crease_bar bar;
    crease_dot *dots;
    size_t dot_count;
    bool coloured;
} drawing;

/* --------------------------------------------------------------------------------- colours -- */

static crease_field colouring_field(const crease_layer *layer, const char *name)
{
    return layer->cloud && name ? crease_cloud_find_field(layer->cloud, name)
                                : (crease_field){.name = NULL};
}

/* The names of all fields of the scene, for a message. */
static void list_fields(const crease_scene *scene, char *out, size_t size)
{
    size_t used = 0;
    out[0] = 0;
    for (size_t i = 0; i < scene->layer_count; i++)
        for (size_t f = 0; scene->layers[i].cloud && used < size &&
             f < crease_cloud_field_count(scene->layers[i].cloud);
             f++)
            used += (size_t)snprintf(out + used, size - used, "%s%s", used ? ", " : "",
                crease_cloud_field(scene->layers[i].cloud, f).name);
}

/* The range of the first cloud that has the field. */
static crease_status find_range(drawing *d)
{
    const char *name = d->panel->options.colour_by;
    const crease_scene *scene = d->panel->scene;
    if (!name)
        return CREASE_OK;
    for (size_t i = 0; i < scene->layer_count; i++) {
        const crease_field field = colouring_field(&scene->layers[i], name);
        if (!field.name)
            continue;
        d->coloured = true;
        return crease_range_of_field(
            d->canvas.context, &field, crease_cloud_count(scene->layers[i].cloud), &d->range);
    }
    char fields[256];
    list_fields(scene, fields, sizeof fields);
    return crease_fail(d->canvas.context, CREASE_ERROR_ARGUMENT,
        "figure: no cloud has a field named '%s' to colour by; there %s%s", name,
        fields[0] ? "is: " : "is none", fields);
}

/* ---------------------------------------------------------------------------------- layout -- */

/* At most SHORT_TEXT bytes of clean text, whole characters, with room for an ellipsis. */
static void shorten(const char *text, char *out, size_t size)
{
    size_t used = 0;
    while (text[used]) {
        const size_t length = crease_text_sequence(text + used);
        if (used + length + 4 > size)
            break;
        memcpy(out + used, text + used, length);
        used += length;
    }
    out[used] = 0;
}

static crease_entry entry_of(const drawing *d, size_t index)
{
    const crease_layer *layer = &d->panel->scene->layers[index];
    crease_entry entry = {.colour = crease_palette_of_layer(d->panel->scene, index),
        .dot = layer->kind == CREASE_LAYER_POINTS || layer->kind == CREASE_LAYER_NET,
        .line = layer->kind == CREASE_LAYER_NET || layer->kind == CREASE_LAYER_CURVES,
        .patch = layer->kind == CREASE_LAYER_SURFACE,
        .width = layer->kind == CREASE_LAYER_CURVES ? 4.5 : 1.8};
    if (d->coloured && colouring_field(layer, d->panel->options.colour_by).name)
        entry.colour =
            crease_map_at(d->range.map, d->range.map == CREASE_MAP_DIVERGING ? 0.9 : 0.5);
    shorten(layer->name, entry.name, sizeof entry.name);
    return entry;
}

static crease_status prepare_legend(drawing *d)
{
    const size_t count = d->panel->scene->layer_count;
    d->legend.font = 0.92 * d->axes.font;
    d->legend.entries = crease_allocate(d->canvas.context, count, sizeof *d->legend.entries);
    if (!d->legend.entries)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        if (d->panel->scene->layers[i].name[0])
            d->legend.entries[d->legend.count++] = entry_of(d, i);
    return CREASE_OK;
}

static crease_status prepare_bar(drawing *d)
{
    if (!d->coloured)
        return CREASE_OK;
    char *clean = crease_text_clean(d->canvas.context, d->panel->options.colour_by);
    if (!clean)
        return CREASE_ERROR_NO_MEMORY;
    d->bar = (crease_bar){
        .range = d->range, .font = 0.92 * d->axes.font, .thickness = 0.9 * d->axes.font};
    shorten(clean, d->bar.title, sizeof d->bar.title);
    free(clean);
    return CREASE_OK;
}

static void draw_title(drawing *d, crease_area *room)
{
    char title[SHORT_TEXT], letter[8] = "";
    shorten(d->panel->scene->title, title, sizeof title);
    if (d->panel->letter)
        snprintf(letter, sizeof letter, "(%c) ", d->panel->letter);
    if (!title[0] && !letter[0])
        return;
    const double size = 1.15 * d->axes.font;
    const crease_extent taken = crease_lettering_measure(d->canvas.cairo, letter, 1.1 * size);
    crease_lettering_fit(
        d->canvas.cairo, title, size, false, room->right - room->left - taken.width);
    cairo_set_source_rgb(d->canvas.cairo, 0.08, 0.08, 0.10);
    crease_lettering_draw(d->canvas.cairo,
        &(crease_lettering){.text = letter,
            .note = title,
            .x = (room->left + room->right) / 2,
            .y = room->top + 0.6 * size,
            .size = size,
            .bold = true});
    room->top += 1.9 * size;
}

static void place_legend(drawing *d, crease_area *room)
{
    if (d->legend.count == 0)
        return;
    const double height = crease_legend_measure(&d->canvas, &d->legend, room->right - room->left);
    crease_area area = *room;
    area.top = room->bottom - height;
    crease_legend_draw(&d->canvas, &d->legend, &area);
    room->bottom = area.top - 0.8 * d->axes.font;
}

static void place_bar(drawing *d, crease_area *room)
{
    if (!d->coloured)
        return;
    const double height = room->bottom - room->top, cut = 0.14 * height;
    const double width = crease_bar_measure(&d->canvas, &d->bar, height - 2 * cut);
    const crease_area area = {
        room->right - width, room->top + cut, room->right, room->bottom - cut};
    crease_bar_draw(&d->canvas, &d->bar, &area);
    room->right -= width + 1.3 * d->axes.font;
}

/* Scales and moves the camera until the box with its numbers fills the room. What the numbers need
 * depends on the scale, and the other way round, so this is repeated. */
static void fit_camera(drawing *d, const crease_area *room)
{
    crease_camera *camera = &d->canvas.camera;
    const double width = room->right - room->left, height = room->bottom - room->top;
    const bool numbered = d->panel->options.axes;
    camera->scale = 1;
    const crease_area bare = crease_axes_cover(&d->axes, d->canvas.cairo, camera, false);
    const double bare_width = fmax(1e-300, bare.right - bare.left);
    const double bare_height = fmax(1e-300, bare.bottom - bare.top);
    camera->scale = 0.8 * fmin(width / bare_width, height / bare_height);
    for (int pass = 0; pass < 6; pass++) {
        crease_axes_arrange(&d->axes, d->canvas.cairo, camera);
        const crease_area cover = crease_axes_cover(&d->axes, d->canvas.cairo, camera, numbered);
        const double across = cover.right - cover.left - bare_width * camera->scale;
        const double down = cover.bottom - cover.top - bare_height * camera->scale;
        camera->x += (room->left + room->right - cover.left - cover.right) / 2;
        camera->y += (room->top + room->bottom - cover.top - cover.bottom) / 2;
        if (pass < 5)
            camera->scale = fmax(0.2 * camera->scale,
                fmin((width - across) / bare_width, (height - down) / bare_height));
    }
    crease_axes_arrange(&d->axes, d->canvas.cairo, camera);
}

static void place_camera(drawing *d, const crease_area *room)
{
    double centre[3], diagonal = 0;
    for (int c = 0; c < 3; c++) {
        centre[c] = (d->axes.lowest[c] + d->axes.highest[c]) / 2;
        diagonal = hypot(diagonal, d->axes.highest[c] - d->axes.lowest[c]);
    }
    d->canvas.camera =
        crease_camera_at(d->panel->options.azimuth, d->panel->options.elevation, centre);
    d->canvas.camera.x = (room->left + room->right) / 2;
    d->canvas.camera.y = (room->top + room->bottom) / 2;
    fit_camera(d, room);
    d->canvas.slack = 1.5 * d->canvas.unit + 0.002 * diagonal * d->canvas.camera.scale;
}

/* --------------------------------------------------------------------------------- drawing -- */

/* The radius of a cloud's dots: smaller the more there are, but never too small to be seen. */
static double dot_radius(const drawing *d, size_t count)
{
    const double radius = fmin(5.5, fmax(1.1, 90 / sqrt((double)count + 1)));
    return fmax(0.6, d->canvas.unit * radius);
}

static bool is_drawn(const crease_layer *layer)
{
    return layer->cloud && crease_cloud_count(layer->cloud) <= DRAWN_DOTS_MOST;
}

static bool has_net_dots(const crease_layer *layer)
{
    return layer->kind == CREASE_LAYER_NET && layer->lines.node_count <= DRAWN_DOTS_MOST;
}

static crease_colour dot_colour(
    const drawing *d, const crease_field *field, crease_colour plain, size_t point)
{
    return field->name ? crease_range_colour(&d->range, crease_field_value(field, point)) : plain;
}

/* The field that colours this layer in this drawing; name NULL for none. */
static crease_field field_of(const drawing *d, const crease_layer *layer)
{
    return colouring_field(layer, d->coloured ? d->panel->options.colour_by : NULL);
}

/* Colours of a range looked up in steps, because a large cloud asks for very many. */
typedef struct shades {
    crease_colour steps[SHADES];
    const crease_range *range;
} shades;

static shades shades_of(const crease_range *range)
{
    shades s = {.range = range};
    for (int i = 0; i < SHADES; i++)
        s.steps[i] = crease_map_at(range->map, i / (SHADES - 1.0));
    return s;
}

static crease_colour shade_at(const shades *s, double value)
{
    if (!isfinite(value))
        return crease_range_colour(s->range, value);
    const double t = (value - s->range->lowest) / (s->range->highest - s->range->lowest);
    return s->steps[lround((SHADES - 1) * fmin(1, fmax(0, t)))];
}

static void picture_cloud(const drawing *d, size_t index)
{
    const crease_layer *layer = &d->panel->scene->layers[index];
    const crease_field field = field_of(d, layer);
    const crease_colour plain = crease_palette_of_layer(d->panel->scene, index);
    const shades s = shades_of(&d->range);
    const double *points = crease_cloud_points(layer->cloud);
    const size_t count = crease_cloud_count(layer->cloud);
    const double radius = dot_radius(d, count);
    for (size_t i = 0; i < count; i++) {
        crease_spot spot = crease_camera_project(&d->canvas.camera, &points[3 * i]);
        spot.depth -= d->canvas.slack;
        const crease_colour colour =
            field.name ? shade_at(&s, crease_field_value(&field, i)) : plain;
        crease_raster_draw_dot(d->canvas.raster, spot, radius, colour);
    }
}

/* Surfaces and large clouds, with what is behind hidden sample by sample. */
static crease_status draw_picture(drawing *d, const crease_area *room)
{
    const crease_scene *scene = d->panel->scene;
    bool needed = false;
    for (size_t i = 0; i < scene->layer_count; i++)
        needed = needed || scene->layers[i].mesh ||
            (scene->layers[i].cloud && !is_drawn(&scene->layers[i]));
    if (!needed)
        return CREASE_OK;
    const double left = floor(room->left), top = floor(room->top);
    crease_status status =
        crease_raster_create(d->canvas.context, left, top, ceil(room->right) - left,
            ceil(room->bottom) - top, d->panel->density, PICTURE_SAMPLES, &d->canvas.raster);
    if (status != CREASE_OK)
        return status;
    for (size_t i = 0; i < scene->layer_count; i++)
        if (scene->layers[i].mesh)
            crease_raster_draw_mesh(d->canvas.raster, scene->layers[i].mesh, &d->canvas.camera,
                crease_palette_of_layer(scene, i));
        else if (scene->layers[i].cloud && !is_drawn(&scene->layers[i]))
            picture_cloud(d, i);
    crease_raster_shade_dots(d->canvas.raster, d->coloured ? 0.75 : 0.45);
    return crease_raster_paint(d->canvas.context, d->canvas.raster, d->canvas.cairo);
}

static crease_pen pen_of(const drawing *d, size_t index)
{
    const crease_layer *layer = &d->panel->scene->layers[index];
    const crease_colour colour = crease_palette_of_layer(d->panel->scene, index);
    if (layer->kind == CREASE_LAYER_SURFACE)
        return (crease_pen){{0.27, 0.34, 0.48}, 1.0, 0.55, 0};
    if (layer->kind == CREASE_LAYER_CURVES)
        return (crease_pen){colour, 4.5, 1, 0.25};
    return (crease_pen){colour, has_net_dots(layer) ? 1.8 : 0.8, 0.9, 0.2};
}

static void draw_lines(const drawing *d)
{
    for (int kind = CREASE_LAYER_SURFACE; kind <= CREASE_LAYER_CURVES; kind++)
        for (size_t i = 0; i < d->panel->scene->layer_count; i++) {
            const crease_layer *layer = &d->panel->scene->layers[i];
            const crease_pen pen = pen_of(d, i);
            if ((int)layer->kind == kind)
                crease_marks_draw_lines(&d->canvas, &layer->lines, &pen);
        }
}

static void add_dot(drawing *d, const double place[3], double radius, crease_colour colour)
{
    d->dots[d->dot_count] =
        (crease_dot){crease_camera_project(&d->canvas.camera, place), radius, colour, d->dot_count};
    d->dot_count++;
}

static void add_dots(drawing *d, size_t index)
{
    const crease_layer *layer = &d->panel->scene->layers[index];
    const crease_colour plain = crease_palette_of_layer(d->panel->scene, index);
    if (is_drawn(layer)) {
        const crease_field field = field_of(d, layer);
        const size_t count = crease_cloud_count(layer->cloud);
        for (size_t i = 0; i < count; i++)
            add_dot(d, &crease_cloud_points(layer->cloud)[3 * i], dot_radius(d, count),
                dot_colour(d, &field, plain, i));
    }
    if (has_net_dots(layer))
        for (size_t i = 0; i < layer->lines.node_count; i++)
            add_dot(d, &layer->lines.nodes[3 * i],
                fmin(5 * d->canvas.unit, dot_radius(d, layer->lines.node_count)), plain);
}

static crease_status draw_dots(drawing *d)
{
    const crease_scene *scene = d->panel->scene;
    size_t most = 0;
    for (size_t i = 0; i < scene->layer_count; i++) {
        const crease_layer *layer = &scene->layers[i];
        most += is_drawn(layer) ? crease_cloud_count(layer->cloud) : 0;
        most += has_net_dots(layer) ? layer->lines.node_count : 0;
    }
    d->dots = crease_allocate(d->canvas.context, most, sizeof *d->dots);
    if (!d->dots)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < scene->layer_count; i++)
        add_dots(d, i);
    crease_marks_draw_dots(&d->canvas, d->dots, d->dot_count);
    return CREASE_OK;
}

/* Everything inside the room that title, legend and bar leave. */
static crease_status draw_scene(drawing *d, const crease_area *room)
{
    place_camera(d, room);
    if (d->panel->options.axes)
        crease_axes_draw(&d->axes, d->canvas.cairo, &d->canvas.camera);
    crease_status status = draw_picture(d, room);
    if (status == CREASE_OK) {
        draw_lines(d);
        status = draw_dots(d);
    }
    return status;
}

static crease_status draw_all(drawing *d)
{
    const crease_panel *panel = d->panel;
    const double margin = MARGIN * d->canvas.unit;
    crease_area room = {panel->left + margin, panel->top + margin,
        panel->left + panel->options.width - margin, panel->top + panel->options.height - margin};
    crease_status status = find_range(d);
    if (status == CREASE_OK)
        status = prepare_legend(d);
    if (status == CREASE_OK)
        status = prepare_bar(d);
    if (status != CREASE_OK)
        return status;
    draw_title(d, &room);
    place_legend(d, &room);
    place_bar(d, &room);
    return draw_scene(d, &room);
}

crease_status crease_panel_draw(crease_context *context, const crease_panel *panel, cairo_t *cairo)
{
    double lowest[3], highest[3];
    if (!crease_scene_bounds(panel->scene, lowest, highest))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "figure: the scene shows nothing; add a cloud with points, surfaces or curves");
    const double unit = fmin(panel->options.width / 1200.0, panel->options.height / 900.0);
    drawing d = {.canvas = {.context = context, .cairo = cairo, .unit = unit}, .panel = panel};
    d.axes.unit = unit;
    d.axes.font = FONT * unit;
    crease_axes_enclose(&d.axes, lowest, highest);
    crease_lettering_prepare(cairo);
    const crease_status status = draw_all(&d);
    crease_raster_free(d.canvas.raster);
    free(d.legend.entries);
    free(d.dots);
    return status;
}
