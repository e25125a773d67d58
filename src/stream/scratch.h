/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Files for what memory does not hold. They have no name: nothing is left of them, whatever ends
 * the process. */
#ifndef CREASE_STREAM_SCRATCH_H
#define CREASE_STREAM_SCRATCH_H

#include "base/context.h"

/* Opens one in a folder. Errors: CANNOT_WRITE. */
crease_status crease_scratch_open(crease_context *context, const char *folder, int *file);
/* Closes it; a negative number is fine. */
void crease_scratch_close(int file);
/* `size` bytes from byte `at` on. Errors: CANNOT_WRITE. */
crease_status crease_scratch_get(
    crease_context *context, int file, size_t at, void *bytes, size_t size);
crease_status crease_scratch_put(
    crease_context *context, int file, size_t at, const void *bytes, size_t size);

#endif
