/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/formats.h"
#include "read/number.h"
#include "read/span.h"

#include <string.h>
#include <strings.h>

enum { HEAD_SIZE = 4096, IGES_LINE = 73 };

static const crease_format formats[] = {
    {"PLY", "a PLY file", crease_ply_read, crease_ply_faces},
    {"PCD", "a PCD file", crease_pcd_read, NULL},
    {"XYZ", "rows of numbers", crease_xyz_read, NULL},
    {"OBJ", "a Wavefront OBJ file", crease_obj_read, crease_obj_faces},
    {"STL", "an STL file", crease_stl_read, crease_stl_faces},
    {"OFF", "an OFF file", crease_off_read, crease_off_faces},
    {"LAS", "a LAS file", crease_las_read, NULL},
    {"STEP", "a CAD model (STEP)", NULL, NULL},
    {"IGES", "a CAD model (IGES)", NULL, NULL},
    {"BREP", "a CAD model (BREP)", NULL, NULL},
    {"GLB", "a scene (binary glTF)", NULL, NULL},
    {"HTML", "a web page (HTML)", NULL, NULL},
    {"JSON", "data in JSON", NULL, NULL},
    {"PNG", "a picture (PNG)", NULL, NULL},
    {"JPEG", "a picture (JPEG)", NULL, NULL},
    {"PDF", "a document (PDF)", NULL, NULL},
    {"ZIP", "an archive (ZIP)", NULL, NULL},
    {"GZIP", "a compressed file (gzip)", NULL, NULL},
    {"ELF", "a program (ELF)", NULL, NULL},
    {"E57", "an E57 scan", NULL, NULL},
    {"XML", "data in XML", NULL, NULL},
    {"SVG", "a drawing (SVG)", NULL, NULL},
};

static const crease_format *named(const char *name)
{
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (strcmp(formats[i].name, name) == 0)
            return &formats[i];
    return NULL;
}

/* ---------------------------------------------------------------------------- by signature -- */

typedef struct signature {
    const char *bytes, *name;
} signature;

static bool begins(crease_span head, const char *bytes)
{
    const size_t length = strlen(bytes);
    return (size_t)(head.end - head.at) >= length && memcmp(head.at, bytes, length) == 0;
}

/* Signatures at the very first byte. */
static const char *by_first_bytes(crease_span head)
{
    static const signature signatures[] = {{"ply\n", "PLY"}, {"ply\r", "PLY"}, {"ply ", "PLY"},
        {"# .PCD", "PCD"}, {"ISO-10303-21", "STEP"}, {"DBRep_DrawableShape", "BREP"},
        {"CASCADE Topology", "BREP"}, {"glTF", "GLB"}, {"\x89PNG", "PNG"}, {"\xff\xd8\xff", "JPEG"},
        {"%PDF", "PDF"}, {"PK\x03\x04", "ZIP"}, {"\x1f\x8b", "GZIP"},
        {"\x7f"
         "ELF",
            "ELF"},
        {"LASF", "LAS"}, {"ASTM-E57", "E57"}};
    for (size_t i = 0; i < sizeof signatures / sizeof signatures[0]; i++)
        if (begins(head, signatures[i].bytes))
            return signatures[i].name;
    return NULL;
}

/* IGES: lines of 80 characters, an S for the start section in column 73. */
static bool is_iges(crease_span head)
{
    if (head.end - head.at < IGES_LINE + 7 || head.at[IGES_LINE - 1] != 'S')
        return false;
    for (int i = 0; i < IGES_LINE + 7; i++)
        if (head.at[i] < ' ' || head.at[i] > '~')
            return false;
    return head.at[IGES_LINE + 6] == '1';
}

/* The first word of the first line that is neither blank nor a comment. */
static crease_span first_word(crease_span head, bool *alone)
{
    crease_cursor cursor = {.at = head.at, .end = head.end};
    crease_span line = {head.at, head.at}, word = line;
    while (crease_cursor_line(&cursor, &line))
        if (crease_span_word(&line, &word) && *word.at != '#')
            break;
    *alone = crease_skip_blanks(line.at, line.end) == line.end;
    return word;
}

static bool is_off(crease_span word)
{
    return word.end - word.at >= 3 && word.end - word.at <= 8 &&
        crease_span_is((crease_span){word.end - 3, word.end}, "OFF");
}

/* Signatures that are words of text. */
static const char *by_first_word(crease_span head)
{
    static const signature words[] = {{"<!doctype", "HTML"}, {"<html", "HTML"}, {"<svg", "SVG"},
        {"<?xml", "XML"}, {"version", "PCD"}, {"fields", "PCD"}, {"columns", "PCD"}, {"v", "OBJ"},
        {"vn", "OBJ"}, {"vt", "OBJ"}, {"mtllib", "OBJ"}, {"o", "OBJ"}};
    bool alone = false;
    const crease_span word = first_word(head, &alone);
    if (word.at == word.end)
        return NULL;
    if (*word.at == '{' || *word.at == '[')
        return "JSON";
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (!alone && crease_span_is_like(word, words[i].bytes))
            return words[i].name;
    if (crease_span_is_like(word, "<html>"))
        return "HTML";
    return is_off(word) ? "OFF" : NULL;
}

static bool contains(crease_span head, const char *word)
{
    for (; head.at < head.end; head.at++)
        if (*head.at == *word && begins(head, word))
            return true;
    return false;
}

static bool is_ascii_stl(crease_span head)
{
    return begins(head, "solid") && (contains(head, "facet") || contains(head, "endsolid"));
}

static const char *by_signature(crease_span head, size_t file_size)
{
    const char *name = by_first_bytes(head);
    if (name)
        return name;
    if (is_iges(head))
        return "IGES";
    if (crease_stl_is_binary(head.at, (size_t)(head.end - head.at), file_size) ||
        is_ascii_stl(head))
        return "STL";
    return by_first_word(head);
}

/* --------------------------------------------------------------------------------- otherwise -- */

static const char *by_extension(const char *path)
{
    static const signature extensions[] = {{"ply", "PLY"}, {"pcd", "PCD"}, {"xyz", "XYZ"},
        {"txt", "XYZ"}, {"csv", "XYZ"}, {"asc", "XYZ"}, {"pts", "XYZ"}, {"obj", "OBJ"},
        {"stl", "STL"}, {"off", "OFF"}, {"xyzn", "XYZ"}, {"xyzrgb", "XYZ"}};
    const char *slash = strrchr(path, '/');
    const char *point = strrchr(slash ? slash : path, '.');
    for (size_t i = 0; point && i < sizeof extensions / sizeof extensions[0]; i++)
        if (strcasecmp(point + 1, extensions[i].bytes) == 0)
            return extensions[i].name;
    return NULL;
}

/* The first line that is neither blank nor a comment begins with a number. */
static bool is_rows(crease_span head)
{
    bool alone = false;
    const crease_span word = first_word(head, &alone);
    double value = 0;
    return crease_number_parse(word.at, word.end, true, &value) != NULL;
}

const crease_format *crease_format_find(
    const char *path, const char *head, size_t head_size, size_t file_size)
{
    const crease_span span = {head, head + (head_size < HEAD_SIZE ? head_size : HEAD_SIZE)};
    const char *name = by_signature(span, file_size);
    if (!name)
        name = by_extension(path);
    if (!name && is_rows(span))
        name = "XYZ";
    return name ? named(name) : NULL;
}

const char *crease_file_format(const char *path)
{
    char head[HEAD_SIZE];
    size_t head_size = 0, file_size = 0;
    if (!crease_source_peek(path, head, sizeof head, &head_size, &file_size) || !head_size)
        return NULL;
    const crease_format *format = crease_format_find(path, head, head_size, file_size);
    return format ? format->name : NULL;
}
