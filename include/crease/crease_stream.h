/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/** @file crease_stream.h
 * Clouds larger than memory, from file to file. Part of libcrease; the manners are those of
 * crease.h.
 *
 * Files that can be read in parts are PLY files that begin with their points, without lists where
 * they are binary, LAS files, and rows of text (XYZ, TXT, CSV, ASC, PTS).
 */
#ifndef CREASE_CREASE_STREAM_H
#define CREASE_CREASE_STREAM_H

#include "crease/crease.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct crease_stream_options {
    crease_detect_options detect;   /**< as for crease_scores_compute() */
    crease_regions_options regions; /**< as for crease_regions_find() */
    crease_read_options read;       /**< as for crease_cloud_read() */
    bool by_score;       /**< features are those of the scores, not the points beside creases;
                              default false */
    size_t memory;       /**< bytes that this may take; default 1 GiB, at least 8 MB */
    const char *scratch; /**< folder for files of 56 bytes a point, which have no name and are gone
                              with the process; default NULL: the folder of the output */
} crease_stream_options;

/** What came of it. */
typedef struct crease_stream_summary {
    size_t count;                 /**< points */
    size_t sampled;               /**< of which regions and creases were found */
    size_t parts;                 /**< that the cloud was worked on in */
    size_t features, outliers;    /**< points that are features; that are in no region */
    double spacing;               /**< of all points, from that of the sample */
    double lowest[3], highest[3]; /**< coordinates */
} crease_stream_summary;

CREASE_API crease_stream_options crease_stream_options_default(void);
/** Tells how many points a file has and about how many bytes of memory detecting takes when all of
 * them are held: 500 for each point and the file itself. O(1). Errors: those of
 * crease_cloud_read(); UNSUPPORTED (the file cannot be read in parts). */
CREASE_API crease_status crease_stream_need(crease_context *context, const char *input,
    const crease_read_options *options, size_t *count, size_t *bytes);
/** Finds the creases of a file that memory need not hold, and writes its points to a PLY file with
 * the fields `variance` (single numbers), `feature` and `region`.
 *
 * What the neighbours of every point tell is found at full resolution: `variance`, and with
 * by_score `feature`, are the same bytes as from a cloud in memory, for any limit. The cloud is cut
 * along a Morton curve into parts that fit; each is completed by the points of others that its own
 * have among their nearest, and worked on by itself. Regions and creases are found from a sample
 * that fits in memory, evenly drawn by the seed; they are what crease_regions_find() and
 * crease_network_find() find of it, and depend on the limit. Then every point gets the region that
 * is cheapest among those of the 10 nearest points of the sample by its distance and by how many of
 * them have it, and is a feature within one spacing, of all points, of a crease.
 *
 * *regions, *network: those of the sample (free them); the sizes and rms of the regions are those
 * of all points, their normals are not kept. O(n log n) time; the input is read five times. Errors:
 * those of reading, computing and writing; UNSUPPORTED (see above), ARGUMENT (the limit is too
 * low), NO_MEMORY (the neighbours of a few points are more than the limit holds). */
CREASE_API crease_status crease_detect_stream(crease_context *context, const char *input,
    const crease_stream_options *options, const char *output, crease_stream_summary *summary,
    crease_regions **regions, crease_network **network);
/** Reads a sample of at most `most` points, without normals and fields, evenly drawn by the seed,
 * with about 24 bytes for each and a few megabytes. *total: points of the file. O(n). Errors: those
 * of crease_cloud_read(); UNSUPPORTED. */
CREASE_API crease_status crease_cloud_read_sample(crease_context *context, const char *input,
    const crease_read_options *options, size_t most, crease_cloud **out, size_t *total);

typedef struct crease_fit_stream_options {
    crease_sheet_options sheet; /**< as for crease_sheet_fit() */
    crease_read_options read;   /**< as for crease_cloud_read() */
    size_t memory;              /**< bytes that this may take; default 1 GiB, at least 8 MB */
} crease_fit_stream_options;

/** How far the points of a file are from the sheet. */
typedef struct crease_fit_stream_summary {
    size_t count;                 /**< points */
    size_t sampled;               /**< of which the creases were found */
    double mean, rms, p95, most;  /**< distances of all points; p95 within 1 % */
    double lowest[3], highest[3]; /**< coordinates */
} crease_fit_stream_summary;

CREASE_API crease_fit_stream_options crease_fit_stream_options_default(void);
/** Fits a sheet to the points of a file that memory need not hold, see crease_sum.h: the file is
 * read four to five times, some points at a time. *sample: an evenly drawn sample of the points
 * (free it); the points of *out are its. O(n). Errors: those of crease_cloud_read() and
 * crease_sheet_sum_create(); UNSUPPORTED (the file cannot be read in parts), ARGUMENT (the limit is
 * too low for the net). */
CREASE_API crease_status crease_sheet_fit_stream(crease_context *context, const char *input,
    const crease_fit_stream_options *options, crease_fit_stream_summary *summary,
    crease_cloud **sample, crease_sheet **out);

#ifdef __cplusplus
}
#endif

#endif
