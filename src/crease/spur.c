/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "crease/spur.h"

#include "base/vector.h"

/* The chain's length with the corners at its ends. */
static double whole_length(const crease_chain *chain, const crease_junctions *corners)
{
    double length = crease_chain_length(chain);
    for (int end = 0; end < 2 && chain->count > 0; end++)
        if (chain->corners[end] != CREASE_NO_CORNER)
            length += crease_vector_distance(corners->items[chain->corners[end]].place,
                chain->points + (end ? 3 * (chain->count - 1) : 0));
    return length;
}

static bool leads_nowhere(const crease_chain *chain, const crease_junctions *corners)
{
    const int32_t *const ends = chain->corners;
    const uint32_t own = ends[0] == ends[1] ? 2 : 1;
    for (int end = 0; end < 2; end++)
        if (ends[end] == CREASE_NO_CORNER || corners->items[ends[end]].valence <= own)
            return true;
    return false;
}

/* Removes the corners without chains and numbers the others anew. */
static void compact(crease_chains *chains, crease_junctions *corners)
{
    size_t kept = 0;
    for (size_t i = 0; i < corners->count; i++) {
        if (corners->items[i].valence == 0)
            continue;
        for (size_t c = 0; c < chains->count && kept != i; c++)
            for (int end = 0; end < 2; end++)
                if (chains->items[c].corners[end] == (int32_t)i)
                    chains->items[c].corners[end] = (int32_t)kept;
        corners->items[kept++] = corners->items[i];
    }
    corners->count = kept;
}

void crease_spurs_drop(crease_chains *chains, crease_junctions *corners, double length)
{
    size_t kept = 0;
    for (size_t i = 0; i < chains->count; i++) {
        crease_chain *const chain = &chains->items[i];
        if (chain->closed || !leads_nowhere(chain, corners) ||
            whole_length(chain, corners) >= length) {
            chains->items[kept++] = *chain;
            continue;
        }
        for (int end = 0; end < 2; end++)
            if (chain->corners[end] != CREASE_NO_CORNER)
                corners->items[chain->corners[end]].valence--;
        crease_chain_clear(chain);
    }
    const bool dropped = kept < chains->count;
    chains->count = kept;
    if (dropped)
        compact(chains, corners);
}
