/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/context.h"

#include "base/parallel.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_THREADS = 1024 };

crease_context_options crease_context_options_default(void)
{
    return (crease_context_options){.threads = 0, .seed = 1};
}

crease_status crease_context_create(const crease_context_options *options, crease_context **out)
{
    *out = NULL;
    const crease_context_options chosen = options ? *options : crease_context_options_default();
    if (chosen.threads < 0 || chosen.threads > MOST_THREADS)
        return CREASE_ERROR_ARGUMENT;
    crease_context *context = calloc(1, sizeof *context);
    if (!context)
        return CREASE_ERROR_NO_MEMORY;
    context->options = chosen;
    if (context->options.threads == 0)
        context->options.threads = crease_parallel_processors();
    context->stage = "";
    atomic_init(&context->cancelled, false);
    atomic_init(&context->allocations, -1);
    atomic_flag_clear(&context->refusing);
    *out = context;
    return CREASE_OK;
}

void crease_context_free(crease_context *context)
{
    free(context);
}

const char *crease_context_message(const crease_context *context)
{
    return context->message;
}

int crease_context_threads(const crease_context *context)
{
    return context->options.threads;
}

uint64_t crease_context_seed(const crease_context *context)
{
    return context->options.seed;
}

crease_status crease_context_fail(
    crease_context *context, crease_status status, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(context->message, sizeof context->message, format, arguments);
    va_end(arguments);
    return status;
}

void crease_warn(crease_context *context, const char *format, ...)
{
    if (!context->options.warn)
        return;
    char sentence[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    context->options.warn(context->options.user, sentence);
}

void crease_stage(crease_context *context, const char *stage)
{
    context->stage = stage;
    crease_progress(context, 0.0);
}

void crease_progress(crease_context *context, double fraction)
{
    if (context->options.progress)
        context->options.progress(context->options.user, context->stage, fraction);
}

bool crease_cancelled(crease_context *context)
{
    if (context->options.cancelled && context->options.cancelled(context->options.user))
        atomic_store(&context->cancelled, true);
    return atomic_load(&context->cancelled);
}

crease_status crease_fail_cancelled(crease_context *context)
{
    atomic_store(&context->cancelled, false);
    return crease_fail(context, CREASE_ERROR_CANCELLED, "%s: cancelled before it was done",
        context->stage[0] ? context->stage : "crease");
}

void crease_context_fail_allocation(crease_context *context, long n)
{
    atomic_store(&context->allocations, n);
}
