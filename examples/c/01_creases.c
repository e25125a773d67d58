/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* usage: 01_creases CLOUD CREASES.csv
 * Finds the sharp edges of a cloud and prints them. */
#include <crease/crease.h>
#include <stdio.h>

static void print(const crease_network *network)
{
    for (size_t i = 0; i < crease_network_count(network); i++) {
        crease_network_crease crease = crease_network_at(network, i);
        printf("regions %u and %u: %.4g long, %.1f +- %.1f degrees, placed to %.2g%s\n",
            (unsigned)crease.regions[0], (unsigned)crease.regions[1], crease.length, crease.angle,
            crease.angle_error, crease.position_error, crease.closed ? ", closed" : "");
    }
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fputs("usage: 01_creases CLOUD CREASES.csv\n", stderr);
        return 2;
    }
    crease_context *context = NULL;
    crease_cloud *cloud = NULL;
    crease_regions *regions = NULL;
    crease_network *network = NULL;
    if (crease_context_create(NULL, &context) != CREASE_OK) {
        fputs("no memory\n", stderr);
        return 1;
    }
    /* Each call needs what the one before has made; the first that fails says why. */
    int failed = crease_cloud_read(context, argv[1], NULL, &cloud) != CREASE_OK ||
        crease_regions_find(context, cloud, NULL, &regions) != CREASE_OK ||
        crease_network_find(context, regions, NULL, &network) != CREASE_OK ||
        crease_network_write(context, network, argv[2]) != CREASE_OK;
    if (failed)
        fprintf(stderr, "%s\n", crease_context_message(context));
    else
        print(network);
    crease_network_free(network);
    crease_regions_free(regions);
    crease_cloud_free(cloud);
    crease_context_free(context);
    return failed;
}
