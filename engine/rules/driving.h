// Rests of those who drive: what is counted of a driver, and how that goes on.
//
// Driving is time on legs alone. All else since the last rest is work, waiting too, but the first
// part of a rest. A rest lies between two stops, as breaks do: where the truck leaves, where it
// arrives, or on its way, then as late as the rules allow.
#pragma once

#include <algorithm>

#include "problem/instance.h"
#include "rules/breaks.h"

namespace tandem {

using Driver = tandem_driver;

// What a rest may be; the number of a break among `Rests`.
constexpr Int whole_rest = 0;
constexpr Int first_part = 1;
constexpr Int second_part = 2;

// Rests on one leg, at most, and on one route.
constexpr Int most_rests = 8;
constexpr Int most_rests_on_route = 16;

// Whether rules ask a driver for rests.
inline bool has_driving_rules(const VehicleType& type) { return type.must_rest == 1; }

// Whether a driver may rest while drones are out.
inline bool may_rest_in_flights(const VehicleType& type) { return type.rests_in_flights == 1; }

// How long a rest is.
inline Int rest_duration(const VehicleType& type, Int number) {
    return type.rest_durations[number];
}

// How long all rests on a leg are.
inline Int duration_of(const VehicleType& type, Rests rests) {
    Int duration = 0;
    for (Int index = 0; index < rests.count(); ++index) {
        duration += rest_duration(type, rests.number(index));
    }
    return duration;
}

// A driver whose route begins at `begin`.
inline Driver driver_from(const VehicleType& type, Int begin) {
    return {type.driven_before, counted_begin(type, begin) - type.worked_before, 0};
}

// How much longer a driver may be at the wheel, negative if it should have rested before.
inline Int may_drive(const VehicleType& type, const Driver& driver, Int now) {
    return std::min(type.max_driving - driver.driven, type.max_work - (now - driver.since));
}

// Whether a driver hasn't worked for too long by now.
inline bool may_still_work(const VehicleType& type, const Driver& driver, Int now) {
    return now - driver.since <= type.max_work;
}

// Whether a driver may work and drive so long that nobody has to rest.
inline bool needs_no_rest(const VehicleType& type, Int driving, Int working) {
    return type.driven_before + driving <= type.max_driving &&
           type.worked_before + working <= type.max_work;
}

// Whether rules bound how long a driver works without a rest.
inline bool limits_work(const VehicleType& type) { return type.max_work < unlimited; }

// Whether a driver may have to rest who drives so much further.
inline bool may_need_rest(const VehicleType& type, const Driver& driver, Int driving) {
    return limits_work(type) || driver.driven + driving > type.max_driving;
}

// Whether a rest may come next: the second part of one behind the first alone.
inline bool may_rest(const VehicleType& type, const Driver& driver, Int number) {
    if (number == whole_rest) return true;
    return rest_duration(type, number) > 0 && (driver.half_rested == 1) == (number == second_part);
}

// Let a driver have rested until `end`. In place.
inline void rest(const VehicleType& type, Driver& driver, Int number, Int end) {
    if (number == first_part) {
        driver.since += rest_duration(type, number);
        driver.half_rested = 1;
    } else {
        driver = {0, end, 0};
    }
}

// A leg that a driver who may have to rest has before him.
class RestedLeg {
public:
    RestedLeg(const VehicleType& type, Driver driver, Int leave, Int duration)
        : type_(type), driver_(driver), time_(leave), left_(duration) {}

    Int time() const { return time_; }
    const Driver& driver() const { return driver_; }

    // Whether the rest of the leg can't be driven at a stretch.
    bool is_too_long() const { return may_drive(type_, driver_, time_) < left_; }

    // Take a rest; returns when it begins, `none` if it should have begun before.
    Int take(Int number, RestPlace place) {
        const Int most = may_drive(type_, driver_, time_);
        if (place == RestPlace::arrival) {
            drive(left_);
        } else if (place == RestPlace::way) {
            drive(std::clamp(most, Int{0}, left_));
        }
        if (may_drive(type_, driver_, time_) < 0) return none;
        const Int begin = time_;
        time_ += rest_duration(type_, number);
        rest(type_, driver_, number, time_);
        return begin;
    }

    // Drive on to the end of the leg; false if that is too long.
    bool arrive() {
        drive(left_);
        return may_drive(type_, driver_, time_) >= 0;
    }

private:
    void drive(Int duration) {
        driver_.driven += duration;
        time_ += duration;
        left_ -= duration;
    }

    const VehicleType& type_;
    Driver driver_;
    Int time_;
    Int left_;
};

// Let a driver drive a leg with rests. In place; false if one lacks.
inline bool drive_rested(const VehicleType& type, Rests rests, Int leave, Int duration,
                         Driver& driver) {
    RestedLeg leg(type, driver, leave, duration);
    for (Int index = 0; index < rests.count(); ++index) {
        if (leg.take(rests.number(index), rests.place(index)) == none) return false;
    }
    const bool done = leg.arrive();
    driver = leg.driver();
    return done;
}

// The rest that a driver takes who has to rest at once.
inline Int usual_rest(const Driver& driver) {
    return driver.half_rested == 1 ? second_part : whole_rest;
}

// The rests that a driver takes on a leg who doesn't know what comes behind it: as late as allowed,
// or in the time before the service there `opens`, or before one that `ends` too late without.
// Nothing if they don't do.
template <class Opens, class Ends>
std::optional<Rests> rests_as_needed(const VehicleType& type, Driver driver, Int leave,
                                     Int duration, const Opens& opens, const Ends& ends) {
    Rests rests;
    RestedLeg leg(type, driver, leave, duration);
    while (leg.is_too_long()) {
        const Int number = usual_rest(leg.driver());
        if (rests.count() == most_rests || leg.take(number, RestPlace::way) == none) {
            return std::nullopt;
        }
        rests = rests.with(number, RestPlace::way);
    }
    leg.arrive();
    const Int arrival = leg.time(), waits = opens(arrival) - arrival;
    const bool has_to = !may_still_work(type, leg.driver(), ends(arrival));
    if (rests.count() == most_rests) return rests;
    for (const Int number : {whole_rest, second_part, first_part}) {
        if (!may_rest(type, leg.driver(), number)) continue;
        const bool helps = rest_duration(type, number) > 0 && leg.driver().since < arrival;
        if ((helps && rest_duration(type, number) <= waits) ||
            (has_to && number == usual_rest(leg.driver()))) {
            return rests.with(number, RestPlace::arrival);
        }
    }
    return rests;
}

}  // namespace tandem
