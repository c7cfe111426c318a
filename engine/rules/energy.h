// What flying takes of a drone's battery. What is `left` of it is `empty_battery` once more was
// asked of it than it held.
#pragma once

#include "problem/instance.h"

namespace tandem {

constexpr Int empty_battery = -1;

// What a drone came aboard with, and when.
struct Charge {
    Int kept, since;
};

// A quotient rounded down, by a divisor that is positive.
inline Int floor_quotient(Int dividend, Int divisor) {
    return dividend / divisor - (dividend % divisor < 0 ? 1 : 0);
}

// Whether a type's drones have a battery that limits them.
inline bool is_limited(const VehicleType& type) { return type.points > 0; }

// Whether waiting and serving at a customer take of the battery.
inline bool hovers_at_customers(const VehicleType& type) {
    return is_limited(type) && type.lands == 0;
}

// What a sortie may take.
inline Int battery_of(const VehicleType& type) { return type.battery; }

// Whether drones are charged aboard; else each launch has a full battery.
inline bool charges_aboard(const VehicleType& type) { return type.charge > 0; }

// What a drone has before the first sortie of its truck's trip, and since when.
inline Charge first_charge(const VehicleType& type, Int drone) {
    return {type.first_charge[drone], type.shift_earliest};
}

// What a drone has at an instant that came aboard at `since` with what it has `kept`.
inline Int charged(const VehicleType& type, Int kept, Int since, Int time) {
    const Int rest = std::max(Int{0}, time - since);
    // The product might not fit 64 bits.
    const bool full = rest > floor_quotient(type.battery - kept, type.charge);
    return full ? type.battery : kept + rest * type.charge;
}

// When a drone has what a flight takes that leaves so much `left` of a full battery; at once if
// that is more than it holds. It came aboard as for `charged`.
inline Int time_charged(const VehicleType& type, Int kept, Int since, Int left) {
    const Int missing = type.battery - left - kept;
    if (left < 0 || missing <= 0) return since;
    return since + (missing + type.charge - 1) / type.charge;
}

// How long it takes to have so much more, charged at full power while less is taken at another.
inline Int time_to_gain(const VehicleType& type, Int missing, Int saved) {
    return missing > 0 ? (missing + type.charge + saved - 1) / (type.charge + saved) : 0;
}

// A power with so much aboard, rounded down.
inline Int power_at(const VehicleType& type, const Int* powers, Int weight) {
    const Int* weights = type.weights;
    Int upper = 1;
    while (upper + 1 < type.points && weights[upper] < weight) ++upper;
    const Int lower = upper - 1;
    const Int rise = (powers[upper] - powers[lower]) * (weight - weights[lower]);
    const Int range = weights[upper] - weights[lower];
    return std::max(Int{0}, powers[lower] + floor_quotient(rise, range));
}

// What is left after a power was needed for so long.
inline Int discharge(Int left, Int power, Int duration) {
    if (left < 0 || power == 0) return left;
    // The product might not fit 64 bits.
    return duration > left / power ? empty_battery : left - power * duration;
}

// How long an empty drone flies on its battery; `far` if for ever.
inline Int longest_cruise(const VehicleType& type) {
    const Int power = type.cruise[0];
    return type.points == 0 || power == 0 ? far : type.battery / power;
}

// What is left after a leg, climb and descent included, with so much aboard.
inline Int after_leg(const VehicleType& type, Int left, Int weight, Int duration) {
    const Int flight = duration - type.climb_duration - type.descent_duration;
    left = discharge(left, power_at(type, type.cruise, weight), std::max(Int{0}, flight));
    if (type.climb_duration > 0) {
        left = discharge(left, power_at(type, type.climb, weight), type.climb_duration);
    }
    if (type.descent_duration > 0) {
        left = discharge(left, power_at(type, type.descent, weight), type.descent_duration);
    }
    return left;
}

// The power of hovering with so much aboard.
inline Int power_hovering(const VehicleType& type, Int weight) {
    return power_at(type, type.hover, weight);
}

// What is left after hovering with so much aboard.
inline Int after_hovering(const VehicleType& type, Int left, Int weight, Int duration) {
    return discharge(left, power_hovering(type, weight), duration);
}

// How long a drone can hover with so much aboard; `far` if for ever.
inline Int longest_hover(const VehicleType& type, Int left, Int weight) {
    const Int power = power_hovering(type, weight);
    return power == 0 ? far : floor_quotient(left, power);
}

}  // namespace tandem
