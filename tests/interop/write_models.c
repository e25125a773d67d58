/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Writes STEP files of known models into a folder: NAME.FACES-SHARED-CLOSED.step. */
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
    return count == 2 ? 0 : 2;
}
