// Other types of vehicles for routes of linked stops.
#pragma once

#include "search/linked/layout.h"
#include "search/route/vehicles.h"

namespace tandem {

inline Haul haul_of(const Run& run) { return {run.distance, run.count, amount_of(run.load)}; }

// Lets a vehicle of another type drive a route, and notes that.
void give_run(Searcher& searcher, Linked& linked, Int slot, Int k);

// Gives a route the cheapest vehicle left, or another's; returns the saving.
double cheapen_run(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot);

// Gives the routes of this turn cheaper vehicles; returns the saving.
double cheapen_runs(const ProblemData& data, Searcher& searcher, Linked& linked);

// Lets all routes be driven by the vehicles that did before this turn.
void take_types_back(Searcher& searcher, Linked& linked);

}  // namespace tandem
