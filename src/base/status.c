/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "crease/crease.h"

static const struct {
    crease_kind kind;
    const char *sentence;
} table[] = {
#define ROW(code, kind, sentence) {kind, sentence},
    CREASE_STATUS_TABLE(ROW)
#undef ROW
};

static bool known(crease_status status)
{
    return (size_t)status < sizeof table / sizeof table[0];
}

const char *crease_status_sentence(crease_status status)
{
    return known(status) ? table[status].sentence : "this is not a status of crease";
}

crease_kind crease_status_kind(crease_status status)
{
    return known(status) ? table[status].kind : CREASE_KIND_FAILURE;
}

const char *crease_version(void)
{
    return CREASE_VERSION;
}
