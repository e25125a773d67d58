/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where two surfaces touch, or nearly so: they may also overlap or leave a gap. Across the line of
 * contact their distances from each other are least (or, if they cut each other, greatest): on the
 * surface midway between them, where their gradients do not differ across the line. */
#ifndef CREASE_TOPOLOGY_CONTACT_H
#define CREASE_TOPOLOGY_CONTACT_H

#include "primitive/model.h"

/* Moves a place to the line of contact, across the direction `along`. False where the surfaces are
 * at a right angle. Where both curve alike there is no line, and the place is only moved to midway.
 */
bool crease_contact_place(
    const crease_model *const models[2], const double along[3], double spacing, double place[3]);
/* The direction of the line of contact beside a place: in which the gradients differ least. False
 * where both surfaces curve alike. */
bool crease_contact_direction(
    const crease_model *const models[2], const double place[3], double spacing, double along[3]);
/* Moves a place to midway between two surfaces; returns how far they are apart there. */
double crease_contact_midway(const crease_model *const models[2], double place[3]);

#endif
