#include "search/beginning/plans.h"

#include <stdexcept>

#include "rules/drone_types.h"
#include "rules/hub.h"
#include "search/route/fairness.h"
#include "search/route/lags.h"
#include "search/route/state.h"
#include "search/search.h"

namespace tandem {

void disband(const ProblemData& data, Searcher& searcher) {
    const Fleet& now = searcher.now;
    SearchCounts& count = *searcher.count;
    ++count.stamp;
    count.changed = all_slots;
    count.absent = 0;
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        Route& route = now.route[slot];
        route.stamp = count.stamp;
        route.length = route.sorties = route.trips = 0;
        now.cost[slot] = 0.0;
    }
    std::ranges::fill(now.used, 0);
    for (Int node = 0; node < now.where.size(); ++node) {
        if (now.where[node].slot < 0) continue;
        now.where[node].slot = nowhere;
        if (!is_other_end(data.pair, node)) {
            searcher.missing.at(count.missing++) = unit_of(data.pair, node);
        }
    }
    list_active(searcher);
    searcher.value->cost = missing_cost(data, searcher) + plan_cost(data, searcher);
}

// Return how seldom those of a route were left out after a turn, and how few they are; least first.
Int absences_of(const ProblemData& data, const Searcher& searcher, Int slot) {
    const Fleet& now = searcher.now;
    Int sum = 0;
    for (const Stop& stop : stops_of(now, slot)) {
        if (stop.kind == customer_stop && !is_other_end(data.pair, stop.node)) {
            sum += 1 + searcher.absences[stop.node];
        }
    }
    return sum;
}

void give_up_route(const ProblemData& data, Searcher& searcher) {
    const Fleet& now = searcher.now;
    SearchCounts& count = *searcher.count;
    const View<const Int, 1> active = searcher.active.first(count.active);
    Int slot = active[0];
    for (const Int other : active) {
        if (absences_of(data, searcher, other) < absences_of(data, searcher, slot)) slot = other;
    }
    Route& route = now.route[slot];
    double cost = searcher.value->cost - now.cost[slot] - plan_cost(data, searcher);
    for (const Stop& stop : stops_of(now, slot)) {
        if (stop.kind != customer_stop) continue;
        now.where[stop.node].slot = nowhere;
        if (is_other_end(data.pair, stop.node)) continue;
        searcher.missing.at(count.missing++) = stop.node;
        cost += data.unassigned_cost + data.unassigned_more[stop.node];
    }
    route.stamp = ++count.stamp;
    route.length = route.sorties = route.trips = 0;
    now.cost[slot] = 0.0;
    --now.used[route.type];
    list_anew(searcher, slot, false);
    note_changed(searcher, slot);
    searcher.value->cost = cost + plan_cost(data, searcher);
}

namespace {

// The numbers of a plan, one after another.
struct Numbers {
    View<const Int, 1> all;
    Int place = 0;

    bool any_left() const { return place < all.size(); }
    Int next() { return all.at(place++); }

    // Returns what is next, and passes so many in all.
    Int first_of(Int count) {
        const Int number = next();
        place += count - 1;
        return number;
    }
};

constexpr Int numbers_of_visit = 6, numbers_of_break = 6;

void read_stop(Numbers& numbers, Int index, Int count, Stop& stop) {
    stop.node = numbers.next();
    const Int arrival = numbers.first_of(4);
    const bool is_launch_site = numbers.next() == 1;
    stop.kind = index == 0           ? start_stop
                : index == count - 1 ? end_stop
                : is_launch_site     ? halt_stop
                                     : customer_stop;
    stop.hold = none;
    stop.free_start = index == 0 ? arrival : 0;
}

void read_sortie(Numbers& numbers, Int first, Sortie& sortie) {
    sortie.drone = numbers.next();
    sortie.launch = first + numbers.next();
    sortie.recovery = first + numbers.first_of(4);
    sortie.count = numbers.next();
    const View<Int, 1> nodes(sortie.nodes, {std::ssize(sortie.nodes)});
    for (Int visit = 0; visit < sortie.count; ++visit) {
        nodes.at(visit) = numbers.first_of(numbers_of_visit);
    }
}

void read_trip(Numbers& numbers, const Fleet& fleet, Int slot, Trip& trip) {
    Route& route = fleet.route[slot];
    trip.charged_from = numbers.next();
    trip.charged_until = numbers.next();
    const Int stops = numbers.next(), sorties = numbers.next(), breaks = numbers.next();
    const Int first = route.length;
    for (Int index = 0; index < stops; ++index) {
        read_stop(numbers, index, stops, fleet.stop[slot].at(route.length++));
    }
    for (Int index = 0; index < sorties; ++index) {
        read_sortie(numbers, first, fleet.sortie[slot].at(route.sorties++));
    }
    numbers.place += breaks * numbers_of_break;
}

// A stop as it is timed.
ToldStop told_stop(const ProblemData& data, View<const Stop, 1> stops, Int p) {
    const Stop& stop = stops[p];
    const Int start = data.place[0][stop.node].start_of_service(
        stop.kind == customer_stop ? as_if_reached(data, stop) : stop.arrival);
    if (stop.kind == customer_stop) {
        const Int setup = setup_after(data.setup, stops[p - 1].node, stop.node);
        return {stop.node, stop.arrival - setup, start, stop.leave, setup};
    }
    if (stop.kind != start_stop) {
        return {stop.node, stop.arrival, start, stop.leave, 0, stop.kind == halt_stop};
    }
    const Int begin = std::max({stop.arrival, stop.release, stop.hold});
    return {stop.node, begin, begin, stop.leave, 0};
}

// The leg behind a stop.
ToldLeg told_leg(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops,
                 Int p) {
    const Stop& stop = stops[p];
    const Rests rests(stop.rests);
    const Int setup = setup_after(data.setup, stop.node, stops[p + 1].node);
    Int duration = stop.gap;
    if (is_steady(type)) {
        duration -= setup;
        if (rests_in_gaps(type)) duration -= duration_of(type, rests);
    }
    Int stood = 0;
    if (stop.kind == customer_stop) stood = data.place.by_truck(type)[stop.node].service_duration();
    if (stop.kind == start_stop && p > 0) stood = type.reload_duration;
    return {rests, stop.leave, duration, stood, setup};
}

void tell_sortie(const ProblemData& data, const VehicleType& drones, const Sortie& sortie,
                 Int first, Int from, RouteTeller& told) {
    told.sortie({sortie.drone, sortie.launch - first, sortie.recovery - first, sortie.takeoff,
                 sortie.begin, recovery_end(drones, sortie.begin), sortie.count});
    for (Int index = 0; index < sortie.count; ++index) {
        const Int node = sortie.nodes[index], arrival = sortie.arrivals[index];
        const Int setup = setup_after(data.setup, from, node);
        const Windows place = data.place.by_air(drones)[node];
        const Int start = place.start_of_service(arrival);
        told.visit({node, arrival - setup, start, start + place.service_duration(), setup});
        from = node;
    }
}

void tell_route(const ProblemData& data, const Fleet& fleet, Int slot, Int vehicle, Plan& plan) {
    const Route& route = fleet.route[slot];
    const VehicleType& type = data.type[route.type];
    const View<Stop, 1> stops = fleet.stop[slot];
    RouteTeller told(plan, speeds_of(data, route.type), route.type, vehicle,
                     told_stop(data, stops, 0).arrival);
    for (const Trip& trip : trips_of(fleet, slot)) {
        const bool is_charged = shares_chargers(type);
        told.trip(is_charged ? trip.charged_from : 0, is_charged ? trip.charged_until : 0);
        for (Int p = trip.first; p <= trip.last; ++p) {
            told.stop(
                with_handling(type, told_stop(data, stops, p), p == trip.first, p == trip.last));
        }
        for (const Sortie& sortie : sorties_of(fleet, slot)) {
            if (sortie.launch < trip.first || sortie.launch > trip.last) continue;
            const VehicleType& drones =
                data.type[row_of_drone(data.type, route.type, sortie.drone)];
            tell_sortie(data, drones, sortie, trip.first, stops[sortie.launch].node, told);
        }
        for (Int p = trip.first; p < trip.last; ++p) {
            told.leg(p - trip.first, told_leg(data, type, stops, p));
        }
    }
}

// Tells a route as a vehicle's, its trips begun as late as costs nothing. In place.
void tell_timed(const ProblemData& data, Fleet& fleet, Int slot, Int vehicle, Plan& plan) {
    if (!finish_route(data, fleet, slot)) {
        throw std::invalid_argument("nobody can drive the route");
    }
    tell_route(data, fleet, slot, vehicle, plan);
}

}  // namespace

Int read_plan(const Fleet& fleet, View<const Int, 1> numbers) {
    Int slot = 0;
    for (Numbers left{numbers}; left.any_left(); ++slot) {
        Route& route = fleet.route.at(slot);
        route.type = left.first_of(2);
        route.length = route.sorties = 0;
        const Int trips = left.next();
        for (Int trip = 0; trip < trips; ++trip) {
            read_trip(left, fleet, slot, fleet.trip[slot].at(trip));
        }
    }
    return slot;
}

void tell_routes(const ProblemData& data, Fleet& fleet, Int slots, Plan& plan) {
    std::vector<Int> vehicles(std::size_t(data.num_types), 0);
    for (Int slot = 0; slot < slots; ++slot) {
        const Route& route = fleet.route[slot];
        if (route.length == 0) continue;
        tell_timed(data, fleet, slot, vehicles[std::size_t(route.type)]++, plan);
    }
}

// Tells the best routes that aren't those of another search in the same order, by the numbers of
// their slots for vehicles; without trips, there is none any more. In place, as `tell_routes`.
void tell_changed(const ProblemData& data, Searcher& searcher, const Searcher& whole, Plan& plan) {
    const Fleet& best = searcher.best;
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        const Int before = slot < whole.count->active ? whole.active[slot] : nowhere;
        const Route& route = best.route[slot];
        if (route.length == 0) {
            if (before >= 0) plan.numbers.insert(plan.numbers.end(), {route.type, slot, 0});
        } else if (before < 0 || !is_same(best, slot, whole.now, before)) {
            tell_timed(data, searcher.best, slot, slot, plan);
        }
    }
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_give_up_route(const tandem_problem_data* data, tandem_search* search) {
    return guarded([&] { give_up_route(data_of(*data), *search); });
}

extern "C" int tandem_disband(const tandem_problem_data* data, tandem_search* search) {
    return guarded([&] { disband(data_of(*data), *search); });
}

extern "C" int tandem_tell_best(const tandem_problem_data* data, tandem_search* search,
                                tandem_plan* plan) {
    return guarded(
        [&] { tell_routes(data_of(*data), search->best, search->active.size(), *plan); });
}

extern "C" int tandem_tell_changed(const tandem_problem_data* data, tandem_search* search,
                                   tandem_search* whole, tandem_plan* plan) {
    return guarded([&] { tell_changed(data_of(*data), *search, *whole, *plan); });
}
