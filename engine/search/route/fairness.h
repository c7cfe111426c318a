// What the routes of a search cost as a whole, and by how much that would change.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Tell whether the plan as a whole costs something.
inline bool plan_costs(const ProblemData& data) { return is_fairness_priced(data.fairness); }

// Return what all routes share; nothing where the plan as a whole costs nothing.
Shares shares_of(const ProblemData& data, const Searcher& searcher);

// Return what the routes cost as a whole.
double plan_cost(const ProblemData& data, const Searcher& searcher);

// Estimate by how much that grows if a customer comes on the route in a slot, which then costs so
// much more: it ends later in proportion.
double plan_cost_of_joining(const ProblemData& data, const Fleet& fleet, const Shares& shares,
                            Int slot, Int node, double cost);

// Estimate by how much that grows if a route serves a customer alone on another trip.
double plan_cost_of_trip(const ProblemData& data, const Fleet& fleet, const Shares& shares,
                         Int slot, Int node);

// Estimate by how much that grows if a vehicle of type `k` more serves a customer alone.
double plan_cost_of_opening(const ProblemData& data, const Shares& shares, Int k, Int node);

}  // namespace tandem
