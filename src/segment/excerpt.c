/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/excerpt.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"
#include "cloud/cloud.h"
#include "noise/blur.h"
#include "space/kdtree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BALL_POINTS = 256, GRAIN = 256 };

static const double aside = 0.25; /* price of the distance from a region, over that from its
                                     surface */

/* ------------------------------------------------------------------------------------ taking -- */

static void copy_point(
    const double *points, const crease_noise *noise, size_t from, crease_excerpt *to)
{
    const size_t at = to->count++;
    to->places[at] = (uint32_t)from;
    memcpy(to->points + 3 * at, points + 3 * from, 3 * sizeof *points);
    memcpy(to->noise.normals + 3 * at, noise->normals + 3 * from, 3 * sizeof *noise->normals);
    to->noise.scores[at] = noise->scores[from];
    to->noise.local_spacing[at] = noise->local_spacing[from];
}

crease_status crease_excerpt_take(crease_context *context, const double *points, size_t count,
    const crease_noise *noise, const uint8_t *skipped, crease_excerpt *out)
{
    *out = (crease_excerpt){.noise = *noise};
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        kept += !skipped[i];
    out->places = crease_allocate(context, kept, sizeof *out->places);
    out->points = crease_allocate(context, kept, 3 * sizeof *out->points);
    out->labels = crease_allocate(context, kept, sizeof *out->labels);
    out->noise.normals = crease_allocate(context, kept, 3 * sizeof *out->noise.normals);
    out->noise.scores = crease_allocate(context, kept, sizeof *out->noise.scores);
    out->noise.local_spacing = crease_allocate(context, kept, sizeof *out->noise.local_spacing);
    if (!out->places || !out->points || !out->labels || !out->noise.normals || !out->noise.scores ||
        !out->noise.local_spacing)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        if (!skipped[i])
            copy_point(points, noise, i, out);
    out->noise.count = kept;
    const crease_cloud cloud = {.count = kept, .points = out->points};
    return crease_neighbours_find(context, &cloud, CREASE_NOISE_NEIGHBOURS, &out->neighbours);
}

void crease_excerpt_clear(crease_excerpt *excerpt)
{
    crease_neighbours_free(excerpt->neighbours);
    free(excerpt->places);
    free(excerpt->points);
    free(excerpt->labels);
    free(excerpt->noise.normals);
    free(excerpt->noise.scores);
    free(excerpt->noise.local_spacing);
    *excerpt = (crease_excerpt){.count = 0};
}

/* ---------------------------------------------------------------------------------- spreading --
 */

typedef struct spreading {
    const crease_excerpt *excerpt;
    const crease_model *models;
    const crease_tree *tree; /* of the excerpt's points */
    const double *points;
    const uint8_t *known;
    int32_t *labels;
} spreading;

/* The region whose surface is nearest, regions farther away being at a disadvantage. */
static int32_t nearest_region(const spreading *run, const double place[3])
{
    uint32_t found[BALL_POINTS];
    size_t count = 0;
    const double reach = CREASE_BLUR_REACH * run->excerpt->noise.spacing;
    double least = reach, gradient[3];
    int32_t best = CREASE_NO_LABEL;
    crease_tree_within(run->tree, place, reach, BALL_POINTS, found, &count);
    for (size_t i = 0; i < count && i < BALL_POINTS; i++) {
        const int32_t label = run->excerpt->labels[found[i]];
        if (label < 0)
            continue;
        const double away =
            crease_vector_distance(run->excerpt->points + 3 * (size_t)found[i], place);
        const double off = fabs(crease_model_distance(&run->models[label], place, gradient));
        const double price = off + aside * away;
        if (price < least || (price == least && label < best)) {
            least = price;
            best = label;
        }
    }
    return best;
}

static void spread_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const spreading *const run = user;
    for (size_t i = begin; i < end; i++)
        if (!run->known[i])
            run->labels[i] = nearest_region(run, run->points + 3 * i);
}

crease_status crease_excerpt_spread(crease_context *context, const crease_excerpt *excerpt,
    const crease_model *models, const double *points, size_t count, int32_t *labels)
{
    crease_tree *tree = NULL;
    uint8_t *const known = crease_allocate(context, count, sizeof *known);
    crease_status status = known
        ? crease_tree_create(context, excerpt->points, excerpt->count, &tree)
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        for (size_t i = 0; i < excerpt->count; i++) {
            known[excerpt->places[i]] = 1;
            labels[excerpt->places[i]] = excerpt->labels[i];
        }
        spreading run = {excerpt, models, tree, points, known, labels};
        status = crease_parallel_for(context, count, GRAIN, spread_some, &run);
    }
    crease_tree_free(tree);
    free(known);
    return status;
}
