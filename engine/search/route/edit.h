// Changes of a route's sequence: insertions, and the removal of marked customers.
#pragma once

#include "search/route/layout.h"

namespace tandem {

// `Move.kind`: where a customer goes.
constexpr Int at_stop = 0;      // behind stop `first`
constexpr Int by_sortie = 1;    // on a sortie of its own from stop `first` to `last`
constexpr Int on_sortie = 2;    // on sortie number `sortie` before its customer `first`
constexpr Int new_trip = 3;     // on a trip of its own behind stop `first`, by truck
constexpr Int flight_trip = 4;  // likewise, by drone
constexpr Int trip_from = 5;    // behind `first`, where a new trip begins
constexpr Int trip_until = 6;   // likewise, where one ends
constexpr Int new_route = 7;    // on a route of its own
constexpr Int new_flight = 8;   // by drone from there

// How a route serves one customer alone: by truck, or by a drone from the start and back, from the
// start to the end, or from the end and back.
constexpr Int by_truck = 0;
constexpr Int from_start = 1;
constexpr Int across = 2;
constexpr Int from_end = 3;
constexpr Int ways = 4;

// Write a stop's place in the sequence. In place.
inline void put(View<Stop, 1> stops, Int p, Int node, Int kind) {
    Stop& stop = stops[p];
    stop.node = node;
    stop.kind = kind;
    stop.release = none;
    stop.hold = none;
}

// Move all stops from `p` on by `room` places. In place.
void make_room(Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties, Int p, Int room);

// Add a sortie to one customer, in its place in the order. In place.
void add_sortie(Route& route, View<Sortie, 1> sorties, Int launch, Int recovery, Int drone,
                Int node);

// Let a sortie serve a customer before its customer number `place`. In place.
void join_sortie(Sortie& sortie, Int place, Int node);

// Insert a customer, in a part that begins `offset` stops and `skipped` sorties later. In place.
void apply(Int depot, Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties, const Move& move,
           Int node, Int offset, Int skipped);

// Write a route that serves one customer in one of the `ways`, by a `drone`. In place.
void begin_route(Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties, Int k, Int start,
                 Int end, Int node, Int way, Int drone);

// Drop marked customers from sorties, and sorties that begin or end at marked stops.
//
// In place; their other customers are marked and listed in `absent`. Returns how many are there.
Int keep_sorties(Route& route, View<const Stop, 1> stops, View<Sortie, 1> sorties,
                 View<bool, 1> marked, View<Int, 1> absent, Int num_absent);

// Remove marked stops and empty trips; sorties have been dealt with. In place.
//
// `moved` is scratch for a position per stop.
void close_ranks(Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties,
                 View<const bool, 1> marked, View<Int, 1> moved);

}  // namespace tandem
