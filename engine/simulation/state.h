// Running plans, a row per rollout.
#pragma once

#include "rows.h"
#include "rules/flight.h"
#include "rules/leg.h"
#include "rules/pair.h"

namespace tandem {

using Outlook = tandem_outlook;

struct LoggedStop {
    Int node, arrival, start, leave;
    Int rests;  // breaks before the next, as rules/breaks.h packs them
};

struct LoggedTrip {
    Int first_stop, first_op, release, start;
};

struct Operation {
    Int stop, sortie, is_recovery;
};

struct LoggedSortie {
    Int drone;
    Int row;  // of its drone's type
    Int node, launch_stop;
    Int recovery_stop;  // -1 until it is recovered
    Int takeoff, arrival, start, ready, recovery_start, recovery_end;
    Int left;           // of the battery, of drones that are charged aboard
    Int trial_takeoff;  // as it would be if a trip began later
    Int trial_ready;    // likewise
    Int trial_end;      // likewise, of the recovery
    Int trial_left;     // likewise, as it is launched and then recovered
};

// How many of each there are in a log.
struct LogLengths {
    Int trips, stops, ops, sorties;
};

// The open vehicle of a rollout.
struct Vehicle {
    Int type;   // -1 before the first opens
    Int index;  // within the type
    Int node;
    Int idle;               // at the depot, no trip begun
    Int service_end;        // here
    Int crew;               // end of the recoveries here
    Int free;               // end of the launches after them as if none was held back
    Int distance;           // of the trip
    Leg legs;               // of all trips, as one, without setups
    Int start_best;         // latest known start of the first trip that costs nothing
    Int departure_best;     // the departure that follows from it
    Int next_start;         // earliest start of the next trip
    Int rested;             // number of the driver's next break
    Int launched;           // on the trip before this stop
    Int flying;             // drones
    Int given;              // on the trip, over all dimensions
    Int picked;             // likewise, before the stop here; and shipments if lifo
    Int taken;              // likewise, by now
    Int stacked;            // shipments aboard, if lifo
    Int barred_on_trip;     // goods that may not be added
    Int barred_on_vehicle;  // likewise
    Int kept_on_trip;       // relations of who is on this trip
    Int kept_by_vehicle;    // likewise on any trip of this vehicle
    Int parted;             // relations of who is on trips, or vehicles, that are over
    Int load[9];            // left, by dimension
    Int aboard[9];          // of pickups, by dimension
};

// A drone of the open vehicle. Those in flight were launched at the truck's stop.
struct Drone {
    Int row;     // of its type
    Int sortie;  // -1 where it is aboard
    Int place;   // to be recovered at: aboard already, the next stop, this stop
    Int node;    // customer
    Int takeoff;
    Int ready;     // end of service
    Int back;      // arrival at the recovery stop
    Int recovery;  // its beginning
    Int kept;      // of the battery as it last came aboard on the trip, if charged there
    Int since;     // when that was
    Int lacking;   // of a full battery as it is launched
    Int left;      // on recovery
};

// What the open vehicles do, in order, a row per rollout.
struct VehicleLogs {
    VehicleLogs(Int rows, Int customers)
        : count({rows}),
          trip({rows, customers + 1}),
          stop({rows, 3 * customers + 2}),
          op({rows, 2 * customers}),
          sortie({rows, customers}) {}

    OwnRows<LogLengths, 1> count;
    OwnRows<LoggedTrip, 2> trip;
    OwnRows<LoggedStop, 2> stop;
    OwnRows<Operation, 2> op;
    OwnRows<LoggedSortie, 2> sortie;
};

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
struct Setting : ProblemTables {
    Setting(const Instance& instance, Int b, Int k)
        : ProblemTables(instance.problem[b]),
          types(ProblemTables::type),
          type(types[k]),
          nodes(ProblemTables::node),
          node(nodes.by_truck(type)),
          node_by_air(nodes.by_air(type)),
          between(limits_of(max_between, k)),
          durations(instance.duration[b]),
          distances(instance.distance[b]),
          ways(distances[type.travel]),
          drive(durations[type.travel]),
          fly(durations[type.drone_travel]),
          fly_home(durations[type.home_travel]),
          can_fly(instance.can_fly[b]),
          profile_time(ProblemTables::profile_time[k]),
          profile_factor(ProblemTables::profile_factor[k]) {}

    View<const VehicleType, 1> types;  // (row,)
    const VehicleType& type;
    NodeTables nodes;
    NodeTable node;
    NodeTable node_by_air;              // as drones meet them
    View<const Int, 1> between;         // (node,) `max_between`, none where no shipment is limited
    View<const Int, 1> starts;          // (node,) when vehicles closed begin to serve, or `none`
    View<const Int, 3> durations;       // (travel, node, node) ms
    View<const Int, 3> distances;       // (travel, node, node) mm
    View<const Int, 2> ways;            // (node, node) mm driven
    View<const Int, 2> drive;           // (node, node) ms
    View<const Int, 2> fly;             // (node, node) ms
    View<const Int, 2> fly_home;        // (node, node) ms, to where the truck is
    View<const bool, 2> can_fly;        // (row, node)
    View<const Int, 1> profile_time;    // (change,)
    View<const Int, 1> profile_factor;  // (change + 1,)

    // When who is ready at a place has served there; at once at a depot.
    Int served_at(Int place, Int ready) const {
        return place < num_depots ? ready : node[place].end_of_service(ready);
    }
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

    // When it has served a customer that takes off at a node then.
    Int ready(Int from, Int customer, Int takeoff) const {
        return Flight{type, node[customer], out(from, customer), 0}.served_at(takeoff);
    }

    // The flight to a customer, launched and recovered at these nodes.
    Flight flight(Int from, Int customer, Int to) const {
        return {type, node[customer], out(from, customer), home(customer, to),
                zones_of(from, customer, to)};
    }
};

// Running plans, a row per rollout, then scratch rows. Times in ms since plan start; those of
// sorties in flight are as if they were launched at once, in the log and in `drone`.
struct State {
    // Rollouts of problems, and so many scratch rows, before any vehicle opens.
    State(const Instance& instance, View<const Int, 1> problems, Int scratch);

    OwnRows<Int, 1> problem;       // (rollout,) row in the Instance
    OwnRows<bool, 2> served;       // (rollout, node)
    OwnRows<Int, 1> num_unserved;  // (rollout,)
    OwnRows<Int, 2> used;          // (rollout, type) vehicles opened
    OwnRows<Hub, 2> taken;        // (rollout, depot) by the vehicles closed so far, or (rollout, 0)
    OwnRows<Int, 2> starts;       // (rollout, node) when vehicles closed so far begin to serve
                                  // those of orders across vehicles, far before all else nobody
    OwnRows<bool, 1> done;        // (rollout,)
    OwnRows<Vehicle, 1> vehicle;  // (rollout,) the open one
    OwnRows<Drone, 2> drone;      // (rollout, drone) its drones
    VehicleLogs log;
    OwnRows<Cost, 1> cost;   // (rollout,) of the vehicles closed so far
    OwnRows<bool, 3> fresh;  // (problem, type, node) servable alone by a fresh vehicle

private:
    State(const Instance& instance, Int rows);
};

}  // namespace tandem

// As C knows it.
struct tandem_state final : tandem::State {
    using State::State;
};
