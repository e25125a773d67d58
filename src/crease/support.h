/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where points support a crease: from links between neighbouring points of different regions to
 * chains along the intersections of the regions' models. */
#ifndef CREASE_CREASE_SUPPORT_H
#define CREASE_CREASE_SUPPORT_H

#include "crease/chain.h"
#include "crease/survey.h"

/* Adds the chains of all pairs of neighbouring regions. A chain goes as far as there are points of
 * both regions beside each other; it ends before a gap of 4 spacings and where the surface bends
 * by less than the survey's least bend. A border of the cloud has one region only, so it is no
 * chain. */
crease_status crease_support_trace(
    crease_context *context, const crease_survey *survey, crease_chains *chains);

/* How far the surface turns at a place of the intersection of two regions, each side being where
 * the region's points are. */
double crease_support_bend(const crease_survey *survey, const uint32_t regions[2],
    const double place[3], const double tangent[3]);

#endif
