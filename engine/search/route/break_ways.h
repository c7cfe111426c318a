// Ways along a route by which breaks are taken.
#pragma once

#include "search/route/breaks.h"

namespace tandem {

// Instants at which a route may begin by which ways are compared where customers cost by when.
constexpr std::size_t most_compared = 3;

// A break that is taken.
struct Taken {
    PlacedBreaks::One one;
    std::int32_t before;
};

// A break that may be taken, or is over before the route begins.
struct Chosen {
    Int number;
    bool is_over;
};

// What customers cost on a way by when they are served.
struct Times {
    std::int32_t timed = -1;  // the last of them
    double late = 0.0;        // what these cost who are served too late, at the soonest begin
    std::array<double, most_compared> missed{};  // all that these cost, by begins compared
};

struct NoTimes {};

// A way to have come somewhere; lean where customers cost the same at any time.
template <bool is_lean>
struct Way : std::conditional_t<is_lean, NoTimes, Times> {
    TimeSegment now;            // when the truck is there, by when the route begins
    Interval begins;            // for which that holds
    std::int32_t next = 0;      // the first break, of those due, that may still be taken
    std::int32_t left_out = 0;  // bits of those before that aren't
    std::int32_t last = -1;     // break taken
    std::int32_t noted = -1;    // the last one, likewise
};

// A way on a leg: when the truck stands where it last had a break, and when it is at its end.
template <bool is_lean>
struct OnLeg {
    Way<is_lean> way;
    TimeSegment here, there;
    RestPlace place;
};

}  // namespace tandem
