// Vehicles that fly and are charged in turn at depots with few places for that: each between the
// trips of others, as these are planned.
#pragma once

#include "search/route/block.h"

namespace tandem {

// Write what a sortie launched at `node` may hover for, without and before windows. In place.
//
// That is what its flight leaves of its battery.
void charge(NodeTable places, const TravelLegs& legs, const TravelLegs& homeward,
            const VehicleType& type, Sortie& sortie, Int node);

// Take what a sortie whose arrivals are known needs to wait for windows in the air. In place.
//
// Later it waits no longer, as long as windows are the same; sooner, nothing is said of.
void hover(NodeTable places, const VehicleType& type, Sortie& sortie, BlockSums& sums);

// Write with what the drone of a sortie has come aboard, and when it can fly. In place.
//
// All that it flies before is timed; its trip's first sortie is `first`.
void note_charge(const VehicleType& type, View<Sortie, 1> sorties, Int index, Int first);

// Let a sortie take off with what its battery then has. In place.
//
// Returns how long after `time`, when the truck reaches the block, that is at least, if the drone
// is charged from a recovery on, which comes as much later as the truck.
Int await_charge(const VehicleType& type, Sortie& sortie, Int takeoff, Int time);

// Let each trip of a timed route begin once there was a place to charge for what it needs.
//
// Before each trip its vehicle is charged once at most, as soon as that can be: for all trips
// behind if there is time for that, else for the next. In place; false if that doesn't help, or a
// rule is broken.
bool charge_in_turn(const ProblemData& data, const Fleet& fleet, Int slot);

// Tell whether the trips of a timed route begin with what they take, charged when that was noted.
bool is_charged_in_turn(const ProblemData& data, const Tour& tour);

// Tell whether there are places to charge when that was noted on a route, beside others.
bool has_places(const ProblemData& data, const Fleet& fleet, Int slot);

}  // namespace tandem
