// By how much a trip that lasts too long is held.
#pragma once

#include "rules/clock.h"
#include "rules/window.h"

namespace tandem {

// In how much time who comes at `arrival`, and is served at `soonest` at the soonest, is served
// otherwise if he comes later: he need not wait any more, or a window has closed; `far` if never.
inline Int time_to_turn(Windows place, Int arrival, Int soonest) {
    const Int start = place.start_of_service(std::max(arrival, soonest));
    if (start > arrival) return start - arrival;
    const Int closes = place.next_closing(arrival);
    return closes == far ? far : closes - arrival;
}

// In how much time a leg from one instant until another meets another speed; `far` if never.
inline Int time_to_turn(const VehicleType& type, View<const Int, 1> times, Int leave, Int arrival) {
    const Int changes = num_changes(type);
    Int soonest = far;
    for (const Int time : {leave, arrival}) {
        const Int next = changes_until(times, changes, time);
        if (next < changes) soonest = std::min(soonest, times[next] - time);
    }
    return soonest;
}

// How long a trip is held, again and again.
//
// What lasts too long has to begin at least so much later. Where all else is as much later then,
// that doesn't help: nothing does until a window or a speed turns what follows.
class Holding {
public:
    // For a trip of so many stops: each time, all of them are timed anew.
    explicit Holding(Int stops)
        : most_times_(std::clamp(most_timed / stops, fewest_times, most_times)) {}

    // Return how much longer a trip is held that lasts too long by `excess`; all between is
    // as it is now for `turn`. `far` if nothing helps.
    Int wait(Int excess, Int turn) {
        if (++times_ > most_times_) return far;
        const bool in_vain = excess_ > 0 && excess >= excess_ && (wait_ < turn_ || turn_ == far);
        wait_ = !in_vain ? excess : turn == far ? far : std::max(excess, turn);
        excess_ = excess;
        turn_ = turn;
        return wait_;
    }

private:
    static constexpr Int most_timed = 8'000, fewest_times = 50, most_times = 1000;

    Int most_times_;
    Int excess_ = 0, wait_ = 0, turn_ = 0, times_ = 0;
};

}  // namespace tandem
