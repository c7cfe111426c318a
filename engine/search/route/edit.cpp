#include "search/route/edit.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tandem {
namespace {

// Copy a stop with when it is held back until. In place.
void move_stop(const Stop& stop, Stop& to) {
    copy_sequence(stop, to);
    to.hold = stop.hold;
}

// Tell whether the trip that begins at stop `p` serves nobody any more.
bool is_empty_trip(View<const Stop, 1> stops, View<const Sortie, 1> sorties,
                   View<const bool, 1> marked, Int p) {
    Int q = p + 1;
    for (; stops[q].kind != end_stop; ++q) {
        if (stops[q].kind == customer_stop && !marked[stops[q].node]) return false;
    }
    return std::none_of(sorties.begin(), sorties.end(), [&](const Sortie& sortie) {
        return p <= sortie.launch && sortie.launch <= q;
    });
}

// Tell whether a drone is launched or recovered at stop `p`.
bool is_used(View<const Sortie, 1> sorties, Int p) {
    return std::any_of(sorties.begin(), sorties.end(), [&](const Sortie& sortie) {
        return sortie.launch == p || sortie.recovery == p;
    });
}

// Let a sortie, if there is one, serve one customer. In place; false if there is none.
bool put_sortie(Sortie* sortie, Int launch, Int recovery, Int drone, Int node) {
    if (sortie == nullptr) return false;
    sortie->launch = launch;
    sortie->recovery = recovery;
    sortie->drone = drone;
    sortie->count = 1;
    sortie->nodes[0] = node;
    return true;
}

// One of several pickups in a move, by its rank: the node, and the former stop that it belongs to.
std::pair<Int, Int> picked_as(const Move& move, const Pickups& pickups, Int rank) {
    const std::size_t number = std::size_t(move.end[rank]) % most_pickups;
    return {pickups.node[number], move.end[rank] / most_pickups};
}

// Add the sorties that fetch some of several pickups, and that which delivers, as a move says. In
// place; false if there is no room.
bool add_flights(const Sequence& sequence, const Move& move, const Pickups& pickups, Int delivery) {
    for (Int rank = 0; rank < pickups.count; ++rank) {
        const auto [node, stop] = picked_as(move, pickups, rank);
        const Int drone = fetching_drone(move, rank);
        if (drone < 0) continue;
        if (!add_sortie(sequence, stop, stop + fetching_span(move, rank), drone, node)) {
            return false;
        }
    }
    if (move.sortie < 0 || move.late == from_last_pickup) return true;
    const auto add = move.late != 0 ? add_sortie : add_first_sortie;
    return add(sequence, move.last, move.landing, move.sortie, delivery);
}

// Serve both ends of a shipment on the empty trip that begins at stop `start`. In place; likewise.
bool begin_pair(const Sequence& sequence, Int start, const Move& move, Int pickup, Int delivery) {
    Int end = start + 1;
    if (move.drone >= 0) {
        if (!add_sortie(sequence, start, start, move.drone, pickup)) return false;
    } else if (!insert_stops(sequence, end++, {{pickup, customer_stop}})) {
        return false;
    }
    if (move.sortie < 0) return insert_stops(sequence, end, {{delivery, customer_stop}});
    const auto [launch, recovery] = bringing_flight(move.last, end);
    return add_sortie(sequence, launch, recovery, move.sortie, delivery);
}

// Let the sortie that fetches a shipment alone deliver it, too. In place; likewise.
bool bring_within(const Sequence& sequence, Int pickup, Int delivery) {
    for (Sortie& sortie : sequence.sorties.first(sequence.route.sorties)) {
        if (sortie.nodes[0] == pickup && !join_sortie(sortie, 1, delivery)) return false;
    }
    return true;
}

// Open the place of a sortie in the order: before those from the same stop that are recovered at
// stop `later` or behind it. In place; null if there is no room.
Sortie* open_sortie(const Sequence& sequence, Int launch, Int later) {
    const auto& [route, stops, sorties] = sequence;
    if (route.sorties >= sorties.size()) return nullptr;
    Int s = route.sorties++;
    for (; s > 0; --s) {
        const Sortie& before = sorties[s - 1];
        if (before.launch < launch || (before.launch == launch && before.recovery < later)) break;
        sorties[s] = before;
    }
    return &sorties[s];
}

}  // namespace

bool insert_stops(const Sequence& sequence, Int p, std::initializer_list<Visit> visits) {
    const auto& [route, stops, sorties] = sequence;
    const Int more = Int(visits.size());
    if (!sequence.has_room(more)) return false;
    for (Int q = route.length - 1; q >= p; --q) move_stop(stops[q], stops[q + more]);
    route.length += more;
    for (Sortie& sortie : sorties.first(route.sorties)) {
        if (sortie.launch >= p) sortie.launch += more;
        if (sortie.recovery >= p) sortie.recovery += more;
    }
    for (const Visit& visit : visits) put(stops, p++, visit.node, visit.kind);
    return true;
}

bool add_stop(const Sequence& sequence, Int node, Int kind) {
    if (!sequence.has_room(1)) return false;
    put(sequence.stops, sequence.route.length++, node, kind);
    return true;
}

bool add_sortie(const Sequence& sequence, Int launch, Int recovery, Int drone, Int node) {
    return put_sortie(open_sortie(sequence, launch, recovery + 1), launch, recovery, drone, node);
}

bool add_first_sortie(const Sequence& sequence, Int launch, Int recovery, Int drone, Int node) {
    return put_sortie(open_sortie(sequence, launch, recovery), launch, recovery, drone, node);
}

bool insert_parts(const Sequence& sequence, const Move& move, const Pickups& pickups,
                  Int delivery) {
    if (!add_flights(sequence, move, pickups, delivery)) return false;
    if (move.sortie < 0 && !insert_stops(sequence, move.last + 1, {{delivery, customer_stop}})) {
        return false;
    }
    Int driven = 0;
    for (Int rank = pickups.count - 1; rank >= 0; --rank) {
        const auto [node, stop] = picked_as(move, pickups, rank);
        if (fetching_drone(move, rank) >= 0) continue;
        if (!insert_stops(sequence, stop + 1, {{node, customer_stop}})) return false;
        ++driven;
    }
    if (move.sortie < 0 || move.late != from_last_pickup) return true;
    const Int launch = move.last + driven;
    const Int recovery = move.landing == move.last ? launch : move.landing + driven;
    return add_sortie(sequence, launch, recovery, move.sortie, delivery);
}

bool lay_out_parts(const Sequence& sequence, Int start, const Move& move, const Pickups& pickups,
                   Int delivery) {
    Int p = start + 1;
    for (Int rank = 0; rank < pickups.count; ++rank) {
        const auto [node, stop] = picked_as(move, pickups, rank);
        if (fetching_drone(move, rank) >= 0) continue;
        if (!insert_stops(sequence, p++, {{node, customer_stop}})) return false;
    }
    if (move.sortie < 0 && !insert_stops(sequence, p, {{delivery, customer_stop}})) return false;
    return add_flights(sequence, move, pickups, delivery);
}

bool join_sortie(Sortie& sortie, Int place, Int node) {
    if (sortie.count >= Int(std::size(sortie.nodes))) return false;
    std::copy_backward(sortie.nodes + place, sortie.nodes + sortie.count,
                       sortie.nodes + sortie.count + 1);
    sortie.nodes[place] = node;
    ++sortie.count;
    return true;
}

bool apply(Int depot, const Sequence& sequence, const Move& move, Int node,
           View<const Pair, 1> pair) {
    const View<Sortie, 1> sorties = sequence.sorties;
    const Int partner = is_paired(pair, node) ? pair[node].partner : nowhere;
    const Visit start{depot, start_stop}, end{depot, end_stop}, served{node, customer_stop};
    const Visit halt{move.halt, halt_stop}, delivered{partner, customer_stop};
    const Int behind = move.first + 1;
    const auto insert = [&](Int p, std::initializer_list<Visit> visits) {
        return insert_stops(sequence, p, visits);
    };
    const auto fly = [&](Int launch, Int recovery) {
        return add_sortie(sequence, launch, recovery, move.drone, node);
    };
    const auto bring = [&](Int launch, Int drone) {
        const auto add = move.late != 0 ? add_sortie : add_first_sortie;
        return add(sequence, launch, move.landing, drone, partner);
    };
    switch (move.kind) {
        case at_stop:
            return insert(behind, {served});
        case by_sortie:
            return fly(move.first, move.last);
        case on_sortie:
            return join_sortie(sorties[move.sortie], move.first, node);
        case new_trip:
            return insert(behind, {start, served, end});
        case flight_trip:
            return insert(behind, {start, end}) && fly(behind, behind);
        case trip_from:
            return insert(behind, {end, start, served});
        case trip_until:
            return insert(behind, {served, end, start});
        case from_halt:
            return insert(behind, {halt}) &&
                   fly(behind, move.last == move.first ? behind : move.last + 1);
        case to_halt:
            return insert(move.last + 1, {halt}) && fly(move.first, move.last + 1);
        case by_halts:
            return insert(move.last + 1, {{move.landing, halt_stop}}) && insert(behind, {halt}) &&
                   fly(behind, move.last + 2);
        case both_ends:
            return insert(move.last + 1, {delivered}) && insert(behind, {served});
        case by_truck_and_drone:
            return bring(move.last, move.drone) && insert(behind, {served});
        case from_pickup:
            return insert(behind, {served}) &&
                   add_sortie(sequence, behind,
                              move.landing == move.first ? behind : move.landing + 1, move.drone,
                              partner);
        case by_drone_and_truck:
            return insert(move.last + 1, {delivered}) && fly(move.first, move.landing);
        case by_drones:
            return fly(move.first, move.last) && bring(move.halt, move.sortie);
        case on_one_flight:
            return fly(move.first, move.last) && bring_within(sequence, node, partner);
        case pair_trip:
            if (!insert(behind, {start, end})) return false;
            if (move.sortie != on_same_flight) {
                return begin_pair(sequence, behind, move, node, partner);
            }
            return fly(behind, behind) && bring_within(sequence, node, partner);
        case parts_trip:
            return insert(behind, {start, end}) &&
                   lay_out_parts(sequence, behind, move, pickups_of(pair, node), partner);
        case all_ends:
            return insert_parts(sequence, move, pickups_of(pair, node), partner);
        case halt_trip:
            return insert(behind, {start, halt, end}) && fly(behind + 1, behind + 1);
        default:
            return false;
    }
}

bool begin_empty(const Sequence& sequence, const VehicleType& type, Int k) {
    Route& route = sequence.route;
    route.length = route.trips = route.sorties = route.end = route.cum = route.working = 0;
    route.offset = route.stamp = 0;
    route.type = k;
    return insert_stops(sequence, 0, {{type.begins_at, start_stop}, {type.ends_at, end_stop}});
}

bool begin_route(const Sequence& sequence, const VehicleType& type, Int k, Int node, Int way,
                 Int drone, Int halt) {
    if (!begin_empty(sequence, type, k)) return false;
    if (way == by_truck) return insert_stops(sequence, 1, {{node, customer_stop}});
    if (way >= at_halt) {
        return insert_stops(sequence, 1, {{halt, halt_stop}}) &&
               add_sortie(sequence, way == start_to_halt ? 0 : 1, way == halt_to_end ? 2 : 1, drone,
                          node);
    }
    return add_sortie(sequence, way == from_end ? 1 : 0, way == from_start ? 0 : 1, drone, node);
}

void drop_visits(const Sequence& sequence, View<const bool, 1> marked) {
    const auto& [route, stops, sorties] = sequence;
    Int kept = 0;
    for (Sortie& sortie : sorties.first(route.sorties)) {
        Int* const end = sortie.nodes + sortie.count;
        sortie.count =
            std::remove_if(sortie.nodes + 0, end, [&](Int node) { return marked[node]; }) -
            sortie.nodes;
        if (sortie.count > 0) sorties[kept++] = sortie;
    }
    route.sorties = kept;
}

void keep_sorties(const Sequence& sequence, View<const Int, 1> halt_after, Removed& removed) {
    const auto& [route, stops, sorties] = sequence;
    const auto is_removed = [&](Int p) {
        Int node = stops[p].node;
        if (stops[p].kind == halt_stop) node = halt_after[node];
        return has_window(stops[p]) && node >= 0 && removed.marked[node];
    };
    const Int before = removed.count;
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        if (!is_removed(sortie.launch) && !is_removed(sortie.recovery)) continue;
        for (Int visit = 0; visit < sortie.count; ++visit) removed.mark(sortie.nodes[visit]);
    }
    drop_visits(sequence, removed.marked);
    // Where a shipment isn't flown any more, others may have been launched at its pickup.
    if (some_paired(removed.pair) && removed.count > before) {
        keep_sorties(sequence, halt_after, removed);
    }
}

void close_ranks(const Sequence& sequence, View<const bool, 1> marked, View<Int, 1> moved) {
    const auto& [route, stops, sorties] = sequence;
    const View<Sortie, 1> flown = sorties.first(route.sorties);
    Int kept = 0;
    bool dropping = false;
    for (Int p = 0; p < route.length; ++p) {
        const Stop& stop = stops[p];
        if (stop.kind == start_stop) dropping = is_empty_trip(stops, flown, marked, p);
        moved[p] = kept;
        if (dropping || (stop.kind == customer_stop && marked[stop.node])) continue;
        if (stop.kind == halt_stop && !is_used(flown, p)) continue;
        if (kept < p) move_stop(stop, stops[kept]);
        ++kept;
    }
    route.length = kept;
    for (Sortie& sortie : flown) {
        sortie.launch = moved[sortie.launch];
        sortie.recovery = moved[sortie.recovery];
    }
}

}  // namespace tandem
