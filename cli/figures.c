/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Figures 1 to 4 of "Sharp edge preservation using bicubic B-spline surfaces", in its colours: data
 * points green, control points red. */
#include "figures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PANELS = 8, NEVER = 4096 };

typedef struct panels {
    crease_scene *scenes[MOST_PANELS];
    size_t count;
} panels;

static void panels_free(panels *p)
{
    for (size_t i = 0; i < p->count; i++)
        crease_scene_free(p->scenes[i]);
}

/* What one panel shows besides its title; NULL parts are left out. */
typedef struct view {
    const crease_cloud *cloud;
    const crease_surface *surface;
    const crease_sheet *creases;
    bool net;
} view;

static crease_status add_creases(
    crease_context *context, crease_scene *scene, const crease_sheet *sheet)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < crease_sheet_line_count(sheet) && status == CREASE_OK; i++) {
        crease_curve *curve = NULL;
        status = crease_sheet_line_curve(context, sheet, i, &curve);
        if (status == CREASE_OK)
            status = crease_scene_add_curves(
                context, scene, "crease", (const crease_curve *const *)&curve, 1);
        crease_curve_free(curve);
    }
    return status;
}

static crease_status add_panel(crease_context *context, panels *p, const char *title, view v)
{
    crease_scene *scene = NULL;
    crease_status status = crease_scene_create(context, title, &scene);
    if (status == CREASE_OK)
        p->scenes[p->count++] = scene;
    if (status == CREASE_OK && v.surface)
        status = crease_scene_add_surfaces(context, scene, "surface", &v.surface, 1, v.net);
    if (status == CREASE_OK && v.cloud)
        status = crease_scene_add_cloud(context, scene, "data points", v.cloud);
    if (status == CREASE_OK && v.creases)
        status = add_creases(context, scene, v.creases);
    return status;
}

static crease_status write_panels(crease_context *context, const panels *p, int columns,
    const char *folder, const char *name, report *r)
{
    static const char *const extensions[] = {"png", "svg"};
    crease_figure_options options[MOST_PANELS];
    for (size_t i = 0; i < p->count; i++) {
        options[i] = crease_figure_options_default();
        options[i].width = 900, options[i].height = 700;
    }
    crease_status status = CREASE_OK;
    for (int e = 0; e < 2 && status == CREASE_OK; e++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s.%s", folder, name, extensions[e]);
        status = crease_figure_panels_write(
            context, (const crease_scene *const *)p->scenes, options, p->count, columns, path);
        if (status == CREASE_OK)
            report_line(r, "wrote %s", path);
    }
    return status;
}

/* p -> M (p - origin), the reorientation of step 3. */
static void reorient(const crease_sheet *sheet, const double *from, size_t count, double *to)
{
    double m[9], origin[3];
    crease_sheet_frame(sheet, m, origin);
    for (size_t i = 0; i < count; i++) {
        double d[3];
        for (int c = 0; c < 3; c++)
            d[c] = from[3 * i + (size_t)c] - origin[c];
        for (int c = 0; c < 3; c++)
            to[3 * i + (size_t)c] = m[3 * c] * d[0] + m[3 * c + 1] * d[1] + m[3 * c + 2] * d[2];
    }
}

static crease_status cloud_of(
    crease_context *context, const double *points, size_t count, crease_cloud **out)
{
    const crease_cloud_parts parts = {
        .count = count, .points = points, .coordinate_type = CREASE_TYPE_FLOAT64};
    return crease_cloud_create(context, &parts, out);
}

static crease_status reoriented_cloud(crease_context *context, const crease_sheet *sheet,
    const crease_cloud *cloud, crease_cloud **out)
{
    const size_t count = crease_cloud_count(cloud);
    double *points = calloc(3 * count, sizeof *points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    reorient(sheet, crease_cloud_points(cloud), count, points);
    const crease_status status = cloud_of(context, points, count, out);
    free(points);
    return status;
}

static crease_status reoriented_surface(
    crease_context *context, const crease_sheet *sheet, crease_surface **out)
{
    crease_surface_parts parts = crease_surface_parts_of(crease_sheet_surface(sheet));
    const size_t count = parts.count[0] * parts.count[1];
    double *net = calloc(3 * count, sizeof *net);
    if (!net)
        return CREASE_ERROR_NO_MEMORY;
    reorient(sheet, parts.control_points, count, net);
    parts.control_points = net;
    const crease_status status = crease_surface_create(context, &parts, out);
    free(net);
    return status;
}

/* The sample around an edge of the cube, as the cube stands or as a roof, with noise d. */
static crease_status sample(crease_context *context, bool roof, double noise, crease_cloud **out)
{
    crease_sample_options options = crease_sample_options_default();
    options.roof = roof;
    options.noise = noise;
    return crease_shape_sample(context, &options, out);
}

/* Steps 1 to 6 only: no row is ever repeated. */
static crease_status fit_smooth(
    crease_context *context, const crease_cloud *cloud, crease_sheet **out)
{
    crease_averaging_options options = crease_averaging_options_default();
    options.row_threshold = NEVER;
    return crease_averaging_fit(context, cloud, &options, out);
}

static crease_status projected_cloud(
    crease_context *context, const crease_sheet *sheet, crease_cloud **out)
{
    return cloud_of(context, crease_sheet_projected(sheet), crease_sheet_point_count(sheet), out);
}

static crease_status figure_1(crease_context *context, const char *folder, report *r)
{
    panels p = {.count = 0};
    crease_cloud *cloud = NULL;
    crease_status status = sample(context, false, 0, &cloud);
    if (status == CREASE_OK)
        status = add_panel(context, &p, "51 points of the cube", (view){.cloud = cloud});
    if (status == CREASE_OK)
        status = write_panels(context, &p, 1, folder, "figure_1", r);
    crease_cloud_free(cloud);
    panels_free(&p);
    return status;
}

static crease_status figure_2_smooth(crease_context *context, const crease_cloud *cloud, panels *p)
{
    crease_sheet *smooth = NULL;
    crease_cloud *turned = NULL;
    crease_surface *surface = NULL;
    crease_status status = fit_smooth(context, cloud, &smooth);
    if (status == CREASE_OK)
        status = reoriented_cloud(context, smooth, cloud, &turned);
    if (status == CREASE_OK)
        status = reoriented_surface(context, smooth, &surface);
    if (status == CREASE_OK)
        status = add_panel(context, p, "reoriented, initial surface",
            (view){.cloud = turned, .surface = surface, .net = true});
    if (status == CREASE_OK)
        status = add_panel(context, p, "back in its original position",
            (view){.cloud = cloud, .surface = crease_sheet_surface(smooth), .net = true});
    crease_surface_free(surface);
    crease_cloud_free(turned);
    crease_sheet_free(smooth);
    return status;
}

static crease_status figure_2_sharp(crease_context *context, const crease_cloud *cloud, panels *p)
{
    crease_sheet *sharp = NULL;
    crease_cloud *projected = NULL;
    crease_status status = crease_averaging_fit(context, cloud, NULL, &sharp);
    if (status == CREASE_OK)
        status = projected_cloud(context, sharp, &projected);
    if (status == CREASE_OK)
        status = add_panel(context, p, "sharp edge, before projection",
            (view){.cloud = cloud, .surface = crease_sheet_surface(sharp), .net = true});
    if (status == CREASE_OK)
        status = add_panel(context, p, "sharp edge, after projection",
            (view){.cloud = projected, .surface = crease_sheet_surface(sharp)});
    crease_cloud_free(projected);
    crease_sheet_free(sharp);
    return status;
}

static crease_status figure_2(crease_context *context, const char *folder, report *r)
{
    panels p = {.count = 0};
    crease_cloud *cloud = NULL;
    crease_status status = sample(context, false, 0, &cloud);
    if (status == CREASE_OK)
        status = figure_2_smooth(context, cloud, &p);
    if (status == CREASE_OK)
        status = figure_2_sharp(context, cloud, &p);
    if (status == CREASE_OK)
        status = write_panels(context, &p, 2, folder, "figure_2", r);
    crease_cloud_free(cloud);
    panels_free(&p);
    return status;
}

typedef crease_status fitter(crease_context *, const crease_cloud *, crease_sheet **);

static crease_status fit_averaging(
    crease_context *context, const crease_cloud *cloud, crease_sheet **out)
{
    return crease_averaging_fit(context, cloud, NULL, out);
}

static crease_status fit_sheet(
    crease_context *context, const crease_cloud *cloud, crease_sheet **out)
{
    return crease_sheet_fit(context, cloud, NULL, out);
}

/* A panel with the fitted surface and the points projected onto it. */
static crease_status fitted_panel(crease_context *context, const crease_cloud *cloud, fitter *fit,
    const char *title, bool with_creases, panels *p)
{
    crease_sheet *sheet = NULL;
    crease_cloud *projected = NULL;
    crease_status status = fit(context, cloud, &sheet);
    if (status == CREASE_OK)
        status = projected_cloud(context, sheet, &projected);
    if (status == CREASE_OK)
        status = add_panel(context, p, title,
            (view){.cloud = projected,
                .surface = crease_sheet_surface(sheet),
                .creases = with_creases ? sheet : NULL});
    crease_cloud_free(projected);
    crease_sheet_free(sheet);
    return status;
}

static crease_status noisy_panel(
    crease_context *context, double noise, fitter *fit, const char *title, panels *p)
{
    crease_cloud *cloud = NULL;
    crease_status status = sample(context, true, noise, &cloud);
    if (status == CREASE_OK)
        status = fitted_panel(context, cloud, fit, title, fit == fit_sheet, p);
    crease_cloud_free(cloud);
    return status;
}

static crease_status figure_3(crease_context *context, const char *folder, report *r)
{
    static const double levels[] = {0.16, 0.32, 0.48, 0.64};
    panels p = {.count = 0};
    crease_status status = CREASE_OK;
    for (int i = 0; i < 4 && status == CREASE_OK; i++) {
        char title[64];
        snprintf(title, sizeof title, "noise level %.2f", levels[i]);
        status = noisy_panel(context, levels[i], fit_averaging, title, &p);
    }
    if (status == CREASE_OK)
        status = write_panels(context, &p, 2, folder, "figure_3", r);
    panels_free(&p);
    return status;
}

/* Turns the sample about the axis (1, 2, 3), so that its edge lies along no axis. */
static crease_status oblique_sample(crease_context *context, crease_cloud **out)
{
    static const double axis[3] = {0.2672612419124244, 0.5345224838248488, 0.8017837257372732};
    const double c = cos(0.7), s = sin(0.7);
    crease_cloud *cloud = NULL;
    crease_status status = sample(context, true, 0, &cloud);
    if (status != CREASE_OK)
        return status;
    const size_t count = crease_cloud_count(cloud);
    const double *p = crease_cloud_points(cloud);
    double *turned = calloc(3 * count, sizeof *turned);
    for (size_t i = 0; turned && i < 3 * count; i++) {
        const size_t a = i % 3, b = (a + 1) % 3, d = (a + 2) % 3, first = i - a;
        const double along = axis[0] * p[first] + axis[1] * p[first + 1] + axis[2] * p[first + 2];
        turned[i] = c * p[i] + s * (axis[b] * p[first + d] - axis[d] * p[first + b]) +
            (1 - c) * along * axis[a];
    }
    status = turned ? cloud_of(context, turned, count, out) : CREASE_ERROR_NO_MEMORY;
    free(turned);
    crease_cloud_free(cloud);
    return status;
}

static crease_status figure_4(crease_context *context, const char *folder, report *r)
{
    panels p = {.count = 0};
    crease_cloud *cloud = NULL;
    crease_status status = oblique_sample(context, &cloud);
    if (status == CREASE_OK)
        status = fitted_panel(context, cloud, fit_averaging, "an edge along no axis", false, &p);
    if (status == CREASE_OK)
        status = write_panels(context, &p, 1, folder, "figure_4", r);
    crease_cloud_free(cloud);
    panels_free(&p);
    return status;
}

static crease_status figure_5(crease_context *context, const char *folder, report *r)
{
    panels p = {.count = 0};
    crease_status status = noisy_panel(context, 0, fit_averaging, "averaging, no noise", &p);
    if (status == CREASE_OK)
        status = noisy_panel(context, 0, fit_sheet, "sheet, no noise", &p);
    if (status == CREASE_OK)
        status = noisy_panel(context, 0.64, fit_averaging, "averaging, noise level 0.64", &p);
    if (status == CREASE_OK)
        status = noisy_panel(context, 0.64, fit_sheet, "sheet, noise level 0.64", &p);
    if (status == CREASE_OK)
        status = write_panels(context, &p, 2, folder, "figure_5", r);
    panels_free(&p);
    return status;
}

crease_status figures_write(crease_context *context, const char *folder, report *r)
{
    static crease_status (*const figures[])(crease_context *, const char *, report *) = {
        figure_1, figure_2, figure_3, figure_4, figure_5};
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < sizeof figures / sizeof figures[0] && status == CREASE_OK; i++)
        status = figures[i](context, folder, r);
    return status;
}
