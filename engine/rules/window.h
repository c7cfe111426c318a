// What windows and a service mean at a customer: all instants of a stop.
//
// Callers state when somebody arrives, and never compare with a field themselves, so that what a
// window is can change here alone.
#pragma once

#include "problem/instance.h"

namespace tandem {

// When something happens within a block of stops, by the arrival at its beginning: never before
// `c`, nor sooner than `d` after it. Holds for arrivals in an interval, as
// docs/develop/route-times.md derives.
struct TimeSegment {
    Int d, c;

    Int at(Int arrival) const { return std::max(arrival + d, c); }
};

struct Interval {
    Int first, last;
};

// The same so much later.
inline TimeSegment behind(TimeSegment time, Int duration) {
    return {time.d + duration, time.c + duration};
}

// Once both have happened.
inline TimeSegment later(TimeSegment one, TimeSegment other) {
    return {std::max(one.d, other.d), std::max(one.c, other.c)};
}

// Whether one is no later than another, whenever the block is reached.
inline bool is_no_later(TimeSegment one, TimeSegment other) {
    return one.d <= other.d && one.c <= other.c;
}

// Narrow an interval. In place; false if nothing is left of it.
inline bool narrow(Interval& interval, Interval to) {
    interval = {std::max(interval.first, to.first), std::min(interval.last, to.last)};
    return interval.first <= interval.last;
}

// One node, as whoever serves there meets it: its windows, and how long service takes.
class Windows {
public:
    // Its row, then one for each gap between windows.
    Windows(View<const Node, 1> rows) : rows_(rows) {}

    // What is said of the node whatever its windows are.
    const Node& node() const { return rows_[0]; }

    // Whether nobody has several windows, by anyone's rows.
    bool are_single() const { return rows_.size() == 1; }

    // The beginning of the window in which whoever comes at `arrival` is served.
    Int opening(Int arrival) const {
        Int opens = rows_[0].window_earliest;
        for (Int gap = 1; gap < rows_.size() && arrival > rows_[gap].window_latest; ++gap) {
            opens = rows_[gap].window_earliest;
        }
        return opens;
    }

    // The last arrival that is not late.
    Int closing() const { return rows_[0].window_latest; }

    // In how much time whoever arrives needn't wait and isn't late.
    Int width() const {
        Int wide = closing() - rows_[0].window_earliest;
        for (Int gap = 1; gap < rows_.size() && rows_[gap].window_latest != far; ++gap) {
            wide -= rows_[gap].window_earliest - rows_[gap].window_latest;
        }
        return wide;
    }

    // How long service takes.
    Int service_duration() const { return rows_[0].service_duration; }

    // When service begins; early arrival waits.
    Int start_of_service(Int arrival) const { return std::max(arrival, opening(arrival)); }

    // When a customer is served.
    Int end_of_service(Int arrival) const { return start_of_service(arrival) + service_duration(); }

    // Whether a hard window forbids an arrival.
    bool too_late(Int arrival) const { return arrival > rows_[0].arrival_limit; }

    // The last arrival that is allowed.
    Int latest_allowed() const { return rows_[0].arrival_limit; }

    // By how much an arrival is late.
    Int lateness(Int arrival) const { return std::max(Int{0}, arrival - closing()); }

    // How long whoever arrives waits for the window.
    Int waiting(Int arrival) const { return start_of_service(arrival) - arrival; }

    // The last arrival that is no later, by its window, than `arrival`.
    Int as_late(Int arrival) const { return std::max(arrival, closing()); }

    // The last arrival that is served in the same window as `arrival`, and no later.
    Int in_same_window(Int arrival) const {
        for (Int gap = 1; gap < rows_.size(); ++gap) {
            const Int closes = rows_[gap].window_latest;
            if (arrival <= closes) return std::min(closes, as_late(arrival));
        }
        return as_late(arrival);
    }

    // The first arrival after `arrival` that meets another window; `far` if none does.
    Int next_closing(Int arrival) const {
        for (Int gap = 1; gap < rows_.size(); ++gap) {
            const Int closes = rows_[gap].window_latest;
            if (arrival <= closes) return closes == far ? far : closes + 1;
        }
        return far;
    }

    // The last arrival that starts by `start`, which is no earlier than the first opening. Who
    // would come between two windows has to come while the one before is open.
    Int no_later_than(Int start) const {
        for (Int gap = 1; gap < rows_.size(); ++gap) {
            const Int closes = rows_[gap].window_latest;
            if (closes < start && start < rows_[gap].window_earliest) return closes;
        }
        return start;
    }

    // The last arrival that is allowed and lets a truck leave by `leave`.
    Int latest_arrival(Int leave) const {
        return std::min(latest_allowed(), no_later_than(leave - service_duration()));
    }

    // The last arrival no later than `arrival` is that lets a truck leave by `leave`.
    Int latest_free_arrival(Int arrival, Int leave) const {
        return std::min(as_late(arrival), no_later_than(leave - service_duration()));
    }

    // When service begins of whoever is reached so, for arrivals such as `time` at the block.
    TimeSegment start_within(Int time, TimeSegment reached) const {
        return {reached.d, std::max(reached.c, opening(reached.at(time)))};
    }

    // For which arrivals at the block's beginning one that is reached so is allowed and starts so:
    // those that are served in the same window. For where `reached.c` itself is not `too_late`.
    Interval allowed_within(Int time, TimeSegment reached) const {
        const auto [d, c] = reached;
        const Int arrival = reached.at(time);
        Int first = none;
        for (Int gap = 1; gap < rows_.size(); ++gap) {
            const Int closes = rows_[gap].window_latest;
            if (arrival <= closes) return {first, std::min(closes, latest_allowed()) - d};
            if (c <= closes) first = closes + 1 - d;
        }
        return {first, latest_allowed() - d};
    }

private:
    View<const Node, 1> rows_;
};

// All nodes, as whoever serves there meets them.
class NodeTable {
public:
    NodeTable(View<const Node, 2> rows) : rows_(rows) {}  // (node, row)

    Windows operator[](Int node) const { return rows_[node]; }

private:
    View<const Node, 2> rows_;
};

// Those tables of one problem, (variant,).
class NodeTables {
public:
    NodeTables(View<const Node, 3> rows) : rows_(rows) {}  // (variant, node, row)

    NodeTable operator[](Int variant) const { return rows_[variant]; }

    // How many ways there are to meet nodes.
    Int variants() const { return rows_.shape(0); }

    // As trucks of a type meet nodes.
    NodeTable by_truck(const VehicleType& type) const { return rows_[type.variant]; }

    // As drones of a type meet them.
    NodeTable by_air(const VehicleType& type) const { return rows_[type.drone_variant]; }

private:
    View<const Node, 3> rows_;
};

}  // namespace tandem
