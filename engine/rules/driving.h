// Rests of those who drive: what is counted of a driver, and how that goes on.
//
// Driving is time on legs alone. All else since the last rest is work, waiting and short breaks
// too, but not a part of a rest. Where other work interrupts driving, setup, service and reloading
// count that last as long as a rest, all that is done at one place together: they stay as long
// where a route begins later.
// Whoever waits may rest meanwhile. A rest lies between two stops, as breaks do: where the truck
// leaves, where it arrives, or on its way, then as late as the rules allow.
#pragma once

#include "rules/breaks.h"
#include "rules/shift.h"

namespace tandem {

// What is counted of a driver since the last rest.
struct Driver {
    Int driven;
    Int since;        // when it began to work
    Int half_rested;  // whether it has taken the first part of a rest
    Int stood;        // at other work since it was last at the wheel, however long it waited
};

// Breaks and rests on one route, at most, where rules ask for rests.
constexpr Int most_rests_on_route = 16;

// Whether rules ask a driver for rests.
inline bool has_driving_rules(const VehicleType& type) { return type.must_rest == 1; }

// Whether a driver may rest while drones are out.
inline bool may_rest_in_flights(const VehicleType& type) { return type.rests_in_flights == 1; }

// Whether a driver may pause, for breaks or by rules, so that timing takes long.
inline bool may_pause(const VehicleType& type) {
    return has_breaks(type) || has_driving_rules(type);
}

// Whether times hang on where its driver has breaks and rests.
inline bool rests_in_time(const VehicleType& type) {
    return has_breaks(type) || (has_driving_rules(type) && !is_steady(type));
}

// Whether all on a route hangs on when it begins: what breaks are due, or how fast it is.
inline bool hangs_on_begin(const VehicleType& type) {
    return rests_in_time(type) || limits_timed_travel(type);
}

// Whether it takes long to find out when all happens on a route: its driver may pause, or be at the
// wheel for so long alone, however fast it is then.
inline bool is_timed_slowly(const VehicleType& type) {
    return may_pause(type) || limits_timed_travel(type);
}

// Whether all that its driver rests lasts as long whenever it is, so that it is part of legs.
inline bool rests_in_gaps(const VehicleType& type) {
    return has_driving_rules(type) && !rests_in_time(type);
}

// Whether how far a driver comes before a rest has to be known to tell when a leg ends.
inline bool follows_driver(const VehicleType& type) {
    return has_driving_rules(type) && rests_in_time(type);
}

// How long all breaks on a leg are.
inline Int duration_of(const VehicleType& type, Rests rests) {
    Int duration = 0;
    for (Int index = 0; index < rests.count(); ++index) {
        duration += length_of(type, rests.number(index));
    }
    return duration;
}

// A driver whose route begins at `begin`.
inline Driver driver_from(const VehicleType& type, Int begin) {
    return {type.driven_before, counted_begin(type, begin) - type.worked_before,
            type.half_rested_before, 0};
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

// Let a driver have paused until `end`, so long that it may be a rest, or a part of one. In place.
inline void pause(const VehicleType& type, Driver& driver, Int length, Int end) {
    const Int first = rest_duration(type, first_part), second = rest_duration(type, second_part);
    if (length >= rest_duration(type, whole_rest) ||
        (driver.half_rested == 1 && length >= second)) {
        driver = {0, end, 0, 0};
        return;
    }
    if ((first > 0 || second > 0) && length >= first) {
        driver.since += length;
        driver.half_rested = 1;
    }
}

// A driver who has been at other work for so long more, and has so much of a leg before him.
inline Driver having_stood(const VehicleType& type, Driver driver, Int more, Int driving) {
    driver.stood += more;
    if (type.work_interrupts == 0 || driving == 0) return driver;
    if (driver.stood >= rest_duration(type, whole_rest)) driver.driven = 0;
    driver.stood = 0;
    return driver;
}

// How long a rest is at least, in one or in two parts.
inline Int least_rest(const VehicleType& type) {
    const Int first = rest_duration(type, first_part), second = rest_duration(type, second_part);
    const Int whole = rest_duration(type, whole_rest);
    return first > 0 || second > 0 ? std::min(whole, first + second) : whole;
}

// By how much less a driver rests, at most, who pauses for so long anyway.
inline Int most_saved_by(const VehicleType& type, Int length) {
    const Int first = rest_duration(type, first_part), second = rest_duration(type, second_part);
    const Int each = least_rest(type);
    if (length >= each || each < first + second) return std::min(length, each);
    return std::max(length >= first ? first : 0, length >= second ? second : 0);
}

// How long a driver rests at least who has so much `driving` before him, of all that `lasts` so
// long.
inline Int least_rest(const VehicleType& type, const Driver& driver, Int now, Int driving,
                      Int lasting) {
    Int times = 0;
    if (type.work_interrupts == 0 && driver.driven + driving > type.max_driving) {
        times = (driver.driven + driving - 1) / type.max_driving;
    }
    if (limits_work(type))
        times = std::max(times, (now - driver.since + lasting - 1) / type.max_work);
    if (times <= 0) return 0;
    const Int each = least_rest(type), second = rest_duration(type, second_part);
    // More than any route lasts is enough, and more may be more than a number holds.
    times = std::min(times, 1 + unlimited / std::max(Int{1}, each));
    return (driver.half_rested == 1 ? std::min(each, second) : each) + (times - 1) * each;
}

// A leg that a driver who may pause has before him, on a route that begins at `begin`, and how long
// he stood at other work before it.
class RestedLeg {
public:
    RestedLeg(const Speeds& speeds, Int begin, Driver driver, Int stood, Int leave, Int duration)
        : type_(&speeds.type),
          begin_(begin),
          driver_(having_stood(speeds.type, driver, stood, duration)),
          time_(leave),
          left_(speeds, duration) {}

    Int time() const { return time_; }
    Int stood() const { return stood_; }
    const Driver& driver() const { return driver_; }

    // For how long it has been on the leg.
    Int driven() const { return driven_; }

    // How long the rest of the leg is at least.
    Int left() const { return left_.least(); }

    // Whether the rest of the leg can't be driven at a stretch.
    bool is_too_long() const {
        return may_drive(*type_, driver_, time_) < left_.end(time_) - time_;
    }

    // Take a break, or a rest; returns when it begins, `none` if it can't then, or should have
    // begun before. `stood` is then since when the truck stands.
    Int take(Int number, RestPlace place) {
        if (place == RestPlace::arrival) {
            drive_until(left_.end(time_));
        } else if (place == RestPlace::way) {
            const Int most = is_stated(number)
                                 ? break_of(*type_, number, begin_).start(time_) - time_
                                 : may_drive(*type_, driver_, time_);
            drive_until(std::clamp(time_ + most, time_, left_.end(time_)));
        }
        Int begin = stood_ = time_;
        if (is_stated(number)) {
            const Break stated = break_of(*type_, number, begin_);
            begin = stated.start(time_);
            if (begin > stated.latest) return none;
        }
        if (may_drive(*type_, driver_, begin) < 0) return none;
        time_ = begin + length_of(*type_, number);
        pause(*type_, driver_, length_of(*type_, number), time_);
        return begin;
    }

    // Drive on to the end of the leg; false if that is too long.
    bool arrive() {
        drive_until(left_.end(time_));
        return may_drive(*type_, driver_, time_) >= 0;
    }

private:
    void drive_until(Int time) {
        left_.drive(time_, time);
        driven_ += time - time_;
        driver_.driven += time - time_;
        time_ = time;
    }

    const VehicleType* type_;  // so that one can become another
    Int begin_;
    Driver driver_;
    Int time_;
    LegLeft left_;
    Int driven_ = 0, stood_ = 0;
};

// Let a driver take breaks and rests on a leg that is begun, and drive on to its end. In place;
// false if one can't be taken.
inline bool drive_with(RestedLeg& leg, Rests rests) {
    for (Int index = 0; index < rests.count(); ++index) {
        if (leg.take(rests.number(index), rests.place(index)) == none) return false;
    }
    leg.arrive();
    return true;
}

// A leg as it is begun at `leave`, with breaks and rests, on a route that begins at `begin`: how
// long it is at full speed, how long its driver was at other work before, and the setup at its end.
struct PausedLeg {
    Speeds speeds;
    Rests rests;
    Int begin, leave, duration, stood, setup;

    // The leg for a driver, of which nothing is driven yet; it may not outlast this.
    RestedLeg by(const Driver& driver) const {
        return {speeds, begin, driver, stood, leave, duration};
    }

    // When its setup ends; nothing if a break can't be taken. In place: what is counted of its
    // driver, where that is followed.
    std::optional<Int> end(Driver& driver) const {
        RestedLeg leg = by(driver);
        if (!drive_with(leg, rests)) return std::nullopt;
        driver = having_arrived(leg);
        return leg.time() + setup;
    }

    // For how long it is driven. In place, as `end`.
    Int driven(Driver& driver) const {
        RestedLeg leg = by(driver);
        drive_with(leg, rests);
        driver = having_arrived(leg);
        return leg.driven();
    }

    // Its driver, once it is driven and all is set up.
    Driver having_arrived(const RestedLeg& driven) const {
        Driver driver = driven.driver();
        driver.stood += setup;
        return driver;
    }
};

// The rest that a driver takes who has to rest at once.
inline Int usual_rest(const Driver& driver) {
    return driver.half_rested == 1 ? second_part : whole_rest;
}

// The breaks and rests that a driver takes on a leg who doesn't know what comes behind it.
//
// Rests are taken as late as allowed, or in the time before the service there `opens`, or before
// one that `ends` too late without. A break is put off if it may begin when the truck, not delayed,
// is done there; it is taken at once where it ends before the service there `opens`. One that is
// too heavy is put off alone.
template <class Opens, class Ends>
class Unforeseeing {
public:
    Unforeseeing(const VehicleType& type, const RestedLeg& leg, const Opens& opens,
                 const Ends& ends)
        : type_(type), leg_(leg), onward_(leg), opens_(opens), ends_(ends) {}

    // Nothing if what may come next doesn't do.
    std::optional<Rests> run(const BreaksAhead& ahead) {
        const Int begin = ahead.begin;
        for (Int next = ahead.next; drive_on(); ++next) {
            while (next < num_breaks(type_) && over_before(type_, next, begin)) ++next;
            if (next == num_breaks(type_)) return rest_there();
            const Break stated = break_of(type_, next, begin);
            const Int arrival = onward_.time();
            const bool may = !is_among(ahead.heavy, next);
            const bool waits =
                may && stated.may_begin(arrival) && stated.end(arrival) <= opens_(arrival);
            if (!waits && ends_(arrival) <= stated.latest) return rest_there();
            if (!may || !take(next, stated.may_begin(arrival))) return std::nullopt;
        }
        return std::nullopt;
    }

private:
    // Drive on to the end of the leg, with rests as needed; false if that can't be.
    bool drive_on() {
        onward_ = leg_;
        planned_ = rests_;
        while (onward_.is_too_long()) {
            if (!add(usual_rest(onward_.driver()), RestPlace::way, onward_, planned_)) return false;
        }
        onward_.arrive();
        return true;
    }

    // Take a stated break, there or before; false if it can't be.
    bool take(Int number, bool there) {
        if (there || is_there_) {
            leg_ = onward_;
            rests_ = planned_;
            is_there_ = true;
            return add(number, RestPlace::arrival, leg_, rests_);
        }
        const bool on_way = may_rest_on_way(type_, number);
        if (!on_way && is_under_way_) return false;
        const RestPlace place = on_way ? RestPlace::way : RestPlace::departure;
        is_under_way_ = on_way;
        while (!try_add(number, place)) {
            // It comes behind a rest.
            if (!on_way || !leg_.is_too_long() ||
                !add(usual_rest(leg_.driver()), RestPlace::way, leg_, rests_)) {
                return false;
            }
        }
        return true;
    }

    bool try_add(Int number, RestPlace place) {
        RestedLeg leg = leg_;
        if (!add(number, place, leg, rests_)) return false;
        leg_ = leg;
        return true;
    }

    static bool add(Int number, RestPlace place, RestedLeg& leg, Rests& rests) {
        if (rests.count() == most_rests || leg.take(number, place) == none) return false;
        rests = rests.with(number, place);
        return true;
    }

    // Rest where the leg ends, if that helps.
    std::optional<Rests> rest_there() {
        const Int arrival = onward_.time(), waits = opens_(arrival) - arrival;
        const Driver& driver = onward_.driver();
        const bool has_to = !may_still_work(type_, driver, ends_(arrival));
        if (planned_.count() == most_rests) return planned_;
        for (const Int number : {whole_rest, second_part, first_part}) {
            if (!may_rest(type_, driver, number)) continue;
            const Int length = rest_duration(type_, number);
            const bool helps = length > 0 && driver.since < arrival;
            if ((helps && length <= waits) || (has_to && number == usual_rest(driver))) {
                return planned_.with(number, RestPlace::arrival);
            }
        }
        return planned_;
    }

    const VehicleType& type_;
    RestedLeg leg_;     // so far
    RestedLeg onward_;  // at the end, with rests as needed
    Rests rests_;       // so far
    Rests planned_;     // likewise at the end
    const Opens& opens_;
    const Ends& ends_;
    bool is_under_way_ = false, is_there_ = false;
};

}  // namespace tandem
