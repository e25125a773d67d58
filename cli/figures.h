/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The figures of the paper, drawn again. */
#ifndef CREASE_CLI_FIGURES_H
#define CREASE_CLI_FIGURES_H

#include "crease/crease.h"
#include "report.h"

/** Draws Figures 1 to 4, and one that the paper lacks (5: the paper's surface beside the sheet), as
 * PNG and SVG into the folder. */
crease_status figures_write(crease_context *context, const char *folder, report *r);

#endif
