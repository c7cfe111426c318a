// The annealing over linked stops.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// Ruins and recreates `turns` times, as `search/anneal` says.
void anneal_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int turns);

}  // namespace tandem
