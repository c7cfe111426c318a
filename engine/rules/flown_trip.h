// Trips of vehicles that fly by themselves: how long they may last, and what they take of a
// battery.
//
// Legs hold the launch where they leave a depot, and the recovery where they come to one.
#pragma once

#include "rules/flight.h"

namespace tandem {

// Whether vehicles of a type fly by themselves.
inline bool flies(const VehicleType& type) { return type.flies != 0; }

// Whether a trip of such a vehicle may last too long, take too much, or meet a storm.
inline bool bounds_trips(const VehicleType& type) {
    return flies(type) &&
           (endurance_of(type) < unlimited || is_limited(type) || storms_sometime(type));
}

// Whether its trips have to begin and end near those whom they serve.
inline bool bounds_reach(const VehicleType& type) { return flies(type) && limits_range(type); }

// Whether its battery is charged between trips; else each begins with a full one.
inline bool charges_between_trips(const VehicleType& type) {
    return flies(type) && charges_aboard(type);
}

// How long a trip may last from the beginning of its launch to the end of its recovery.
inline Int longest_in_air(const VehicleType& type) {
    return recovery_end(type, take_off(type, endurance_of(type), 0));
}

// By when a trip to some zones has to be over whose launch begins at `start`: when it storms next.
inline Int calm_trip_until(const VehicleType& type, Int start, Int zones) {
    const Int calm = calm_until(type, take_off(type, start, 0), zones);
    return calm < far ? recovery_end(type, calm) : far;
}

// How much later a trip from `start` to `end` has to begin for calm, if the vehicle flies by
// itself: as the next storm is over; `far` if it never is.
inline Int wait_for_calm(const VehicleType& type, Int start, Int end, Int zones) {
    if (!flies(type) || end <= calm_trip_until(type, start, zones)) return 0;
    const Int takeoff = take_off(type, start, 0);
    const Int held = calm_takeoff(type, takeoff, far, zones);
    return held > takeoff ? held - takeoff : far;
}

// What a trip takes that is followed leg by leg, with so much aboard at first. Windows are those of
// the table by which weights are told.
class FlownTrip {
public:
    FlownTrip(const VehicleType& type, Int weight)
        : type_(type), weight_(weight), left_(battery_of(type)) {}

    // Fly to a customer, where service begins once it has `waited` for a window.
    void fly_to(Windows place, Int duration, bool from_depot, Int waited) {
        if (!is_limited(type_)) return;
        left_ = after_leg(type_, left_, weight_, duration - launch_on(from_depot));
        if (hovers_at_customers(type_)) {
            left_ = after_hovering(type_, left_, weight_, place.service_duration());
            strongest_ = std::max(strongest_, power_hovering(type_, weight_));
            taken_waiting_ = std::min(endless, taken_waiting_ + taken_hovering(waited));
        }
        weight_ += weight_taken(place) - weight_brought(place);
    }

    void fly_home(Int duration, bool from_depot) {
        if (!is_limited(type_)) return;
        const Int flight = duration - launch_on(from_depot) - recovery_end(type_, 0);
        left_ = after_leg(type_, left_, weight_, flight);
    }

    // What it leaves of a full battery; below 0 if it takes more than that holds.
    Int left() const { return left_ < 0 ? empty_battery : left_ - taken_waiting_; }

    // By how much later it has to begin at least to wait no longer than its battery lasts; at most
    // 0 if that does, `far` if it wouldn't last without waiting.
    Int excess() const {
        if (left_ < 0) return far;
        const Int over = taken_waiting_ - left_;
        return over > 0 ? (over + strongest_ - 1) / strongest_ : 0;
    }

    // By how much later it has to begin at least than at `start` for a battery that is charged
    // since `before`, at most 0 if it needn't: it then waits less, too.
    Int excess_of_charge(const Charge& before, Int start) const {
        if (left() < 0) return 0;
        const Int there = charged(type_, before.kept, before.since, start);
        return time_to_gain(type_, battery_of(type_) - left() - there, strongest_);
    }

private:
    static constexpr Int endless = Int{1} << 60;  // more than any battery holds

    Int launch_on(bool from_depot) const { return from_depot ? launch_duration(type_, 0) : 0; }

    Int taken_hovering(Int duration) const {
        return endless - std::max(Int{0}, after_hovering(type_, endless, weight_, duration));
    }

    const VehicleType& type_;
    Int weight_;
    Int left_;  // without what waiting takes
    Int taken_waiting_ = 0;
    Int strongest_ = 0;  // power of hovering at a customer
};

}  // namespace tandem
