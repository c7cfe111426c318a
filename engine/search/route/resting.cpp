#include "search/route/refresh.h"
#include "search/route/rests.h"
#include "search/route/routes.h"

namespace tandem {
namespace {

// Return how long a driver of a route without rests is at the wheel.
Int driving_on(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops) {
    Int driving = 0;
    for (Int p = 0; p < stops.size(); ++p) {
        if (stops[p].kind != end_stop) driving += driving_from(data, type, stops, p);
    }
    return driving;
}

// Return when a timed route begins that begins as late as that costs nothing.
Int last_begin(const ProblemData& data, Route& route, View<const Stop, 1> stops,
               View<const Sortie, 1> sorties) {
    const Int departure = first_departure(data, route, stops, sorties);
    return counted_begin(data.type[route.type], departure - route.offset);
}

// Let a timed route without rests begin at `hold`, if it ends no later then. In place; false if
// not, and it is as before.
bool begin_later(const ProblemData& data, Route& route, View<Stop, 1> stops,
                 View<Sortie, 1> sorties, Int hold) {
    const Int end = route.end, before = std::exchange(stops[0].hold, hold);
    if (drive_as_placed(data, route, stops, sorties) && route.end <= end) return true;
    stops[0].hold = before;
    drive_as_placed(data, route, stops, sorties);
    return false;
}

// Write rests and times of a route that begins no sooner than `hold`. In place; false if a rule is
// broken.
bool rest_from(const ProblemData& data, Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties,
               Int hold, const LeastWork& least) {
    clear_rests(data.type[route.type], stops.first(route.length));
    stops[0].hold = hold;
    return place_rests(data, route, stops, sorties, least) &&
           drive_as_placed(data, route, stops, sorties);
}

// Return when a timed route without rests ends, and how long it works.
LeastWork least_work(const ProblemData& data, const Route& route, View<const Stop, 1> stops) {
    const Int depart = std::min(stops[route.length - 1].depart, route.end - route.cum);
    return {route.end, route.end - counted_from(data.type[route.type], depart)};
}

// Return by how much later than soonest a timed route without drones may begin and end no later.
Int slack_of_begin(const ProblemData& data, const Route& route, View<const Stop, 1> stops) {
    const NodeTable places = data.place.by_truck(data.type[route.type]);
    Int waited = 0, slack = far;
    for (const Stop& stop : stops.first(route.length)) {
        if (!has_window(stop)) continue;
        const Windows place = places[stop.node];
        slack = std::min(slack, waited + place.as_late(stop.arrival) - stop.arrival);
        waited += place.waiting(stop.arrival);
    }
    return std::min(slack, waited);
}

// As `drive_by_rules`, where times hang on where breaks and rests are.
bool drive_with_pauses(const ProblemData& data, Route& route, View<Stop, 1> stops,
                       View<Sortie, 1> sorties) {
    const VehicleType& type = data.type[route.type];
    route.driving = 0;
    const bool driven = drive_as_placed(data, route, stops, sorties);
    if (driven) {
        const Int driving = follows_driver(type) ? route.legs.duration
                            : has_driving_rules(type)
                                ? driving_on(data, type, stops.first(route.length))
                                : 0;
        const Int begin = counted_begin(type, begin_of(type, stops));
        if (!lacks_break(type, route, stops) && needs_no_rest(type, driving, route.end - begin)) {
            route.driving = driving;
            return true;
        }
    }
    // Whoever rests is later everywhere, which helps drones alone.
    if (!driven && route.sorties == 0) return false;
    const bool may_wait =
        driven && limits_work(type) && route.sorties == 0 && stops[0].hold == none;
    const Int slack = may_wait ? slack_of_begin(data, route, stops) : 0;
    route.driving = far;
    const Int later = begin_of(type, stops) + slack;
    const LeastWork least{driven ? route.end : none, 0};
    const bool rested = rest_from(data, route, stops, sorties, stops[0].hold, least);
    if (slack == 0) return rested;
    // Whoever begins later hasn't worked for so long.
    const Int end = rested ? route.end : far;
    if (rest_from(data, route, stops, sorties, later, least) && route.end <= end) return true;
    return rested && rest_from(data, route, stops, sorties, none, least);
}

}  // namespace

bool any_rest(const VehicleType& type, const Route& route) {
    return has_driving_rules(type) && route.driving == far;
}

bool may_save_more(const ProblemData& data, const Route& route) {
    const VehicleType& type = data.type[route.type];
    return idle_time(route) > 0 || is_dearer(data.rate[route.type], work_of(type, route)) ||
           any_rest(type, route);
}

bool drive_by_rules(const ProblemData& data, Route& route, View<Stop, 1> stops,
                    View<Sortie, 1> sorties) {
    const VehicleType& type = data.type[route.type];
    clear_rests(type, stops.first(route.length));
    if (rests_in_time(type)) return drive_with_pauses(data, route, stops, sorties);
    if (!drive_as_placed(data, route, stops, sorties)) return false;
    const Int driving = driving_on(data, type, stops.first(route.length));
    const Int soonest = counted_begin(type, begin_of(type, stops));
    const Int latest = last_begin(data, route, stops, sorties);
    route.driving = driving;
    // With drones, who may come in another order then, a route may have to begin before; so with
    // orders, by which all waits that comes behind others. Trips that are held back begin when they
    // are held, not as late as they may.
    const bool is_held = stops[0].hold != none || data.evaluation[route.type].held_back;
    const Int begin = route.sorties > 0 || lags_count(data) || is_held ? soonest : latest;
    if (needs_no_rest(type, driving, route.end - begin)) return true;
    const bool may_wait = stops[0].hold == none && latest > soonest;
    if (may_wait && needs_no_rest(type, driving, route.end - latest) &&
        begin_later(data, route, stops, sorties, latest)) {
        return true;
    }
    route.driving = far;
    const LeastWork least = least_work(data, route, stops);
    if (!rest_from(data, route, stops, sorties, stops[0].hold, least)) {
        // Whoever begins later hasn't worked for so long.
        return may_wait && rest_from(data, route, stops, sorties, latest, least);
    }
    if (!limits_work(type) || stops[0].hold != none) return true;
    const Int later = last_begin(data, route, stops, sorties);
    const Int end = route.end, working = end - later;
    if (later <= soonest) return true;
    if (rest_from(data, route, stops, sorties, later, least) && route.end <= end &&
        route.end - last_begin(data, route, stops, sorties) < working) {
        return true;
    }
    return rest_from(data, route, stops, sorties, none, least);
}

bool may_have_to_rest(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node) {
    const Route& route = fleet.route[slot];
    const VehicleType& type = data.type[route.type];
    const View<const Stop, 1> stops = fleet.stop[slot];
    if (any_rest(type, route) || (route.sorties > 0 && limits_work(type))) return true;
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Int longer = leg(legs, stops[p].node, node).duration +
                       leg(legs, node, stops[p + 1].node).duration - stops[p].gap;
    const Int more = std::max(Int{0}, longer);
    const Int served = data.place.by_truck(type)[node].service_duration();
    return !needs_no_rest(type, route.driving + more, route.working + more + served);
}

}  // namespace tandem
