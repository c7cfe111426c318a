#include "search/insertion/places.h"

#include <algorithm>

#include "randomness.h"
#include "rules/flight.h"
#include "rules/shift.h"
#include "rules/window.h"
#include "search/insertion/cheapest_stop.h"
#include "search/insertion/evaluate.h"
#include "search/insertion/offers.h"
#include "search/insertion/passing.h"
#include "search/route/edit.h"
#include "search/route/ends.h"
#include "search/route/goods.h"
#include "search/route/refresh.h"
#include "search/route/state.h"
#include "search/route/vehicles.h"
#include "search/scratch.h"

namespace tandem {
namespace {

// Tries a customer on the trips and sorties of a route.
//
// In place: the move, and the cost of the best so far.
void try_route(const ProblemData& data, const Searcher& searcher, Int slot, Int node,
               bool enlarge) {
    const Fleet& now = searcher.now;
    const Route& route = now.route[slot];
    const Int k = route.type;
    const VehicleType& type = data.type[k];
    const bool drives = data.can(k, 0, node), flies = data.can(k, 1, node);
    const bool simple = is_simple(data, now, slot);
    if (simple && drives) scan_simple(data, searcher, slot, node, enlarge);
    if (simple && !flies) return;
    for (Int index = 0; index < route.trips; ++index) {
        const Trip& trip = now.trip(slot, index);
        if (!may_fit(data, now, slot, index, k, node) ||
            !goods_may_join(data, now, slot, index, node)) {
            continue;
        }
        const Int first = trip.first, last = trip.last;
        if (drives && !simple && allows_stops(type, stops_on(trip) + 1)) {
            offer_stops(data, searcher, slot, first, last - 1, node);
        }
        if (!flies || !may_launch(type, route, now.sortie[slot], trip)) continue;
        offer_sorties(data, searcher, slot, first, last - 1, node);
        const Int leave = now.stop(slot, first).leave;
        // Who would have to wait for a flight from the depot may fly when the trip is over.
        const Int soonest = held_until(data.place[0][node].opening(leave), endurance_of(type));
        if (leave < soonest) offer_sorties(data, searcher, slot, last, last, node);
    }
    if (data.visits[k] > 1 && flies) offer_joining(data, searcher, slot, node);
    take_cheapest(data, searcher, node);
}

// Tells whether the best place kept for a customer on a route is still that, or none is.
bool is_kept(const Searcher& searcher, Int slot, Int node) {
    return searcher.kept(node, slot).stamp == searcher.now.route[slot].stamp &&
           (searcher.kept_move(node, slot).kind >= 0 ||
            searcher.kept_cost(node, slot) >= searcher.scratch->bound.best);
}

// Lets the move be the place kept for a customer on a route if it is the best.
void take_kept(const Searcher& searcher, Int slot, Int node) {
    const double cost = searcher.kept_cost(node, slot);
    if (cost < searcher.scratch->bound.best &&
        uniform(searcher.rng) >= searcher.scratch->bound.blink) {
        searcher.scratch->bound.best = cost;
        searcher.scratch->move = searcher.kept_move(node, slot);
    }
}

// Keeps what was found for a customer on a route, which cost less than `before`, or nothing.
void keep(const Searcher& searcher, Int slot, Int node, double before) {
    searcher.kept(node, slot).stamp = searcher.now.route[slot].stamp;
    searcher.kept_cost(node, slot) = searcher.scratch->bound.best;
    Move& kept = searcher.kept_move(node, slot);
    kept = searcher.scratch->move;
    if (searcher.scratch->bound.best >= before) kept.kind = nowhere;
}

// Tries a customer on all routes, those first where that takes little. As `try_route`.
//
// Most turns are undone, so that most routes are as when the customer was inserted before. If the
// best place there is overlooked, so is the route.
void try_routes(const ProblemData& data, const Searcher& searcher, Int node, bool enlarge) {
    const Fleet& now = searcher.now;
    Bound& bound = searcher.scratch->bound;
    for (const bool costly : {false, true}) {
        for (const Int slot : searcher.active.first(searcher.count->active)) {
            const Route& route = now.route[slot];
            const bool flies = data.can(route.type, 1, node);
            if (!flies && !data.can(route.type, 0, node)) continue;
            if (data.deadline.passed()) return;
            const bool known = data.strategy.keep_places && !enlarge && route.stamp != changing;
            if (known && is_kept(searcher, slot, node)) {
                if (!costly) take_kept(searcher, slot, node);
                continue;
            }
            if (costly != (flies || !is_simple(data, now, slot))) continue;
            const double before = bound.best;
            bound.blink = known ? 0.0 : data.strategy.blink;
            try_route(data, searcher, slot, node, enlarge);
            bound.blink = data.strategy.blink;
            if (known) keep(searcher, slot, node, before);
        }
    }
}

// Lists a customer behind, and on flights from, the stops beside another, on its trip.
void offer_beside(const ProblemData& data, const Searcher& searcher, Int other, Int node) {
    const Fleet& now = searcher.now;
    const Int slot = now.where[other].slot, k = now.route[slot].type;
    const VehicleType& type = data.type[k];
    const Int p = stop_beside(now, other), index = now.stop(slot, p).trip;
    const Trip& trip = now.trip(slot, index);
    const bool drives = data.can(k, 0, node) && !is_simple(data, now, slot) &&
                        allows_stops(type, stops_on(trip) + 1);
    const bool flies =
        data.can(k, 1, node) && may_launch(type, now.route[slot], now.sortie[slot], trip);
    if ((!drives && !flies) || !may_fit(data, now, slot, index, k, node) ||
        !goods_may_join(data, now, slot, index, node)) {
        return;
    }
    const Int first = std::max(p - 1, trip.first);
    // Nobody is served behind the depot.
    if (drives) offer_stops(data, searcher, slot, first, std::min(p, trip.last - 1), node);
    if (!flies) return;
    offer_sorties(data, searcher, slot, first, p, node);
}

}  // namespace

double try_new_route(const ProblemData& data, const Searcher& searcher, Int node) {
    double best = infeasible;
    for (Int k = 0; k < data.num_types; ++k) {
        if (!is_left(data, searcher.now, k)) continue;
        for (Int way = 0; way < (data.strategy.loops ? 2 : 1); ++way) {
            const double cost = searcher.alone(k, way, node);
            if (cost < best && uniform(searcher.rng) >= data.strategy.blink) {
                best = cost;
                searcher.scratch->move.kind = way == 0 ? new_route : new_flight;
                searcher.scratch->move.type = k;
            }
        }
    }
    return best;
}

double find_place(const ProblemData& data, const Searcher& searcher, Int node, bool enlarge) {
    const double best = try_new_route(data, searcher, node);
    if (!data.general) return scan_lean(data, searcher, node, best, enlarge);
    searcher.scratch->bound = {best, data.strategy.blink};
    try_routes(data, searcher, node, enlarge);
    return searcher.scratch->bound.best;
}

double find_beside(const ProblemData& data, const Searcher& searcher, Int node, bool enlarge) {
    double best = try_new_route(data, searcher, node);
    if (!data.general) {
        best = scan_beside_lean(data, searcher, node, best, enlarge);
        return scan_passing_lean(data, searcher, node, best, enlarge);
    }
    best = scan_beside(data, searcher, node, best, enlarge);
    searcher.scratch->bound = {best, data.strategy.blink};
    for (const Int other : data.fit[node]) {
        if (other < 0) break;
        if (searcher.now.where[other].slot >= 0) offer_beside(data, searcher, other, node);
    }
    take_cheapest(data, searcher, node);
    return searcher.scratch->bound.best;
}

bool opens_route(const Move& move) { return move.kind == new_route || move.kind == new_flight; }

double try_trips(const ProblemData& data, const Searcher& searcher, Int node, Int number) {
    const Fleet& now = searcher.now;
    const Int active = searcher.count->active;
    const Int first = number < active ? below(searcher.rng, active) : 0;
    for (Int index = first; index < first + std::min(number, active); ++index) {
        const Int slot = searcher.active[index < active ? index : index - active];
        const Int k = now.route[slot].type;
        if (now.route[slot].trips >= data.type[k].max_trips || data.deadline.passed() ||
            !goods_may_follow(data, now, slot, node)) {
            continue;
        }
        if (data.can(k, 0, node)) {
            if (is_apart(data, k)) {
                offer_trips_apart(data, searcher, slot, node);
            } else {
                offer_trips(data, searcher, slot, node);
            }
        }
        if (data.can(k, 1, node)) offer_flight_trips(data, searcher, slot, node);
    }
    take_cheapest(data, searcher, node);
    return searcher.scratch->bound.best;
}

}  // namespace tandem
