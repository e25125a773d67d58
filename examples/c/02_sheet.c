/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* usage: 02_sheet SHEET.step
 * Fits one creased sheet to points that this program has in memory, and writes its faces. */
#include <crease/crease_cad.h>
#include <math.h>
#include <stdio.h>

enum { SIDE = 41 };

/* A roof over 10 x 10 whose ridge runs along the diagonal. */
static void sample(double points[SIDE * SIDE][3])
{
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++) {
            double *point = points[SIDE * i + j];
            point[0] = 10.0 * i / (SIDE - 1);
            point[1] = 10.0 * j / (SIDE - 1);
            point[2] = 5 - 0.5 * fabs(point[0] - point[1]);
        }
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: 02_sheet SHEET.step\n", stderr);
        return 2;
    }
    static double points[SIDE * SIDE][3];
    sample(points);
    crease_cloud_parts parts = {.count = SIDE * SIDE, .points = points[0]};
    crease_context *context = NULL;
    crease_cloud *cloud = NULL;
    crease_sheet *sheet = NULL;
    crease_surface **faces = NULL;
    size_t count = 0;
    if (crease_context_create(NULL, &context) != CREASE_OK) {
        fputs("no memory\n", stderr);
        return 1;
    }
    int failed = crease_cloud_create(context, &parts, &cloud) != CREASE_OK ||
        crease_sheet_fit(context, cloud, NULL, &sheet) != CREASE_OK ||
        crease_sheet_faces(context, sheet, &faces, &count) != CREASE_OK ||
        crease_cad_write(context, (const crease_surface *const *)faces, count, argv[1]) !=
            CREASE_OK;
    if (failed)
        fprintf(stderr, "%s\n", crease_context_message(context));
    else
        printf("%zu faces, %zu crease of %.2f degrees\n", count, crease_sheet_line_count(sheet),
            crease_sheet_line(sheet, 0).angle);
    crease_surfaces_free(faces, count);
    crease_sheet_free(sheet);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return failed;
}
