/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "report.h"

#include "option.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void add_option(cJSON *list, const option *o, const settings *s)
{
    char text[64];
    option_value_text(o, s, text, sizeof text);
    switch (o->kind) {
    case OPTION_INTEGER:
    case OPTION_SIZE:
    case OPTION_REAL:
        cJSON_AddNumberToObject(list, o->name, strtod(text, NULL));
        break;
    case OPTION_FLAG:
        cJSON_AddBoolToObject(list, o->name, strcmp(text, "yes") == 0);
        break;
    case OPTION_NET:
        cJSON_AddStringToObject(list, o->name, s->net_given ? text : "automatic");
        break;
    case OPTION_CHOICE:
    case OPTION_SEED: /* as text: JSON numbers do not hold 64 bits */
        cJSON_AddStringToObject(list, o->name, text);
        break;
    case OPTION_PATH:
    case OPTION_OUTPUT:
    case OPTION_ROTATION:
        break;
    }
}

/* Options that change what is written on the terminal but not the result are left out. */
static bool shapes_result(const option *o)
{
    return strcmp(o->name, "help") != 0 && strcmp(o->name, "quiet") != 0 &&
        strcmp(o->name, "json") != 0;
}

static void add_options(cJSON *root, int command_bit, const settings *s)
{
    cJSON *list = cJSON_AddObjectToObject(root, "options");
    for (size_t i = 0; i < option_count; i++)
        if (option_table[i].commands & command_bit && shapes_result(&option_table[i]))
            add_option(list, &option_table[i], s);
    if (s->rotation_given)
        cJSON_AddItemToObject(list, "rotation", cJSON_CreateDoubleArray(s->rotation, 9));
}

bool report_begin(report *r, const char *command, int command_bit, const settings *s)
{
    *r = (report){.root = cJSON_CreateObject(), .begun = seconds(), .speak = !s->quiet && !s->json};
    r->stage_begun = r->begun;
    cJSON_AddStringToObject(r->root, "program", "crease");
    cJSON_AddStringToObject(r->root, "version", crease_version());
    cJSON_AddStringToObject(r->root, "command", command);
    if (s->input_count)
        cJSON_AddStringToObject(r->root, "input", s->inputs[s->input_count - 1]);
    add_options(r->root, command_bit, s);
    r->timings = cJSON_AddObjectToObject(r->root, "seconds");
    return r->timings != NULL;
}

void report_stage(report *r, const char *stage)
{
    const double now = seconds();
    cJSON_AddNumberToObject(r->timings, stage, now - r->stage_begun);
    r->stage_begun = now;
}

void report_failure(report *r, crease_status status, const char *sentence)
{
    static const char *const kinds[] = {"none", "usage", "input", "failure"};
    cJSON *error = cJSON_AddObjectToObject(r->root, "error");
    cJSON_AddStringToObject(error, "kind", kinds[crease_status_kind(status)]);
    cJSON_AddStringToObject(error, "status", crease_status_sentence(status));
    cJSON_AddStringToObject(error, "sentence", sentence);
}

static void set_number(cJSON *object, const char *name, double number)
{
    cJSON_DeleteItemFromObject(object, name);
    cJSON_AddNumberToObject(object, name, number);
}

void report_free(report *r)
{
    cJSON_Delete(r->root);
}

char *report_text(report *r)
{
    struct rusage usage;
    set_number(r->timings, "total", seconds() - r->begun);
    if (getrusage(RUSAGE_SELF, &usage) == 0)
        set_number(r->root, "peak_memory_mb", (double)usage.ru_maxrss / 1024.0);
    return cJSON_Print(r->root);
}

void report_line(const report *r, const char *format, ...)
{
    if (!r->speak)
        return;
    va_list arguments;
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    putchar('\n');
}

void report_vector(cJSON *object, const char *name, const double values[3])
{
    cJSON_AddItemToObject(object, name, cJSON_CreateDoubleArray(values, 3));
}
