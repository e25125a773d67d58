/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "engine.h"

int engine_main(int count, char **arguments, int (*program)(int count, char **arguments))
{
    return program(count, arguments);
}

crease_status engine_begin(crease_context *context, const settings *s)
{
    (void)context, (void)s;
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

crease_status engine_detect_stream(crease_context *context, const char *input,
    const crease_stream_options *options, const char *output, crease_stream_summary *summary,
    crease_regions **regions, crease_network **network)
{
    return crease_detect_stream(context, input, options, output, summary, regions, network);
}

crease_status engine_fit_stream(crease_context *context, const char *input,
    const crease_fit_stream_options *options, crease_fit_stream_summary *summary,
    crease_cloud **sample, crease_sheet **out)
{
    return crease_sheet_fit_stream(context, input, options, summary, sample, out);
}
