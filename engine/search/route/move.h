// What an insertion changes: a list of placements.
#pragma once

#include <span>

#include "rules/pair.h"

namespace tandem {

// What a node is placed as: those of stops are their `Stop.kind`.
enum class How : std::int32_t {
    serve,      // by truck, at stop `from`
    halt,       // likewise, a launch site
    begin,      // a trip begins there
    end,        // or ends there
    fly,        // on a sortie of its own from stop `from` to `to`, by `drone`
    fly_first,  // likewise, before others from and to the same stops
    join,       // on sortie number `from`, before its customer number `to`
    ride,       // behind customer `from` on the sortie that was placed for him
};

struct Placement {
    std::int32_t node;
    How how;
    std::int32_t from, to, drone;
};

// Where a customer goes on a route, or all ends of a shipment, by so many placements at most.
//
// Stops come in their order, then sorties, so that each is told by where it is once all are placed.
template <std::size_t most>
struct Placements {
    std::int32_t slot;   // `nowhere`: that of a new route
    std::int32_t type;   // that drives it then
    std::int32_t first;  // the former stops between which all is placed; before all, -1
    std::int32_t last;
    std::int32_t count;  // if none, nothing was found
    std::array<Placement, most> placement;

    // Begins anew. In place.
    Placements& between(Int of_slot, Int by_type, Int first_stop, Int last_stop) {
        slot = std::int32_t(of_slot);
        type = std::int32_t(by_type);
        first = std::int32_t(first_stop);
        last = std::int32_t(last_stop);
        count = 0;
        return *this;
    }

    // Becomes another. In place; quicker than to copy all that there is room for.
    template <std::size_t others>
    void become(const Placements<others>& other) {
        between(other.slot, other.type, other.first, other.last);
        count = other.count;
        std::copy_n(other.placement.begin(), count, placement.begin());
    }

    // Adds one more. In place.
    void add(How how, Int node, Int from, Int to = 0, Int drone = 0) {
        placement[std::size_t(count++)] = {std::int32_t(node), how, std::int32_t(from),
                                           std::int32_t(to), std::int32_t(drone)};
    }

    std::span<const Placement> placements() const { return {placement.data(), std::size_t(count)}; }
};

// Of several pickups and their delivery, on a trip of their own.
using Move = Placements<most_pickups + 3>;

// Of a customer.
using Offer = Placements<4>;

inline bool is_stop(const Placement& placed) { return placed.how <= How::end; }

inline bool is_flight(const Placement& placed) {
    return placed.how == How::fly || placed.how == How::fly_first;
}

// Tell whether a drone flies to a customer on a sortie more.
inline bool flies(const Move& move) { return std::ranges::any_of(move.placements(), is_flight); }

// Tell whether a trip of its own begins with a move, and no other ends before.
inline bool begins_trip(const Move& move) { return move.placement[0].how == How::begin; }

// Tell whether a customer is served by truck behind a stop, and nothing else changes.
inline bool is_one_stop(const Move& move) {
    return move.count == 1 && move.placement[0].how == How::serve;
}

// Tell whether a customer gets a route of its own.
inline bool opens_route(const Move& move) { return move.slot < 0; }

// Let a drone serve a customer on a trip of its own behind stop `p`. In place.
template <class AnyMove>
void fly_trip(AnyMove& move, Int p, Int depot, Int node, Int drone) {
    move.add(How::begin, depot, p + 1);
    move.add(How::end, depot, p + 2);
    move.add(How::fly, node, p + 1, p + 1, drone);
}

// Let a trip end behind stop `p` and another begin, a customer before or behind that. In place.
template <class AnyMove>
void split_trip(AnyMove& move, Int p, Int depot, Int node, bool until) {
    if (until) move.add(How::serve, node, p + 1);
    move.add(How::end, depot, p + (until ? 2 : 1));
    move.add(How::begin, depot, p + (until ? 3 : 2));
    if (!until) move.add(How::serve, node, p + 3);
}

}  // namespace tandem
