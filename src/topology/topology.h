/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What a body consists of, as the points show it: vertices, edges and faces bounded by loops of
 * edges. Every pair of regions that meet has its edges, along a crease or where they join smoothly;
 * every region whose edges close has its faces. Plain C without atomics, so that C++ can include
 * it.
 */
#ifndef CREASE_TOPOLOGY_TOPOLOGY_H
#define CREASE_TOPOLOGY_TOPOLOGY_H

#include "topology/chart.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CREASE_NO_VERTEX = -1 };

#define CREASE_NO_OTHER UINT32_MAX /* the second region of a rim */

typedef struct crease_vertex {
    double place[3];
    double spread; /* how far away any three of its surfaces meet */
} crease_vertex;

/* An edge runs along the common curve of the surfaces of two regions; or, a rim, along the border
 * of the data on one. */
typedef struct crease_edge {
    uint32_t regions[2]; /* ascending; the second CREASE_NO_OTHER: a rim */
    int32_t vertices[2]; /* where it begins and ends; the same twice: closed */
    bool closed;         /* its first and last point are the same */
    bool smooth;         /* its faces join without an angle */
    bool loose;          /* smooth, between surfaces that have no common curve */
    size_t count, room;  /* its points are on both surfaces, but for those of ... */
    double *points;      /* ... loose edges, and the ends are where the vertices are seen from the
                            two surfaces alone */
} crease_edge;

/* An edge as a loop passes it. */
typedef struct crease_half {
    uint32_t edge;
    bool reversed;
} crease_half;

typedef struct crease_loop {
    size_t count;
    crease_half *halves;
    int turns[2]; /* times that u and v run round along it */
    double area;  /* in u, v; positive: anticlockwise. Only where it does not turn */
    size_t uv_count;
    double *uv; /* u, v of its points; the first is where the first half begins */
} crease_loop;

typedef enum crease_face_kind {
    CREASE_FACE_PATCH, /* its first loop goes around it, the others around holes */
    CREASE_FACE_BAND,  /* all the way round between its first two loops, rims; others are holes */
    CREASE_FACE_CAP,   /* the same between one rim and a pole (sphere) or apex (cone) */
    CREASE_FACE_WHOLE  /* a whole sphere or torus: no loops */
} crease_face_kind;

/* Loops have the face on their left in u, v. */
typedef struct crease_face {
    uint32_t region;
    crease_face_kind kind;
    int direction;   /* of a band: which parameter runs round */
    bool upper;      /* a cap whose pole is where v is greatest */
    int32_t seam[2]; /* vertices of the first and second rim where u (or v) is 0 */
    size_t loop_count;
    crease_loop *loops;
} crease_face;

struct crease_model;

typedef struct crease_topology {
    double spacing;
    size_t region_count;
    crease_chart *charts; /* of each region */
    bool *open;           /* regions whose edges do not close: they have no face */
    size_t vertex_count, vertex_room;
    crease_vertex *vertices;
    size_t edge_count, edge_room;
    crease_edge *edges;
    size_t face_count, face_room;
    crease_face *faces;
    size_t unseen_count;         /* planes of faces that no point shows, but their neighbours: */
    struct crease_model *unseen; /* see topology/complete.h */
} crease_topology;

/* Without vertices, edges, faces and charts. NULL when memory ran out. */
crease_topology *crease_topology_create(crease_context *context, const crease_regions *regions);
/* Whether an edge has one face only. */
static inline bool crease_edge_is_rim(const crease_edge *edge)
{
    return edge->regions[1] == CREASE_NO_OTHER;
}
void crease_edge_clear(crease_edge *edge);
void crease_loop_clear(crease_loop *loop);
void crease_topology_clear_edges(crease_topology *topology);
CREASE_API void crease_topology_free(crease_topology *topology);

#ifdef __cplusplus
}
#endif

#endif
