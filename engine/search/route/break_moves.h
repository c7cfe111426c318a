// Breaks moved from where a route ends soonest to where it costs less: flights that don't wait for
// them, customers who are served in time, or work that begins later.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Return what it costs at least, wherever its breaks are, that customers of a loaded route are
// served too late; nothing where that isn't known. In place: it is timed without breaks.
double least_lateness(const ProblemData& data, const Fleet& fleet, Int slot);

// What is known of a route's cost: what it would be were nobody served too late, and what it has to
// be below.
struct CostBounds {
    double in_time;
    double bar;
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
bool move_breaks(const ProblemData& data, const Fleet& fleet, Int slot, const CostBounds& bounds,
                 bool& settled);

}  // namespace tandem
