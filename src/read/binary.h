/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Columns out of binary bytes, where the value of each column stands at offset + row * stride. */
#ifndef CREASE_READ_BINARY_H
#define CREASE_READ_BINARY_H

#include "read/columns.h"

/* Which bytes come first in a value. */
typedef enum crease_order { CREASE_ORDER_LITTLE, CREASE_ORDER_BIG } crease_order;

/* One cell as a double. */
double crease_cell_load(const unsigned char *from, int cell, crease_order order);
/* Copies the cell of a row into the column. */
void crease_column_copy(
    const crease_column *column, size_t row, const unsigned char *from, crease_order order);
/* Lays the columns out one after the other, as in a packed record; returns the record's size. */
size_t crease_columns_pack(crease_columns *columns);
/* Fills all rows of all columns; the caller has checked that the bytes are there. */
crease_status crease_columns_fill(crease_context *context, crease_columns *columns,
    const unsigned char *bytes, crease_order order);

#endif
