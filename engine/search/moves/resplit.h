// Trips with one drone planned anew from an order of their customers.
//
// A part of a trip, or two routes together, the depot between them among what is moved: so a route
// is split in two, or two become one, with the drones' share of each chosen anew at once.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Plan part of a trip with one drone, or two routes, anew from a changed order of customers.
//
// In place; tells whether routes were changed and keep all rules; if not, they may be broken.
// Nothing is changed that would cost more than `limit`.
bool resplit(const ProblemData& data, Searcher& searcher, double limit);

}  // namespace tandem
