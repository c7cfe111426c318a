// The cheapest insertion of a customer, on all routes or beside neighbours.
#pragma once

#include "search/insertion/best.h"

namespace tandem {

// How often a customer who can go on a trip as it is may begin or split one.
constexpr double more_trips = 0.2;

constexpr Int drawn_for_trips = 16;  // on how many vehicles, where not all are looked at

// Tries a customer on a route of its own.
void try_new_route(const ProblemData& data, const Searcher& searcher, Int node, Best& best);

// Finds the cheapest insertion of a customer on all routes. In place: also what is kept.
void find_place(const Insertion& insertion);

// Finds the cheapest insertion of a customer beside its neighbours.
void find_beside(const Insertion& insertion);

// Which trips more are tried: for the customer alone, or where one is split, too.
enum class MoreTrips { alone, any };

// Tries a customer on a trip more of so many routes.
//
// Follows `find_place` or `find_beside`. Where these are not all routes, they are drawn.
void try_trips(const Insertion& insertion, Int number, MoreTrips tried);

// Finds the cheapest insertion of a customer on one route, on its trips as they are and on more.
void find_at_home(const Insertion& insertion, Int slot);

}  // namespace tandem
