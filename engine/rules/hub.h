// What vehicles that fly share at a depot: each trip takes a battery, or the vehicle is charged
// before it at one of so many places. Rollouts give such a place away for all day.
#pragma once

#include "problem/instance.h"

namespace tandem {

// Whether each trip of a type takes a battery of the depot where it begins.
inline bool takes_batteries(const VehicleType& type) { return type.takes_batteries != 0; }

// Whether vehicles of a type may have to wait for a place to charge.
inline bool shares_chargers(const VehicleType& type) { return type.shares_chargers != 0; }

// Whether a depot has a place to charge for one vehicle more, with so many there.
inline bool has_free_charger(const Hub& hub, Int charged) { return charged < hub.chargers; }

// Whether a vehicle that makes so many trips needs a place to charge at its depot.
inline bool needs_charger(const VehicleType& type, Int trips) {
    return trips > type.trips_uncharged;
}

// Whether a depot has what one trip more takes that begins there.
inline bool has_battery_for(const VehicleType& type, const Hub& hub, Int taken) {
    return !takes_batteries(type) || taken < hub.batteries;
}

// Whether a depot has what one trip more takes of a vehicle that is at home there and has made so
// many; `taken` by others.
inline bool has_charger_for(const VehicleType& type, const Hub& hub, Int trips, Int taken) {
    return needs_charger(type, trips) || !needs_charger(type, trips + 1) || taken < hub.chargers;
}

// Whether a vehicle that has made so many trips may begin one more at a depot that isn't its own:
// no place there is given away.
inline bool charges_away(const VehicleType& type, const Hub& hub, Int trips) {
    return !needs_charger(type, trips + 1) || hub.chargers >= unlimited;
}

}  // namespace tandem
