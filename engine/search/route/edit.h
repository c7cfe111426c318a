// Changes of a route's sequence: insertions, and the removal of marked customers.
#pragma once

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

// Write a stop's place in the sequence, which has to be there. In place.
inline void put(View<Stop, 1> stops, Int p, Int node, Int kind) {
    Stop& stop = stops.at(p);
    stop.node = node;
    stop.kind = kind;
    stop.release = none;
    stop.hold = none;
}

// Let a stop come at place `p`, and those from there on behind it. In place; false, with nothing
// changed, if there is no room.
[[nodiscard]] bool insert_stop(const Sequence& sequence, Int p, Int node, Int kind);

// Let a stop come last. In place; likewise.
[[nodiscard]] bool add_stop(const Sequence& sequence, Int node, Int kind);

// Add a sortie to one customer, in its place in the order. In place; likewise.
[[nodiscard]] bool add_sortie(const Sequence& sequence, Int launch, Int recovery, Int drone,
                              Int node);

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

// Place all that a move says, one after another. In place; false if there is no room.
[[nodiscard]] bool apply(const Sequence& sequence, const Move& move);

// Write a route that serves nobody. In place; likewise.
[[nodiscard]] bool begin_empty(const Sequence& sequence, const VehicleType& type, Int k);

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
