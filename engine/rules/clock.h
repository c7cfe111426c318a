// When a leg is done, and when it has to begin, by speeds that change by time of day.
//
// `times` and `factors` are the profile of a vehicle type, of which as many changes count as the
// type says.
#pragma once

#include <algorithm>

#include "problem/instance.h"

namespace tandem {

// Whether the speed is the same all day, so that legs last as long as tables say.
inline bool is_steady(const VehicleType& type) { return type.speed_changes == no_profile; }

// How often its speed changes.
inline Int num_changes(const VehicleType& type) { return std::max(Int{0}, type.speed_changes); }

// How many of the changes of a speed come no later than `time`.
inline Int changes_until(View<const Int, 1> times, Int changes, Int time) {
    return std::upper_bound(times.data(), times.data() + changes, time) - times.data();
}

// How long a truck sets up after a leg.
inline Int setup_after(View<const Setup, 1> setups, Int origin, Int to) {
    if (setups.empty() || setups[origin].site == setups[to].site) return 0;
    return setups[to].setup_duration;
}

// How long a truck sets up after a leg that the leg's duration doesn't hold.
inline Int setup_beside(const VehicleType& type, View<const Setup, 1> setups, Int origin, Int to) {
    return is_steady(type) ? 0 : setup_after(setups, origin, to);
}

// When a leg of `duration` at full speed, begun at `leave`, is done.
inline Int arrival_by_profile(View<const Int, 1> times, View<const Int, 1> factors, Int changes,
                              Int duration, Int leave) {
    Int piece = changes_until(times, changes, leave);
    Int work = duration * full_speed;
    Int time = leave;
    for (; piece < changes; ++piece) {
        const Int done = (times[piece] - time) * factors[piece];
        if (work <= done) break;
        work -= done;
        time = times[piece];
    }
    return time + (work + factors[piece] - 1) / factors[piece];
}

// The latest departure whose leg of `duration` at full speed ends by `arrival`.
inline Int leave_by_profile(View<const Int, 1> times, View<const Int, 1> factors, Int changes,
                            Int duration, Int arrival) {
    Int piece = changes_until(times, changes, arrival - 1);
    Int work = duration * full_speed;
    Int time = arrival;
    for (; piece > 0; --piece) {
        const Int done = (time - times[piece - 1]) * factors[piece];
        if (work <= done) break;
        work -= done;
        time = times[piece - 1];
    }
    return time - (work + factors[piece] - 1) / factors[piece];
}

// When a leg of `duration` at full speed, begun at `leave`, is done.
inline Int leg_end(const VehicleType& type, View<const Int, 1> times, View<const Int, 1> factors,
                   Int duration, Int leave) {
    if (is_steady(type)) return leave + duration;
    return arrival_by_profile(times, factors, type.speed_changes, duration, leave);
}

// The latest departure whose leg of `duration` at full speed ends by `arrival`.
inline Int leg_start(const VehicleType& type, View<const Int, 1> times, View<const Int, 1> factors,
                     Int duration, Int arrival) {
    if (is_steady(type)) return arrival - duration;
    return leave_by_profile(times, factors, type.speed_changes, duration, arrival);
}

}  // namespace tandem
