// Simulated annealing by ruin and recreate among linked stops. As `moves/anneal`.
#pragma once

#include "search/linked/layout.h"

namespace tandem {

// Ruins and recreates `turns` times.
//
// A turn is given up once what it has inserted costs more than would be accepted; once the search
// must end, as if it had not begun.
void anneal_linked(const World& world, Searcher& searcher, Linked& linked, Int turns);

}  // namespace tandem
