/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* --memory: what fits, and that nothing more is taken. */
#ifndef CREASE_CLI_LIMIT_H
#define CREASE_CLI_LIMIT_H

#include "settings.h"

/* Bytes that a cloud takes for each point, the file aside, in detect and in fit. */
enum { LIMIT_DETECT = 500, LIMIT_FIT = 1000 };

/** Has freed memory returned to the system, so that it is not counted any more. */
void limit_prepare(const settings *s);
/** What the limit leaves for the work: bytes beside the program itself. Without a limit 0. */
size_t limit_left(const settings *s);
/** Whether the points of the input take more than the limit, `each` bytes one, and could be worked
 * on in parts. Fails when they take more, and cannot: see limit_check(). An input that is damaged
 * is not larger. */
crease_status limit_exceeded(
    crease_context *context, const settings *s, size_t each, bool *exceeded);
/** Fails when so many points that were read take more than the limit. */
crease_status limit_check(crease_context *context, const settings *s, size_t points, size_t each);

#endif
