/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The normals of the triangles that a point forms with pairs of its neighbours are points of the
 * Gauss sphere: one heap on smooth ground, two on an edge, three or more on a corner. They are
 * clustered bottom up by average linkage, and the point is a feature when at the sensitivity (a
 * distance) two clusters of weight are left. Instead of asking for one sensitivity, the clustering
 * is carried through, and the score is the greatest sensitivity at which that still holds; the
 * decision (threshold.h) finds the sensitivity from the cloud.
 *
 * Where this differs from the paper: the distance of two normals is the squared sine of their
 * angle, not the angle. Normals of triangles have no sign, and squared sines know none; and the
 * mean squared sine over all pairs of two clusters follows from two matrices, 1 - tr(M_a M_b), M
 * the cluster's mean n n' - no list of pairs is needed. A normal's weight is the area of its
 * triangle: slivers say little. Beyond 16 neighbours 105 of the pairs are taken, spread evenly. The
 * order of merging is that of the nearest-neighbour chain, which gives the same tree.
 *
 * Based on: Weber, Hahmann, Hagen. Sharp feature detection in point clouds. 2010.
 * Based on: Benzecri. Construction d'une classification ascendante hierarchique par la recherche en
 * chaine des voisins reciproques. 1982. */
#include "detect/gauss_map.h"

#include "base/simd.h"
#include "base/vector.h"

#include <math.h>
#include <string.h>

enum { MOST = 112, TRIANGLES = 105, ENTRIES = 6, LANES = 16, NONE = -1 };

/* A cluster counts when it has this share of the weight: more than the triangles of one outlier
 * among 16 points, 2 in 15. */
static const float least_share = 1.0f / 6;
/* Separations below are rounding of single precision. */
static const double rounding = 1e-5;

typedef struct clusters {
    int count;
    float entry[ENTRIES][MOST];        /* xx xy xz yy yz zz of M */
    float weight[MOST], present[MOST]; /* present: 1, 0 beyond the last cluster */
    int32_t key[MOST];                 /* scratch */
} clusters;

/* Returns the weight: 0, and nothing is added, when the three points lie on a line. */
static float add_triangle(clusters *all, const double a[3], const double b[3])
{
    double n[3];
    crease_vector_cross(a, b, n);
    const float weight = (float)crease_vector_dot(n, n);
    if (!(weight > 0))
        return 0;
    crease_vector_normalise(n);
    const double products[ENTRIES] = {
        n[0] * n[0], n[0] * n[1], n[0] * n[2], n[1] * n[1], n[1] * n[2], n[2] * n[2]};
    const int lane = all->count++;
    for (int e = 0; e < ENTRIES; e++)
        all->entry[e][lane] = (float)products[e];
    all->weight[lane] = weight;
    all->present[lane] = 1;
    return weight;
}

/* Every triangle, or, beyond TRIANGLES of them, so many spread evenly. Returns the weight of all.
 */
static float add_triangles(clusters *all, const crease_neighbourhood *neighbourhood)
{
    const int k = neighbourhood->k, pairs = (k - 1) * (k - 2) / 2;
    const int taken = pairs < TRIANGLES ? pairs : TRIANGLES;
    float weight = 0;
    int pair = 0, next = 0;
    for (int i = 1; i < k; i++)
        for (int j = i + 1; j < k; j++, pair++)
            if (pair == next * pairs / taken) {
                weight += add_triangle(all, neighbourhood->moments[i], neighbourhood->moments[j]);
                next++;
            }
    return weight;
}

/* Of each cluster b that is present 1 + tr(M_a M_b) as a whole number that is greater for greater
 * traces, and, among equal ones, for lower numbers b: the seven lowest bits are 127 - b. Returns
 * the greatest. */
CREASE_VECTORISED static int32_t nearest_key(clusters *restrict all, const float of[ENTRIES])
{
    const float xx = of[0], xy = 2 * of[1], xz = 2 * of[2], yy = of[3], yz = 2 * of[4], zz = of[5];
    const int room = (all->count + LANES - 1) / LANES * LANES;
    int32_t most = 0;
    for (int b = 0; b < room; b++) {
        const float trace = xx * all->entry[0][b] + xy * all->entry[1][b] + xz * all->entry[2][b] +
            yy * all->entry[3][b] + yz * all->entry[4][b] + zz * all->entry[5][b];
        all->key[b] = (int32_t)((1 + trace) * all->present[b] * 4194304.0f) * 128 + (127 - b);
    }
    for (int b = 0; b < room; b++)
        most = all->key[b] > most ? all->key[b] : most;
    return most;
}

/* The cluster nearest to one; the one before it in the chain where that is as near. */
static int nearest(clusters *all, int cluster, int before)
{
    float of[ENTRIES];
    for (int e = 0; e < ENTRIES; e++)
        of[e] = all->entry[e][cluster];
    all->present[cluster] = 0;
    const int32_t most = nearest_key(all, of);
    all->present[cluster] = 1;
    return before != NONE && all->key[before] / 128 == most / 128 ? before : 127 - most % 128;
}

static double distance(const clusters *all, int a, int b)
{
    double trace = 0;
    for (int e = 0; e < ENTRIES; e++) {
        const double twice = e == 0 || e == 3 || e == 5 ? 1 : 2;
        trace += twice * (double)all->entry[e][a] * (double)all->entry[e][b];
    }
    return 1 - trace;
}

/* b becomes part of a, and the last cluster takes its place, also in the chain. */
static void merge(clusters *all, int a, int b, int *chain, int length)
{
    const float weight = all->weight[a] + all->weight[b], share = all->weight[b] / weight;
    const int last = --all->count;
    for (int e = 0; e < ENTRIES; e++) {
        all->entry[e][a] += share * (all->entry[e][b] - all->entry[e][a]);
        all->entry[e][b] = all->entry[e][last];
    }
    all->weight[a] = weight;
    all->weight[b] = all->weight[last];
    all->present[last] = 0;
    for (int i = 0; i < length; i++)
        chain[i] = chain[i] == last ? b : chain[i];
}

/* Merges until one cluster is left. */
static double separate(clusters *all, float least)
{
    int chain[MOST], length = 0;
    double most = 0;
    while (all->count > 1) {
        if (length == 0)
            chain[length++] = 0;
        const int last = chain[length - 1], before = length > 1 ? chain[length - 2] : NONE;
        const int next = nearest(all, last, before);
        if (next != before && length < all->count) {
            chain[length++] = next;
            continue;
        }
        if (all->weight[last] >= least && all->weight[before] >= least)
            most = fmax(most, distance(all, before, last));
        length -= 2;
        merge(all, before < last ? before : last, before < last ? last : before, chain, length);
    }
    return most;
}

double crease_gauss_map_separation(const crease_neighbourhood *neighbourhood)
{
    clusters all;
    memset(&all, 0, sizeof all);
    const float weight = add_triangles(&all, neighbourhood);
    const double separation = separate(&all, least_share * weight);
    return separation < rounding ? 0 : separation;
}
