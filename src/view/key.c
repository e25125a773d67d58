/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/key.h"

#include "view/lettering.h"

#include <math.h>

/* In units of the font's size: a symbol, the space behind it, between entries, a row. */
static const double SYMBOL = 1.7, SPACE = 0.45, BETWEEN = 1.6, ROW = 1.6;

static double entry_width(const crease_canvas *canvas, const crease_legend *legend, size_t index)
{
    const char *name = legend->entries[index].name;
    return (SYMBOL + SPACE) * legend->font +
        crease_lettering_measure(canvas->cairo, name, legend->font).width;
}

/* How many entries from `first` on fit one row, at least one; *width is what they take. */
static size_t row_of(const crease_canvas *canvas, const crease_legend *legend, size_t first,
    double most, double *width)
{
    size_t count = 0;
    *width = 0;
    for (size_t i = first; i < legend->count; i++) {
        const double further =
            entry_width(canvas, legend, i) + (count ? BETWEEN * legend->font : 0);
        if (count && *width + further > most)
            break;
        *width += further;
        count++;
    }
    return count;
}

double crease_legend_measure(const crease_canvas *canvas, crease_legend *legend, double width)
{
    const double most = width - (SYMBOL + SPACE) * legend->font;
    for (size_t i = 0; i < legend->count; i++)
        crease_lettering_fit(canvas->cairo, legend->entries[i].name, legend->font, false, most);
    size_t rows = 0;
    double used = 0;
    for (size_t first = 0; first < legend->count; rows++)
        first += row_of(canvas, legend, first, width, &used);
    return (double)rows * ROW * legend->font;
}

static void draw_symbol(
    const crease_canvas *canvas, const crease_entry *entry, double x, double y, double font)
{
    cairo_t *cairo = canvas->cairo;
    const crease_colour c = entry->colour;
    cairo_set_source_rgb(cairo, c.red, c.green, c.blue);
    if (entry->patch) {
        cairo_rectangle(cairo, x + 0.2 * font, y - 0.42 * font, (SYMBOL - 0.4) * font, 0.84 * font);
        cairo_fill_preserve(cairo);
        cairo_set_source_rgb(cairo, 0.55 * c.red, 0.55 * c.green, 0.6 * c.blue);
        cairo_set_line_width(cairo, canvas->unit);
        cairo_stroke(cairo);
    }
    if (entry->line) {
        cairo_move_to(cairo, x + 0.1 * font, y);
        cairo_line_to(cairo, x + (SYMBOL - 0.1) * font, y);
        cairo_set_line_width(cairo, entry->width * canvas->unit);
        cairo_stroke(cairo);
    }
    if (entry->dot)
        crease_marks_draw_dot(canvas,
            &(crease_dot){
                .spot = {x + SYMBOL / 2 * font, y, 0}, .radius = 0.27 * font, .colour = c},
            1);
}

static void draw_row(const crease_canvas *canvas, const crease_legend *legend, size_t first,
    size_t count, double x, double y)
{
    for (size_t i = first; i < first + count; i++) {
        const crease_entry *entry = &legend->entries[i];
        const double width = entry_width(canvas, legend, i);
        const double text = width - (SYMBOL + SPACE) * legend->font;
        draw_symbol(canvas, entry, x, y, legend->font);
        cairo_set_source_rgb(canvas->cairo, 0.13, 0.13, 0.15);
        crease_lettering_draw(canvas->cairo,
            &(crease_lettering){
                .text = entry->name, .x = x + width - text / 2, .y = y, .size = legend->font});
        x += width + BETWEEN * legend->font;
    }
}

void crease_legend_draw(
    const crease_canvas *canvas, const crease_legend *legend, const crease_area *area)
{
    double y = area->top + ROW / 2 * legend->font;
    for (size_t first = 0; first < legend->count; y += ROW * legend->font) {
        double width = 0;
        const size_t count = row_of(canvas, legend, first, area->right - area->left, &width);
        draw_row(canvas, legend, first, count, (area->left + area->right - width) / 2, y);
        first += count;
    }
}

/* In units of the font's size: from the bar to its numbers, and from these to the title. */
static const double TICK_GAP = 0.55, TITLE_GAP = 0.9;

static double label_width(const crease_canvas *canvas, const crease_bar *bar)
{
    double width = 0;
    for (int i = 0; i < bar->ticks.count; i++)
        width = fmax(
            width, crease_lettering_measure(canvas->cairo, bar->ticks.labels[i], bar->font).width);
    return width;
}

double crease_bar_measure(const crease_canvas *canvas, crease_bar *bar, double height)
{
    bar->ticks = crease_ticks_between(
        bar->range.lowest, bar->range.highest, (int)fmin(6, height / (2.6 * bar->font)));
    crease_lettering_fit(canvas->cairo, bar->title, bar->font, false, height);
    return bar->thickness + (TICK_GAP + TITLE_GAP + 0.8) * bar->font + label_width(canvas, bar);
}

static double bar_y(const crease_bar *bar, const crease_area *inner, double value)
{
    const double t = (value - bar->range.lowest) / (bar->range.highest - bar->range.lowest);
    return inner->bottom + (inner->top - inner->bottom) * t;
}

static void draw_gradient(
    const crease_canvas *canvas, const crease_bar *bar, const crease_area *inner)
{
    enum { STOPS = 64 };
    cairo_pattern_t *pattern = cairo_pattern_create_linear(0, inner->bottom, 0, inner->top);
    for (int i = 0; i <= STOPS; i++) {
        const crease_colour c = crease_map_at(bar->range.map, (double)i / STOPS);
        cairo_pattern_add_color_stop_rgb(pattern, (double)i / STOPS, c.red, c.green, c.blue);
    }
    const double middle = (inner->left + inner->right) / 2, point = bar->thickness * 0.9;
    cairo_t *cairo = canvas->cairo;
    cairo_move_to(cairo, inner->left, inner->bottom);
    if (bar->range.below)
        cairo_line_to(cairo, middle, inner->bottom + point);
    cairo_line_to(cairo, inner->right, inner->bottom);
    cairo_line_to(cairo, inner->right, inner->top);
    if (bar->range.above)
        cairo_line_to(cairo, middle, inner->top - point);
    cairo_line_to(cairo, inner->left, inner->top);
    cairo_close_path(cairo);
    cairo_set_source(cairo, pattern);
    cairo_fill_preserve(cairo);
    cairo_pattern_destroy(pattern);
    cairo_set_source_rgb(cairo, 0.25, 0.25, 0.27);
    cairo_set_line_width(cairo, 1.2 * canvas->unit);
    cairo_stroke(cairo);
}

static void draw_bar_ticks(
    const crease_canvas *canvas, const crease_bar *bar, const crease_area *inner)
{
    cairo_t *cairo = canvas->cairo;
    for (int i = 0; i < bar->ticks.count; i++) {
        const double y = bar_y(bar, inner, bar->ticks.values[i]);
        const crease_extent extent =
            crease_lettering_measure(cairo, bar->ticks.labels[i], bar->font);
        cairo_move_to(cairo, inner->right, y);
        cairo_rel_line_to(cairo, 0.3 * bar->font, 0);
        cairo_stroke(cairo);
        crease_lettering_draw(cairo,
            &(crease_lettering){.text = bar->ticks.labels[i],
                .x = inner->right + TICK_GAP * bar->font + extent.width / 2,
                .y = y,
                .size = bar->font});
    }
}

void crease_bar_draw(const crease_canvas *canvas, const crease_bar *bar, const crease_area *area)
{
    const double end = bar->thickness;
    const crease_area inner = {
        area->left, area->top + end, area->left + bar->thickness, area->bottom - end};
    draw_gradient(canvas, bar, &inner);
    draw_bar_ticks(canvas, bar, &inner);
    crease_lettering_draw(canvas->cairo,
        &(crease_lettering){.text = bar->title,
            .note = bar->ticks.note,
            .power = bar->ticks.power,
            .x = inner.right + (TICK_GAP + TITLE_GAP + 0.4) * bar->font + label_width(canvas, bar),
            .y = (inner.top + inner.bottom) / 2,
            .size = bar->font,
            .upright = true});
}
