/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Selection without unforeseeable branches, in loops that vectorise: all distances; a limit that
 * somewhat more than k of them pass, found by counting; those that pass, each put at its rank,
 * which is the number of others that come before it. */
#include "space/candidates.h"

#include "base/simd.h"

#include <string.h>

typedef struct selection {
    size_t count;
    double distance[CREASE_MOST_SELECTED], rank[CREASE_MOST_SELECTED];
    uint32_t number[CREASE_MOST_SELECTED]; /* of the candidate */
} selection;

CREASE_INLINE double outside(double low, double high, double value)
{
    const double below = low - value, above = value - high;
    const double away = below > above ? below : above;
    return away > 0 ? away : 0;
}

bool crease_candidates_add(crease_candidates *candidates, uint32_t begin, uint32_t end)
{
    const crease_tree *const tree = candidates->tree;
    const double *const low = candidates->low, *const high = candidates->high;
    const double limit = candidates->limit;
    size_t count = candidates->count;
    if (count + (end - begin) > CREASE_MOST_CANDIDATES)
        return false;
    for (uint32_t i = begin; i < end; i++) {
        const double x = tree->x[i], y = tree->y[i], z = tree->z[i];
        const double dx = outside(low[0], high[0], x);
        const double dy = outside(low[1], high[1], y);
        const double dz = outside(low[2], high[2], z);
        candidates->x[count] = x;
        candidates->y[count] = y;
        candidates->z[count] = z;
        candidates->position[count] = i;
        count += dx * dx + dy * dy + dz * dz <= limit;
    }
    candidates->count = count;
    return true;
}

CREASE_INLINE void measure(crease_candidates *candidates, size_t self)
{
    const double x = candidates->x[self], y = candidates->y[self], z = candidates->z[self];
    for (size_t i = 0; i < candidates->count; i++) {
        const double dx = candidates->x[i] - x;
        const double dy = candidates->y[i] - y;
        const double dz = candidates->z[i] - z;
        candidates->distance[i] = dx * dx + dy * dy + dz * dz;
    }
    candidates->distance[self] = -1; /* before all others */
}

CREASE_INLINE double count_within(const crease_candidates *candidates, double limit)
{
    const double *const distance = candidates->distance;
    double lanes[8] = {0};
    size_t i = 0;
    for (; i + 8 <= candidates->count; i += 8)
        for (size_t j = 0; j < 8; j++)
            lanes[j] += distance[i + j] <= limit ? 1 : 0;
    double sum = 0;
    for (; i < candidates->count; i++)
        sum += distance[i] <= limit ? 1 : 0;
    for (size_t j = 0; j < 8; j++)
        sum += lanes[j];
    return sum;
}

/* A limit that k points pass, and not many more if it can be helped: on a surface the number of
 * points grows with the squared distance. *count is the number of those that pass. */
CREASE_INLINE double find_limit(
    const crease_candidates *candidates, const crease_request *request, double *count)
{
    const double k = request->k, most = 1.5 * k + 4, aim = 1.2 * k + 2;
    double limit = request->guess;
    for (int attempt = 0; attempt < 4 && limit < candidates->limit; attempt++) {
        *count = count_within(candidates, limit);
        if (*count >= k && (*count <= most || attempt > 1))
            return limit;
        limit *= aim / *count;
    }
    *count = count_within(candidates, candidates->limit);
    return candidates->limit;
}

CREASE_INLINE void select_within(
    const crease_candidates *candidates, double limit, selection *chosen)
{
    size_t count = 0;
    for (size_t i = 0; i < candidates->count; i++) {
        chosen->number[count] = (uint32_t)i;
        count += candidates->distance[i] <= limit;
    }
    for (size_t i = 0; i < count; i++)
        chosen->distance[i] = candidates->distance[chosen->number[i]];
    chosen->count = count;
}

/* The number of others that are nearer; true when all are different. */
CREASE_INLINE bool rank_by_distance(selection *restrict chosen)
{
    const size_t count = chosen->count;
    for (size_t i = 0; i < count; i++)
        chosen->rank[i] = 0;
    for (size_t j = 0; j < count; j++) {
        const double distance = chosen->distance[j];
        for (size_t i = 0; i < count; i++)
            chosen->rank[i] += distance < chosen->distance[i] ? 1 : 0;
    }
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += chosen->rank[i];
    return sum == 0.5 * (double)count * ((double)count - 1);
}

/* Adds the number of others that are as near and have a lower index. */
CREASE_INLINE void rank_ties(selection *restrict chosen, const crease_candidates *candidates)
{
    const size_t count = chosen->count;
    double index[CREASE_MOST_SELECTED];
    for (size_t i = 0; i < count; i++)
        index[i] = candidates->tree->index[candidates->position[chosen->number[i]]];
    for (size_t j = 0; j < count; j++) {
        const double distance = chosen->distance[j], own = index[j];
        for (size_t i = 0; i < count; i++) {
            const double lower = own < index[i] ? 1 : 0;
            chosen->rank[i] += distance == chosen->distance[i] ? lower : 0;
        }
    }
}

CREASE_VECTORISED bool crease_candidates_nearest(crease_candidates *candidates,
    const crease_request *request, uint32_t *positions, double *squared_distances)
{
    const size_t k = (size_t)request->k;
    selection chosen;
    measure(candidates, request->self);
    double count = 0;
    const double limit = find_limit(candidates, request, &count);
    if (count < (double)k || count >= CREASE_MOST_SELECTED)
        return false;
    select_within(candidates, limit, &chosen);
    if (!rank_by_distance(&chosen))
        rank_ties(&chosen, candidates);
    for (size_t i = 0; i < chosen.count; i++) {
        const size_t rank = (size_t)chosen.rank[i];
        if (rank < k) {
            positions[rank] = candidates->position[chosen.number[i]];
            squared_distances[rank] = chosen.distance[i];
        }
    }
    squared_distances[0] = 0;
    return true;
}
