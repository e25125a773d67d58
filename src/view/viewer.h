/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The page without its data (viewer/dist/viewer.html), made part of the library by the build. */
#ifndef CREASE_VIEW_VIEWER_H
#define CREASE_VIEW_VIEWER_H

#include <stddef.h>

extern const unsigned char crease_viewer_page[];
extern const size_t crease_viewer_page_size;

#endif
