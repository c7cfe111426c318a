// What a flight may last, and all instants of one but those on the way.
//
// `launched` is how many launches of the trip come before one.
#pragma once

#include "rules/energy.h"
#include "rules/load.h"

namespace tandem {

// Whether a flight duration marks a flight that can't be flown.
inline bool unreachable(Int duration) { return duration >= unreachable_leg; }

// Whether a customer may lie too far from where a drone is launched or recovered.
inline bool limits_range(const VehicleType& type) { return type.max_range < unlimited; }

// Whether a customer so far away, straight, may be flown to.
inline bool within_range(const VehicleType& type, Int distance) {
    return distance <= type.max_range;
}

// How many drones of a truck may be in the air at once.
inline Int most_airborne(const VehicleType& type) { return type.max_airborne; }

// Whether that is fewer than it has.
inline bool limits_airborne(const VehicleType& type) { return type.max_airborne < type.drones; }

// Whether a truck stands still while any of its drones is out.
inline bool waits_for_drones(const VehicleType& type) { return type.truck_waits != 0; }

// Whether there are hours in which no drone may be in the air, or none that comes to some zones.
inline bool storms_sometime(const VehicleType& type) { return type.storms > 0; }

// The zones with hours that hold a node, as bits. `zones` has a row for each node, and none where
// there are no such zones.
inline Int zones_at(View<const Int, 1> zones, Int node) { return zones.empty() ? 0 : zones[node]; }

// Whether a storm counts for a flight that comes to these zones: one of the wind for any.
inline bool storm_counts(const VehicleType& type, Int storm, Int zones) {
    return type.storm_zones[storm] == 0 || (type.storm_zones[storm] & zones) != 0;
}

// The first storm for a flight that isn't over at an instant, none behind the last.
inline Int storm_behind(const VehicleType& type, Int time, Int zones) {
    Int storm = 0;
    while (storm < type.storms &&
           (type.storm_until[storm] <= time || !storm_counts(type, storm, zones))) {
        ++storm;
    }
    return storm;
}

// Until when a drone must be recovered that takes off at `takeoff`: when it storms next.
inline Int calm_until(const VehicleType& type, Int takeoff, Int zones) {
    const Int storm = storm_behind(type, takeoff, zones);
    return storm < type.storms ? type.storm_from[storm] : far;
}

// When a drone takes off for calm that can at `takeoff`, and is back at `back` then: at once, or as
// the next storm is over, if ever.
inline Int calm_takeoff(const VehicleType& type, Int takeoff, Int back, Int zones) {
    const Int storm = storm_behind(type, takeoff, zones);
    if (storm == type.storms || back <= type.storm_from[storm]) return takeoff;
    return type.storm_until[storm] < unlimited ? type.storm_until[storm] : takeoff;
}

// Whether it matters which launch is the first of a trip.
inline bool launches_differ(const VehicleType& type) {
    return type.relaunch_duration != type.launch_duration;
}

// How long a launch takes: before all but a trip's first, a battery is swapped.
inline Int launch_duration(const VehicleType& type, Int launched) {
    return launched > 0 ? type.relaunch_duration : type.launch_duration;
}

// When a drone is in the air whose launch begins at `begin`.
inline Int take_off(const VehicleType& type, Int begin, Int launched) {
    return begin + launch_duration(type, launched);
}

// When the launch begins of a drone that takes off at `takeoff`.
inline Int launch_begin(const VehicleType& type, Int takeoff, Int launched) {
    return takeoff - launch_duration(type, launched);
}

// When a drone is aboard whose recovery begins at `begin`.
inline Int recovery_end(const VehicleType& type, Int begin) {
    return begin + type.recovery_duration;
}

// When the recovery begins of a drone that is aboard at `end`.
inline Int recovery_begin(const VehicleType& type, Int end) { return end - type.recovery_duration; }

// When a drone takes off at the latest whose truck would leave at `leave` without it, if no window
// holds it back. A usual launch is taken to be over by then, a swap to begin, and where it has to
// be charged, or to wait for calm, nothing is known.
inline Int gone_by(const VehicleType& type, Int leave) {
    if (charges_aboard(type) || storms_sometime(type)) return far;
    return launches_differ(type) ? take_off(type, leave, 1) : leave;
}

// How long launch and recovery take together, but for a trip's first launch.
inline Int handling_duration(const VehicleType& type) {
    return type.relaunch_duration + type.recovery_duration;
}

// Whether a recovery, or else a launch, ends as it begins.
inline bool takes_no_time(const VehicleType& type, bool is_recovery, Int launched) {
    return (is_recovery ? type.recovery_duration : launch_duration(type, launched)) == 0;
}

// When a drone is where `home` leads to that is at a customer as the window opens in which whoever
// comes at `arrival` is served.
inline Int earliest_back(Windows place, Int arrival, Int home) {
    return place.opening(arrival) + place.service_duration() + home;
}

// In how long after its take-off windows may let a drone be back. Its endurance; and where it
// hovers before windows, what it can beside the `flight`, services included, after which so much is
// `left` of its battery, with the most `weight` aboard.
inline Int longest_hold(const VehicleType& type, Int flight, Int left, Int weight) {
    if (!hovers_at_customers(type) || left < 0) return type.endurance;
    return std::min(type.endurance, flight + longest_hover(type, left, weight));
}

// The earliest take-off after which a drone can be back within a limit. `back` is the earliest that
// windows allow; the flight itself may be too long.
inline Int held_until(Int back, Int limit) { return back - limit; }

// Whether a flight that takes so long in all is within the endurance if nothing waits. None is that
// leads where nobody can fly.
inline bool can_last(const VehicleType& type, Int duration) { return duration <= type.endurance; }

// A flight to one customer: the drone, the customer by the drones' table of nodes, and how long the
// legs there and to the recovery take.
struct Flight {
    const VehicleType& type;
    Windows place;
    Int out, home;
    Int zones = 0;  // with hours, that hold where it begins, whom it serves, or where it ends

    // How long it takes if nothing waits.
    Int duration() const { return out + place.service_duration() + home; }

    // When the customer is served of a drone that takes off then.
    Int served_at(Int takeoff) const { return place.end_of_service(takeoff + out); }

    // What it leaves of a full battery if nothing waits.
    Int left() const {
        const Int weight = weight_flown_out(place);
        Int left = after_leg(type, battery_of(type), weight, out);
        if (hovers_at_customers(type)) {
            left = after_hovering(type, left, weight, place.service_duration());
        }
        return after_leg(type, left, weight_flown_back(place), home);
    }

    // When the drone takes off that can at `takeoff`: then, or held back.
    Int held_takeoff(Int takeoff) const {
        Int limit = type.endurance;
        if (hovers_at_customers(type)) {
            limit = longest_hold(type, duration(), left(),
                                 std::max(weight_flown_out(place), weight_flown_back(place)));
        }
        while (true) {
            Int held = held_until(earliest_back(place, takeoff + out, home), limit);
            if (held <= takeoff && storms_sometime(type)) {
                held = calm_takeoff(type, takeoff, served_at(takeoff) + home, zones);
            }
            if (held <= takeoff) return takeoff;
            takeoff = held;
        }
    }

    // Whether it is within endurance and energy if nothing waits.
    bool can_serve() const {
        return can_last(type, duration()) && (!is_limited(type) || left() >= 0);
    }

    // Whether energy lasts for so long a wait to be recovered.
    bool can_wait(Int waiting) const {
        return !is_limited(type) ||
               after_hovering(type, left(), weight_flown_back(place), waiting) >= 0;
    }

    // From when on the launch may begin of a drone that is charged aboard since then, with what it
    // has kept; at once if it can't be.
    Int charged_launch(Int kept, Int since) const {
        return time_charged(type, kept, since, left());
    }

    // What it leaves of a full battery, waiting included, if the customer is served by then;
    // nothing where none limits it.
    Int left_after(Int takeoff, Int served, Int recovery_start) const {
        if (!is_limited(type)) return 0;
        Int rest = left();
        if (hovers_at_customers(type)) {
            const Int waited = served - place.service_duration() - takeoff - out;
            rest = after_hovering(type, rest, weight_flown_out(place), waited);
        }
        return after_hovering(type, rest, weight_flown_back(place), recovery_start - served - home);
    }
};

// Until when the endurance counts: as a drone is back, or as its recovery begins. Of one sortie, or
// of several at once.
template <class Instant>
Instant counted_until(const VehicleType& type, const Instant& back, const Instant& recovery_start) {
    return type.waiting_counts != 0 ? recovery_start : back;
}

// Whether a sortie, back at `back` and recovered from then on, is short enough.
inline bool within_endurance(const VehicleType& type, Int takeoff, Int back, Int recovery_start) {
    return can_last(type, counted_until(type, back, recovery_start) - takeoff);
}

// How long `counted_until` may be from the take-off.
inline Int endurance_of(const VehicleType& type) { return type.endurance; }

// How long a drone may fly with nothing aboard, for those who only want an idea.
inline Int longest_flight(const VehicleType& type) {
    return std::min(type.endurance, longest_cruise(type));
}

// For which arrivals at a block's beginning it is at most `limit` from one instant to another,
// which is never before it; `far` and `none` if there is none. Both are sums with `d` for arrivals
// past `begin.c - begin.d`, so that what lasts too long by `d` must begin before.
inline Interval lasting_within(Int limit, TimeSegment begin, TimeSegment end) {
    if (end.d - begin.d <= limit) {
        return {end.c - begin.c > limit ? end.c - limit - begin.d : none, far};
    }
    if (end.c - begin.c > limit) return {far, none};
    return {none, limit + begin.c - end.d};
}

}  // namespace tandem
