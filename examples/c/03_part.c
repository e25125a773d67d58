/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* usage: 03_part CLOUD PART.step
 * Turns the scan of a whole part into a CAD model, shows progress, and stops cleanly on Ctrl-C. */
#include <crease/crease_cad.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

static volatile sig_atomic_t interrupted;

static void interrupt(int number)
{
    (void)number;
    interrupted = 1;
}

/* One line for each stage. user: the name of the stage last told. */
static void tell(void *user, const char *stage, double fraction)
{
    const char **last = user;
    (void)fraction;
    if (strcmp(*last, stage) != 0)
        fprintf(stderr, "%s ...\n", stage);
    *last = stage;
}

static int is_interrupted(void *user)
{
    (void)user;
    return interrupted;
}

static void report(const crease_part *part)
{
    const char *states[] = {"closed solid", "open shell", "loose faces"};
    printf("%s, volume %.6g\n", states[crease_part_state_of(part)], crease_part_volume(part));
    for (size_t i = 0; i < crease_part_face_count(part); i++) {
        crease_part_face face = crease_part_face_at(part, i);
        printf("face %zu: %zu points, rms %.3g, worst %.3g\n", i, face.point_count, face.rms,
            face.most);
    }
    if (*crease_part_message(part))
        puts(crease_part_message(part));
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fputs("usage: 03_part CLOUD PART.step\n", stderr);
        return 2;
    }
    const char *stage = "";
    signal(SIGINT, interrupt);
    crease_context_options options = crease_context_options_default();
    options.progress = tell;
    options.cancelled = is_interrupted;
    options.user = &stage;
    crease_context *context = NULL;
    crease_cloud *cloud = NULL;
    crease_regions *regions = NULL;
    crease_network *network = NULL;
    crease_part *part = NULL;
    if (crease_context_create(&options, &context) != CREASE_OK) {
        fputs("no memory\n", stderr);
        return 1;
    }
    int failed = crease_cloud_read(context, argv[1], NULL, &cloud) != CREASE_OK ||
        crease_regions_find(context, cloud, NULL, &regions) != CREASE_OK ||
        crease_network_find(context, regions, NULL, &network) != CREASE_OK ||
        crease_part_build(context, cloud, regions, network, NULL, &part) != CREASE_OK ||
        crease_part_write(context, part, argv[2]) != CREASE_OK;
    if (failed)
        fprintf(stderr, "%s\n", crease_context_message(context));
    else
        report(part);
    crease_part_free(part);
    crease_network_free(network);
    crease_regions_free(regions);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return failed;
}
