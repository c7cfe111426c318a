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
    Int soonest = far;
    for (const Int change : times.first(num_changes(type))) {
        if (change > leave) soonest = std::min(soonest, change - leave);
        if (change > arrival) soonest = std::min(soonest, change - arrival);
    }
    return soonest;
}

// How long a trip is held, again and again.
//
// What lasts too long has to begin at least so much later. Where all else is as much later then,
// that doesn't help: nothing does until a window or a speed turns what follows. What helps a little
// helps no more than as much until then.
class Holding {
public:
    // Return how much longer a trip is held that lasts too long by `excess`; all between is
    // as it is now for `turn`. `far` if nothing helps.
    Int wait(Int excess, Int turn) {
        if (++times_ > most_times) return far;
        const bool is_alike = excess_ > 0 && (wait_ < turn_ || turn_ == far);
        if (!is_alike) {
            wait_ = excess;
        } else if (excess >= excess_) {
            wait_ = turn == far ? far : std::max(excess, turn);
        } else {
            wait_ = std::max(excess, std::min(turn, as_helpful(excess)));
        }
        excess_ = excess;
        turn_ = turn;
        return wait_;
    }

private:
    static constexpr Int most_times = 1000;

    // Return how much later nothing lasts too long, at the soonest, if it goes on as it did by the
    // last wait. Excesses are rounded up.
    Int as_helpful(Int excess) const {
        constexpr double exact = 1.0 - 1e-9;
        const double waits =
            static_cast<double>(excess - 1) / static_cast<double>(excess_ - excess + 1);
        return static_cast<Int>(
            std::min(static_cast<double>(far), waits * static_cast<double>(wait_) * exact));
    }

    Int excess_ = 0, wait_ = 0, turn_ = 0, times_ = 0;
};

}  // namespace tandem
