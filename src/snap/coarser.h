/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Fewer regions of the same cloud, for parts whose faces do not close. Plain C without atomics, so
 * that C++ can include it. */
#ifndef CREASE_SNAP_COARSER_H
#define CREASE_SNAP_COARSER_H

#include "crease/crease.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Unites the regions as crease_regions_options says, and snaps them if the given ones are. *out:
 * NULL when the given ones are united. */
CREASE_API crease_status crease_regions_find_coarser(
    crease_context *context, const crease_regions *regions, crease_regions **out);

#ifdef __cplusplus
}
#endif

#endif
