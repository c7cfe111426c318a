#include "search/route/flown_trips.h"

#include <algorithm>

#include "search/route/routes.h"

namespace tandem {
namespace {

// Return when a timed trip begins.
Int start_of(View<const Stop, 1> stops, const Trip& trip) { return stops[trip.first].leave; }

// Return with what a vehicle ends a trip, and when it begins to be charged.
Charge charge_behind(const VehicleType& type, View<const Stop, 1> stops, const Trip& trip,
                     const Charge& before, Int left) {
    const Int there = charged(type, before.kept, before.since, start_of(stops, trip));
    return {there - (battery_of(type) - left), stops[trip.last].leave};
}

}  // namespace

FlownTrip follow_trip(const ProblemData& data, Int k, View<const Stop, 1> stops, Int first,
                      Int last, const Added& added, bool waits) {
    const VehicleType& type = data.type[k];
    const NodeTable places = data.place.by_air(type);
    Int weight = added.node < 0 ? 0 : weight_brought(places[added.node]);
    for (Int p = first + 1; p < last; ++p) weight += weight_brought(places[stops[p].node]);
    FlownTrip trip(type, weight);
    for (Int p = first; p < last; ++p) {
        Int gap = stops[p].gap;
        bool from_depot = p == first;
        if (p == added.behind) {
            trip.fly_to(places[added.node], added.out, from_depot, 0);
            gap = added.on;
            from_depot = false;
        }
        if (p + 1 == last) {
            trip.fly_home(gap, from_depot);
        } else {
            const Windows place = places[stops[p + 1].node];
            trip.fly_to(place, gap, from_depot, waits ? place.waiting(stops[p + 1].arrival) : 0);
        }
    }
    return trip;
}

bool lasts_in_air(const ProblemData& data, Int k, View<const Stop, 1> stops, Int first, Int last,
                  const Added& added) {
    const VehicleType& type = data.type[k];
    Int busy = 0;
    for (Int p = first; p < last; ++p) busy += stops[p].d + stops[p].gap;
    if (added.node >= 0) {
        busy += added.out + added.on - stops[added.behind].gap +
                data.place.by_truck(type)[added.node].service_duration();
    }
    if (busy > longest_in_air(type)) return false;
    return !is_limited(type) || follow_trip(data, k, stops, first, last, added, false).left() >= 0;
}

Int excess_in_air(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                  const Trip& trip) {
    const VehicleType& type = data.type[route.type];
    const Int excess = stops[trip.last].leave - start_of(stops, trip) - longest_in_air(type);
    if (!is_limited(type)) return excess;
    return std::max(
        excess,
        follow_trip(data, route.type, stops, trip.first, trip.last, nobody_added, true).excess());
}

bool charge_trips(const ProblemData& data, Route& route, View<Stop, 1> stops,
                  View<const Trip, 1> trips, View<Sortie, 1> sorties) {
    const VehicleType& type = data.type[route.type];
    Charge before = first_charge(type, 0);
    for (const Trip& trip : trips.first(route.trips)) {
        Int left = 0;
        while (true) {
            left = follow_trip(data, route.type, stops, trip.first, trip.last, nobody_added, true)
                       .left();
            if (left < 0) return false;
            const Int ready = time_charged(type, before.kept, before.since, left);
            if (start_of(stops, trip) >= ready) break;
            stops[trip.first].release = std::max(stops[trip.first].release, ready);
            if (!drive_forward(data, route, stops, sorties)) return false;
        }
        before = charge_behind(type, stops, trip, before, left);
    }
    return true;
}

bool lacks_charge(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                  View<const Trip, 1> trips) {
    const VehicleType& type = data.type[route.type];
    Charge before = first_charge(type, 0);
    for (const Trip& trip : trips.first(route.trips)) {
        const Int left =
            follow_trip(data, route.type, stops, trip.first, trip.last, nobody_added, true).left();
        before = charge_behind(type, stops, trip, before, left);
        if (left < 0 || before.kept < 0) return true;
    }
    return false;
}

}  // namespace tandem
