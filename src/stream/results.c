/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "stream/results.h"

#include "base/memory.h"
#include "stream/scratch.h"

#include <stdlib.h>

crease_status crease_results_create(
    crease_context *context, const char *scratch, size_t runs, crease_results *out)
{
    *out = (crease_results){.file = -1, .room = runs};
    out->runs = crease_allocate(context, runs, sizeof *out->runs);
    const crease_status status =
        out->runs ? crease_scratch_open(context, scratch, &out->file) : CREASE_ERROR_NO_MEMORY;
    if (status != CREASE_OK)
        crease_results_free(out);
    return status;
}

void crease_results_free(crease_results *results)
{
    if (results->runs)
        crease_scratch_close(results->file);
    free(results->runs);
    free(results->memory);
    *results = (crease_results){.file = -1};
}

crease_status crease_results_add(
    crease_context *context, crease_results *results, const crease_result *items, size_t count)
{
    results->runs[results->run_count++] = (crease_run){.first = results->count, .count = count};
    results->count += count;
    return crease_scratch_put(context, results->file, (results->count - count) * sizeof *items,
        items, count * sizeof *items);
}

/* False when the run has no more. */
static bool refill(
    crease_context *context, crease_results *results, size_t run, crease_status *status)
{
    crease_run *const from = &results->runs[run];
    if (from->at < from->end || *status != CREASE_OK)
        return *status == CREASE_OK;
    const size_t left = from->count - from->read;
    from->items = results->memory + run * CREASE_RUN_RESULTS;
    from->at = 0;
    from->end = left < CREASE_RUN_RESULTS ? left : CREASE_RUN_RESULTS;
    *status =
        crease_scratch_get(context, results->file, (from->first + from->read) * sizeof *from->items,
            from->items, from->end * sizeof *from->items);
    from->read += from->end;
    return *status == CREASE_OK && from->end > 0;
}

crease_status crease_results_next(crease_context *context, crease_results *results, size_t first,
    size_t count, crease_result *out)
{
    crease_status status = CREASE_OK;
    if (!results->memory)
        results->memory = crease_allocate(
            context, results->run_count * CREASE_RUN_RESULTS, sizeof *results->memory);
    if (!results->memory)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t r = 0; r < results->run_count && status == CREASE_OK; r++) {
        crease_run *const run = &results->runs[r];
        while (refill(context, results, r, &status) && run->items[run->at].number < first + count) {
            out[run->items[run->at].number - first] = run->items[run->at];
            run->at++;
        }
    }
    return status;
}
