#include "simulation/transition.h"

#include <utility>

#include "rules/drone_types.h"
#include "rules/holding.h"
#include "rules/hours.h"
#include "rules/start.h"
#include "simulation/aboard.h"
#include "simulation/lags.h"
#include "simulation/simulator.h"
#include "simulation/vehicle_log.h"

namespace tandem {
namespace {

void log_op(VehicleLog& log, Int stop, Int sortie, bool is_recovery) {
    log.op.at(log.count.ops++) = {stop, sortie, is_recovery};
}

void log_stop(VehicleLog& log, Int node, Int arrival, Int start, Int leave) {
    log.stop.at(log.count.stops++) = {node, arrival, start, leave, 0};
}

// Append the recoveries decided by `leave_for`, in order.
void log_recoveries(const Setting& setting, VehicleLog& log, View<Drone, 1> drones, Recovery place,
                    Int stop) {
    const auto is_sooner = [](const Drone& one, const Drone& other) {
        return std::pair(one.recovery, one.back) < std::pair(other.recovery, other.back);
    };
    while (true) {
        Drone* chosen = nullptr;
        for (Drone& drone : drones) {
            if (is_recovered(drone, place) && (chosen == nullptr || is_sooner(drone, *chosen))) {
                chosen = &drone;
            }
        }
        if (chosen == nullptr) return;
        LoggedSortie& sortie = log.sortie[chosen->sortie];
        sortie.recovery_stop = stop;
        sortie.recovery_start = chosen->recovery;
        sortie.recovery_end = recovery_end(setting.types[chosen->row], chosen->recovery);
        sortie.left = chosen->left;
        log_op(log, stop, chosen->sortie, true);
        chosen->place = Int(Recovery::aboard);
        chosen->sortie = in_flight;
    }
}

// When a launch or recovery begins and ends, as if each launch were the trip's first: later than
// that none begins, so that the order is the same.
std::pair<Int, Int> op_times(const Setting& setting, const VehicleLog& log, const Operation& op) {
    const LoggedSortie& sortie = log.sortie[op.sortie];
    if (op.is_recovery != 0) return {sortie.recovery_start, sortie.recovery_end};
    return {launch_begin(setting.types[sortie.row], sortie.takeoff, 0), sortie.takeoff};
}

// Whether an operation comes before another. Of those at once, a drone comes back before another
// is launched where there may be no room for both in the air.
bool comes_before(const Setting& setting, const VehicleLog& log, const Operation& op,
                  const Operation& other) {
    const auto times = op_times(setting, log, op), others = op_times(setting, log, other);
    if (times != others || !limits_airborne(setting.type)) return times < others;
    return op.is_recovery != 0 && other.is_recovery == 0 && op.sortie != other.sortie;
}

// Put the launches and recoveries from row `first` on, all at one stop, in order.
void sort_ops(const Setting& setting, VehicleLog& log, Int first) {
    for (Int last = first + 1; last < log.count.ops; ++last) {
        for (Int row = last;
             row > first && comes_before(setting, log, log.op[row], log.op[row - 1]); --row) {
            std::swap(log.op[row], log.op[row - 1]);
        }
    }
}

// Write what `leave_for` decided of the sorties in flight.
void log_sorties(const Setting& setting, VehicleLog& log, const Vehicle& vehicle,
                 View<Drone, 1> drones) {
    const Int here = log.count.stops - 1;
    const Int first = log.count.ops - vehicle.flying;
    for (const Drone& drone : drones) {
        if (is_aboard(drone)) continue;
        LoggedSortie& sortie = log.sortie[drone.sortie];
        const DroneKind drone_kind = drone_kind_of(setting, drone.row);
        sortie.takeoff = drone.takeoff;
        sortie.arrival = drone.takeoff + drone_kind.out(vehicle.node, drone.node);
        sortie.start = setting.node[drone.node].start_of_service(sortie.arrival);
        sortie.ready = drone.ready;
    }
    log_recoveries(setting, log, drones, Recovery::loop, here);
    sort_ops(setting, log, first);
    log_recoveries(setting, log, drones, Recovery::meet, here + 1);
}

// Begin a trip of the idle vehicle as soon as the parcel is released.
void begin_trip(OpenVehicle& open, Int release) {
    auto& [setting, vehicle, log, drones] = open;
    const Int start = std::max(vehicle.next_start, release);
    const Int leave = leaves_first(setting.type, start);
    log.trip.at(log.count.trips++) = {log.count.stops, log.count.ops, release, start};
    log_stop(log, vehicle.node, start, start, leave);
    if (log.count.trips == 1) {
        vehicle.start_best = start;
        vehicle.departure_best = first_departure(setting, log, start);
    }
    vehicle.idle = 0;
    vehicle.service_end = leave;
    vehicle.free = vehicle.crew = start;
}

// Write until when the vehicle is busy at its last stop, by the log.
void note_times(OpenVehicle& open) {
    const auto& [setting, vehicle, log, drones] = open;
    const Int here = log.count.stops - 1;
    const LoggedStop& stop = log.stop[here];
    const bool is_depot = stop.node < setting.num_depots;
    vehicle.service_end = is_depot ? leaves_first(setting.type, stop.start)
                                   : stop.start + setting.node[stop.node].service_duration();
    vehicle.free = vehicle.crew = is_depot ? stop.start : stop.arrival;
    for (Int last = log.count.ops - 1; last >= 0 && log.op[last].stop == here; --last) {
        const LoggedSortie& sortie = log.sortie[log.op[last].sortie];
        if (log.op[last].is_recovery != 0) {
            vehicle.crew = std::max(vehicle.crew, sortie.recovery_end);
            vehicle.free = std::max(vehicle.free, sortie.recovery_end);
        } else {
            vehicle.free = std::max(vehicle.free, sortie.takeoff);
        }
    }
}

// Let the trip begin no earlier than `release`.
Retimed hold_trip(OpenVehicle& open, Int release) {
    auto& [setting, vehicle, log, drones] = open;
    LoggedTrip& trip = log.trip[log.count.trips - 1];
    trip.release = std::max(trip.release, release);
    if (trip.start >= release) return Retimed::kept;
    const Retimed held = retime(setting, log, log.count.trips - 1, release);
    if (held != Retimed::kept) return held;
    note_charges(setting, log, drones);
    note_times(open);
    for (Drone& drone : drones) {
        if (drone.sortie == in_flight) continue;
        drone.takeoff = log.sortie[drone.sortie].takeoff;
        drone.ready = log.sortie[drone.sortie].ready;
    }
    if (log.count.trips == 1) vehicle.start_best = std::max(vehicle.start_best, release);
    return Retimed::kept;
}

// Hold the trip until nothing lasts too long, and no storm is met; false if that can't be.
bool keep_fresh(OpenVehicle& open) {
    auto& [setting, vehicle, log, drones] = open;
    if (!holds_count(setting)) return true;
    Retimed held = Retimed::kept;
    Holding holding(log.count.stops - log.trip[log.count.trips - 1].first_stop);
    while (true) {
        const Int excess = most_excess(setting, log);
        const Int wait = excess > 0 ? holding.wait(excess, time_to_turn(setting, log))
                                    : waits_for_calm(setting, log);
        if (wait == 0) return held == Retimed::kept;
        if (wait == far || held == Retimed::too_late) return false;
        // Drones that don't last then may do if the trip is held even longer.
        held = hold_trip(open, log.trip[log.count.trips - 1].start + wait);
    }
}

// Note when service begins at those of orders across vehicles. In place.
void note_starts(const OpenVehicle& open, View<Int, 1> starts) {
    for (const LoggedStop& stop : open.log.stop.first(open.log.count.stops)) {
        if (stop.node >= open.setting.num_depots && is_bound(open.setting.across, stop.node)) {
            starts[stop.node] = stop.start;
        }
    }
}

// Whether the truck leaves its last stop before that closes, if it is a depot.
bool left_in_hours(const Setting& setting, const VehicleLog& log) {
    const LoggedStop& here = log.stop[log.count.stops - 1];
    return here.node >= setting.num_depots ||
           here.leave <= leaves_by(setting.type, setting.node, here.node);
}

// End the trip at a depot.
void come_home(const Setting& setting, Vehicle& vehicle) {
    vehicle.idle = 1;
    vehicle.distance = vehicle.launched = 0;
    vehicle.next_start = vehicle.free + setting.type.reload_duration;
    vehicle.barred_on_trip = 0;
    vehicle.parted |= std::exchange(vehicle.kept_on_trip, 0);
    empty(setting.type, vehicle);
}

}  // namespace

OpenVehicle open_vehicle_of(const Instance& instance, Int b, const State& state, Int row) {
    Vehicle& vehicle = state.vehicle[row];
    Setting setting(instance, b, vehicle.type);
    setting.starts = state.starts[row];
    return {setting, vehicle, log_of(state.log, row), state.drone[row].first(setting.type.drones)};
}

void improve_departure(OpenVehicle& open) {
    auto& [setting, vehicle, log, drones] = open;
    if (longest_work(setting.type) < unlimited) {
        vehicle.start_best = latest_start(setting, log, 0, vehicle.start_best);
    }
    vehicle.departure_best = first_departure(setting, log, vehicle.start_best);
}

void board(const OpenVehicle& open, Drone& drone, Int sortie, Int node, Int takeoff) {
    const auto& [setting, vehicle, log, drones] = open;
    const DroneKind drone_kind = drone_kind_of(setting, drone.row);
    drone.sortie = sortie;
    drone.node = node;
    drone.takeoff = takeoff;
    drone.ready = drone_kind.ready(vehicle.node, node, takeoff);
    ++vehicle.flying;
    vehicle.free = takeoff;
}

bool launch(OpenVehicle& open, Int node) {
    auto& [setting, vehicle, log, drones] = open;
    const Windows place = setting.node[node];
    const Int release = release_of(place);
    if (vehicle.idle != 0) {
        begin_trip(open, release);
        note_charges(setting, log, drones);
    } else if (hold_trip(open, release) != Retimed::kept) {
        return false;
    }
    const Int chosen = next_drone(setting, log, vehicle, drones, node);
    if (chosen < 0) return false;
    Drone& drone = drones[chosen];
    const DroneKind drone_kind = drone_kind_of(setting, drone.row);
    const auto [takeoff, soonest] = takeoffs(setting, vehicle, drone_kind.type, node);
    const Int flight = drone_kind.out(vehicle.node, node);
    if (unreachable(flight) || !drone_kind.in_range(vehicle.node, node) ||
        place.too_late(soonest + flight)) {
        return false;
    }
    const Int here = log.count.stops - 1;
    const Int index = log.count.sorties++;
    board(open, drone, index, node, takeoff);
    LoggedSortie& sortie = log.sortie[index];
    sortie.drone = chosen;
    sortie.row = drone.row;
    sortie.node = node;
    sortie.launch_stop = here;
    sortie.recovery_stop = in_flight;
    sortie.takeoff = takeoff;
    sortie.arrival = takeoff + flight;
    sortie.start = place.start_of_service(sortie.arrival);
    sortie.ready = drone.ready;
    log_op(log, here, index, false);
    log.stop[here].leave = std::max(vehicle.service_end, takeoff);
    load_flight(setting, vehicle, node);
    // The start known so far kept the end of service here, not the arrival, on which launches hang.
    vehicle.start_best = log.trip[0].start;
    return true;
}

bool drive(OpenVehicle& open, Int node) {
    auto& [setting, vehicle, log, drones] = open;
    const bool is_customer = node >= setting.num_depots;
    const Windows place = setting.node[node];
    if (vehicle.idle != 0) {
        begin_trip(open, release_of(place));
    } else if (is_customer && hold_trip(open, release_of(place)) != Retimed::kept) {
        return false;
    }
    const auto [left, arrival, free, rests] = leave_for(setting, log, vehicle, drones, node);
    if (arrival < 0 || (is_customer && place.too_late(arrival))) return false;
    if (!holds_all(setting, vehicle, drones, node, is_customer)) return false;
    log.stop[log.count.stops - 1].rests = rests.packed();
    vehicle.rested = rests.next(vehicle.rested);
    load_stop(setting, vehicle, drones, node, is_customer, rests);
    // A break that is counted from when the route begins may then end later than known so far.
    if (rests.count() > 0) vehicle.start_best = log.trip[0].start;
    if (vehicle.flying > 0) {
        log.stop[log.count.stops - 1].leave = std::max(vehicle.service_end, left);
        log_sorties(setting, log, vehicle, drones);
        vehicle.launched += std::exchange(vehicle.flying, 0);
        // The start known so far kept the drones' return, not the last take-off before recoveries.
        vehicle.start_best = log.trip[0].start;
    }
    Int ready = arrival;
    if (is_customer && !setting.lag.empty()) {
        ready = logged_starts(log).ready_at(setting, node, log.count.stops, arrival);
        if (place.too_late(ready)) return false;
    }
    // The start known so far kept what was behind it, not breaks that come later than a start does,
    // nor what is charged between the trips.
    if (follow_departure(setting.type, rests) || limits_timed_travel(setting.type) ||
        follows_driver(setting.type) || charges_between_trips(setting.type)) {
        vehicle.start_best = log.trip[0].start;
    }
    const Int there = is_customer ? arrival : let_in(setting.type, setting.node, node, arrival);
    const Int start = is_customer ? place.start_of_service(ready) : there;
    const Int service_end = setting.served_at(node, is_customer ? ready : there);
    if (!left_in_hours(setting, log) ||
        (!is_customer && std::max(there, free) > closes_at(setting.type, setting.node, node))) {
        return false;
    }
    log_stop(log, node, arrival, start, std::max(service_end, free));
    vehicle.node = node;
    vehicle.service_end = service_end;
    vehicle.free = vehicle.crew = std::max(free, there);
    if (!keep_fresh(open)) return false;
    if (!setting.lag.empty()) {
        if (!logged_starts(log).keep_lags(setting)) return false;
        // Who is served some time behind another may come later than the start known so far allows.
        if (is_customer && (is_behind(setting.lag, node) || is_bound(setting.across, node))) {
            vehicle.start_best = log.trip[0].start;
        }
    }
    note_charges(setting, log, drones);
    if (!is_customer) come_home(setting, vehicle);
    return true;
}

void clear_vehicle(Vehicle& vehicle) {
    vehicle = {};
    vehicle.type = no_vehicle;
}

void open_vehicle(const Instance& instance, State& state, Int r, Int k) {
    const View<const VehicleType, 1> types = instance.problem[state.problem[r]].type;
    const VehicleType& type = types[k];
    Vehicle& vehicle = state.vehicle[r];
    const Int parted = vehicle.parted | vehicle.kept_by_vehicle;
    clear_vehicle(vehicle);
    vehicle.parted = parted;
    vehicle.type = k;
    vehicle.index = state.used(r, k)++;
    vehicle.node = type.begins_at;
    vehicle.idle = 1;
    vehicle.next_start = type.shift_earliest;
    empty(type, vehicle);
    const View<Drone, 1> drones = state.drone[r];
    for (Int d = 0; d < drones.size(); ++d) {
        drones[d].sortie = in_flight;
        drones[d].row = row_of_drone(types, k, d);
    }
    state.log.count[r] = {};
}

void close_vehicle(const Instance& instance, State& state, Int r) {
    const Int b = state.problem[r];
    OpenVehicle open = open_vehicle_of(instance, b, state, r);
    auto& [setting, vehicle, log, drones] = open;
    for (Int trip = 0; trip < log.count.trips; ++trip) {
        // Who begins a later trip later has worked longer before its rests.
        if (trip > 0 && has_driving_rules(setting.type)) continue;
        const Int soonest = log.trip[trip].start;
        Int known = soonest;
        if (trip == 0) known = std::max(known, vehicle.start_best);
        Int start = latest_start(setting, log, trip, known);
        if (trip == 0) start = start_within_work(setting, log, start);
        if (start <= soonest) continue;
        retime(setting, log, trip, start);
        // Where drones wait out a storm, what begins later may take longer.
        if (!has_rested(setting, log)) {
            retime(setting, log, trip, soonest);
            start = start_within_work(setting, log, soonest);
            if (start > soonest) retime(setting, log, trip, start);
        }
    }
    if (log.count.trips == 0) return;
    note_starts(open, state.starts[r]);
    note_taken(instance, state, r);
    add_cost(setting, log, vehicle.type, state.cost[r]);
}

}  // namespace tandem
