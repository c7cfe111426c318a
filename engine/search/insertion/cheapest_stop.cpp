#include "search/insertion/cheapest_stop.h"

#include <algorithm>
#include <cmath>

#include "guard.h"
#include "rules/load.h"
#include "rules/shift.h"
#include "search/insertion/newcomer.h"
#include "search/route/goods.h"
#include "search/route/rarer.h"
#include "search/route/stop_loads.h"
#include "search/route/vehicles.h"

namespace tandem {
namespace {

// Tells whether to insert a customer beside stop `p` costs no less than `best`.
//
// By the triangle inequality, with a stop between which and this one the customer would come that
// is no nearer; beside that, if it is, the same place is looked at as well.
bool is_too_far_beside(const LegRow& inward, const LegRow& onward, View<const Stop, 1> stops, Int p,
                       double rate, double best) {
    const Int near = nearness(inward, onward, stops[p].node);
    return double(2 * near - std::max(stops[p - 1].leg, stops[p].leg)) * rate >= best;
}

// A stop behind which the detour is shortest, `nowhere` if that is none, and how long it is.
struct ShortestDetour {
    Int distance;
    Int stop;
};

// Returns the shortest detour for a customer on a lean route that is shorter than `best`.
ShortestDetour shortest_detour(const Newcomer& newcomer, const Room& room,
                               View<const Stop, 1> stops, Int last, Int best) {
    ShortestDetour found{best, nowhere};
    for (Int p = 0; p < last; ++p) {
        const Stop &here = stops[p], &behind = stops[p + 1];
        const Int further = newcomer.further(here.node, behind.node, here.leg);
        if (further >= found.distance || !room_behind(room, p)) continue;
        if (newcomer.comes_between(here.node, here.leave, behind.node, behind.latest)) {
            found = {further, p};
        } else if (newcomer.place.too_late(here.leave)) {
            break;
        }
    }
    return found;
}

// Tries the customer on a lean route that this turn doesn't change. False if the best place there
// is overlooked.
//
// Most turns are undone, so that most routes are as when the customer was inserted before.
bool try_kept(const Insertion& insertion, const Joining& joins, Kept& kept) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const Int slot = joins.slot, k = fleet.route[slot].type, stamp = fleet.route[slot].stamp;
    const double most = best.cost - joins.cost;
    if (kept.stamp != stamp || (kept.stop < 0 && double(kept.detour) * joins.rate < most)) {
        Int longest = far;
        // Also where distance costs nothing, or a larger vehicle saves more than any detour costs.
        if (std::abs(most) < double(far) * joins.rate) {
            longest = static_cast<Int>(most / joins.rate) + 1;
        }
        const ShortestDetour found = shortest_detour(
            newcomer_for(data, data.type[k], node), room_on(data, fleet, slot, k, node),
            fleet.stop[slot], fleet.trip(slot, 0).last, longest);
        kept = {stamp, found.distance, found.stop};
    }
    if (kept.stop < 0 || double(kept.detour) * joins.rate + joins.cost >= best.cost) return true;
    return best.try_behind(joins, kept.stop, kept.detour, [] { return true; });
}

// Tells whether a customer is known to cost no less than the best on a route as it is.
//
// That is so of most routes, so nothing else is asked of them.
bool is_too_far(const Insertion& insertion, Int slot) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Route& route = searcher.now.route[slot];
    if (enlarge || !data.strategy.scan_all || route.stamp == changing) return false;
    const Rate& rate = data.rate[route.type];
    const Kept& kept = searcher.kept(node, slot);
    return kept.stamp == route.stamp &&
           double(kept.detour) * rate.distance >= best.cost - rate.stop;
}

}  // namespace

bool is_simple(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    return data.evaluation[route.type].by_detour && route.sorties == 0;
}

bool may_join(const Insertion& insertion, Int slot, Int index, Joining& joins) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const Int k = fleet.route[slot].type;
    if (!goods_may_join(data, fleet, slot, index, node)) return false;
    if (takes(data, fleet, slot, index, k, node)) {
        joins = {slot, k, data.rate[k].distance, data.rate[k].stop};
        return true;
    }
    if (!enlarge) return false;
    const Haul haul = haul_of(fleet.trip(slot, 0));
    const Int by = larger_type(data, fleet, k, haul, node, [&, node = node](Int other) {
        return may_fit(data, fleet, slot, 0, other, node);
    });
    if (by < 0) return false;
    const double more = route_cost(data, by, haul) - fleet.cost[slot];
    joins = {slot, by, data.rate[by].distance, more + data.rate[by].stop};
    return joins.cost < best.cost;
}

void scan_trip(const Insertion& insertion, const Joining& joins, Int first, Int last, Int skipped) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const Int slot = joins.slot, k = fleet.route[slot].type;
    const VehicleType& type = data.type[k];
    const View<const Stop, 1> stops = fleet.stop[slot];
    const Trip& trip = fleet.trip(slot, stops[first].trip);
    const Newcomer newcomer = newcomer_for(data, type, node);
    const Room room = room_on(data, fleet, slot, joins.type, node);
    const Int spare = longest_trip(type) - trip.distance;
    const bool timed = data.evaluation[k].timed;
    // If the trip has to wait for the parcel, it leaves all its stops later.
    const Int release = release_of(newcomer.place);
    const bool waits = release > stops[trip.first].leave;
    Int leave = release;
    for (Int p = waits ? trip.first : first; p <= last; ++p) {
        const Stop &here = stops[p], &behind = stops[p + 1];
        if (!waits) {
            leave = here.leave;
        } else if (p > trip.first) {
            const Int arrival = leave + stops[p - 1].gap;
            if (arrival > here.latest) return;
            leave = data.place.by_truck(type)[here.node].end_of_service(arrival);
        } else if (leave > here.latest) {
            return;
        }
        if (p < first) continue;
        const Int further = newcomer.further(here.node, behind.node, here.leg);
        bool over = false;  // as soon as whoever leaves here comes too late
        best.try_behind(joins, p, further, [&] {
            over = newcomer.place.too_late(leave);
            return !over && further <= spare && p != skipped && room_behind(room, p) &&
                   newcomer.comes_between(here.node, leave, behind.node, behind.latest) &&
                   (!timed || price_stop(data, fleet, slot, p, newcomer) < infeasible);
        });
        if (over) return;
    }
}

void scan_simple(const Insertion& insertion, Int slot) {
    const Fleet& fleet = insertion.searcher.now;
    for (Int index = 0; index < fleet.route[slot].trips; ++index) {
        Joining joins;
        if (!may_join(insertion, slot, index, joins)) continue;
        const Trip& trip = fleet.trip(slot, index);
        scan_trip(insertion, joins, trip.first, trip.last - 1);
    }
}

void scan_beside(const Insertion& insertion) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    for (const Int other : data.granular[node]) {
        if (other < 0) break;
        const Int slot = fleet.where[other].slot;
        if (slot < 0) continue;
        const Int k = fleet.route[slot].type;
        if (!(is_simple(data, fleet, slot) && data.can(k, 0, node))) continue;
        const Int p = fleet.where[other].position, m = data.type[k].travel;
        const View<const Stop, 1> stops = fleet.stop[slot];
        const Rate& rate = data.rate[k];
        Joining joins;
        if ((enlarge ||
             !is_too_far_beside(legs_to(data.back, m, node), legs_from(data.leg, m, node), stops, p,
                                rate.distance, best.cost - rate.stop)) &&
            may_join(insertion, slot, stops[p].trip, joins)) {
            scan_trip(insertion, joins, p - 1, p);
        }
    }
}

void scan_lean(const Insertion& insertion) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    for (const Int slot : searcher.active.first(searcher.count->active)) {
        const Route& route = fleet.route[slot];
        Joining joins;
        if (is_too_far(insertion, slot) || !data.can(route.type, 0, node) ||
            !may_join(insertion, slot, 0, joins)) {
            continue;
        }
        // What is kept is where there is room on the vehicle as it is.
        const bool known = data.strategy.scan_all && route.stamp != changing &&
                           (joins.type == route.type || tiers_of(data) == 0);
        Kept& kept = searcher.kept(node, slot);
        if (known && try_kept(insertion, joins, kept)) continue;
        scan_trip(insertion, joins, 0, fleet.trip(slot, 0).last - 1, known ? kept.stop : nowhere);
    }
}

}  // namespace tandem

extern "C" int tandem_cost_beside(const tandem_problem_data* data, const tandem_searcher* searcher,
                                  int64_t node, double* cost) {
    using namespace tandem;
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        const Searcher working = searcher_of(*searcher);
        Best best{problem.strategy.blink, working.rng};
        scan_beside({problem, working, node, false, best});
        *cost = best.cost;
    });
}
