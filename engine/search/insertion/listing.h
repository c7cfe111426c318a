// The list of insertions that may be the cheapest.
#pragma once

#include "search/route/layout.h"
#include "search/scratch.h"

namespace tandem {

// Lists an insertion that costs at least `cost`; returns it, to complete it.
inline Move& add_offer(const Searcher& searcher, double cost, Int kind, Int slot, Int first) {
    const Int index = searcher.scratch->offers++;
    searcher.scratch->least[index] = cost;
    Move& offer = searcher.scratch->offer[index];
    offer.kind = kind;
    offer.slot = slot;
    offer.first = first;
    return offer;
}

}  // namespace tandem
