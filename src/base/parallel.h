/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Threads. The only pair of files that knows OpenMP.
 *
 * The promise: work is cut into chunks of `grain` consecutive items, so chunk borders depend on the
 * count alone; a body that writes only results of its own items gives the same bytes for any number
 * of threads. For a sum, let each chunk (begin / grain) fill its own slot and add the slots in
 * order. */
#ifndef CREASE_BASE_PARALLEL_H
#define CREASE_BASE_PARALLEL_H

#include "base/context.h"

/* Works on items begin..end-1. worker is below crease_context_threads() and unique among the bodies
 * running at the same time: an index into scratch memory made beforehand. */
typedef void crease_parallel_body(void *user, size_t begin, size_t end, int worker);

/* Runs the body over 0..count-1, reports progress of the stage and stops early when cancelled.
 * Returns CREASE_OK or CREASE_ERROR_CANCELLED. */
crease_status crease_parallel_for(
    crease_context *context, size_t count, size_t grain, crease_parallel_body *body, void *user);

/* Number of processors of this machine that may be used, at least 1. */
int crease_parallel_processors(void);

#endif
