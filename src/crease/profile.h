/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Is the surface kinked along a chain, or does only its curvature change there, as where a fillet
 * begins? Two regions tell the one from the other badly when they bend by little: their models run
 * on beyond the points. So the points beside the chain are looked at again, in the plane across it.
 */
#ifndef CREASE_CREASE_PROFILE_H
#define CREASE_CREASE_PROFILE_H

#include "crease/chain.h"
#include "crease/survey.h"

/* Removes the chains that the regions do not end at (sides.h), and those that bend by less than 60
 * degrees and whose points a smooth profile explains as well as one with a kink. Threaded over the
 * chains. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_profile_prune(
    crease_context *context, const crease_survey *survey, crease_chains *chains);

#endif
