// What the drone of a sortie meets.
#pragma once

#include "rules/drone_types.h"
#include "rules/leg.h"
#include "rules/window.h"
#include "search/route/layout.h"

namespace tandem {

// The row and the nodes of a sortie's drones, its legs to customers and those home.
struct DroneData {
    const VehicleType& type;
    NodeTable places;
    TravelLegs legs;
    TravelLegs homeward;
};

// Return what the drones of a row meet.
inline DroneData drone_data_at(const ProblemData& data, Int row) {
    const VehicleType& type = data.type[row];
    return {type, data.place.by_air(type), legs_of(data.leg, type.drone_travel),
            legs_of(data.leg, type.home_travel)};
}

}  // namespace tandem
