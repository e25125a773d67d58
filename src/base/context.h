/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The context: what every call of the library needs besides its arguments. Internal view. */
#ifndef CREASE_BASE_CONTEXT_H
#define CREASE_BASE_CONTEXT_H

#include "crease/crease.h"

#include <stdatomic.h>

struct crease_context {
    crease_context_options options; /* threads resolved to a positive number */
    char message[512];
    const char *kept;        /* folder for what finished stages found (see store.h), or NULL */
    const char *stage;       /* what the progress callback is told */
    atomic_bool cancelled;   /* set once the caller asked to stop */
    atomic_long allocations; /* allocations left before one fails on purpose; negative: no limit */
    atomic_flag refusing;    /* a thread is writing the message about a failed allocation */
};

/* The library's own short name for storing a sentence "where: what; what to do" and returning the
 * status. From the calling thread only. */
#define crease_fail crease_context_fail

/* Hands a sentence about odd but usable input to the caller. */
void crease_warn(crease_context *context, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Names the work that now begins; later progress is reported under this name. */
void crease_stage(crease_context *context, const char *stage);
/* Reports progress 0..1 of the stage; from the calling thread only. */
void crease_progress(crease_context *context, double fraction);
/* True once the caller wants to stop. Asks the callback; from the calling thread only. */
bool crease_cancelled(crease_context *context);
/* The status and message of cancelled work. */
crease_status crease_fail_cancelled(crease_context *context);

/* Makes the n-th allocation from now fail (0 = the next one, negative = none): for tests. */
void crease_context_fail_allocation(crease_context *context, long n);

#endif
