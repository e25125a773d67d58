/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/crossing.h"

#include "base/symmetric.h"
#include "base/vector.h"
#include "topology/contact.h"

#include <math.h>
#include <string.h>

enum { ROUNDS = 12, LEAST_LINKS = 3 };

/* In spacings. */
static const double AROUND = 4.0;  /* links that tell a line */
static const double ON_LINE = 2.5; /* from links to the line of contact */
static const double STILL = 0.05;  /* what a place moves by where the surfaces tell it */
static const double MOVE = 4.5;    /* at most, from the first place */

static const double ALONG = 0.6; /* cosine between a line of contact and its links */
static const double LINKS_WEIGHT = 0.3, STAY = 0.1; /* against lines of contact */
static const double HARDLY = 1e-6; /* the weight of the first place where the surfaces tell */

/* A line that a vertex is on. */
struct line {
    double on[3], along[3], weight;
};

/* The line along which two surfaces touch beside a place. */
static bool line_of_contact(
    const crease_graph *graph, const crease_loose *loose, const double place[3], struct line *out)
{
    const double s = graph->survey->spacing;
    const crease_model *const all = graph->survey->regions->models;
    const crease_model *const models[2] = {&all[loose->regions[0]], &all[loose->regions[1]]};
    out->weight = 1.0;
    memcpy(out->on, place, sizeof out->on);
    return crease_contact_direction(models, out->on, s, out->along) &&
        crease_contact_place(models, out->along, s, out->on) &&
        crease_vector_distance(out->on, place) < MOVE * s;
}

/* That of two regions where their links are, or, where it is not there, the line of the links
 * beside the first place. False without links. */
static bool line_of_links(const crease_graph *graph, const crease_loose *loose,
    const double first[3], const double place[3], struct line *out)
{
    const double s = graph->survey->spacing;
    double mean[3], by_links[3], link[3], away;
    if (crease_loose_direction(loose, first, AROUND * s, mean, by_links) < LEAST_LINKS)
        return false;
    if (line_of_contact(graph, loose, place, out) &&
        fabs(crease_vector_dot(out->along, by_links)) > ALONG &&
        crease_loose_nearest(loose, out->on, ON_LINE * s, &away, link))
        return true;
    out->weight = LINKS_WEIGHT;
    memcpy(out->on, mean, sizeof mean);
    memcpy(out->along, by_links, sizeof by_links);
    return true;
}

/* Moves a place to where the lines cross: least squares of the distances from all of them, and,
 * with little weight, from the first place. False where surfaces are asked and one does not tell.
 */
static bool cross_lines(const crease_graph *graph, const crease_loose *const pairs[], size_t count,
    bool by_links, const double first[3], double place[3])
{
    const double stay = by_links ? STAY : HARDLY;
    double matrix[9] = {stay, 0.0, 0.0, 0.0, stay, 0.0, 0.0, 0.0, stay};
    double right[3] = {stay * first[0], stay * first[1], stay * first[2]};
    for (size_t i = 0; i < count; i++) {
        struct line line;
        if (by_links ? !line_of_links(graph, pairs[i], first, place, &line)
                     : !line_of_contact(graph, pairs[i], place, &line)) {
            if (by_links)
                continue;
            return false;
        }
        const double ahead = crease_vector_dot(line.on, line.along);
        for (int r = 0; r < 3; r++) {
            right[r] += line.weight * (line.on[r] - ahead * line.along[r]);
            for (int c = 0; c < 3; c++)
                matrix[3 * r + c] +=
                    line.weight * ((r == c ? 1.0 : 0.0) - line.along[r] * line.along[c]);
        }
    }
    if (!crease_symmetric_factor(matrix, 3, 3, 2))
        return false;
    crease_symmetric_solve(matrix, 3, 3, 2, right);
    memcpy(place, right, sizeof right);
    return true;
}

/* Follows the lines to where they cross; false when that does not come to an end near by. */
static bool follow_lines(const crease_graph *graph, const crease_loose *const pairs[], size_t count,
    bool by_links, double place[3])
{
    const double s = graph->survey->spacing;
    double to[3] = {place[0], place[1], place[2]}, moved = INFINITY;
    for (int i = 0; i < ROUNDS; i++) {
        const double before[3] = {to[0], to[1], to[2]};
        if (!cross_lines(graph, pairs, count, by_links, place, to))
            return false;
        moved = crease_vector_distance(before, to);
    }
    if (!(moved < (by_links ? MOVE : STILL) * s && crease_vector_distance(place, to) < MOVE * s))
        return false;
    memcpy(place, to, sizeof to);
    return true;
}

void crease_crossing_find(
    const crease_graph *graph, const crease_loose *const pairs[], size_t count, double place[3])
{
    if (!follow_lines(graph, pairs, count, false, place))
        follow_lines(graph, pairs, count, true, place);
}
