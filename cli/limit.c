/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "limit.h"

#include "input.h"

#include "crease/crease_stream.h"

#include <sys/stat.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

/* The program itself and its libraries, with what these keep. */
static const size_t PROGRAM = 40000000;

void limit_prepare(const settings *s)
{
#ifdef __GLIBC__
    enum { LARGE = 1 << 18 }; /* such blocks go back to the system when they are freed */
    if (s->memory) {
        mallopt(M_MMAP_THRESHOLD, LARGE);
        mallopt(M_TRIM_THRESHOLD, LARGE);
    }
#else
    (void)s;
#endif
}

size_t limit_left(const settings *s)
{
    return s->memory > PROGRAM ? s->memory - PROGRAM : 0;
}

static crease_status refuse(
    crease_context *context, const settings *s, const char *path, double bytes)
{
    return crease_context_fail(context, CREASE_ERROR_NO_MEMORY,
        "%s: takes about %.3g GB, more than --memory allows (%.3g GB); give more, or a PLY, LAS, "
        "XYZ or CSV file, which is read in parts",
        path, (bytes + (double)PROGRAM) / 1e9, (double)s->memory / 1e9);
}

crease_status limit_check(crease_context *context, const settings *s, size_t points, size_t each)
{
    const double bytes = (double)points * (double)each;
    return s->memory && bytes > (double)limit_left(s)
        ? refuse(context, s, s->inputs[s->input_count - 1], bytes)
        : CREASE_OK;
}

crease_status limit_exceeded(
    crease_context *context, const settings *s, size_t each, bool *exceeded)
{
    const char *path = NULL;
    struct stat info;
    size_t count = 0, bytes = 0;
    *exceeded = false;
    if (!s->memory)
        return CREASE_OK;
    crease_status status =
        input_path(context, s, "the file to read, or - for standard input", &path);
    if (status != CREASE_OK)
        return status;
    status = crease_stream_need(context, path, &s->read, &count, &bytes);
    if (status == CREASE_OK) {
        const double file = (double)bytes - (double)count * LIMIT_DETECT;
        *exceeded = (double)count * (double)each + file > (double)limit_left(s);
        return CREASE_OK;
    }
    if (status == CREASE_ERROR_UNSUPPORTED && stat(path, &info) == 0 && S_ISREG(info.st_mode) &&
        (double)info.st_size > (double)limit_left(s))
        return refuse(context, s, path, (double)info.st_size);
    return CREASE_OK;
}
