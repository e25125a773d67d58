/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Vector instructions by the compiler: a function marked CREASE_VECTORISED is compiled for several
 * instruction sets and the best one is taken when the program starts. Products and sums are never
 * contracted (see cmake/flags.cmake) and their order is that of the source, so all of them give the
 * same bytes. */
#ifndef CREASE_BASE_SIMD_H
#define CREASE_BASE_SIMD_H

#include <limits.h> /* says whether this is glibc, whose loader chooses the version */

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) &&       \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CREASE_VECTORISED __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define CREASE_VECTORISED
#endif

/* For the helpers of such functions: they must become part of each version. */
#define CREASE_INLINE static inline __attribute__((always_inline))

/* Four numbers that are added and multiplied at once, where the compiler does not see by itself
 * that it may. They may lie anywhere numbers may. */
typedef double crease_four __attribute__((vector_size(32), aligned(8), may_alias));

#endif
