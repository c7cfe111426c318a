// What each action does to a running plan.
#pragma once

#include "simulation/state.h"

namespace tandem {

// The open vehicle of a rollout, and what it meets.
struct OpenVehicle {
    Setting setting;
    Vehicle& vehicle;
    VehicleLog log;
    View<Drone, 1> drones;
};

// The open vehicle in a row of the state, by which problem `b` is planned; scratch rows name none.
OpenVehicle open_vehicle_of(const Instance& instance, Int b, const State& state, Int row);

// Put a drone into the air, to a customer.
void board(const OpenVehicle& open, Drone& drone, Int sortie, Int node, Int takeoff);

// Launch a drone to a customer; false if a window or a distance forbids it, or no drone aboard
// lifts the parcel. Whether the vehicle could have left later is for `improve_departure`.
bool launch(OpenVehicle& open, Int node);

// Drive to a customer or home; false if a window, endurance or load forbids it. Whether the vehicle
// could have left later is for `improve_departure`.
bool drive(OpenVehicle& open, Int node);

// Find how late the vehicle could have left without ending its last stop later.
void improve_departure(OpenVehicle& open);

// Let no vehicle be open.
void clear_vehicle(Vehicle& vehicle);

// Let a fresh vehicle of type `k` stand ready at its depot.
void open_vehicle(const Instance& instance, State& state, Int r, Int k);

// Let each trip of the vehicle begin as late as costs nothing and add its cost.
void close_vehicle(const Instance& instance, State& state, Int r);

}  // namespace tandem
