// The cheapest insertion of a customer, on all routes or beside neighbours.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// How often a customer who can go on a trip as it is may begin or split one.
constexpr double more_trips = 0.2;

constexpr Int drawn_for_trips = 16;  // on how many vehicles, where not all are looked at

// Tries a customer on a route of its own; returns its cost, `infeasible` if there is none.
//
// In place: the move.
double try_new_route(const ProblemData& data, const Searcher& searcher, Int node);

// Finds the cheapest insertion of a customer; returns its cost, `infeasible` if there is none.
//
// In place: the move, and what is kept.
double find_place(const ProblemData& data, const Searcher& searcher, Int node, bool enlarge);

// Finds the cheapest insertion of a customer beside its neighbours. As `find_place`.
double find_beside(const ProblemData& data, const Searcher& searcher, Int node, bool enlarge);

// Tells whether an insertion is on a route of its own.
bool opens_route(const Move& move);

// Tries a customer on a trip more of so many routes, or where one of theirs is split.
//
// Follows `find_place` or `find_beside`; returns the cost of the cheapest insertion so far. Where
// these are not all routes, they are drawn. In place: the move.
double try_trips(const ProblemData& data, const Searcher& searcher, Int node, Int number);

}  // namespace tandem
