// What is laid out for a search before it begins, place by place.
#pragma once

#include "problem/instance.h"

namespace tandem {

// What waiting and lateness weigh against driving between neighbours.
constexpr double waiting_weight = 0.2;
constexpr double lateness_weight = 1.0;

// What a drive costs with the waiting or lateness that it can't do without.
inline double detour(Int drive, double leaves, double leaves_last, double opens, double closes) {
    const double way = double(drive);
    return way + waiting_weight * std::max(opens - leaves_last - way, 0.0) +
           lateness_weight * std::max(leaves + way - closes, 0.0);
}

}  // namespace tandem
