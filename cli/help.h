/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Everything that is said about the commands and options, made from their one definition: --help,
 * the man page and the shell completions. */
#ifndef CREASE_CLI_HELP_H
#define CREASE_CLI_HELP_H

#include "command.h"

#include <stdio.h>

void help_overview(FILE *to);
void help_command(FILE *to, const command *c);
/** The man page crease(1) in man(7) macros. */
void help_man(FILE *to);
/** The completion script for bash, zsh or fish; false for another shell. */
bool help_completion(FILE *to, const char *shell);

#endif
