/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Clouds read from bytes in memory: the block ends where the file ends, so that a sanitizer sees
 * every step behind it. And what every reader must survive. */
#ifndef CREASE_TESTS_GIVEN_BYTES_H
#define CREASE_TESTS_GIVEN_BYTES_H

#include "given.h"

#include "base/random.h"
#include "read/formats.h"

static char last_warning[512];

static inline void keep_warning(void *user, const char *sentence)
{
    (void)user;
    snprintf(last_warning, sizeof last_warning, "%s", sentence);
}

static inline crease_context *given_reader_with_threads(int threads)
{
    crease_context_options options = crease_context_options_default();
    options.threads = threads;
    options.warn = keep_warning;
    last_warning[0] = '\0';
    crease_context *context = NULL;
    assert_int_equal(crease_context_create(&options, &context), CREASE_OK);
    return context;
}

static inline crease_context *given_reader(void)
{
    return given_reader_with_threads(2);
}

static inline crease_status read_bytes(crease_context *context, const char *name, const void *bytes,
    size_t size, bool skip_invalid, crease_cloud **out)
{
    const crease_read_options options = {.skip_invalid = skip_invalid};
    crease_source source = {.name = name, .path = name, .size = size, .bytes = malloc(size + 1)};
    assert_non_null(source.bytes);
    memcpy(source.bytes, bytes, size);
    source.bytes[size] = '\0';
    *out = NULL;
    const crease_status status = crease_source_read(context, &source, &options, out);
    assert_true((status == CREASE_OK) == (*out != NULL));
    free(source.bytes);
    return status;
}

static inline crease_cloud *when_read(
    crease_context *context, const char *name, const void *bytes, size_t size)
{
    crease_cloud *cloud = NULL;
    if (read_bytes(context, name, bytes, size, false, &cloud) != CREASE_OK)
        fail_msg("%s", crease_context_message(context));
    return cloud;
}

static inline crease_cloud *when_text_read(
    crease_context *context, const char *name, const char *text)
{
    return when_read(context, name, text, strlen(text));
}

static inline void then_point_is(
    const crease_cloud *cloud, size_t index, double x, double y, double z)
{
    assert_true(index < crease_cloud_count(cloud));
    const double *point = crease_cloud_points(cloud) + 3 * index;
    assert_near(point[0], x, 0);
    assert_near(point[1], y, 0);
    assert_near(point[2], z, 0);
}

static inline void then_field_is(
    const crease_cloud *cloud, const char *name, crease_type type, size_t index, double value)
{
    const crease_field field = crease_cloud_find_field(cloud, name);
    if (!field.name)
        fail_msg("there is no field '%s'", name);
    assert_int_equal(field.type, type);
    assert_near(crease_field_value(&field, index), value, 0);
}

/* The bytes are refused with this status, in a sentence that holds these words. */
static inline void then_bytes_fail(
    const char *name, const void *bytes, size_t size, crease_status status, const char *words)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    const crease_status found = read_bytes(context, name, bytes, size, false, &cloud);
    const char *message = crease_context_message(context);
    if (found != status || !strstr(message, words) || strncmp(message, name, strlen(name)) != 0)
        fail_msg("status %d, expected %d; '%s' should hold '%s'", found, status, message, words);
    assert_non_null(strchr(message, ';'));
    crease_context_free(context);
}

static inline void then_text_fails(
    const char *name, const char *text, crease_status status, const char *words)
{
    then_bytes_fail(name, text, strlen(text), status, words);
}

/* Cut short anywhere, the file gives an error or a cloud whose points are the first of the whole
 * one. loose_end: the last number may have lost digits unnoticed. */
static inline void then_every_truncation_is_survived(
    const char *name, const void *bytes, size_t size, bool loose_end)
{
    crease_context *context = given_reader();
    crease_cloud *whole = when_read(context, name, bytes, size), *part = NULL;
    for (size_t kept = 0; kept < size; kept++) {
        if (read_bytes(context, name, bytes, kept, false, &part) != CREASE_OK)
            continue;
        const size_t count = crease_cloud_count(part);
        const size_t sure = 3 * count - (loose_end && count ? 3 : 0);
        assert_true(count <= crease_cloud_count(whole));
        assert_memory_equal(crease_cloud_points(part), crease_cloud_points(whole), 8 * sure);
        crease_cloud_free(part);
    }
    crease_cloud_free(whole);
    crease_context_free(context);
}

/* Bytes changed at random: no crash, and a sentence for every error. */
static inline void then_damage_is_survived(
    const char *name, const void *bytes, size_t size, unsigned rounds)
{
    crease_context *context = given_reader_with_threads(1);
    unsigned char *damaged = malloc(size);
    assert_non_null(damaged);
    for (unsigned round = 0; round < rounds; round++) {
        memcpy(damaged, bytes, size);
        const uint32_t changes = 1 + crease_random_below(5, round, 0, 4);
        for (uint32_t i = 0; i < changes; i++)
            damaged[crease_random_below(5, round, 2 * i + 1, (uint32_t)size)] =
                (unsigned char)crease_random_below(5, round, 2 * i + 2, 256);
        crease_cloud *cloud = NULL;
        if (read_bytes(context, name, damaged, size, round % 2, &cloud) != CREASE_OK)
            assert_true(strlen(crease_context_message(context)) > 20);
        crease_cloud_free(cloud);
    }
    free(damaged);
    crease_context_free(context);
}

/* Every allocation fails once: NO_MEMORY each time, until none is left. */
static inline void then_every_failed_allocation_is_survived(
    const char *name, const void *bytes, size_t size)
{
    crease_context *context = given_reader();
    crease_cloud *cloud = NULL;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    long n = 0;
    for (; status != CREASE_OK && n < 1000; n++) {
        crease_context_fail_allocation(context, n);
        status = read_bytes(context, name, bytes, size, false, &cloud);
        if (status != CREASE_OK)
            assert_int_equal(status, CREASE_ERROR_NO_MEMORY);
    }
    assert_true(n > 3 && n < 1000);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

#endif
