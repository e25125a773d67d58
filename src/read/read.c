/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/formats.h"

crease_read_options crease_read_options_default(void)
{
    return (crease_read_options){.skip_invalid = false};
}

crease_status crease_source_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    const crease_format *format =
        crease_format_find(source->path, source->bytes, source->size, source->size);
    if (format && format->read)
        return format->read(context, source, options, out);
    if (format)
        return crease_fail(context, CREASE_ERROR_FORMAT,
            "%s: is %s, not a cloud; give points as PLY, PCD, XYZ, TXT, CSV, ASC, PTS, LAS, OBJ, "
            "STL or "
            "OFF",
            source->name, format->description);
    return crease_fail(context, CREASE_ERROR_FORMAT,
        "%s: is no cloud that is known here; give points as PLY, PCD, XYZ, TXT, CSV, ASC, PTS, "
        "OBJ, STL or OFF",
        source->name);
}

crease_status crease_cloud_read(crease_context *context, const char *path,
    const crease_read_options *options, crease_cloud **out)
{
    *out = NULL;
    const crease_read_options chosen = options ? *options : crease_read_options_default();
    crease_source source;
    crease_stage(context, "reading");
    crease_status status = crease_source_open(context, path, &source);
    if (status != CREASE_OK)
        return status;
    status = crease_source_read(context, &source, &chosen, out);
    crease_source_free(&source);
    return status;
}
