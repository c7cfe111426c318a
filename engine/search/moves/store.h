// The annealing over routes in rows of stops.
#pragma once

#include "search/route/layout.h"

namespace tandem {

constexpr Int any_order = -1;  // no order of insertion in particular: one is drawn each turn

// Ruins and recreates `turns` times, as `search/anneal` says.
void anneal_routes(const ProblemData& data, Searcher& searcher, Int turns);

// Inserts all who are left out in an order, as `search/anneal` says.
void insert_all(const ProblemData& data, Searcher& searcher, Int order);

}  // namespace tandem
