// When trips of a timed route begin at the latest.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Let every trip begin as soon as possible. In place.
void clear_holds(const Route& route, View<Stop, 1> stops, View<const Trip, 1> trips);

// Let each trip of a timed route begin as late as costs nothing. In place; false if a rule is
// broken.
bool settle(const ProblemData& data, Route& route, View<Stop, 1> stops, View<const Trip, 1> trips,
            View<Sortie, 1> sorties);

}  // namespace tandem
