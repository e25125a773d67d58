/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A picture with depths: shaded triangles and dots, each sample keeping what is nearest to the eye.
 * It hides what lies behind a surface, also for what is drawn as lines above it. */
#ifndef CREASE_VIEW_RASTER_H
#define CREASE_VIEW_RASTER_H

#include "base/context.h"
#include "view/camera.h"
#include "view/colour.h"

#include <cairo.h>

typedef struct crease_raster {
    double left, top;  /* its corner on the drawing */
    int width, height; /* pixels of the picture */
    double density;    /* pixels per unit of the drawing */
    int samples;       /* per pixel, along x and along y */
    float *depths;     /* of every sample; infinite where nothing is */
    uint32_t *colours; /* of every sample, 0xAARRGGBB */
    bool *dots;        /* true where the sample shows a dot */
} crease_raster;

/* A picture of width x height units of the drawing. Errors: NO_MEMORY. */
crease_status crease_raster_create(crease_context *context, double left, double top, double width,
    double height, double density, int samples, crease_raster **out);
void crease_raster_free(crease_raster *raster);

/* Draws a mesh, lit from above the left shoulder of the eye, both sides alike. */
void crease_raster_draw_mesh(crease_raster *raster, const crease_mesh *mesh,
    const crease_camera *camera, crease_colour colour);
/* Draws a dot; depth is that of its middle. */
void crease_raster_draw_dot(
    crease_raster *raster, crease_spot middle, double radius, crease_colour colour);
/* Darkens dots that lie behind their neighbours on the picture, once all are drawn: a cloud without
 * normals then shows its shape. darkest: the least part of its brightness that a dot keeps, 0..1.
 * Based on: Boucheny. Visualisation scientifique de grands volumes de donnees: pour une approche
 * perceptive. 2009 (eye-dome lighting). */
void crease_raster_shade_dots(crease_raster *raster, double darkest);
/* True when nothing that was drawn lies in front of the spot by more than `slack`. */
bool crease_raster_sees(const crease_raster *raster, crease_spot spot, double slack);
/* Puts the picture onto the drawing. */
crease_status crease_raster_paint(
    crease_context *context, const crease_raster *raster, cairo_t *cairo);

#endif
