/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The stages of segmentation.h in turn, until nothing changes. */
#include "segment/segmentation.h"

#include "segment/fillet.h"

enum {
    ROUNDS = 6,
    LABEL_ROUNDS = 12,
    FIRST_SAMPLE = 300,
    FIRST_LARGE = 100,
    SAMPLE = 800,
    LARGE = 50,
    LARGE_SAMPLE = 2000,
    STILL = 1000 /* at most one label in this many changes: the result stands */
};

static const double waving = 1.5; /* mean square residual of a face, in square sigmas, that shared
                                     errors leave at most */

/* What one round did. */
typedef struct progress {
    size_t merged, dropped, reconsidered, changed;
} progress;

static crease_status relabel(crease_segmentation *seg, int rounds, progress *done)
{
    size_t changed = 0;
    const crease_status status = crease_relabel(seg, rounds, &changed);
    done->changed += changed;
    return status;
}

static void set_sigma(crease_segmentation *seg)
{
    for (int i = 0; i < crease_context_threads(seg->context); i++)
        seg->fitters[i].sigma = seg->sigma;
}

static crease_status improve(crease_segmentation *seg, int number, progress *done)
{
    crease_status status = number == 1 || number == 2 ? crease_grow(seg) : CREASE_OK;
    if (status == CREASE_OK)
        status = crease_segmentation_list(seg);
    if (status == CREASE_OK)
        status = number ? crease_merge(seg, SAMPLE, LARGE, &done->merged)
                        : crease_merge(seg, FIRST_SAMPLE, FIRST_LARGE, &done->merged);
    if (status == CREASE_OK)
        status = relabel(seg, LABEL_ROUNDS, done);
    if (status == CREASE_OK && number < 4)
        status = crease_reconsider(seg, &done->reconsidered);
    if (status == CREASE_OK && done->reconsidered)
        status = relabel(seg, LABEL_ROUNDS, &(progress){0});
    if (status == CREASE_OK)
        status = crease_give_up(seg, &done->dropped);
    return status;
}

static crease_status settle(crease_segmentation *seg, int number, progress *done)
{
    const bool keep_kinds = number > 0 || done->reconsidered;
    crease_status status = crease_refit(seg, number ? LARGE_SAMPLE : SAMPLE, keep_kinds);
    if (status == CREASE_OK)
        status = relabel(seg, LABEL_ROUNDS, done);
    if (status == CREASE_OK) {
        crease_segmentation_compact(seg);
        status = crease_refit(seg, LARGE_SAMPLE, keep_kinds);
    }
    if (status == CREASE_OK)
        status = crease_measure_noise(seg);
    set_sigma(seg);
    return status;
}

static bool stands(const crease_segmentation *seg, const progress *done)
{
    return done->changed < seg->count / STILL + 1;
}

static crease_status polish(crease_segmentation *seg)
{
    crease_status status = crease_refit_closely(seg);
    for (int i = 0; i < 2 && status == CREASE_OK; i++) {
        progress done = {0};
        status = relabel(seg, LABEL_ROUNDS / 2, &done);
        if (stands(seg, &done))
            break;
        if (status == CREASE_OK)
            status = crease_refit_closely(seg);
    }
    if (status == CREASE_OK)
        crease_segmentation_compact(seg);
    return status;
}

/* Where neighbouring points err alike, a face waves by more than independent errors explain, and
 * falls apart. Its pieces are joined where a simple surface follows them about as well as that. */
static crease_status join_waves(crease_segmentation *seg)
{
    if (!(seg->alike > 1.0))
        return CREASE_OK;
    crease_status status = crease_merge_within(seg, SAMPLE, waving);
    if (status == CREASE_OK)
        status = relabel(seg, LABEL_ROUNDS, &(progress){0});
    if (status == CREASE_OK) {
        crease_segmentation_compact(seg);
        status = crease_refit(seg, LARGE_SAMPLE, true);
    }
    return status;
}

crease_status crease_rounds_unite(crease_segmentation *seg, bool wide)
{
    size_t united = 0;
    set_sigma(seg);
    const crease_status status = crease_unite(seg, wide, &united);
    return status == CREASE_OK && united ? polish(seg) : status;
}

/* Free forms that were found in pieces. Where neighbours err alike the noise would explain too
 * much. */
static crease_status join_pieces(crease_segmentation *seg)
{
    return seg->alike > 1.0 ? CREASE_OK : crease_rounds_unite(seg, false);
}

crease_status crease_rounds_run(crease_segmentation *seg)
{
    set_sigma(seg);
    crease_status status = crease_grow(seg);
    for (int number = 0; number < ROUNDS && status == CREASE_OK; number++) {
        progress done = {0};
        status = improve(seg, number, &done);
        if (status == CREASE_OK)
            status = settle(seg, number, &done);
        if (number > 0 && !done.merged && !done.dropped && !done.reconsidered && stands(seg, &done))
            break;
    }
    if (status == CREASE_OK)
        status = polish(seg);
    if (status == CREASE_OK)
        status = join_waves(seg);
    if (status == CREASE_OK)
        status = join_pieces(seg);
    return status == CREASE_OK ? crease_fillets_find(seg) : status;
}
