// Plans to and from the routes of a search.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Writes the cost of a route that serves one customer alone, (type, 2, node). A slot of the fleet
// is scratch.
void alone_costs(const ProblemData& data, Fleet& fleet, const View<double, 3>& alone);

// Times the routes written; those that break a rule are left to be planned anew.
void begin(const ProblemData& data, Searcher& searcher, Int num_routes);

// What the truck's legs between customers cost on average. Where there are none, a share of the
// whole cost; always above zero.
double leg_cost(const ProblemData& data, const Searcher& searcher);

// Writes the times of a route whose trips begin as late as costs nothing. False if nobody can drive
// it.
bool finish_route(const ProblemData& data, Fleet& fleet, Int slot);

}  // namespace tandem
