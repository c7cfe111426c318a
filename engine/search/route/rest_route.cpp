#include "search/route/rests.h"

namespace tandem {
namespace {

Truck resting_truck(const ProblemData& data, const Route& route, View<const Stop, 1> stops) {
    Truck truck(data, route.type);
    if (truck.resting) truck.begin = begin_of(truck.type, stops);
    return truck;
}

}  // namespace

RestRoute::RestRoute(const ProblemData& data, const Route& route, View<Stop, 1> row,
                     View<Sortie, 1> flights, const LeastWork& least)
    : truck(resting_truck(data, route, row)),
      type(truck.type),
      stops(row.first(route.length)),
      sorties(flights.first(route.sorties)),
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

Ahead RestRoute::whole() const {
    Ahead ahead{0, 0};
    for (Int p = 0; p < stops.size(); ++p) {
        ahead.driving += driving_at(p);
        ahead.lasting += lasting_at(p);
    }
    return ahead;
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
    if (!limits_work(type)) label.driver.since = 0;
    label.on_leg = 0;
}

void RestRoute::reload(RestLabel& label, Int p) const {
    label.time += stops[p].gap;
    label.cum += stops[p].gap;
}

Stay RestRoute::stay_at(Int p, Int time) const {
    const Stop& stop = stops[p];
    if (!has_window(stop)) return {0, time};
    const Windows place = truck.places[stop.node];
    return {place.waiting(time), place.end_of_service(time)};
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

}  // namespace tandem
