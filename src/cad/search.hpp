/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The ways of building a part are tried in turn until one gives a solid that the points lie on;
 * failing that, the best of what came out is taken. */
#ifndef CREASE_CAD_SEARCH_HPP
#define CREASE_CAD_SEARCH_HPP

#include "cad/job.hpp"
#include "cad/judge.hpp"

#include <memory>
#include <optional>
#include <string>

namespace crease_cad
{

struct RegionsFree {
    void operator()(crease_regions *regions) const
    {
        crease_regions_free(regions);
    }
};

/* The search for the best outcome. */
struct Search {
    crease_context *context;
    const crease_cloud *cloud;
    const Job &given;
    bool as_bsplines;
    std::unique_ptr<crease_regions, RegionsFree> coarser_regions;
    std::unique_ptr<const Job> coarser; /* with these */
    std::unique_ptr<crease_regions, RegionsFree> complete_regions;
    std::unique_ptr<const Job> complete; /* with these */
    const Job *job;                      /* of the best */
    std::optional<Judged> best;
    std::string why_no_solid;
    bool spent;       /* an arrangement was too much work; with a larger margin it is even more */
    bool hangs;       /* and took so long that it was ended */
    double arranging; /* seconds that arrangements have taken */
};

/* Leaves the best in the search; throws Failure when there is none. */
void search_best(Search &search);

} // namespace crease_cad

#endif
