// When a depot is open: trips leave it and return to it then, and reload there.
//
// Types whose shift keeps all of that anyway look at no hours.
#pragma once

#include "rules/flown_trip.h"

namespace tandem {

// Whether hours of depots limit trips of a type more than its shift does.
inline bool keeps_hours(const VehicleType& type) { return type.keeps_hours != 0; }

// When whoever comes to a depot at `arrival` is let in.
inline Int let_in(const VehicleType& type, NodeTable places, Int depot, Int arrival) {
    return keeps_hours(type) ? places[depot].start_of_service(arrival) : arrival;
}

// The last return to a depot.
inline Int closes_at(const VehicleType& type, NodeTable places, Int depot) {
    return keeps_hours(type) ? places[depot].latest_allowed() : far;
}

// The last departure from a depot, the take-off of who flies by itself.
inline Int leaves_by(const VehicleType& type, NodeTable places, Int depot) {
    const Int closes = closes_at(type, places, depot);
    return flies(type) ? closes - launch_duration(type, 0) : closes;
}

}  // namespace tandem
