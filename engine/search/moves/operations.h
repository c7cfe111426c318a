// What it costs to serve a stretch of a line by one operation of a truck and its drone.
//
// Either the truck drives to the next place, after its drone has served those between on flights
// that it waits for, or it serves them itself but for one, whom the drone serves meanwhile.
#pragma once

#include <limits>

#include "rules/launch_place.h"
#include "rules/shift.h"
#include "search/route/drone_data.h"

namespace tandem {

constexpr double infinite_cost = std::numeric_limits<double>::infinity();

// What operations of trucks of type `k` go by, looked up once.
struct OperationData {
    OperationData(const ProblemData& data, Int k)
        : data(&data),
          type(&data.type[k]),
          rate(&data.rate[k]),
          by_truck(data.place.by_truck(*type)),
          by_air(data.place.by_air(*type)),
          drive(legs_of(data.leg, type->travel)),
          out(legs_of(data.leg, type->drone_travel)),
          home(legs_of(data.leg, type->home_travel)) {}

    const ProblemData* data;
    const VehicleType* type;
    const Rate* rate;
    NodeTable by_truck, by_air;
    TravelLegs drive, out, home;
};

// A flight to a customer and back to the truck, and how far that is.
struct WayByAir {
    Flight flight;
    Int distance;
};

inline WayByAir way_by_air(const OperationData& by, Int from, Int customer, Int to) {
    const Leg out = leg(by.out, from, customer), home = leg(by.home, customer, to);
    return {{*by.type, by.by_air[customer], out.duration, home.duration},
            out.distance + home.distance};
}

// Return what it costs to come so far, be served and drive to the next stop.
inline double driven_on(const Rate& rate, double before, const Leg& way, Int service) {
    return before + usual_work_cost(rate, way.duration + service) + drive_cost(rate, way.distance) +
           rate.stop;
}

// Return what a flight costs for which the truck waits at a stop.
inline double loop_cost(const OperationData& by, Int node, Int customer) {
    const ProblemData& data = *by.data;
    const VehicleType& type = *by.type;
    if (!data.strategy.loops || !is_launch_place(data.no_launch, node) ||
        !in_range(data, type, node, customer)) {
        return infinite_cost;
    }
    const auto [flight, distance] = way_by_air(by, node, customer, node);
    if (!flight.can_serve()) return infinite_cost;
    const Int duration = flight.duration();
    return usual_work_cost(*by.rate, duration + handling_duration(type)) +
           airborne_cost(*by.rate, duration) + flown_cost(*by.rate, distance);
}

// Return how much longer a truck is at a stop where it launches its drone than that takes, less the
// `service` there, which counts as driving.
inline Int stay_beside_launch(const VehicleType& type, Int service) {
    return std::max(Int{0}, service - launch_duration(type, 1)) - service;
}

// Return what an operation costs on which the drone flies so far, and is `airborne`, while the
// truck drives, of one or of several at once. `working` is how long all takes, with launch and
// recovery, `alone` what the truck costs by distance and stops.
template <class Amounts, class Costs>
Costs crossing_cost(const Rate& rate, const Amounts& working, const Amounts& airborne,
                    const Amounts& flown, const Costs& alone) {
    return usual_work_cost(rate, working) + alone + airborne_cost(rate, airborne) +
           flown_cost(rate, flown);
}

// What the truck does while its drone flies across: how long it takes from the arrival where both
// part, services included, how far that is, and how many it stops at on the way.
struct Drive {
    Int duration, distance, stops;
};

// Return what it costs to go from one node to another while the drone serves a customer; infinite
// if that can't be.
inline double cost_across(const OperationData& by, Int from, Int customer, Int to,
                          const Drive& drive) {
    const VehicleType& type = *by.type;
    const Rate& rate = *by.rate;
    if (waits_for_drones(type) || !in_range(*by.data, type, from, customer) ||
        !in_range(*by.data, type, to, customer)) {
        return infinite_cost;
    }
    const auto [flight, distance] = way_by_air(by, from, customer, to);
    const Int away =
        drive.duration + stay_beside_launch(type, by.by_truck[from].service_duration());
    const Int back = flight.duration();
    const Int airborne = std::max(back, away);
    if (!within_endurance(type, 0, back, airborne) || !flight.can_wait(airborne - back)) {
        return infinite_cost;
    }
    const double alone = drive_cost(rate, drive.distance) + stops_cost(rate, drive.stops);
    return crossing_cost(rate, handling_duration(type) + airborne, airborne, distance, alone);
}

}  // namespace tandem
