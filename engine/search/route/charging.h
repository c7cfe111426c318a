// Vehicles that fly and are charged in turn at depots with few places for that: each between the
// trips of others, as these are planned.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// Let each trip of a timed route begin once there was a place to charge for what it needs.
//
// Before each trip its vehicle is charged once at most, as soon as that can be: for all trips
// behind if there is time for that, else for the next. In place; false if that doesn't help, or a
// rule is broken.
bool charge_in_turn(const ProblemData& data, const Fleet& fleet, Int slot);

// Tell whether the trips of a timed route begin with what they take, charged when that was noted.
bool is_charged_in_turn(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                        View<const Trip, 1> trips);

// Tell whether there are places to charge when that was noted on a route, beside others.
bool has_places(const ProblemData& data, const Fleet& fleet, Int slot);

}  // namespace tandem
