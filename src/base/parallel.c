/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/parallel.h"

#ifdef _OPENMP
#include <omp.h>
#else
static int omp_get_thread_num(void)
{
    return 0;
}
static int omp_get_num_procs(void)
{
    return 1;
}
#endif

int crease_parallel_processors(void)
{
    const int processors = omp_get_num_procs();
    return processors < 1 ? 1 : processors;
}

crease_status crease_parallel_for(
    crease_context *context, size_t count, size_t grain, crease_parallel_body *body, void *user)
{
    const size_t chunks = count / grain + (count % grain != 0);
    const int threads = context->options.threads;
    atomic_size_t next = 0;
#ifdef _OPENMP
#pragma omp parallel num_threads(threads) if (chunks > 1 && threads > 1)
#endif
    {
        const int worker = omp_get_thread_num();
        for (;;) {
            const size_t chunk = atomic_fetch_add(&next, 1);
            if (chunk >= chunks || atomic_load(&context->cancelled))
                break;
            const size_t begin = chunk * grain;
            const size_t left = count - begin;
            body(user, begin, begin + (left < grain ? left : grain), worker);
            if (worker == 0 && !crease_cancelled(context))
                crease_progress(context, (double)(chunk + 1) / (double)chunks);
        }
    }
    return crease_cancelled(context) ? crease_fail_cancelled(context) : CREASE_OK;
}
