// What a vehicle's log costs.
#pragma once

#include "simulation/state.h"

namespace tandem {

// Add the cost of the vehicle in the log, of type `k` in problem `b`.
void add_cost(const Instance& instance, const Setting& setting, const VehicleLog& log, Int b, Int k,
              Cost& cost);

}  // namespace tandem
