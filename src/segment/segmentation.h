/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The work in progress of finding regions: labels and models, changed by the stages in turn until
 * nothing changes any more. Points are positions in Morton order. */
#ifndef CREASE_SEGMENT_SEGMENTATION_H
#define CREASE_SEGMENT_SEGMENTATION_H

#include "noise/noise.h"
#include "primitive/fitter.h"
#include "primitive/model.h"

#include <stdatomic.h>

enum {
    CREASE_NO_LABEL = -1,
    CREASE_LINKS = 10,      /* neighbours whose labels a point's label depends on */
    CREASE_BORDER_LINKS = 8 /* neighbours by which regions are next to each other */
};

/* Squared residual in sigma beyond which a point is an outlier to a model, whatever the distance.
 */
static const double CREASE_RESIDUAL_CUT = 12.0;
/* Price of a link between different labels, in units of -log likelihood. */
static const double CREASE_LINK_PRICE = 0.5;

typedef struct crease_segmentation {
    crease_context *context;
    size_t count;
    const double *points;
    const uint32_t *neighbours; /* count x stride, the point itself first */
    size_t stride;
    int links, border_links; /* CREASE_LINKS and CREASE_BORDER_LINKS, or all there are */
    const crease_noise *noise;
    double sigma; /* what a residual is weighed by: the noise, times the root of `alike` */
    double alike; /* neighbouring points that err as if they were one: their squared residuals
                     together say no more than one of them */
    double spacing;
    double least_cosine; /* of the angle between a point's normal and its region's */
    size_t least_points; /* of a region */
    int32_t *labels;
    size_t region_count, room;
    crease_model *models;
    size_t *tried;     /* size of each region when other explanations were last sought in vain */
    uint32_t *members; /* all labelled points, region by region, ascending */
    size_t *first;     /* region_count + 1: where each region's members begin */
    bool known_sigma;  /* not to be measured again */
    crease_fitter *fitters; /* one for each thread */
    atomic_bool no_memory;  /* an allocation failed inside a parallel loop */
} crease_segmentation;

static inline size_t crease_segmentation_size(const crease_segmentation *seg, size_t region)
{
    return seg->first[region + 1] - seg->first[region];
}

static inline const uint32_t *crease_segmentation_near(const crease_segmentation *seg, size_t point)
{
    return seg->neighbours + point * seg->stride;
}

/* Half the squared residual in sigma, cut, and a price for a normal that is not the model's: -log
 * likelihood of the point on the model. */
double crease_segmentation_price(
    const crease_segmentation *seg, const crease_model *model, size_t point);
/* Adds a point to a sample, its normal on the side of the given one. */
void crease_segmentation_sample(
    const crease_segmentation *seg, size_t point, const double side[3], crease_sample *sample);
/* Fills the sample with at most `most` of the points, evenly; normals on the side of the model's
 * gradient, or, without a model, of the first point's normal. */
void crease_segmentation_sample_points(const crease_segmentation *seg, const uint32_t *points,
    size_t count, size_t most, const crease_model *model, crease_sample *sample);

/* Appends a region without members; takes the model over. */
crease_status crease_segmentation_add(crease_segmentation *seg, const crease_model *model);
/* Replaces a region's model; takes the new one over. */
void crease_segmentation_replace(
    crease_segmentation *seg, size_t region, const crease_model *model);
/* Lists the members by the labels. */
crease_status crease_segmentation_list(crease_segmentation *seg);
/* Removes regions without members and numbers the rest anew, in order. Lists must be up to date and
 * are so afterwards. */
void crease_segmentation_compact(crease_segmentation *seg);
/* crease_parallel_for, with a failed allocation inside turned into a status. */
crease_status crease_segmentation_parallel(crease_segmentation *seg, size_t count, size_t grain,
    void (*body)(void *user, size_t begin, size_t end, int worker), void *user);

/* ----------------------------------------------------------------------------------- stages -- */

/* Grows new regions from smooth points that no region explains. */
crease_status crease_grow(crease_segmentation *seg);
/* Joins neighbouring regions that one model explains, looking at `sample` points of each; regions
 * with more than `large` points only when their models agree at the border. *merged: how many were
 * joined away. */
crease_status crease_merge(crease_segmentation *seg, size_t sample, size_t large, size_t *merged);
/* Joins neighbouring regions on each of which one simple model leaves a mean square residual within
 * the tolerance, in square sigmas. */
crease_status crease_merge_within(crease_segmentation *seg, size_t sample, double tolerance);
/* Gives every point the label that its distances and its neighbours favour. *changed: labels. */
crease_status crease_relabel(crease_segmentation *seg, int rounds, size_t *changed);
/* Fits the models to their regions' interiors again. */
crease_status crease_refit(crease_segmentation *seg, size_t sample, bool keep_kinds);
/* Fits the free forms of large regions, when the labels stand, as closely as can be to all points
 * that are certain. */
crease_status crease_refit_closely(crease_segmentation *seg);
/* Looks for other surfaces that explain a region and its surroundings better, or for two of them.
 */
crease_status crease_reconsider(crease_segmentation *seg, size_t *changed);
/* Gives up regions whose points their neighbours explain nearly as well, and those too small. */
crease_status crease_give_up(crease_segmentation *seg, size_t *dropped);
/* Joins regions that meet without an angle where one free form explains both to the noise: of any
 * kind, or, unless wide, pieces of free forms and what the description is shorter without.
 * *united: how many were joined away. */
crease_status crease_unite(crease_segmentation *seg, bool wide, size_t *united);
/* Estimates sigma again, from residuals deep inside regions. */
crease_status crease_measure_noise(crease_segmentation *seg);

/* All of these in turn, until nothing changes. */
crease_status crease_rounds_run(crease_segmentation *seg);
/* Unites pieces of one smooth surface, wide: all that join without an angle, and fits again. */
crease_status crease_rounds_unite(crease_segmentation *seg, bool wide);

#endif
