#include "search/route/flown_trips.h"

#include "search/route/drone_data.h"
#include "search/route/lags.h"
#include "search/route/routes.h"

namespace tandem {
namespace {

// Return when a timed trip begins.
Int start_of(View<const Stop, 1> stops, const Trip& trip) { return stops[trip.first].leave; }

// Return what a timed trip leaves of a full battery.
Int left_behind(const ProblemData& data, const Tour& tour, const Trip& trip) {
    return follow_trip(data, tour, trip).left();
}

// The stops from `first` to `last` whose legs are known, with some between. `waits`: by the windows
// that are met when they are reached; else as if nobody waited.
struct Followed {
    View<const Stop, 1> stops;
    Int first, last;
    View<const Added, 1> added;
    bool waits;
};

FlownTrip follow(const ProblemData& data, const VehicleType& type, const Followed& followed) {
    const auto& [stops, first, last, added, waits] = followed;
    const NodeTable places = data.place.by_air(type);
    Int weight = 0;
    for (const Added& one : added) weight += weight_brought(places[one.node]);
    for (Int p = first + 1; p < last; ++p) weight += weight_brought(places[stops[p].node]);
    FlownTrip trip(type, weight);
    const Added* next = added.begin();
    for (Int p = first; p < last; ++p) {
        Int gap = stops[p].gap;
        bool from_depot = p == first;
        for (; next != added.end() && next->behind == p; ++next) {
            trip.fly_to(places[next->node], next->out, from_depot, 0);
            gap = next->on;
            from_depot = false;
        }
        if (p + 1 == last) {
            trip.fly_home(gap, from_depot);
        } else {
            const Windows place = places[stops[p + 1].node];
            const Stop& stop = stops[p + 1];
            const Int start = waits ? place.start_of_service(as_if_reached(data, stop)) : 0;
            trip.fly_to(place, gap, from_depot, waits ? start - stop.arrival : 0);
        }
    }
    return trip;
}

}  // namespace

FlownTrip follow_trip(const ProblemData& data, const Tour& tour, const Trip& trip) {
    return follow(data, data.type[tour.route.type], {tour.stops, trip.first, trip.last, {}, true});
}

bool reaches(const ProblemData& data, Int k, View<const Stop, 1> stops, const Trip& trip,
             Int customer) {
    const VehicleType& type = data.type[k];
    return !bounds_reach(type) || (in_range(data, type, stops[trip.first].node, customer) &&
                                   in_range(data, type, stops[trip.last].node, customer));
}

bool lasts_in_air(const ProblemData& data, Int k, View<const Stop, 1> stops, Int first, Int last,
                  View<const Added, 1> added) {
    const VehicleType& type = data.type[k];
    const NodeTable places = data.place.by_truck(type);
    Int busy = 0;
    const Added* next = added.begin();
    for (Int p = first; p < last; ++p) {
        Int gap = stops[p].gap;
        for (; next != added.end() && next->behind == p; ++next) {
            busy += next->out + places[next->node].service_duration();
            gap = next->on;
        }
        busy += stops[p].d + gap;
    }
    if (busy > longest_in_air(type)) return false;
    return !is_limited(type) || follow(data, type, {stops, first, last, added, false}).left() >= 0;
}

Int excess_in_air(const ProblemData& data, const Tour& tour, const Trip& trip) {
    const VehicleType& type = data.type[tour.route.type];
    const Int excess =
        tour.stops[trip.last].leave - start_of(tour.stops, trip) - longest_in_air(type);
    if (!is_limited(type)) return excess;
    return std::max(excess, follow_trip(data, tour, trip).excess());
}

Int waits_for_calm(const ProblemData& data, const Tour& tour, const Trip& trip) {
    const auto& [route, stops, trips, sorties] = tour;
    Int zones = 0;
    for (Int p = trip.first; p <= trip.last; ++p) zones |= zones_at(data.zones, stops[p].node);
    return wait_for_calm(data.type[route.type], start_of(stops, trip), stops[trip.last].leave,
                         zones);
}

Int waits_for_charge(const ProblemData& data, const Tour& tour, const Trip& trip,
                     const Charge& before) {
    const FlownTrip flown = follow_trip(data, tour, trip);
    return flown.left() < 0 ? far : flown.excess_of_charge(before, start_of(tour.stops, trip));
}

Charge charge_behind(const ProblemData& data, const Tour& tour, const Trip& trip,
                     const Charge& before) {
    const VehicleType& type = data.type[tour.route.type];
    const Int there = charged(type, before.kept, before.since, start_of(tour.stops, trip));
    const Int taken = battery_of(type) - left_behind(data, tour, trip);
    return {there - taken, tour.stops[trip.last].leave};
}

bool lacks_charge(const ProblemData& data, const Tour& tour) {
    Charge before = first_charge(data.type[tour.route.type], 0);
    for (const Trip& trip : tour.trips.first(tour.route.trips)) {
        if (left_behind(data, tour, trip) < 0) return true;
        before = charge_behind(data, tour, trip, before);
        if (before.kept < 0) return true;
    }
    return false;
}

}  // namespace tandem
