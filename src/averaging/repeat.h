/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Steps 8 and 9 of Algorithm 1: transposing the net, and repeating its rows. */
#ifndef CREASE_AVERAGING_REPEAT_H
#define CREASE_AVERAGING_REPEAT_H

#include "averaging/net.h"

/* Step 8: rows become columns, of the net and of its marks. */
crease_status crease_net_transpose(crease_context *context, crease_net *net, uint8_t *marks);

/* Step 9: passes[i] is true when the sum of the marks of row i is above the threshold g. Returns
 * the number of rows that pass. */
size_t crease_marked_rows(
    const uint8_t *marks, size_t rows, size_t columns, int threshold, bool *passes);

/* Step 9: the net with every row that passes standing in it `times` times. */
crease_status crease_net_repeat(crease_context *context, const crease_net *net, const bool *passes,
    size_t times, crease_net *out);

#endif
