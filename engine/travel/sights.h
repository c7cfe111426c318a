// Places in cells, and which of them see each other.
#pragma once

#include "problem/instance.h"

namespace tandem {

struct Cells {
    View<const double, 2> low;          // (cell, axis)
    View<const double, 2> high;         // (cell, axis)
    View<const std::int64_t, 1> first;  // (cell,) its points, by their place in `point`
    View<const std::int64_t, 1> last;   // (cell,)
    View<const std::int64_t, 2>
        half;                     // (cell, 2) the cells that it is halved into; -1 if it is not
    View<const double, 2> point;  // (place, axis)
    View<const std::int32_t, 1> number;  // (place,) of the point
};

inline Cells cells_of(const tandem_cells& from) {
    return {from.low, from.high, from.first, from.last, from.half, from.point, from.number};
}

struct Sights {
    View<const std::int64_t, 1> begin;  // (row + 1,)
    View<const std::int64_t, 1> place;  // (entry,)
    View<const double, 1> distance;     // (entry,) metres
    View<const double, 1> duration;     // (entry,) seconds, infinite where the wind is too strong
};

inline Sights sights_of(const tandem_sights& from) {
    return {from.begin, from.place, from.distance, from.duration};
}

// On which sides of ways to corners areas may lie, as bits.
struct Turns {
    static constexpr std::int32_t left = 1, right = 2;

    View<const std::int32_t, 1> reached;           // (entry from a node,)
    View<const std::int32_t, 1> arrived;           // (entry from a corner,)
    View<const std::int64_t, 1> only_left_end;     // (corner,)
    View<const std::int64_t, 1> only_right_begin;  // (corner,)
};

inline Turns turns_of(const tandem_turns& from) {
    return {from.reached, from.arrived, from.only_left_end, from.only_right_begin};
}

}  // namespace tandem
