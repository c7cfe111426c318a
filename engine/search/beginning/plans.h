// The routes that a search begins with: of a plan, or of nobody; and the best ones as a plan.
#pragma once

#include "plan/telling.h"
#include "search/route/layout.h"

namespace tandem {

// Write the sequences of the routes of a plan to the first slots. In place; returns how many there
// are.
Int read_plan(const Fleet& fleet, View<const Int, 1> numbers);

// Tell the routes in so many slots, whose trips begin as late as costs nothing. In place: they are
// timed so; throws if nobody can drive one.
void tell_routes(const ProblemData& data, Fleet& fleet, Int slots, Plan& plan);

// Times the routes written; those that break a rule are left to be planned anew.
void begin(const ProblemData& data, Searcher& searcher, Int num_routes);

// What the truck's legs between customers cost on average: by the last end, where that alone costs.
// Where there are none, a share of the whole cost; always above zero.
double leg_cost(const ProblemData& data, const Searcher& searcher);

// Writes the times of a route whose trips begin as late as costs nothing. False if nobody can drive
// it.
bool finish_route(const ProblemData& data, Fleet& fleet, Int slot);

// Takes all routes apart.
void disband(const ProblemData& data, Searcher& searcher);

// Takes the route apart, without sorties, whose customers were left out after the fewest turns.
void give_up_route(const ProblemData& data, Searcher& searcher);

}  // namespace tandem
