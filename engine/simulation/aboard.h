// What the open vehicle has aboard, and what its drones bring.
//
// The load left is what could still be asked to be carried from where the trip begins to the stop
// where the vehicle is, so what is delivered from now on. Drones in flight bring what they pick up
// to this stop or to the next, as `leave_for` has decided.
#pragma once

#include "rules/breaks.h"
#include "simulation/state.h"

namespace tandem {

// An amount of one tier.
inline Amount part_of(const Int* row, Int number) {
    return amount_of(row + number * dimensions_per_tier);
}

// Let nothing be aboard of what a vehicle of a type holds.
void empty(const VehicleType& type, Vehicle& vehicle);

// Tell whether the truck may carry all that it has on its way to a node and there.
bool holds_all(const Setting& setting, const Vehicle& vehicle, View<const Drone, 1> drones,
               Int node, bool is_customer);

// Take aboard what a drive to a node asks for.
//
// From then on no more is asked for than may be aboard during the breaks on the way.
void load_stop(const Setting& setting, Vehicle& vehicle, View<const Drone, 1> drones, Int node,
               bool is_customer, Rests rests);

// The breaks, as bits, that the truck can't take on its way to a node with all that it has.
Int too_heavy(const Setting& setting, const Vehicle& vehicle, View<const Drone, 1> drones, Int node,
              bool is_customer);

// Tell whether a customer's parcel may go with all that the vehicle's trip carries.
bool may_carry(const Setting& setting, const Vehicle& vehicle, Int node);

// Tell whether a parcel may still leave the truck by a drone at this stop.
//
// Whether there is room for what the drone brings is for `holds_all`, on the way home.
bool may_launch(const Setting& setting, const Vehicle& vehicle, Int node);

// The sum over all dimensions of a parcel, where orders of pickups may matter.
Int given_by_flight(const Setting& setting, Int node);

// Take aboard what a drone delivers that is launched at this stop.
void load_flight(const Setting& setting, Vehicle& vehicle, Int node);

}  // namespace tandem
