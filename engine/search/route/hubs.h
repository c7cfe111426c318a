// What routes of vehicles that fly take of their depots' batteries, all of them together. Where any
// depot has only so many, they are counted anew each time, whenever a route is timed: so no plan
// takes more, wherever its trips are moved.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Add how many batteries each route takes of each depot, (slot, depot). In place; none are counted
// where all depots have enough.
void count_batteries(const ProblemData& data, const Fleet& fleet, View<Int, 2> taken);

// Tell whether there is a battery for one trip more that a vehicle of type `k` begins at a depot.
bool may_take_off(const ProblemData& data, const Fleet& fleet, Int k, Int depot);

// Tell whether there is one for a trip more wherever it reloads.
bool may_take_off_again(const ProblemData& data, const Fleet& fleet, Int k);

// Tell whether there are batteries for the trips of a route beside others'. In a scratch slot it
// isn't known whose it is.
bool has_batteries(const ProblemData& data, const Fleet& fleet, Int slot);

}  // namespace tandem
