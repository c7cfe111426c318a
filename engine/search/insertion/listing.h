// The list of insertions that may be the cheapest.
#pragma once

#include "rules/rates.h"
#include "search/scratch.h"

namespace tandem {

// What it saves at most that a route's vehicle serves a customer, beside all that it drives and
// flies further: what its waiting costs, less what it costs that it is this vehicle.
inline double most_saved(const ProblemData& data, const Fleet& fleet, Int slot, Int node) {
    return fleet.early[slot] - vehicle_cost_at(data.vehicle_cost, fleet.route[slot].type, node);
}

// Lists an insertion that costs at least `cost`; returns it, to complete it. Were there no room, it
// would take the place of the last one.
inline Offer& add_offer(const Searcher& searcher, double cost, Int slot, Int first, Int last) {
    Scratch& scratch = *searcher.scratch;
    if (scratch.offers < scratch.offer.size()) ++scratch.offers;
    const Int index = scratch.offers - 1;
    scratch.least[index] = cost;
    return scratch.offer[index].between(slot, searcher.now.route[slot].type, first, last);
}

}  // namespace tandem
