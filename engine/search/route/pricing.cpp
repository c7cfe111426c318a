#include "search/route/charging.h"
#include "search/route/freshness.h"
#include "search/route/refresh.h"
#include "search/route/rests.h"
#include "search/route/stop_loads.h"

namespace tandem {
namespace {

// Return how long a driver pauses at least who works at `lasting` things of which `driving` are
// legs, but for breaks that aren't paid.
Int least_pause(const VehicleType& type, Int driving, Int lasting) {
    const Int last_begin = last_end(type) - lasting, first_begin = type.shift_earliest;
    Int paused = 0, saved = 0;
    for (Int number = 0; number < num_breaks(type); ++number) {
        const Break first = break_of(type, number, first_begin);
        const bool is_certain = first.latest < first_begin + lasting &&
                                !over_before(type, number, std::max(first_begin, last_begin));
        if (is_paid(type, number) && !is_certain) continue;
        if (is_paid(type, number)) paused += first.duration;
        saved += most_saved_by(type, first.duration);
    }
    if (!has_driving_rules(type)) return paused;
    const Int begin = counted_begin(type, first_begin);
    const Int rests = least_rest(type, driver_from(type, begin), begin, driving, lasting);
    return paused + std::max(Int{0}, rests - saved);
}

// Return how long a sortie is out at least, recovery included.
Int least_airborne(const ProblemData& data, Int k, View<const Stop, 1> stops,
                   const Sortie& sortie) {
    const DroneData drone = drone_data_at(data, row_of_drone(data.type, k, sortie.drone));
    Int lasting = 0, here = stops[sortie.launch].node;
    for (const Int next : sortie.customers()) {
        lasting += leg(drone.legs, here, next).duration + drone.places[next].service_duration();
        here = next;
    }
    lasting += leg(drone.homeward, here, stops[sortie.recovery].node).duration;
    return recovery_end(drone.type, lasting);
}

// Return how long a route lasts at least from when truck or drone first leaves it, as drones have
// to be waited for, but for breaks that aren't paid. In place: take-offs as soon as may be.
Int least_lasting(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    const NodeTable places = data.place.by_truck(type);
    Int time = 0;
    for (Int p = 0; p < route.length; ++p) {
        const Stop& stop = stops[p];
        Int leave = time;
        if (stop.kind == customer_stop) leave += places[stop.node].service_duration();
        for (Sortie& sortie : sorties.first(route.sorties)) {
            if (sortie.launch == p) sortie.takeoff = time;
            if (sortie.recovery != p) continue;
            leave =
                std::max(leave, sortie.takeoff + least_airborne(data, route.type, stops, sortie));
        }
        time = p + 1 < route.length ? leave + stop.gap - resting_in_gap(type, stop) : leave;
    }
    for (Int number = 0; number < num_breaks(type); ++number) {
        if (!is_paid(type, number)) time -= length_of(type, number);
    }
    return time;
}

// Return how long a vehicle whose driver rests works at least on a route.
//
// Its legs, services and reloads last so long, and its breaks and rests, as far as they are paid
// and can't be missed by whoever begins later.
Int least_working(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    const auto [driving, lasting] = all_of(data, type, stops.first(route.length));
    return lasting + least_pause(type, driving, lasting);
}

}  // namespace

Int spare_time(const ProblemData& data, const Tour& tour) {
    return rests_in_time(data.type[tour.route.type])
               ? tour.route.working - least_working(data, tour)
               : idle_time(tour.route);
}

bool may_save_more(const ProblemData& data, const Route& route) {
    const VehicleType& type = data.type[route.type];
    return idle_time(route) > 0 || is_dearer(data.rate[route.type], work_of(type, route)) ||
           any_rest(type, route);
}

LeastPrice least_cost(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Tour tour = tour_of(fleet, slot);
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    const Rate& rate = data.rate[route.type];
    Int working = least_working(data, tour);
    if (route.sorties > 0) {
        working = std::max(working, least_lasting(data, tour));
    }
    double cost = rate.fixed + work_cost(rate, paid_work(type, none, working));
    for (const Trip& trip : trips_of(fleet, slot)) {
        cost += drive_cost(rate, trip.distance);
    }
    for (const Stop& stop : stops.first(route.length)) {
        if (stop.kind == customer_stop) {
            cost += rate.stop + vehicle_cost_at(data.vehicle_cost, route.type, stop.node);
        } else if (stop.kind == halt_stop) {
            cost += data.halt_cost[stop.node];
        }
    }
    if (loads_cost(data, route.type)) cost += load_cost(data, fleet, slot);
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        for (const Int node : sortie.customers())
            cost += vehicle_cost_at(data.vehicle_cost, route.type, node);
        cost += flight_cost(data, route.type, stops, sortie,
                            least_airborne(data, route.type, stops, sortie));
    }
    return {cost, working};
}

namespace {

// Return when truck or drone first leaves the depot on a settled route.
Int settled_departure(const ProblemData& data, const Tour& tour) {
    return counted_from(data.type[tour.route.type], departure_of(data, tour, 0));
}

// Tell whether a route with drones works too long unless it begins later than it could.
//
// Whether they then come in the order that its times were found by has to be seen.
bool has_to_wait(const ProblemData& data, const Tour& tour) {
    if (tour.route.sorties == 0) return false;
    const Int soonest = settled_departure(data, tour);
    return !may_work(data.type[tour.route.type], tour.route.end - soonest - tour.route.unpaid);
}

}  // namespace

bool price_timed(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled) {
    const Tour tour = tour_of(fleet, slot);
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[route.type];
    const bool held_back = data.evaluation[route.type].held_back;
    Int departure = first_departure(data, tour);
    settled = held_back || has_to_wait(data, tour);
    if (settled) {
        if (!settle(data, tour)) return false;
        departure = settled_departure(data, tour);
    }
    if (lags_count(data) && !keeps_all_lags(data, tour)) return false;
    route.working = route.end - departure - route.unpaid;
    if (!may_work(type, route.working)) return false;
    const auto [cost, early] = price_route(data, tour);
    fleet.cost[slot] = cost;
    if (loads_cost(data, route.type)) fleet.cost[slot] += load_cost(data, fleet, slot);
    fleet.early[slot] = held_back ? early : 0.0;
    return true;
}

bool price_driven(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled) {
    const Tour tour = tour_of(fleet, slot);
    const VehicleType& type = data.type[tour.route.type];
    if (holds_count(data, tour.route.type) && !hold_trips(data, tour)) {
        return false;
    }
    if (shares_chargers(type) && !charge_in_turn(data, fleet, slot)) return false;
    return price_timed(data, fleet, slot, settled);
}

bool price_loaded(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled) {
    const Tour tour = tour_of(fleet, slot);
    clear_holds(tour);
    return drive_forward(data, tour) && price_driven(data, fleet, slot, settled);
}

}  // namespace tandem
