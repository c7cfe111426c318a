#include "search/route/edit.h"

#include <algorithm>

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
    for (; stops[q].kind == customer_stop; ++q) {
        if (!marked[stops[q].node]) return false;
    }
    return std::none_of(sorties.begin(), sorties.end(), [&](const Sortie& sortie) {
        return p <= sortie.launch && sortie.launch <= q;
    });
}

}  // namespace

void make_room(Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties, Int p, Int room) {
    for (Int q = route.length - 1; q >= p; --q) move_stop(stops[q], stops[q + room]);
    route.length += room;
    for (Sortie& sortie : sorties.first(route.sorties)) {
        if (sortie.launch >= p) sortie.launch += room;
        if (sortie.recovery >= p) sortie.recovery += room;
    }
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
    Sortie& sortie = sorties[s];
    sortie.launch = launch;
    sortie.recovery = recovery;
    sortie.drone = drone;
    sortie.count = 1;
    sortie.nodes[0] = node;
}

void join_sortie(Sortie& sortie, Int place, Int node) {
    std::copy_backward(sortie.nodes + place, sortie.nodes + sortie.count,
                       sortie.nodes + sortie.count + 1);
    sortie.nodes[place] = node;
    ++sortie.count;
}

void apply(Int depot, Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties, const Move& move,
           Int node, Int offset, Int skipped) {
    const Int p = move.first - offset;
    switch (move.kind) {
        case at_stop:
            make_room(route, stops, sorties, p + 1, 1);
            put(stops, p + 1, node, customer_stop);
            break;
        case by_sortie:
            add_sortie(route, sorties, p, move.last - offset, move.drone, node);
            break;
        case on_sortie:
            join_sortie(sorties[move.sortie - skipped], move.first, node);
            break;
        case new_trip:
            make_room(route, stops, sorties, p + 1, 3);
            put(stops, p + 1, depot, start_stop);
            put(stops, p + 2, node, customer_stop);
            put(stops, p + 3, depot, end_stop);
            break;
        case flight_trip:
            make_room(route, stops, sorties, p + 1, 2);
            put(stops, p + 1, depot, start_stop);
            put(stops, p + 2, depot, end_stop);
            add_sortie(route, sorties, p + 1, p + 1, move.drone, node);
            break;
        case trip_from:
            make_room(route, stops, sorties, p + 1, 3);
            put(stops, p + 1, depot, end_stop);
            put(stops, p + 2, depot, start_stop);
            put(stops, p + 3, node, customer_stop);
            break;
        case trip_until:
            make_room(route, stops, sorties, p + 1, 3);
            put(stops, p + 1, node, customer_stop);
            put(stops, p + 2, depot, end_stop);
            put(stops, p + 3, depot, start_stop);
            break;
        default:
            break;
    }
}

void begin_route(Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties, Int k, Int start,
                 Int end, Int node, Int way, Int drone) {
    route.trips = route.sorties = route.end = route.cum = route.working = 0;
    route.offset = route.stamp = 0;
    route.type = k;
    put(stops, 0, start, start_stop);
    if (way == by_truck) {
        put(stops, 1, node, customer_stop);
        put(stops, 2, end, end_stop);
        route.length = 3;
    } else {
        put(stops, 1, end, end_stop);
        route.length = 2;
        add_sortie(route, sorties, way == from_end ? 1 : 0, way == from_start ? 0 : 1, drone, node);
    }
}

Int keep_sorties(Route& route, View<const Stop, 1> stops, View<Sortie, 1> sorties,
                 View<bool, 1> marked, View<Int, 1> absent, Int num_absent) {
    const auto is_removed = [&](Int p) {
        return stops[p].kind == customer_stop && marked[stops[p].node];
    };
    Int kept = 0;
    for (Sortie& sortie : sorties.first(route.sorties)) {
        const bool grounded = is_removed(sortie.launch) || is_removed(sortie.recovery);
        Int left = 0;
        for (Int visit = 0; visit < sortie.count; ++visit) {
            const Int node = sortie.nodes[visit];
            if (grounded && !marked[node]) {
                marked[node] = true;
                absent[num_absent++] = node;
            }
            if (!marked[node]) sortie.nodes[left++] = node;
        }
        sortie.count = left;
        if (left > 0) sorties[kept++] = sortie;
    }
    route.sorties = kept;
    return num_absent;
}

void close_ranks(Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties,
                 View<const bool, 1> marked, View<Int, 1> moved) {
    const View<Sortie, 1> flown = sorties.first(route.sorties);
    Int kept = 0;
    bool dropping = false;
    for (Int p = 0; p < route.length; ++p) {
        const Stop& stop = stops[p];
        if (stop.kind == start_stop) dropping = is_empty_trip(stops, flown, marked, p);
        moved[p] = kept;
        if (dropping || (stop.kind == customer_stop && marked[stop.node])) continue;
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
