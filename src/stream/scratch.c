/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "stream/scratch.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static crease_status refuse(crease_context *context, const char *folder, int error)
{
    char reason[128];
    if (strerror_r(error, reason, sizeof reason) != 0)
        snprintf(reason, sizeof reason, "error %d", error);
    return crease_fail(context, CREASE_ERROR_CANNOT_WRITE,
        "scratch file%s%s: cannot be written or read (%s); free some space or name another folder "
        "with --scratch",
        folder ? " in " : "", folder ? folder : "", reason);
}

crease_status crease_scratch_open(crease_context *context, const char *folder, int *file)
{
    char path[4096];
    const int length = snprintf(path, sizeof path, "%s/.crease-XXXXXX", folder);
    const bool fits = length > 0 && (size_t)length < sizeof path;
    *file = fits ? mkstemp(path) : -1;
    if (*file < 0)
        return refuse(context, folder, fits ? errno : ENAMETOOLONG);
    unlink(path);
    return CREASE_OK;
}

void crease_scratch_close(int file)
{
    if (file >= 0)
        close(file);
}

crease_status crease_scratch_get(
    crease_context *context, int file, size_t at, void *bytes, size_t size)
{
    for (char *to = bytes; size > 0;) {
        const ssize_t got = pread(file, to, size, (off_t)at);
        if (got == 0 || (got < 0 && errno != EINTR))
            return refuse(context, NULL, got < 0 ? errno : EIO);
        to += got > 0 ? got : 0;
        at += got > 0 ? (size_t)got : 0;
        size -= got > 0 ? (size_t)got : 0;
    }
    return CREASE_OK;
}

crease_status crease_scratch_put(
    crease_context *context, int file, size_t at, const void *bytes, size_t size)
{
    for (const char *from = bytes; size > 0;) {
        const ssize_t put = pwrite(file, from, size, (off_t)at);
        if (put == 0 || (put < 0 && errno != EINTR))
            return refuse(context, NULL, put < 0 ? errno : ENOSPC);
        from += put > 0 ? put : 0;
        at += put > 0 ? (size_t)put : 0;
        size -= put > 0 ? (size_t)put : 0;
    }
    return CREASE_OK;
}
