/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Things put one behind the other as bytes, for another process of the same program. */
#ifndef CREASE_BASE_PACKING_H
#define CREASE_BASE_PACKING_H

#include "base/memory.h"

#include <string.h>

/* Counts the bytes; writes them where there is room. */
typedef struct crease_packing {
    char *to;
    size_t size;
} crease_packing;

typedef void crease_packing_body(crease_packing *out, const void *user);

static inline void crease_packing_put(crease_packing *out, const void *bytes, size_t size)
{
    if (out->to && size)
        memcpy(out->to + out->size, bytes, size);
    out->size += size;
}

/* Calls the body to count, and again to write; free() the bytes. Errors: NO_MEMORY. */
static inline crease_status crease_packing_make(crease_context *context, crease_packing_body *body,
    const void *user, char **bytes, size_t *size)
{
    crease_packing out = {0};
    body(&out, user);
    *size = out.size;
    *bytes = out.to = crease_allocate(context, out.size, 1);
    if (!out.to)
        return CREASE_ERROR_NO_MEMORY;
    out.size = 0;
    body(&out, user);
    return CREASE_OK;
}

#endif
