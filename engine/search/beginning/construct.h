// Plans by insertion alone, for the search to begin with.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Takes all routes apart.
void disband(const ProblemData& data, Searcher& searcher);

// Takes the route apart, without sorties, whose customers were left out after the fewest turns.
void give_up_route(const ProblemData& data, Searcher& searcher);

}  // namespace tandem
