// Simulated annealing by ruin and recreate.
//
// References: Christiaens and Vanden Berghe (2020), slack induction by string removals for vehicle
// routing problems, Transportation Science 54:417-433.
#pragma once

#include "search/route/layout.h"

namespace tandem {

constexpr Int any_order = -1;     // no order of insertion in particular: one is drawn each turn
constexpr Int most_missing = 12;  // how many of the customers left out are tried again each turn
constexpr double retyped_share = 0.1;  // how often touched routes get the vehicles that cost least

// List `most` of the customers left out as absent. In place; return how many are not tried.
Int begin_turn(const World& world, Searcher& searcher, Int most);

// Let those left out near a customer, who may be one of them, be tried before others. In place.
//
// They come last of the first `total` absent, of whom those from number `first` on are tried. Who
// has to be served is tried by chance alone, everywhere as often.
void try_near(const World& world, Searcher& searcher, Int seed, Int first, Int total);

// Tell whether after this turn others are left out who must not be, and seldom were.
//
// They are as many as before, and all who are left out cost no more. Counts the absences. In place.
bool rarer_absences(const World& world, Searcher& searcher);

// Tell whether what a turn has inserted so far costs no more than all that it will insert.
bool counts_up(const World& world, const Searcher& searcher);

// Ruin and recreate `turns` times. In place.
//
// Where no insertion saves anything, a turn is given up once those made cost more than would be
// accepted.
// Given an `order`, nobody is removed, all who are left out are inserted in it, and that is kept
// whatever it costs.
// Once the search must end, a turn is given up as if it had not begun, and an insertion of all
// leaves out whoever is not inserted yet.
void anneal(const World& world, Searcher& searcher, Int turns, Int order);

}  // namespace tandem
