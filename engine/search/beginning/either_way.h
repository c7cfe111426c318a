// A first plan by savings of routes that may be driven either way, where loads alone limit them.
//
// Pairs of customers are joined in the order of what that saves, each where it is first or last on
// its route, whichever: routes are turned round as needed. Where they are long that leaves far
// fewer pieces than joining ends to beginnings, elsewhere it is a little worse: so both are tried.
#pragma once

#include "search/beginning/savings.h"

namespace tandem {

// Joins routes at either end, pair after pair. As `join`.
void join_either_way(const ProblemData& data, Int k, Int ranks, View<const Int, 1> keys,
                     const Beside& beside);

}  // namespace tandem
