// Routes of a search as linked stops, and back.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// Writes how near neighbours are.
void measure_near(const ProblemData& data, Linked& linked);

// Links the routes of a search as they are, and of its best plan.
void tie(const ProblemData& data, Searcher& searcher, Linked& linked);

// Lets the routes of a search, and of its best plan, be those that are linked.
void write_back(const ProblemData& data, Searcher& searcher, Linked& linked);

}  // namespace tandem
