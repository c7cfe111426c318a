// Routes shared between threads: a region for each, or the cheapest of all for everyone.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Goes on from the routes that thread `number` owns, and the customers missing; `spare` (type,)
// vehicles may be used besides.
void take_part(const ProblemData& data, const Searcher& whole, Searcher& part,
               View<const Int, 1> owner, Int number, View<const Int, 1> missing,
               View<const Int, 1> spare);

// Copies a part's routes behind the `filled` first slots, and who is missing; returns how many
// slots are filled then.
Int add_routes(const ProblemData& data, Searcher& whole, const Searcher& part, Int filled);

// Copies a part's best routes behind the `filled` first slots, and who is missing. As `add_routes`.
Int add_best(Searcher& whole, const Searcher& part, Int filled);

}  // namespace tandem
