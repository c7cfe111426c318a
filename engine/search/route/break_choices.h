// Ways to take breaks on a route whose order is given, among which is the cheapest.
#pragma once

#include "search/route/best_begin.h"
#include "search/route/breaks.h"

namespace tandem {

// Where breaks are taken, and what that makes of a route that begins when that costs least.
struct BreakChoice {
    PlacedBreaks placed;
    Begun timing;
};

// Return all ways to take breaks on a loaded route that may be the cheapest, none that breaks a
// rule by itself, or costs `most_late` as customers are served too late; the cheapest first.
//
// By dynamic programming along the route: of two ways to have taken as many breaks, one is no worse
// that is nowhere later, may begin in the same interval, costs no more by when customers are
// served, and was at those later whom others look back to.
std::vector<BreakChoice> break_choices(const ProblemData& data, const Route& route,
                                       View<const Stop, 1> stops, double most_late);

// Write when each stop of a loaded route may be left at the soonest, whichever breaks are taken
// before. In place.
void note_soonest(const ProblemData& data, const Route& route, View<Stop, 1> stops);

}  // namespace tandem
