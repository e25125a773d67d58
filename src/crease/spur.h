/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Spurs: what corners have cut chains to, when it leads nowhere. */
#ifndef CREASE_CREASE_SPUR_H
#define CREASE_CREASE_SPUR_H

#include "crease/junction.h"

/* Drops open chains, corners at their ends included, that are shorter than a length and have an end
 * at which no other chain ends: so few points are beside them that they say nothing. Corners at
 * which no chain is left go with them. */
void crease_spurs_drop(crease_chains *chains, crease_junctions *corners, double length);

#endif
