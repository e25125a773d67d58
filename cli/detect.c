/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease detect: the sharp edges of a cloud, as curves and as labels of its points. */
#include "cad.h"
#include "command.h"
#include "engine.h"
#include "facts.h"
#include "input.h"
#include "limit.h"
#include "outputs.h"
#include "region.h"

#include "crease/crease_stream.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    ALLOWED = TARGET_CLOUD | TARGET_FIGURE | TARGET_PAGE | TARGET_REPORT,
    CREASES = TARGET_LINES | TARGET_CAD
};

typedef struct result {
    crease_scores *scores;
    crease_regions *regions;
    crease_network *network;
    crease_cloud *cloud;                  /* with the fields */
    size_t points, features, outliers;    /* how many */
    const cJSON *of_regions, *of_creases; /* what the report says of each */
} result;

static void result_free(result *all)
{
    crease_cloud_free(all->cloud);
    crease_network_free(all->network);
    crease_regions_free(all->regions);
    crease_scores_free(all->scores);
}

/* ---------------------------------------------------------------------------------- finding -- */

static const uint8_t *features_of(const settings *s, const result *all)
{
    return s->features == FEATURES_SCORE ? crease_scores_features(all->scores)
                                         : crease_network_features(all->network);
}

/* The cloud with its labels: the score as single numbers, which is all they are good for. */
static crease_status label(
    crease_context *context, const settings *s, const crease_cloud *cloud, result *all)
{
    const size_t count = crease_cloud_count(cloud);
    float *variance = malloc((count ? count : 1) * sizeof *variance);
    if (!variance)
        return crease_context_fail(context, CREASE_ERROR_NO_MEMORY,
            "memory ran out: %zu numbers are not to be had; use fewer points", count);
    for (size_t i = 0; i < count; i++)
        variance[i] = (float)crease_scores_variance(all->scores)[i];
    const crease_field fields[] = {
        {"variance", CREASE_TYPE_FLOAT32, variance},
        {"feature", CREASE_TYPE_UINT8, features_of(s, all)},
        {"region", CREASE_TYPE_INT32, crease_regions_labels(all->regions)},
    };
    const crease_status status = crease_cloud_with_fields(context, cloud, fields, 3, &all->cloud);
    free(variance);
    return status;
}

static void count(const settings *s, result *all)
{
    const uint8_t *const features = features_of(s, all);
    const int32_t *const labels = crease_regions_labels(all->regions);
    all->points = crease_network_point_count(all->network);
    for (size_t i = 0; i < all->points; i++) {
        all->features += features[i];
        all->outliers += labels[i] < 0;
    }
}

static crease_status find(
    crease_context *context, const settings *s, report *r, const crease_cloud *cloud, result *all)
{
    crease_status status = engine_scores(context, cloud, &s->detect, &all->scores);
    if (status != CREASE_OK)
        return status;
    report_stage(r, "scores");
    status = engine_regions(context, cloud, &s->regions, &all->regions);
    if (status != CREASE_OK)
        return status;
    report_stage(r, "regions");
    status = crease_network_find(context, all->regions, NULL, &all->network);
    if (status != CREASE_OK)
        return status;
    report_stage(r, "creases");
    count(s, all);
    return label(context, s, cloud, all);
}

/* -------------------------------------------------------------------------- larger than memory --
 */

/* The one cloud that is written; other outputs would show it whole. */
static crease_status choose_output(
    crease_context *context, const settings *s, settings *others, const char **cloud)
{
    *others = *s;
    others->output_count = 0;
    *cloud = NULL;
    for (size_t i = 0; i < s->output_count; i++) {
        const target_kind kind = target_of(s->outputs[i], ALLOWED);
        if (kind == TARGET_REPORT)
            others->outputs[others->output_count++] = s->outputs[i];
        else if (kind == TARGET_CLOUD && !*cloud)
            *cloud = s->outputs[i];
        else
            return crease_context_fail(context, CREASE_ERROR_ARGUMENT,
                "%s: the cloud is larger than --memory; it is written to one PLY file alone, leave "
                "other outputs out or raise the limit",
                s->outputs[i]);
    }
    return *cloud ? CREASE_OK
                  : crease_context_fail(context, CREASE_ERROR_ARGUMENT,
                        "the cloud is larger than --memory: name the PLY file to write it to, -o "
                        "FILE.ply, or raise the limit");
}

static void describe_stream(
    report *r, const settings *s, const char *path, const crease_stream_summary *summary)
{
    cJSON *object = cJSON_AddObjectToObject(r->root, "cloud");
    cJSON_AddNumberToObject(object, "points", (double)summary->count);
    report_vector(object, "lowest", summary->lowest);
    report_vector(object, "highest", summary->highest);
    cJSON_AddNumberToObject(r->root, "parts", (double)summary->parts);
    cJSON_AddNumberToObject(r->root, "sampled", (double)summary->sampled);
    report_line(r, "%s: %zu points, larger than --memory: worked on in %zu parts", path,
        summary->count, summary->parts);
    report_line(r,
        "regions and creases are those of a sample of %zu points; every point was then labelled by "
        "them%s",
        summary->sampled,
        s->features == FEATURES_SCORE ? ", its score and feature are its own" : "");
}

/* Leaves in `others` what is still to be written. */
static crease_status find_in_parts(
    crease_context *context, const settings *s, report *r, result *all, settings *others)
{
    const char *path = NULL, *cloud = NULL;
    crease_stream_summary summary;
    crease_stream_options options = crease_stream_options_default();
    options.detect = s->detect;
    options.regions = s->regions;
    options.read = s->read;
    options.by_score = s->features == FEATURES_SCORE;
    options.memory = limit_left(s);
    options.scratch = s->scratch;
    crease_status status = choose_output(context, s, others, &cloud);
    if (status == CREASE_OK)
        status = input_path(context, s, "the file to read", &path);
    if (status == CREASE_OK)
        status = engine_detect_stream(
            context, path, &options, cloud, &summary, &all->regions, &all->network);
    if (status != CREASE_OK)
        return status;
    report_stage(r, "parts");
    all->points = summary.count;
    all->features = summary.features;
    all->outliers = summary.outliers;
    describe_stream(r, s, path, &summary);
    report_line(r, "wrote %s", cloud);
    return CREASE_OK;
}

/* --------------------------------------------------------------------------------- telling -- */

static void describe_regions(report *r, const crease_regions *regions, size_t outliers)
{
    region_counts counts = {0};
    char text[160];
    for (size_t i = 0; i < crease_regions_count(regions); i++)
        counts.of[crease_regions_at(regions, i).type]++;
    cJSON *object = cJSON_AddObjectToObject(r->root, "regions");
    cJSON_AddNumberToObject(object, "count", (double)crease_regions_count(regions));
    region_counts_describe(object, &counts);
    cJSON_AddNumberToObject(object, "outliers", (double)outliers);
    cJSON_AddNumberToObject(r->root, "noise", crease_regions_sigma(regions));
    region_counts_text(&counts, text, sizeof text);
    report_line(r, "smooth regions: %s; outliers: %zu; noise %.2g", text, outliers,
        crease_regions_sigma(regions));
}

/* Each region: its surface, its points and how well the one explains the others. */
static const cJSON *describe_each_region(report *r, const crease_regions *regions)
{
    cJSON *list = cJSON_AddArrayToObject(cJSON_GetObjectItem(r->root, "regions"), "each");
    for (size_t i = 0; i < crease_regions_count(regions); i++) {
        const crease_region region = crease_regions_at(regions, i);
        cJSON *object = cJSON_CreateObject();
        region_describe(object, &region);
        cJSON_AddNumberToObject(object, "points", (double)region.point_count);
        cJSON_AddNumberToObject(object, "rms", region.rms);
        cJSON_AddNumberToObject(object, "chi", region.chi);
        cJSON_AddItemToArray(list, object);
    }
    return list;
}

/* Rounded edges, which the regions' types do not tell from other cylinders. */
static void describe_fillets(report *r, const crease_regions *regions)
{
    cJSON *list = cJSON_AddArrayToObject(r->root, "fillets");
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < crease_regions_count(regions); i++) {
        const crease_region region = crease_regions_at(regions, i);
        if (region.tangent[0] < 0)
            continue;
        const double tangent[2] = {region.tangent[0], region.tangent[1]};
        const double radius = region.parameters[6];
        cJSON *object = cJSON_CreateObject();
        cJSON_AddNumberToObject(object, "region", (double)i);
        cJSON_AddItemToObject(object, "tangent", cJSON_CreateDoubleArray(tangent, 2));
        cJSON_AddNumberToObject(object, "radius", radius);
        cJSON_AddItemToArray(list, object);
        least = fmin(least, radius);
        most = fmax(most, radius);
    }
    if (most > 0)
        report_line(r, "fillets: %d, radii %.4g to %.4g", cJSON_GetArraySize(list), least, most);
}

static cJSON *crease_object(crease_network_crease crease)
{
    cJSON *object = cJSON_CreateObject();
    const double regions[2] = {crease.regions[0], crease.regions[1]};
    const double corners[2] = {crease.corners[0], crease.corners[1]};
    cJSON_AddItemToObject(object, "regions", cJSON_CreateDoubleArray(regions, 2));
    cJSON_AddItemToObject(object, "corners", cJSON_CreateDoubleArray(corners, 2));
    cJSON_AddBoolToObject(object, "closed", crease.closed);
    cJSON_AddNumberToObject(object, "length", crease.length);
    cJSON_AddNumberToObject(object, "angle", crease.angle);
    cJSON_AddNumberToObject(object, "angle_error", crease.angle_error);
    cJSON_AddNumberToObject(object, "position_error", crease.position_error);
    return object;
}

static void describe_corners(report *r, const crease_network *network)
{
    cJSON *list = cJSON_AddArrayToObject(r->root, "corners");
    for (size_t i = 0; i < crease_network_corner_count(network); i++) {
        const crease_corner corner = crease_network_corner(network, i);
        cJSON *object = cJSON_CreateObject();
        report_vector(object, "position", corner.position);
        cJSON_AddNumberToObject(object, "valence", corner.valence);
        cJSON_AddItemToArray(list, object);
    }
}

static const cJSON *describe_network(report *r, const crease_network *network)
{
    const size_t count = crease_network_count(network);
    const size_t corners = crease_network_corner_count(network);
    double length = 0, least = INFINITY, most = 0;
    cJSON *list = cJSON_AddArrayToObject(r->root, "creases");
    for (size_t i = 0; i < count; i++) {
        const crease_network_crease crease = crease_network_at(network, i);
        cJSON_AddItemToArray(list, crease_object(crease));
        length += crease.length;
        least = fmin(least, crease.angle);
        most = fmax(most, crease.angle);
    }
    describe_corners(r, network);
    if (count > 0)
        report_line(r,
            "creases: %zu, length %.4g in all, dihedral angles %.1f to %.1f degrees; corners: %zu",
            count, length, least, most, corners);
    else
        report_line(r, "creases: none");
    return list;
}

static void describe_features(report *r, const settings *s, const result *all)
{
    const size_t count = all->points, found = all->features;
    const double spacing = crease_network_spacing(all->network);
    const double percent = count ? 100.0 * (double)found / (double)count : 0.0;
    cJSON_AddNumberToObject(r->root, "features", (double)found);
    cJSON_AddNumberToObject(r->root, "spacing", spacing);
    if (s->features == FEATURES_SCORE)
        report_line(
            r, "%zu of %zu points are features by their score (%.1f %%)", found, count, percent);
    else
        report_line(r, "%zu of %zu points lie on sharp edges (%.1f %%), within the spacing of %.4g",
            found, count, percent, spacing);
}

/* --------------------------------------------------------------------------------- writing -- */

static crease_status show(crease_context *context, const void *from, bool page, crease_scene *scene)
{
    (void)page;
    const result *const all = from;
    const size_t count = crease_network_count(all->network);
    crease_status status = facts_show(context, scene, all->of_regions);
    if (status == CREASE_OK && count > 0)
        status = crease_scene_add_curves(
            context, scene, "creases", crease_network_curves(all->network), count);
    return status == CREASE_OK && count > 0 ? facts_show(context, scene, all->of_creases) : status;
}

static crease_status write_creases(
    crease_context *context, report *r, const void *from, const char *path)
{
    const crease_network *const network = ((const result *)from)->network;
    if (target_of(path, CREASES) == TARGET_CAD)
        return cad_write_creases(
            context, r, crease_network_curves(network), crease_network_count(network), path);
    const crease_status status = crease_network_write(context, network, path);
    if (status == CREASE_OK)
        report_line(r, "wrote %s", path);
    return status;
}

static crease_status write_outputs(
    crease_context *context, const settings *s, report *r, const result *all)
{
    const outputs made = {.allowed = ALLOWED,
        .from = all,
        .cloud = all->cloud,
        .colour_by = "region",
        .show = show,
        .creases = write_creases};
    return outputs_write(context, s, r, &made);
}

static crease_status check(crease_context *context, const settings *s)
{
    crease_status status = targets_check(context, s, ALLOWED);
    if (status == CREASE_OK)
        status = target_check(context, s->creases, CREASES);
    return status == CREASE_OK ? target_check(context, s->report, TARGET_REPORT) : status;
}

static crease_status find_in_memory(
    crease_context *context, const settings *s, report *r, result *all)
{
    crease_cloud *cloud = NULL;
    crease_status status = input_read(context, s, r, &cloud);
    if (status == CREASE_OK)
        status = limit_check(context, s, crease_cloud_count(cloud), LIMIT_DETECT);
    if (status == CREASE_OK)
        status = find(context, s, r, cloud, all);
    crease_cloud_free(cloud);
    return status;
}

crease_status detect_run(crease_context *context, const settings *s, report *r)
{
    settings left = *s; /* to write */
    result all = {0};
    bool larger = false;
    crease_status status = check(context, s);
    if (status == CREASE_OK)
        status = limit_exceeded(context, s, LIMIT_DETECT, &larger);
    if (status == CREASE_OK)
        status = larger ? find_in_parts(context, s, r, &all, &left)
                        : find_in_memory(context, s, r, &all);
    if (status == CREASE_OK) {
        describe_regions(r, all.regions, all.outliers);
        all.of_regions = describe_each_region(r, all.regions);
        describe_fillets(r, all.regions);
        all.of_creases = describe_network(r, all.network);
        describe_features(r, s, &all);
        status = write_outputs(context, &left, r, &all);
    }
    result_free(&all);
    return status;
}
