#include "search/route/edit.h"

#include <iterator>

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
    return std::ranges::none_of(
        sorties, [&](const Sortie& sortie) { return p <= sortie.launch && sortie.launch <= q; });
}

// Tell whether a drone is launched or recovered at stop `p`.
bool is_used(View<const Sortie, 1> sorties, Int p) {
    return std::ranges::any_of(
        sorties, [&](const Sortie& sortie) { return sortie.launch == p || sortie.recovery == p; });
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

// Let a sortie that serves one customer serve another behind. In place; false if there is none.
bool ride_along(const Sequence& sequence, Int customer, Int node) {
    const View<Sortie, 1> flown = sequence.sorties.first(sequence.route.sorties);
    const auto found = std::find_if(flown.begin(), flown.end(), [&](const Sortie& sortie) {
        return sortie.nodes[0] == customer;
    });
    return found != flown.end() && join_sortie(*found, 1, node);
}

// Let so many stops more have room from place `p` on. In place; false, with nothing changed, if
// there is none.
bool open_stops(const Sequence& sequence, Int p, Int more) {
    const auto& [route, stops, sorties] = sequence;
    if (!sequence.has_room(more)) return false;
    for (Int q = route.length - 1; q >= p; --q) move_stop(stops[q], stops[q + more]);
    route.length += more;
    for (Sortie& sortie : sorties.first(route.sorties)) {
        if (sortie.launch >= p) sortie.launch += more;
        if (sortie.recovery >= p) sortie.recovery += more;
    }
    return true;
}

// Place what is no stop. In place; false if there is no room.
bool fly(const Sequence& sequence, const Placement& placed) {
    const auto [node, how, from, to, drone] = placed;
    switch (how) {
        case How::fly:
            return add_sortie(sequence, from, to, drone, node);
        case How::fly_first:
            return put_sortie(open_sortie(sequence, from, to), from, to, drone, node);
        case How::join:
            return join_sortie(sequence.sorties[from], to, node);
        default:
            return ride_along(sequence, from, node);
    }
}

// How many stops in a row begin some placements.
std::size_t stops_in_row(std::span<const Placement> placements) {
    std::size_t count = 1;
    while (count < placements.size() && is_stop(placements[count]) &&
           placements[count].from == placements[count - 1].from + 1) {
        ++count;
    }
    return count;
}

}  // namespace

bool insert_stop(const Sequence& sequence, Int p, Int node, Int kind) {
    if (!open_stops(sequence, p, 1)) return false;
    put(sequence.stops, p, node, kind);
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

bool join_sortie(Sortie& sortie, Int place, Int node) {
    if (sortie.count >= Int(std::size(sortie.nodes))) return false;
    std::copy_backward(sortie.nodes + place, sortie.nodes + sortie.count,
                       sortie.nodes + sortie.count + 1);
    sortie.nodes[place] = node;
    ++sortie.count;
    return true;
}

bool apply(const Sequence& sequence, const Move& move) {
    std::span<const Placement> left = move.placements();
    while (!left.empty()) {
        const Placement& next = left.front();
        const std::size_t count = is_stop(next) ? stops_in_row(left) : 1;
        if (is_stop(next) ? !open_stops(sequence, next.from, Int(count)) : !fly(sequence, next)) {
            return false;
        }
        for (const Placement& placed : left.first(is_stop(next) ? count : 0)) {
            put(sequence.stops, placed.from, placed.node, Int(placed.how));
        }
        left = left.subspan(count);
    }
    return true;
}

bool begin_empty(const Sequence& sequence, const VehicleType& type, Int k) {
    Route& route = sequence.route;
    route.length = route.trips = route.sorties = route.end = route.cum = route.working = 0;
    route.offset = route.stamp = 0;
    route.type = k;
    return add_stop(sequence, type.begins_at, start_stop) &&
           add_stop(sequence, type.ends_at, end_stop);
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
        for (const Int node : sortie.customers()) removed.mark(node);
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
