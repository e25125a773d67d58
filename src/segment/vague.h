/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions whose kind of surface is a guess. */
#ifndef CREASE_SEGMENT_VAGUE_H
#define CREASE_SEGMENT_VAGUE_H

#include "segment/segmentation.h"

bool crease_region_is_form(const crease_segmentation *seg, size_t region);
/* Where most points on primitives fit them exactly, as they do without noise, a primitive that does
 * not is an approximation of something else. *out: the mean square residual, in square sigmas, of
 * such a one; more than any has where there is noise. */
crease_status crease_vague_find_rough(const crease_segmentation *seg, double *out);
/* Free forms, rough primitives, and small pieces that hardly turn. */
bool crease_region_is_vague(const crease_segmentation *seg, double rough, size_t region);
/* Free forms with more parameters than primitives have, and rough primitives, which should be such.
 */
bool crease_region_is_rich(const crease_segmentation *seg, double rough, size_t region);

#endif
