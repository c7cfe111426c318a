// Whether the trips of a route serve whole shipments.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Tell whether each trip serves whole shipments, each picked up first, and unloads from a stack
// what lies on it.
bool keeps_pairs(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                 View<const Trip, 1> trips, View<const Sortie, 1> sorties);

}  // namespace tandem
