// Another type of vehicle for a route.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Give the routes touched this turn the cheapest vehicles left, or others'. In place.
void improve_types(const ProblemData& data, Searcher& searcher);

// Give one of the routes touched this turn a vehicle of any type. In place.
void draw_type(const ProblemData& data, Searcher& searcher);

// Give the routes touched this turn the types that drive them at the least cost. In place.
void cheapen_types(const ProblemData& data, Searcher& searcher);

}  // namespace tandem
