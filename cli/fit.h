/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The two ways to fit. */
#ifndef CREASE_CLI_FIT_H
#define CREASE_CLI_FIT_H

#include "deviation.h"
#include "report.h"
#include "settings.h"
#include "target.h"

#include "crease/crease_trim.h"

enum {
    FIT_ALLOWED = TARGET_CAD | TARGET_MESH | TARGET_FIGURE | TARGET_PAGE | TARGET_REPORT,
    FIT_CREASES = TARGET_LINES | TARGET_CAD
};

/** What has been made already of a sheet; it is taken over. */
typedef struct fit_ready {
    crease_sheet *sheet; /**< or NULL */
    crease_trim *trim;   /**< sound, or NULL */
    bool whole;          /**< nothing of it is to be cut off */
} fit_ready;

void fit_ready_free(fit_ready *ready);
/** Fits one sheet, by either of its methods, and writes what is asked for. of_all: deviations of
 * more points than the cloud has, or NULL. */
crease_status fit_sheet(crease_context *context, const settings *s, report *r,
    const crease_cloud *cloud, fit_ready *ready, const deviation_summary *of_all);
/** Builds a part from its smooth regions and writes what is asked for. rival: NULL, or a sheet that
 * is taken instead where no shell comes out, or one that most points are further from: then nothing
 * is written, and *instead is true. */
crease_status fit_part(crease_context *context, const settings *s, report *r,
    const crease_cloud *cloud, const crease_sheet *rival, bool *instead);

#endif
