/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The scene: layers of points, surfaces, control nets and curves. Internal view. */
#ifndef CREASE_VIEW_SCENE_H
#define CREASE_VIEW_SCENE_H

#include "view/facts.h"
#include "view/polylines.h"

typedef enum crease_layer_kind {
    CREASE_LAYER_POINTS,
    CREASE_LAYER_SURFACE,
    CREASE_LAYER_NET,
    CREASE_LAYER_CURVES
} crease_layer_kind;

typedef struct crease_layer {
    crease_layer_kind kind;
    char *name;             /* clean text */
    size_t items;           /* surfaces or curves it was made from */
    crease_cloud *cloud;    /* points */
    crease_mesh *mesh;      /* surface */
    crease_polylines lines; /* net, curves, and lines of constant parameter on a surface */
    uint32_t *begins;       /* of curves: the first link of each */
    crease_facts facts;     /* of surfaces, curves, or points with the number in a field */
} crease_layer;

struct crease_scene {
    char *title; /* clean text */
    crease_layer *layers;
    size_t layer_count;
};

/* Lowest and highest coordinates of all layers; false when the scene shows nothing. */
bool crease_scene_bounds(const crease_scene *scene, double lowest[3], double highest[3]);

#endif
