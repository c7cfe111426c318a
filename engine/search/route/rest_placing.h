// Where those rest on a route whom rules ask to: by dynamic programming along the route.
//
// Of two ways to have come somewhere, one is no worse if the truck is there as soon, with no more
// driven or worked since the last rest, and the same drones out since the same instants. A way that
// can't end better than one that is known is given up: what is left lasts as long as its legs,
// services and as few rests as rules allow. Often that is known who rests as late as allowed.
#pragma once

#include "rules/driving.h"
#include "search/route/layout.h"

namespace tandem {

// When a route ends that nobody rests on, and how long it works then.
struct LeastWork {
    Int end;
    Int working;
};

// Return how long the breaks behind a stop make its gap.
Int resting_in_gap(const VehicleType& type, const Stop& stop);

// Return how long the leg from a stop is, without setup and rests.
Int driving_from(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops,
                 Int p);

// Let nobody rest behind a stop. In place.
void forget_rests(const VehicleType& type, Stop& stop);

// Let nobody rest on a route. In place.
void clear_rests(const VehicleType& type, View<Stop, 1> stops);

// Write the rests of the route whose work costs least, and of these that which ends first; with
// breaks, that which ends first. In place; false if a rule is broken.
bool place_rests(const ProblemData& data, const Route& route, View<Stop, 1> stops,
                 View<Sortie, 1> sorties, const LeastWork& least);

}  // namespace tandem
