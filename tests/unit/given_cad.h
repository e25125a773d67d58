/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A folder of its own for CAD files, writing into it and reading back. */
#ifndef CREASE_TESTS_GIVEN_CAD_H
#define CREASE_TESTS_GIVEN_CAD_H

#include "given_surfaces.h"

#include "crease/crease_cad.h"

#include <ftw.h>
#include <unistd.h>

static char folder[] = "/tmp/crease-cad-XXXXXX";

static inline const char *in_folder(const char *name)
{
    static _Thread_local char path[4][256];
    static _Thread_local int turn = 0;
    turn = (turn + 1) % 4;
    snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

static inline int remove_one(const char *path, const struct stat *info, int kind, struct FTW *walk)
{
    return remove(path);
}

static inline int make_folder(void **state)
{
    return mkdtemp(folder) ? 0 : -1;
}

static inline int remove_folder(void **state)
{
    return nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

static inline size_t read_bytes(const char *path, char **bytes)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    const size_t size = (size_t)ftell(file);
    rewind(file);
    *bytes = malloc(size + 1);
    assert_int_equal(fread(*bytes, 1, size, file), size);
    fclose(file);
    return size;
}

static inline void when_written(model *m, const char *path)
{
    const crease_status status =
        crease_cad_write(m->context, (const crease_surface *const *)m->surfaces, m->count, path);
    if (status != CREASE_OK)
        fail_msg("%d: %s", (int)status, crease_context_message(m->context));
}

static inline crease_cad_info when_read(model *m, const char *path)
{
    crease_cad_info info;
    const crease_status status = crease_cad_info_read(m->context, path, &info);
    if (status != CREASE_OK)
        fail_msg("%d: %s", (int)status, crease_context_message(m->context));
    return info;
}

static inline crease_cad_info when_written_and_read(model *m, const char *name)
{
    when_written(m, in_folder(name));
    return when_read(m, in_folder(name));
}

static inline void then_counts_are(const crease_cad_info *info, size_t solids, size_t faces,
    size_t edges, size_t vertices, size_t free_edges, size_t sharp_edges)
{
    assert_true(info->valid);
    assert_int_equal(info->solids, solids);
    assert_int_equal(info->faces, faces);
    assert_int_equal(info->edges, edges);
    assert_int_equal(info->vertices, vertices);
    assert_int_equal(info->free_edges, free_edges);
    assert_int_equal(info->sharp_edges, sharp_edges);
}

#endif
