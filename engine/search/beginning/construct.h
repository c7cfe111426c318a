// Plans by insertion alone, for the search to begin with.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Takes all routes apart.
void disband(const ProblemData& data, Searcher& searcher);

}  // namespace tandem
