/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/contact.h"

#include "base/memory.h"

#include <stdlib.h>

typedef struct link {
    int32_t from, to;
} link;

static int compare_links(const void *a, const void *b)
{
    const link *x = a, *y = b;
    if (x->from != y->from)
        return x->from < y->from ? -1 : 1;
    return x->to < y->to ? -1 : x->to > y->to;
}

/* Both ways of all links between regions; counts them when links is NULL. */
static size_t collect(const crease_segmentation *seg, link *links)
{
    size_t count = 0;
    for (size_t i = 0; i < seg->count; i++) {
        const uint32_t *const near = crease_segmentation_near(seg, i);
        for (int j = 1; j <= seg->border_links; j++) {
            const int32_t mine = seg->labels[i], theirs = seg->labels[near[j]];
            if (mine < 0 || theirs < 0 || mine == theirs)
                continue;
            if (links) {
                links[count] = (link){mine, theirs};
                links[count + 1] = (link){theirs, mine};
            }
            count += 2;
        }
    }
    return count;
}

/* Sorted links: one neighbour for each run of equal ones that is long enough. */
static void list(const link *links, size_t count, size_t least, crease_contacts *out)
{
    size_t kept = 0;
    for (size_t begin = 0, end; begin < count; begin = end) {
        for (end = begin; end < count && compare_links(&links[begin], &links[end]) == 0;)
            end++;
        if (end - begin < least)
            continue;
        out->to[kept++] = links[begin].to;
        out->first[links[begin].from + 1] = kept;
    }
}

crease_status crease_contacts_find(crease_segmentation *seg, size_t least, crease_contacts *out)
{
    const size_t count = collect(seg, NULL);
    link *const links = crease_allocate(seg->context, count, sizeof *links);
    out->first = crease_allocate(seg->context, seg->region_count + 1, sizeof *out->first);
    out->to = crease_allocate(seg->context, count, sizeof *out->to);
    const bool enough = links && out->first && out->to;
    if (enough) {
        collect(seg, links);
        qsort(links, count, sizeof *links, compare_links);
        list(links, count, least, out);
        for (size_t r = 0; r < seg->region_count; r++)
            if (out->first[r + 1] < out->first[r])
                out->first[r + 1] = out->first[r];
    } else {
        crease_contacts_clear(out);
    }
    free(links);
    return enough ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

void crease_contacts_clear(crease_contacts *contacts)
{
    free(contacts->first);
    free(contacts->to);
    *contacts = (crease_contacts){.first = NULL};
}

bool crease_contacts_has(const crease_contacts *contacts, int32_t from, int32_t to)
{
    for (size_t i = contacts->first[from]; i < contacts->first[from + 1]; i++)
        if (contacts->to[i] == to)
            return true;
    return false;
}
