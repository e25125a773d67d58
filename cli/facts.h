/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What the report says of faces, edges and regions, for the page. */
#ifndef CREASE_CLI_FACTS_H
#define CREASE_CLI_FACTS_H

#include "report.h"

/** Gives the layer added last what an object of the report says of its item: numbers, words, yes or
 * no, and arrays of at most 8 numbers; members that are objects are left out. */
crease_status facts_show_one(
    crease_context *context, crease_scene *scene, size_t item, const cJSON *object);
/** The same for every object of a list, the first being that of item 0. NULL: nothing. */
crease_status facts_show(crease_context *context, crease_scene *scene, const cJSON *list);

#endif
