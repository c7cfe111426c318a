#include "search/route/freshness.h"

#include "rules/hub.h"
#include "search/route/charging.h"

namespace tandem {
namespace {

// Call `visit` with each customer of a timed trip, when he is reached, and the first stop that
// comes no sooner.
template <class Visit>
void for_each_reached(const ProblemData& data, const Tour& tour, const Trip& trip,
                      const Visit& visit) {
    for (Int p = trip.first; p <= trip.last; ++p) {
        const Stop& stop = tour.stops[p];
        if (stop.kind == customer_stop) visit(stop.node, as_if_reached(data, stop), p);
    }
    for (const Sortie& sortie : tour.sorties.first(tour.route.sorties)) {
        if (sortie.launch < trip.first || sortie.launch > trip.last) continue;
        for (Int visited = 0; visited < sortie.count; ++visited) {
            visit(sortie.nodes[visited], sortie.arrivals[visited], sortie.launch + 1);
        }
    }
}

// Return by how much a parcel is too long aboard on a timed trip; at most 0 if none is.
Int excess_of_parcels(const ProblemData& data, const Tour& tour, const Trip& trip) {
    const Int departure = departure_of(data, tour, trip.first);
    const NodeTable places = data.place[0];
    Int most = -far;
    for_each_reached(data, tour, trip, [&](Int node, Int arrival, Int) {
        const Int start = places[node].start_of_service(arrival);
        most = std::max(most, excess_aboard(data.max_time_aboard, node, departure, start));
    });
    return most;
}

// Return by how much a shipment is too long under way on a timed trip; at most 0 if none is.
Int excess_of_pairs(const ProblemData& data, const Tour& tour, const Trip& trip) {
    const auto& [route, stops, trips, sorties] = tour;
    const View<const Int, 1> limits = data.max_between[route.type];
    const NodeTable places = data.place.by_truck(data.type[route.type]);
    Int most = -far;
    for_each_reached(data, tour, trip, [&](Int node, Int arrival, Int behind) {
        if (!is_delivery(data.pair, node)) return;
        const Int start = places[node].start_of_service(arrival);
        for (Int q = behind - 1; q > trip.first; --q) {
            const Int pickup = stops[q].node;
            if (stops[q].kind != customer_stop || !brings(data.pair, pickup, node)) continue;
            const Int left = places[pickup].end_of_service(as_if_reached(data, stops[q]));
            most = std::max(most, excess_between(limits, pickup, left, start));
        }
        for (const Sortie& sortie : sorties.first(route.sorties)) {
            for (Int visit = 0; visit < sortie.count; ++visit) {
                const Int pickup = sortie.nodes[visit];
                if (!brings(data.pair, pickup, node)) continue;
                const Int row = row_of_drone(data.type, route.type, sortie.drone);
                const Int left = data.place.by_air(data.type[row])[pickup].end_of_service(
                    sortie.arrivals[visit]);
                most = std::max(most, excess_between(limits, pickup, left, start));
            }
        }
    });
    return most;
}

}  // namespace

Int most_excess(const ProblemData& data, const Tour& tour, const Trip& trip) {
    Int most = -far;
    if (time_aboard_counts(data)) most = excess_of_parcels(data, tour, trip);
    if (!data.max_between.empty()) {
        most = std::max(most, excess_of_pairs(data, tour, trip));
    }
    if (lags_count(data)) {
        most = std::max(most, most_lag_excess(data, tour, trip));
    }
    if (bounds_trips(data.type[tour.route.type])) {
        most = std::max(most, excess_in_air(data, tour, trip));
    }
    return most;
}

Int time_to_turn(const ProblemData& data, const Tour& tour, const Trip& trip) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    const NodeTable places = data.place.by_truck(type);
    Int soonest = far;
    for (Int p = trip.first + 1; p <= trip.last; ++p) {
        const Stop& stop = stops[p];
        const Stop& before = stops[p - 1];
        const Int driven = stop.arrival - setup_beside(type, data.setup, before.node, stop.node);
        soonest = std::min(soonest,
                           time_to_turn(type, data.profile_time[route.type], before.leave, driven));
        if (!has_window(stop)) continue;
        const Int open = orders_cross(data) ? data.span[stop.node].soonest : none;
        soonest = std::min(soonest, time_to_turn(places[stop.node], stop.arrival, open));
    }
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        if (sortie.launch < trip.first || sortie.launch > trip.last) continue;
        const Int row = row_of_drone(data.type, route.type, sortie.drone);
        for (Int visit = 0; visit < sortie.count; ++visit) {
            const Windows place = data.place.by_air(data.type[row])[sortie.nodes[visit]];
            soonest = std::min(soonest, time_to_turn(place, sortie.arrivals[visit], none));
        }
    }
    return soonest;
}

Int departure_of(const ProblemData& data, const Tour& tour, Int first) {
    const auto& [route, stops, trips, sorties] = tour;
    Int departure = far;
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        if (sortie.launch == first) departure = std::min(departure, sortie.takeoff);
    }
    if (departure != far) return departure;
    const Stop& stop = stops[first];
    return leaves_first(data.type[route.type],
                        std::max(stop.arrival, std::max(stop.release, stop.hold)));
}

bool holds_count(const ProblemData& data, Int k) {
    return time_aboard_counts(data) || !data.max_between.empty() || lags_count(data) ||
           bounds_trips(data.type[k]);
}

bool any_too_long(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    if (!holds_count(data, route.type)) return false;
    const VehicleType& type = data.type[route.type];
    if (shares_chargers(type) ? !is_charged_in_turn(data, tour)
                              : charges_between_trips(type) && lacks_charge(data, tour)) {
        return true;
    }
    if (lags_count(data) && !keeps_all_lags(data, tour)) return true;
    const View<const Trip, 1> made = trips.first(route.trips);
    return std::ranges::any_of(made, [&](const Trip& trip) {
        return most_excess(data, tour, trip) > 0 || waits_for_calm(data, tour, trip) > 0;
    });
}

namespace {

// As `hold_trips`, one trip after another.
bool hold_in_turn(const ProblemData& data, const Tour& tour) {
    const VehicleType& type = data.type[tour.route.type];
    const bool charging = charges_between_trips(type);
    Charge charge = charging ? first_charge(type, 0) : Charge{};
    for (const Trip& trip : tour.trips.first(tour.route.trips)) {
        const auto wait = [&] { return charging ? waits_for_charge(data, tour, trip, charge) : 0; };
        if (!hold_trip(data, tour, trip, wait)) return false;
        if (charging) charge = charge_behind(data, tour, trip, charge);
    }
    return true;
}

}  // namespace

bool hold_trips(const ProblemData& data, const Tour& tour) {
    if (!hold_in_turn(data, tour)) return false;
    if (!may_pause(data.type[tour.route.type])) return true;
    const auto lasts_too_long = [&](const Trip& trip) { return most_excess(data, tour, trip) > 0; };
    const View<const Trip, 1> made = tour.trips.first(tour.route.trips);
    if (std::ranges::none_of(made, lasts_too_long)) return true;
    // A trip that was held moved a rest to one before it.
    return hold_in_turn(data, tour) && std::ranges::none_of(made, lasts_too_long);
}

}  // namespace tandem
