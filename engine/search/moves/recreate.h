// Insertion of the customers left out, one after another, each where that costs least.
#pragma once

#include "search/turn.h"

namespace tandem {

// How often a full route may take a larger vehicle to serve a customer more.
constexpr double enlarged = 0.2;

// How often the first customer inserted is given a route of its own.
constexpr double opening_share = 0.03;

// In what order customers are inserted.
enum InsertionOrder : Int {
    by_chance,
    by_demand,
    by_far,
    by_close,
    by_width,
    by_latest,
    by_cost,
    by_absences
};

// Draws in what order customers are inserted; if somebody lacks who has to be served, every other
// time those come first who were left out most often.
Int draw_order(const ProblemData& data, View<std::uint64_t, 1> rng, bool lacks);

// Puts the customers to insert in order, from number `first` on.
void sort_absent(const ProblemData& data, const Searcher& searcher, Int first, Int order);

// Inserts the absent customers from number `first` on, each where it costs least.
//
// False, with only some inserted, once that costs more than is to `spare`, or leaves out more. Once
// the search must end, the others are left out.
bool recreate(const ProblemData& data, const Searcher& searcher, Int first, bool scan_all,
              Spare spare);

constexpr Int any_order = -1;  // no order of insertion in particular: one is drawn each turn

// Ruins and recreates `turns` times, as `search/anneal` says.
void anneal_routes(const ProblemData& data, Searcher& searcher, Int turns);

// Inserts all who are left out in an order, as `search/anneal` says.
void insert_all(const ProblemData& data, Searcher& searcher, Int order);

}  // namespace tandem
