/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Memory with checked sizes. Every allocation of the library goes through here, so that a test can
 * let each one fail in turn. Released by free(). */
#ifndef CREASE_BASE_MEMORY_H
#define CREASE_BASE_MEMORY_H

#include "base/context.h"

/* count elements of size bytes, zeroed; never NULL for zero bytes. On failure NULL, and the
 * context's message says so. Thread-safe. */
void *crease_allocate(crease_context *context, size_t count, size_t size);

/* Room for count elements of size bytes in a block got from crease_allocate; new bytes are not set.
 * On failure NULL, and the old block stays. */
void *crease_reallocate(crease_context *context, void *block, size_t count, size_t size);

/* A copy of count elements of size bytes. */
void *crease_duplicate(crease_context *context, const void *from, size_t count, size_t size);

#endif
