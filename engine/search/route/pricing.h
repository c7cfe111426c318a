// What a route costs whose trips are where they are, at least and once they begin as late as that
// costs nothing.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// What no route costs.
constexpr double no_bar = 1e300;

// Write what a route costs whose trips are timed, and held as long as they have to be. In place;
// false if it breaks a rule.
//
// Where that costs less, its trips are held back; `settled` tells.
bool price_timed(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled);

// As `price_timed`, of a route that is timed as soon as possible, none of its trips held.
bool price_driven(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled);

// Write times and cost of a route whose loads are known and whose first trip begins no sooner than
// its release says. In place, as `price_timed`.
bool price_loaded(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled);

// Let every trip begin as soon as possible. In place.
void clear_holds(const Tour& tour);

// Let each trip of a timed route begin as late as costs nothing. In place; false if a rule is
// broken.
bool settle(const ProblemData& data, const Tour& tour);

// Return how long a route could work longer at no cost.
Int spare_time(const ProblemData& data, const Tour& tour);

// Tell whether a timed route may work for less if fewer or others are served on it, by more than
// the hours that they take.
bool may_save_more(const ProblemData& data, const Route& route);

// What a route costs at least, and how long its vehicle works then.
struct LeastPrice {
    double cost;
    Int working;
};

// Return what a route costs at least whose driver rests, once its trips are loaded.
LeastPrice least_cost(const ProblemData& data, const Fleet& fleet, Int slot);

}  // namespace tandem
