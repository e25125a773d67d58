/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/straight.h"

#include "averaging/orient.h"
#include "base/vector.h"

#include <math.h>
#include <string.h>

enum { STATIONS = 65 };

/* Of the spacing: as much a straight crease may seem to bend, or a nearly straight one. */
static const double BEND[2] = {0.15, 1.5};
/* Sine of the angle that parallel creases may seem to have. */
static const double TURN[2] = {0.035, 0.1};
static const double ERRORS = 4.0; /* standard errors */

/* A crease seen along z. */
typedef struct sight {
    double direction[2], bend, length;
    double places[STATIONS][3]; /* in the cloud's coordinates */
} sight;

/* False when nothing is seen but a point. */
static bool look(const crease_frame *frame, const crease_curve *curve, sight *out)
{
    double domain[2], p[STATIONS][3];
    crease_curve_domain(curve, domain);
    for (int i = 0; i < STATIONS; i++)
        crease_curve_evaluate(curve, domain[0] + (domain[1] - domain[0]) * i / (STATIONS - 1),
            CREASE_SIDE_RIGHT, 0, out->places[i]);
    crease_frame_enter(frame, out->places[0], STATIONS, p[0]);
    const double x = p[STATIONS - 1][0] - p[0][0], y = p[STATIONS - 1][1] - p[0][1];
    out->length = hypot(x, y);
    if (!(out->length > 0.0))
        return false;
    out->direction[0] = x / out->length;
    out->direction[1] = y / out->length;
    out->bend = 0.0;
    for (int i = 0; i < STATIONS; i++)
        out->bend = fmax(out->bend,
            fabs(
                out->direction[0] * (p[i][1] - p[0][1]) - out->direction[1] * (p[i][0] - p[0][0])));
    return true;
}

/* Sine of the angle between two directions, or to the right angle. */
static double askew(const double a[2], const double b[2])
{
    return fmin(fabs(a[0] * b[1] - a[1] * b[0]), fabs(a[0] * b[0] + a[1] * b[1]));
}

/* The longest crease as a line. */
static void take_longest(
    const crease_network *network, const crease_frame *frame, crease_straightness *out)
{
    double longest = 0.0;
    for (size_t i = 0; i < crease_network_count(network); i++) {
        sight now;
        if (!look(frame, crease_network_curves(network)[i], &now) || !(now.length > longest))
            continue;
        longest = now.length;
        for (size_t c = 0; c < 3; c++) {
            out->point[c] = now.places[STATIONS / 2][c];
            out->direction[c] = now.places[STATIONS - 1][c] - now.places[0][c];
        }
    }
    crease_vector_normalise(out->direction);
}

/* Tips of creases on a line that lie farthest before and behind its point. */
typedef struct extent {
    double from, to, first[3], last[3];
} extent;

static void extend(extent *e, const crease_straightness *line, const double tip[3], double near)
{
    double off[3];
    for (size_t c = 0; c < 3; c++)
        off[c] = tip[c] - line->point[c];
    const double t = crease_vector_dot(off, line->direction);
    if (!(crease_vector_dot(off, off) - t * t < near * near))
        return;
    if (t < e->from) {
        e->from = t;
        memcpy(e->first, tip, sizeof e->first);
    }
    if (t > e->to) {
        e->to = t;
        memcpy(e->last, tip, sizeof e->last);
    }
}

/* The line through the longest crease, and through those that go on from it. */
static void take_line(
    const crease_network *network, const crease_frame *frame, crease_straightness *out)
{
    const double near = BEND[1] * crease_network_spacing(network);
    extent e = {.from = 0.0};
    take_longest(network, frame, out);
    for (size_t i = 0; i < crease_network_count(network); i++) {
        sight now;
        if (!look(frame, crease_network_curves(network)[i], &now))
            continue;
        extend(&e, out, now.places[0], near);
        extend(&e, out, now.places[STATIONS - 1], near);
    }
    if (!(e.from < e.to))
        return;
    for (size_t c = 0; c < 3; c++)
        out->direction[c] = e.last[c] - e.first[c];
    crease_vector_normalise(out->direction);
}

static void compare(
    const crease_frame *frame, const crease_network *network, crease_straightness *out)
{
    const double spacing = crease_network_spacing(network);
    double first[2] = {0.0, 0.0};
    bool *const fits[2] = {&out->straight, &out->nearly};
    for (size_t i = 0; i < crease_network_count(network) && out->nearly; i++) {
        const crease_network_crease crease = crease_network_at(network, i);
        sight now;
        if (crease.closed || !look(frame, crease_network_curves(network)[i], &now)) {
            out->straight = out->nearly = false;
            return;
        }
        for (int k = 0; k < 2; k++) {
            const double bend = fmax(BEND[k] * spacing, ERRORS * crease.position_error);
            const double turn = TURN[k] + ERRORS * crease.position_error / crease.length;
            if (!(now.bend < bend) || (i > 0 && !(askew(first, now.direction) < turn)))
                *fits[k] = false;
        }
        if (i == 0)
            memcpy(first, now.direction, sizeof first);
    }
}

crease_status crease_straight(crease_context *context, const crease_cloud *cloud,
    const crease_network *network, crease_straightness *out)
{
    crease_oriented oriented;
    bool suits;
    *out = (crease_straightness){.straight = false};
    crease_status status = crease_sheet_suits(context, cloud, &suits);
    if (status != CREASE_OK || !suits)
        return status;
    status = crease_orient_find(
        context, crease_cloud_points(cloud), crease_cloud_count(cloud), &oriented);
    out->straight = out->nearly = status == CREASE_OK;
    if (status == CREASE_OK)
        compare(&oriented.frame, network, out);
    if (out->nearly)
        take_line(network, &oriented.frame, out);
    return status;
}
