#include "search/route/refresh.h"
#include "search/route/rests.h"
#include "search/route/routes.h"

namespace tandem {
namespace {

Truck resting_truck(const ProblemData& data, const Tour& tour) {
    Truck truck(data, tour.route.type);
    if (truck.resting) truck.begin = begin_of(truck.type, tour.stops);
    return truck;
}

}  // namespace

RestRoute::RestRoute(const ProblemData& data, const Tour& tour, const LeastWork& least)
    : truck(resting_truck(data, tour)),
      type(truck.type),
      stops(tour.stops.first(tour.route.length)),
      sorties(tour.sorties.first(tour.route.sorties)),
      due(type, truck.begin),
      least_(least) {}

RestLabel RestRoute::beginning() const {
    RestLabel first{};
    first.depart = far;
    first.last = -1;
    first.timed = -1;
    first.time = begin_of(type, stops);
    first.driver = driver_from(type, first.time);
    return first;
}

// Return how long the leg from a stop is, that of one where a trip ends.
Int RestRoute::driving_at(Int p) const {
    if (stops[p].kind == end_stop || is_last(p)) return 0;
    return driving_from(truck.data, type, stops, p);
}

// Return how long service at a stop and the way to the next last, as far as nobody waits.
Int RestRoute::lasting_at(Int p) const {
    const Stop& stop = stops[p];
    const Int served = stop.kind == customer_stop ? truck.places[stop.node].service_duration() : 0;
    return is_last(p) ? served : served + stop.gap - resting_in_gap(type, stop);
}

Ahead all_of(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops) {
    const NodeTable places = data.place.by_truck(type);
    Ahead all{0, 0};
    for (Int p = 0; p < stops.size(); ++p) {
        const Stop& stop = stops[p];
        if (stop.kind == customer_stop) all.lasting += places[stop.node].service_duration();
        if (p + 1 == stops.size()) break;
        all.lasting += stop.gap - resting_in_gap(type, stop);
        if (stop.kind != end_stop) all.driving += driving_from(data, type, stops, p);
    }
    return all;
}

void RestRoute::note_latest() const {
    Int latest = far;
    for (Int p = stops.size() - 1; p >= 0; --p) {
        Stop& stop = stops[p];
        latest -= lasting_at(p);
        if (stop.kind == end_stop) latest = std::min(latest, last_end(type));
        if (has_window(stop)) latest = std::min(latest, truck.own[stop.node].latest_allowed());
        stop.latest = latest;
    }
}

LegAhead RestRoute::way_from(Int p, const Ahead& ahead, bool flying) const {
    const Int duration = driving_at(p);
    const Int setup =
        is_last(p) ? 0 : setup_after(truck.data.setup, stops[p].node, stops[p + 1].node);
    return {p,      duration,
            setup,  {ahead.driving - duration, ahead.lasting - lasting_at(p)},
            flying, !flying || may_rest_in_flights(type)};
}

bool RestRoute::reach_alone(Int p, Int time) const {
    truck.time_alone(stops[p], time);
    return stops[p].lo <= time && time <= stops[p].hi;
}

bool RestRoute::leave_block(RestLabel& label, Int first) const {
    const Stop& stop = stops[first];
    if (!truck.resting) label.depart = std::min(label.depart, stop.dep - label.cum);
    // With breaks, `d` is none, and when it leaves at best is asked behind.
    label.cum = std::max(label.cum + stop.d, none);
    label.time = std::max(label.time + stop.d, stop.c);
    return may_still_work(type, label.driver, label.time);
}

void RestRoute::arrive(RestLabel& label, const LegAhead& way, const RestedLeg& leg,
                       Int left) const {
    label.time = leg.time() + way.setup;
    if (!truck.resting) label.cum += label.time - left;
    if (has_driving_rules(type)) label.driver = leg.driver();
    label.driver.stood += way.setup;
    if (!limits_work(type)) label.driver.since = 0;
    label.on_leg = 0;
}

void RestRoute::reload(RestLabel& label, Int p) const {
    label.time += stops[p].gap;
    label.cum += stops[p].gap;
}

Stay RestRoute::stay_at(Int p, Int time) const {
    const Stop& stop = stops[p];
    const Int waits = has_window(stop) ? truck.places[stop.node].waiting(time) : 0;
    return {waits, truck.served_at(stop, time)};
}

Ending RestRoute::ending_of(const RestLabel& label) const {
    const bool lacks =
        label.next < due.count() && !none_due(type, due[label.next], truck.begin, label.time);
    return lacks ? no_ending : ending_of(label.time, working_of(label.time, label, label.cum));
}

Ending RestRoute::ending_of(Int end, Int working) const {
    if (!may_end(type, end)) return no_ending;
    if (truck.resting) return {0.0, end};
    if (!may_work(type, working)) return no_ending;
    return {work_cost(truck.data.rate[truck.k], paid_work(type, end, working)), end};
}

Int RestRoute::working_of(Int end, const RestLabel& label, Int cum) const {
    return end - counted_from(type, std::min(label.depart, end - cum));
}

Ending RestRoute::bound_of(const RestLabel& label, Int time, const Ahead& ahead) const {
    const Int more = ahead.lasting + least_pause(label, time, ahead);
    const Int end = std::max(time + more, least_.end);
    const Int working = working_of(end, label, label.cum + more);
    return ending_of(end, std::max(working, least_.working));
}

// Return how long a driver rests at least who is somewhere at an instant, by breaks that can't come
// too late any more, and by rules, as far as those breaks are no rests.
Int RestRoute::least_pause(const RestLabel& label, Int time, const Ahead& ahead) const {
    Int paused = 0, saved = 0;
    for (Int index = label.next; index < due.count(); ++index) {
        const Break pause = break_of(type, due[index], truck.begin);
        if (pause.latest >= time + ahead.lasting + paused) continue;
        paused += pause.duration;
        saved += most_saved_by(type, pause.duration);
    }
    const Int rests = least_rest(type, label.driver, time, ahead.driving, ahead.lasting);
    return paused + std::max(Int{0}, rests - saved);
}

void RestRoute::rest_nowhere(Int first, Int last) const {
    for (Int q = first; q < last; ++q) forget_rests(type, stops[q]);
}

void RestRoute::take(const TakenRest& taken) const {
    Stop& stop = stops[taken.stop];
    stop.rests = Rests(stop.rests).with(taken.number, RestPlace{taken.place}).packed();
    if (rests_in_gaps(type)) stop.gap += rest_duration(type, taken.number);
}

namespace {

// Return when a timed route begins that begins as late as that costs nothing.
Int last_begin(const ProblemData& data, const Tour& tour) {
    const Int departure = first_departure(data, tour);
    return counted_begin(data.type[tour.route.type], departure - tour.route.offset);
}

// Let a timed route without rests begin at `hold`, if it ends no later then. In place; false if
// not, and it is as before.
bool begin_later(const ProblemData& data, const Tour& tour, Int hold) {
    const auto& [route, stops, trips, sorties] = tour;
    const Int end = route.end, before = std::exchange(stops[0].hold, hold);
    if (drive_as_placed(data, tour) && route.end <= end) return true;
    stops[0].hold = before;
    drive_as_placed(data, tour);
    return false;
}

// Write rests and times of a route that begins no sooner than `hold`. In place; false if a rule is
// broken.
bool rest_from(const ProblemData& data, const Tour& tour, Int hold, const LeastWork& least) {
    const auto& [route, stops, trips, sorties] = tour;
    clear_rests(data.type[route.type], stops.first(route.length));
    stops[0].hold = hold;
    return place_rests(data, tour, least) && drive_as_placed(data, tour);
}

// Return when a timed route without rests ends, and how long it works.
LeastWork least_work(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const Int depart = std::min(stops[route.length - 1].depart, route.end - route.cum);
    return {route.end, route.end - counted_from(data.type[route.type], depart)};
}

// Return by how much later than soonest a timed route without drones may begin and end no later.
Int slack_of_begin(const ProblemData& data, const Tour& tour) {
    const NodeTable places = data.place.by_truck(data.type[tour.route.type]);
    Int waited = 0, slack = far;
    for (const Stop& stop : tour.stops.first(tour.route.length)) {
        if (!has_window(stop)) continue;
        const Windows place = places[stop.node];
        slack = std::min(slack, waited + place.as_late(stop.arrival) - stop.arrival);
        waited += place.waiting(stop.arrival);
    }
    return std::min(slack, waited);
}

// As `drive_by_rules`, where times hang on where breaks and rests are.
bool drive_with_pauses(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    route.driving = 0;
    const bool driven = drive_as_placed(data, tour);
    if (driven) {
        const Int driving = follows_driver(type) ? route.legs.duration
                            : has_driving_rules(type)
                                ? all_of(data, type, stops.first(route.length)).driving
                                : 0;
        const Int begin = counted_begin(type, begin_of(type, stops));
        if (!lacks_break(type, tour) && needs_no_rest(type, driving, route.end - begin)) {
            route.driving = driving;
            return true;
        }
    }
    // Whoever rests is later everywhere, which helps drones alone.
    if (!driven && route.sorties == 0) return false;
    const bool may_wait =
        driven && limits_work(type) && route.sorties == 0 && stops[0].hold == none;
    const Int slack = may_wait ? slack_of_begin(data, tour) : 0;
    route.driving = far;
    const Int later = begin_of(type, stops) + slack;
    const LeastWork least{driven ? route.end : none, 0};
    const bool rested = rest_from(data, tour, stops[0].hold, least);
    if (slack == 0) return rested;
    // Whoever begins later hasn't worked for so long.
    const Int end = rested ? route.end : far;
    if (rest_from(data, tour, later, least) && route.end <= end) return true;
    return rested && rest_from(data, tour, none, least);
}

}  // namespace

bool any_rest(const VehicleType& type, const Route& route) {
    return has_driving_rules(type) && route.driving == far;
}

bool drive_by_rules(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    clear_rests(type, stops.first(route.length));
    if (rests_in_time(type)) return drive_with_pauses(data, tour);
    if (!drive_as_placed(data, tour)) return false;
    const Int driving = all_of(data, type, stops.first(route.length)).driving;
    const Int soonest = counted_begin(type, begin_of(type, stops));
    const Int latest = last_begin(data, tour);
    route.driving = driving;
    // With drones, who may come in another order then, a route may have to begin before; so with
    // orders, by which all waits that comes behind others. Trips that are held back begin when they
    // are held, not as late as they may.
    const bool is_held = stops[0].hold != none || data.evaluation[route.type].held_back;
    const Int begin = route.sorties > 0 || lags_count(data) || is_held ? soonest : latest;
    if (needs_no_rest(type, driving, route.end - begin)) return true;
    const bool may_wait = stops[0].hold == none && latest > soonest;
    if (may_wait && needs_no_rest(type, driving, route.end - latest) &&
        begin_later(data, tour, latest)) {
        return true;
    }
    route.driving = far;
    const LeastWork least = least_work(data, tour);
    if (!rest_from(data, tour, stops[0].hold, least)) {
        // Whoever begins later hasn't worked for so long.
        return may_wait && rest_from(data, tour, latest, least);
    }
    if (!limits_work(type) || stops[0].hold != none) return true;
    const Int later = last_begin(data, tour);
    const Int end = route.end, working = end - later;
    if (later <= soonest) return true;
    if (rest_from(data, tour, later, least) && route.end <= end &&
        route.end - last_begin(data, tour) < working) {
        return true;
    }
    return rest_from(data, tour, none, least);
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
