/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/marks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIECES_PER_STROKE = 400 };
static const double PIECE = 2.5;       /* longest piece of a line that is seen or hidden */
static const double HIDDEN_DOT = 0.22; /* opacity of a dot behind a surface */
static const double TWO_PI = 6.28318530717958647692;

static bool seen(const crease_canvas *canvas, crease_spot spot, double slack)
{
    return !canvas->raster || crease_raster_sees(canvas->raster, spot, slack);
}

static crease_spot between(crease_spot a, crease_spot b, double t)
{
    return (crease_spot){
        a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.depth + (b.depth - a.depth) * t};
}

/* A path that is stroked now and then, so that cairo never has to join very many pieces. */
typedef struct stroke {
    const crease_canvas *canvas;
    const crease_pen *pen;
    bool wants_seen;
    crease_spot end;
    int pieces;
} stroke;

static void finish(stroke *s)
{
    const crease_colour c = s->pen->colour;
    cairo_set_source_rgba(
        s->canvas->cairo, c.red, c.green, c.blue, s->wants_seen ? s->pen->seen : s->pen->hidden);
    cairo_set_line_width(s->canvas->cairo, s->pen->width * s->canvas->unit);
    cairo_stroke(s->canvas->cairo);
    s->pieces = 0;
}

static void draw_piece(stroke *s, crease_spot from, crease_spot to)
{
    const bool joins = s->pieces > 0 && s->end.x == from.x && s->end.y == from.y;
    if (!joins && s->pieces >= PIECES_PER_STROKE)
        finish(s);
    if (!joins || s->pieces == 0)
        cairo_move_to(s->canvas->cairo, from.x, from.y);
    cairo_line_to(s->canvas->cairo, to.x, to.y);
    s->end = to;
    s->pieces++;
}

/* Adds the parts of a straight line that are seen (or hidden) to the stroke, each in one piece. */
static void draw_link(stroke *s, crease_spot from, crease_spot to)
{
    const double length = hypot(to.x - from.x, to.y - from.y);
    const int count = s->canvas->raster ? (int)ceil(fmin(1e5, length / PIECE)) + 1 : 1;
    int first = -1;
    for (int i = 0; i <= count; i++) {
        const bool wanted = i < count &&
            seen(s->canvas, between(from, to, (i + 0.5) / count), s->canvas->slack) ==
                s->wants_seen;
        if (wanted && first < 0)
            first = i;
        if (!wanted && first >= 0) {
            draw_piece(s, between(from, to, (double)first / count),
                i == count ? to : between(from, to, (double)i / count));
            first = -1;
        }
    }
}

static void draw_side(const crease_canvas *canvas, const crease_polylines *lines,
    const crease_pen *pen, bool wants_seen)
{
    stroke s = {.canvas = canvas, .pen = pen, .wants_seen = wants_seen};
    for (size_t i = 0; i < lines->link_count; i++) {
        const double *from = &lines->nodes[3 * (size_t)lines->links[2 * i]];
        const double *to = &lines->nodes[3 * (size_t)lines->links[2 * i + 1]];
        draw_link(&s, crease_camera_project(&canvas->camera, from),
            crease_camera_project(&canvas->camera, to));
    }
    finish(&s);
}

void crease_marks_draw_lines(
    const crease_canvas *canvas, const crease_polylines *lines, const crease_pen *pen)
{
    cairo_set_line_cap(canvas->cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(canvas->cairo, CAIRO_LINE_JOIN_ROUND);
    if (pen->hidden > 0 && canvas->raster)
        draw_side(canvas, lines, pen, false);
    draw_side(canvas, lines, pen, true);
}

void crease_marks_draw_dot(const crease_canvas *canvas, const crease_dot *dot, double opacity)
{
    cairo_t *cairo = canvas->cairo;
    const crease_colour c = dot->colour;
    cairo_new_path(cairo);
    cairo_arc(cairo, dot->spot.x, dot->spot.y, dot->radius, 0, TWO_PI);
    cairo_set_source_rgba(cairo, c.red, c.green, c.blue, opacity);
    cairo_fill_preserve(cairo);
    cairo_set_source_rgba(cairo, 0.45 * c.red, 0.45 * c.green, 0.45 * c.blue, opacity);
    cairo_set_line_width(cairo, fmin(0.9 * canvas->unit, 0.2 * dot->radius));
    cairo_stroke(cairo);
}

static int farthest_first(const void *a, const void *b)
{
    const crease_dot *p = a, *q = b;
    if (p->spot.depth != q->spot.depth)
        return p->spot.depth < q->spot.depth ? 1 : -1;
    return (p->order > q->order) - (p->order < q->order);
}

void crease_marks_draw_dots(const crease_canvas *canvas, crease_dot *dots, size_t count)
{
    qsort(dots, count, sizeof *dots, farthest_first);
    for (size_t i = 0; i < count; i++) {
        const bool visible = seen(canvas, dots[i].spot, dots[i].radius + canvas->slack);
        crease_marks_draw_dot(canvas, &dots[i], visible ? 1 : HIDDEN_DOT);
    }
}
