// How long a vehicle works, what that costs, and how much a trip may have. A type's limits of the
// end and of the working duration are those with all the overtime allowed.
#pragma once

#include "rules/clock.h"
#include "rules/leg.h"
#include "rules/rates.h"

namespace tandem {

// How much of a vehicle's work is paid: all of it, and again what is past the usual.
struct PaidWork {
    Int duration, overtime;
};

// What work costs, by term.
struct WorkCost {
    double time, overtime;
};

// The work of a vehicle that ends at `end` and works so long. Past what is usual is what is past
// the shift or its working duration, the longer.
inline PaidWork paid_work(const VehicleType& type, Int end, Int working) {
    const Int past = std::max(end - type.usual_end, working - type.usual_working);
    return {working, std::max(Int{0}, past)};
}

// How much more one vehicle works than another.
inline PaidWork operator-(const PaidWork& one, const PaidWork& other) {
    return {one.duration - other.duration, one.overtime - other.overtime};
}

// What work costs that is within what is usual.
inline double usual_work_cost(const Rate& rate, Int duration, Units units = ms_and_mm) {
    return double(duration) / units.duration * rate.time;
}

// The same of several at once, in whole ms.
template <int length>
Vector<double, length> usual_work_cost(const Rate& rate, const Vector<double, length>& duration) {
    return duration * rate.time;
}

// What work costs.
inline WorkCost terms_of_work(const Rate& rate, const PaidWork& work, Units units = ms_and_mm) {
    return {usual_work_cost(rate, work.duration, units),
            double(work.overtime) / units.duration * rate.overtime};
}

// The sum of what work costs.
inline double work_cost(const Rate& rate, const PaidWork& work) {
    const auto [time, overtime] = terms_of_work(rate, work);
    return time + overtime;
}

// Add what work costs to the terms of a cost.
inline void add_work_cost(const Rate& rate, const PaidWork& work, Units units, Cost& cost) {
    const auto [time, overtime] = terms_of_work(rate, work, units);
    cost.time += time;
    cost.overtime += overtime;
}

// Whether some of a vehicle's work costs more than by the hour, so that less of it saves more.
inline bool is_dearer(const Rate& rate, const PaidWork& work) {
    return rate.overtime > 0.0 && work.overtime > 0;
}

// The last end of a vehicle's work, with overtime.
inline Int last_end(const VehicleType& type) { return type.shift_latest; }

// The longest working duration, with overtime.
inline Int longest_work(const VehicleType& type) { return type.max_working_duration; }

// Whether a vehicle's work may end at `end`.
inline bool may_end(const VehicleType& type, Int end) { return end <= last_end(type); }

// Whether a vehicle may work so long.
inline bool may_work(const VehicleType& type, Int working) { return working <= longest_work(type); }

// When the shift ends without overtime.
inline Int usual_end(const VehicleType& type) { return type.usual_end; }

// The longest working duration without overtime.
inline Int usual_working(const VehicleType& type) { return type.usual_working; }

// How far the truck may drive on a trip.
inline Int longest_trip(const VehicleType& type) { return type.max_trip_distance; }

// Whether the time of a vehicle on legs is limited.
inline bool limits_travel(const VehicleType& type) { return type.max_travel_duration < unlimited; }

// Whether a vehicle's legs are limited, on all its trips together.
inline bool limits_legs(const VehicleType& type) {
    return limits_travel(type) || type.max_distance < unlimited;
}

// Whether the time on legs is limited, and hangs on when they are driven.
inline bool limits_timed_travel(const VehicleType& type) {
    return limits_travel(type) && !is_steady(type);
}

// Whether a vehicle may be on legs so long, on all its trips together.
inline bool may_travel(const VehicleType& type, Int travel) {
    return travel <= type.max_travel_duration;
}

// Whose legs tell how far it drives, where that is limited.
inline Int limited_travel(const VehicleType& type) { return type.limited_travel; }

// Whether a vehicle may drive such legs, without setups, on all its trips together.
inline bool may_drive_all(const VehicleType& type, Leg legs) {
    return may_travel(type, legs.duration) && legs.distance <= type.max_distance;
}

// How long a vehicle may be on legs, on all its trips together, `unlimited` if ever.
inline Int longest_travel(const VehicleType& type) { return type.max_travel_duration; }

// How many customers the truck may serve itself on a trip, `unlimited` if any number.
inline Int most_stops(const VehicleType& type) { return type.max_stops; }

// Whether the truck may serve so many customers itself on a trip.
inline bool allows_stops(const VehicleType& type, Int count) { return count <= type.max_stops; }

// Whether so many sorties may be flown on a trip.
inline bool allows_sorties(const VehicleType& type, Int count) { return count <= type.max_sorties; }

}  // namespace tandem
