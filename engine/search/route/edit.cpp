#include "search/route/edit.h"

#include <algorithm>
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

// Let a sortie serve one customer. In place.
void put_sortie(Sortie& sortie, Int launch, Int recovery, Int drone, Int node) {
    sortie.launch = launch;
    sortie.recovery = recovery;
    sortie.drone = drone;
    sortie.count = 1;
    sortie.nodes[0] = node;
}

// One of several pickups in a move, by its rank: the node, and the former stop that it belongs to.
std::pair<Int, Int> picked_as(const Move& move, const Pickups& pickups, Int rank) {
    const std::size_t number = std::size_t(move.end[rank]) % most_pickups;
    return {pickups.node[number], move.end[rank] / most_pickups};
}

// Add the sorties that fetch some of several pickups, and that which delivers, as a move says. In
// place.
void add_flights(const Sequence& sequence, const Move& move, const Pickups& pickups, Int delivery) {
    const auto& [route, stops, sorties] = sequence;
    for (Int rank = 0; rank < pickups.count; ++rank) {
        const auto [node, stop] = picked_as(move, pickups, rank);
        const Int drone = fetching_drone(move, rank);
        if (drone < 0) continue;
        add_sortie(route, sorties, stop, stop + fetching_span(move, rank), drone, node);
    }
    if (move.sortie < 0 || move.late == from_last_pickup) return;
    const auto add = move.late != 0 ? add_sortie : add_first_sortie;
    add(route, sorties, move.last, move.landing, move.sortie, delivery);
}

// Serve both ends of a shipment on the empty trip that begins at stop `start`. In place.
void begin_pair(const Sequence& sequence, Int start, const Move& move, Int pickup, Int delivery) {
    const auto& [route, stops, sorties] = sequence;
    Int end = start + 1;
    if (move.drone >= 0) {
        add_sortie(route, sorties, start, start, move.drone, pickup);
    } else {
        insert_stops(sequence, end++, {{pickup, customer_stop}});
    }
    if (move.sortie >= 0) {
        const auto [launch, recovery] = bringing_flight(move.last, end);
        add_sortie(route, sorties, launch, recovery, move.sortie, delivery);
    } else {
        insert_stops(sequence, end, {{delivery, customer_stop}});
    }
}

// Let the sortie that fetches a shipment alone deliver it, too. In place.
void bring_within(const Route& route, View<Sortie, 1> sorties, Int pickup, Int delivery) {
    for (Sortie& sortie : sorties.first(route.sorties)) {
        if (sortie.nodes[0] == pickup) join_sortie(sortie, 1, delivery);
    }
}

}  // namespace

void insert_stops(const Sequence& sequence, Int p, std::initializer_list<Visit> visits) {
    const auto& [route, stops, sorties] = sequence;
    const Int room = Int(visits.size());
    for (Int q = route.length - 1; q >= p; --q) move_stop(stops[q], stops[q + room]);
    route.length += room;
    for (Sortie& sortie : sorties.first(route.sorties)) {
        if (sortie.launch >= p) sortie.launch += room;
        if (sortie.recovery >= p) sortie.recovery += room;
    }
    for (const Visit& visit : visits) put(stops, p++, visit.node, visit.kind);
}

void add_sortie(Route& route, View<Sortie, 1> sorties, Int launch, Int recovery, Int drone,
                Int node) {
    Int s = route.sorties++;
    for (; s > 0; --s) {
        const Sortie& before = sorties[s - 1];
        if (before.launch < launch || (before.launch == launch && before.recovery <= recovery)) {
            break;
        }
        sorties[s] = before;
    }
    put_sortie(sorties[s], launch, recovery, drone, node);
}

void add_first_sortie(Route& route, View<Sortie, 1> sorties, Int launch, Int recovery, Int drone,
                      Int node) {
    Int s = route.sorties++;
    for (; s > 0; --s) {
        const Sortie& before = sorties[s - 1];
        if (before.launch < launch || (before.launch == launch && before.recovery < recovery)) {
            break;
        }
        sorties[s] = before;
    }
    put_sortie(sorties[s], launch, recovery, drone, node);
}

void insert_parts(const Sequence& sequence, const Move& move, const Pickups& pickups,
                  Int delivery) {
    add_flights(sequence, move, pickups, delivery);
    if (move.sortie < 0) insert_stops(sequence, move.last + 1, {{delivery, customer_stop}});
    Int driven = 0;
    for (Int rank = pickups.count - 1; rank >= 0; --rank) {
        const auto [node, stop] = picked_as(move, pickups, rank);
        if (fetching_drone(move, rank) < 0) {
            insert_stops(sequence, stop + 1, {{node, customer_stop}});
            ++driven;
        }
    }
    if (move.sortie < 0 || move.late != from_last_pickup) return;
    const Int launch = move.last + driven;
    const Int recovery = move.landing == move.last ? launch : move.landing + driven;
    add_sortie(sequence.route, sequence.sorties, launch, recovery, move.sortie, delivery);
}

void lay_out_parts(const Sequence& sequence, Int start, const Move& move, const Pickups& pickups,
                   Int delivery) {
    Int p = start + 1;
    for (Int rank = 0; rank < pickups.count; ++rank) {
        const auto [node, stop] = picked_as(move, pickups, rank);
        if (fetching_drone(move, rank) < 0) insert_stops(sequence, p++, {{node, customer_stop}});
    }
    if (move.sortie < 0) insert_stops(sequence, p, {{delivery, customer_stop}});
    add_flights(sequence, move, pickups, delivery);
}

void join_sortie(Sortie& sortie, Int place, Int node) {
    std::copy_backward(sortie.nodes + place, sortie.nodes + sortie.count,
                       sortie.nodes + sortie.count + 1);
    sortie.nodes[place] = node;
    ++sortie.count;
}

void apply(Int depot, const Sequence& sequence, const Move& move, Int node,
           View<const Pair, 1> pair) {
    const auto& [route, stops, sorties] = sequence;
    const Int partner = is_paired(pair, node) ? pair[node].partner : nowhere;
    const Visit start{depot, start_stop}, end{depot, end_stop}, served{node, customer_stop};
    const Int behind = move.first + 1;
    const auto bring = [&](Int launch, Int drone) {
        const auto add = move.late != 0 ? add_sortie : add_first_sortie;
        add(route, sorties, launch, move.landing, drone, partner);
    };
    switch (move.kind) {
        case at_stop:
            insert_stops(sequence, behind, {served});
            break;
        case by_sortie:
            add_sortie(route, sorties, move.first, move.last, move.drone, node);
            break;
        case on_sortie:
            join_sortie(sorties[move.sortie], move.first, node);
            break;
        case new_trip:
            insert_stops(sequence, behind, {start, served, end});
            break;
        case flight_trip:
            insert_stops(sequence, behind, {start, end});
            add_sortie(route, sorties, behind, behind, move.drone, node);
            break;
        case trip_from:
            insert_stops(sequence, behind, {end, start, served});
            break;
        case trip_until:
            insert_stops(sequence, behind, {served, end, start});
            break;
        case from_halt:
            insert_stops(sequence, behind, {{move.halt, halt_stop}});
            add_sortie(route, sorties, behind, move.last == move.first ? behind : move.last + 1,
                       move.drone, node);
            break;
        case to_halt:
            insert_stops(sequence, move.last + 1, {{move.halt, halt_stop}});
            add_sortie(route, sorties, move.first, move.last + 1, move.drone, node);
            break;
        case by_halts:
            insert_stops(sequence, move.last + 1, {{move.landing, halt_stop}});
            insert_stops(sequence, behind, {{move.halt, halt_stop}});
            add_sortie(route, sorties, behind, move.last + 2, move.drone, node);
            break;
        case both_ends:
            insert_stops(sequence, move.last + 1, {{partner, customer_stop}});
            insert_stops(sequence, behind, {served});
            break;
        case by_truck_and_drone:
            bring(move.last, move.drone);
            insert_stops(sequence, behind, {served});
            break;
        case from_pickup:
            insert_stops(sequence, behind, {served});
            add_sortie(route, sorties, behind,
                       move.landing == move.first ? behind : move.landing + 1, move.drone, partner);
            break;
        case by_drone_and_truck:
            insert_stops(sequence, move.last + 1, {{partner, customer_stop}});
            add_sortie(route, sorties, move.first, move.landing, move.drone, node);
            break;
        case by_drones:
            add_sortie(route, sorties, move.first, move.last, move.drone, node);
            bring(move.halt, move.sortie);
            break;
        case on_one_flight:
            add_sortie(route, sorties, move.first, move.last, move.drone, node);
            bring_within(route, sorties, node, partner);
            break;
        case pair_trip:
            insert_stops(sequence, behind, {start, end});
            if (move.sortie == on_same_flight) {
                add_sortie(route, sorties, behind, behind, move.drone, node);
                bring_within(route, sorties, node, partner);
                break;
            }
            begin_pair(sequence, behind, move, node, partner);
            break;
        case parts_trip:
            insert_stops(sequence, behind, {start, end});
            lay_out_parts(sequence, behind, move, pickups_of(pair, node), partner);
            break;
        case all_ends:
            insert_parts(sequence, move, pickups_of(pair, node), partner);
            break;
        case halt_trip:
            insert_stops(sequence, behind, {start, {move.halt, halt_stop}, end});
            add_sortie(route, sorties, behind + 1, behind + 1, move.drone, node);
            break;
        default:
            break;
    }
}

void begin_empty(const Sequence& sequence, const VehicleType& type, Int k) {
    Route& route = sequence.route;
    route.length = route.trips = route.sorties = route.end = route.cum = route.working = 0;
    route.offset = route.stamp = 0;
    route.type = k;
    insert_stops(sequence, 0, {{type.begins_at, start_stop}, {type.ends_at, end_stop}});
}

void begin_route(const Sequence& sequence, const VehicleType& type, Int k, Int node, Int way,
                 Int drone, Int halt) {
    const auto& [route, stops, sorties] = sequence;
    begin_empty(sequence, type, k);
    if (way == by_truck) {
        insert_stops(sequence, 1, {{node, customer_stop}});
    } else if (way >= at_halt) {
        insert_stops(sequence, 1, {{halt, halt_stop}});
        add_sortie(route, sorties, way == start_to_halt ? 0 : 1, way == halt_to_end ? 2 : 1, drone,
                   node);
    } else {
        add_sortie(route, sorties, way == from_end ? 1 : 0, way == from_start ? 0 : 1, drone, node);
    }
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
