/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The terminal: a progress bar on standard error, and signals turned into a request to stop. */
#ifndef CREASE_CLI_TERMINAL_H
#define CREASE_CLI_TERMINAL_H

#include <stdbool.h>

/** Catches SIGINT, SIGTERM and SIGHUP: the work ends at the next occasion, leaving nothing half
 * written. A second signal ends the program at once. */
void terminal_catch_signals(void);
/** The signal that arrived, 0 for none. */
int terminal_signal(void);
/** Ends the program by the signal that arrived, as if it had not been caught. */
void terminal_raise(int signal_number);

/** Callbacks for crease_context_options. */
int terminal_cancelled(void *user);
void terminal_warn(void *user, const char *sentence);
/** Draws the bar for work of over a second, only when standard error is a terminal. */
void terminal_progress(void *user, const char *stage, double fraction);
/** Removes the bar, so that other lines stand alone. */
void terminal_clear(void);
/** Columns of the terminal, 80 when not known. */
int terminal_columns(void);

#endif
