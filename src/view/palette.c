/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/palette.h"

crease_colour crease_palette_of_layer(const crease_scene *scene, size_t index)
{
    static const crease_colour clouds[] = {
        {0.10, 0.62, 0.22}, {0.93, 0.55, 0.10}, {0.45, 0.30, 0.75}, {0.05, 0.55, 0.65}};
    static const crease_colour nets[] = {{0.84, 0.12, 0.12}, {0.60, 0.10, 0.45}};
    static const crease_colour surfaces[] = {{0.74, 0.81, 0.93}, {0.93, 0.86, 0.74}};
    const crease_layer_kind kind = scene->layers[index].kind;
    size_t before = 0;
    for (size_t i = 0; i < index; i++)
        before += scene->layers[i].kind == kind;
    if (kind == CREASE_LAYER_POINTS)
        return clouds[before % 4];
    if (kind == CREASE_LAYER_NET)
        return nets[before % 2];
    return kind == CREASE_LAYER_SURFACE ? surfaces[before % 2] : (crease_colour){0.11, 0.11, 0.15};
}
