/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease filter: less noise, edges kept, outliers set aside. */
#include "command.h"
#include "input.h"
#include "outputs.h"

enum { ALLOWED = TARGET_CLOUD | TARGET_FIGURE | TARGET_PAGE | TARGET_REPORT };

static void describe(report *r, const settings *s, const crease_filtered *filtered)
{
    const size_t outliers = crease_filtered_outlier_count(filtered);
    const double spacing = crease_filtered_spacing(filtered);
    cJSON_AddNumberToObject(r->root, "outliers", (double)outliers);
    cJSON_AddNumberToObject(r->root, "spacing", spacing);
    cJSON_AddNumberToObject(r->root, "noise_before", crease_filtered_sigma(filtered));
    cJSON_AddNumberToObject(r->root, "noise_after", crease_filtered_sigma_after(filtered));
    cJSON_AddNumberToObject(r->root, "movement", crease_filtered_movement(filtered));
    report_line(r, "outliers: %zu, %s", outliers,
        s->filter.remove_outliers ? "left out" : "marked in the field `outlier`");
    report_line(r, "noise %.2g before, %.2g after; moved by %.2g (rms); spacing %.4g",
        crease_filtered_sigma(filtered), crease_filtered_sigma_after(filtered),
        crease_filtered_movement(filtered), spacing);
}

crease_status filter_run(crease_context *context, const settings *s, report *r)
{
    crease_cloud *cloud = NULL;
    crease_filtered *filtered = NULL;
    crease_status status = targets_check(context, s, ALLOWED);
    if (status == CREASE_OK)
        status = target_check(context, s->report, TARGET_REPORT);
    if (status == CREASE_OK)
        status = input_read(context, s, r, &cloud);
    if (status == CREASE_OK)
        status = crease_cloud_filter(context, cloud, &s->filter, &filtered);
    if (status == CREASE_OK) {
        report_stage(r, "filter");
        describe(r, s, filtered);
        const outputs all = {.allowed = ALLOWED,
            .cloud = crease_filtered_cloud(filtered),
            .colour_by = s->filter.remove_outliers ? NULL : "outlier"};
        status = outputs_write(context, s, r, &all);
    }
    crease_filtered_free(filtered);
    crease_cloud_free(cloud);
    return status;
}
