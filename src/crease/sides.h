/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* On which sides of a chain the points of its regions lie. */
#ifndef CREASE_CREASE_SIDES_H
#define CREASE_CREASE_SIDES_H

#include "crease/chain.h"
#include "crease/survey.h"

enum { CREASE_SIDES_POINTS = 512 };

/* Whether both regions end at the chain, or one of them ends on the other as a rib on a plate does.
 * Surfaces that merely cross, because noise or a poor fit has laid one through the other's points,
 * go on on both sides. found: room for CREASE_SIDES_POINTS. */
bool crease_sides_end(const crease_survey *survey, const crease_chain *chain, uint32_t *found);

#endif
