/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "settings.h"

#include <string.h>

settings settings_default(void)
{
    const crease_context_options context = crease_context_options_default();
    return (settings){
        .threads = context.threads,
        .seed = context.seed,
        .read = crease_read_options_default(),
        .detect = crease_detect_options_default(),
        .detector = CREASE_DETECTOR_BOOTSTRAP,
        .features = FEATURES_CREASES,
        .regions = crease_regions_options_default(),
        .filter = crease_filter_options_default(),
        .method = METHOD_AUTOMATIC,
        .averaging = crease_averaging_options_default(),
        .sheet = crease_sheet_options_default(),
        .orientation = CREASE_ORIENTATION_AUTOMATIC,
        .noise = -1,
        .seeds = 100,
    };
}

void settings_resolve(settings *s)
{
    if (s->rotation_given)
        s->orientation = CREASE_ORIENTATION_GIVEN;
    s->averaging.orientation = s->sheet.orientation = (crease_orientation)s->orientation;
    memcpy(s->averaging.rotation, s->rotation, sizeof s->rotation);
    memcpy(s->sheet.rotation, s->rotation, sizeof s->rotation);
    s->regions.sigma = s->filter.sigma = s->sigma;
    s->detect.detector = (crease_detector)s->detector;
    s->averaging.detect = s->detect;
    if (s->net_given) {
        memcpy(s->averaging.net, s->net, sizeof s->net);
        memcpy(s->sheet.net, s->net, sizeof s->net);
    }
}
