// Tails of routes, swapped among linked stops, or driven as a route of their own.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// The slots of both routes, `nowhere` if no tails were swapped, and what it costs.
struct SwappedTails {
    Int slot;
    Int other;
    double cost;
};

// Swaps the tail behind a random customer if that costs less than `limit`.
SwappedTails two_opt_star_linked(const ProblemData& data, Searcher& searcher, Linked& linked,
                                 double limit);

}  // namespace tandem
