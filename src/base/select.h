/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Order statistics. */
#ifndef CREASE_BASE_SELECT_H
#define CREASE_BASE_SELECT_H

#include <stddef.h>

/* The value that would be number `rank` (from 0, below count) if the values were sorted. Reorders
 * them. O(count).
 * Based on: Hoare. Algorithm 65: find. 1961. */
double crease_select(double *values, size_t count, size_t rank);

#endif
