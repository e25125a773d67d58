/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Which regions are next to which. */
#ifndef CREASE_SEGMENT_CONTACT_H
#define CREASE_SEGMENT_CONTACT_H

#include "segment/segmentation.h"

typedef struct crease_contacts {
    size_t *first; /* of each region and beyond the last: where its neighbours begin */
    int32_t *to;   /* numbers of the neighbours, ascending for each region */
} crease_contacts;

/* Regions with fewer links between them than `least` are not next to each other. */
crease_status crease_contacts_find(crease_segmentation *seg, size_t least, crease_contacts *out);
void crease_contacts_clear(crease_contacts *contacts);
bool crease_contacts_has(const crease_contacts *contacts, int32_t from, int32_t to);

#endif
