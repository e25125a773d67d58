/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The options of the command line, each defined once: the parser, --help, the man page, the shell
 * completions and the report's list of options all come from this table. */
#ifndef CREASE_CLI_OPTION_H
#define CREASE_CLI_OPTION_H

#include "settings.h"

#include <stdio.h>

/* The commands, as bits: an option names those that take it. */
enum {
    FOR_DETECT = 1,
    FOR_FIT = 2,
    FOR_INFO = 4,
    FOR_EXAMPLE = 8,
    FOR_REPRODUCE = 16,
    FOR_COMPARE = 32,
    FOR_FILTER = 64,
    FOR_ALL = 127
};

typedef enum option_kind {
    OPTION_FLAG,    /* bool */
    OPTION_SIZE,    /* size_t: bytes */
    OPTION_INTEGER, /* int */
    OPTION_SEED,    /* uint64_t */
    OPTION_REAL,    /* double */
    OPTION_PATH,    /* const char * */
    OPTION_OUTPUT,  /* appended to settings.outputs */
    OPTION_CHOICE,  /* int: position in choices */
    OPTION_NET,     /* size_t[2], MxN */
    OPTION_ROTATION /* double[9] */
} option_kind;

typedef struct option {
    const char *name; /* without the dashes */
    char letter;      /* short form or 0 */
    option_kind kind;
    const char *argument;       /* what stands for the argument in --help, NULL for flags */
    int commands;               /* FOR_... bits */
    size_t offset;              /* in settings */
    double least, most;         /* range of numbers, both inclusive */
    const char *const *choices; /* NULL-terminated, for OPTION_CHOICE */
    const char *help;
    const char *default_text; /* where the default is not the number in settings_default() */
} option;

/** The table and its length. */
extern const option option_table[];
extern const size_t option_count;
/* The names of fit_method, in its order. */
extern const char *const fit_method_names[];

/** Reads the arguments after the command's name into s. On failure prints one sentence to stderr
 * and returns false. */
bool options_parse(int commands, const char *command, int count, char **arguments, settings *s);

/** The value of an option as text, as --help and the report show it. */
void option_value_text(const option *o, const settings *s, char *text, size_t size);

#endif
