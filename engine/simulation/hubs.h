// What vehicles that fly take of their depots' batteries and places to charge in a running plan.
#pragma once

#include "simulation/state.h"

namespace tandem {

// Tell whether a vehicle of type `k` that has made so many trips may begin one at a depot, by what
// is left there.
bool may_take_off(const Instance& instance, const State& state, Int r, Int k, Int depot, Int trips);

// Add what the open vehicle has taken to what those closed before have. In place.
void note_taken(const Instance& instance, State& state, Int r);

}  // namespace tandem
