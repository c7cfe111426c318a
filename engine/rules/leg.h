// Legs: how long and how far from one place to another.
//
// All are read here: from tables, or computed from where nodes are. Where none are computed and all
// fit 32 bits they are held so, with `no_leg` for what can't be flown: most of the time of a search
// goes into getting them from memory.
#pragma once

#include "problem/instance.h"

namespace tandem {

// A way, driven at full speed or flown.
struct Leg {
    Int duration, distance;
};

inline Leg operator+(Leg a, Leg b) { return {a.duration + b.duration, a.distance + b.distance}; }

inline Leg operator-(Leg a, Leg b) { return {a.duration - b.duration, a.distance - b.distance}; }

// The legs to a customer and from there, and how much further that is than the direct way.
struct Detour {
    Leg out, on;
    Int distance;
};

// Those of one travel. Both tables are (origin, to, duration and distance).
struct TravelLegs {
    const std::int32_t* stated = nullptr;  // none where some travels are computed
    const Int* table = nullptr;            // none where this one is computed, or stated
    Int nodes = 0;
    const Point* point = nullptr;
    const LegLaw* law = nullptr;
};

// Those of one travel from one node, or to it. Both tables are (node, duration and distance).
struct LegRow {
    const std::int32_t* stated = nullptr;
    const Int* table = nullptr;
    const Point* point = nullptr;
    const Point* here = nullptr;
    const LegLaw* law = nullptr;
};

// A leg as `StraightLegs` has it, with the setup at its end.
Leg straight_leg(const Point& origin, const Point& to, const LegLaw& law);

// The distance of a leg alone, which takes half of the time.
Int straight_distance(const Point& origin, const Point& to, const LegLaw& law);

// The entry of a table in 64 bits, in which sums fit. Whether there is a leg, its duration tells
// alone.
inline Leg stated_leg(const std::int32_t* entry) {
    return {entry[0] == no_leg ? unreachable_leg : entry[0], entry[1]};
}

// The legs of travel `m`.
inline TravelLegs legs_of(const Legs& legs, Int m) {
    if (legs.stated.data() != nullptr) {
        return {.stated = &legs.stated(m, 0, 0, 0), .nodes = legs.stated.shape(1)};
    }
    const LegLaw& law = legs.law[m];
    const Int* table = law.table < 0 ? nullptr : &legs.table(0, law.table, 0, 0, 0);
    return {.table = table, .nodes = legs.table.shape(2), .point = legs.point.data(), .law = &law};
}

// The row of a node among the legs of travel `m`, in one direction of the tables.
[[gnu::always_inline]] inline LegRow legs_beside(const Legs& legs, Int direction, Int m, Int node) {
    if (legs.stated.data() != nullptr) return {.stated = &legs.stated(m, node, 0, 0)};
    const LegLaw& law = legs.law[m];
    const Int* table = law.table < 0 ? nullptr : &legs.table(direction, law.table, node, 0, 0);
    return {.table = table, .point = legs.point.data(), .here = &legs.point[node], .law = &law};
}

// The legs of travel `m` from a node, for a loop over where they lead.
[[gnu::always_inline]] inline LegRow legs_from(const Legs& legs, Int m, Int node) {
    return legs_beside(legs, 0, m, node);
}

// The legs of travel `m` to a node; stated ones are given as (travel, to, origin, 2).
[[gnu::always_inline]] inline LegRow legs_to(const Legs& legs, Int m, Int node) {
    return legs_beside(legs, legs.table.shape(0) - 1, m, node);
}

// A leg of one travel.
[[gnu::always_inline]] inline Leg leg(const TravelLegs& legs, Int origin, Int to) {
    const Int entry = 2 * (origin * legs.nodes + to);
    if (legs.stated != nullptr) return stated_leg(legs.stated + entry);
    if (legs.table != nullptr) return {legs.table[entry], legs.table[entry + 1]};
    return straight_leg(legs.point[origin], legs.point[to], *legs.law);
}

// The leg to a node from that for which `legs_from` took the row.
[[gnu::always_inline]] inline Leg leg_to(const LegRow& onward, Int node) {
    if (onward.stated != nullptr) return stated_leg(onward.stated + 2 * node);
    if (onward.table != nullptr) return {onward.table[2 * node], onward.table[2 * node + 1]};
    return straight_leg(*onward.here, onward.point[node], *onward.law);
}

// The leg from a node to that for which `legs_to` took the row.
[[gnu::always_inline]] inline Leg leg_from(const LegRow& inward, Int node) {
    if (inward.stated != nullptr) return stated_leg(inward.stated + 2 * node);
    if (inward.table != nullptr) return {inward.table[2 * node], inward.table[2 * node + 1]};
    return straight_leg(inward.point[node], *inward.here, *inward.law);
}

// The distance of `leg_to` alone.
inline Int distance_to(const LegRow& onward, Int node) {
    if (onward.stated != nullptr) return onward.stated[2 * node + 1];
    if (onward.table != nullptr) return onward.table[2 * node + 1];
    return straight_distance(*onward.here, onward.point[node], *onward.law);
}

// The distance of `leg_from` alone.
inline Int distance_from(const LegRow& inward, Int node) {
    if (inward.stated != nullptr) return inward.stated[2 * node + 1];
    if (inward.table != nullptr) return inward.table[2 * node + 1];
    return straight_distance(inward.point[node], *inward.here, *inward.law);
}

// Asks for a leg from memory, if it is there.
inline void prefetch(const LegRow& row, Int node) {
    if (row.stated != nullptr) __builtin_prefetch(row.stated + 2 * node);
}

// Whether two rows of one travel for the same node tell the same legs: they are as far there as
// back.
inline bool are_same(const LegRow& inward, const LegRow& onward) {
    return inward.stated == onward.stated && inward.table == onward.table;
}

// The shorter distance to or from a node, by rows of one travel for the same node. What is computed
// is as far back, to the last bit.
inline Int nearness(const LegRow& inward, const LegRow& onward, Int node) {
    const Int there = distance_to(onward, node);
    const bool computed = onward.stated == nullptr && onward.table == nullptr;
    return computed ? there : std::min(distance_from(inward, node), there);
}

}  // namespace tandem
