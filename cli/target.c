/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "target.h"

#include "cad.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static const struct {
    target_kind kind;
    const char *extensions[8];
} kinds[] = {
    {TARGET_CAD, {".step", ".stp", ".iges", ".igs", ".brep"}},
    {TARGET_CLOUD, {".ply", ".pcd", ".xyz", ".txt", ".csv", ".asc", ".pts"}},
    {TARGET_MESH, {".ply", ".obj", ".stl", ".glb"}},
    {TARGET_LINES, {".ply", ".obj", ".csv"}},
    {TARGET_FIGURE, {".png", ".svg", ".pdf"}},
    {TARGET_PAGE, {".html"}},
    {TARGET_REPORT, {".json"}},
};
enum { KINDS = sizeof kinds / sizeof kinds[0], MOST_EXTENSIONS = 8 };

static bool ends_with(const char *path, const char *extension)
{
    const size_t length = strlen(path), tail = strlen(extension);
    return length > tail && strcasecmp(path + length - tail, extension) == 0;
}

target_kind target_of(const char *path, int allowed)
{
    for (size_t k = 0; k < KINDS; k++)
        for (size_t i = 0; i < MOST_EXTENSIONS && kinds[k].extensions[i]; i++)
            if (allowed & (int)kinds[k].kind && ends_with(path, kinds[k].extensions[i]))
                return kinds[k].kind;
    return 0;
}

static void list_extensions(int allowed, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 0; k < KINDS; k++)
        for (size_t i = 0; i < MOST_EXTENSIONS && kinds[k].extensions[i]; i++)
            if (allowed & (int)kinds[k].kind && used < size)
                used += (size_t)snprintf(
                    text + used, size - used, "%s%s", used ? " " : "", kinds[k].extensions[i]);
}

crease_status target_check(crease_context *context, const char *path, int allowed)
{
    if (!path)
        return CREASE_OK;
    if (!target_of(path, allowed)) {
        char list[256];
        list_extensions(allowed, list, sizeof list);
        return crease_context_fail(context, CREASE_ERROR_ARGUMENT,
            "%s: nothing is known to write there; use one of %s", path, list);
    }
    if (target_of(path, allowed) == TARGET_CAD && cad_check(context, path) != CREASE_OK)
        return CREASE_ERROR_UNSUPPORTED;
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    const bool writable = folder && access(folder, W_OK) == 0;
    const int reason = errno;
    free(folder);
    if (!writable)
        return crease_context_fail(context, CREASE_ERROR_CANNOT_WRITE,
            "%s: the folder cannot be written (%s)", path, strerror(reason));
    return CREASE_OK;
}

crease_status targets_check(crease_context *context, const settings *s, int allowed)
{
    for (size_t i = 0; i < s->output_count; i++) {
        const crease_status status = target_check(context, s->outputs[i], allowed);
        if (status != CREASE_OK)
            return status;
    }
    return CREASE_OK;
}

const char *target_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

crease_status target_write_report(crease_context *context, report *r, const char *path)
{
    if (!path)
        return CREASE_OK;
    char *text = report_text(r);
    if (!text)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = crease_file_write(context, path, text, strlen(text));
    free(text);
    return status;
}
