#include "search/insertion/cheapest_stop.h"

#include <algorithm>
#include <cmath>

#include "guard.h"
#include "randomness.h"
#include "rules/load.h"
#include "search/insertion/evaluate.h"
#include "search/insertion/newcomer.h"
#include "search/route/edit.h"
#include "search/route/goods.h"
#include "search/route/rarer.h"
#include "search/route/vehicles.h"
#include "search/scratch.h"

namespace tandem {
namespace {

// What a place must cost less than, and what is asked beside.
struct Wanted {
    double rate;            // cost by distance
    double best;            // cost of the detour that is to be undercut
    double blink;           // how often a better place is overlooked
    Int spare = far;        // longest detour
    Int skipped = nowhere;  // a stop behind which is none
};

// A stop behind which a customer costs least, `nowhere` if that is none, and the cost.
struct CheapestStop {
    double cost;
    Int stop;
};

// Finds the cheapest place for a customer behind one of the stops from `first` to `last`, where
// cost is that of the detour.
CheapestStop scan_stops(const Newcomer& newcomer, View<const Stop, 1> stops, Int first, Int last,
                        const Wanted& wanted, View<std::uint64_t, 1> rng) {
    CheapestStop found{wanted.best, nowhere};
    for (Int p = first; p <= last; ++p) {
        const Int further = newcomer.further_behind(stops, p);
        const double cost = double(further) * wanted.rate;
        if (cost >= found.cost || further > wanted.spare || p == wanted.skipped ||
            !room_behind(newcomer.room, p)) {
            continue;
        }
        if (newcomer.comes_in_time(stops, p, stops[p].leave)) {
            if (uniform(rng) >= wanted.blink) found = {cost, p};
        } else if (newcomer.place.too_late(stops[p].leave)) {
            break;
        }
    }
    return found;
}

// As `scan_stops`, on a trip that has to wait for the customer's parcel.
CheapestStop scan_delayed(NodeTable places, const Newcomer& newcomer, View<const Stop, 1> stops,
                          Int first, Int last, Int start, const Wanted& wanted,
                          View<std::uint64_t, 1> rng) {
    const Windows place = newcomer.place;
    CheapestStop found{wanted.best, nowhere};
    Int leave = release_of(place);
    if (leave > stops[start].latest) return found;
    for (Int p = start; p <= last; ++p) {
        if (p > start) {
            const Int arrival = leave + stops[p - 1].gap;
            if (arrival > stops[p].latest) break;
            leave = places[stops[p].node].end_of_service(arrival);
        }
        if (place.too_late(leave)) break;
        if (p < first) continue;
        const Int further = newcomer.further_behind(stops, p);
        const double cost = double(further) * wanted.rate;
        if (cost < found.cost && further <= wanted.spare &&
            newcomer.comes_in_time(stops, p, leave) && room_behind(newcomer.room, p) &&
            uniform(rng) >= wanted.blink) {
            found = {cost, p};
        }
    }
    return found;
}

// As `scan_stops`, on a route whose vehicle may only work for some time.
CheapestStop scan_limited(const ProblemData& data, const Fleet& fleet, Int slot, Int first,
                          Int last, Int node, const Newcomer& newcomer, const Wanted& wanted,
                          View<std::uint64_t, 1> rng) {
    const View<const Stop, 1> stops = fleet.stop[slot];
    CheapestStop found{wanted.best, nowhere};
    for (Int p = first; p <= last; ++p) {
        const Int further = newcomer.further_behind(stops, p);
        const double cost = double(further) * wanted.rate;
        if (cost >= found.cost || further > wanted.spare || !room_behind(newcomer.room, p)) {
            continue;
        }
        if (newcomer.place.too_late(stops[p].leave)) break;
        if (price_stop(data, fleet, slot, p, node) < infeasible && uniform(rng) >= wanted.blink) {
            found = {cost, p};
        }
    }
    return found;
}

// Finds the cheapest place for a customer on a trip, by type `by`. As `scan_stops`.
CheapestStop scan_trip(const ProblemData& data, const Fleet& fleet, Int slot, Int index, Int first,
                       Int last, Int node, Int by, double best, double blink,
                       View<std::uint64_t, 1> rng) {
    const Int k = fleet.route[slot].type;
    const Trip& trip = fleet.trip(slot, index);
    const View<const Stop, 1> stops = fleet.stop[slot];
    const Newcomer newcomer = newcomer_on(data, fleet, slot, by, node);
    const Wanted wanted{data.rate[by].distance, best, blink,
                        data.type[k].max_trip_distance - trip.distance};
    if (data.evaluation[k].timed) {
        return scan_limited(data, fleet, slot, first, last, node, newcomer, wanted, rng);
    }
    if (release_of(newcomer.place) > stops[trip.first].leave) {
        return scan_delayed(data.place.by_truck(data.type[k]), newcomer, stops, first, last,
                            trip.first, wanted, rng);
    }
    return scan_stops(newcomer, stops, first, last, wanted, rng);
}

// Lets the move be to serve a customer behind a stop.
void take_stop(Move& move, Int slot, Int p, Int by) {
    move.kind = at_stop;
    move.slot = slot;
    move.first = p;
    move.type = by;
}

// A stop behind which the detour is shortest, `nowhere` if that is none, and how long it is.
struct ShortestDetour {
    Int distance;
    Int stop;
};

// Returns the shortest detour for a customer on a lean route that is shorter than `best`.
ShortestDetour shortest_detour(const Newcomer& newcomer, View<const Stop, 1> stops, Int last,
                               Int best) {
    ShortestDetour found{best, nowhere};
    for (Int p = 0; p < last; ++p) {
        const Int further = newcomer.further_behind(stops, p);
        if (further >= found.distance || !room_behind(newcomer.room, p)) continue;
        if (newcomer.comes_in_time(stops, p, stops[p].leave)) {
            found = {further, p};
        } else if (newcomer.place.too_late(stops[p].leave)) {
            break;
        }
    }
    return found;
}

// As `scan_stops`, on a lean route that this turn doesn't change, but for overlooking.
//
// Most turns are undone, so that most routes are as when the customer was inserted before.
CheapestStop scan_kept(const ProblemData& data, const Fleet& fleet, Int slot, Int node, double rate,
                       double best, Kept& kept) {
    const Int stamp = fleet.route[slot].stamp;
    if (kept.stamp != stamp || (kept.stop < 0 && double(kept.detour) * rate < best)) {
        Int most = far;
        // Also where distance costs nothing, or a larger vehicle saves more than any detour costs.
        if (std::abs(best) < double(far) * rate) most = static_cast<Int>(best / rate) + 1;
        const Newcomer newcomer = newcomer_on(data, fleet, slot, fleet.route[slot].type, node);
        const ShortestDetour found =
            shortest_detour(newcomer, fleet.stop[slot], fleet.trip(slot, 0).last, most);
        kept = {stamp, found.distance, found.stop};
    }
    const double cost = double(kept.detour) * rate;
    if (cost >= best) return {best, nowhere};
    return {cost, kept.stop};
}

// Tells whether a customer is known to cost no less than `best` on a route as it is.
//
// That is so of most routes, so nothing else is asked of them.
bool is_too_far(const ProblemData& data, const Searcher& searcher, Int slot, Int node,
                double best) {
    const Route& route = searcher.now.route[slot];
    if (!data.strategy.scan_all || route.stamp == changing) return false;
    const Rate& rate = data.rate[route.type];
    const Kept& kept = searcher.kept(node, slot);
    return kept.stamp == route.stamp && double(kept.detour) * rate.distance >= best - rate.stop;
}

// Tells whether to insert a customer beside stop `p`, at `other`, costs no less than `best`.
//
// By the triangle inequality, with a stop between which and this one the customer would come that
// is no nearer; beside that, if it is, the same place is looked at as well.
bool is_too_far_beside(const LegRow& inward, const LegRow& onward, View<const Stop, 1> stops, Int p,
                       Int other, double rate, double best) {
    const Int near = nearness(inward, onward, other);
    return double(2 * near - std::max(stops[p - 1].leg, stops[p].leg)) * rate >= best;
}

}  // namespace

bool is_simple(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    return data.evaluation[route.type].by_detour && route.sorties == 0;
}

Serving serving_type(const ProblemData& data, const Fleet& fleet, Int slot, Int index, Int node,
                     bool enlarge) {
    const Int k = fleet.route[slot].type;
    if (!goods_may_join(data, fleet, slot, index, node)) return {nowhere, 0.0};
    if (takes(data, fleet, slot, index, k, node)) return {k, data.rate[k].stop};
    if (!enlarge) return {nowhere, 0.0};
    const Haul haul = haul_of(fleet.trip(slot, 0));
    const Int by = larger_type(data, fleet, k, haul, node, [&](Int other) {
        return may_fit(data, fleet, slot, 0, other, node);
    });
    if (by < 0) return {nowhere, 0.0};
    const double cost = route_cost(data, by, haul) + data.rate[by].stop;
    return {by, cost - fleet.cost[slot]};
}

double take_cheaper(const ProblemData& data, const Searcher& searcher, Int slot,
                    const std::array<Int, 2>& places, Int node, Serving serving, double best) {
    const View<const Stop, 1> stops = searcher.now.stop[slot];
    const Newcomer newcomer = newcomer_on(data, searcher.now, slot, serving.type, node);
    const double rate = data.rate[serving.type].distance;
    for (const Int p : places) {
        const Int further = newcomer.further_behind(stops, p);
        const double cost = double(further) * rate + serving.cost;
        if (cost < best && newcomer.comes_in_time(stops, p, stops[p].leave) &&
            room_behind(newcomer.room, p) && uniform(searcher.rng) >= data.strategy.blink) {
            best = cost;
            take_stop(searcher.scratch->move, slot, p, serving.type);
        }
    }
    return best;
}

double scan_lean(const ProblemData& data, const Searcher& searcher, Int node, double best,
                 bool enlarge) {
    const Fleet& fleet = searcher.now;
    for (const Int slot : searcher.active.first(searcher.count->active)) {
        if (!enlarge && is_too_far(data, searcher, slot, node, best)) continue;
        const Route& route = fleet.route[slot];
        const Int k = route.type;
        if (!data.can(k, 0, node)) continue;
        const auto [by, base] = serving_type(data, fleet, slot, 0, node, enlarge);
        if (by < 0 || (by != k && base >= best)) continue;
        Wanted wanted{data.rate[by].distance, best - base, data.strategy.blink};
        // What is kept is where there is room on the vehicle as it is.
        bool anew =
            !data.strategy.scan_all || route.stamp == changing || (by != k && tiers_of(data) > 0);
        CheapestStop found{best, nowhere};
        if (!anew) {
            found = scan_kept(data, fleet, slot, node, wanted.rate, wanted.best,
                              searcher.kept(node, slot));
            if (found.stop >= 0 && uniform(searcher.rng) < data.strategy.blink) {
                wanted.skipped = found.stop;
                anew = true;
            }
        }
        if (anew) {
            found = scan_stops(newcomer_on(data, fleet, slot, by, node), fleet.stop[slot], 0,
                               fleet.trip(slot, 0).last - 1, wanted, searcher.rng);
        }
        if (found.stop >= 0) {
            best = found.cost + base;
            take_stop(searcher.scratch->move, slot, found.stop, by);
        }
    }
    return best;
}

void scan_simple(const ProblemData& data, const Searcher& searcher, Int slot, Int node,
                 bool enlarge) {
    const Fleet& fleet = searcher.now;
    Bound& bound = searcher.scratch->bound;
    const Int k = fleet.route[slot].type;
    for (Int index = 0; index < fleet.route[slot].trips; ++index) {
        const auto [by, base] = serving_type(data, fleet, slot, index, node, enlarge);
        if (by < 0 || (by != k && base >= bound.best)) continue;
        const Trip& trip = fleet.trip(slot, index);
        const auto [cost, p] = scan_trip(data, fleet, slot, index, trip.first, trip.last - 1, node,
                                         by, bound.best - base, bound.blink, searcher.rng);
        if (p >= 0) {
            bound.best = cost + base;
            take_stop(searcher.scratch->move, slot, p, by);
        }
    }
}

double scan_beside(const ProblemData& data, const Searcher& searcher, Int node, double best,
                   bool enlarge) {
    const Fleet& fleet = searcher.now;
    for (const Int other : data.fit[node]) {
        if (other < 0) break;
        const Int slot = fleet.where[other].slot;
        if (slot < 0) continue;
        const Int k = fleet.route[slot].type;
        if (!(is_simple(data, fleet, slot) && data.can(k, 0, node))) continue;
        const Int behind = fleet.where[other].position, m = data.type[k].travel;
        const View<const Stop, 1> stops = fleet.stop[slot];
        if (!enlarge &&
            is_too_far_beside(legs_to(data.back, m, node), legs_from(data.leg, m, node), stops,
                              behind, other, data.rate[k].distance, best - data.rate[k].stop)) {
            continue;
        }
        const Int trip = stops[behind].trip;
        const auto [by, base] = serving_type(data, fleet, slot, trip, node, enlarge);
        if (by < 0 || (by != k && base >= best)) continue;
        const auto [cost, p] = scan_trip(data, fleet, slot, trip, behind - 1, behind, node, by,
                                         best - base, data.strategy.blink, searcher.rng);
        if (p >= 0) {
            best = cost + base;
            take_stop(searcher.scratch->move, slot, p, by);
        }
    }
    return best;
}

double scan_beside_lean(const ProblemData& data, const Searcher& searcher, Int node, double best,
                        bool enlarge) {
    const Fleet& fleet = searcher.now;
    for (const Int other : data.fit[node]) {
        if (other < 0) break;
        const Int slot = fleet.where[other].slot, behind = fleet.where[other].position;
        if (slot < 0) continue;
        const Int k = fleet.route[slot].type;
        const View<const Stop, 1> stops = fleet.stop[slot];
        const Int m = data.type[k].travel;
        if (!enlarge &&
            is_too_far_beside(legs_to(data.back, m, node), legs_from(data.leg, m, node), stops,
                              behind, other, data.rate[k].distance, best - data.rate[k].stop)) {
            continue;
        }
        if (!data.can(k, 0, node)) continue;
        const auto [by, base] = serving_type(data, fleet, slot, 0, node, enlarge);
        if (by < 0 || (by != k && base >= best)) continue;
        best = take_cheaper(data, searcher, slot, {behind - 1, behind}, node, {by, base}, best);
    }
    return best;
}

}  // namespace tandem

extern "C" int tandem_scan_beside_lean(const tandem_problem_data* data,
                                       const tandem_searcher* searcher, int64_t node, double best,
                                       bool enlarge, double* cost) {
    return tandem::guarded([&] {
        const tandem::ProblemData problem = tandem::data_of(*data);
        tandem::Searcher working = tandem::searcher_of(*searcher);
        tandem::Scratch scratch(problem, working);
        *cost = tandem::scan_beside_lean(problem, working, node, best, enlarge);
    });
}
