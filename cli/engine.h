/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Who does the heavy stages: this process alone, in the program crease (engine.c), or many, in the
 * program crease-mpi (mpi/engine.c). */
#ifndef CREASE_CLI_ENGINE_H
#define CREASE_CLI_ENGINE_H

#include "crease/crease.h"

/* Runs the program in this process, or helps another one that does; returns the exit code. */
int engine_main(int count, char **arguments, int (*program)(int count, char **arguments));
/* Before the first stage. threads: as asked for, 0: one for each processor. */
crease_status engine_begin(crease_context *context, int threads);
/* After the last one. */
void engine_end(crease_status status);

/* crease_scores_compute() and crease_regions_find(). */
crease_status engine_scores(crease_context *context, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out);
crease_status engine_regions(crease_context *context, const crease_cloud *cloud,
    const crease_regions_options *options, crease_regions **out);

#endif
