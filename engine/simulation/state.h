// Running plans, a row per rollout.
#pragma once

#include "problem/instance.h"

namespace tandem {

using LoggedStop = tandem_logged_stop;
using LoggedTrip = tandem_logged_trip;
using Operation = tandem_operation;
using LoggedSortie = tandem_logged_sortie;
using LogLengths = tandem_log_lengths;
using Vehicle = tandem_vehicle;
using Drone = tandem_drone;
using Cost = tandem_cost;
using Outlook = tandem_outlook;

struct VehicleLogs {
    View<LogLengths, 2> count;  // LENGTHS
    View<LoggedTrip, 2> trip;  // (trip,) LOGGED_TRIP
    View<LoggedStop, 2> stop;  // (stop,) LOGGED_STOP
    View<Operation, 2> op;  // (op,) OPERATION
    View<LoggedSortie, 2> sortie;  // (sortie,) LOGGED_SORTIE
};

inline VehicleLogs vehicle_logs_of(const tandem_vehicle_logs& from) {
    return {from.count, from.trip, from.stop, from.op, from.sortie};
}

struct State {
    View<std::int64_t, 1> problem;  // (rollout,) row in the Instance
    View<bool, 2> served;  // (rollout, node)
    View<std::int64_t, 1> num_unserved;  // (rollout,)
    View<std::int64_t, 2> used;  // (rollout, type) vehicles opened
    View<bool, 1> done;  // (rollout,)
    View<Vehicle, 1> vehicle;  // (rollout,) VEHICLE, the open one
    View<Drone, 2> drone;  // (rollout, drone) DRONE, its drones
    VehicleLogs log;
    View<Cost, 1> cost;  // (rollout,) COST of the vehicles closed so far
    View<bool, 3> fresh;  // (problem, type, node) servable alone by a fresh vehicle
};

inline State state_of(const tandem_state& from) {
    return {from.problem, from.served, from.num_unserved, from.used, from.done, from.vehicle, from.drone, vehicle_logs_of(from.log), from.cost, from.fresh};
}

}  // namespace tandem
