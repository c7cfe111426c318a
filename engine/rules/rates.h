// What drives, stops, flights and missed windows cost. What work costs stands in `rules/shift.h`.
#pragma once

#include "rules/window.h"
#include "vectors.h"

namespace tandem {

// What one of is priced, in ms and mm.
struct Units {
    double duration, distance;
};

constexpr Units hours_and_km{3'600'000.0, 1'000'000.0};  // as a problem states its prices
constexpr Units ms_and_mm{1.0, 1.0};                     // as the search adds them up

// What the truck's drives cost.
inline double drive_cost(const Rate& rate, Int distance, Units units = ms_and_mm) {
    return double(distance) / units.distance * rate.distance;
}

// What it costs that the truck serves so many customers itself.
inline double stops_cost(const Rate& rate, Int stops) { return double(stops) * rate.stop; }

// What a vehicle costs that makes one such trip, but for its work.
inline double trip_cost(const Rate& rate, Int distance, Int stops) {
    return rate.fixed + drive_cost(rate, distance) + stops_cost(rate, stops);
}

// What it costs on top of all else that a vehicle of type `k`, or its drones, serves a customer.
// The table is empty where nobody states any.
inline double vehicle_cost_at(const View<const double, 2>& vehicle_cost, Int k, Int node) {
    return vehicle_cost.empty() ? 0.0 : vehicle_cost(k, node);
}

// What loads cost, each in the first dimension times the way that it is driven.
inline double load_cost(const Rate& rate, double carried, Units units = ms_and_mm) {
    return carried / units.distance * rate.load;
}

// What the way that drones fly costs, by the row of their type.
inline double flown_cost(const Rate& rate, Int distance, Units units = ms_and_mm) {
    return double(distance) / units.distance * rate.drone_distance;
}

// What it costs that drones are in the air so long, from take-off to the end of recovery.
inline double airborne_cost(const Rate& rate, Int duration, Units units = ms_and_mm) {
    return double(duration) / units.duration * rate.drone_time;
}

// What it costs once to arrive behind the window.
inline double once_late_cost(const Price& price, Windows place, Int arrival) {
    return place.lateness(arrival) > 0 ? price.late : 0.0;
}

// What an arrival behind the window costs.
inline double lateness_cost(const Price& price, Windows place, Int arrival,
                            Units units = ms_and_mm) {
    return double(place.lateness(arrival)) / units.duration * price.lateness +
           once_late_cost(price, place, arrival);
}

// Whether a customer costs by when somebody comes.
inline bool times_cost(const Price& price) {
    return price.lateness > 0.0 || price.late > 0.0 || price.waiting > 0.0;
}

// What it costs to wait for the window.
inline double waiting_cost(const Price& price, Windows place, Int arrival,
                           Units units = ms_and_mm) {
    return double(place.waiting(arrival)) / units.duration * price.waiting;
}

// The same of several at once, whole numbers of ms and mm.
template <int length>
Vector<double, length> drive_cost(const Rate& rate, const Vector<double, length>& distance) {
    return distance * rate.distance;
}

template <int length>
Vector<double, length> stops_cost(const Rate& rate, const Vector<double, length>& stops) {
    return stops * rate.stop;
}

template <int length>
Vector<double, length> flown_cost(const Rate& rate, const Vector<double, length>& distance) {
    return distance * rate.drone_distance;
}

template <int length>
Vector<double, length> airborne_cost(const Rate& rate, const Vector<double, length>& duration) {
    return duration * rate.drone_time;
}

}  // namespace tandem
