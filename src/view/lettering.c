/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/lettering.h"

#include <stdio.h>
#include <string.h>

static const double CAPITAL = 0.73;  /* height of capitals and digits over the size of the font */
static const double EXPONENT = 0.72; /* size of an exponent over that of its line */

void crease_lettering_prepare(cairo_t *cairo)
{
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(cairo, options);
    cairo_font_options_destroy(options);
}

static void select(cairo_t *cairo, double size, bool italic, bool bold)
{
    cairo_select_font_face(cairo, "sans-serif",
        italic ? CAIRO_FONT_SLANT_ITALIC : CAIRO_FONT_SLANT_NORMAL,
        bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, size);
}

static double advance(cairo_t *cairo, const char *text)
{
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, text, &extents);
    return extents.x_advance;
}

crease_extent crease_lettering_measure(cairo_t *cairo, const char *text, double size)
{
    select(cairo, size, false, false);
    return (crease_extent){advance(cairo, text), CAPITAL * size};
}

/* Goes through text, note and exponent, each in its font; returns the length of all. */
static double go(cairo_t *cairo, const crease_lettering *l, bool draw)
{
    char power[16] = "";
    if (l->power)
        snprintf(power, sizeof power, "%s%d", l->power < 0 ? "\xE2\x88\x92" : "",
            l->power < 0 ? -l->power : l->power);
    const char *const parts[] = {l->text, l->note ? l->note : "", power};
    double length = 0;
    for (int i = 0; i < 3; i++) {
        if (!parts[i][0])
            continue;
        select(
            cairo, i == 2 ? EXPONENT * l->size : l->size, l->italic && i == 0, l->bold && i == 0);
        if (draw) {
            cairo_move_to(cairo, length, i == 2 ? -0.42 * l->size : 0);
            cairo_show_text(cairo, parts[i]);
        }
        length += advance(cairo, parts[i]);
    }
    return length;
}

crease_extent crease_lettering_extent(cairo_t *cairo, const crease_lettering *lettering)
{
    const double length = go(cairo, lettering, false), height = CAPITAL * lettering->size;
    return lettering->upright ? (crease_extent){height, length} : (crease_extent){length, height};
}

void crease_lettering_draw(cairo_t *cairo, const crease_lettering *lettering)
{
    const double length = go(cairo, lettering, false);
    cairo_save(cairo);
    cairo_translate(cairo, lettering->x, lettering->y);
    if (lettering->upright)
        cairo_rotate(cairo, -3.14159265358979323846 / 2);
    cairo_translate(cairo, -length / 2, CAPITAL * lettering->size / 2);
    go(cairo, lettering, true);
    cairo_restore(cairo);
}

/* Cuts the last character, and an ellipsis behind it, and puts an ellipsis there. */
static void cut(char *text)
{
    static const char ellipsis[] = "\xE2\x80\xA6";
    size_t end = strlen(text);
    if (end >= 3 && strcmp(text + end - 3, ellipsis) == 0)
        end -= 3;
    while (end > 0 && ((unsigned char)text[--end] & 0xC0) == 0x80)
        continue;
    strcpy(text + end, ellipsis);
}

void crease_lettering_fit(cairo_t *cairo, char *text, double size, bool bold, double width)
{
    select(cairo, size, false, bold);
    while (strlen(text) > 3 && advance(cairo, text) > width)
        cut(text);
}
