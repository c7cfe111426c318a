// When a leg is done, and when it has to begin, by speeds that change by time of day.
//
// `times` and `factors` are the profile of a vehicle type, of which as many changes count as the
// type says.
#pragma once

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

// When so much is driven from `leave` on, in ms times the factor of speed.
inline Int time_driven(View<const Int, 1> times, View<const Int, 1> factors, Int changes, Int work,
                       Int leave) {
    Int piece = changes_until(times, changes, leave);
    Int time = leave;
    for (; piece < changes; ++piece) {
        const Int done = (times[piece] - time) * factors[piece];
        if (work <= done) break;
        work -= done;
        time = times[piece];
    }
    return time + (work + factors[piece] - 1) / factors[piece];
}

// How much is driven from one instant to another, as `time_driven` counts it.
inline Int driven_within(View<const Int, 1> times, View<const Int, 1> factors, Int changes,
                         Int begin, Int end) {
    Int piece = changes_until(times, changes, begin);
    Int work = 0;
    for (; piece < changes && times[piece] < end; ++piece) {
        work += (times[piece] - begin) * factors[piece];
        begin = times[piece];
    }
    return work + (end - begin) * factors[piece];
}

// When a leg of `duration` at full speed, begun at `leave`, is done.
inline Int arrival_by_profile(View<const Int, 1> times, View<const Int, 1> factors, Int changes,
                              Int duration, Int leave) {
    return time_driven(times, factors, changes, duration * full_speed, leave);
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

// How fast vehicles of a type drive.
struct Speeds {
    const VehicleType& type;
    View<const Int, 1> times, factors;

    // The last change of the speed; `none` if it is the same all day.
    Int last_change() const {
        const Int changes = num_changes(type);
        return changes == 0 ? none : times[changes - 1];
    }

    // How much of a delay is left at least: whoever drives later may do so faster.
    Int left_of(Int delay) const {
        if (is_steady(type) || delay <= 0) return delay;
        const auto [slowest, fastest] =
            std::minmax_element(factors.data(), factors.data() + num_changes(type) + 1);
        // An unreachable leg's delay may not be multiplied as it is.
        return delay / *fastest * *slowest + delay % *fastest * *slowest / *fastest;
    }

    // How long so much driving lasts at most that takes `duration` at full speed on some legs.
    Int most(Int duration, Int legs) const {
        if (is_steady(type)) return duration;
        const Int slowest =
            *std::min_element(factors.data(), factors.data() + num_changes(type) + 1);
        const double longest = double(duration) * double(full_speed) / double(slowest);
        return longest < double(far) / 2 ? Int(longest) + 1 + legs : far;
    }
};

// What of a leg is still to be driven.
class LegLeft {
public:
    LegLeft(const Speeds& speeds, Int duration)
        : speeds_(&speeds), left_(is_steady(speeds.type) ? duration : duration * full_speed) {}

    // When it is over for whoever drives on from an instant.
    Int end(Int time) const {
        if (is_steady(speeds_->type)) return time + left_;
        return time_driven(speeds_->times, speeds_->factors, speeds_->type.speed_changes, left_,
                           time);
    }

    // How long that takes at least.
    Int least() const {
        return is_steady(speeds_->type) ? left_ : (left_ + full_speed - 1) / full_speed;
    }

    // Be driven from one instant to another, no later than its end. In place.
    void drive(Int begin, Int until) {
        if (is_steady(speeds_->type)) {
            left_ -= until - begin;
        } else {
            left_ -= std::min(left_, driven_within(speeds_->times, speeds_->factors,
                                                   speeds_->type.speed_changes, begin, until));
        }
    }

private:
    const Speeds* speeds_;  // so that one can become another
    Int left_;              // where speeds change, in ms times the factor of speed
};

}  // namespace tandem
