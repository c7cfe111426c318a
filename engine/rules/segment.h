// What a row of stops does to whoever comes along it: when he may go on, and by when he has to
// come.
//
// A route is driven as a front, all of it up to somewhere, and what is behind that, a rear. Both
// grow by legs and stops, and are joined to a whole (docs/develop/route-times.md). Those that are
// paid know what work costs by, too; that is chosen where one is made, and takes no time elsewhere.
#pragma once

#include <optional>

#include "rules/window.h"

namespace tandem {

// A route up to somewhere: when whoever drives it has come there, at the soonest.
struct Front {
    Int time;

    void drive(Int duration) { time += duration; }

    // Lets a place be served to which a leg takes so long. In place; false if that is too late.
    bool serve(Windows place, Int duration = 0) {
        drive(duration);
        const bool allowed = !place.too_late(time);
        time = place.end_of_service(time);
        return allowed;
    }
};

// A route from somewhere on: when whoever drives it has to come there, at the latest.
struct Rear {
    Int latest;

    // Lets a leg come first that takes so long. In place.
    void drive(Int duration) { latest -= duration; }

    // Lets a place be served first, and then a leg that takes so long. In place.
    void serve(Windows place, Int duration = 0) {
        latest = place.latest_arrival(latest - duration);
    }

    bool allows(const Front& front) const { return front.time <= latest; }
};

// A front of which it is known how long all takes that is no waiting, and when the route leaves at
// the latest so that nothing is later or dearer for it.
struct PaidFront {
    Int time, busy, depart;

    void drive(Int duration) {
        time += duration;
        busy += duration;
    }

    // Goes through a block of stops that may be reached until `until` as well. In place.
    void pass(TimeSegment block, Int until) {
        depart = std::min(depart, until - busy);
        time = block.at(time);
        // Where speeds change, `d` is none, whose sum would leave the range of numbers.
        busy = std::max(busy + block.d, none);
    }

    // As `Front::serve`.
    bool serve(Windows place, Int duration = 0) {
        drive(duration);
        depart = std::min(depart, place.as_late(time) - busy);
        busy += place.service_duration();
        const bool allowed = !place.too_late(time);
        time = place.end_of_service(time);
        return allowed;
    }
};

// A rear of which it is known how soon it may be reached, how long all takes that is no waiting,
// and when the route ends at the soonest, however soon it is reached.
struct PaidRear {
    Int latest, early, busy, end;

    void drive(Int duration) {
        latest -= duration;
        early -= duration;
        busy += duration;
    }

    // Lets a block of stops come first that may be reached within an interval. In place.
    void pass(TimeSegment block, Interval within) {
        latest = std::min(within.last, latest - block.d);
        early = block.c < early ? std::max(within.first, early - block.d) : within.first;
        end = std::max(block.c + busy, end);
        busy += block.d;
    }

    bool allows(const PaidFront& front) const {
        return early <= front.time && front.time <= latest;
    }
};

// When a route ends, and leaves at the latest, so that nothing is later or dearer for it.
struct Whole {
    Int end, depart;
};

// A route that ends where it has come to.
inline Whole whole_of(const PaidFront& front) {
    return {front.time, std::min(front.depart, front.time - front.busy)};
}

// A route that goes on where it has come to. None if that is too late, or too soon.
inline std::optional<Whole> join(const PaidFront& front, const PaidRear& rear) {
    if (!rear.allows(front)) return std::nullopt;
    const Int busy = front.busy + rear.busy, end = std::max(front.time + rear.busy, rear.end);
    return Whole{end, std::min({front.depart, rear.latest - front.busy, end - busy})};
}

}  // namespace tandem
