// The cheapest of ways to take breaks; beside drones, they are moved from where a route ends
// soonest: to where flights don't wait for them, customers are served in time, or work begins
// later.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// What is known of a route's cost: what it would be at least were nobody served too late, with how
// much work, and what it has to be below.
struct CostBounds {
    double in_time;
    double bar;
    Int working = 0;
};

// Price a loaded route by the cheapest way to take its breaks, of those that `break_choices` knows.
// In place; false if none does, or is below the bar.
bool price_choices(const ProblemData& data, const Fleet& fleet, Int slot, const CostBounds& bounds,
                   bool& settled);

// Price a route that can't begin sooner, as breaks that follow its departure would come too soon:
// as late as it could without them. In place; false if that doesn't do.
bool begin_late(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled);

// Tell whether a priced route might cost less, at least so much, were its breaks elsewhere.
bool may_move_breaks(const ProblemData& data, const Fleet& fleet, Int slot, double least);

// Let the breaks of a priced route be elsewhere, or the route begin later, if that costs less. In
// place; false if it can't be driven any more. Where there is a bar, its cost alone is written.
bool move_breaks(const ProblemData& data, const Fleet& fleet, Int slot, double bar, bool& settled);

}  // namespace tandem
