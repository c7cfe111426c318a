// The annealing over linked stops, and routes of a search as such and back.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// Returns how near neighbours are.
std::shared_ptr<const Nearness> measured_near(const ProblemData& data);

// Links the routes of a search as they are, and of its best plan.
void tie(const ProblemData& data, Searcher& searcher, Linked& linked);

// Lets the routes of a search, and of its best plan, be those that are linked.
void write_back(const ProblemData& data, Searcher& searcher, Linked& linked);

// Ruins and recreates `turns` times, as `search/anneal` says.
void anneal_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int turns);

// Links the routes of a search, inserts all who are left out in an order, as `search/anneal` says,
// and writes them back.
void insert_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int order);

}  // namespace tandem
