/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What a trimmed sheet tells of itself. */
#include "trim/trim.h"

#include <stdlib.h>

void crease_trim_free(crease_trim *trim)
{
    if (!trim)
        return;
    for (size_t i = 0; i < trim->edge_count; i++)
        crease_curve_free(trim->curves[i]);
    for (size_t i = 0; i < trim->crease_count; i++)
        crease_curve_free(trim->creases[i]);
    crease_surfaces_free(trim->pieces, trim->piece_count);
    free(trim->vertices);
    free(trim->edges);
    free(trim->curves);
    free(trim->faces);
    free(trim->first_half);
    free(trim->halves);
    free(trim->creases);
    free(trim);
}

bool crease_trim_is_whole(const crease_trim *trim)
{
    return trim->whole;
}

size_t crease_trim_vertex_count(const crease_trim *trim)
{
    return trim->vertex_count;
}

const double *crease_trim_vertices(const crease_trim *trim)
{
    return trim->vertices;
}

size_t crease_trim_edge_count(const crease_trim *trim)
{
    return trim->edge_count;
}

crease_trim_edge crease_trim_edge_at(const crease_trim *trim, size_t index)
{
    return trim->edges[index];
}

size_t crease_trim_face_count(const crease_trim *trim)
{
    return trim->face_count;
}

const crease_surface *crease_trim_surface(const crease_trim *trim, size_t face)
{
    return trim->pieces[trim->faces[face].piece];
}

size_t crease_trim_loop_count(const crease_trim *trim, size_t face)
{
    return trim->faces[face].loop_count;
}

const crease_trim_half *crease_trim_loop(
    const crease_trim *trim, size_t face, size_t loop, size_t *count)
{
    const size_t *const first = trim->first_half + trim->faces[face].first_loop + loop;
    *count = first[1] - first[0];
    return trim->halves + first[0];
}

size_t crease_trim_crease_count(const crease_trim *trim)
{
    return trim->crease_count;
}

const crease_curve *const *crease_trim_creases(const crease_trim *trim)
{
    return (const crease_curve *const *)trim->creases;
}
