/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Arrays of numbers, made small for the page. In blocks of 4096 tuples the lowest bytes of the
 * first number of every tuple stand together, then its next bytes, then those of the second number:
 * bytes that are alike are neighbours. Of most numbers it is the difference from the tuple before,
 * modulo their size, its sign in the lowest bit. All of it is deflated (RFC 1950) and written as
 * base64. */
#ifndef CREASE_VIEW_PACK_H
#define CREASE_VIEW_PACK_H

#include "write/output.h"

/* What is packed: so many numbers in a tuple, so many bytes each (1 to 4). */
typedef struct crease_pack_form {
    const char *name;
    size_t components, bytes;
    bool differences;
} crease_pack_form;

/* Places within the box from -1 to 1 in steps of 2^-23, as fine as single precision. */
extern const crease_pack_form crease_pack_lattice;
/* Unit vectors in steps of 1/32767. */
extern const crease_pack_form crease_pack_direction;
extern const crease_pack_form crease_pack_links, crease_pack_triangles; /* numbers of nodes */
/* The numbers of a field; 64 bits are brought to 32. */
crease_pack_form crease_pack_of_type(crease_type type);

typedef struct crease_pack crease_pack;

/* Begins to pack into an output. Errors: NO_MEMORY. */
crease_status crease_pack_open(
    crease_context *context, crease_output *output, crease_pack_form form, crease_pack **out);
/* The next number, in as many of its lowest bytes as the form has. */
void crease_pack_put(crease_pack *pack, uint32_t value);
void crease_pack_put_float(crease_pack *pack, float value);
/* The next coordinate of a lattice, -1..1, or of a direction. */
void crease_pack_put_coordinate(crease_pack *pack, double value);
/* Writes what is left and frees the pack; NULL is fine. */
void crease_pack_close(crease_pack *pack);

#endif
