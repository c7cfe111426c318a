// Where truck and drones meet again, and when all that happens from one stop to the next.
//
// A sortie takes off at the truck's stop and is recovered at the next or, if it can't be met there
// within endurance, at the same stop: a loop. Its launch is held back as long as the customer's
// window would let the flight last longer than the endurance, which depends on where it is
// recovered. So launches are timed anew once it is known where the truck drives to.
#pragma once

#include "rules/breaks.h"
#include "simulation/state.h"

namespace tandem {

constexpr Int no_vehicle = -1;  // type of the open vehicle before the first opens

// Where a drone is to be recovered: nowhere, at the next stop, at this stop.
enum class Recovery : Int { aboard, meet, loop };

inline bool is_recovered(const Drone& drone, Recovery place) { return drone.place == Int(place); }

inline bool is_aboard(const Drone& drone) { return is_recovered(drone, Recovery::aboard); }

// Write with what drones have last come aboard on this trip, if they are charged.
void note_charges(const Setting& setting, const VehicleLog& log, View<Drone, 1> drones);

// The drone that would fly to a customer, of those aboard; -1 if there is none.
//
// The first that could come back here, else the first that lifts the parcel.
Int next_drone(const Setting& setting, const VehicleLog& log, const Vehicle& vehicle,
               View<const Drone, 1> drones, Int node);

// Whether drones may be launched in another order than they were chosen in: those of another type,
// which come back to where they are launched, or carry what the truck picks up there.
bool order_may_change(const Setting& setting, Int node);

// Tell whether another drone in flight may be the first, so that working may begin sooner.
bool order_is_open(const Setting& setting, const Vehicle& vehicle);

// When a drone takes off to a customer: behind all in flight, and at the soonest, as it may be
// launched before these.
struct Takeoffs {
    Int last, soonest;
};

Takeoffs takeoffs(const Setting& setting, const Vehicle& vehicle, const VehicleType& type,
                  Int node);

// End of the launches and recoveries at a stop, arrival at the next, end of the recoveries there;
// -1 each if some sortie can be recovered at neither, or is launched too late, or a break can't be
// taken.
struct Leaving {
    Int left, arrival, free;
    Rests rests;  // between both stops
};

// Decide what the sorties in flight do if the truck drives to `to` next, and mark each as met or
// looping, with its times.
Leaving leave_for(const Setting& setting, const VehicleLog& log, const Vehicle& vehicle,
                  View<Drone, 1> drones, Int to);

}  // namespace tandem
