/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Writes STEP files of known models into a folder: NAME.FACES-SHARED-CLOSED.step; and curves that
 * meet in corners, with places on them: NAME.EDGES-VERTICES.step and NAME.EDGES-VERTICES.txt. */
#include "given_surfaces.h"

#include "crease/crease_cad.h"

static void write_wedge(model *m)
{
    add_wedge(m, 1.0, (double[]){0, 0, 0}, 3);
}

static void write_box(model *m)
{
    add_box(m, 2.0, (double[]){1e3, 0, 0});
}

static void write_rows(model *m)
{
    add_repeated_rows(m, 1, 0.1);
}

static void write_tube(model *m)
{
    add_tube(m, 0);
}

static void write_tips(model *m)
{
    add_tube(m, 3);
}

static void write_apart(model *m)
{
    add_box(m, 1.0, (double[]){0, 0, 0});
    add_wedge(m, 1.0, (double[]){5, 0, 0}, 0);
}

enum { SPOKES = 5, POINTS = 9, PLACES = 101 };

/* Curves of order 4 from the middle to a rim, with parameters from 0 to more than 1. */
static crease_curve *spoke(crease_context *context, int i)
{
    double knots[POINTS + 4], points[POINTS][3];
    crease_curve *out = NULL;
    for (int k = 0; k < POINTS + 4; k++)
        knots[k] = (1 + 0.7 * i) * (k < 4 ? 0 : k < POINTS ? k - 3 - 0.2 * (k % 3) : POINTS - 3);
    for (int k = 0; k < POINTS; k++) {
        const double away = k / (POINTS - 1.0), turn = i + 0.3 * sin(3 * away);
        points[k][0] = 1.0 / 3 + 20 * away * cos(turn);
        points[k][1] = 1e-5 / 7 + 20 * away * sin(turn);
        points[k][2] = away * (1 - away) * i;
    }
    assert_int_equal(
        crease_curve_create(context, 4, POINTS, knots, &points[0][0], &out), CREASE_OK);
    return out;
}

static void write_places(const char *path, const crease_curve *const *curves)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int i = 0; i < SPOKES; i++)
        for (int k = 0; k < PLACES; k++) {
            double domain[2], p[3];
            const double part = k / (PLACES - 1.0);
            crease_curve_domain(curves[i], domain);
            crease_curve_evaluate(
                curves[i], domain[0] + part * (domain[1] - domain[0]), CREASE_SIDE_LEFT, 0, p);
            fprintf(file, "%d %.17g %.17g %.17g %.17g\n", i, part, p[0], p[1], p[2]);
        }
    assert_int_equal(fclose(file), 0);
}

static void write_spokes(const char *folder)
{
    char path[1024], places[1024];
    crease_context *context = given_context();
    crease_curve *curves[SPOKES];
    for (int i = 0; i < SPOKES; i++)
        curves[i] = spoke(context, i);
    snprintf(path, sizeof path, "%s/spokes.%d-%d.step", folder, SPOKES, SPOKES + 1);
    snprintf(places, sizeof places, "%s/spokes.%d-%d.txt", folder, SPOKES, SPOKES + 1);
    const crease_curve *const *all = (const crease_curve *const *)curves;
    assert_int_equal(crease_cad_curves_write(context, all, SPOKES, path), CREASE_OK);
    write_places(places, all);
    for (int i = 0; i < SPOKES; i++)
        crease_curve_free(curves[i]);
    crease_context_free(context);
}

int main(int count, char **arguments)
{
    static const struct {
        const char *name;
        void (*add)(model *m);
    } models[] = {{"wedge.2-1-0", write_wedge}, {"box.6-12-1", write_box},
        {"rows.2-1-0", write_rows}, {"tube.1-1-0", write_tube}, {"tips.1-0-1", write_tips},
        {"apart.8-13-1", write_apart}};
    for (size_t i = 0; count == 2 && i < sizeof models / sizeof models[0]; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s.step", arguments[1], models[i].name);
        model m = given_model();
        models[i].add(&m);
        const crease_status status =
            crease_cad_write(m.context, (const crease_surface *const *)m.surfaces, m.count, path);
        if (status != CREASE_OK) {
            fprintf(stderr, "%s\n", crease_context_message(m.context));
            return 1;
        }
        free_model(&m);
    }
    if (count == 2)
        write_spokes(arguments[1]);
    return count == 2 ? 0 : 2;
}
