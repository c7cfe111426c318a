// A trip on which a shipment is tried, and what each way to try it asks.
#pragma once

#include "rules/launch_place.h"
#include "search/insertion/offers.h"
#include "search/insertion/proposal.h"
#include "search/route/drone_data.h"

namespace tandem {

constexpr Int by_wheels = -1;  // instead of a row of drones
constexpr Int at_stop_there = -1;

// By truck behind stop `first`, or by a drone of a row from `first` to `last`; a delivery perhaps
// from behind `first`, where the truck makes pickup number `from`, and back there if that is
// `last`.
struct EndPlace {
    double cost;
    Int row, first, last;
    Int from = at_stop_there;

    // From where on a pickup is aboard, and where a delivery leaves, in half stops.
    Int aboard() const { return row == by_wheels ? 2 * first + 1 : 2 * last; }
    Int leaves() const { return row == by_wheels ? 2 * first + 1 : launch(); }

    // From where to where a drone flies, in half stops.
    Int launch() const { return 2 * first + (flies_on() ? 1 : 0); }
    Int recovery() const { return std::max(launch(), 2 * last); }

    bool is_flown() const { return row >= 0; }
    bool flies_on() const { return from >= 0; }

    bool operator<(const EndPlace& other) const { return cost < other.cost; }
};

struct TripScan : OnTrip {
    TripScan(const Insertion& insertion, Int of_slot, const Trip& tried)
        : OnTrip(insertion.data, insertion.searcher.now, of_slot, tried),
          best(insertion.best),
          node(insertion.node) {}

    Newcomer newcomer(Int end) const { return newcomer_for(data, type, end); }

    // How a vehicle goes by an end behind a stop, and how much further that is.
    Detour detour(const Newcomer& end, Int behind) const {
        const Stop& stop = stops[behind];
        return end.detour(stop.node, stops[behind + 1].node, stop.leg);
    }

    // Whether a stop may be left with the shipment aboard as well, if the trip goes on there.
    bool fits(Int p) const {
        if (p == trip.last) return true;
        for (Int tier = 0; tier < tiers_aboard(fleet); ++tier) {
            const Amount aboard = amount_of(fleet.stop_load(slot, tier, p).aboard);
            if (!holds_in(type, plus(aboard, picked_of(data.amount, node, tier)), tier)) {
                return false;
            }
        }
        return true;
    }

    // Whether what costs at least so much may be passed over.
    bool is_dear(double least) const { return data.strategy.give_up_early && least >= best.cost; }

    // Lets a move begin between two stops. In place.
    Move& move_between(Move& move, Int first, Int last) const {
        return move.between(slot, route.type, first, last);
    }

    // A drone that is free for a place's flight; `nowhere` if there is none.
    Int drone_for(const EndPlace& place) const {
        return free_drone(data, fleet, slot, {place.launch(), place.recovery()}, place.row);
    }

    // Calls `visit` with each row of drones that may serve two customers and has a battery.
    template <class Visit>
    void for_each_row(Int first, Int last, const Visit& visit) const {
        for (Int row = first_drone_row(data.type, route.type); row >= 0;
             row = next_drone_row(data.type, row)) {
            if (data.can(row, 1, first) && data.can(row, 1, last) &&
                has_battery(data.type, route, fleet.sortie[slot], trip, row)) {
                visit(row);
            }
        }
    }

    // From which stop to which a drone flies, how long its first and last leg take, and what it
    // costs.
    struct Flown {
        Int launch, recovery, out, home;
        double cost;
    };

    // Calls `visit` with each flight of a row that serves one customer first and one last,
    // `between` whom it is so far, from stops where it may be launched to where it may be
    // recovered.
    template <class Visit>
    void for_each_flight(Int row, Int first, Int last, Int between, const Visit& visit) const {
        const VehicleType& drone = data.type[row];
        const Rate& rate = data.rate[row];
        const LegRow inward = legs_to(data.back, drone.drone_travel, first);
        const LegRow onward = legs_from(data.leg, drone.home_travel, last);
        const bool crosses = data.strategy.crossings && !waits_for_drones(type);
        for (Int launch = trip.first; launch <= trip.last; ++launch) {
            const Leg out = leg_from(inward, stops[launch].node);
            const Int far_out = out.distance + between;
            if (is_dear(flown_cost(rate, far_out)) || !may_meet(drone, stops[launch].node, first)) {
                continue;
            }
            const Int latest = crosses ? std::min(trip.last, launch + max_span) : launch;
            for (Int recovery = data.strategy.loops ? launch : launch + 1; recovery <= latest;
                 ++recovery) {
                const Leg home = leg_to(onward, stops[recovery].node);
                const double cost = flown_cost(rate, far_out + home.distance);
                if (!is_dear(cost) && may_meet(drone, stops[recovery].node, last)) {
                    visit({launch, recovery, out.duration, home.duration, cost});
                }
            }
        }
    }

    // Calls `visit` with a row of drones and each flight of theirs to an end alone.
    template <class Visit>
    void for_each_single_flight(Int end, const Visit& visit) const {
        if (!data.can(route.type, 1, end) || !may_launch(type, route, fleet.sortie[slot], trip)) {
            return;
        }
        for_each_row(end, end, [&](Int row) {
            const VehicleType& drone = data.type[row];
            const Windows place = data.place.by_air(drone)[end];
            for_each_flight(row, end, end, 0, [&](const Flown& flown) {
                if (Flight{drone, place, flown.out, flown.home}.can_serve()) visit(row, flown);
            });
        });
    }

    // Calls `visit` with each place where the truck may serve a pickup and launch a drone that
    // delivers there, and with each such flight.
    template <class Visit>
    void for_each_flight_on(Int pickup, Int delivery, const Visit& visit) const {
        if (!data.can(route.type, 1, delivery) || !allows_stops(type, stops_on(trip) + 1) ||
            !may_launch(type, route, fleet.sortie[slot], trip)) {
            return;
        }
        const Newcomer driven = newcomer(pickup);
        for_each_row(delivery, delivery, [&](Int row) {
            const VehicleType& drone = data.type[row];
            if (!may_meet(drone, pickup, delivery)) return;
            const Leg out = leg(legs_of(data.leg, drone.drone_travel), pickup, delivery);
            const Windows place = data.place.by_air(drone)[delivery];
            for (Int p = trip.first; p < trip.last; ++p) {
                const auto [there, on, distance] = detour(driven, p);
                const double cost = double(distance) * rate.distance + rate.stop;
                if (is_dear(cost) || driven.place.too_late(stops[p].leave + there.duration)) {
                    continue;
                }
                for_each_landing(row, pickup, delivery, p, [&](Int recovery, Leg home) {
                    const double flown = flown_cost(data.rate[row], out.distance + home.distance);
                    if (!is_dear(cost + flown) &&
                        Flight{drone, place, out.duration, home.duration}.can_serve()) {
                        visit(EndPlace{cost, by_wheels, p, p}, EndPlace{flown, row, p, recovery});
                    }
                });
            }
        });
    }

    // Calls `visit` with each stop from where a drone is launched at a pickup behind one on, where
    // it may be recovered that delivers, and its leg there; the stop before stands for the pickup.
    template <class Visit>
    void for_each_landing(Int row, Int pickup, Int delivery, Int behind, const Visit& visit) const {
        const LegRow onward = legs_from(data.leg, data.type[row].home_travel, delivery);
        const bool crosses = data.strategy.crossings && !waits_for_drones(type);
        const Int latest = crosses ? std::min(trip.last, behind + max_span) : behind;
        for (Int p = data.strategy.loops ? behind : behind + 1; p <= latest; ++p) {
            const Int node_there = p == behind ? pickup : stops[p].node;
            if (may_meet(data.type[row], node_there, delivery))
                visit(p, leg_to(onward, node_there));
        }
    }

    // Adds where the truck may serve an end. In place.
    template <class Places>
    void add_driven(Int end, Places& places) const {
        if (!allows_stops(type, stops_on(trip) + 1)) return;
        const Newcomer driven = newcomer(end);
        for (Int p = trip.first; p < trip.last; ++p) {
            const auto [out, on, distance] = detour(driven, p);
            const double cost = double(distance) * rate.distance + rate.stop;
            if (is_dear(cost) || driven.place.too_late(stops[p].leave + out.duration)) continue;
            places.add({cost, by_wheels, p, p});
        }
    }

    // Adds where drones may serve an end; false if there is no place then. In place.
    template <class Places>
    bool add_flown(Int end, Places& places) const {
        for_each_single_flight(end, [&](Int row, const Flown& flown) {
            places.add({flown.cost, row, flown.launch, flown.recovery});
        });
        return !places.items().empty();
    }

    // Whether drones of a type that serve a customer may be launched or recovered at a node.
    bool may_meet(const VehicleType& drone, Int here, Int customer) const {
        return is_launch_place(data.no_launch, here) && in_range(data, drone, here, customer);
    }

    Best& best;
    const Int node;  // the first pickup
};

}  // namespace tandem
