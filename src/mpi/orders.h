/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What rank 0 tells the others before they work on a file. Internal view. */
#ifndef CREASE_MPI_ORDERS_H
#define CREASE_MPI_ORDERS_H

#include "mpi/intake.h"
#include "stream/overview.h"

typedef struct crease_mpi_orders {
    crease_detect_options detect;
    crease_read_options read;
    int32_t by_score;
    uint64_t rows, at_once;
    uint64_t sample; /* points that are drawn */
    char input[4096], output[4096];
} crease_mpi_orders;

/* Bytes that a rank takes for each of its points, with those around them. */
enum { CREASE_MPI_STREAM_POINT = 250 };

#endif
