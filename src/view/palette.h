/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The colours of layers, the same in figures and on the page: those of the paper first, green data
 * points and red control points. */
#ifndef CREASE_VIEW_PALETTE_H
#define CREASE_VIEW_PALETTE_H

#include "view/colour.h"
#include "view/scene.h"

/* The colour of layer `index` when no field colours it. Layers of the same kind differ. */
crease_colour crease_palette_of_layer(const crease_scene *scene, size_t index);

#endif
