// Write a part of a route anew.
#pragma once

#include "search/moves/exchanges.h"
#include "search/route/edit.h"
#include "search/route/refresh.h"
#include "search/route/routes.h"

namespace tandem {

// Write the route that is kept aside into a slot, but what lies between stops `first` and `last`.
//
// `write_part` gets stop `first`, and writes from there up to but without stop `last`, in place;
// false if there is no room. False if so, or if the route breaks a rule.
template <typename WritePart>
bool rewrite(const ProblemData& data, const Searcher& searcher, Int slot, Int first, Int last,
             const WritePart& write_part) {
    const Fleet& now = searcher.now;
    const Int spare = now.route.size() - 2;
    Route& route = now.route[slot];
    route.length = route.sorties = route.trips = 0;
    if (!append(now, spare, 0, first, slot) || !write_part(now.stop(spare, first)) ||
        !append(now, spare, last, now.route[spare].length, slot)) {
        return false;
    }
    if (has_halts(data)) {
        // Where ways by a launch site are shorter, the truck may have come by for nothing.
        close_ranks(sequence_in(now, slot), searcher.marked, searcher.scratch->moved);
    }
    const bool done = refresh(data, now, slot);
    locate(now, slot);
    return done;
}

}  // namespace tandem
