// What the drone of a sortie meets.
#pragma once

#include "rules/drone_types.h"
#include "rules/leg.h"
#include "rules/window.h"
#include "search/route/layout.h"

namespace tandem {

// The row and the nodes of a sortie's drones, its legs to customers and those home.
struct SortieCraft {
    const VehicleType& type;
    NodesRows places;
    TravelLegs legs;
    TravelLegs homeward;
};

// Return what the drones of a row meet.
inline SortieCraft craft_at(const World& world, Int row) {
    const VehicleType& type = world.type[row];
    return {type, places_by_air(world.place, type), legs_of(world.leg, type.drone_travel),
            legs_of(world.leg, type.home_travel)};
}

}  // namespace tandem
