/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease: the program. Finds the command, runs it, tells how it went. */
#include "command.h"
#include "engine.h"
#include "help.h"
#include "limit.h"
#include "terminal.h"

#include <stdlib.h>
#include <string.h>

const command commands[] = {
    {"filter", FOR_FILTER, "filter CLOUD -o FILE [OPTIONS]", "take noise off a cloud, edges kept",
        "Finds outliers, and moves every other point onto the surface that the points on its own "
        "side of any edge suggest. Nothing needs to be set.\n\n"
        "CLOUD is a PLY, PCD, XYZ, TXT, CSV, ASC, PTS, LAS, OBJ, STL or OFF file; - is standard "
        "input.\n"
        "What FILE gets depends on its extension: .ply .pcd .xyz .txt .csv .asc .pts the filtered "
        "cloud, all points in their order, with the field `outlier` (1 or 0; outliers stay where "
        "they are); .png .svg .pdf a figure; .html a page to turn and pick points in; .json the "
        "report.",
        filter_run},
    {"detect", FOR_DETECT, "detect CLOUD -o FILE [OPTIONS]", "find the sharp edges of a cloud",
        "Finds the smooth regions of a cloud, the creases in which they meet at an angle, and the "
        "points that lie on them. Nothing needs to be set.\n\n"
        "CLOUD is a PLY, PCD, XYZ, TXT, CSV, ASC, PTS, LAS, OBJ, STL or OFF file; - is standard "
        "input.\n"
        "What FILE gets depends on its extension: .ply .pcd .xyz .txt .csv .asc .pts the cloud "
        "with the "
        "fields `variance` (the score: see --detector), `feature` (1 on a sharp edge) and "
        "`region` (number of the smooth region, -1 for outliers), all points in their order; .png "
        ".svg .pdf a figure; .html a page to turn and pick points in; .json the report.",
        detect_run},
    {"fit", FOR_FIT, "fit CLOUD -o FILE [OPTIONS]",
        "turn a cloud into a CAD model, edges kept sharp",
        "Turns the cloud of a whole part into a solid: a face on the surface of every smooth "
        "region, edges where they meet, closed where the points allow; open ones end at the border "
        "of their points (--method shell). "
        "Fits one bicubic B-spline "
        "sheet, sharp along the edges that the data show, to a cloud in which no surface lies over "
        "another. Nothing needs to be set.\n\n"
        "CLOUD is a PLY, PCD, XYZ, TXT, CSV, ASC, PTS, LAS, OBJ, STL or OFF file; - is standard "
        "input.\n"
        "What FILE gets depends on its extension: .step .stp .iges .igs .brep the CAD model; .obj "
        ".stl .ply .glb a mesh; .png .svg .pdf a figure; .html a page to turn and pick points in; "
        ".json the report.",
        fit_run},
    {"compare", FOR_COMPARE, "compare MODEL CLOUD [-o FILE] [OPTIONS]",
        "tell how far a cloud is from a CAD model",
        "Measures the distance of every point from the nearest face of a CAD model. Both must lie "
        "in the same place, and be in the same unit.\n\n"
        "MODEL is a STEP, IGES or BREP file; CLOUD is a PLY, PCD, XYZ, TXT, CSV, ASC, PTS, LAS, "
        "OBJ, "
        "STL or OFF file; - is standard input.\n"
        "What FILE gets depends on its extension: .ply .pcd .xyz .txt .csv .asc .pts the cloud "
        "with the "
        "fields `deviation` (positive outside) and `face` (number of the nearest face, from 0, in "
        "the order of MODEL); .png .svg .pdf a figure; .html a page to turn and pick points in; "
        ".json the report, with mean, rms, 95 % and greatest deviation for every face.",
        compare_run},
    {"info", FOR_INFO, "info FILE [OPTIONS]", "tell what a cloud or a CAD model holds",
        "Reads a cloud (PLY, PCD, XYZ, TXT, CSV, ASC, PTS, LAS, OBJ, STL, OFF) or a CAD model "
        "(STEP, "
        "IGES, BREP) and tells what it holds.",
        info_run},
    {"example", FOR_EXAMPLE, "example cube|sample|panel|bracket -o FILE [OPTIONS]",
        "make a cloud to try the others on",
        "Makes a cloud: the paper's cube (6146 points), the paper's sample of 51 points at one "
        "edge, a scanned panel with noise, outliers and an edge along no axis, or a bracket "
        "scanned from all around.\n\n"
        "FILE is .ply .pcd .xyz .txt .csv .asc or .pts.",
        example_run},
    {"reproduce", FOR_REPRODUCE, "reproduce -o FOLDER [OPTIONS]",
        "rebuild the experiment of the paper",
        "Rebuilds the experiment of \"Sharp edge preservation using bicubic B-spline surfaces\" in "
        "a "
        "folder: its clouds, Figures 1 to 4 as PNG and SVG and one more that sets its algorithm "
        "beside the sheet, and what it lacks: a table of the errors of both over many random "
        "repetitions of each noise level, as study.md and study.json.",
        reproduce_run},
};

const size_t command_count = sizeof commands / sizeof commands[0];

static int exit_code(crease_status status)
{
    static const int codes[] = {[CREASE_KIND_NONE] = 0,
        [CREASE_KIND_FAILURE] = 1,
        [CREASE_KIND_USAGE] = 2,
        [CREASE_KIND_INPUT] = 3};
    return codes[crease_status_kind(status)];
}

static crease_status print_report(report *r)
{
    char *text = report_text(r);
    if (!text || puts(text) == EOF || fflush(stdout) == EOF) {
        free(text);
        return CREASE_ERROR_CANNOT_WRITE;
    }
    free(text);
    return CREASE_OK;
}

/* Tells of a failure on stderr and in the report. */
static void tell_failure(const command *c, crease_context *context, crease_status status, report *r)
{
    const char *sentence = crease_context_message(context);
    if (!*sentence)
        sentence = crease_status_sentence(status);
    fprintf(stderr, "crease %s: %s\n", c->name, sentence);
    report_failure(r, status, sentence);
}

static crease_status run(const command *c, crease_context *context, const settings *s)
{
    report r;
    if (!report_begin(&r, c->name, c->bit, s))
        return CREASE_ERROR_NO_MEMORY;
    cJSON_AddNumberToObject(r.root, "threads", crease_context_threads(context));
    crease_status status = c->run(context, s, &r);
    terminal_clear();
    if (status != CREASE_OK)
        tell_failure(c, context, status, &r);
    if (s->json && print_report(&r) != CREASE_OK && status == CREASE_OK)
        status = CREASE_ERROR_CANNOT_WRITE;
    report_free(&r);
    return status;
}

static crease_status lead(const command *c, crease_context *context, const settings *s)
{
    crease_status status = engine_begin(context, s);
    if (status == CREASE_OK)
        status = crease_context_keep(context, s->resume);
    if (status == CREASE_OK)
        status = run(c, context, s);
    else
        fprintf(stderr, "crease: %s\n", crease_context_message(context));
    engine_end(status);
    return status;
}

static int run_command(const command *c, int count, char **arguments)
{
    settings s = settings_default();
    if (!options_parse(c->bit, c->name, count, arguments, &s))
        return 2;
    if (s.help) {
        help_command(stdout, c);
        return 0;
    }
    limit_prepare(&s);
    terminal_catch_signals();
    crease_context_options o = crease_context_options_default();
    o.threads = s.threads;
    o.seed = s.seed;
    o.memory = s.memory;
    o.cancelled = terminal_cancelled;
    if (!s.quiet) {
        o.progress = terminal_progress;
        o.warn = terminal_warn;
    }
    crease_context *context = NULL;
    crease_status status = crease_context_create(&o, &context);
    if (status == CREASE_OK)
        status = lead(c, context, &s);
    else
        fprintf(stderr, "crease: %s\n", crease_status_sentence(status));
    crease_context_free(context);
    if (terminal_signal())
        terminal_raise(terminal_signal());
    return exit_code(status);
}

static int run_global(int count, char **arguments)
{
    const char *word = arguments[1];
    if (strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0) {
        printf("crease %s\n", crease_version());
    } else if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 ||
        strcmp(word, "help") == 0) {
        help_overview(stdout);
    } else if (strcmp(word, "--man") == 0) {
        help_man(stdout);
    } else if (strcmp(word, "--completion") == 0 && count > 2) {
        if (!help_completion(stdout, arguments[2])) {
            fprintf(
                stderr, "crease: completions are for bash, zsh or fish, not '%s'\n", arguments[2]);
            return 2;
        }
    } else {
        fprintf(stderr, "crease: there is no command '%s'; see crease --help\n", word);
        return 2;
    }
    return 0;
}

static int program(int count, char **arguments)
{
    if (count < 2) {
        help_overview(stderr);
        return 2;
    }
    for (size_t i = 0; i < command_count; i++)
        if (strcmp(commands[i].name, arguments[1]) == 0)
            return run_command(&commands[i], count - 2, arguments + 2);
    return run_global(count, arguments);
}

int main(int count, char **arguments)
{
    return engine_main(count, arguments, program);
}
