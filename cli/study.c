/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The noise study of "Sharp edge preservation using bicubic B-spline surfaces", repeated over many
 * seeds and measured against the true planes: the literal algorithm beside the sheet. */
#include "study.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { METHODS = 2, SAMPLES = 4, LEVELS = 5, MEASURES = 5 };

static const char *const method_names[METHODS] = {"averaging", "sheet"};
static const struct {
    const char *name;
    int across, along;
    bool roof;
} samples[SAMPLES] = {{"17 x 3, roof", 17, 3, true}, {"3 x 17, roof", 3, 17, true},
    {"17 x 3, flat", 17, 3, false}, {"3 x 17, flat", 3, 17, false}};
static const double levels[LEVELS] = {0, 0.16, 0.32, 0.48, 0.64};
/* What is measured: crease position, dihedral angle, flattened width, rms and max to the planes. */
static const struct {
    const char *name, *unit;
} measures[MEASURES] = {
    {"crease", "h"}, {"angle", "degrees"}, {"width", "h"}, {"rms", "h"}, {"max", "h"}};

/* Sums over the seeds of one method, sample and level. */
typedef struct cell {
    int runs;  /* fits that came to an end */
    int sharp; /* fits with a crease */
    double sum[MEASURES], square[MEASURES];
    int count[MEASURES];
} cell;

typedef cell table[METHODS][SAMPLES][LEVELS];

static void add(cell *c, int measure, double value)
{
    c->sum[measure] += value;
    c->square[measure] += value * value;
    c->count[measure]++;
}

static double mean(const cell *c, int measure)
{
    return c->count[measure] ? c->sum[measure] / c->count[measure] : NAN;
}

/* Standard deviation over the seeds. */
static double spread(const cell *c, int measure)
{
    const int n = c->count[measure];
    if (n < 2)
        return 0.0;
    const double m = c->sum[measure] / n;
    return sqrt(fmax(0.0, (c->square[measure] - n * m * m) / (n - 1)));
}

static void note(cell *c, const crease_accuracy *a, double h)
{
    c->runs++;
    if (a->lines) {
        c->sharp++;
        add(c, 0, a->position / h);
        add(c, 1, a->angle);
    }
    add(c, 2, a->width / h);
    add(c, 3, a->rms / h);
    add(c, 4, a->max / h);
}

static crease_status run(
    crease_context *context, const crease_sample_options *options, int method, cell *c)
{
    crease_cloud *cloud = NULL;
    crease_sheet *sheet = NULL;
    crease_status status = crease_shape_sample(context, options, &cloud);
    if (status == CREASE_OK)
        status = method == 0 ? crease_averaging_fit(context, cloud, NULL, &sheet)
                             : crease_sheet_fit(context, cloud, NULL, &sheet);
    if (status == CREASE_OK) {
        const crease_accuracy accuracy = crease_sample_accuracy(options, sheet);
        note(c, &accuracy, options->spacing);
    }
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    return status;
}

static crease_status run_cell(
    crease_context *context, int seeds, int method, int sample, int level, cell *c)
{
    crease_sample_options options = crease_sample_options_default();
    options.across = samples[sample].across;
    options.along = samples[sample].along;
    options.roof = samples[sample].roof;
    options.noise = levels[level];
    const int repetitions = levels[level] > 0 ? seeds : 1;
    crease_status status = CREASE_OK;
    for (int i = 0; i < repetitions && status == CREASE_OK; i++) {
        options.variant = (uint64_t)i;
        status = run(context, &options, method, c);
    }
    return status;
}

static crease_status run_table(crease_context *context, int seeds, table t)
{
    crease_status status = CREASE_OK;
    for (int i = 0; i < METHODS * SAMPLES * LEVELS && status == CREASE_OK; i++) {
        const int level = i % LEVELS, sample = i / LEVELS % SAMPLES, method = i / LEVELS / SAMPLES;
        status = run_cell(context, seeds, method, sample, level, &t[method][sample][level]);
    }
    return status;
}

static void print_measure(FILE *to, const cell *c, int measure)
{
    const double m = mean(c, measure), s = spread(c, measure);
    if (isnan(m))
        fprintf(to, " - |");
    else if (measure == 1)
        fprintf(to, " %.1f ± %.1f |", m, s);
    else if (m < 5e-4 && s < 5e-4)
        fprintf(to, " %.1e |", m);
    else
        fprintf(to, " %.3f ± %.3f |", m, s);
}

static void print_sample(FILE *to, table t, int sample)
{
    fprintf(to,
        "\n## %s\n\n"
        "| method | noise (h) | sharp in | crease off (h) | angle (°) | width (h) | rms (h) | "
        "max (h) |\n|---|---|---|---|---|---|---|---|\n",
        samples[sample].name);
    for (int method = 0; method < METHODS; method++)
        for (int level = 0; level < LEVELS; level++) {
            const cell *c = &t[method][sample][level];
            fprintf(to, "| %s | %.2f | %d of %d |", method_names[method], levels[level], c->sharp,
                c->runs);
            for (int i = 0; i < MEASURES; i++)
                print_measure(to, c, i);
            fprintf(to, "\n");
        }
}

static void print_text(FILE *to, int seeds, table t)
{
    fprintf(to,
        "# The noise study\n\n"
        "51 points around one edge of the cube (spacing h, dihedral angle 90°), 13 of them moved "
        "along ±z by a normal distribution of standard deviation noise x h. Mean ± standard "
        "deviation over %d seeds (one where there is no noise). `averaging` is the paper's "
        "Algorithm 1 to the letter, `sheet` places the crease where the data show it.\n\n"
        "- *sharp in*: fits that have a crease at all\n"
        "- *crease off*: rms distance of the crease from the true edge\n"
        "- *angle*: dihedral angle across the crease\n"
        "- *width*: of the rounded or flattened zone across the edge\n"
        "- *rms*, *max*: distance of the surface from the true planes\n",
        seeds);
    for (int sample = 0; sample < SAMPLES; sample++)
        print_sample(to, t, sample);
}

static cJSON *cell_json(const cell *c)
{
    cJSON *object = cJSON_CreateObject();
    cJSON_AddNumberToObject(object, "runs", c->runs);
    cJSON_AddNumberToObject(object, "sharp", c->sharp);
    for (int i = 0; i < MEASURES; i++) {
        cJSON *one = cJSON_AddObjectToObject(object, measures[i].name);
        cJSON_AddStringToObject(one, "unit", measures[i].unit);
        cJSON_AddNumberToObject(one, "mean", mean(c, i)); /* null when nothing was measured */
        cJSON_AddNumberToObject(one, "spread", spread(c, i));
    }
    return object;
}

static cJSON *table_json(int seeds, table t)
{
    cJSON *root = cJSON_CreateObject(), *rows = cJSON_CreateArray();
    cJSON_AddNumberToObject(root, "seeds", seeds);
    for (int i = 0; i < METHODS * SAMPLES * LEVELS; i++) {
        const int level = i % LEVELS, sample = i / LEVELS % SAMPLES, method = i / LEVELS / SAMPLES;
        cJSON *row = cell_json(&t[method][sample][level]);
        cJSON_AddStringToObject(row, "method", method_names[method]);
        cJSON_AddStringToObject(row, "sample", samples[sample].name);
        cJSON_AddNumberToObject(row, "noise", levels[level]);
        cJSON_AddItemToArray(rows, row);
    }
    cJSON_AddItemToObject(root, "results", rows);
    return root;
}

static crease_status write_text(
    crease_context *context, const char *folder, const char *name, const char *text, report *r)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (!text)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = crease_file_write(context, path, text, strlen(text));
    if (status == CREASE_OK)
        report_line(r, "wrote %s", path);
    return status;
}

crease_status study_write(crease_context *context, int seeds, const char *folder, report *r)
{
    table *t = calloc(1, sizeof *t);
    char *text = NULL;
    size_t size = 0;
    crease_status status = t ? run_table(context, seeds, *t) : CREASE_ERROR_NO_MEMORY;
    FILE *memory = status == CREASE_OK ? open_memstream(&text, &size) : NULL;
    if (memory) {
        print_text(memory, seeds, *t);
        fclose(memory);
        status = write_text(context, folder, "study.md", text, r);
    }
    if (status == CREASE_OK) {
        cJSON *root = table_json(seeds, *t);
        char *json = cJSON_Print(root);
        status = write_text(context, folder, "study.json", json, r);
        free(json);
        cJSON_AddItemToObject(r->root, "study", root);
    }
    free(text);
    free(t);
    return status;
}
