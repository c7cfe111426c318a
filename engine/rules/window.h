// What windows and a service mean at a customer: all instants of a stop.
//
// Callers state when somebody arrives, and never compare with a field themselves, so that what a
// window is can change here alone. Within a block of stops, times hang on the arrival `time` at its
// beginning: a pair (d, c) stands for `max(time + d, c)`, and holds for arrivals in an interval
// (see docs/develop/route-times.md).
#pragma once

#include <algorithm>

#include "problem/instance.h"

namespace tandem {

using NodeRows = View<const Node, 1>;   // one node, in the table of whoever serves there
using NodesRows = View<const Node, 2>;  // all nodes: (node, row)

struct Pair {
    Int d, c;
};

struct Interval {
    Int first, last;
};

// The rows of all nodes as trucks of a type meet them.
inline NodesRows places_of(const View<const Node, 3>& places, const VehicleType& type) {
    return places[type.variant];
}

// The rows of all nodes as drones of a type meet them.
inline NodesRows places_by_air(const View<const Node, 3>& places, const VehicleType& type) {
    return places[type.drone_variant];
}

// Whether nobody has several windows, by anyone's rows.
inline bool are_single(NodeRows place) { return place.size() == 1; }

// The beginning of the window in which whoever comes at `arrival` is served.
inline Int opening(NodeRows place, Int arrival) {
    Int opens = place[0].window_earliest;
    for (Int gap = 1; gap < place.size() && arrival > place[gap].window_latest; ++gap) {
        opens = place[gap].window_earliest;
    }
    return opens;
}

// The last arrival that is not late.
inline Int closing(NodeRows place) { return place[0].window_latest; }

// In how much time whoever arrives needn't wait and isn't late.
inline Int width(NodeRows place) {
    Int wide = closing(place) - place[0].window_earliest;
    for (Int gap = 1; gap < place.size() && place[gap].window_latest != far; ++gap) {
        wide -= place[gap].window_earliest - place[gap].window_latest;
    }
    return wide;
}

// How long service takes.
inline Int service_duration(NodeRows place) { return place[0].service_duration; }

// When service begins; early arrival waits.
inline Int start_of_service(NodeRows place, Int arrival) {
    return std::max(arrival, opening(place, arrival));
}

// When a customer is served.
inline Int end_of_service(NodeRows place, Int arrival) {
    return start_of_service(place, arrival) + service_duration(place);
}

// Whether a hard window forbids an arrival.
inline bool too_late(NodeRows place, Int arrival) { return arrival > place[0].arrival_limit; }

// The last arrival that is allowed.
inline Int latest_allowed(NodeRows place) { return place[0].arrival_limit; }

// By how much an arrival is late.
inline Int lateness(NodeRows place, Int arrival) {
    return std::max(Int{0}, arrival - closing(place));
}

// How long whoever arrives waits for the window.
inline Int waiting(NodeRows place, Int arrival) {
    return start_of_service(place, arrival) - arrival;
}

// The last arrival that is no later, by its window, than `arrival`.
inline Int as_late(NodeRows place, Int arrival) { return std::max(arrival, closing(place)); }

// The last arrival that is served in the same window as `arrival`, and no later.
inline Int in_same_window(NodeRows place, Int arrival) {
    for (Int gap = 1; gap < place.size(); ++gap) {
        const Int closes = place[gap].window_latest;
        if (arrival <= closes) return std::min(closes, as_late(place, arrival));
    }
    return as_late(place, arrival);
}

// The last arrival that starts by `start`, which is no earlier than the first opening. Who would
// come between two windows has to come while the one before is open.
inline Int no_later_than(NodeRows place, Int start) {
    for (Int gap = 1; gap < place.size(); ++gap) {
        const Int closes = place[gap].window_latest;
        if (closes < start && start < place[gap].window_earliest) return closes;
    }
    return start;
}

// The last arrival that is allowed and lets a truck leave by `leave`.
inline Int latest_arrival(NodeRows place, Int leave) {
    return std::min(latest_allowed(place), no_later_than(place, leave - service_duration(place)));
}

// The last arrival no later than `arrival` is that lets a truck leave by `leave`.
inline Int latest_free_arrival(NodeRows place, Int arrival, Int leave) {
    return std::min(as_late(place, arrival), no_later_than(place, leave - service_duration(place)));
}

// The pair of the start of service, for an arrival at (d, c).
inline Pair start_within(NodeRows place, Int time, Int d, Int c) {
    return {d, std::max(c, opening(place, std::max(time + d, c)))};
}

// For which arrivals at the block's beginning one at (d, c) is allowed and starts so: those that
// are served in the same window. For where c itself is not `too_late`.
inline Interval allowed_within(NodeRows place, Int time, Int d, Int c) {
    const Int arrival = std::max(time + d, c);
    Int first = none;
    for (Int gap = 1; gap < place.size(); ++gap) {
        const Int closes = place[gap].window_latest;
        if (arrival <= closes) return {first, std::min(closes, latest_allowed(place)) - d};
        if (c <= closes) first = closes + 1 - d;
    }
    return {first, latest_allowed(place) - d};
}

}  // namespace tandem
