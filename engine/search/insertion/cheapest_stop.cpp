#include "search/insertion/cheapest_stop.h"

#include <cmath>

#include "search/route/goods.h"
#include "search/route/stop_loads.h"
#include "search/search.h"

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

// Tells whether somebody may serve a customer more on a trip, and who that is: a larger type if
// that may be.
bool may_join(const Insertion& insertion, Int slot, Int index, Joining& joins) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const Int k = fleet.route[slot].type;
    if (!goods_may_join(data, fleet, slot, index, node)) return false;
    if (takes(data, fleet, slot, index, k, node)) {
        joins = {node, slot, k, data.rate[k].distance,
                 data.rate[k].stop + vehicle_cost_at(data.vehicle_cost, k, node)};
        return true;
    }
    if (!enlarge) return false;
    const Haul haul = haul_of(fleet.trip(slot, 0));
    const Int by = larger_type(data, fleet, k, haul, node, [&, node = node](Int other) {
        return may_fit(data, fleet, slot, 0, other, node);
    });
    if (by < 0) return false;
    const double more = route_cost(data, by, haul) - fleet.cost[slot];
    joins = {node, slot, by, data.rate[by].distance, more + data.rate[by].stop};
    return joins.cost < best.cost;
}

// Tries the customer behind some stops of a trip where only distance counts.
void scan_trip(const Insertion& insertion, const Joining& joins, Int first, Int last) {
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
    Front front{release};
    for (Int p = waits ? trip.first : first; p <= last; ++p) {
        const Stop &here = stops[p], &behind = stops[p + 1];
        if (!waits) {
            front = {here.leave};
        } else {
            if (p > trip.first) front.drive(stops[p - 1].gap);
            if (front.time > here.latest) return;
            if (p > trip.first) front.serve(data.place.by_truck(type)[here.node]);
        }
        if (p < first) continue;
        const Int further = newcomer.further(here.node, behind.node, here.leg);
        bool over = false;  // as soon as whoever leaves here comes too late
        best.try_behind(joins, p, further, [&] {
            over = newcomer.place.too_late(front.time);
            return !over && further <= spare && room_behind(room, p) &&
                   newcomer.comes_between(here.node, front, behind.node, {behind.latest}) &&
                   (!timed || price_stop(data, fleet, slot, p, newcomer) < infeasible);
        });
        if (over) return;
    }
}

}  // namespace

void scan_simple(const Insertion& insertion, Int slot) {
    const Fleet& fleet = insertion.searcher.now;
    for (Int index = 0; index < fleet.route[slot].trips; ++index) {
        Joining joins;
        if (!may_join(insertion, slot, index, joins)) continue;
        const Trip& trip = fleet.trip(slot, index);
        scan_trip(insertion, joins, trip.first, trip.last - 1);
    }
}

void scan_beside(const Insertion& insertion, Int other) {
    const auto& [data, searcher, node, enlarge, best] = insertion;
    const Fleet& fleet = searcher.now;
    const Int slot = fleet.where[other].slot;
    const Int k = fleet.route[slot].type;
    if (!(is_simple(data, fleet.route[slot]) && data.can(k, 0, node))) return;
    const Int p = fleet.where[other].position, m = data.type[k].travel;
    const View<const Stop, 1> stops = fleet.stop[slot];
    const Rate& rate = data.rate[k];
    Joining joins;
    if ((enlarge || !is_too_far_beside(legs_to(data.back, m, node), legs_from(data.leg, m, node),
                                       stops, p, rate.distance, best.cost - rate.stop)) &&
        may_join(insertion, slot, stops[p].trip, joins)) {
        scan_trip(insertion, joins, p - 1, p);
    }
}

}  // namespace tandem
