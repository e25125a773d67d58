/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/axes.h"

#include "view/lettering.h"

#include <math.h>
#include <string.h>

static const double TICK = 7, GAP = 8; /* length of a tick, then space before its number */

void crease_axes_enclose(crease_axes *axes, const double lowest[3], const double highest[3])
{
    double longest = 0;
    for (int c = 0; c < 3; c++)
        longest = fmax(longest, highest[c] - lowest[c]);
    if (!(longest > 0))
        longest = 1;
    for (int c = 0; c < 3; c++) {
        const double half = (highest[c] - lowest[c]) / 2;
        const double padded = fmax(half + 0.03 * longest, 0.08 * longest);
        axes->lowest[c] = lowest[c] + half - padded;
        axes->highest[c] = lowest[c] + half + padded;
    }
}

/* Sets the two ends of the edge along one axis; sides tell where it lies on the other two. */
static void set_edge(crease_axes *axes, int along, const bool high[3])
{
    crease_axis *axis = &axes->axes[along];
    for (int c = 0; c < 3; c++)
        axis->from[c] = axis->to[c] = high[c] ? axes->highest[c] : axes->lowest[c];
    axis->from[along] = axes->lowest[along];
    axis->to[along] = axes->highest[along];
}

/* x and y are numbered along the bottom edges nearest to the eye, z along the upright edge at the
 * left, so that no number falls on the box. */
static void choose_edges(crease_axes *axes, const crease_camera *camera)
{
    const bool near_high[3] = {camera->eye[0] > 0, camera->eye[1] > 0, camera->eye[2] < 0};
    set_edge(axes, 0, near_high);
    set_edge(axes, 1, near_high);
    set_edge(axes, 2, (const bool[3]){camera->right[0] < 0, camera->right[1] < 0, false});
}

/* The unit vector across the edge that leads away from the middle of the box. */
static void choose_outward(crease_axis *axis, const crease_camera *camera)
{
    const crease_spot a = crease_camera_project(camera, axis->from);
    const crease_spot b = crease_camera_project(camera, axis->to);
    const double length = hypot(b.x - a.x, b.y - a.y);
    axis->outward_x = length > 0 ? -(b.y - a.y) / length : -1;
    axis->outward_y = length > 0 ? (b.x - a.x) / length : 0;
    const double away = axis->outward_x * ((a.x + b.x) / 2 - camera->x) +
        axis->outward_y * ((a.y + b.y) / 2 - camera->y);
    if (away < 0) {
        axis->outward_x = -axis->outward_x;
        axis->outward_y = -axis->outward_y;
    }
}

static void choose_ticks(crease_axis *axis, int along, double font, const crease_camera *camera)
{
    const crease_spot a = crease_camera_project(camera, axis->from);
    const crease_spot b = crease_camera_project(camera, axis->to);
    const double length = hypot(b.x - a.x, b.y - a.y);
    const double room = font * (fabs(axis->outward_x) > 0.8 ? 2.2 : 3.4);
    const int most = (int)fmax(2, fmin(6, floor(length / room)));
    axis->ticks = (crease_ticks){0};
    for (int more = 0; axis->ticks.count < 2 && more < 4 && length > 2 * font; more++)
        axis->ticks = crease_ticks_between(axis->from[along], axis->to[along], most + more);
}

static void choose_reach(crease_axis *axis, cairo_t *cairo, double font)
{
    axis->reach = 0;
    for (int i = 0; i < axis->ticks.count; i++) {
        const crease_extent extent = crease_lettering_measure(cairo, axis->ticks.labels[i], font);
        axis->reach = fmax(axis->reach,
            fabs(axis->outward_x) * extent.width + fabs(axis->outward_y) * extent.height);
    }
}

void crease_axes_arrange(crease_axes *axes, cairo_t *cairo, const crease_camera *camera)
{
    choose_edges(axes, camera);
    for (int along = 0; along < 3; along++) {
        choose_outward(&axes->axes[along], camera);
        choose_ticks(&axes->axes[along], along, axes->font, camera);
        choose_reach(&axes->axes[along], cairo, axes->font);
    }
}

/* Where a text lies whose near side is `away` from the edge at the value. */
static crease_spot text_middle(const crease_axis *axis, int along, const crease_camera *camera,
    double value, double away, crease_extent extent)
{
    double place[3];
    memcpy(place, axis->from, sizeof place);
    place[along] = value;
    crease_spot spot = crease_camera_project(camera, place);
    const double half =
        fabs(axis->outward_x) * extent.width / 2 + fabs(axis->outward_y) * extent.height / 2;
    spot.x += axis->outward_x * (away + half);
    spot.y += axis->outward_y * (away + half);
    return spot;
}

typedef void visit_text(void *user, const crease_lettering *text);

/* True when two texts come closer than a third of a line. */
static bool crowd(const crease_lettering *a, crease_extent m, const crease_lettering *b,
    crease_extent n, double font)
{
    return fabs(a->x - b->x) < (m.width + n.width) / 2 + 0.33 * font &&
        fabs(a->y - b->y) < (m.height + n.height) / 2 + 0.33 * font;
}

/* Numbers that would come too close to the one before are left out. */
static void visit_ticks(const crease_axes *axes, int along, cairo_t *cairo,
    const crease_camera *camera, visit_text *visit, void *user)
{
    const crease_axis *axis = &axes->axes[along];
    crease_lettering last = {.text = NULL};
    crease_extent last_extent = {0, 0};
    for (int i = 0; i < axis->ticks.count; i++) {
        const char *label = axis->ticks.labels[i];
        const crease_extent extent = crease_lettering_measure(cairo, label, axes->font);
        const crease_spot spot = text_middle(
            axis, along, camera, axis->ticks.values[i], (TICK + GAP) * axes->unit, extent);
        const crease_lettering text = {.text = label, .x = spot.x, .y = spot.y, .size = axes->font};
        if (last.text && crowd(&last, last_extent, &text, extent, axes->font))
            continue;
        visit(user, &text);
        last = text;
        last_extent = extent;
    }
}

static void visit_title(const crease_axes *axes, int along, cairo_t *cairo,
    const crease_camera *camera, visit_text *visit, void *user)
{
    static const char *const names[] = {"x", "y", "z"};
    const crease_axis *axis = &axes->axes[along];
    if (axis->ticks.count == 0)
        return;
    crease_lettering title = {.text = names[along],
        .size = 1.1 * axes->font,
        .italic = true,
        .note = axis->ticks.note,
        .power = axis->ticks.power,
        .upright = fabs(axis->outward_x) > 0.9 && axis->ticks.note[0]};
    crease_extent extent = crease_lettering_extent(cairo, &title);
    const double middle = (axis->from[along] + axis->to[along]) / 2;
    const double away = (TICK + 2.2 * GAP) * axes->unit + axis->reach;
    const crease_spot spot = text_middle(axis, along, camera, middle, away, extent);
    title.x = spot.x;
    title.y = spot.y;
    visit(user, &title);
}

static void visit_all(const crease_axes *axes, cairo_t *cairo, const crease_camera *camera,
    visit_text *visit, void *user)
{
    for (int along = 0; along < 3; along++) {
        visit_ticks(axes, along, cairo, camera, visit, user);
        visit_title(axes, along, cairo, camera, visit, user);
    }
}

typedef struct covering {
    cairo_t *cairo;
    crease_area area;
} covering;

static void cover(crease_area *area, double x, double y, double half_width, double half_height)
{
    area->left = fmin(area->left, x - half_width);
    area->right = fmax(area->right, x + half_width);
    area->top = fmin(area->top, y - half_height);
    area->bottom = fmax(area->bottom, y + half_height);
}

static void cover_text(void *user, const crease_lettering *text)
{
    covering *c = user;
    const crease_extent extent = crease_lettering_extent(c->cairo, text);
    cover(&c->area, text->x, text->y, extent.width / 2, extent.height / 2);
}

static void corner(const crease_axes *axes, int number, double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = number >> c & 1 ? axes->highest[c] : axes->lowest[c];
}

crease_area crease_axes_cover(
    const crease_axes *axes, cairo_t *cairo, const crease_camera *camera, bool numbered)
{
    covering c = {cairo, {camera->x, camera->y, camera->x, camera->y}};
    for (int number = 0; number < 8; number++) {
        double place[3];
        corner(axes, number, place);
        const crease_spot spot = crease_camera_project(camera, place);
        cover(&c.area, spot.x, spot.y, 0, 0);
    }
    if (numbered)
        visit_all(axes, cairo, camera, cover_text, &c);
    return c.area;
}

static void draw_text(void *user, const crease_lettering *text)
{
    crease_lettering_draw(user, text);
}

static void line_between(
    cairo_t *cairo, const crease_camera *camera, const double from[3], const double to[3])
{
    const crease_spot a = crease_camera_project(camera, from);
    const crease_spot b = crease_camera_project(camera, to);
    cairo_move_to(cairo, a.x, a.y);
    cairo_line_to(cairo, b.x, b.y);
}

/* The pane across an axis, on the side away from the eye. */
static void pane_path(
    const crease_axes *axes, int across, cairo_t *cairo, const crease_camera *camera)
{
    const int u = (across + 1) % 3, v = (across + 2) % 3;
    for (int i = 0; i < 4; i++) {
        double place[3];
        place[across] = camera->eye[across] > 0 ? axes->lowest[across] : axes->highest[across];
        place[u] = i == 1 || i == 2 ? axes->highest[u] : axes->lowest[u];
        place[v] = i >= 2 ? axes->highest[v] : axes->lowest[v];
        const crease_spot spot = crease_camera_project(camera, place);
        if (i == 0)
            cairo_move_to(cairo, spot.x, spot.y);
        else
            cairo_line_to(cairo, spot.x, spot.y);
    }
    cairo_close_path(cairo);
}

/* The grid of an axis's ticks on the pane across another one. */
static void grid_path(
    const crease_axes *axes, int along, int across, cairo_t *cairo, const crease_camera *camera)
{
    const int other = 3 - along - across;
    const crease_ticks *ticks = &axes->axes[along].ticks;
    for (int i = 0; i < ticks->count; i++) {
        double from[3], to[3];
        from[across] = to[across] =
            camera->eye[across] > 0 ? axes->lowest[across] : axes->highest[across];
        from[along] = to[along] = ticks->values[i];
        from[other] = axes->lowest[other];
        to[other] = axes->highest[other];
        line_between(cairo, camera, from, to);
    }
}

static void draw_panes(const crease_axes *axes, cairo_t *cairo, const crease_camera *camera)
{
    static const double shades[] = {0.955, 0.97, 0.94};
    for (int across = 0; across < 3; across++) {
        pane_path(axes, across, cairo, camera);
        cairo_set_source_rgb(cairo, shades[across], shades[across], shades[across] + 0.008);
        cairo_fill(cairo);
        for (int along = 0; along < 3; along++)
            if (along != across)
                grid_path(axes, along, across, cairo, camera);
        cairo_set_source_rgb(cairo, 0.85, 0.85, 0.865);
        cairo_set_line_width(cairo, 1.1 * axes->unit);
        cairo_stroke(cairo);
    }
    for (int across = 0; across < 3; across++)
        pane_path(axes, across, cairo, camera);
    cairo_set_source_rgb(cairo, 0.72, 0.72, 0.74);
    cairo_stroke(cairo);
}

static void draw_edge(
    const crease_axes *axes, int along, cairo_t *cairo, const crease_camera *camera)
{
    const crease_axis *axis = &axes->axes[along];
    line_between(cairo, camera, axis->from, axis->to);
    for (int i = 0; i < axis->ticks.count; i++) {
        double place[3];
        memcpy(place, axis->from, sizeof place);
        place[along] = axis->ticks.values[i];
        const crease_spot spot = crease_camera_project(camera, place);
        cairo_move_to(cairo, spot.x, spot.y);
        cairo_rel_line_to(
            cairo, axis->outward_x * TICK * axes->unit, axis->outward_y * TICK * axes->unit);
    }
    cairo_set_source_rgb(cairo, 0.25, 0.25, 0.27);
    cairo_set_line_width(cairo, 1.5 * axes->unit);
    cairo_stroke(cairo);
}

void crease_axes_draw(const crease_axes *axes, cairo_t *cairo, const crease_camera *camera)
{
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    draw_panes(axes, cairo, camera);
    for (int along = 0; along < 3; along++)
        draw_edge(axes, along, cairo, camera);
    cairo_set_source_rgb(cairo, 0.13, 0.13, 0.15);
    visit_all(axes, cairo, camera, draw_text, cairo);
}
