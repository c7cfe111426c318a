// How long a vehicle works past what is usual, and how much a trip may have. A type's limits of the
// end and of the working duration are those with all the overtime allowed.
#pragma once

#include <algorithm>

#include "problem/instance.h"

namespace tandem {

// How long a vehicle works that ends at `end`, and works so long, past what is usual: past the
// shift or its working duration, the longer.
inline Int overtime(const VehicleType& type, Int end, Int working) {
    return std::max(Int{0}, std::max(end - type.usual_end, working - type.usual_working));
}

// When the shift ends without overtime.
inline Int usual_end(const VehicleType& type) { return type.usual_end; }

// The longest working duration without overtime.
inline Int usual_working(const VehicleType& type) { return type.usual_working; }

// How many customers the truck may serve itself on a trip, `unlimited` if any number.
inline Int most_stops(const VehicleType& type) { return type.max_stops; }

// Whether the truck may serve so many customers itself on a trip.
inline bool allows_stops(const VehicleType& type, Int count) { return count <= type.max_stops; }

// Whether so many sorties may be flown on a trip.
inline bool allows_sorties(const VehicleType& type, Int count) { return count <= type.max_sorties; }

}  // namespace tandem
