/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "facts.h"

enum { MOST_NUMBERS = 8 };

static crease_fact fact_of(const cJSON *member)
{
    crease_fact fact = {.name = member->string};
    const cJSON *item = NULL;
    if (cJSON_IsString(member))
        fact.text = member->valuestring;
    else if (cJSON_IsBool(member))
        fact.text = cJSON_IsTrue(member) ? "yes" : "no";
    else if (cJSON_IsNumber(member))
        fact.numbers[fact.number_count++] = member->valuedouble;
    if (!cJSON_IsArray(member))
        return fact;
    cJSON_ArrayForEach(item, member)
    {
        if (cJSON_IsNumber(item) && fact.number_count < MOST_NUMBERS)
            fact.numbers[fact.number_count++] = item->valuedouble;
    }
    return fact;
}

crease_status facts_show_one(
    crease_context *context, crease_scene *scene, size_t item, const cJSON *object)
{
    const cJSON *member = NULL;
    crease_status status = CREASE_OK;
    cJSON_ArrayForEach(member, object)
    {
        const crease_fact fact = fact_of(member);
        if (status == CREASE_OK && (fact.text || fact.number_count > 0))
            status = crease_scene_describe(context, scene, item, &fact, 1);
    }
    return status;
}

crease_status facts_show(crease_context *context, crease_scene *scene, const cJSON *list)
{
    const cJSON *object = NULL;
    crease_status status = CREASE_OK;
    size_t item = 0;
    cJSON_ArrayForEach(object, list)
    {
        if (status == CREASE_OK)
            status = facts_show_one(context, scene, item++, object);
    }
    return status;
}
