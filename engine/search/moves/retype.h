// Another type of vehicle for a route.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Gives the routes touched this turn the cheapest vehicles left, or others'.
void improve_types(const World& world, Searcher& searcher);

// Gives one of the routes touched this turn a vehicle of any type.
void draw_type(const World& world, Searcher& searcher);

// Gives the routes touched this turn the types that drive them at the least cost.
void cheapen_types(const World& world, Searcher& searcher);

}  // namespace tandem
