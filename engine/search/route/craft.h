// What the drone of a sortie meets.
#pragma once

#include "rules/drone_types.h"
#include "rules/leg.h"
#include "rules/window.h"
#include "search/route/layout.h"

namespace tandem {

// What drones on a truck of type `k` meet.
struct Skies {
    const World& world;
    Int k;
};

inline Skies skies_of(const World& world, Int k) { return {world, k}; }

// The row and the nodes of a sortie's drones, its legs to customers and those home.
struct SortieCraft {
    const VehicleType& type;
    NodesRows places;
    TravelLegs legs;
    TravelLegs homeward;
};

inline SortieCraft craft_of(const Skies& skies, const Sortie& sortie) {
    const World& world = skies.world;
    const VehicleType& type = world.type[row_of_drone(world.type, skies.k, sortie.drone)];
    return {type, places_by_air(world.place, type), legs_of(world.leg, type.drone_travel),
            legs_of(world.leg, type.home_travel)};
}

}  // namespace tandem
