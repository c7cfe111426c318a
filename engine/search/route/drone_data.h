// What the drone of a sortie meets.
#pragma once

#include "rules/drone_types.h"
#include "rules/flight.h"
#include "search/route/layout.h"

namespace tandem {

// The row and the nodes of a sortie's drones, its legs to customers and those home.
struct DroneData {
    const VehicleType& type;
    NodeTable places;
    TravelLegs legs;
    TravelLegs homeward;
};

// Whether drones of a type may serve a customer who are launched or recovered at a node.
[[gnu::always_inline]] inline bool in_range(const ProblemData& data, const VehicleType& type,
                                            Int node, Int customer) {
    return !limits_range(type) ||
           within_range(type,
                        leg(legs_of(data.leg, type.straight_travel), node, customer).distance);
}

// Return what the drones of a row meet.
inline DroneData drone_data_at(const ProblemData& data, Int row) {
    const VehicleType& type = data.type[row];
    return {type, data.place.by_air(type), legs_of(data.leg, type.drone_travel),
            legs_of(data.leg, type.home_travel)};
}

}  // namespace tandem
