/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/** @file crease_mpi.h
 * The heavy stages shared out over the processes of an MPI communicator, on one machine or many. A
 * library of its own, crease-mpi; the manners are those of crease.h.
 *
 * Rank 0 leads: it holds the cloud, asks for a stage, and gets the result, which is the same bytes
 * as that of the function of crease.h with the same name, for any number of ranks and threads. All
 * other ranks serve. Each function says whether it is collective.
 *
 *     crease_mpi_create(context, MPI_COMM_WORLD, &mpi);         every rank
 *     if (crease_mpi_rank(mpi) > 0)
 *         crease_mpi_serve(mpi);                                every rank but 0
 *     else
 *         crease_mpi_regions_find(mpi, cloud, NULL, &regions);  rank 0
 *     crease_mpi_free(mpi);                                     every rank
 *
 * The cloud is cut into pieces along a Morton curve, and every piece is completed by those points
 * of other pieces that its own have among their nearest. All machines must run the same build.
 *
 * When any rank fails, all learn of it, and rank 0 returns the status and the sentence. When a rank
 * dies, MPI ends the others.
 */
#ifndef CREASE_CREASE_MPI_H
#define CREASE_CREASE_MPI_H

#include "crease/crease_stream.h"

#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Some processes that work on one cloud. */
typedef struct crease_mpi crease_mpi;

/** Collective. Makes the team; the context must outlive it. The communicator is duplicated. Errors:
 * NO_MEMORY, UNSUPPORTED (the ranks run different builds). */
CREASE_API crease_status crease_mpi_create(
    crease_context *context, MPI_Comm communicator, crease_mpi **out);
/** Collective, after serve has returned. Lets the other ranks return from it: they do when rank 0
 * calls this. */
CREASE_API void crease_mpi_free(crease_mpi *mpi);
/** Not collective. Number of this process, from 0. */
CREASE_API int crease_mpi_rank(const crease_mpi *mpi);
/** Not collective. How many processes there are. */
CREASE_API int crease_mpi_size(const crease_mpi *mpi);

/** Every rank but 0: does its share of what rank 0 asks for, until rank 0 frees the team. Returns
 * CANCELLED when the context was cancelled, else OK: what failed is told to rank 0. */
CREASE_API crease_status crease_mpi_serve(crease_mpi *mpi);

/** Rank 0, while the others serve: crease_scores_compute(). The cloud has less than 2^31 points.
 * Every rank needs 300 bytes for each of its points and of those around them. Errors: as there, of
 * any rank. */
CREASE_API crease_status crease_mpi_scores_compute(crease_mpi *mpi, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out);

/** Rank 0, while the others serve: crease_regions_find(). Neighbours, noise and normals, most of
 * the work, are shared out; the regions grow over the whole cloud on rank 0, which needs as much
 * memory as it would alone. The other ranks need 450 bytes for each of their points and of those
 * around them. Less than 2^31 points. Errors: as there, of any rank. */
CREASE_API crease_status crease_mpi_regions_find(crease_mpi *mpi, const crease_cloud *cloud,
    const crease_regions_options *options, crease_regions **out);

/** Rank 0, while the others serve: crease_detect_stream(), with the same files for any number of
 * ranks, one included. The limit of memory holds for each rank. When the points fit the other ranks
 * together, 250 bytes for each and 4 MB for the rank, each of these reads its own share of the rows
 * (all must see the file under the same name), they sort them along the Morton curve among
 * themselves, complete and score them while rank 0 finds regions and creases of the sample, label
 * them, and send what is to be written to rank 0: it holds the sample alone, and no rank touches a
 * disk in between. When they do not fit, rank 0 works on the file alone, in parts.
 * summary->parts: the shares, or the parts. Errors: as there, of any rank. */
CREASE_API crease_status crease_mpi_detect_stream(crease_mpi *mpi, const char *input,
    const crease_stream_options *options, const char *output, crease_stream_summary *summary,
    crease_regions **regions, crease_network **network);

/** Rank 0, while the others serve: crease_sheet_fit_stream(), with the same bytes for any number of
 * ranks, one included. The other ranks read the file, batch about (all must see it under the same
 * name), find the feet and weights of its points and their distances; rank 0 reads it once for the
 * sample, and adds what it is sent, 40 bytes for each point in each round, to the normal equations
 * in the order of the file. Every rank needs the memory of a batch, rank 0 that of the net, too.
 * Errors: as there, of any rank. */
CREASE_API crease_status crease_mpi_sheet_fit_stream(crease_mpi *mpi, const char *input,
    const crease_fit_stream_options *options, crease_fit_stream_summary *summary,
    crease_cloud **sample, crease_sheet **out);

#ifdef __cplusplus
}
#endif

#endif
