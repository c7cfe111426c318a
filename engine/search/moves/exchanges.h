// Other moves than ruin and recreate: tails, ends of shipments and vehicles go elsewhere.
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

// Lets a truck or a drone serve an end of a random shipment elsewhere on its trip, if drones may
// serve some end and that costs less than so much more.
//
// Whom a drone brings may depend on where another's parcel is fetched, and this on where the first
// is, so that both leave together, and neither comes back as well alone. In place; tells whether a
// route was changed and keeps all rules; if not, it may be broken.
bool move_end(const ProblemData& data, const Searcher& searcher, double rise);

// Give the routes touched this turn the cheapest vehicles left, or others'. In place.
void improve_types(const ProblemData& data, Searcher& searcher);

// Give one of the routes touched this turn a vehicle of any type. In place.
void draw_type(const ProblemData& data, Searcher& searcher);

// Give the routes touched this turn the types that drive them at the least cost. In place.
void cheapen_types(const ProblemData& data, Searcher& searcher);

}  // namespace tandem
