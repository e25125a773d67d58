/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The report: what was done, with what, how long it took; as JSON and as lines for people. */
#ifndef CREASE_CLI_REPORT_H
#define CREASE_CLI_REPORT_H

#include "settings.h"

#include <cjson/cJSON.h>

typedef struct report {
    cJSON *root;    /* the whole report */
    cJSON *timings; /* seconds by stage */
    double begun;   /* monotonic seconds at the start */
    double stage_begun;
    bool speak; /* lines for people are printed */
} report;

/** Begins a report: program, version, command, input, options in force, seed, threads. */
bool report_begin(report *r, const char *command, int command_bit, const settings *s);
/** Names the stage that now ends and notes its time since the last one. */
void report_stage(report *r, const char *stage);
/** Adds the failure of the command. */
void report_failure(report *r, crease_status status, const char *sentence);
void report_free(report *r);
/** The report as it stands, with the time and the memory so far, as text to be freed with free();
 * NULL when memory ran out. */
char *report_text(report *r);
/** Prints a line for people, unless they asked for quiet or JSON. */
void report_line(const report *r, const char *format, ...) __attribute__((format(printf, 2, 3)));
/** Adds three numbers as an array. */
void report_vector(cJSON *object, const char *name, const double values[3]);

#endif
