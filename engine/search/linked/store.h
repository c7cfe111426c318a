// The annealing over linked stops.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// Ruins and recreates `turns` times, as `search/anneal` says.
void anneal_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int turns);

// Links the routes of a search, inserts all who are left out in an order, as `search/anneal` says,
// and writes them back.
void insert_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int order);

}  // namespace tandem
