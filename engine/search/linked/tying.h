// Routes of a search as linked stops, and back.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// Returns how near neighbours are.
std::shared_ptr<const Nearness> measured_near(const ProblemData& data);

// Links the routes of a search as they are, and of its best plan.
void tie(const ProblemData& data, Searcher& searcher, Linked& linked);

// Lets the routes of a search, and of its best plan, be those that are linked.
void write_back(const ProblemData& data, Searcher& searcher, Linked& linked);

}  // namespace tandem
