/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "option.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define AT(member) offsetof(settings, member)

const char *const fit_method_names[] = {"automatic", "part", "shell", "sheet", "averaging", NULL};
static const char *const face_names[] = {"analytic", "bspline", NULL};
static const char *const detector_names[] = {
    "bootstrap", "jackknife", "variation", "gauss-map", NULL};
static const char *const feature_names[] = {"creases", "score", NULL};
static const char *const orientation_names[] = {"automatic", "none", NULL};

const option option_table[] = {
    {"output", 'o', OPTION_OUTPUT, "FILE",
        FOR_DETECT | FOR_FIT | FOR_COMPARE | FOR_FILTER | FOR_EXAMPLE | FOR_REPRODUCE, 0, 0, 0,
        NULL, "what to write; may be given several times, the extension says what", "nothing"},
    {"creases", 0, OPTION_PATH, "FILE", FOR_DETECT | FOR_FIT, AT(creases), 0, 0, NULL,
        "write the creases: as lines to .ply, .obj or .csv, as the curves that they are to .step, "
        ".stp, .iges, .igs or .brep",
        "not written"},
    {"points", 0, OPTION_PATH, "FILE", FOR_FIT, AT(points), 0, 0, NULL,
        "write the cloud projected onto the surface, with the field `deviation`: .ply, .xyz, .csv, "
        "...",
        "not written"},
    {"report", 0, OPTION_PATH, "FILE", FOR_DETECT | FOR_FIT | FOR_COMPARE | FOR_FILTER, AT(report),
        0, 0, NULL, "write the report as JSON", "not written"},
    {"method", 'm', OPTION_CHOICE, "NAME", FOR_FIT, AT(method), 0, 0, fit_method_names,
        "`part`: a face for every smooth region, closed to a solid where the points allow; "
        "`shell`: the same for points that end at a border, along which the faces end as well; "
        "`sheet`: one surface whose creases are knot lines; `averaging`: the paper's Algorithm 1; "
        "`automatic`: where no surface lies over another a sheet, or a shell if creases are not "
        "where "
        "a sheet can have them; else a part",
        NULL},
    {"faces", 0, OPTION_CHOICE, "KIND", FOR_FIT, AT(faces), 0, 0, face_names,
        "part, shell: planes, cylinders, cones, spheres and tori as what they are, or every face "
        "as a "
        "B-spline surface",
        NULL},
    {"no-snap", 0, OPTION_FLAG, NULL, FOR_FIT, AT(no_snap), 0, 0, NULL,
        "part, shell: leave surfaces that are parallel, perpendicular, coaxial, equally large or "
        "symmetric "
        "within "
        "their errors as the points have them",
        NULL},
    {"no-trim", 0, OPTION_FLAG, NULL, FOR_FIT, AT(no_trim), 0, 0, NULL,
        "sheet: write its full rectangle, also where no points are, instead of trimming it to "
        "their "
        "border and their holes",
        NULL},
    {"sigma", 0, OPTION_REAL, "S", FOR_DETECT | FOR_FIT | FOR_FILTER, AT(sigma), 0, 1e150, NULL,
        "noise of the points along the normal, when it is known: a length; each point is then "
        "taken to err by itself. A sheet finds its own",
        "0: estimated"},
    {"window", 'w', OPTION_INTEGER, "K", FOR_FILTER, AT(filter.neighbours), 25, 256, NULL,
        "points among which a point's surface is sought, itself included", NULL},
    {"passes", 'p', OPTION_INTEGER, "N", FOR_FILTER, AT(filter.passes), 0, 10, NULL,
        "times every point is moved; 0: only outliers are found", NULL},
    {"outlier-sigmas", 0, OPTION_REAL, "X", FOR_FILTER, AT(filter.outlier_sigmas), 0.1, 1e6, NULL,
        "an outlier is further from the surface than this many times the noise", NULL},
    {"remove-outliers", 0, OPTION_FLAG, NULL, FOR_FILTER, AT(filter.remove_outliers), 0, 0, NULL,
        "leave outliers out instead of marking them", NULL},
    {"detector", 'd', OPTION_CHOICE, "NAME", FOR_DETECT, AT(detector), 0, 0, detector_names,
        "what the field `variance` holds. `bootstrap`: variance of the normal over resampled "
        "neighbours; `jackknife`: its limit, without resampling; `variation`: surface variation, "
        "the "
        "share of the neighbours' variance along the normal; `gauss-map`: how far the normals of "
        "the "
        "neighbours' triangles fall into two clusters",
        NULL},
    {"features", 0, OPTION_CHOICE, "FROM", FOR_DETECT, AT(features), 0, 0, feature_names,
        "what the field `feature` comes from. `creases`: the points within one spacing of a "
        "crease; "
        "`score`: the points whose score noise does not explain",
        NULL},
    {"false-discovery-rate", 0, OPTION_REAL, "R", FOR_DETECT, AT(detect.false_discovery_rate), 0, 1,
        NULL, "expected share of wrong ones among the points of --features score", NULL},
    {"neighbours", 'K', OPTION_INTEGER, "K", FOR_DETECT | FOR_FIT, AT(detect.neighbours), 4, 256,
        NULL, "neighbours of a point in its score, itself included", NULL},
    {"resamples", 'B', OPTION_INTEGER, "B", FOR_DETECT | FOR_FIT, AT(detect.resamples), 2, 10000,
        NULL, "bootstrap resamples of each neighbourhood", NULL},
    {"net", 'n', OPTION_NET, "MxN", FOR_FIT, AT(net), 4, 4096, NULL,
        "control points across and along the edge",
        "6x6 for averaging, as many as the data ask for with sheet"},
    {"orientation", 0, OPTION_CHOICE, "HOW", FOR_FIT, AT(orientation), 0, 0, orientation_names,
        "how the cloud is turned into a height field: found from the data, or left as it is", NULL},
    {"rotation", 0, OPTION_ROTATION, "M", FOR_FIT, AT(rotation), 0, 0, NULL,
        "turn the cloud by this matrix instead: nine numbers, row by row, separated by commas",
        "none"},
    {"averaging-neighbours", 0, OPTION_INTEGER, "N", FOR_FIT, AT(averaging.averaging_neighbours), 1,
        256, NULL, "averaging, step 5: data points averaged for a control point", NULL},
    {"passes", 0, OPTION_INTEGER, "N", FOR_FIT, AT(averaging.passes), 1, 1000, NULL,
        "averaging, step 5: passes", NULL},
    {"marking-neighbours", 0, OPTION_INTEGER, "N", FOR_FIT, AT(averaging.marking_neighbours), 1,
        256, NULL, "averaging, step 7: data points averaged for a mark", NULL},
    {"mark-threshold", 'e', OPTION_REAL, "E", FOR_FIT, AT(averaging.mark_threshold), 0, 1e6, NULL,
        "averaging, step 7: a control point is marked above this", NULL},
    {"row-threshold", 'g', OPTION_INTEGER, "G", FOR_FIT, AT(averaging.row_threshold), 0, 4096, NULL,
        "averaging, step 9: a row with more marks than this is repeated", NULL},
    {"multiplicity", 0, OPTION_INTEGER, "N", FOR_FIT, AT(averaging.multiplicity), 1, 3, NULL,
        "averaging, step 9: times a marked row stands in the net", NULL},
    {"order", 0, OPTION_INTEGER, "K", FOR_FIT, AT(sheet.order), 2, 8, NULL,
        "sheet: order of the surface, degree + 1", NULL},
    {"most-creases", 0, OPTION_INTEGER, "N", FOR_FIT, AT(sheet.creases), -1, 1000, NULL,
        "sheet: most crease lines in each direction", "-1: all that are significant"},
    {"smoothing", 0, OPTION_REAL, "W", FOR_FIT, AT(sheet.smoothing), -1, 1e12, NULL,
        "sheet: weight of the thin-plate term", "-1: found from the data"},
    {"tolerance", 0, OPTION_REAL, "T", FOR_FIT, AT(sheet.tolerance), 0, 1e300, NULL,
        "sheet: refine until the rms deviation is below this length",
        "0: until only noise is left"},
    {"noise", 0, OPTION_REAL, "D", FOR_EXAMPLE, AT(noise), 0, 100, NULL,
        "standard deviation of the noise in spacings: of the panel's or the bracket's points, or "
        "of "
        "the 13 moved points of the sample",
        "0.2 for panel and bracket, none for the others"},
    {"count", 0, OPTION_INTEGER, "N", FOR_EXAMPLE, AT(count), 4, 100000000, NULL,
        "points of the panel or the bracket", "20000 or 30000"},
    {"seeds", 0, OPTION_INTEGER, "N", FOR_REPRODUCE, AT(seeds), 1, 100000, NULL,
        "random repetitions for each noise level", NULL},
    {"skip-invalid", 0, OPTION_FLAG, NULL,
        FOR_DETECT | FOR_FIT | FOR_COMPARE | FOR_FILTER | FOR_INFO, AT(read.skip_invalid), 0, 0,
        NULL, "leave out points that are not finite numbers instead of stopping", NULL},
    {"mesh-points", 0, OPTION_INTEGER, "N",
        FOR_DETECT | FOR_FIT | FOR_COMPARE | FOR_FILTER | FOR_INFO, AT(read.mesh_points), -1, 1e7,
        NULL,
        "points drawn on the triangles of a mesh (STL, OBJ, OFF, PLY), as if it were scanned; 0: "
        "its "
        "vertices are the cloud",
        "-1: where its vertices alone do not tell its shape, as many as its narrowest faces ask "
        "for"},
    {"resume", 0, OPTION_PATH, "FOLDER", FOR_DETECT | FOR_FIT, AT(resume), 0, 0, NULL,
        "keep what the long stages find in this folder, and begin with what is there: work that "
        "was "
        "broken off goes on after its last finished stage, with the same result",
        "nothing is kept"},
    {"memory", 0, OPTION_SIZE, "SIZE", FOR_DETECT | FOR_FIT, AT(memory), 50e6, 1e18, NULL,
        "take no more memory than this: bytes, such as 500M or 2G. A PLY, LAS, XYZ or CSV file "
        "whose points do not fit: `detect` goes from file to file, part by part, with regions "
        "and creases from a sample; `fit` takes a sample",
        "no limit"},
    {"scratch", 0, OPTION_PATH, "FOLDER", FOR_DETECT, AT(scratch), 0, 0, NULL,
        "with --memory: where files of 56 bytes for each point are kept meanwhile",
        "the folder of the output"},
    {"seed", 's', OPTION_SEED, "N", FOR_DETECT | FOR_FIT | FOR_EXAMPLE | FOR_REPRODUCE, AT(seed), 0,
        0, NULL, "seed of every random draw", NULL},
    {"threads", 't', OPTION_INTEGER, "N", FOR_ALL, AT(threads), 0, 1024, NULL,
        "number of threads; the result does not depend on it", "0: one for each processor"},
    {"json", 'j', OPTION_FLAG, NULL, FOR_ALL, AT(json), 0, 0, NULL,
        "print the report as JSON on standard output", NULL},
    {"quiet", 'q', OPTION_FLAG, NULL, FOR_ALL, AT(quiet), 0, 0, NULL,
        "print nothing but errors, and no progress", NULL},
    {"help", 'h', OPTION_FLAG, NULL, FOR_ALL, AT(help), 0, 0, NULL, "show this help and stop",
        NULL},
};

const size_t option_count = sizeof option_table / sizeof option_table[0];

static bool complain(const char *command, const char *sentence, const char *detail)
{
    fprintf(stderr, "crease %s: ", command);
    fprintf(stderr, sentence, detail);
    fprintf(stderr, "; see crease %s --help\n", command);
    return false;
}

static void *member(settings *s, const option *o)
{
    return (char *)s + o->offset;
}

static bool read_number(const char *text, double *number)
{
    char *end = NULL;
    errno = 0;
    *number = strtod(text, &end);
    return *text && !*end && isfinite(*number) && errno != ERANGE;
}

static bool set_integer(const option *o, const char *text, settings *s)
{
    double number;
    if (!read_number(text, &number) || number != floor(number) || number < o->least ||
        number > o->most)
        return false;
    *(int *)member(s, o) = (int)number;
    return true;
}

static bool set_real(const option *o, const char *text, settings *s)
{
    double number;
    if (!read_number(text, &number) || number < o->least || number > o->most)
        return false;
    *(double *)member(s, o) = number;
    return true;
}

/* 1500000, 500M, 2G: powers of 1000, as disks and most programs have them. */
static bool set_size(const option *o, const char *text, settings *s)
{
    static const char units[] = "kMGT";
    char *end = NULL;
    errno = 0;
    double number = strtod(text, &end);
    if (end == text || errno == ERANGE || !isfinite(number))
        return false;
    const char *const unit = *end ? strchr(units, *end) : NULL;
    if (unit)
        end++;
    for (const char *u = units; unit && u <= unit; u++)
        number *= 1000;
    if (*end || number < o->least || number > o->most)
        return false;
    *(size_t *)member(s, o) = (size_t)number;
    return true;
}

static bool set_seed(const option *o, const char *text, settings *s)
{
    char *end = NULL;
    errno = 0;
    const unsigned long long number = strtoull(text, &end, 10);
    if (!*text || *end || *text == '-' || errno == ERANGE)
        return false;
    *(uint64_t *)member(s, o) = number;
    return true;
}

static bool set_choice(const option *o, const char *text, settings *s)
{
    for (int i = 0; o->choices[i]; i++)
        if (strcmp(o->choices[i], text) == 0) {
            *(int *)member(s, o) = i;
            return true;
        }
    return false;
}

static bool set_net(const option *o, const char *text, settings *s)
{
    char *end = NULL;
    const unsigned long m = strtoul(text, &end, 10);
    if (end == text || *end != 'x')
        return false;
    const char *second = end + 1;
    const unsigned long n = strtoul(second, &end, 10);
    if (end == second || *end)
        return false;
    const double low = fmin((double)m, (double)n), high = fmax((double)m, (double)n);
    if (low < o->least || high > o->most)
        return false;
    s->net[0] = m, s->net[1] = n;
    return s->net_given = true;
}

static bool is_rotation(const double m[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double dot =
                m[3 * i] * m[3 * j] + m[3 * i + 1] * m[3 * j + 1] + m[3 * i + 2] * m[3 * j + 2];
            if (fabs(dot - (i == j)) > 1e-6)
                return false;
        }
    const double determinant = m[0] * (m[4] * m[8] - m[5] * m[7]) -
        m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
    return determinant > 0;
}

static bool set_rotation(const char *text, settings *s)
{
    for (int i = 0; i < 9; i++) {
        char *end = NULL;
        s->rotation[i] = strtod(text, &end);
        if (end == text || *end != (i < 8 ? ',' : '\0'))
            return false;
        text = end + 1;
    }
    return s->rotation_given = is_rotation(s->rotation);
}

static bool add_output(const char *text, settings *s)
{
    if (s->output_count == MOST_OUTPUTS)
        return false;
    s->outputs[s->output_count++] = text;
    return true;
}

static bool set_value(const option *o, const char *text, settings *s)
{
    switch (o->kind) {
    case OPTION_FLAG:
        return *(bool *)member(s, o) = true;
    case OPTION_INTEGER:
        return set_integer(o, text, s);
    case OPTION_SEED:
        return set_seed(o, text, s);
    case OPTION_SIZE:
        return set_size(o, text, s);
    case OPTION_REAL:
        return set_real(o, text, s);
    case OPTION_PATH:
        *(const char **)member(s, o) = text;
        return *text;
    case OPTION_OUTPUT:
        return *text && add_output(text, s);
    case OPTION_CHOICE:
        return set_choice(o, text, s);
    case OPTION_NET:
        return set_net(o, text, s);
    case OPTION_ROTATION:
        return set_rotation(text, s);
    }
    return false;
}

static void expected(const option *o, char *text, size_t size)
{
    size_t used = 0;
    switch (o->kind) {
    case OPTION_INTEGER:
    case OPTION_REAL:
        snprintf(text, size, "a%s number from %g to %g", o->kind == OPTION_INTEGER ? " whole" : "",
            o->least, o->most);
        return;
    case OPTION_SEED:
        snprintf(text, size, "a whole number from 0 to 18446744073709551615");
        return;
    case OPTION_SIZE:
        snprintf(text, size, "bytes, such as 500M or 2G, at least %gM", o->least / 1e6);
        return;
    case OPTION_NET:
        snprintf(text, size, "two whole numbers from %g to %g such as 6x6", o->least, o->most);
        return;
    case OPTION_ROTATION:
        snprintf(text, size, "nine numbers separated by commas that form a rotation");
        return;
    case OPTION_CHOICE:
        for (int i = 0; o->choices[i] && used < size; i++)
            used += (size_t)snprintf(text + used, size - used, "%s%s",
                i == 0                  ? ""
                    : o->choices[i + 1] ? ", "
                                        : " or ",
                o->choices[i]);
        return;
    default:
        snprintf(text, size, "a file name (at most %d outputs)", MOST_OUTPUTS);
    }
}

static bool refuse(const char *command, const option *o, const char *text)
{
    char want[128];
    expected(o, want, sizeof want);
    fprintf(stderr, "crease %s: --%s takes %s, not '%s'; see crease %s --help\n", command, o->name,
        want, text, command);
    return false;
}

static const option *find_long(int commands, const char *name, size_t length)
{
    for (size_t i = 0; i < option_count; i++)
        if (option_table[i].commands & commands && strlen(option_table[i].name) == length &&
            strncmp(option_table[i].name, name, length) == 0)
            return &option_table[i];
    return NULL;
}

static const option *find_short(int commands, char letter)
{
    for (size_t i = 0; i < option_count; i++)
        if (option_table[i].commands & commands && option_table[i].letter == letter)
            return &option_table[i];
    return NULL;
}

/* One argument that begins with a dash; *next is moved on when its value is the next argument. */
static bool parse_option(
    int commands, const char *command, int count, char **arguments, int *next, settings *s)
{
    const char *word = arguments[*next - 1];
    const bool is_long = word[1] == '-';
    const char *equals = is_long ? strchr(word, '=') : NULL;
    const size_t length = equals ? (size_t)(equals - word) - 2 : strlen(word + 1) - is_long;
    const option *o =
        is_long ? find_long(commands, word + 2, length) : find_short(commands, word[1]);
    if (!o)
        return complain(command, "there is no option '%s' here", word);
    const char *value = equals ? equals + 1 : (!is_long && word[2]) ? word + 2 : NULL;
    if (o->kind == OPTION_FLAG)
        return value ? complain(command, "'%s': this option takes no value", word)
                     : set_value(o, "", s);
    if (!value && *next >= count)
        return complain(command, "'%s' wants a value after it", word);
    if (!value)
        value = arguments[(*next)++];
    return set_value(o, value, s) || refuse(command, o, value);
}

bool options_parse(int commands, const char *command, int count, char **arguments, settings *s)
{
    bool only_files = false;
    for (int next = 0; next < count;) {
        const char *word = arguments[next++];
        if (!only_files && strcmp(word, "--") == 0) {
            only_files = true;
        } else if (!only_files && word[0] == '-' && word[1]) {
            if (!parse_option(commands, command, count, arguments, &next, s))
                return false;
        } else if (s->input_count == (commands == FOR_COMPARE ? MOST_INPUTS : 1)) {
            return complain(command, "'%s' is one argument too many", word);
        } else {
            s->inputs[s->input_count++] = word;
        }
    }
    settings_resolve(s);
    return true;
}

void option_value_text(const option *o, const settings *s, char *text, size_t size)
{
    const void *at = (const char *)s + o->offset;
    switch (o->kind) {
    case OPTION_INTEGER:
        snprintf(text, size, "%d", *(const int *)at);
        return;
    case OPTION_SEED:
        snprintf(text, size, "%llu", (unsigned long long)*(const uint64_t *)at);
        return;
    case OPTION_SIZE:
        snprintf(text, size, "%zu", *(const size_t *)at);
        return;
    case OPTION_REAL:
        snprintf(text, size, "%g", *(const double *)at);
        return;
    case OPTION_CHOICE:
        snprintf(text, size, "%s",
            s->rotation_given && o->choices == orientation_names ? "given"
                                                                 : o->choices[*(const int *)at]);
        return;
    case OPTION_NET:
        snprintf(text, size, "%zux%zu", s->net[0], s->net[1]);
        return;
    case OPTION_FLAG:
        snprintf(text, size, "%s", *(const bool *)at ? "yes" : "no");
        return;
    default:
        snprintf(text, size, "%s", "");
    }
}
