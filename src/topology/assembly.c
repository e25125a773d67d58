/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/assembly.h"

#include "base/memory.h"
#include "crease/profile.h"
#include "crease/support.h"
#include "topology/alike.h"
#include "topology/bridge.h"
#include "topology/charts.h"
#include "topology/ends.h"
#include "topology/extend.h"
#include "topology/face.h"
#include "topology/lap.h"
#include "topology/loop.h"
#include "topology/missing.h"
#include "topology/overshoot.h"
#include "topology/relax.h"
#include "topology/rim.h"
#include "topology/seam.h"
#include "topology/tangency.h"
#include "topology/turn.h"
#include "topology/unseen.h"

#include <stdlib.h>

static const double LEAST_TURN = 0.1745329251994329577; /* 10 degrees: less is no crease */

static void free_models(crease_model *models, size_t count)
{
    for (size_t i = 0; models && i < count; i++)
        crease_model_clear(&models[i]);
    free(models);
}

static crease_status trace(
    crease_context *context, const crease_survey *survey, crease_chains *chains)
{
    crease_status status = crease_support_trace(context, survey, chains);
    if (status == CREASE_OK)
        status = crease_profile_prune(context, survey, chains);
    return status;
}

/* Finds the faces that no point shows; edges run around those that are regions already. */
static crease_status find_unseen(crease_graph *graph)
{
    crease_topology *const t = graph->topology;
    const crease_regions *const r = graph->survey->regions;
    crease_unseens unseens;
    crease_status status = crease_unseens_find(graph, &unseens);
    t->unseen = crease_allocate(graph->context, unseens.count, sizeof *t->unseen);
    if (status == CREASE_OK && !t->unseen)
        status = CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < unseens.count && status == CREASE_OK; i++) {
        t->unseen[t->unseen_count++] = unseens.items[i].plane;
        if (i < r->unseen_count)
            status = crease_unseen_border(
                graph, &unseens.items[i], (uint32_t)(r->region_count - r->unseen_count + i));
    }
    crease_unseens_clear(&unseens);
    return status;
}

/* What closes the faces where creases and seams do not. */
static crease_status close_gaps(crease_graph *graph, const crease_links *links, bool bordered)
{
    const crease_ground ground = crease_ground_of_models(graph);
    if (bordered)
        return crease_rims_add(graph, &ground);
    crease_status status = crease_overshoots_retract(graph);
    if (status == CREASE_OK)
        status = crease_bridges_build(graph, links);
    if (status == CREASE_OK)
        status = crease_laps_close(graph);
    if (status == CREASE_OK)
        status = crease_missing_find(graph, links);
    if (status == CREASE_OK)
        status = find_unseen(graph);
    return status == CREASE_OK ? crease_seams_relax(graph) : status;
}

/* Smooth edges from the vertices that creases lead to; then from those where only such edges meet.
 */
static crease_status find_seams(crease_graph *graph, const crease_links *links)
{
    crease_confluences confluences = {.count = 0};
    crease_status status = crease_seams_find(graph, links, NULL);
    if (status == CREASE_OK)
        status = crease_confluences_find(graph, links, &confluences);
    if (status == CREASE_OK && confluences.count > 0)
        status = crease_seams_find(graph, links, &confluences);
    crease_confluences_clear(&confluences);
    return status;
}

static crease_status make_edges(crease_graph *graph, crease_chains *chains, bool bordered)
{
    crease_junctions corners = {.count = 0};
    crease_links links = {.count = 0};
    crease_status status = crease_junctions_find(graph->context, graph->survey, chains, &corners);
    if (status == CREASE_OK)
        status = crease_graph_begin(graph, chains, &corners);
    crease_junctions_clear(&corners);
    if (status == CREASE_OK && !bordered)
        status = crease_ends_extend(graph);
    if (status == CREASE_OK)
        status = crease_ends_join(graph);
    if (status == CREASE_OK)
        status = crease_links_find(graph->context, graph->survey, &links);
    if (status == CREASE_OK)
        status = crease_seams_relocate(graph, &links);
    if (status == CREASE_OK)
        status = crease_ends_meet(graph);
    if (status == CREASE_OK) {
        crease_ends_prune(graph);
        status = find_seams(graph, &links);
    }
    if (status == CREASE_OK)
        status = close_gaps(graph, &links, bordered);
    if (status == CREASE_OK)
        status = crease_ends_dissolve(graph);
    crease_links_clear(&links);
    return status;
}

static crease_status make_faces(crease_graph *graph)
{
    int32_t *const seams =
        crease_allocate(graph->context, graph->topology->region_count, 2 * sizeof *seams);
    if (!seams)
        return CREASE_ERROR_NO_MEMORY;
    crease_status status = crease_charts_make(graph);
    if (status == CREASE_OK)
        status = crease_turns_cut(graph, seams);
    if (status == CREASE_OK)
        status = crease_ends_finish(graph);
    if (status == CREASE_OK)
        status = crease_faces_make(graph, seams);
    if (status == CREASE_OK)
        status = crease_charts_cover(graph);
    free(seams);
    return status;
}

/* Copies of the models, which tangency may change. */
static crease_model *copy_models(crease_context *context, const crease_regions *regions)
{
    crease_model *const out = crease_allocate(context, regions->region_count, sizeof *out);
    bool complete = out != NULL;
    for (size_t i = 0; i < regions->region_count && complete; i++)
        complete = crease_model_copy(context, &regions->models[i], &out[i]) == CREASE_OK;
    if (!complete)
        free_models(out, regions->region_count);
    return complete ? out : NULL;
}

static crease_status impose_tangency(
    crease_graph *graph, const crease_chains *chains, crease_model *models, bool *changed)
{
    const crease_junctions none = {.count = 0};
    crease_links links = {.count = 0};
    crease_status status = crease_graph_begin(graph, chains, &none);
    if (status == CREASE_OK)
        status = crease_links_find(graph->context, graph->survey, &links);
    if (status == CREASE_OK)
        status = crease_tangency_impose(graph, &links, models, changed);
    crease_links_clear(&links);
    crease_topology_clear_edges(graph->topology);
    return status;
}

static crease_status find(crease_context *context, const crease_survey *survey,
    crease_model *models, bool bordered, crease_topology *topology)
{
    crease_graph graph = {context, survey, topology};
    crease_chains chains = {.count = 0};
    bool changed = false;
    crease_status status = trace(context, survey, &chains);
    if (status == CREASE_OK)
        status = impose_tangency(&graph, &chains, models, &changed);
    if (status == CREASE_OK && changed) {
        crease_chains_clear(&chains);
        status = trace(context, survey, &chains);
    }
    if (status == CREASE_OK)
        status = make_edges(&graph, &chains, bordered);
    crease_chains_clear(&chains);
    if (status == CREASE_OK)
        status = make_faces(&graph);
    return status;
}

crease_status crease_topology_find(
    crease_context *context, const crease_regions *regions, bool bordered, crease_topology **out)
{
    crease_tree *tree = NULL;
    crease_regions view = *regions; /* with models and labels that may change */
    crease_topology *const topology = crease_topology_create(context, regions);
    view.models = topology ? copy_models(context, regions) : NULL;
    view.labels = crease_duplicate(context, regions->labels, regions->count, sizeof *view.labels);
    *out = NULL;
    crease_stage(context, "topology");
    crease_status status = view.models && view.labels ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_tree_create(context, regions->points, regions->count, &tree);
    if (status == CREASE_OK) {
        const crease_survey survey = {.regions = &view,
            .tree = tree,
            .spacing = regions->noise->spacing,
            .sigma = regions->sigma,
            .least_bend = LEAST_TURN};
        status = crease_alikes_join(context, &survey, view.labels);
        if (status == CREASE_OK)
            status = find(context, &survey, view.models, bordered, topology);
    }
    crease_tree_free(tree);
    free_models(view.models, regions->region_count);
    free(view.labels);
    if (status == CREASE_OK)
        *out = topology;
    else
        crease_topology_free(topology);
    return status;
}
