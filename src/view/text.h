/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Text that comes from outside (titles, names of layers and fields), made safe to draw and to
 * embed: valid UTF-8 without control characters. */
#ifndef CREASE_VIEW_TEXT_H
#define CREASE_VIEW_TEXT_H

#include "base/context.h"

/* A copy in which every byte that is not UTF-8 is U+FFFD and every control character a space. NULL
 * is read as "". The caller frees it; NULL when memory ran out. */
char *crease_text_clean(crease_context *context, const char *text);
/* The length in bytes of the UTF-8 sequence at text, 0 when it is none. */
size_t crease_text_sequence(const char *text);

#endif
