// Changes of a route's sequence: insertions, and the removal of marked customers.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "rules/pair.h"
#include "search/route/layout.h"

namespace tandem {

// What is chosen of a route: its stops and sorties, in order.
//
// The arrays have room for what `model/search/route/room.py` counts. A plan that breaks rules
// may need more on its way to one that breaks none, so that whatever adds to a route asks: it is
// false where there is no room. The route may then be half of what was meant, and the move is to be
// taken back as if it broke a rule.
struct Sequence {
    Route& route;
    View<Stop, 1> stops;
    View<Sortie, 1> sorties;

    // Whether so many stops more have room.
    bool has_room(Int more) const { return route.length + more <= stops.size(); }
};

inline Sequence sequence_in(const Fleet& fleet, Int slot) {
    return {fleet.route[slot], fleet.stop[slot], fleet.sortie[slot]};
}

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

constexpr Int from_halt = 9;  // on a sortie from a stop at a launch site behind `first`, to stop
                              // `last`, or back there if that is `first`
constexpr Int to_halt = 10;   // on a sortie from `first` to a stop at a launch site behind `last`

constexpr Int by_halts = 11;  // on a sortie from a stop at a launch site behind `first` to one at
                              // another behind `last`, which comes later

constexpr Int both_ends = 12;  // both ends of a shipment: the pickup behind stop `first`, the
                               // delivery behind the pickup or the former stop `last`
constexpr Int pair_trip = 13;  // both on a trip of their own behind stop `first`; the pickup by
                               // `drone` from its start, the delivery by drone `sortie` as
                               // `last` tells, or by truck where these are `nowhere`; or
                               // `on_same_flight`
constexpr Int on_same_flight = -2;
constexpr Int from_last_pickup = 2;  // `late`: several pickups' delivery from the last of them, all
                                     // behind `last` at most, to the former stop `landing`, or back
                                     // there if that is `last`
constexpr Int by_truck_and_drone = 15;  // the pickup behind stop `first`, the delivery on a sortie
                                        // from the former stop `last` to `landing`
constexpr Int by_drone_and_truck = 16;  // the pickup on a sortie from stop `first` to `landing`,
                                        // the delivery behind the former stop `last`
constexpr Int by_drones = 17;   // the pickup on a sortie from stop `first` to `last`, the delivery
                                // on one from `halt` to `landing` by drone `sortie`
constexpr Int all_ends = 18;    // several pickups and their delivery, as `insert_parts` does
constexpr Int parts_trip = 19;  // on a trip of their own behind stop `first`, as `lay_out_parts`
constexpr Int on_one_flight = 20;  // both on a sortie from stop `first` to `last`
constexpr Int from_pickup = 21;    // the pickup behind stop `first`, the delivery on a sortie from
                                   // there to the former stop `landing`, or back there if that is
                                   // `first`
constexpr Int halt_trip = 14;  // on a trip of its own behind stop `first`, by drone from a launch
                               // site and back there

// One of several pickups in a move: its number among them, behind a former stop, or on a sortie
// from there.
constexpr std::int32_t picked_behind(Int stop, Int number) {
    return static_cast<std::int32_t>(stop * most_pickups + number);
}

// Whether a move can tell of a drone, by its number on the truck, that it fetches one of several
// pickups.
constexpr bool may_note_fetched(Int drone) { return drone < 255; }

// Note that a pickup, the one of a rank in `Move.end`, is fetched by a drone that is recovered so
// many stops later. In place.
inline void note_fetched(Move& move, Int rank, Int drone, Int span) {
    move.drone |= (drone + 1) << 8 * rank;
    move.halt |= span << 8 * rank;
}

// What of that was noted of a pickup: by which drone, `nowhere` by truck, and how many stops later.
inline Int fetching_drone(const Move& move, Int rank) { return (move.drone >> 8 * rank & 255) - 1; }
inline Int fetching_span(const Move& move, Int rank) { return move.halt >> 8 * rank & 255; }

// From which stop to which a drone delivers on a trip that ends at stop `end`, behind the last
// pickup: from the end, from that pickup there, or from that pickup and back.
constexpr Int ways_to_bring = 3;

struct Bringing {
    Int launch;
    Int recovery;
};

constexpr Bringing bringing_flight(Int way, Int end) {
    return {way == 0 ? end : end - 1, way == 2 ? end - 1 : end};
}

// Tell whether a customer is served by way of stops more at launch sites.
inline bool uses_halt(const Move& move) { return move.kind >= from_halt && move.kind <= by_halts; }

// How a route serves one customer alone: by truck, or by a drone from the start and back, from the
// start to the end, or from the end and back; from a launch site and back, from the start to it, or
// from it to the end.
constexpr Int by_truck = 0;
constexpr Int from_start = 1;
constexpr Int across = 2;
constexpr Int from_end = 3;
constexpr Int ways = 4;
constexpr Int at_halt = 4;
constexpr Int start_to_halt = 5;
constexpr Int halt_to_end = 6;
constexpr Int ways_by_halt = 3;

// Write a stop's place in the sequence, which has to be there. In place.
inline void put(View<Stop, 1> stops, Int p, Int node, Int kind) {
    Stop& stop = stops.at(p);
    stop.node = node;
    stop.kind = kind;
    stop.release = none;
    stop.hold = none;
}

// A node, and what the truck stops there for.
struct Visit {
    Int node;
    Int kind;
};

// Let some stops come at place `p`, and those from there on behind them. In place; false, with
// nothing changed, if there is no room.
[[nodiscard]] bool insert_stops(const Sequence& sequence, Int p,
                                std::initializer_list<Visit> visits);

// Let a stop come last. In place; likewise.
[[nodiscard]] bool add_stop(const Sequence& sequence, Int node, Int kind);

// Add a sortie to one customer, in its place in the order. In place; likewise.
[[nodiscard]] bool add_sortie(const Sequence& sequence, Int launch, Int recovery, Int drone,
                              Int node);

// As `add_sortie`, before others from and to the same stops: what it delivers is aboard no longer
// than it need be. In place; likewise.
[[nodiscard]] bool add_first_sortie(const Sequence& sequence, Int launch, Int recovery, Int drone,
                                    Int node);

// Insert several pickups and their delivery. In place; false if there is no room.
//
// A pickup comes behind the former stop that `Move.end` tells, or is fetched from there, as noted;
// the delivery comes behind the former stop `last` and all of them, or is brought by drone `sortie`
// from there to `landing`.
[[nodiscard]] bool insert_parts(const Sequence& sequence, const Move& move, const Pickups& pickups,
                                Int delivery);

// Let an empty trip that begins at a stop serve several pickups, in order, and their delivery. In
// place; false if there is no room.
//
// As noted, a pickup is fetched from the stop that `Move.end` tells, and the delivery brought by
// drone `sortie` from stop `last` to `landing`, by their numbers once all the truck's are there.
[[nodiscard]] bool lay_out_parts(const Sequence& sequence, Int start, const Move& move,
                                 const Pickups& pickups, Int delivery);

// Let a sortie serve a customer before its customer number `place`. In place; false if no sortie
// has room for one more.
[[nodiscard]] bool join_sortie(Sortie& sortie, Int place, Int node);

// Customers to be removed, in the order in which they were marked, each once. Of a shipment all
// ends are, for which the first pickup stands; for a customer's places the first does.
struct Removed {
    View<bool, 1> marked;  // (node,)
    View<Int, 1> absent;   // who was absent before comes first
    Int count;             // of those in `absent`
    View<const Pair, 1> pair;

    void mark(Int node) {
        if (marked[node]) return;
        marked[node] = true;
        if (is_paired(pair, node)) {
            for_each_pickup(pair, node, [&](Int pickup) { marked[pickup] = true; });
            marked[pair[unit_of(pair, node)].partner] = true;
        }
        absent.at(count++) = unit_of(pair, node);
    }

    void unmark(Int node) const {
        for_each_place(pair, node, [&](Int place) { marked[place] = false; });
        if (is_paired(pair, node)) marked[pair[node].partner] = false;
    }
};

// Insert a customer, on trips from a depot; of a shipment, by its first pickup, all ends. In place;
// false if there is no room.
[[nodiscard]] bool apply(Int depot, const Sequence& sequence, const Move& move, Int node,
                         View<const Pair, 1> pair);

// Write a route that serves nobody. In place; likewise.
[[nodiscard]] bool begin_empty(const Sequence& sequence, const VehicleType& type, Int k);

// Write a route that serves one customer in one of the `ways`, by a `drone`, or from a launch site.
// In place; likewise.
[[nodiscard]] bool begin_route(const Sequence& sequence, const VehicleType& type, Int k, Int node,
                               Int way, Int drone, Int halt);

// Drop marked customers from sorties, and sorties that serve nobody else. In place.
void drop_visits(const Sequence& sequence, View<const bool, 1> marked);

// Drop marked customers from sorties, and sorties that begin or end at marked stops, or at launch
// sites where a marked customer is served before, as `halt_after` tells.
//
// In place; their other customers are marked, too.
void keep_sorties(const Sequence& sequence, View<const Int, 1> halt_after, Removed& removed);

// Remove marked stops, empty trips, and stops at launch sites where no drone is launched or
// recovered any more; sorties have been dealt with. In place.
//
// `moved` is scratch for a position per stop.
void close_ranks(const Sequence& sequence, View<const bool, 1> marked, View<Int, 1> moved);

}  // namespace tandem
