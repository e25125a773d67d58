/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The noise study: what the paper shows in pictures, in numbers. */
#ifndef CREASE_CLI_STUDY_H
#define CREASE_CLI_STUDY_H

#include "crease/crease.h"
#include "report.h"

/** Fits the 51-point samples at every noise level by both methods, `seeds` times each, and writes
 * study.md and study.json into the folder. */
crease_status study_write(crease_context *context, int seeds, const char *folder, report *r);

#endif
