/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#define _XOPEN_SOURCE 700 /* realpath */

#include "write/output.h"

#include "base/memory.h"
#include "write/decimal.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER_SIZE = 1 << 16, FORMAT_SIZE = 4096 };

struct crease_output {
    crease_context *context;
    const char *asked;        /* the path as given, for sentences */
    char target[PATH_MAX];    /* the file that is to be, symbolic links followed */
    char writing[PATH_MAX];   /* the file being written */
    bool direct;              /* a device or pipe: writing is the target itself */
    int file;                 /* descriptor, or -1 */
    crease_output_take *take; /* what gets the bytes instead of a file, or NULL */
    void *user;
    int error; /* errno of the first failure, or 0 */
    bool cancelled;
    size_t used;
    unsigned char buffer[BUFFER_SIZE];
};

static const char *advice(int error)
{
    switch (error) {
    case ENOSPC:
    case EDQUOT:
        return "free some space or write elsewhere";
    case ENOENT:
    case ENOTDIR:
        return "make the directory first or write elsewhere";
    case EISDIR:
        return "give the name of a file";
    case ENAMETOOLONG:
        return "give a shorter name";
    default:
        return "write elsewhere";
    }
}

static crease_status fail(crease_context *context, const char *path, int error)
{
    char reason[128];
    if (strerror_r(error, reason, sizeof reason) != 0)
        snprintf(reason, sizeof reason, "error %d", error);
    return crease_fail(context, CREASE_ERROR_CANNOT_WRITE, "%s: cannot be written (%s); %s", path,
        reason, advice(error));
}

bool crease_output_temporary_name(const char *target, char *out, size_t size)
{
    const char *slash = strrchr(target, '/');
    const char *name = slash ? slash + 1 : target;
    char ending[40];
    const int ending_length = snprintf(ending, sizeof ending, ".crease-%ld.tmp", (long)getpid());
    const int most = NAME_MAX - 1 - ending_length;
    const int length =
        snprintf(out, size, "%.*s.%.*s%s", (int)(name - target), target, most, name, ending);
    return length >= 0 && (size_t)length < size;
}

/* Finds out what the path is; returns errno or 0. *mode: permissions the file is to have. */
static int inspect(crease_output *output, const char *path, mode_t *mode)
{
    struct stat info;
    *mode = 0;
    if (stat(path, &info) != 0) {
        if (errno != ENOENT)
            return errno;
        if (strlen(path) >= sizeof output->target)
            return ENAMETOOLONG;
        snprintf(output->target, sizeof output->target, "%s", path);
        return 0;
    }
    if (S_ISDIR(info.st_mode))
        return EISDIR;
    if (!realpath(path, output->target))
        return errno;
    output->direct = !S_ISREG(info.st_mode);
    *mode = info.st_mode & 07777;
    return 0;
}

/* A file of this name left by a crashed process with our number is nobody's. */
static int open_new(const char *path)
{
    const int flags = O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC;
    const int file = open(path, flags, 0666);
    if (file >= 0 || errno != EEXIST || unlink(path) != 0)
        return file;
    return open(path, flags, 0666);
}

static int open_file(crease_output *output, const char *path)
{
    mode_t mode = 0;
    const int error = inspect(output, path, &mode);
    if (error)
        return error;
    if (output->direct) {
        snprintf(output->writing, sizeof output->writing, "%s", output->target);
        output->file = open(output->writing, O_WRONLY | O_CLOEXEC);
        return output->file < 0 ? errno : 0;
    }
    if (!crease_output_temporary_name(output->target, output->writing, sizeof output->writing))
        return ENAMETOOLONG;
    output->file = open_new(output->writing);
    if (output->file < 0)
        return errno;
    if (mode && fchmod(output->file, mode) != 0)
        output->error = errno;
    return 0;
}

crease_status crease_output_open(crease_context *context, const char *path, crease_output **out)
{
    *out = NULL;
    crease_output *output = crease_allocate(context, 1, sizeof *output);
    if (!output)
        return CREASE_ERROR_NO_MEMORY;
    output->context = context;
    output->asked = path;
    const int error = open_file(output, path);
    if (error) {
        free(output);
        return fail(context, path, error);
    }
    *out = output;
    return CREASE_OK;
}

crease_status crease_output_divert(
    crease_context *context, crease_output_take *take, void *user, crease_output **out)
{
    crease_output *const output = *out = crease_allocate(context, 1, sizeof *output);
    if (!output)
        return CREASE_ERROR_NO_MEMORY;
    output->context = context;
    output->asked = "";
    output->direct = true;
    output->file = -1;
    output->take = take;
    output->user = user;
    return CREASE_OK;
}

static void write_out(crease_output *output, const unsigned char *bytes, size_t size)
{
    output->cancelled = output->cancelled || crease_cancelled(output->context);
    if (output->take) {
        if (size && !crease_output_failed(output) && !output->take(output->user, bytes, size))
            output->error = EIO;
        output->cancelled = output->cancelled || crease_cancelled(output->context);
        return;
    }
    while (size && !crease_output_failed(output)) {
        const ssize_t written = write(output->file, bytes, size);
        if (written < 0 && errno != EINTR)
            output->error = errno;
        if (written > 0) {
            bytes += written;
            size -= (size_t)written;
        }
    }
}

static void flush(crease_output *output)
{
    write_out(output, output->buffer, output->used);
    output->used = 0;
}

static int finish(crease_output *output)
{
    flush(output);
    if (crease_output_failed(output) || output->direct)
        return output->error;
    if (fsync(output->file) != 0)
        return errno;
    return rename(output->writing, output->target) == 0 ? 0 : errno;
}

crease_status crease_output_close(
    crease_context *context, crease_output *output, crease_status status)
{
    if (!output)
        return status;
    if (status == CREASE_OK) {
        const int error = finish(output);
        if (output->cancelled)
            status = crease_fail_cancelled(context);
        else if (error)
            status = fail(context, output->asked, error);
    }
    if (output->file >= 0)
        close(output->file);
    if (status != CREASE_OK && !output->direct)
        unlink(output->writing);
    free(output);
    return status;
}

bool crease_output_failed(const crease_output *output)
{
    return output->error != 0 || output->cancelled;
}

const char *crease_output_path(const crease_output *output)
{
    return output->writing;
}

void crease_output_bytes(crease_output *output, const void *bytes, size_t size)
{
    if (size > BUFFER_SIZE - output->used)
        flush(output);
    if (size > BUFFER_SIZE) {
        write_out(output, bytes, size);
        return;
    }
    memcpy(output->buffer + output->used, bytes, size);
    output->used += size;
}

void crease_output_text(crease_output *output, const char *text)
{
    crease_output_bytes(output, text, strlen(text));
}

void crease_output_format(crease_output *output, const char *format, ...)
{
    char text[FORMAT_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    crease_output_text(output, text);
}

void crease_output_double(crease_output *output, double value)
{
    char text[CREASE_DECIMAL_SIZE];
    crease_output_bytes(output, text, crease_decimal_print(value, text));
}

void crease_output_float(crease_output *output, float value)
{
    char text[CREASE_DECIMAL_SIZE];
    crease_output_bytes(output, text, crease_decimal_print_float(value, text));
}

static void write_little_endian(crease_output *output, uint64_t value, int size)
{
    unsigned char bytes[8];
    for (int i = 0; i < size; i++)
        bytes[i] = (unsigned char)(value >> (8 * i));
    crease_output_bytes(output, bytes, (size_t)size);
}

void crease_output_binary_u16(crease_output *output, uint16_t value)
{
    write_little_endian(output, value, 2);
}

void crease_output_binary_u32(crease_output *output, uint32_t value)
{
    write_little_endian(output, value, 4);
}

void crease_output_binary_f32(crease_output *output, float value)
{
    uint32_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    write_little_endian(output, bits, 4);
}

void crease_output_binary_f64(crease_output *output, double value)
{
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    write_little_endian(output, bits, 8);
}

static void name_extensions(
    const char *const *extensions, size_t count, char *sentence, size_t size)
{
    size_t used = 0;
    for (size_t i = 0; i < count && used < size; i++) {
        const char *between = i == 0 ? "" : (i + 1 == count ? " or " : ", ");
        const int length = snprintf(sentence + used, size - used, "%s.%s", between, extensions[i]);
        used += length > 0 ? (size_t)length : 0;
    }
}

crease_status crease_output_choose(crease_context *context, const char *path,
    const char *const *extensions, size_t count, size_t *choice)
{
    const char *slash = strrchr(path, '/');
    const char *point = strrchr(slash ? slash : path, '.');
    for (size_t i = 0; point && i < count; i++)
        if (strcasecmp(point + 1, extensions[i]) == 0) {
            *choice = i;
            return CREASE_OK;
        }
    char all[160] = "";
    name_extensions(extensions, count, all, sizeof all);
    return crease_fail(context, CREASE_ERROR_ARGUMENT,
        "%s: the name does not tell a format that can be written; end it in %s", path, all);
}
