/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/memory.h"
#include "view/numbering.h"
#include "view/panel.h"
#include "write/output.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE_LEAST = 64, SIZE_MOST = 16384, PANELS_MOST = 26 };

/* In the order of the extensions below. */
typedef enum figure_format { FORMAT_PNG, FORMAT_SVG, FORMAT_PDF } figure_format;
static const char *const extensions[] = {"png", "svg", "pdf"};

crease_figure_options crease_figure_options_default(void)
{
    return (crease_figure_options){
        .width = 1200, .height = 900, .azimuth = -65, .elevation = 35, .axes = true};
}

/* ------------------------------------------------------------------------------- the file -- */

/* Where cairo's bytes go: straight to the file, or into memory when they must be changed. */
typedef struct sink {
    crease_context *context;
    crease_output *output;
    char *text; /* SVG only */
    size_t used, room;
} sink;

static cairo_status_t write_file(void *user, const unsigned char *bytes, unsigned int count)
{
    sink *to = user;
    crease_output_bytes(to->output, bytes, count);
    return crease_output_failed(to->output) ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
}

static cairo_status_t write_memory(void *user, const unsigned char *bytes, unsigned int count)
{
    sink *to = user;
    if (to->used + count > to->room) {
        const size_t room = 2 * to->room + count;
        char *grown = crease_reallocate(to->context, to->text, room, 1);
        if (!grown)
            return CAIRO_STATUS_NO_MEMORY;
        to->text = grown;
        to->room = room;
    }
    memcpy(to->text + to->used, bytes, count);
    to->used += count;
    return CAIRO_STATUS_SUCCESS;
}

static cairo_surface_t *open_surface(figure_format format, sink *to, double width, double height)
{
    if (format == FORMAT_PNG)
        return cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
    if (format == FORMAT_SVG)
        return cairo_svg_surface_create_for_stream(write_memory, to, width, height);
    cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(write_file, to, width, height);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, "crease");
    return surface;
}

/* Brings the drawing into the file. */
static cairo_status_t close_surface(figure_format format, cairo_surface_t *surface, sink *to)
{
    cairo_status_t status = CAIRO_STATUS_SUCCESS;
    if (format == FORMAT_PNG)
        status = cairo_surface_write_to_png_stream(surface, write_file, to);
    cairo_surface_finish(surface);
    if (status == CAIRO_STATUS_SUCCESS)
        status = cairo_surface_status(surface);
    if (format == FORMAT_SVG && status == CAIRO_STATUS_SUCCESS)
        crease_numbering_write(to->output, to->text, to->used);
    return status;
}

/* ---------------------------------------------------------------------------- the drawing -- */

typedef struct sheet_of_panels {
    const crease_scene *const *scenes;
    crease_figure_options *options; /* count of them, checked, with the size of the first */
    size_t count, columns, rows;
} sheet_of_panels;

static crease_status draw_panels(
    crease_context *context, const sheet_of_panels *sheet, figure_format format, cairo_t *cairo)
{
    cairo_set_source_rgb(cairo, 1, 1, 1);
    cairo_paint(cairo);
    crease_status status = CREASE_OK;
    for (size_t i = 0; status == CREASE_OK && i < sheet->count; i++) {
        const crease_figure_options *options = &sheet->options[i];
        const crease_panel panel = {.scene = sheet->scenes[i],
            .options = *options,
            .left = (double)(i % sheet->columns) * options->width,
            .top = (double)(i / sheet->columns) * options->height,
            .letter = (char)(sheet->count > 1 ? 'a' + (int)i : 0),
            .density = format == FORMAT_PNG ? 1 : 2};
        status = crease_panel_draw(context, &panel, cairo);
        if (status == CREASE_OK && crease_cancelled(context))
            status = crease_fail_cancelled(context);
        crease_progress(context, (double)(i + 1) / (double)sheet->count);
    }
    return status;
}

/* What cairo found wrong, unless something more exact is known already. */
static crease_status status_of(crease_context *context, cairo_status_t cairo, const char *path)
{
    if (cairo == CAIRO_STATUS_SUCCESS || cairo == CAIRO_STATUS_WRITE_ERROR)
        return CREASE_OK;
    return crease_fail(context,
        cairo == CAIRO_STATUS_NO_MEMORY ? CREASE_ERROR_NO_MEMORY : CREASE_ERROR_NUMERIC,
        "%s: the figure cannot be drawn (%s); make it smaller", path,
        cairo_status_to_string(cairo));
}

static crease_status draw_sheet(crease_context *context, const sheet_of_panels *sheet,
    figure_format format, sink *to, const char *path)
{
    const double width = (double)sheet->columns * sheet->options[0].width;
    const double height = (double)sheet->rows * sheet->options[0].height;
    cairo_surface_t *surface = open_surface(format, to, width, height);
    cairo_t *cairo = cairo_create(surface);
    crease_status status = status_of(context, cairo_status(cairo), path);
    if (status == CREASE_OK)
        status = draw_panels(context, sheet, format, cairo);
    if (status == CREASE_OK)
        status = status_of(context, cairo_status(cairo), path);
    cairo_destroy(cairo);
    if (status == CREASE_OK)
        status = status_of(context, close_surface(format, surface, to), path);
    cairo_surface_destroy(surface);
    return status;
}

static crease_status write_sheet(
    crease_context *context, const sheet_of_panels *sheet, const char *path)
{
    size_t format = 0;
    crease_status status = crease_output_choose(context, path, extensions, 3, &format);
    if (status != CREASE_OK)
        return status;
    sink to = {.context = context};
    status = crease_output_open(context, path, &to.output);
    if (status == CREASE_OK)
        status = draw_sheet(context, sheet, (figure_format)format, &to, path);
    free(to.text);
    return crease_output_close(context, to.output, status);
}

/* -------------------------------------------------------------------------------- calls -- */

static crease_status check_options(crease_context *context, const crease_figure_options *options)
{
    if (options->width < SIZE_LEAST || options->width > SIZE_MOST || options->height < SIZE_LEAST ||
        options->height > SIZE_MOST)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "figure: a size of %d x %d; give %d to %d for width and height", options->width,
            options->height, SIZE_LEAST, SIZE_MOST);
    if (!isfinite(options->azimuth) || !(fabs(options->elevation) <= 90))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "figure: an azimuth or elevation out of range; give an elevation of -90 to 90 degrees");
    return CREASE_OK;
}

static crease_status check_sheet(crease_context *context, size_t count, int columns)
{
    if (count >= 1 && count <= PANELS_MOST && columns >= 1)
        return CREASE_OK;
    return crease_fail(context, CREASE_ERROR_ARGUMENT,
        "figure: %zu panels in %d columns; give 1 to %d panels and at least one column", count,
        columns, PANELS_MOST);
}

crease_status crease_figure_panels_write(crease_context *context, const crease_scene *const *scenes,
    const crease_figure_options *options, size_t count, int columns, const char *path)
{
    crease_status status = check_sheet(context, count, columns);
    if (status != CREASE_OK)
        return status;
    sheet_of_panels sheet = {.scenes = scenes, .count = count};
    sheet.columns = (size_t)columns < count ? (size_t)columns : count;
    sheet.rows = (count + sheet.columns - 1) / sheet.columns;
    sheet.options = crease_allocate(context, count, sizeof *sheet.options);
    if (!sheet.options)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        sheet.options[i] = options ? options[i] : crease_figure_options_default();
        sheet.options[i].width = sheet.options[0].width;
        sheet.options[i].height = sheet.options[0].height;
        status = check_options(context, &sheet.options[i]);
    }
    crease_stage(context, "drawing");
    if (status == CREASE_OK)
        status = write_sheet(context, &sheet, path);
    free(sheet.options);
    return status;
}

crease_status crease_figure_write(crease_context *context, const crease_scene *scene,
    const crease_figure_options *options, const char *path)
{
    return crease_figure_panels_write(context, &scene, options, 1, 1, path);
}
