/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* The size in bytes, or 0 when it overflows or this allocation is to fail. */
static size_t granted(crease_context *context, size_t count, size_t size)
{
    size_t bytes = 0;
    if (__builtin_mul_overflow(count ? count : 1, size ? size : 1, &bytes))
        return 0;
    if (atomic_load(&context->allocations) >= 0 && atomic_fetch_sub(&context->allocations, 1) == 0)
        return 0;
    return bytes;
}

/* Of threads that fail at the same time one writes the message. */
static void *refuse(crease_context *context, size_t count, size_t size)
{
    if (atomic_flag_test_and_set(&context->refusing))
        return NULL;
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
