/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Programs of others to measure against; each is used only where it is installed. */
#ifndef CREASE_BENCH_PEER_H
#define CREASE_BENCH_PEER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The k nearest points of each of count points by nanoflann, on one thread; indices: count x k. */
void peer_nanoflann(const double *points, size_t count, size_t k, uint32_t *indices);

#ifdef __cplusplus
}
#endif

#endif
