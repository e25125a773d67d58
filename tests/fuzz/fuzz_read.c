/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Every reader, on any bytes. The first byte says which extension the file pretends to have, since
 * rows of numbers go by it. What is read must be a cloud that holds what it says; what is not must
 * have a sentence. */
#include "facets/draw.h"
#include "read/formats.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {
    "a.ply", "a.pcd", "a.xyz", "a.csv", "a.pts", "a.obj", "a.stl", "a.off", "a.las", "a", "-"};

static void look_at(const crease_cloud *cloud)
{
    const double *points = crease_cloud_points(cloud);
    double sum = 0.0;
    for (size_t i = 0; i < 3 * crease_cloud_count(cloud); i++)
        if (!isfinite(points[i]))
            abort();
    for (size_t f = 0; f < crease_cloud_field_count(cloud); f++) {
        const crease_field field = crease_cloud_field(cloud, f);
        for (size_t i = 0; i < crease_cloud_count(cloud); i++)
            sum += crease_field_value(&field, i);
    }
    volatile double used = sum;
    (void)used;
}

/* Points on its faces, where it is a mesh. */
static void draw_on(crease_context *context, const crease_source *source, const crease_cloud *cloud)
{
    crease_facets facets;
    crease_cloud *drawn = NULL;
    if (crease_source_faces(context, source, cloud, &facets) != CREASE_OK)
        return;
    if (facets.triangle_count && crease_facets_draw(context, &facets, 20, &drawn) == CREASE_OK)
        look_at(drawn);
    crease_cloud_free(drawn);
    crease_facets_free(&facets);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2)
        return 0;
    crease_context_options chosen = crease_context_options_default();
    chosen.threads = 1;
    crease_context *context = NULL;
    crease_cloud *cloud = NULL;
    if (crease_context_create(&chosen, &context) != CREASE_OK)
        return 0;
    const char *name = names[data[0] % (sizeof names / sizeof names[0])];
    const crease_read_options options = {.skip_invalid = data[0] >= 128};
    /* a block of its own, with the zero behind that a source has: one byte further is seen */
    crease_source source = {.name = name, .path = name, .size = size - 1, .bytes = malloc(size)};
    if (source.bytes) {
        memcpy(source.bytes, data + 1, size - 1);
        source.bytes[size - 1] = '\0';
        const crease_status status = crease_source_read(context, &source, &options, &cloud);
        if ((status == CREASE_OK) != (cloud != NULL))
            abort();
        if (cloud)
            look_at(cloud);
        if (cloud && !options.skip_invalid)
            draw_on(context, &source, cloud);
        if (!cloud && !*crease_context_message(context) && status != CREASE_ERROR_NO_MEMORY)
            abort();
    }
    crease_cloud_free(cloud);
    free(source.bytes);
    crease_context_free(context);
    return 0;
}
