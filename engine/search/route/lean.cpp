#include "search/route/lean.h"

#include "rules/leg.h"
#include "rules/load.h"
#include "rules/shift.h"
#include "rules/start.h"
#include "rules/window.h"
#include "search/route/rarer.h"
#include "search/route/stop_loads.h"
#include "search/route/vehicles.h"

namespace tandem {
namespace {

// Move the stops from `p` on by one place. In place.
void shift_lean(const Fleet& fleet, Int slot, Int p) {
    const View<Stop, 1> stops = fleet.stop[slot];
    for (Int q = fleet.route[slot].length - 1; q >= p; --q) {
        copy_lean(stops[q], stops[q + 1]);
        if (stops[q].kind == customer_stop) fleet.where[stops[q].node].position = q + 1;
    }
    ++fleet.route[slot].length;
}

// Bring departures behind a new stop `p`, and latest arrivals before, up to date. In place.
void spread(NodeTable places, View<Stop, 1> stops, Int last, Int p) {
    Int time = stops[p - 1].leave;
    for (Int q = p; q <= last; ++q) {
        time += stops[q - 1].gap;
        if (q < last) time = places[stops[q].node].end_of_service(time);
        if (q > p && stops[q].leave == time) break;
        stops[q].leave = time;
    }
    Int latest = stops[p + 1].latest;
    for (Int q = p; q > 0; --q) {
        latest = places[stops[q].node].latest_arrival(latest - stops[q].gap);
        if (q < p && stops[q].latest == latest) return;
        stops[q].latest = latest;
    }
    stops[0].latest = latest - stops[0].gap;
}

}  // namespace

bool refresh_lean(const ProblemData& data, const Fleet& fleet, Int slot) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    Trip& trip = fleet.trip(slot, 0);
    const Int k = route.type, last = route.length - 1;
    const VehicleType& type = data.type[k];
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const NodeTable places = data.place.by_truck(type);
    clear_trip(trip);
    route.trips = 1;
    trip.last = last;
    Int time = leaves_first(type, type.shift_earliest);
    stops[0].leave = time;
    stops[0].flying = stops[0].trip = 0;
    for (Int p = 1; p <= last; ++p) {
        Stop &before = stops[p - 1], &stop = stops[p];
        const Leg way = leg(legs, before.node, stop.node);
        before.gap = way.duration;
        before.leg = way.distance;
        trip.distance += way.distance;
        time += way.duration;
        if (p < last) {
            const Windows place = places[stop.node];
            if (place.too_late(time)) return false;
            time = place.end_of_service(time);
            add_load(trip, demand_of(place));
        }
        stop.leave = time;
        stop.flying = stop.trip = 0;
    }
    stops[last].leg = stops[last].gap = 0;
    if (!may_make(type, trip)) return false;
    Int latest = last_end(type);
    stops[last].latest = latest;
    for (Int p = last - 1; p > 0; --p) {
        latest = places[stops[p].node].latest_arrival(latest - stops[p].gap);
        stops[p].latest = latest;
    }
    stops[0].latest = latest - stops[0].gap;
    fleet.cost[slot] = route_cost(data, k, haul_of(trip));
    if (tiers_aboard(fleet) > 0 && !weigh(data, fleet, slot)) return false;
    return may_end(type, time);
}

void insert_lean(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node) {
    shift_lean(fleet, slot, p + 1);
    const View<Stop, 1> stops = fleet.stop[slot];
    Trip& trip = fleet.trip(slot, 0);
    const Int k = fleet.route[slot].type;
    const VehicleType& type = data.type[k];
    const TravelLegs legs = legs_of(data.leg, type.travel);
    Stop &before = stops[p], &stop = stops[p + 1];
    stop.node = node;
    stop.kind = customer_stop;
    stop.flying = stop.trip = 0;
    fleet.where[node] = {slot, p + 1, nowhere};
    const Leg out = leg(legs, before.node, node), on = leg(legs, node, stops[p + 2].node);
    const Int detour = out.distance + on.distance - before.leg;
    before.gap = out.duration;
    before.leg = out.distance;
    stop.gap = on.duration;
    stop.leg = on.distance;
    ++trip.last;
    trip.distance += detour;
    fleet.cost[slot] += static_cast<double>(detour) * data.rate[k].distance + data.rate[k].stop;
    add_load(trip, demand_of(data.place[0][node]));
    spread(data.place.by_truck(type), stops, trip.last, p + 1);
    if (tiers_aboard(fleet) > 0) weigh(data, fleet, slot);
}

}  // namespace tandem
