// Other types of vehicles for routes of linked stops.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// What a route costs by a vehicle of type `k`.
inline double cost_of_run(const ProblemData& data, Int k, const Run& run) {
    const Rate& rate = data.rate[k];
    return rate.fixed + double(run.distance) * rate.distance + double(run.count) * rate.stop;
}

// Lets a vehicle of another type drive a route, and notes that.
void give_run(Searcher& searcher, Linked& linked, Int slot, Int k);

// The type for which a route would be exchanged to take a customer more: the cheapest that is left
// and holds them all; `nowhere` if there is none.
Int larger_for(const ProblemData& data, const Searcher& searcher, const Run& run, Int node);

// Gives a route the cheapest vehicle left, or another's; returns the saving.
double cheapen_run(const ProblemData& data, Searcher& searcher, Linked& linked, Int slot);

// Gives the routes of this turn cheaper vehicles; returns the saving.
double cheapen_runs(const ProblemData& data, Searcher& searcher, Linked& linked);

// Lets all routes be driven by the vehicles that did before this turn.
void take_types_back(Searcher& searcher, Linked& linked);

}  // namespace tandem
