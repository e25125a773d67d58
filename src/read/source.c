/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/source.h"

#include "base/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FIRST_ROOM = 1 << 16, MOST_AT_ONCE = 1 << 30 };

crease_status crease_source_refuse(crease_context *context, const char *name, int error)
{
    if (error == ENOENT || error == ENOTDIR)
        return crease_fail(context, CREASE_ERROR_NO_SUCH_FILE,
            "%s: there is no such file; check the name and the directory", name);
    if (error == EACCES || error == EPERM)
        return crease_fail(context, CREASE_ERROR_CANNOT_READ,
            "%s: no permission to read it; change its permissions or copy it", name);
    char reason[128];
    if (strerror_r(error, reason, sizeof reason) != 0)
        snprintf(reason, sizeof reason, "error %d", error);
    return crease_fail(
        context, CREASE_ERROR_CANNOT_READ, "%s: cannot be read (%s); check it", name, reason);
}

/* What can be read to an end: a file or a pipe. */
static crease_status check_kind(crease_context *context, const char *path, struct stat *info)
{
    if (stat(path, info) != 0)
        return crease_source_refuse(context, path, errno);
    if (S_ISDIR(info->st_mode))
        return crease_fail(context, CREASE_ERROR_CANNOT_READ,
            "%s: is a directory, not a file; name a file in it", path);
    if (S_ISCHR(info->st_mode) || S_ISBLK(info->st_mode))
        return crease_fail(context, CREASE_ERROR_CANNOT_READ,
            "%s: is a device, not a file; name a file, or - for standard input", path);
    return CREASE_OK;
}

static ssize_t read_some(int file, char *to, size_t room)
{
    ssize_t got;
    do
        got = read(file, to, room < MOST_AT_ONCE ? room : MOST_AT_ONCE);
    while (got < 0 && errno == EINTR);
    return got;
}

static crease_status grow(crease_context *context, crease_source *source, size_t *room)
{
    char *grown = crease_reallocate(context, source->bytes, 2 * *room, 1);
    if (!grown)
        return CREASE_ERROR_NO_MEMORY;
    source->bytes = grown;
    *room *= 2;
    return CREASE_OK;
}

/* Reads to the end, whatever the size said; room includes the zero byte behind. */
static crease_status read_all(crease_context *context, int file, size_t room, crease_source *source)
{
    source->bytes = crease_allocate(context, room, 1);
    if (!source->bytes)
        return CREASE_ERROR_NO_MEMORY;
    for (;;) {
        if (source->size + 1 == room && grow(context, source, &room) != CREASE_OK)
            return CREASE_ERROR_NO_MEMORY;
        const ssize_t got = read_some(file, source->bytes + source->size, room - 1 - source->size);
        if (got < 0)
            return crease_source_refuse(context, source->name, errno);
        if (got == 0)
            break;
        source->size += (size_t)got;
        if (crease_cancelled(context))
            return crease_fail_cancelled(context);
    }
    source->bytes[source->size] = '\0';
    return CREASE_OK;
}

static crease_status open_path(
    crease_context *context, const char *path, int *file, size_t *file_size)
{
    struct stat info;
    const crease_status status = check_kind(context, path, &info);
    if (status != CREASE_OK)
        return status;
    *file = open(path, O_RDONLY | O_CLOEXEC);
    *file_size = info.st_size > 0 ? (size_t)info.st_size : 0;
    return *file < 0 ? crease_source_refuse(context, path, errno) : CREASE_OK;
}

crease_status crease_source_open(crease_context *context, const char *path, crease_source *out)
{
    const bool standard = strcmp(path, "-") == 0;
    *out = (crease_source){.name = standard ? "standard input" : path, .path = path};
    int file = STDIN_FILENO;
    size_t file_size = 0;
    crease_status status = standard ? CREASE_OK : open_path(context, path, &file, &file_size);
    if (status != CREASE_OK)
        return status;
    status = read_all(context, file, file_size ? file_size + 2 : FIRST_ROOM, out);
    if (!standard)
        close(file);
    if (status == CREASE_OK && out->size == 0)
        status = crease_fail(context, CREASE_ERROR_TRUNCATED,
            "%s: is empty; write the cloud again or name another file", out->name);
    if (status != CREASE_OK)
        crease_source_free(out);
    return status;
}

void crease_source_free(crease_source *source)
{
    free(source->bytes);
    source->bytes = NULL;
}

bool crease_source_peek(
    const char *path, char *head, size_t room, size_t *head_size, size_t *file_size)
{
    struct stat info;
    if (stat(path, &info) != 0 || !S_ISREG(info.st_mode))
        return false;
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return false;
    const ssize_t got = read_some(file, head, room);
    close(file);
    *head_size = got > 0 ? (size_t)got : 0;
    *file_size = info.st_size > 0 ? (size_t)info.st_size : 0;
    return got >= 0;
}

bool crease_source_get(int file, char *to, size_t room, size_t from, size_t *size)
{
    *size = 0;
    while (*size < room) {
        const size_t left = room - *size;
        const ssize_t got = pread(
            file, to + *size, left < MOST_AT_ONCE ? left : MOST_AT_ONCE, (off_t)(from + *size));
        if (got < 0 && errno != EINTR)
            return false;
        if (got == 0)
            break;
        *size += got > 0 ? (size_t)got : 0;
    }
    return true;
}
