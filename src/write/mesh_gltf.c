/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: The Khronos Group. glTF 2.0 specification. 2021, section 4 (GLB: a header of 12 bytes,
 * a JSON and a binary chunk, each a multiple of 4 bytes long). */
#include "write/mesh.h"

#include "base/vector.h"
#include "write/decimal.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
    JSON_SIZE = 4096,
    GLB_MAGIC = 0x46546C67,
    JSON_CHUNK = 0x4E4F534A,
    BINARY_CHUNK = 0x004E4942
};

typedef struct json {
    size_t length;
    char text[JSON_SIZE];
} json;

static void append(json *j, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void append(json *j, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length =
        vsnprintf(j->text + j->length, sizeof j->text - j->length, format, arguments);
    va_end(arguments);
    j->length += length > 0 ? (size_t)length : 0;
}

static void append_triple(json *j, const char *name, const double values[3], bool single)
{
    append(j, ",\"%s\":[", name);
    for (int c = 0; c < 3; c++) {
        char number[CREASE_DECIMAL_SIZE];
        if (single)
            crease_decimal_print_float((float)values[c], number);
        else
            crease_decimal_print(values[c], number);
        append(j, c ? ",%s" : "%s", number);
    }
    append(j, "]");
}

/* A position as written: relative to the middle. */
static float relative(const crease_mesh *mesh, const double middle[3], size_t i)
{
    return (float)(crease_mesh_vertices(mesh)[i] - middle[i % 3]);
}

static void append_accessors(json *j, const crease_mesh *mesh, const double middle[3])
{
    double lowest[3] = {INFINITY, INFINITY, INFINITY};
    double highest[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * crease_mesh_vertex_count(mesh); i++) {
        lowest[i % 3] = fmin(lowest[i % 3], (double)relative(mesh, middle, i));
        highest[i % 3] = fmax(highest[i % 3], (double)relative(mesh, middle, i));
    }
    const size_t vertices = crease_mesh_vertex_count(mesh);
    append(j, ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%zu", vertices);
    append(j, ",\"type\":\"VEC3\"");
    append_triple(j, "min", lowest, true);
    append_triple(j, "max", highest, true);
    append(j,
        "},{\"bufferView\":1,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"}"
        ",{\"bufferView\":2,\"componentType\":5125,\"count\":%zu,\"type\":\"SCALAR\"}]",
        vertices, 3 * crease_mesh_triangle_count(mesh));
}

static void append_buffers(json *j, size_t vertex_bytes, size_t index_bytes)
{
    append(j,
        ",\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":%zu,\"target\":34962}"
        ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"target\":34962}"
        ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"target\":34963}]"
        ",\"buffers\":[{\"byteLength\":%zu}]}",
        vertex_bytes, vertex_bytes, vertex_bytes, 2 * vertex_bytes, index_bytes,
        2 * vertex_bytes + index_bytes);
}

/* Two nodes: the outer one turns z up into y up, the inner one moves the mesh to its place. */
static void describe(json *j, const crease_mesh *mesh, const double middle[3])
{
    append(j, "{\"asset\":{\"version\":\"2.0\",\"generator\":\"crease %s\"}", crease_version());
    append(j,
        ",\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":["
        "{\"name\":\"z up\",\"rotation\":[-0.7071067811865476,0,0,0.7071067811865476]"
        ",\"children\":[1]},{\"name\":\"surfaces\",\"mesh\":0");
    append_triple(j, "translation", middle, false);
    append(j,
        "}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1}"
        ",\"indices\":2,\"material\":0}]}],\"materials\":[{\"doubleSided\":true"
        ",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.7}}]");
    append_accessors(j, mesh, middle);
    append_buffers(j, 12 * crease_mesh_vertex_count(mesh), 12 * crease_mesh_triangle_count(mesh));
    while (j->length % 4)
        append(j, " ");
}

/* The format wants unit normals everywhere, also where the surface has none. */
static void write_normal(crease_output *output, const double normal[3])
{
    const bool none = crease_vector_length(normal) < 0.5;
    for (int c = 0; c < 3; c++)
        crease_output_binary_f32(output, none ? (float)(c == 2) : (float)normal[c]);
}

void crease_mesh_write_gltf(crease_output *output, const crease_mesh *mesh)
{
    double lowest[3], highest[3], middle[3];
    crease_mesh_bounds(mesh, lowest, highest);
    for (int c = 0; c < 3; c++)
        middle[c] = 0.5 * lowest[c] + 0.5 * highest[c];
    json j = {.length = 0};
    describe(&j, mesh, middle);
    const size_t vertices = crease_mesh_vertex_count(mesh);
    const size_t triangles = crease_mesh_triangle_count(mesh);
    const size_t binary = 24 * vertices + 12 * triangles;
    crease_output_binary_u32(output, GLB_MAGIC);
    crease_output_binary_u32(output, 2);
    crease_output_binary_u32(output, (uint32_t)(12 + 8 + j.length + 8 + binary));
    crease_output_binary_u32(output, (uint32_t)j.length);
    crease_output_binary_u32(output, JSON_CHUNK);
    crease_output_bytes(output, j.text, j.length);
    crease_output_binary_u32(output, (uint32_t)binary);
    crease_output_binary_u32(output, BINARY_CHUNK);
    for (size_t i = 0; i < 3 * vertices; i++)
        crease_output_binary_f32(output, relative(mesh, middle, i));
    for (size_t i = 0; i < vertices; i++)
        write_normal(output, crease_mesh_normals(mesh) + 3 * i);
    for (size_t i = 0; i < 3 * triangles; i++)
        crease_output_binary_u32(output, crease_mesh_triangles(mesh)[i]);
}
