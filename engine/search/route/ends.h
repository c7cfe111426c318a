// Where the trips of a route begin and end, if not all do so at one place.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Tell whether trips of a type don't all begin and end at one place.
inline bool is_apart(const ProblemData& data, Int k) { return data.type[k].changes_ends != 0; }

// Let each trip begin and end where it may. In place.
//
// Where one ends and the next begins stays as it is, if it may be there.
void place_ends(const ProblemData& data, Int k, const Tour& tour);

// A place to reload at, and how far it is by it.
struct Reload {
    Int distance, node;
};

// Return how far it is from a node to another by a place to reload at, and which.
Reload nearest_reload(const ProblemData& data, Int k, Int before, Int behind);

// Return how far it is from a node to another by a customer and a place to reload at.
//
// `first` tells that the customer comes first.
Int way_by_reload(const ProblemData& data, Int k, Int before, Int node, Int behind, bool first);

}  // namespace tandem
