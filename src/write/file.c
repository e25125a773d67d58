/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "write/output.h"

crease_status crease_file_write(
    crease_context *context, const char *path, const void *bytes, size_t size)
{
    crease_output *output = NULL;
    const crease_status status = crease_output_open(context, path, &output);
    if (status != CREASE_OK)
        return status;
    crease_output_bytes(output, bytes, size);
    return crease_output_close(context, output, CREASE_OK);
}
