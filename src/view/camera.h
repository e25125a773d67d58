/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A parallel projection with equal scales on all axes: what a figure measures is not foreshortened
 * by distance. On the drawing x goes right, y down, and depth away from the eye, all in the units
 * of the drawing, so that a depth can be compared with the radius of a dot. */
#ifndef CREASE_VIEW_CAMERA_H
#define CREASE_VIEW_CAMERA_H

typedef struct crease_camera {
    double right[3], up[3]; /* unit vectors of the drawing in space */
    double eye[3];          /* unit vector towards the eye */
    double centre[3];       /* the place in space that falls on x, y, at depth 0 */
    double scale;           /* units of the drawing per unit of length */
    double x, y;
} crease_camera;

typedef struct crease_spot {
    double x, y, depth;
} crease_spot;

/* A camera of scale 1 that looks at the centre; angles in degrees. */
crease_camera crease_camera_at(double azimuth, double elevation, const double centre[3]);
crease_spot crease_camera_project(const crease_camera *camera, const double point[3]);

#endif
