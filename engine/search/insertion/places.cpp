// All places of a customer, or a shipment, on a route.
#include "search/insertion/places.h"

#include "search/insertion/alone.h"
#include "search/insertion/cheapest_stop.h"
#include "search/insertion/offers.h"
#include "search/insertion/shipments.h"
#include "search/route/fairness.h"
#include "search/route/goods.h"
#include "search/route/hubs.h"
#include "search/route/lags.h"
#include "search/route/refresh.h"
#include "search/search.h"

namespace tandem {
namespace {

// Tells whether a drone of a trip may fly to a customer, by what is carried and how often it flies.
bool may_fly_on(const Insertion& insertion, Int slot, Int index) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    return may_launch(data.type[route.type], route, now.sortie[slot], now.trip(slot, index)) &&
           may_fit(data, now, slot, index, route.type, node) &&
           goods_may_join(data, now, slot, index, node);
}

// Tries a customer on flights from stops at launch sites to come on a route.
//
// Once the best of all else is known, most of them cost too much.
void try_halts(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    for (Int index = 0; index < route.trips; ++index) {
        const Trip& trip = now.trip(slot, index);
        if (may_fly_on(insertion, slot, index)) {
            offer_halts(insertion, slot, trip.first, trip.last - 1);
        }
    }
    take_cheapest(insertion);
}

// Whether an end of a shipment is flown to from a stop: a flight from a stop before may delay that.
bool is_end_flown_from(const ProblemData& data, const Fleet& fleet, Int slot, Int p) {
    if (!some_paired(data.pair)) return false;
    const View<const Sortie, 1> sorties = sorties_of(fleet, slot);
    return std::ranges::any_of(sorties, [&](const Sortie& sortie) {
        return sortie.launch == p && is_paired(data.pair, sortie.nodes[0]);
    });
}

// Tries a customer on the trips and sorties of a route.
void try_route(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Int k = route.type;
    const VehicleType& type = data.type[k];
    const bool drives = data.can(k, 0, node), flies = data.can(k, 1, node);
    const bool simple = is_simple(data, route);
    if (is_paired(data.pair, node)) {
        scan_pair(insertion, slot);
        return;
    }
    if (simple && drives) scan_simple(insertion, slot);
    if (simple && !flies) return;
    for (Int index = 0; index < route.trips; ++index) {
        const Trip& trip = now.trip(slot, index);
        if (!may_fit(data, now, slot, index, k, node) ||
            !goods_may_join(data, now, slot, index, node)) {
            continue;
        }
        const Int first = trip.first, last = trip.last;
        if (drives && !simple && allows_stops(type, stops_on(trip) + 1)) {
            offer_stops(insertion, slot, first, last - 1);
        }
        if (!flies || !may_launch(type, route, now.sortie[slot], trip)) continue;
        offer_sorties(insertion, slot, first, last - 1);
        const Int leave = now.stop(slot, first).leave;
        // Who would have to wait for a flight from the depot may fly when the trip is over.
        const Int soonest = held_until(data.place[0][node].opening(leave), endurance_of(type));
        if (leave < soonest || is_end_flown_from(data, now, slot, last)) {
            offer_sorties(insertion, slot, last, last);
        }
    }
    if (data.visits[k] > 1 && flies) offer_joining(insertion, slot);
    take_cheapest(insertion);
    if (has_halts(data) && flies) try_halts(insertion, slot);
}

// Tells whether the best place for a customer on a route is kept from turn to turn.
bool may_keep(const Insertion& insertion, Int slot) {
    return insertion.data.strategy.keep_places && !insertion.enlarge &&
           insertion.searcher.now.route[slot].stamp != changing;
}

// Tells whether the place that is kept is still the best, or none is.
[[gnu::always_inline]] inline bool is_kept(const Insertion& insertion, Int slot) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    return may_keep(insertion, slot) &&
           searcher.kept_stamp(node, slot) == searcher.now.route[slot].stamp &&
           (searcher.kept_move(node, slot).count > 0 ||
            searcher.kept_cost(node, slot) >= best.cost);
}

// Tries a customer on a route as `try_route`, and keeps what is found that costs less than the best
// so far, or that nothing does.
void try_anew(const Insertion& insertion, Int slot) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const bool keeps = may_keep(insertion, slot);
    const double before = best.cost;
    best.blink = keeps ? 0.0 : data.strategy.blink;
    try_route(insertion, slot);
    best.blink = data.strategy.blink;
    if (!keeps) return;
    searcher.kept_stamp(node, slot) = searcher.now.route[slot].stamp;
    searcher.kept_cost(node, slot) = best.cost;
    Move& kept = searcher.kept_move(node, slot);
    kept.count = 0;
    if (best.cost < before) kept.become(best.move);
}

// Tries a customer on a route by `find`, to which the plan as a whole costs nothing. The best it
// finds costs what it lets the route end later, too: how much later is known once it is found.
template <class Find>
void try_weighed(const Insertion& insertion, Int slot, const Find& find) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    if (best.weight == 0.0) {
        find();
        return;
    }
    const auto more_by = [&, node = node](double cost) {
        return best.weight *
               plan_cost_of_joining(data, searcher.now, best.shares, slot, node, cost);
    };
    const double least = more_by(0.0);
    const Surcharge surcharge(best, least);
    const double bar = best.cost;
    Move former;
    former.become(best.move);
    find();
    if (best.cost >= bar) return;
    best.cost += more_by(best.cost) - least;
    if (best.cost < bar) return;
    best.cost = bar;
    best.move.become(former);
}

// Tries a customer on all routes, those first where that takes little. As `try_route`.
//
// Most turns are undone, so that most routes are as when the customer was inserted before. If the
// best place there is overlooked, so is the route.
void try_routes(const Insertion& insertion) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const View<Int, 1> costly = searcher.scratch->moved;
    Int left = 0;
    for (const Int slot : searcher.active.first(searcher.count->active)) {
        const Route& route = searcher.now.route[slot];
        const bool flies = data.can(route.type, 1, node);
        if (!flies && !data.can(route.type, 0, node)) continue;
        if (data.deadline.passed()) return;
        try_weighed(insertion, slot, [&] {
            if (is_kept(insertion, slot)) {
                if (best.takes(searcher.kept_cost(node, slot))) {
                    best.move.become(searcher.kept_move(node, slot));
                }
            } else if (flies || !is_simple(data, route)) {
                costly.at(left++) = slot;
            } else {
                try_anew(insertion, slot);
            }
        });
    }
    for (const Int slot : costly.first(left)) {
        if (data.deadline.passed()) return;
        try_weighed(insertion, slot, [&] {
            if (!is_kept(insertion, slot)) try_anew(insertion, slot);
        });
    }
}

// Tries a customer on more trips of a route.
void try_trips_of(const Insertion& insertion, Int slot, MoreTrips tried) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Int k = now.route[slot].type;
    if (now.route[slot].trips >= data.type[k].max_trips || data.deadline.passed() ||
        !goods_may_follow(data, now, slot, node) || !may_take_off_again(data, now, k)) {
        return;
    }
    const Surcharge surcharge(
        best, best.weight > 0.0
                  ? best.weight * plan_cost_of_trip(data, now, best.shares, slot, node)
                  : 0.0);
    if (is_paired(data.pair, node)) {
        if (data.can(k, 0, node)) try_pair_trips(insertion, slot);
        return;
    }
    if (data.can(k, 0, node)) offer_trips_alone(insertion, slot);
    if (data.can(k, 0, node) && tried == MoreTrips::any) offer_splits(insertion, slot);
    if (data.can(k, 1, node)) offer_flight_trips(insertion, slot);
    if (has_halts(data) && data.can(k, 1, node)) offer_halt_trips(insertion, slot);
    if (best.weight > 0.0) take_cheapest(insertion);
}

// Lists a customer behind, and on flights from, the stops beside another, on its trip.
void offer_beside(const Insertion& insertion, Int other) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Int slot = now.where[other].slot, k = now.route[slot].type;
    const VehicleType& type = data.type[k];
    const Int p = stop_beside(now, other), index = now.stop(slot, p).trip;
    const Trip& trip = now.trip(slot, index);
    const bool drives = data.can(k, 0, node) && !is_simple(data, now.route[slot]) &&
                        allows_stops(type, stops_on(trip) + 1);
    const bool flies =
        data.can(k, 1, node) && may_launch(type, now.route[slot], now.sortie[slot], trip);
    if ((!drives && !flies) || !may_fit(data, now, slot, index, k, node) ||
        !goods_may_join(data, now, slot, index, node)) {
        return;
    }
    const Int first = std::max(p - 1, trip.first);
    // Nobody is served behind the depot.
    if (drives) offer_stops(insertion, slot, first, std::min(p, trip.last - 1));
    if (flies) offer_sorties(insertion, slot, first, p);
}

// Lists a customer on flights from stops at launch sites to come beside another, on its trip.
void offer_halts_beside(const Insertion& insertion, Int other) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Fleet& now = searcher.now;
    const Int slot = now.where[other].slot;
    const Int p = stop_beside(now, other), index = now.stop(slot, p).trip;
    const Trip& trip = now.trip(slot, index);
    if (!data.can(now.route[slot].type, 1, node) || !may_fly_on(insertion, slot, index)) return;
    offer_halts(insertion, slot, std::max(p - 1, trip.first), std::min(p, trip.last - 1));
}

// Calls `visit` with each neighbour of a customer who is served.
template <class Visit>
void for_each_beside(const Insertion& insertion, const Visit& visit) {
    const Fleet& now = insertion.searcher.now;
    for (const Int other : insertion.data.granular[insertion.node]) {
        if (other < 0) break;
        if (now.where[other].slot >= 0) visit(other);
    }
}

// Tries a customer beside neighbours on one route after another.
void try_routes_beside(const Insertion& insertion) {
    const Fleet& now = insertion.searcher.now;
    const auto slot_of = [&](Int other) { return now.where[other].slot; };
    for_each_beside(insertion, [&](Int first) {
        const Int slot = slot_of(first);
        bool is_tried = false, is_behind = false;
        for_each_beside(insertion, [&](Int other) {
            is_behind = is_behind || other == first;
            is_tried = is_tried || (!is_behind && slot_of(other) == slot);
        });
        if (is_tried) return;
        try_weighed(insertion, slot, [&] {
            for_each_beside(insertion, [&](Int other) {
                if (slot_of(other) != slot) return;
                scan_beside(insertion, other);
                offer_beside(insertion, other);
            });
            take_cheapest(insertion);
        });
    });
}

// What a route costs that serves a customer alone, among the others as they are.
double cost_alone(const ProblemData& data, const Searcher& searcher, Int k, Int way, Int node) {
    const double cost = searcher.alone(k, way, node);
    if (cost >= infeasible || !is_bound(data.across, node)) return cost;
    const Int slot = searcher.now.route.size() - 1;
    return serve_alone(data, searcher.now, slot, k, node, way == 1) ? searcher.now.cost[slot]
                                                                    : infeasible;
}

}  // namespace

void try_new_route(const ProblemData& data, const Searcher& searcher, Int node, Best& best) {
    for (Int k = 0; k < data.num_types; ++k) {
        if (!is_left(data, searcher.now, k) ||
            !may_take_off(data, searcher.now, k, data.type[k].begins_at)) {
            continue;
        }
        const Surcharge surcharge(
            best, best.weight > 0.0 ? best.weight * plan_cost_of_opening(data, best.shares, k, node)
                                    : 0.0);
        const Int ways = data.strategy.loops || is_paired(data.pair, node) ? 2 : 1;
        for (Int way = 0; way < ways; ++way) {
            if (!best.takes(cost_alone(data, searcher, k, way, node))) continue;
            best.move.between(nowhere, k, 0, 1).add(way == 0 ? How::serve : How::fly, node, 1);
        }
    }
}

void find_place(const Insertion& insertion) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    try_new_route(data, searcher, node, best);
    try_routes(insertion);
}

void find_beside(const Insertion& insertion) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    try_new_route(data, searcher, node, best);
    if (is_paired(data.pair, node)) {
        scan_pair_beside(insertion);
        return;
    }
    if (best.weight > 0.0) {
        try_routes_beside(insertion);
    } else {
        for_each_beside(insertion, [&](Int other) { scan_beside(insertion, other); });
        for_each_beside(insertion, [&](Int other) { offer_beside(insertion, other); });
        take_cheapest(insertion);
    }
    if (!has_halts(data)) return;
    for (const Int other : data.granular[node]) {
        if (other < 0) break;
        if (searcher.now.where[other].slot >= 0) offer_halts_beside(insertion, other);
    }
    take_cheapest(insertion);
}

void try_trips(const Insertion& insertion, Int number, MoreTrips tried) {
    const Searcher& searcher = insertion.searcher;
    const Int active = searcher.count->active;
    const Int first = number < active ? below(searcher.rng, active) : 0;
    for (Int index = first; index < first + std::min(number, active); ++index) {
        try_trips_of(insertion, searcher.active[index < active ? index : index - active], tried);
    }
    take_cheapest(insertion);
}

void find_at_home(const Insertion& insertion, Int slot) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Int k = searcher.now.route[slot].type;
    if (!data.can(k, 0, node) && !data.can(k, 1, node)) return;
    try_route(insertion, slot);
    try_trips_of(insertion, slot, MoreTrips::any);
    take_cheapest(insertion);
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_write_places(const tandem_problem_data* data, tandem_search* search,
                                   int64_t node, int64_t slot, const tandem_f64_1d* costs,
                                   const tandem_i64_3d* placements, int64_t* count) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        problem.deadline.go_on();
        const View<double, 1> cost(*costs);
        const View<Int, 3> placed(*placements);
        PricedPlaces places;
        // Whatever is found is overlooked, so that all there is comes to be priced.
        Best best{1.0, search->rng};
        best.listed = &places;
        find_at_home({problem, looking(problem, *search), node, false, best}, slot);
        *count = 0;
        places.for_each([&](const PricedPlaces::Priced& found) {
            if (*count == std::min(cost.size(), placed.shape(0))) return;
            cost[*count] = found.cost;
            const View<Int, 2> rows = placed[(*count)++];
            for (Int row = 0; row < rows.shape(0); ++row) {
                const bool is_there = row < found.move.count;
                const Placement& each = found.move.placement[std::size_t(is_there ? row : 0)];
                rows(row, 0) = is_there ? each.node : nowhere;
                rows(row, 1) = Int(each.how);
                rows(row, 2) = each.from;
                rows(row, 3) = each.to;
                rows(row, 4) = each.drone;
            }
        });
    });
}
