// When one vehicle's route happens: as soon as possible, and how late it may depart.
//
// A vehicle log lists what one vehicle does: trips, their stops, its sorties, and the launches and
// recoveries at each stop in order. `retime` times it; `latest_start` finds the latest beginning of
// a trip that costs nothing elsewhere.
#pragma once

#include "rules/driving.h"
#include "rules/flown_trip.h"
#include "simulation/state.h"

namespace tandem {

constexpr Int in_flight = -1;  // recovery stop of a sortie until it is recovered

// What drones meet whose type is at a row.
inline DroneKind drone_kind_of(const Setting& setting, Int row) {
    const VehicleType& type = setting.types[row];
    return {type,
            setting.nodes.by_air(type),
            setting.durations[type.drone_travel],
            setting.durations[type.home_travel],
            setting.distances[type.straight_travel],
            setting.zones};
}

// When a truck that leaves at `leave` arrives, by its speed at the time of day, and is set up.
inline Int travel_arrival(const Setting& setting, Int origin, Int to, Int leave) {
    return leg_end(setting.type, setting.profile_time, setting.profile_factor,
                   setting.drive(origin, to), leave) +
           setup_beside(setting.type, setting.setup, origin, to);
}

// How long the truck is on a leg, without setup, at full speed.
inline Int travel_of(const Setting& setting, Int origin, Int to) {
    const Int setup = is_steady(setting.type) ? setup_after(setting.setup, origin, to) : 0;
    return setting.drive(origin, to) - setup;
}

// A leg of the truck, likewise, as it counts where that is limited.
inline Leg leg_of(const Setting& setting, Int origin, Int to) {
    return {travel_of(setting, origin, to),
            setting.distances(limited_travel(setting.type), origin, to)};
}

// Whether a vehicle that has driven such legs may go home from a node.
inline bool may_drive_home(const Setting& setting, Leg legs, Int here) {
    return !limits_legs(setting.type) ||
           may_drive_all(setting.type, legs + leg_of(setting, here, setting.type.ends_at));
}

// Whether it may go to a node first.
inline bool may_drive_by(const Setting& setting, Leg legs, Int here, Int node) {
    return !limits_legs(setting.type) ||
           may_drive_home(setting, legs + leg_of(setting, here, node), node);
}

// How long its driver is at other work at a node, however long he waits; reloading isn't counted.
inline Int stood_at(const Setting& setting, Int node) {
    return node < setting.num_depots ? 0 : setting.node[node].service_duration();
}

// How fast a truck drives.
inline Speeds speeds_of(const Setting& setting) {
    return {setting.type, setting.profile_time, setting.profile_factor};
}

// A leg with breaks that is begun at `leave`, on a route that begins at `begin`.
struct BegunLeg {
    Rests rests;
    Int begin, origin, to, leave;
};

inline PausedLeg paused_leg(const Setting& setting, const BegunLeg& begun) {
    const auto& [rests, begin, origin, to, leave] = begun;
    return {speeds_of(setting),
            rests,
            begin,
            leave,
            travel_of(setting, origin, to),
            stood_at(setting, origin),
            setup_after(setting.setup, origin, to)};
}

// As `travel_arrival`, with breaks; -1 if one can't be taken.
//
// In place: what is counted of the driver, where that is followed.
inline Int come(const Setting& setting, const BegunLeg& begun, Driver& driver) {
    const auto& [rests, begin, origin, to, leave] = begun;
    if (!follows_driver(setting.type)) {
        if (rests.count() == 0) return travel_arrival(setting, origin, to, leave);
        if (rests_in_gaps(setting.type)) {
            return travel_arrival(setting, origin, to, leave) + duration_of(setting.type, rests);
        }
    }
    return paused_leg(setting, begun).end(driver).value_or(-1);
}

// Whether the truck isn't on legs for too long by the log, if that hangs on when they are driven.
bool has_travelled_within(const Setting& setting, const VehicleLog& log);

// What is counted of the driver once the last stop is reached; `driven` takes how long it has been
// at the wheel on the way. Nothing if it lacks a rest.
std::optional<Driver> driver_of(const Setting& setting, const VehicleLog& log, Int& driven);

// Whether the driver of a route that ends at its last stop has rested as rules ask.
bool has_rested(const Setting& setting, const VehicleLog& log);

// How long the breaks are that a vehicle has taken and that don't count in its working duration.
inline Int unpaid_in(const Setting& setting, const VehicleLog& log) {
    if (!has_breaks(setting.type)) return 0;
    Int unpaid = 0;
    for (const LoggedStop& stop : log.stop.first(log.count.stops)) {
        unpaid += unpaid_of(setting.type, Rests(stop.rests));
    }
    return unpaid;
}

// Whether all rules hold of trips timed anew: who comes too late won't be sooner if they begin
// later; what lasts too long may do less.
enum class Retimed { kept, too_late, too_long };

// Time the trips from `first_trip` on, the first begun at `start`, all else without delay.
//
// The log takes new times, void if somebody comes too late.
Retimed retime(const Setting& setting, VehicleLog& log, Int first_trip, Int start);

// Tell whether a later start of `first_trip` costs nothing: no more lateness, no longer sortie, no
// later end than logged, and no parcel too long aboard. Writes trial times of sorties alone.
bool costs_nothing(const Setting& setting, VehicleLog& log, Int first_trip, Int start);

// By how much a parcel is too long under way that is delivered then, as far as it is picked up
// before a stop, or by drones; negative if it isn't yet.
Int excess_under_way(const Setting& setting, const VehicleLog& log, Int delivery, Int behind,
                     Int start);

// Whether trips may have to be held back.
inline bool holds_count(const Setting& setting) {
    return some_limited(setting.max_time_aboard) || some_limited(setting.between) ||
           !setting.lag.empty() || bounds_trips(setting.type);
}

// By how much later the last trip has to begin, so that no parcel is too long aboard, and nobody
// who flies by itself too long in the air; at most 0 if it needn't, `far` if that doesn't help.
Int most_excess(const Setting& setting, const VehicleLog& log);

// In how much time the last trip, begun later, meets other windows or speeds; `far` if never.
Int time_to_turn(const Setting& setting, const VehicleLog& log);

// How much later the last trip of who flies by itself has to begin for calm; 0 if it needn't, `far`
// if that doesn't help.
Int waits_for_calm(const Setting& setting, const VehicleLog& log);

// The latest start of a trip that costs nothing; `known` is one that costs nothing.
Int latest_start(const Setting& setting, VehicleLog& log, Int trip, Int known);

// When truck or drone first leaves the depot if the first trip begins at `start`; if its work
// counts from an instant, however late it leaves: that instant.
Int first_departure(const Setting& setting, const VehicleLog& log, Int start);

// The start of the first trip by which none leaves the depot before `departure`.
Int start_to_depart(const Setting& setting, const VehicleLog& log, Int departure);

// A start of the first trip that costs nothing and keeps the working duration, or `known`.
//
// Only the soonest that would keep it is tried: mostly all before one that costs nothing cost
// nothing, but where batteries are charged, not all do.
Int start_within_work(const Setting& setting, VehicleLog& log, Int known);

}  // namespace tandem
