/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/store.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_ARRAYS = 8, MOST_AT_ONCE = 1 << 26 };

/* At the beginning of a file; a sum of all arrays stands at its end. The sizes are in the order of
 * this machine's bytes, and so tell a file of another one. */
typedef struct head {
    char magic[16];
    uint64_t key, count, sizes[MOST_ARRAYS];
} head;

static const char magic[16] = "crease stage 1\n";

uint64_t crease_store_key(uint64_t key, const void *bytes, size_t size)
{
    const unsigned char *const from = bytes;
    const uint64_t odd = 0x9E3779B97F4A7C15u;
    for (size_t i = 0; i < size; i += sizeof(uint64_t)) {
        uint64_t word = 0;
        memcpy(&word, from + i, size - i < sizeof word ? size - i : sizeof word);
        key = (key ^ word) * odd;
        key ^= key >> 29;
    }
    return (key ^ size) * odd;
}

static head make_head(uint64_t key, const crease_stored *arrays, size_t count)
{
    head out = {.key = key, .count = count};
    memcpy(out.magic, magic, sizeof magic);
    for (size_t i = 0; i < count; i++)
        out.sizes[i] = arrays[i].size;
    return out;
}

static bool make_path(
    const crease_context *context, const char *stage, const char *ending, char path[PATH_MAX])
{
    const int length = snprintf(path, PATH_MAX, "%s/%s.stage%s", context->kept, stage, ending);
    return length > 0 && length < PATH_MAX;
}

static bool read_whole(int file, void *to, size_t size)
{
    char *at = to;
    while (size > 0) {
        const ssize_t got = read(file, at, size < MOST_AT_ONCE ? size : MOST_AT_ONCE);
        if (got == 0 || (got < 0 && errno != EINTR))
            return false;
        at += got > 0 ? got : 0;
        size -= got > 0 ? (size_t)got : 0;
    }
    return true;
}

static bool write_whole(int file, const void *from, size_t size)
{
    const char *at = from;
    while (size > 0) {
        const ssize_t put = write(file, at, size < MOST_AT_ONCE ? size : MOST_AT_ONCE);
        if (put < 0 && errno != EINTR)
            return false;
        at += put > 0 ? put : 0;
        size -= put > 0 ? (size_t)put : 0;
    }
    return true;
}

static uint64_t sum_of(const crease_stored *arrays, size_t count)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < count; i++)
        sum = crease_store_key(sum, arrays[i].values, arrays[i].size);
    return sum;
}

static bool load(int file, uint64_t key, const crease_stored *arrays, size_t count)
{
    const head wanted = make_head(key, arrays, count);
    head found;
    uint64_t sum = 0;
    if (!read_whole(file, &found, sizeof found) || memcmp(&found, &wanted, sizeof found) != 0)
        return false;
    for (size_t i = 0; i < count; i++)
        if (!read_whole(file, arrays[i].values, arrays[i].size))
            return false;
    return read_whole(file, &sum, sizeof sum) && sum == sum_of(arrays, count);
}

bool crease_store_load(crease_context *context, const char *stage, uint64_t key,
    const crease_stored *arrays, size_t count)
{
    char path[PATH_MAX];
    if (!context->kept || !make_path(context, stage, "", path))
        return false;
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return false;
    const bool loaded = load(file, key, arrays, count);
    close(file);
    if (loaded)
        crease_warn(context, "%s: taken from %s", stage, path);
    return loaded;
}

static bool save(int file, uint64_t key, const crease_stored *arrays, size_t count)
{
    const head first = make_head(key, arrays, count);
    const uint64_t sum = sum_of(arrays, count);
    bool whole = write_whole(file, &first, sizeof first);
    for (size_t i = 0; i < count && whole; i++)
        whole = write_whole(file, arrays[i].values, arrays[i].size);
    return whole && write_whole(file, &sum, sizeof sum) && fsync(file) == 0;
}

void crease_store_save(crease_context *context, const char *stage, uint64_t key,
    const crease_stored *arrays, size_t count)
{
    char path[PATH_MAX], beside[PATH_MAX], ending[32];
    snprintf(ending, sizeof ending, ".%ld.tmp", (long)getpid());
    if (!context->kept || !make_path(context, stage, "", path) ||
        !make_path(context, stage, ending, beside))
        return;
    const int file = open(beside, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    bool kept = file >= 0 && save(file, key, arrays, count);
    if (file >= 0)
        close(file);
    kept = kept && rename(beside, path) == 0;
    if (!kept) {
        unlink(beside);
        crease_warn(context, "%s: cannot be kept in %s; a later run begins with it anew", stage,
            context->kept);
    }
}

static crease_status refuse(crease_context *context, const char *folder, const char *what)
{
    return crease_fail(context, CREASE_ERROR_CANNOT_WRITE,
        "%s: %s; name a folder that can be written", folder, what);
}

crease_status crease_context_keep(crease_context *context, const char *folder)
{
    struct stat info;
    context->kept = NULL;
    if (!folder)
        return CREASE_OK;
    if (strlen(folder) >= PATH_MAX / 2)
        return refuse(context, folder, "the name is too long");
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return refuse(context, folder, "cannot be made");
    if (stat(folder, &info) != 0 || !S_ISDIR(info.st_mode))
        return refuse(context, folder, "is no folder");
    if (access(folder, W_OK | X_OK) != 0)
        return refuse(context, folder, "nothing can be written there");
    context->kept = folder;
    return CREASE_OK;
}
