/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/straight.h"

#include "averaging/orient.h"
#include "base/vector.h"

enum { STATIONS = 65 };

static const double BEND = 0.15;  /* of the spacing: as much a straight crease may seem to bend */
static const double TURN = 0.035; /* sine of the angle that parallel creases may seem to have */

/* Direction of a crease seen along z; false when it bends. */
static bool follow(const crease_frame *frame, const crease_curve *curve,
    const crease_network_crease *crease, double spacing, double direction[2])
{
    double domain[2], p[STATIONS][3], most = 0.0;
    crease_curve_domain(curve, domain);
    for (int i = 0; i < STATIONS; i++)
        crease_curve_evaluate(curve, domain[0] + (domain[1] - domain[0]) * i / (STATIONS - 1),
            CREASE_SIDE_RIGHT, 0, p[i]);
    crease_frame_enter(frame, p[0], STATIONS, p[0]);
    const double x = p[STATIONS - 1][0] - p[0][0], y = p[STATIONS - 1][1] - p[0][1];
    const double length = hypot(x, y);
    if (crease->closed || !(length > 0.0))
        return false;
    direction[0] = x / length;
    direction[1] = y / length;
    for (int i = 0; i < STATIONS; i++)
        most = fmax(
            most, fabs(direction[0] * (p[i][1] - p[0][1]) - direction[1] * (p[i][0] - p[0][0])));
    return most < fmax(BEND * spacing, 4.0 * crease->position_error);
}

crease_status crease_straight(crease_context *context, const crease_cloud *cloud,
    const crease_network *network, bool *straight)
{
    crease_oriented oriented;
    double first[2] = {0.0, 0.0};
    const double spacing = crease_network_spacing(network);
    crease_status status = crease_sheet_suits(context, cloud, straight);
    if (status == CREASE_OK && *straight)
        status = crease_orient_find(
            context, crease_cloud_points(cloud), crease_cloud_count(cloud), &oriented);
    for (size_t i = 0; i < crease_network_count(network) && status == CREASE_OK && *straight; i++) {
        const crease_network_crease crease = crease_network_at(network, i);
        double now[2] = {0.0, 0.0};
        *straight =
            follow(&oriented.frame, crease_network_curves(network)[i], &crease, spacing, now);
        if (i == 0) {
            first[0] = now[0];
            first[1] = now[1];
        } else if (*straight) {
            const double sine = fabs(first[0] * now[1] - first[1] * now[0]);
            const double cosine = fabs(first[0] * now[0] + first[1] * now[1]);
            const double slack = TURN + 4.0 * crease.position_error / crease.length;
            *straight = fmin(sine, cosine) < slack;
        }
    }
    return status;
}
