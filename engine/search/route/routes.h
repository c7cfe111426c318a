// All that follows from the sequence of a route: loads, times, where it bends, its cost.
#pragma once

#include "rules/segment.h"
#include "rules/start.h"
#include "search/route/vehicles.h"

namespace tandem {

// What nothing costs that may be.
constexpr double infeasible = 1e300;

// Return a timed route up to where the truck leaves a stop.
inline PaidFront front_of(const Stop& stop) { return {stop.leave, stop.cum, stop.depart}; }

// Return a timed route from where the truck comes to a stop.
inline PaidRear rear_of(const Stop& stop) { return {stop.latest, stop.early, stop.rest, stop.end}; }

// Put a customer's parcel on a trip. In place.
inline void carry(const ProblemData& data, Trip& trip, Int node) {
    const Windows place = data.place[0][node];
    trip.release = std::max(trip.release, release_of(place));
    add_load(trip, demand_of(place));
}

// Return a leg of a truck, without setup, where speeds don't change.
Leg leg_between(const ProblemData& data, const VehicleType& type, Int from, Int to);

// Return its legs from one stop of a route to another, as one.
Leg legs_on(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops, Int first,
            Int last);

// Write loads, releases and distances of the trips. In place; false if one is too much.
bool load_trips(const ProblemData& data, const Tour& tour);

// Write times as soon as possible, stop after stop, with breaks where they are placed. In place;
// false if a rule is broken.
bool drive_as_placed(const ProblemData& data, const Tour& tour);

// As `drive_as_placed`, with breaks placed so that the route ends as soon as possible, unless they
// have to stay where they are.
bool drive_forward(const ProblemData& data, const Tour& tour);

// Write how late, and how early, each block may be reached, and what follows it. In place.
//
// As docs/develop/route-times.md derives.
void look_back(const ProblemData& data, const Tour& tour);

// Mark a route whose legs change with time: nothing is known of later arrivals. In place.
void open_up(const Tour& tour);

// Return what being late at a customer costs; nothing at a depot.
inline double lateness_cost(const ProblemData& data, Int node, Int arrival) {
    return lateness_cost(data.price[node], data.place[0][node], arrival);
}

// Return what being early at a customer costs.
inline double waiting_cost(const ProblemData& data, Int node, Int arrival) {
    return waiting_cost(data.price[node], data.place[0][node], arrival);
}

// Return what being late, or early, at a customer costs.
inline double window_cost(const ProblemData& data, Int node, Int arrival) {
    return lateness_cost(data, node, arrival) + waiting_cost(data, node, arrival);
}

// What lateness and what waiting cost.
struct WindowCosts {
    double late, early;
};

// Return what lateness and what waiting cost on a timed route.
//
// And write it for each stop. In place.
WindowCosts price_windows(const ProblemData& data, const Tour& tour);

// Return what the flight of a sortie costs that is in the air so long, recovery included.
double flight_cost(const ProblemData& data, Int k, View<const Stop, 1> stops, const Sortie& sortie,
                   Int airborne);

// Return what the flight of a timed sortie costs.
double sortie_cost(const ProblemData& data, Int k, View<const Stop, 1> stops, const Sortie& sortie);

// Return when truck or drone first leaves the depot, as late as costs nothing.
//
// And write how long before the truck a drone does. In place.
Int first_departure(const ProblemData& data, const Tour& tour);

// Return how much of the work on a timed route is paid.
inline PaidWork work_of(const VehicleType& type, const Route& route) {
    return paid_work(type, route.end, route.working);
}

// Return what it costs more that a timed route is driven so; `infeasible` if that takes too long.
inline double longer_cost(const VehicleType& type, const Rate& rate, const Route& route,
                          const Whole& whole) {
    const Int working = whole.end - counted_from(type, whole.depart) - route.offset;
    if (!may_work(type, working)) return infeasible;
    return work_cost(rate, paid_work(type, whole.end, working) - work_of(type, route));
}

// The cost of a route, and what waiting for windows costs of it.
struct RoutePrice {
    double cost, early;
};

// Return the cost of a timed route, and what waiting for windows costs of it.
RoutePrice price_route(const ProblemData& data, const Tour& tour);

}  // namespace tandem
