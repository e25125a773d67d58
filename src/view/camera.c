/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/camera.h"

#include "base/vector.h"

#include <math.h>
#include <string.h>

crease_camera crease_camera_at(double azimuth, double elevation, const double centre[3])
{
    const double degree = 3.14159265358979323846 / 180;
    const double ca = cos(azimuth * degree), sa = sin(azimuth * degree);
    const double ce = cos(elevation * degree), se = sin(elevation * degree);
    crease_camera camera = {.right = {-sa, ca, 0},
        .up = {-se * ca, -se * sa, ce},
        .eye = {ce * ca, ce * sa, se},
        .scale = 1};
    memcpy(camera.centre, centre, sizeof camera.centre);
    return camera;
}

crease_spot crease_camera_project(const crease_camera *camera, const double point[3])
{
    const double *c = camera->centre;
    const double from[3] = {point[0] - c[0], point[1] - c[1], point[2] - c[2]};
    return (crease_spot){camera->x + camera->scale * crease_vector_dot(camera->right, from),
        camera->y - camera->scale * crease_vector_dot(camera->up, from),
        -camera->scale * crease_vector_dot(camera->eye, from)};
}
