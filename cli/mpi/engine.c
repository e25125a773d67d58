/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Rank 0 runs the program, the others serve. They know nothing of its arguments: what they are to
 * do they are told. */
#include "engine.h"

#include "crease/crease_mpi.h"
#include "limit.h"
#include "terminal.h"

#include <signal.h>
#include <stdio.h>

enum { NOTHING_TO_DO = -1, EXIT_FAILED = 1 };

static crease_mpi *team; /* of the one context that a run of the program has */
static bool begun;

/* Rank 0's word on what each rank may take. */
typedef struct allowance {
    int64_t threads, memory;
} allowance;

static allowance tell(allowance given)
{
    MPI_Bcast(&given, 2, MPI_INT64_T, 0, MPI_COMM_WORLD);
    return given;
}

static int help(void)
{
    crease_context_options options = crease_context_options_default();
    crease_context *context = NULL;
    crease_mpi *helpers = NULL;
    const allowance given = tell((allowance){0});
    if (given.threads == NOTHING_TO_DO)
        return 0;
    settings s = settings_default();
    s.memory = (size_t)given.memory;
    limit_prepare(&s);
    options.threads = (int)given.threads;
    options.memory = s.memory;
    options.cancelled = terminal_cancelled;
    terminal_catch_signals();
    crease_status status = crease_context_create(&options, &context);
    if (status != CREASE_OK) {
        fprintf(stderr, "crease: %s\n", crease_status_sentence(status));
        MPI_Abort(MPI_COMM_WORLD, EXIT_FAILED);
    }
    status = crease_mpi_create(context, MPI_COMM_WORLD, &helpers);
    if (status == CREASE_OK)
        status = crease_mpi_serve(helpers);
    if (status == CREASE_ERROR_CANCELLED)
        terminal_raise(terminal_signal());
    crease_mpi_free(helpers);
    crease_context_free(context);
    return 0;
}

int engine_main(int count, char **arguments, int (*program)(int count, char **arguments))
{
    int rank = 0, level = 0;
    MPI_Init_thread(&count, &arguments, MPI_THREAD_FUNNELED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const int code = rank == 0 ? program(count, arguments) : help();
    if (rank == 0 && !begun)
        tell((allowance){.threads = NOTHING_TO_DO});
    MPI_Finalize();
    return code;
}

crease_status engine_begin(crease_context *context, const settings *s)
{
    begun = true;
    tell((allowance){.threads = s->threads, .memory = (int64_t)s->memory});
    return crease_mpi_create(context, MPI_COMM_WORLD, &team);
}

/* After CANCELLED the program ends by the signal that it got, and mpirun ends the others. It also
 * sends SIGTERM to those that are left when one has died. */
void engine_end(crease_status status)
{
    if (status != CREASE_ERROR_CANCELLED)
        crease_mpi_free(team);
    else if (terminal_signal() == SIGTERM)
        fputs("crease: another rank has died, or the job was stopped from outside; no file is half "
              "written: look for what mpirun says of the rank, and run it again\n",
            stderr);
    team = NULL;
}

crease_status engine_scores(crease_context *context, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out)
{
    (void)context;
    return crease_mpi_scores_compute(team, cloud, options, out);
}

crease_status engine_regions(crease_context *context, const crease_cloud *cloud,
    const crease_regions_options *options, crease_regions **out)
{
    (void)context;
    return crease_mpi_regions_find(team, cloud, options, out);
}

crease_status engine_detect_stream(crease_context *context, const char *input,
    const crease_stream_options *options, const char *output, crease_stream_summary *summary,
    crease_regions **regions, crease_network **network)
{
    (void)context;
    return crease_mpi_detect_stream(team, input, options, output, summary, regions, network);
}

crease_status engine_fit_stream(crease_context *context, const char *input,
    const crease_fit_stream_options *options, crease_fit_stream_summary *summary,
    crease_cloud **sample, crease_sheet **out)
{
    (void)context;
    return crease_mpi_sheet_fit_stream(team, input, options, summary, sample, out);
}
