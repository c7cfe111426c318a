// What an insertion costs: from the blocks around it, or by timing the whole route again.
#pragma once

#include "search/insertion/newcomer.h"
#include "search/route/routes.h"

namespace tandem {

// Returns what it costs to insert a customer as `move` says; `infeasible` if it can't be, or is
// known to cost no less than `bar` before the route is timed.
double price_move(const ProblemData& data, const Fleet& fleet, const Move& move, Int node,
                  double bar);

// Tells whether `price_stop` can price a customer behind stop `p`.
//
// No drone is in the air there, the trip needs not wait for the parcel and, if lateness counts,
// no drone flies at all, so that stops follow one another in time.
bool stands_alone(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node);

// Returns what it costs to insert a customer behind stop `p`; `infeasible` if it can't be.
//
// For where `stands_alone`; in constant time unless lateness costs.
double price_stop(const ProblemData& data, const Fleet& fleet, Int slot, Int p,
                  const Newcomer& newcomer);

}  // namespace tandem
