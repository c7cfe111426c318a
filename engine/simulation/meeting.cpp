#include "simulation/meeting.h"

#include "rules/drone_types.h"
#include "rules/hours.h"
#include "rules/launch_place.h"
#include "simulation/aboard.h"
#include "simulation/lags.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

constexpr Int not_yet = -1;  // take-off and recovery that have no time yet

// Whether a drone fetches what the truck delivers next, at `to`: it is to be aboard before.
bool is_awaited(const Setting& setting, const Drone& drone, Int to) {
    return is_pickup(setting.pair, drone.node) && setting.pair[drone.node].partner == to;
}

// Mark where drones are recovered: at `to` those that can and may fly there, while there is room
// for them in the air, else at `here`.
void mark_places(const Setting& setting, View<Drone, 1> drones, Int here, Int to) {
    Int room = waits_for_drones(setting.type) ? 0 : most_airborne(setting.type);
    if (!is_launch_place(setting.no_launch, to)) room = 0;
    for (Drone& drone : drones) {
        Recovery place = Recovery::aboard;
        if (drone.sortie != in_flight) {
            const DroneKind drone_kind = drone_kind_of(setting, drone.row);
            const bool meets = room > 0 && !is_awaited(setting, drone, to) &&
                               drone_kind.in_range(to, drone.node) &&
                               drone_kind.flight(here, drone.node, to).can_serve();
            place = meets ? Recovery::meet : Recovery::loop;
            if (meets) --room;
        }
        drone.place = Int(place);
    }
}

// Tell whether there is a battery for one more sortie by drones of a row on the last trip.
bool has_battery(const Setting& setting, const VehicleLog& log, Int row) {
    const Int first = log.trip[log.count.trips - 1].first_stop;
    Int flown = 1;
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        if (sortie.row == row && sortie.launch_stop >= first) ++flown;
    }
    return allows_sorties(setting.types[row], flown);
}

// Whether a drone waits that is recovered where it is launched.
bool is_loop_waiting(View<const Drone, 1> drones) {
    return std::ranges::any_of(drones, [](const Drone& drone) {
        return is_recovered(drone, Recovery::loop) && drone.takeoff == not_yet;
    });
}

// Where a drone that waits may be recovered if it is launched beside so many in the air: nowhere,
// here alone, or anywhere. Loops come first where there would be no room for them behind.
enum class Airspace { none, loops, all };

Airspace airspace_beside(const VehicleType& type, View<const Drone, 1> drones, Int airborne) {
    if (!limits_airborne(type)) return Airspace::all;
    if (airborne >= most_airborne(type)) return Airspace::none;
    if (airborne + 1 < most_airborne(type) || !is_loop_waiting(drones)) return Airspace::all;
    return Airspace::loops;
}

struct NextLaunch {
    Int drone;  // -1: none
    Int takeoff;
};

// When the launch to a customer can begin, the crew being free from `free` on.
Int ready_to_launch(const Setting& setting, const Vehicle& vehicle, Int node, Int free) {
    return hands_over(setting.pair, vehicle.node, node) ? std::max(free, vehicle.service_end)
                                                        : free;
}

// When the crew is free, how many launches of the trip come before, and who may be launched.
struct Crew {
    Int free, launched;
    Airspace airspace;
};

// The drone that can be launched first.
NextLaunch next_launch(const Setting& setting, const Vehicle& vehicle, View<const Drone, 1> drones,
                       Int to, const Crew& crew) {
    const auto [free, launched, airspace] = crew;
    const Int here = vehicle.node;
    NextLaunch next{-1, 0};
    if (airspace == Airspace::none) return next;
    for (Int d = 0; d < drones.size(); ++d) {
        const Drone& drone = drones[d];
        if (is_aboard(drone) || drone.takeoff != not_yet) continue;
        if (airspace == Airspace::loops && !is_recovered(drone, Recovery::loop)) continue;
        const DroneKind drone_kind = drone_kind_of(setting, drone.row);
        const Flight flight =
            drone_kind.flight(here, drone.node, is_recovered(drone, Recovery::meet) ? to : here);
        Int begin = ready_to_launch(setting, vehicle, drone.node, free);
        if (charges_aboard(drone_kind.type)) {
            begin = std::max(begin, flight.charged_launch(drone.kept, drone.since));
        }
        const Int soonest = flight.held_takeoff(take_off(drone_kind.type, begin, launched));
        if (next.drone < 0 || soonest < next.takeoff) next = {d, soonest};
    }
    return next;
}

// Time the flight of a drone that takes off at `here`.
void fly(const Setting& setting, Drone& drone, Int here, Int to, Int takeoff) {
    const DroneKind drone_kind = drone_kind_of(setting, drone.row);
    const Int end = is_recovered(drone, Recovery::meet) ? to : here;
    drone.takeoff = takeoff;
    drone.ready = drone_kind.ready(here, drone.node, takeoff);
    drone.back = drone.ready + drone_kind.home(drone.node, end);
    drone.lacking = 0;
    if (charges_aboard(drone_kind.type)) {
        drone.lacking =
            battery_of(drone_kind.type) - charged(drone_kind.type, drone.kept, drone.since,
                                                  launch_begin(drone_kind.type, takeoff, 1));
    }
}

// The drone in the air that is first back at `place`; -1 if there is none.
Int next_back(View<const Drone, 1> drones, Recovery place) {
    Int chosen = -1;
    for (Int d = 0; d < drones.size(); ++d) {
        const Drone& drone = drones[d];
        if (is_recovered(drone, place) && drone.takeoff != not_yet && drone.recovery == not_yet &&
            (chosen < 0 || drone.back < drones[chosen].back)) {
            chosen = d;
        }
    }
    return chosen;
}

// Recover a drone launched at `here` from `free` on, at `to`; return the end, -1 if it can't last.
Int bring_aboard(const Setting& setting, Drone& drone, Int here, Int to, Int free) {
    const DroneKind drone_kind = drone_kind_of(setting, drone.row);
    const Int begin = std::max(free, drone.back);
    const Int zones = drone_kind.zones_of(here, drone.node, to);
    if (unreachable(drone.back) || begin > calm_until(drone_kind.type, drone.takeoff, zones) ||
        !within_endurance(drone_kind.type, drone.takeoff, drone.back, begin)) {
        return -1;
    }
    const Flight flight{drone_kind.type, drone_kind.node[drone.node],
                        drone_kind.out(here, drone.node), drone.back - drone.ready};
    const Int left = flight.left_after(drone.takeoff, drone.ready, begin);
    if (left < drone.lacking) return -1;
    drone.left = left - drone.lacking;
    drone.recovery = begin;
    return recovery_end(drone_kind.type, begin);
}

// Launch all drones in flight from this stop, and recover those that loop.
//
// Returns when all is done, -1 if a loop can't be recovered within its endurance. What can be
// launched first is; loops are recovered behind, or while a launch is held back.
Int operate(const Setting& setting, const Vehicle& vehicle, View<Drone, 1> drones, Int to) {
    const Int here = vehicle.node;
    Int free = vehicle.crew, waiting = vehicle.flying, looping = 0, leaving = 0;
    Int before = vehicle.launched;
    for (Drone& drone : drones) drone.takeoff = drone.recovery = not_yet;
    while (waiting + looping > 0) {
        const Airspace airspace = airspace_beside(setting.type, drones, looping + leaving);
        const auto [launched, takeoff] =
            next_launch(setting, vehicle, drones, to, {free, before, airspace});
        Int begin = takeoff;
        if (launched >= 0) {
            begin = launch_begin(setting.types[drones[launched].row], takeoff, before);
        }
        const Int landed = looping > 0 ? next_back(drones, Recovery::loop) : -1;
        if (landed >= 0 &&
            (launched < 0 || (begin > free && std::max(free, drones[landed].back) <= begin))) {
            free = bring_aboard(setting, drones[landed], here, here, free);
            if (free < 0) return -1;
            --looping;
        } else {
            fly(setting, drones[launched], here, to, takeoff);
            free = takeoff;
            --waiting;
            ++before;
            ++(is_recovered(drones[launched], Recovery::loop) ? looping : leaving);
        }
    }
    return free;
}

// Recover the drones, launched at `here`, that the truck meets at `to` where it arrives.
//
// Returns when all are recovered. Where one can't be within its endurance: -1, and it is marked to
// loop instead.
Int meet(const Setting& setting, View<Drone, 1> drones, Int here, Int to, Int arrival) {
    Int free = arrival;
    for (Int landed = next_back(drones, Recovery::meet); landed >= 0;
         landed = next_back(drones, Recovery::meet)) {
        free = bring_aboard(setting, drones[landed], here, to, free);
        if (free < 0) {
            drones[landed].place = Int(Recovery::loop);
            return -1;
        }
    }
    return free;
}

// When a truck that leaves at `leave` arrives, set up, with the breaks that its driver takes.
struct Ride {
    Int arrival;  // -1: a break can't be taken
    Rests rests;
};

// The leg to a place that is left for at an instant, while drones are `out` or not.
struct NextLeg {
    Int to, leave;
    bool out;
};

Ride ride(const Setting& setting, const VehicleLog& log, const Vehicle& vehicle,
          View<const Drone, 1> drones, const NextLeg& leg) {
    const auto [to, leave, out] = leg;
    const Int here = vehicle.node;
    const bool asks = has_driving_rules(setting.type);
    if (!may_pause(setting.type)) return {travel_arrival(setting, here, to, leave), {}};
    const Int begin = log.trip[0].start;
    const Int setup = setup_after(setting.setup, here, to);
    const PausedLeg whole = paused_leg(setting, {{}, begin, here, to, leave});
    const bool is_customer = to >= setting.num_depots;
    const bool attends = asks && out && !may_rest_in_flights(setting.type);
    const auto ready = [&](Int arrival) {
        return is_customer && !setting.lag.empty()
                   ? logged_starts(log).ready_at(setting, to, log.count.stops, arrival + setup)
                   : arrival + setup;
    };
    const auto opens = [&](Int arrival) {
        return is_customer && !attends ? setting.node[to].start_of_service(ready(arrival)) - setup
                                       : arrival;
    };
    const auto leaves = [&](Int arrival) {
        return is_customer ? setting.served_at(to, ready(arrival)) : arrival;
    };
    const Int heavy =
        has_breaks(setting.type) ? too_heavy(setting, vehicle, drones, to, is_customer) : 0;
    const BreaksAhead pauses{vehicle.rested, heavy, begin};
    Int driven = 0;
    std::optional<Driver> driver = Driver{};
    if (asks) driver = driver_of(setting, log, driven);
    if (!driver) return {-1, {}};
    const std::optional<Rests> rests =
        Unforeseeing(setting.type, whole.by(*driver), opens, leaves).run(pauses);
    if (!rests || (attends && rests->any_unstated())) return {-1, {}};
    return {come(setting, {*rests, begin, here, to, leave}, *driver), *rests};
}

// Tell whether a drone in flight reaches its customer too late for a hard window.
bool any_late(const Setting& setting, Int here, View<const Drone, 1> drones) {
    return std::ranges::any_of(drones, [&](const Drone& drone) {
        if (is_aboard(drone)) return false;
        const DroneKind drone_kind = drone_kind_of(setting, drone.row);
        return drone_kind.node[drone.node].too_late(drone.takeoff +
                                                    drone_kind.out(here, drone.node));
    });
}

}  // namespace

void note_charges(const Setting& setting, const VehicleLog& log, View<Drone, 1> drones) {
    bool charging = false;
    for (Int d = 0; d < drones.size(); ++d) {
        const VehicleType& type = setting.types[drones[d].row];
        if (!charges_aboard(type)) continue;
        charging = true;
        const auto [kept, since] = first_charge(type, d);
        drones[d].kept = kept;
        drones[d].since = since;
    }
    if (!charging) return;
    const Int first = log.trip[log.count.trips - 1].first_stop;
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        if (sortie.launch_stop >= first && sortie.recovery_stop != in_flight) {
            drones[sortie.drone].kept = sortie.left;
            drones[sortie.drone].since = sortie.recovery_end;
        }
    }
}

Int next_drone(const Setting& setting, const VehicleLog& log, const Vehicle& vehicle,
               View<const Drone, 1> drones, Int node) {
    Int chosen = -1;
    if (!is_launch_place(setting.no_launch, vehicle.node)) return chosen;
    for (Int d = 0; d < drones.size(); ++d) {
        if (drones[d].sortie != in_flight) continue;
        if (!are_several(setting.type)) return d;
        const Int row = drones[d].row;
        if (!setting.can_fly(row, node) || !has_battery(setting, log, row)) continue;
        const DroneKind drone_kind = drone_kind_of(setting, row);
        if (!drone_kind.in_range(vehicle.node, node)) continue;
        if (drone_kind.flight(vehicle.node, node, vehicle.node).can_serve()) {
            return d;
        }
        if (chosen < 0) chosen = d;
    }
    return chosen;
}

bool order_may_change(const Setting& setting, Int node) {
    return are_several(setting.type) || limits_airborne(setting.type) ||
           is_pickup(setting.pair, node);
}

bool order_is_open(const Setting& setting, const Vehicle& vehicle) {
    return order_may_change(setting, vehicle.node) && vehicle.flying > 0 &&
           longest_work(setting.type) < unlimited;
}

Takeoffs takeoffs(const Setting& setting, const Vehicle& vehicle, const VehicleType& type,
                  Int node) {
    const Int last = take_off(type, ready_to_launch(setting, vehicle, node, vehicle.free),
                              vehicle.launched + vehicle.flying);
    if (!order_may_change(setting, vehicle.node)) return {last, last};
    return {last, take_off(type, ready_to_launch(setting, vehicle, node, vehicle.crew),
                           vehicle.launched)};
}

Leaving leave_for(const Setting& setting, const VehicleLog& log, const Vehicle& vehicle,
                  View<Drone, 1> drones, Int to) {
    const Leaving impossible{-1, -1, -1, {}};
    const Int here = vehicle.node;
    mark_places(setting, drones, here, to);
    if (vehicle.flying == 0) {
        const Int leave = std::max(vehicle.service_end, vehicle.free);
        const auto [arrival, rests] = ride(setting, log, vehicle, drones, {to, leave, false});
        return {vehicle.free, arrival, arrival, rests};
    }
    // Who can't be met loops, of which the others may be launched later, and so on.
    while (true) {
        const Int left = operate(setting, vehicle, drones, to);
        if (left < 0) return impossible;
        const Int leave = std::max(vehicle.service_end, left);
        const bool out = std::ranges::any_of(
            drones, [](const Drone& drone) { return is_recovered(drone, Recovery::meet); });
        const auto [arrival, rests] = ride(setting, log, vehicle, drones, {to, leave, out});
        if (arrival < 0) return impossible;
        const bool is_depot = to < setting.num_depots;
        const Int there = is_depot ? let_in(setting.type, setting.node, to, arrival) : arrival;
        const Int free = meet(setting, drones, here, to, there);
        if (free < 0) continue;
        return any_late(setting, here, drones) ? impossible : Leaving{left, arrival, free, rests};
    }
}

}  // namespace tandem
