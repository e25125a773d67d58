/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "help.h"

#include <string.h>

enum { WIDTH = 80, COLUMN = 30 };

static const char *const exit_codes[][2] = {
    {"0", "everything was done"},
    {"1", "the work failed (memory, disk, numerics), or the output cannot be written"},
    {"2", "the command line is wrong"},
    {"3", "the input is missing, broken, or not a cloud of points on a surface"},
};

/* Prints text word by word, from column `at` on, indented by `indent`, within 80 columns. */
static void flow(FILE *to, const char *text, int at, int indent)
{
    while (*text) {
        if (*text == '\n') {
            fprintf(to, "\n%*s", indent, "");
            at = indent;
            text++;
            continue;
        }
        const int length = (int)strcspn(text, " \n");
        if (at > indent && at + 1 + length > WIDTH - 1) {
            fprintf(to, "\n%*s", indent, "");
            at = indent;
        } else if (at > indent) {
            fputc(' ', to);
            at++;
        }
        fwrite(text, 1, (size_t)length, to);
        at += length;
        text += length;
        text += *text == ' ';
    }
    fputc('\n', to);
}

static void default_text(const option *o, char *text, size_t size)
{
    const settings defaults = settings_default();
    if (o->default_text)
        snprintf(text, size, "%s", o->default_text);
    else
        option_value_text(o, &defaults, text, size);
}

/* The help of an option with its choices and default. */
static void full_help(const option *o, char *text, size_t size)
{
    char value[96];
    default_text(o, value, sizeof value);
    if (o->kind == OPTION_FLAG)
        snprintf(text, size, "%s", o->help);
    else
        snprintf(text, size, "%s [%s]", o->help, value);
}

static void option_heading(const option *o, char *text, size_t size)
{
    char letter[8] = "    ";
    if (o->letter)
        snprintf(letter, sizeof letter, "-%c, ", o->letter);
    snprintf(text, size, "  %s--%s%s%s", letter, o->name, o->argument ? " " : "",
        o->argument ? o->argument : "");
}

void help_overview(FILE *to)
{
    fprintf(to,
        "crease %s: point clouds in, B-spline surfaces and CAD models out, sharp edges kept\n\n"
        "usage: crease COMMAND [OPTIONS] ...\n\n",
        crease_version());
    for (size_t i = 0; i < command_count; i++)
        fprintf(to, "  %-11s %s\n", commands[i].name, commands[i].summary);
    fprintf(to,
        "\n"
        "  crease COMMAND --help   says more about a command\n"
        "  crease --version        prints the version\n"
        "  crease --man            prints the manual page\n"
        "  crease --completion SHELL   prints completions for bash, zsh or fish\n\n"
        "First steps:\n"
        "  crease example panel -o panel.ply\n"
        "  crease fit panel.ply -o panel.step -o panel.html\n");
}

void help_command(FILE *to, const command *c)
{
    fprintf(to, "usage: crease %s\n\n", c->usage);
    flow(to, c->text, 0, 0);
    fprintf(to, "\nOptions, with their defaults in brackets:\n");
    for (size_t i = 0; i < option_count; i++) {
        if (!(option_table[i].commands & c->bit))
            continue;
        char heading[64], text[512];
        option_heading(&option_table[i], heading, sizeof heading);
        full_help(&option_table[i], text, sizeof text);
        if (strlen(heading) < COLUMN)
            fprintf(to, "%-*s", COLUMN, heading);
        else
            fprintf(to, "%s\n%*s", heading, COLUMN, "");
        flow(to, text, COLUMN, COLUMN);
    }
    fprintf(to, "\nExit status:\n");
    for (size_t i = 0; i < sizeof exit_codes / sizeof exit_codes[0]; i++)
        fprintf(to, "  %s  %s\n", exit_codes[i][0], exit_codes[i][1]);
}

/* Text with the characters that man(7) would take for its own escaped. */
static void man_text(FILE *to, const char *text)
{
    for (; *text; text++) {
        if (*text == '-')
            fputs("\\-", to);
        else if (*text == '\\')
            fputs("\\e", to);
        else if (*text == '\n' && text[1] == '\n')
            fputs("\n.PP", to);
        else
            fputc(*text, to);
    }
    fputc('\n', to);
}

static void man_option(FILE *to, const option *o)
{
    char text[512];
    full_help(o, text, sizeof text);
    fprintf(to, ".TP\n");
    if (o->letter)
        fprintf(to, "\\fB\\-%c\\fR, ", o->letter);
    fprintf(to, "\\fB\\-\\-");
    for (const char *c = o->name; *c; c++)
        fprintf(to, *c == '-' ? "\\-" : "%c", *c);
    fprintf(to, "\\fR");
    if (o->argument)
        fprintf(to, " \\fI%s\\fR", o->argument);
    fputc('\n', to);
    man_text(to, text);
}

void help_man(FILE *to)
{
    fprintf(to,
        ".TH CREASE 1 \"" CREASE_DATE "\" \"crease %s\" \"User Commands\"\n.SH NAME\n"
        "crease \\- point clouds to B\\-spline surfaces and CAD models with sharp edges kept\n"
        ".SH SYNOPSIS\n",
        crease_version());
    for (size_t i = 0; i < command_count; i++) {
        fprintf(to, "%s.B crease\n", i ? ".br\n" : "");
        man_text(to, commands[i].usage);
    }
    for (size_t i = 0; i < command_count; i++) {
        fprintf(to, ".SH CREASE %s\n", commands[i].name);
        man_text(to, commands[i].text);
        for (size_t j = 0; j < option_count; j++)
            if (option_table[j].commands & commands[i].bit)
                man_option(to, &option_table[j]);
    }
    fprintf(to, ".SH EXIT STATUS\n");
    for (size_t i = 0; i < sizeof exit_codes / sizeof exit_codes[0]; i++)
        fprintf(to, ".TP\n.B %s\n%s\n", exit_codes[i][0], exit_codes[i][1]);
}

static void bash_completion(FILE *to)
{
    fprintf(to,
        "_crease() {\n    local word=${COMP_WORDS[COMP_CWORD]}\n"
        "    local before=${COMP_WORDS[COMP_CWORD-1]} words=\n"
        "    case \"$before\" in\n");
    for (size_t i = 0; i < option_count; i++) {
        if (option_table[i].kind != OPTION_CHOICE)
            continue;
        fprintf(to, "    --%s) words=\"", option_table[i].name);
        for (int c = 0; option_table[i].choices[c]; c++)
            fprintf(to, "%s ", option_table[i].choices[c]);
        fprintf(to, "\" ;;\n");
    }
    fprintf(to, "    *) case \"${COMP_WORDS[1]}\" in\n");
    for (size_t i = 0; i < command_count; i++) {
        fprintf(to, "        %s) words=\"", commands[i].name);
        for (size_t j = 0; j < option_count; j++)
            if (option_table[j].commands & commands[i].bit)
                fprintf(to, "--%s ", option_table[j].name);
        fprintf(to, "\" ;;\n");
    }
    fprintf(to, "        esac ;;\n    esac\n    if [ \"$COMP_CWORD\" = 1 ]; then words=\"");
    for (size_t i = 0; i < command_count; i++)
        fprintf(to, "%s ", commands[i].name);
    fprintf(to,
        "\"; fi\n    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
        "}\ncomplete -o default -F _crease crease\n");
}

/* Text inside single quotes of a shell. */
static void quoted(FILE *to, const char *text)
{
    fputc('\'', to);
    for (; *text; text++)
        fputs(*text == '\'' ? "'\\''" : (char[]){*text, '\0'}, to);
    fputc('\'', to);
}

static void zsh_completion(FILE *to)
{
    fprintf(to,
        "#compdef crease\n_crease() {\n    if (( CURRENT == 2 )); then\n        _values "
        "command");
    for (size_t i = 0; i < command_count; i++)
        fprintf(to, " '%s[%s]'", commands[i].name, commands[i].summary);
    fprintf(to, "\n        return\n    fi\n    case $words[2] in\n");
    for (size_t i = 0; i < command_count; i++) {
        fprintf(to, "    %s) _arguments", commands[i].name);
        for (size_t j = 0; j < option_count; j++)
            if (option_table[j].commands & commands[i].bit)
                fprintf(to, " --%s%s", option_table[j].name, option_table[j].argument ? "=" : "");
        fprintf(to, " '*:file:_files' ;;\n");
    }
    fprintf(to, "    esac\n}\n_crease \"$@\"\n");
}

static void fish_completion(FILE *to)
{
    for (size_t i = 0; i < command_count; i++) {
        fprintf(to, "complete -c crease -n __fish_use_subcommand -a %s -d ", commands[i].name);
        quoted(to, commands[i].summary);
        fputc('\n', to);
        for (size_t j = 0; j < option_count; j++) {
            if (!(option_table[j].commands & commands[i].bit))
                continue;
            fprintf(to, "complete -c crease -n '__fish_seen_subcommand_from %s' -l %s%s -d ",
                commands[i].name, option_table[j].name, option_table[j].argument ? " -r" : "");
            quoted(to, option_table[j].help);
            fputc('\n', to);
        }
    }
}

bool help_completion(FILE *to, const char *shell)
{
    static const struct {
        const char *shell;
        void (*print)(FILE *);
    } shells[] = {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}};
    for (size_t i = 0; i < sizeof shells / sizeof shells[0]; i++)
        if (strcmp(shells[i].shell, shell) == 0) {
            shells[i].print(to);
            return true;
        }
    return false;
}
