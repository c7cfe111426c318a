// When a depot is open: trips leave it and return to it then, and reload there.
//
// Types whose shift keeps all of that anyway look at no hours.
#pragma once

#include "rules/window.h"

namespace tandem {

// Whether hours of depots limit trips of a type more than its shift does.
inline bool keeps_hours(const VehicleType& type) { return type.keeps_hours != 0; }

// When whoever comes to a depot at `arrival` is let in.
inline Int let_in(const VehicleType& type, NodeTable places, Int depot, Int arrival) {
    return keeps_hours(type) ? places[depot].start_of_service(arrival) : arrival;
}

// The last departure from a depot, and the last return to it.
inline Int closes_at(const VehicleType& type, NodeTable places, Int depot) {
    return keeps_hours(type) ? places[depot].latest_allowed() : far;
}

}  // namespace tandem
