// What routes of vehicles that fly take of their depots' batteries and places to charge, all of
// them together. Where any depot has only so many, they are counted anew each time.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Tell whether there is what one trip more takes that a vehicle of type `k` begins at a depot after
// so many.
bool may_take_off(const ProblemData& data, const Searcher& searcher, Int k, Int depot, Int trips);

// Tell whether the routes take no more than there is.
bool hubs_suffice(const ProblemData& data, const Searcher& searcher);

}  // namespace tandem
