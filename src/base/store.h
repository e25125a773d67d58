/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What finished stages found, kept in the context's folder, so that work that was broken off can go
 * on from there. A file belongs to one key, which is made from everything that the stage depends
 * on; a file of another key, or a damaged one, is as good as none. Written beside and renamed. */
#ifndef CREASE_BASE_STORE_H
#define CREASE_BASE_STORE_H

#include "base/context.h"

typedef struct crease_stored {
    void *values;
    size_t size; /* bytes */
} crease_stored;

/* A key: begin with 0, and add whatever matters. */
uint64_t crease_store_key(uint64_t key, const void *bytes, size_t size);
/* Fills the arrays from the file of a stage; false when there is none that fits, or no folder: what
 * the arrays hold then is undefined. */
bool crease_store_load(crease_context *context, const char *stage, uint64_t key,
    const crease_stored *arrays, size_t count);
/* Keeps the arrays; does nothing without a folder. What cannot be kept is said in a warning: the
 * work goes on. */
void crease_store_save(crease_context *context, const char *stage, uint64_t key,
    const crease_stored *arrays, size_t count);

#endif
