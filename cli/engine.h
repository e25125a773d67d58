/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Who does the heavy stages: this process alone, in the program crease (engine.c), or many, in the
 * program crease-mpi (mpi/engine.c). */
#ifndef CREASE_CLI_ENGINE_H
#define CREASE_CLI_ENGINE_H

#include "crease/crease_stream.h"
#include "settings.h"

/* Runs the program in this process, or helps another one that does; returns the exit code. */
int engine_main(int count, char **arguments, int (*program)(int count, char **arguments));
/* Before the first stage. */
crease_status engine_begin(crease_context *context, const settings *s);
/* After the last one. */
void engine_end(crease_status status);

/* crease_scores_compute() and crease_regions_find(). */
crease_status engine_scores(crease_context *context, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out);
crease_status engine_regions(crease_context *context, const crease_cloud *cloud,
    const crease_regions_options *options, crease_regions **out);
/* crease_detect_stream(). */
crease_status engine_detect_stream(crease_context *context, const char *input,
    const crease_stream_options *options, const char *output, crease_stream_summary *summary,
    crease_regions **regions, crease_network **network);
/* crease_sheet_fit_stream(). */
crease_status engine_fit_stream(crease_context *context, const char *input,
    const crease_fit_stream_options *options, crease_fit_stream_summary *summary,
    crease_cloud **sample, crease_sheet **out);

#endif
