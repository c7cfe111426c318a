// Searches as C knows them.
#pragma once

#include "search/scratch.h"

struct tandem_search final : tandem::Searcher {
    using Searcher::Searcher;
};

namespace tandem {

// The search, with room for what it writes down while it looks, for one call at a time.
Searcher& looking(const ProblemData& data, Searcher& searcher);

}  // namespace tandem
