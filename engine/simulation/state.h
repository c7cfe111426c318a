// Running plans, a row per rollout.
#pragma once

#include "rules/flight.h"

namespace tandem {

using LoggedStop = tandem_logged_stop;
using LoggedTrip = tandem_logged_trip;
using Operation = tandem_operation;
using LoggedSortie = tandem_logged_sortie;
using LogLengths = tandem_log_lengths;
using Vehicle = tandem_vehicle;
using Drone = tandem_drone;
using Outlook = tandem_outlook;
using VehicleLogs = tandem_vehicle_logs;

// What one vehicle does, in order.
struct VehicleLog {
    LogLengths& count;
    View<LoggedTrip, 1> trip;
    View<LoggedStop, 1> stop;
    View<Operation, 1> op;
    View<LoggedSortie, 1> sortie;
};

// The log of one rollout.
inline VehicleLog log_of(const VehicleLogs& logs, Int r) {
    return {logs.count[r], logs.trip[r], logs.stop[r], logs.op[r], logs.sortie[r]};
}

// What one vehicle type meets in one problem. What is said of drones holds where they are of one
// type, else `drone_kind_of` tells.
struct Setting {
    Int num_depots;
    NodeTable node;
    NodeTable node_by_air;       // as drones meet them
    View<const Int, 3> amount;   // (node, tier, amounts); no tiers where `Node::demand` tells all
    View<const Goods, 1> goods;  // (node,) none where all go together
    View<const Int, 1> max_time_aboard;  // (node,) ms, none where nothing is limited
    View<const Pair, 1> pair;            // (node,) none where nobody belongs together
    View<const Int, 1> max_between;      // (node,) ms, none where no shipment is limited
    View<const Lag, 2> lag;              // (node, rank) none where nobody is served behind others
    View<const Lag, 2> across;           // (node, rank) none likewise, of any vehicles
    View<const Int, 1> starts;           // (node,) when vehicles closed begin to serve, or `none`
    View<const bool, 1> no_launch;       // (node,) none where drones may take off anywhere
    View<const Int, 1> zones;            // (node,) with hours that hold it, none where none do
    const VehicleType& type;
    View<const Int, 2> drive;           // (node, node) ms
    View<const Int, 2> fly;             // (node, node) ms
    View<const Int, 2> fly_home;        // (node, node) ms, to where the truck is
    View<const Setup, 1> setup;         // (node,) none where nobody sets up
    View<const Int, 1> profile_time;    // (change,)
    View<const Int, 1> profile_factor;  // (change + 1,)
    View<const VehicleType, 1> types;   // (row,)
    NodeTables nodes;
    View<const Int, 3> durations;  // (travel, node, node) ms
    View<const Int, 3> distances;  // (travel, node, node) mm
    View<const bool, 2> can_fly;   // (row, node)
};

// What a type of drones meets.
struct DroneKind {
    const VehicleType& type;
    NodeTable node;
    View<const Int, 2> out;       // (node, node) ms
    View<const Int, 2> home;      // (node, node) ms, to where the truck is
    View<const Int, 2> straight;  // (node, node) mm
    View<const Int, 1> zones;     // (node,) with hours that hold it, none where none do

    // Whether it may serve a customer that is launched or recovered at a node.
    bool in_range(Int here, Int customer) const {
        return !limits_range(type) || within_range(type, straight(here, customer));
    }

    // The zones with hours to which a flight comes that is launched and recovered at these nodes.
    Int zones_of(Int from, Int customer, Int to) const {
        return zones_at(zones, from) | zones_at(zones, customer) | zones_at(zones, to);
    }

    // The flight to a customer, launched and recovered at these nodes.
    Flight flight(Int from, Int customer, Int to) const {
        return {type, node[customer], out(from, customer), home(customer, to),
                zones_of(from, customer, to)};
    }
};

// Running plans, a row per rollout, then scratch rows. Times in ms since plan start; those of
// sorties in flight are as if they were launched at once, in the log and in `drone`.
using State = tandem_state;

}  // namespace tandem
