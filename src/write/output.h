/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A file that is there whole or not at all: written beside the target, brought to the disk, then
 * renamed. Whatever fails, and when the context is cancelled, the old file stays as it was and
 * nothing is left beside it. A target that is a device or a pipe is written directly; through a
 * symbolic link its target is replaced.
 *
 * Use: open; any number of writes, none of which needs a check; close, which tells what failed:
 *
 *     crease_output *output = NULL;
 *     crease_status status = crease_output_open(context, path, &output);
 *     if (status != CREASE_OK)
 *         return status;
 *     crease_output_text(output, "ply\n");
 *     return crease_output_close(context, output, CREASE_OK);
 *
 * From the calling thread only. */
#ifndef CREASE_WRITE_OUTPUT_H
#define CREASE_WRITE_OUTPUT_H

#include "base/context.h"

typedef struct crease_output crease_output;

/* Begins to write a file. Errors: CANNOT_WRITE, NO_MEMORY. */
crease_status crease_output_open(crease_context *context, const char *path, crease_output **out);
/* Begins to write to something else than a file: `take` gets the bytes, some at a time, and tells
 * whether it took them. Errors: NO_MEMORY. */
typedef bool crease_output_take(void *user, const void *bytes, size_t size);
crease_status crease_output_divert(
    crease_context *context, crease_output_take *take, void *user, crease_output **out);
/* Finishes: with CREASE_OK the file takes its name, with any other status it is removed and that
 * status returned. Frees the output in any case (NULL is fine: the status is returned).
 * Errors: CANNOT_WRITE, CANCELLED. */
crease_status crease_output_close(
    crease_context *context, crease_output *output, crease_status status);
/* True once a write has failed or the context was cancelled: what follows is not written. */
bool crease_output_failed(const crease_output *output);

void crease_output_bytes(crease_output *output, const void *bytes, size_t size);
void crease_output_text(crease_output *output, const char *text);
/* At most 4095 bytes; for whole numbers and strings only, because %g follows the locale. */
void crease_output_format(crease_output *output, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* A number as text, the shortest that reads back, always with a point. */
void crease_output_double(crease_output *output, double value);
void crease_output_float(crease_output *output, float value);
/* Numbers in binary, little endian. */
void crease_output_binary_u16(crease_output *output, uint16_t value);
void crease_output_binary_u32(crease_output *output, uint32_t value);
void crease_output_binary_f32(crease_output *output, float value);
void crease_output_binary_f64(crease_output *output, double value);

/* The file being written, for a library that writes by name: it may truncate or replace it. */
const char *crease_output_path(const crease_output *output);
/* Where a target is written before it takes its name: `.name.crease-PID.tmp` beside it. A program
 * that dies at once on a signal can remove this. False when the name does not fit. */
bool crease_output_temporary_name(const char *target, char *out, size_t size);

/* Which of the extensions (without the point, any case) the path has. Otherwise ARGUMENT, with a
 * sentence that names them all. */
crease_status crease_output_choose(crease_context *context, const char *path,
    const char *const *extensions, size_t count, size_t *choice);

#endif
