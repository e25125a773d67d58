/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What is known of the items of a layer. Internal view. */
#ifndef CREASE_VIEW_FACTS_H
#define CREASE_VIEW_FACTS_H

#include "base/context.h"

/* One fact of an item; its texts are clean copies. */
typedef struct crease_known {
    size_t item;
    crease_fact fact;
} crease_known;

typedef struct crease_facts {
    crease_known *all; /* in the order in which they were added */
    size_t count;
} crease_facts;

void crease_facts_free(crease_facts *facts);
/* Adds what is known of an item; all of it, or nothing when memory ran out. */
crease_status crease_facts_add(crease_context *context, crease_facts *facts, size_t item,
    const crease_fact *added, size_t count);

#endif
