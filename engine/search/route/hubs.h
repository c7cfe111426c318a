// What routes of vehicles that fly take of their depots' batteries, all of them together. Where any
// depot has only so many, they are counted anew each time.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Tell whether there is a battery for one trip more that a vehicle of type `k` begins at a depot.
bool may_take_off(const ProblemData& data, const Searcher& searcher, Int k, Int depot);

// Tell whether the routes take no more than there is.
bool hubs_suffice(const ProblemData& data, const Searcher& searcher);

}  // namespace tandem
