/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A command of the program and what it runs with. */
#ifndef CREASE_CLI_COMMAND_H
#define CREASE_CLI_COMMAND_H

#include "option.h"
#include "report.h"
#include "settings.h"

typedef struct command {
    const char *name;
    int bit; /* FOR_... */
    const char *usage;
    const char *summary; /* one line */
    const char *text;    /* paragraphs for --help and the man page */
    crease_status (*run)(crease_context *context, const settings *s, report *r);
} command;

extern const command commands[];
extern const size_t command_count;

crease_status filter_run(crease_context *context, const settings *s, report *r);
crease_status detect_run(crease_context *context, const settings *s, report *r);
crease_status fit_run(crease_context *context, const settings *s, report *r);
crease_status example_run(crease_context *context, const settings *s, report *r);
crease_status reproduce_run(crease_context *context, const settings *s, report *r);
crease_status compare_run(crease_context *context, const settings *s, report *r);
crease_status info_run(crease_context *context, const settings *s, report *r);

#endif
