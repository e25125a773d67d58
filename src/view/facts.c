/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/facts.h"

#include "base/memory.h"
#include "view/text.h"

#include <stdlib.h>

static void clear(crease_known *known)
{
    free((char *)known->fact.name);
    free((char *)known->fact.text);
}

void crease_facts_free(crease_facts *facts)
{
    for (size_t i = 0; i < facts->count; i++)
        clear(&facts->all[i]);
    free(facts->all);
    *facts = (crease_facts){0};
}

static crease_status copy(
    crease_context *context, size_t item, const crease_fact *from, crease_known *out)
{
    *out = (crease_known){.item = item, .fact = *from};
    out->fact.name = crease_text_clean(context, from->name);
    out->fact.text = from->text ? crease_text_clean(context, from->text) : NULL;
    if (out->fact.name && (out->fact.text || !from->text))
        return CREASE_OK;
    clear(out);
    return CREASE_ERROR_NO_MEMORY;
}

crease_status crease_facts_add(crease_context *context, crease_facts *facts, size_t item,
    const crease_fact *added, size_t count)
{
    crease_known *const grown =
        crease_reallocate(context, facts->all, facts->count + count, sizeof *grown);
    if (!grown)
        return CREASE_ERROR_NO_MEMORY;
    facts->all = grown;
    const size_t before = facts->count;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        status = copy(context, item, &added[i], &grown[facts->count]);
        facts->count += status == CREASE_OK;
    }
    while (status != CREASE_OK && facts->count > before)
        clear(&grown[--facts->count]);
    return status;
}
