// When a vehicle that may be under way leaves where it begins, and since when it works.
#pragma once

#include "problem/instance.h"

namespace tandem {

// When a truck leaves its start at which its trip begins at `time`.
inline Int leaves_first(const VehicleType& type, Int time) {
    return std::max(time, type.busy_until);
}

// Whether work counts from before the vehicle leaves, however late it does.
inline bool has_begun(const VehicleType& type) { return type.begun == 1; }

// From when work counts that begins with a departure, unless it has begun before.
inline Int counted_from(const VehicleType& type, Int departure) {
    return has_begun(type) ? type.shift_earliest : departure;
}

}  // namespace tandem
