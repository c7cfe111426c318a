// Plans to and from the routes of a search, by the numbers that they cross as.
#pragma once

#include "plan/telling.h"
#include "search/route/layout.h"

namespace tandem {

// Write the sequences of the routes of a plan to the first slots. In place; returns how many there
// are.
Int read_plan(const Fleet& fleet, View<const Int, 1> numbers);

// Tell the routes in so many slots, whose trips begin as late as costs nothing. In place: they are
// timed so; throws if nobody can drive one.
void tell_routes(const ProblemData& data, Fleet& fleet, Int slots, Plan& plan);

}  // namespace tandem
