// Moves of whole parts: tails between routes, into a new route or behind another.
#pragma once

#include "search/route/layout.h"

namespace tandem {

constexpr Int tail_neighbours = 16;  // with how many neighbours' routes a tail is tried

// Append stops `first` to `behind - 1` of a route, and sorties from there, to another. In place;
// false if there is no room.
[[nodiscard]] bool append(const Fleet& source, Int slot, Int first, Int behind, Int to);

// Swap the tail behind a random stop if that may cost less than `limit`.
//
// In place; tells whether routes were changed and keep all rules; if not, they may be broken.
bool two_opt_star(const ProblemData& data, Searcher& searcher, double limit);

}  // namespace tandem
