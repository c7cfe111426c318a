

#include "search/route/block.h"

namespace tandem {
namespace {

// Call `visit` with the customers of sorties launched in a part, and when service begins there.
template <class Visit>
void for_each_flown(const ProblemData& data, View<const Sortie, 1> sorties, Part part,
                    const Visit& visit) {
    const NodeTable places = data.place[0];
    for (const Sortie& sortie : sorties) {
        if (sortie.launch < part.first || sortie.launch >= part.behind) continue;
        for (Int index = 0; index < sortie.count; ++index) {
            const Int node = sortie.nodes[index];
            visit(node, places[node].start_of_service(sortie.arrivals[index]));
        }
    }
}

// Call `visit` with all customers of a part, likewise.
template <class Visit>
void for_each_served(const ProblemData& data, View<const Stop, 1> stops,
                     View<const Sortie, 1> sorties, Part part, const Visit& visit) {
    for (Int p = part.first; p < part.behind; ++p) {
        if (stops[p].kind == customer_stop) visit(stops[p].node, stops[p].start);
    }
    for_each_flown(data, sorties, part, visit);
}

// Tell when service begins at customers of a part; `none` of others.
auto starts_on(const ProblemData& data, View<const Stop, 1> stops, View<const Sortie, 1> sorties,
               Part part) {
    return [=, &data](Int wanted) {
        Int found = none;
        for_each_served(data, stops, sorties, part, [&](Int node, Int start) {
            if (node == wanted) found = start;
        });
        return found;
    };
}

// When service begins at a customer on another route than that in a slot, as it is planned; `none`
// of others.
Int start_elsewhere(const Fleet& fleet, Int slot, Int node) {
    const Place& place = fleet.where[node];
    if (place.slot < 0 || place.slot == slot || place.position < 0) return none;
    const Stop& stop = fleet.stop(place.slot, place.position);
    return stop.kind == customer_stop && stop.node == node ? stop.free_start : none;
}

// From when to when a customer may be served, by those on other routes.
Span span_of(const ProblemData& data, Int node) {
    return is_bound(data.across, node) ? data.span[node] : Span{none, far};
}

// Tell whether a customer is on a route.
bool is_on(View<const Stop, 1> stops, Int node) {
    return std::ranges::any_of(
        stops, [&](const Stop& stop) { return stop.kind == customer_stop && stop.node == node; });
}

}  // namespace

void note_spans(const ProblemData& data, const Fleet& fleet, Int slot) {
    const View<const Stop, 1> stops = stops_of(fleet, slot);
    for (const Stop& stop : stops) {
        if (stop.kind != customer_stop || !is_bound(data.across, stop.node)) continue;
        data.span[stop.node] = span_by(lags_of(data.across, stop.node), [&](Int other) {
            return is_on(stops, other) ? none : start_elsewhere(fleet, slot, other);
        });
    }
}

void keep_starts(const ProblemData& data, const Tour& tour) {
    for (Stop& stop : tour.stops.first(tour.route.length)) {
        if (stop.kind == start_stop) stop.hold = stop.free_start;
        if (stop.kind != customer_stop || !is_bound(data.across, stop.node)) continue;
        data.span[stop.node] = {stop.free_start, stop.free_start};
    }
}

void plan_starts(const Tour& tour) {
    for (Stop& stop : tour.stops.first(tour.route.length)) {
        stop.free_start = stop.kind == start_stop
                              ? std::max({stop.arrival, stop.release, stop.hold})
                              : stop.start;
    }
}

Int await_others(const Truck& truck, View<Stop, 1> stops, View<const Sortie, 1> sorties, Int p,
                 Int arrival) {
    Stop& stop = stops[p];
    if (stop.kind != customer_stop) return none;
    const Windows place = truck.places[stop.node];
    const View<const Lag, 1> lags = lags_of(truck.data.lag, stop.node);
    const Span span = span_of(truck.data, stop.node);
    const Int ready =
        std::max({arrival, span.soonest,
                  soonest_behind(lags, starts_on(truck.data, stops, sorties, {0, p}))});
    if (place.too_late(ready)) return far;
    stop.start = place.start_of_service(ready);
    if (stop.start > span.latest) return far;
    return stop.start + place.service_duration();
}

bool keeps_all_lags(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const Part all{0, route.length};
    const View<const Sortie, 1> flown = sorties.first(route.sorties);
    const auto starts = starts_on(data, stops, flown, all);
    bool kept = true;
    for_each_served(data, stops, flown, all, [&](Int node, Int start) {
        kept = kept && keeps_lags(lags_of(data.lag, node), start, starts);
    });
    return kept;
}

Int most_lag_excess(const ProblemData& data, const Tour& tour, const Trip& trip) {
    const auto& [route, stops, trips, sorties] = tour;
    const Part part{trip.first, trip.last + 1};
    const View<const Sortie, 1> flown = sorties.first(route.sorties);
    const auto starts = starts_on(data, stops, flown, part);
    Int most = none;
    for_each_served(data, stops, flown, part, [&](Int node, Int start) {
        most = std::max(most, excess_of_lags(lags_of(data.lag, node), start, starts));
    });
    return most;
}

Int excess_within(const ProblemData& data, View<const Stop, 1> stops, View<const Sortie, 1> sorties,
                  Part part) {
    const auto starts = starts_on(data, stops, sorties, {0, part.behind});
    Int most = 0;
    for_each_served(data, stops, sorties, part, [&](Int node, Int start) {
        const View<const Lag, 1> lags = lags_of(data.lag, node);
        // A drone that comes too soon doesn't wait.
        most = std::max(
            {most, excess_of_lags(lags, start, starts), soonest_behind(lags, starts) - start});
    });
    return most;
}

Int latest_leave(const ProblemData& data, const Tour& tour, Int p, Int service_duration) {
    const auto& [route, stops, trips, sorties] = tour;
    const Int node = stops[p].node;
    Int latest = span_of(data, node).latest;
    const auto look_at = [&](Int behind, Int start) {
        latest = std::min(latest, latest_before(lags_of(data.lag, behind), node, start));
    };
    for (Int q = p + 1; q < route.length; ++q) {
        if (stops[q].kind == customer_stop) look_at(stops[q].node, stops[q].free_start);
    }
    for_each_flown(data, sorties.first(route.sorties), {0, route.length}, look_at);
    return latest == far ? far : latest + service_duration;
}

}  // namespace tandem
