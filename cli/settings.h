/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Everything the command line can set, in one place; each command uses its part. */
#ifndef CREASE_CLI_SETTINGS_H
#define CREASE_CLI_SETTINGS_H

#include "crease/crease.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MOST_OUTPUTS = 16, MOST_INPUTS = 2 };

typedef enum fit_method {
    METHOD_AUTOMATIC,
    METHOD_PART,
    METHOD_SHELL,
    METHOD_SHEET,
    METHOD_AVERAGING
} fit_method;

typedef enum face_kind { FACES_ANALYTIC, FACES_BSPLINE } face_kind;

/* What the field `feature` comes from. */
typedef enum feature_source { FEATURES_CREASES, FEATURES_SCORE } feature_source;

typedef struct settings {
    /* paths */
    const char *inputs[MOST_INPUTS];
    size_t input_count;
    const char *outputs[MOST_OUTPUTS];
    size_t output_count;
    const char *creases;
    const char *points;
    const char *report;
    const char *resume;
    const char *scratch;
    /* how it runs */
    int threads;
    size_t memory; /* bytes; 0: no limit */
    uint64_t seed;
    bool quiet;
    bool json;
    bool help;
    crease_read_options read;
    /* what it does */
    crease_detect_options detect;
    int detector; /* crease_detector */
    int features; /* feature_source */
    crease_regions_options regions;
    crease_filter_options filter;
    double sigma; /* for the regions and the filter */
    int method;   /* fit_method */
    int faces;    /* face_kind */
    bool no_snap;
    bool no_trim;
    crease_averaging_options averaging;
    crease_sheet_options sheet;
    int orientation; /* crease_orientation, shared by both methods */
    double rotation[9];
    bool rotation_given;
    size_t net[2];
    bool net_given;
    double tolerance;
    /* crease example */
    double noise; /* negative: as the example has it */
    int count;    /* 0: as many as the example has */
    /* crease reproduce */
    int seeds;
} settings;

/** Every setting at its default: those of the library where it has one. */
settings settings_default(void);

/** Carries the settings that several methods share into the options of each. */
void settings_resolve(settings *s);

#endif
