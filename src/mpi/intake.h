/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A file that every rank but 0 reads its own share of. Internal view; every function is collective
 * but where it says otherwise. */
#ifndef CREASE_MPI_INTAKE_H
#define CREASE_MPI_INTAKE_H

#include "mpi/parcel.h"
#include "read/rows.h"

typedef struct crease_mpi_intake {
    crease_rows *rows;
    size_t at_once;             /* rows that are read together */
    size_t begin, end;          /* own rows */
    crease_mpi_parcels parcels; /* their points */
    uint64_t *first; /* by rank: number of its first point among all; then how many there are */
    double low[3], high[3]; /* of all points */
    bool wide_normals;      /* of any point, see write/cloud.h */
    crease_type coordinate_type;
} crease_mpi_intake;

/* Opens a file that rank 0 has found to have so many rows; every machine has to see the same. Not
 * collective. Errors: those of crease_rows_open(), with the number of the rank; FORMAT. */
crease_status crease_mpi_rows_open(const crease_mpi *mpi, const char *path,
    const crease_read_options *options, size_t rows, crease_rows **out);
/* Reads the own rows. rows: opened, and left to the caller. */
crease_status crease_mpi_intake_read(
    const crease_mpi *mpi, crease_rows *rows, size_t at_once, crease_mpi_intake *out);
void crease_mpi_intake_free(crease_mpi_intake *intake);
/* How many points there are in all. Not collective. */
size_t crease_mpi_intake_total(const crease_mpi *mpi, const crease_mpi_intake *intake);
/* Brings `most` points to rank 0, those of crease_sample_take(). sample: elsewhere NULL. */
crease_status crease_mpi_intake_sample(
    const crease_mpi *mpi, const crease_mpi_intake *intake, size_t most, crease_cloud **sample);

#endif
