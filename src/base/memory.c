/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/memory.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What a sanitizer takes for itself is not the program's, and far more than that. */
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED 1
#endif
#endif
#if defined(SANITIZED) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
static const bool counted = false;
#else
static const bool counted = true;
#endif

/* Blocks below this are not held against the limit, which takes a system call. */
static const size_t SMALL = 1 << 16;

/* Bytes that the process has in memory; 0 when that is not told. */
static size_t resident(void)
{
    char text[128] = "";
    size_t pages = 0;
    const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return 0;
    if (read(file, text, sizeof text - 1) > 0)
        sscanf(text, "%*s %zu", &pages);
    close(file);
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

static bool within_limit(const crease_context *context, size_t bytes)
{
    const size_t most = context->options.memory;
    return !counted || !most || bytes < SMALL || (bytes <= most && resident() <= most - bytes);
}

/* The size in bytes, or 0 when it overflows or this allocation is to fail. */
static size_t granted(crease_context *context, size_t count, size_t size)
{
    size_t bytes = 0;
    if (__builtin_mul_overflow(count ? count : 1, size ? size : 1, &bytes))
        return 0;
    if (atomic_load(&context->allocations) >= 0 && atomic_fetch_sub(&context->allocations, 1) == 0)
        return 0;
    return within_limit(context, bytes) ? bytes : 0;
}

/* Of threads that fail at the same time one writes the message. */
static void *refuse(crease_context *context, size_t count, size_t size)
{
    if (atomic_flag_test_and_set(&context->refusing))
        return NULL;
    if (context->options.memory)
        crease_fail(context, CREASE_ERROR_NO_MEMORY,
            "memory ran out: %zu elements of %zu bytes are not to be had within the limit of %.3g "
            "GB; give more, or use fewer points",
            count, size, (double)context->options.memory / 1e9);
    else
        crease_fail(context, CREASE_ERROR_NO_MEMORY,
            "memory ran out: %zu elements of %zu bytes are not to be had; use fewer points", count,
            size);
    atomic_flag_clear(&context->refusing);
    return NULL;
}

void *crease_allocate(crease_context *context, size_t count, size_t size)
{
    const size_t bytes = granted(context, count, size);
    void *block = bytes ? calloc(1, bytes) : NULL;
    return block ? block : refuse(context, count, size);
}

void *crease_reallocate(crease_context *context, void *block, size_t count, size_t size)
{
    const size_t bytes = granted(context, count, size);
    void *grown = bytes ? realloc(block, bytes) : NULL;
    return grown ? grown : refuse(context, count, size);
}

void *crease_duplicate(crease_context *context, const void *from, size_t count, size_t size)
{
    void *copy = crease_allocate(context, count, size);
    if (copy && count)
        memcpy(copy, from, count * size);
    return copy;
}
