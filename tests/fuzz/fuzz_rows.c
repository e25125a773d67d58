/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Reading a file in parts, on any bytes. The first byte says how many rows are read at once. Where
 * the file can be read whole and in parts, both must give the same points. */
#define _XOPEN_SOURCE 700
#include "read/formats.h"
#include "read/rows.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Reads all rows; true when that worked. whole: NULL, or what they must be. */
static bool in_parts(
    crease_context *context, crease_rows *rows, size_t at_once, const crease_cloud *whole)
{
    const double *const points = whole ? crease_cloud_points(whole) : NULL;
    const size_t total = crease_rows_count(rows);
    size_t count = 0;
    for (size_t at = 0; at < total; at += at_once) {
        crease_cloud *cloud = NULL;
        const size_t left = total - at, some = left < at_once ? left : at_once;
        if (crease_rows_read(context, rows, at, some, &cloud) != CREASE_OK)
            return false;
        const size_t got = crease_cloud_count(cloud);
        if (whole &&
            (count + got > crease_cloud_count(whole) ||
                memcmp(points + 3 * count, crease_cloud_points(cloud), 3 * got * sizeof *points)))
            abort();
        count += got;
        crease_cloud_free(cloud);
    }
    if (whole && count != crease_cloud_count(whole))
        abort();
    return true;
}

static void compare(crease_context *context, const char *path, const crease_source *source,
    size_t at_once, const crease_read_options *options)
{
    crease_rows *rows = NULL;
    crease_cloud *whole = NULL;
    const crease_status status = crease_rows_open(context, path, options, &rows);
    if (status != CREASE_OK && status != CREASE_ERROR_NO_MEMORY &&
        !*crease_context_message(context))
        abort();
    if (status == CREASE_OK) {
        crease_source_read(context, source, options, &whole);
        if (!in_parts(context, rows, at_once, whole) && whole)
            abort();
    }
    crease_cloud_free(whole);
    crease_rows_close(rows);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static FILE *file; /* one for all inputs */
    if (!file)
        file = tmpfile();
    if (size < 2 || !file || ftruncate(fileno(file), 0) != 0 ||
        pwrite(fileno(file), data + 1, size - 1, 0) != (ssize_t)(size - 1))
        return 0;
    char path[64];
    snprintf(path, sizeof path, "/proc/self/fd/%d", fileno(file));
    crease_context_options chosen = crease_context_options_default();
    chosen.threads = 1;
    crease_context *context = NULL;
    if (crease_context_create(&chosen, &context) != CREASE_OK)
        return 0;
    const crease_read_options options = {.skip_invalid = data[0] >= 128};
    crease_source source = {.name = path, .path = path, .size = size - 1, .bytes = malloc(size)};
    if (source.bytes) {
        memcpy(source.bytes, data + 1, size - 1);
        source.bytes[size - 1] = '\0';
        compare(context, path, &source, 1 + data[0] % 5, &options);
    }
    free(source.bytes);
    crease_context_free(context);
    return 0;
}
