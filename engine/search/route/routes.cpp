#include "search/route/routes.h"

#include "rules/launch_place.h"
#include "search/route/ends.h"
#include "search/route/flown_trips.h"
#include "search/route/rests.h"

namespace tandem {

namespace {

// Tell whether the truck stops at a launch site only once its customer has been served, if it has
// one: by the truck before, or by a drone that has been recovered before.
bool halts_in_order(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    for (Int p = 0; p < route.length; ++p) {
        if (stops[p].kind != halt_stop) continue;
        const Int node = data.halt_after[stops[p].node];
        if (node < 0) continue;
        const View<const Stop, 1> before = stops.first(p);
        const View<const Sortie, 1> flown = sorties.first(route.sorties);
        const bool is_served =
            std::ranges::any_of(before,
                                [&](const Stop& stop) {
                                    return stop.kind == customer_stop && stop.node == node;
                                }) ||
            std::ranges::any_of(flown, [&](const Sortie& sortie) {
                return sortie.recovery < p && sortie.serves(node);
            });
        if (!is_served) return false;
    }
    return true;
}

// Return what it costs on top by which vehicle a route's customers are served.
double vehicle_cost_on(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const View<const double, 1> price = data.vehicle_cost[route.type];
    double cost = 0.0;
    for (const Stop& stop : stops.first(route.length)) cost += price[stop.node];
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        for (const Int node : sortie.customers()) cost += price[node];
    }
    return cost;
}

// Tell whether all customers of a trip are near enough to where it begins and ends.
bool reaches_all(const ProblemData& data, Int k, View<const Stop, 1> stops, const Trip& trip) {
    if (!bounds_reach(data.type[k])) return true;
    for (Int p = trip.first + 1; p < trip.last; ++p) {
        if (!reaches(data, k, stops, trip, stops[p].node)) return false;
    }
    return true;
}

// Return how long the truck is on its legs, whose times are known.
Int timed_travel(const Truck& truck, View<const Stop, 1> stops) {
    Int travel = 0;
    Driver driver = driver_from(truck.type, truck.begin);
    for (Int p = 0; p + 1 < stops.size(); ++p) {
        if (stops[p].kind == end_stop) continue;
        travel += truck.leg_behind(stops[p], stops[p + 1].node, stops[p].leave).driven(driver);
    }
    return travel;
}

}  // namespace

Leg leg_between(const ProblemData& data, const VehicleType& type, Int from, Int to) {
    const Int setup = is_steady(type) ? setup_after(data.setup, from, to) : 0;
    return {leg(legs_of(data.leg, type.travel), from, to).duration - setup,
            leg(legs_of(data.leg, limited_travel(type)), from, to).distance};
}

Leg legs_on(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops, Int first,
            Int last) {
    Leg legs{};
    for (Int p = first; p < last; ++p) {
        if (stops[p].kind == end_stop) continue;
        legs = legs + leg_between(data, type, stops[p].node, stops[p + 1].node);
    }
    return legs;
}

bool load_trips(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const Int k = route.type;
    const VehicleType& type = data.type[k];
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Int most_trips = std::min(type.max_trips, trips.size());
    if (is_apart(data, k)) place_ends(data, k, tour);
    Int index = -1, s = 0, flown = 0;
    for (Int p = 0; p < route.length; ++p) {
        Stop& stop = stops[p];
        if (stop.kind == start_stop) {
            if (++index >= most_trips) return false;
            clear_trip(trips[index]);
            trips[index].first = p;
            flown = s;
        }
        Trip& trip = trips[index];
        stop.trip = index;
        stop.rests = 0;
        if (stop.kind == customer_stop) {
            carry(data, trip, stop.node);
        } else if (stop.kind == halt_stop) {
            if (!may_halt(data.halts, k, stop.node)) return false;
            ++trip.halts;
        }
        for (; s < route.sorties && sorties[s].launch == p; ++s) {
            for (const Int node : sorties[s].customers()) carry(data, trip, node);
        }
        if (stop.kind == end_stop) {
            trip.last = p;
            stops[trip.first].release = trip.release;
            if (trip.distance > longest_trip(type) || !may_make(type, trip) ||
                !reaches_all(data, k, stops, trip) || !allows_sorties(type, s - flown) ||
                !have_batteries(data.type, k, sorties, flown, s)) {
                return false;
            }
            stop.leg = 0;
            stop.gap = type.reload_duration;
        } else {
            const Leg way = leg(legs, stop.node, stops[p + 1].node);
            stop.gap = way.duration;
            stop.leg = way.distance;
            trip.distance += way.distance;
        }
    }
    route.trips = index + 1;
    route.placed = breaks_by_end;
    if (limits_legs(type)) {
        route.legs = legs_on(data, type, stops, 0, route.length - 1);
        if (!may_drive_all(type, route.legs)) return false;
    }
    return !has_halts(data) || halts_in_order(data, tour);
}

bool drive_forward(const ProblemData& data, const Tour& tour) {
    const VehicleType& type = data.type[tour.route.type];
    if (!may_pause(type)) return drive_as_placed(data, tour);
    if (tour.route.placed == breaks_by_end) return drive_by_rules(data, tour);
    return drive_as_placed(data, tour) &&
           (tour.route.placed == breaks_left_out || !lacks_break(type, tour));
}

bool drive_as_placed(const ProblemData& data, const Tour& tour) {
    Route& route = tour.route;
    Truck truck(data, route.type);
    if (truck.resting) truck.begin = begin_of(truck.type, tour.stops);
    route.unpaid = 0;
    const Int length = route.length;
    const View<Stop, 1> stops = tour.stops.first(length);
    const View<Sortie, 1> sorties = tour.sorties.first(route.sorties);
    PaidFront front{truck.type.shift_earliest, 0, far};
    BlockSums sums;
    sums.driver = driver_from(truck.type, truck.begin);
    const bool rested = truck.follows && any_rest(truck.type, route);
    make_ready(truck, stops, sorties);
    for (Int p = 0; p < length;) {
        const Int last = pass_block(truck, stops, sorties, p, sums, front);
        if (last < 0) return false;
        const Stop& behind = stops[last];
        front.drive(behind.gap);
        if (behind.kind != end_stop) {
            const Int next = stops[last + 1].node;
            front.time = truck.travel(behind.node, next, behind.gap, {none, behind.leave}).c;
            if (truck.pauses(behind)) {
                front.time = truck.come(behind, next, behind.leave, sums.driver);
                if (front.time == far ||
                    (rested && may_drive(truck.type, sums.driver, front.time) < 0)) {
                    return false;
                }
            }
        }
        p = last + 1;
    }
    if (truck.resting) route.unpaid = unpaid_on(truck.type, stops);
    route.end = stops[length - 1].leave;
    route.cum = stops[length - 1].cum;
    route.awaited = sums.awaited;
    if (!truck.follows && !limits_timed_travel(truck.type)) return true;
    route.legs.duration = timed_travel(truck, stops);
    return may_travel(truck.type, route.legs.duration);
}

void look_back(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const NodeTable places = data.place.by_truck(data.type[route.type]);
    const bool single = places[0].are_single();
    PaidRear rear{far, none, 0, none};
    for (Int q = route.length - 1; q >= 0;) {
        if (q < route.length - 1) rear.drive(stops[q].gap);
        const Int p = stops[q].block;
        Stop& stop = stops[p];
        Rear alone{rear.latest};
        rear.pass({stop.d, stop.c}, {stop.lo, stop.hi});
        if (has_window(stop) && !single) {
            // No drone flies, or the route would be retimed.
            alone.serve(places[stop.node]);
            rear.latest = alone.latest;
        }
        stop.latest = rear.latest;
        stop.early = rear.early;
        stop.rest = rear.busy;
        stop.end = rear.end;
        q = p - 1;
    }
}

void open_up(const Tour& tour) {
    for (Stop& stop : tour.stops.first(tour.route.length)) {
        stop.latest = far;
        stop.early = none;
    }
}

WindowCosts price_windows(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    WindowCosts costs{0.0, 0.0};
    for (Stop& stop : stops.first(route.length)) {
        if (stop.kind != customer_stop) continue;
        const double late = lateness_cost(data, stop.node, as_if_reached(data, stop));
        const double early = waiting_cost(data, stop.node, stop.arrival);
        stop.window_cost = late + early;
        costs.late += late;
        costs.early += early;
    }
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        for (Int visit = 0; visit < sortie.count; ++visit) {
            const Int node = sortie.nodes[visit], arrival = sortie.arrivals[visit];
            costs.late += lateness_cost(data, node, arrival);
            costs.early += waiting_cost(data, node, arrival);
        }
    }
    return costs;
}

double flight_cost(const ProblemData& data, Int k, View<const Stop, 1> stops, const Sortie& sortie,
                   Int airborne) {
    const Int row = row_of_drone(data.type, k, sortie.drone);
    const TravelLegs flights = legs_of(data.leg, data.type[row].drone_travel);
    Int node = stops[sortie.launch].node, flown = 0;
    for (const Int following : sortie.customers()) {
        flown += leg(flights, node, following).distance;
        node = following;
    }
    flown += leg(flights, node, stops[sortie.recovery].node).distance;
    return flown_cost(data.rate[row], flown) + airborne_cost(data.rate[row], airborne);
}

double sortie_cost(const ProblemData& data, Int k, View<const Stop, 1> stops,
                   const Sortie& sortie) {
    const Int row = row_of_drone(data.type, k, sortie.drone);
    return flight_cost(data, k, stops, sortie,
                       recovery_end(data.type[row], sortie.begin) - sortie.takeoff);
}

Int first_departure(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    const Int depart = std::min(stops[route.length - 1].depart, route.end - route.cum);
    route.offset = 0;
    if (route.sorties > 0 && sorties[0].launch == 0 && !has_begun(type)) {
        Int first = 0;
        if (are_several(type)) {
            for (Int s = 1; s < route.sorties; ++s) {
                if (sorties[s].launch == 0 && sorties[s].takeoff < sorties[first].takeoff) {
                    first = s;
                }
            }
        }
        const Int row = row_of_drone(data.type, route.type, sorties[first].drone);
        route.offset = launch_duration(data.type[row], 0);
    }
    return counted_from(type, depart + route.offset);
}

RoutePrice price_route(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const Int k = route.type;
    const Rate& rate = data.rate[k];
    RoutePrice price{rate.fixed, 0.0};
    Int halts = 0;
    for (const Trip& trip : trips.first(route.trips)) {
        price.cost += drive_cost(rate, trip.distance);
        halts += trip.halts;
    }
    price.cost += stops_cost(rate, route.length - 2 * route.trips - halts);
    if (halts > 0) {
        for (const Stop& stop : stops.first(route.length)) {
            if (stop.kind == halt_stop) price.cost += data.halt_cost[stop.node];
        }
    }
    price.cost += work_cost(rate, work_of(data.type[k], route));
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        price.cost += sortie_cost(data, k, stops, sortie);
    }
    if (!data.vehicle_cost.empty()) price.cost += vehicle_cost_on(data, tour);
    if (data.evaluation[k].priced) {
        const auto [late, early] = price_windows(data, tour);
        price.cost += late + early;
        price.early = early;
    }
    return price;
}

}  // namespace tandem
