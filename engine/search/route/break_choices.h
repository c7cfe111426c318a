// Ways to take breaks on a route whose order is given, among which is the cheapest.
#pragma once

#include <vector>

#include "search/route/layout.h"
#include "search/route/placed_breaks.h"

namespace tandem {

// Where breaks are taken, and what that makes of a route that begins as `placed` says.
struct BreakChoice {
    PlacedBreaks placed;
    Int end;      // of the route, at the soonest
    Int working;  // how long it works, at least
};

// Tell whether drivers of a type pause for stated breaks alone, and nobody else hangs on when.
bool has_breaks_alone(const ProblemData& data, Int k);

// Tell whether breaks of a loaded route are chosen so: its times are joined by `TimeSegment`.
//
// Not where speeds change, drones fly, drivers rest by rules, customers cost by when they are
// served, or other vehicles are waited for.
bool joins_breaks(const ProblemData& data, const Route& route, View<const Stop, 1> stops);

// Return all ways to take breaks on a loaded route that may be the cheapest, none that breaks a
// rule by itself.
//
// By dynamic programming along the route: of two ways to have taken as many breaks, one is no worse
// that is nowhere later, may begin in the same interval, and was at those later whom others look
// back to.
std::vector<BreakChoice> break_choices(const ProblemData& data, const Route& route,
                                       View<const Stop, 1> stops);

// Write when each stop of a loaded route may be left at the soonest, whichever breaks are taken
// before. In place.
void note_soonest(const ProblemData& data, const Route& route, View<Stop, 1> stops);

}  // namespace tandem
