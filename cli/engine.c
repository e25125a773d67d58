/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "engine.h"

int engine_main(int count, char **arguments, int (*program)(int count, char **arguments))
{
    return program(count, arguments);
}

crease_status engine_begin(crease_context *context, int threads)
{
    (void)context, (void)threads;
    return CREASE_OK;
}

void engine_end(crease_status status)
{
    (void)status;
}

crease_status engine_scores(crease_context *context, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out)
{
    return crease_scores_compute(context, cloud, options, out);
}

crease_status engine_regions(crease_context *context, const crease_cloud *cloud,
    const crease_regions_options *options, crease_regions **out)
{
    return crease_regions_find(context, cloud, options, out);
}
