// Insertions that begin a trip more on a route, or split one, where distance alone costs.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Tells whether a customer may join a trip's up to stop `p`, or the rest, by what is carried.
bool part_fits(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node, bool front);

// Tells whether a vehicle of type `k` may serve a customer on a trip of its own, by loads.
bool may_begin(const ProblemData& data, Int k, Int node);

// Tells whether a simple route may have a trip more as a move says.
bool more_trips_fit(const ProblemData& data, const Fleet& fleet, const Move& move, Int node);

}  // namespace tandem
