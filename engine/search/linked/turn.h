// What a turn does to linked stops: strings are removed, customers inserted, tails swapped, and
// vehicles exchanged.
#pragma once

#include "search/linked/layout.h"
#include "search/route/vehicles.h"
#include "search/turn.h"

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

// How many customers a turn removes at most, to the last string.
constexpr Int most_removed = 512;

// What was saved, and near whom.
struct Ruined {
    double saved;
    Int seed;
};

// Removes strings of customers near each other; they are absent then.
Ruined ruin_linked(const ProblemData& data, Searcher& searcher, Linked& linked);

// Whether all were tried, and what routes cost more then.
struct Recreated {
    bool done;
    double added;
};

// Inserts the absent customers from number `first` on, each where it costs least; they are tried
// everywhere if `scan_all`, else nearby. As `recreate`.
Recreated recreate_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int first,
                          Spare spare, bool scan_all);

// The slots of both routes, `nowhere` if no tails were swapped, and what it costs.
struct SwappedTails {
    Int slot, other;
    double cost;
};

// Swaps the tail behind a random customer if that costs less than `limit`.
SwappedTails two_opt_star_linked(const ProblemData& data, Searcher& searcher, Linked& linked,
                                 double limit);

}  // namespace tandem
