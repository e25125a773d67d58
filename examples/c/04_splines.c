/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* usage: 04_splines SHEET.glb
 * A surface of one's own with a sharp edge: a knot of multiplicity 3 in a bicubic net. Cuts it
 * there, finds the nearest place of it to a point, and writes triangles. */
#include <crease/crease.h>
#include <stdio.h>

enum { ROWS = 7, COLUMNS = 4 };

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: 04_splines SHEET.glb\n", stderr);
        return 2;
    }
    const double u[ROWS + 4] = {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2};
    const double v[COLUMNS + 4] = {0, 0, 0, 0, 1, 1, 1, 1};
    const double height[ROWS] = {0, 1, 2, 3, 2, 1, 0}; /* up, and down again */
    double net[ROWS][COLUMNS][3];
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            net[i][j][0] = i;
            net[i][j][1] = j;
            net[i][j][2] = height[i];
        }
    crease_surface_parts parts = {
        .order = {4, 4}, .count = {ROWS, COLUMNS}, .knots = {u, v}, .control_points = net[0][0]};
    crease_context *context = NULL;
    crease_surface *surface = NULL, *lower = NULL, *upper = NULL;
    crease_mesh *mesh = NULL;
    crease_foot foot;
    const double point[3] = {3, 1.5, 4};
    if (crease_context_create(NULL, &context) != CREASE_OK) {
        fputs("no memory\n", stderr);
        return 1;
    }
    int failed = crease_surface_create(context, &parts, &surface) != CREASE_OK ||
        crease_surface_split(context, surface, 0, 1, &lower, &upper) != CREASE_OK ||
        crease_surface_project(context, surface, point, 1, &foot) != CREASE_OK;
    if (!failed) {
        const crease_surface *halves[2] = {lower, upper};
        failed = crease_mesh_create(context, halves, 2, 0, &mesh) != CREASE_OK ||
            crease_mesh_write(context, mesh, argv[1]) != CREASE_OK;
    }
    if (failed)
        fprintf(stderr, "%s\n", crease_context_message(context));
    else
        printf("multiplicity %d at u = 1; the point is %.6f above the edge\n",
            crease_surface_multiplicity(surface, 0, 1), foot.distance);
    crease_mesh_free(mesh);
    crease_surface_free(upper);
    crease_surface_free(lower);
    crease_surface_free(surface);
    crease_context_free(context);
    return failed;
}
