#include "simulation/vehicle_log.h"

#include <vector>

#include "rules/drone_types.h"
#include "rules/holding.h"
#include "rules/hours.h"
#include "rules/start.h"
#include "simulation/lags.h"
#include "simulation/meeting.h"

namespace tandem {
namespace {

// When a sortie takes off whose launch may begin at `free`; `launched` counts the launches of the
// trip before it. It is held back for the customer's window once it is known where it is recovered.
Int sortie_takeoff(const Setting& setting, const VehicleLog& log, const LoggedSortie& sortie,
                   Int free, Int launched) {
    const DroneKind drone_kind = drone_kind_of(setting, sortie.row);
    const Int takeoff = take_off(drone_kind.type, free, launched);
    if (sortie.recovery_stop == in_flight) return takeoff;
    const Int here = log.stop[sortie.launch_stop].node;
    const Int to = log.stop[sortie.recovery_stop].node;
    return drone_kind.flight(here, sortie.node, to).held_takeoff(takeoff);
}

// As `sortie_takeoff`, of a sortie by its index, where drones are charged aboard; notes what it has
// then. The trip begins at stop `first`.
Int charged_takeoff(const Setting& setting, const VehicleLog& log, Int index, Int first, Int free,
                    Int launched) {
    LoggedSortie& sortie = log.sortie[index];
    const DroneKind drone_kind = drone_kind_of(setting, sortie.row);
    auto [kept, since] = first_charge(drone_kind.type, sortie.drone);
    for (const LoggedSortie& other : log.sortie.first(index)) {
        if (other.drone == sortie.drone && other.launch_stop >= first) {
            kept = other.trial_left;
            since = other.trial_end;
        }
    }
    if (sortie.recovery_stop != in_flight) {
        const Int here = log.stop[sortie.launch_stop].node;
        const Int to = log.stop[sortie.recovery_stop].node;
        free = std::max(free, drone_kind.flight(here, sortie.node, to).charged_launch(kept, since));
    }
    const Int takeoff = sortie_takeoff(setting, log, sortie, free, launched);
    sortie.trial_left =
        charged(drone_kind.type, kept, since, launch_begin(drone_kind.type, takeoff, launched));
    return takeoff;
}

// The stops of a trip, up to the last that is logged.
struct Stops {
    Int first, behind;
};

Stops stops_of(const VehicleLog& log, Int trip) {
    const bool is_last = trip + 1 == log.count.trips;
    return {log.trip[trip].first_stop, is_last ? log.count.stops : log.trip[trip + 1].first_stop};
}

// The zones with hours that hold any stop of a trip.
Int zones_of_trip(const Setting& setting, const VehicleLog& log, Int trip) {
    Int zones = 0;
    if (setting.zones.empty()) return zones;
    const auto [first, behind] = stops_of(log, trip);
    for (Int index = first; index < behind; ++index) {
        zones |= setting.zones[log.stop[index].node];
    }
    return zones;
}

// How long a vehicle waits at a stop, for a window or for others, by the log.
Int waiting_at(const VehicleLog& log, Int index) {
    return log.stop[index].start - log.stop[index].arrival;
}

// What a trip takes of who flies by itself, and waits at stops as long as `waiting` says.
template <class Waiting>
FlownTrip follow_trip(const Setting& setting, const VehicleLog& log, Int trip,
                      const Waiting& waiting) {
    const auto [first, behind] = stops_of(log, trip);
    const auto served = [&](Int index) { return log.stop[index].node >= setting.num_depots; };
    Int weight = 0;
    for (Int index = first; index < behind; ++index) {
        if (served(index)) weight += weight_brought(setting.node_by_air[log.stop[index].node]);
    }
    FlownTrip flown(setting.type, weight);
    for (Int index = first + 1; index < behind; ++index) {
        const Int node = log.stop[index].node;
        const Int duration = setting.drive(log.stop[index - 1].node, node);
        if (served(index)) {
            const Windows place = setting.node_by_air[node];
            flown.fly_to(place, duration, index == first + 1, waiting(index));
        } else {
            flown.fly_home(duration, index == first + 1);
        }
    }
    return flown;
}

// With what a vehicle that flies by itself comes to a trip, by the log, and since when.
Charge charge_before(const Setting& setting, const VehicleLog& log, Int trip) {
    const VehicleType& type = setting.type;
    Charge charge = first_charge(type, 0);
    for (Int before = 0; before < trip; ++before) {
        const auto [first, behind] = stops_of(log, before);
        const FlownTrip flown =
            follow_trip(setting, log, before, [&](Int index) { return waiting_at(log, index); });
        const Int there = charged(type, charge.kept, charge.since, log.stop[first].leave);
        charge = {there - (battery_of(type) - flown.left()), log.stop[behind - 1].leave};
    }
    return charge;
}

// The leg that leads to a stop, as logged.
BegunLeg leg_to(const VehicleLog& log, Int index) {
    const LoggedStop& before = log.stop[index - 1];
    return {Rests(before.rests), log.trip[0].start, before.node, log.stop[index].node,
            before.leave};
}

// How long the truck is on legs of the first trips. In place: what is counted of its driver, where
// that is followed.
Int travelled_on(const Setting& setting, const VehicleLog& log, Int trips, Driver& driver) {
    Int travel = 0;
    for (Int trip = 0; trip < trips; ++trip) {
        const auto [first, behind] = stops_of(log, trip);
        for (Int index = first + 1; index < behind; ++index) {
            const BegunLeg leg = leg_to(log, index);
            travel += paused_leg(setting, leg).driven(driver);
        }
    }
    return travel;
}

// Times trips anew, as `retime` says if it writes, else as `costs_nothing` does.
template <bool writes>
class Replay {
public:
    Replay(const Setting& setting, const VehicleLog& log) : setting_(setting), log_(log) {
        if (some_limited(setting.between)) {
            served_.resize(std::size_t(log.count.stops));
        }
        if (!setting.lag.empty()) {
            for (const LoggedStop& stop : log.stop.first(log.count.stops)) {
                starts_.push_back(stop.start);
            }
            for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
                flown_.push_back(sortie.start);
            }
        }
        if (bounds_trips(setting.type)) {
            waits_.resize(std::size_t(log.count.stops));
        }
    }

    bool run(Int first_trip, Int start) {
        op_ = log_.trip[first_trip].first_op;
        leave_ = start;
        begin_ = first_trip == 0 ? start : log_.trip[0].start;
        const bool follows = follows_driver(setting_.type);
        const bool counts = limits_timed_travel(setting_.type);
        if (follows) driver_ = driver_from(setting_.type, begin_);
        travel_ = counts || follows ? travelled_on(setting_, log_, first_trip, driver_) : 0;
        for (Int trip = first_trip; trip < log_.count.trips; ++trip) {
            if (trip > first_trip) {
                start = std::max(log_.trip[trip].release, leave_ + setting_.type.reload_duration);
            }
            if (!run_trip(trip, start)) return false;
            if (bounds_trips(setting_.type) && !lasts(trip, start)) return false;
        }
        in_time_ = true;
        return lasting_ && (!counts || may_travel(setting_.type, travel_)) &&
               (writes || !follows || may_still_work(setting_.type, driver_, leave_)) &&
               (writes || leave_ <= log_.stop[log_.count.stops - 1].leave) &&
               (setting_.lag.empty() || starts().keep_lags(setting_));
    }

    // Whether nobody came too late, once it has run.
    bool in_time() const { return in_time_; }

private:
    // When service begins, as tried.
    auto starts() const {
        const auto of_stop = [this](Int index) { return starts_[std::size_t(index)]; };
        const auto of_sortie = [this](Int index) { return flown_[std::size_t(index)]; };
        return Starts<decltype(of_stop), decltype(of_sortie)>{log_, of_stop, of_sortie};
    }

    // Whether a trip that was begun at `start` lasts in the air; when writing, that is noted.
    bool lasts(Int trip, Int start) {
        const VehicleType& type = setting_.type;
        const FlownTrip flown = follow_trip(setting_, log_, trip,
                                            [&](Int index) { return waits_[std::size_t(index)]; });
        // In the calm that is known, if that counts, so that all between is allowed as well.
        const Int known = writes ? start : log_.trip[trip].start;
        bool done = leave_ - start <= longest_in_air(type) &&
                    (!is_limited(type) || flown.left() >= 0) &&
                    leave_ <= calm_trip_until(type, known, zones_of_trip(setting_, log_, trip));
        if (charges_between_trips(type)) {
            if (trip == 0 || !charge_) charge_ = charge_before(setting_, log_, trip);
            const Int there = charged(type, charge_->kept, charge_->since, start);
            charge_ = Charge{there - (battery_of(type) - flown.left()), leave_};
            done = done && charge_->kept >= 0;
        }
        if constexpr (writes) {
            lasting_ = lasting_ && done;
            return true;
        }
        return done;
    }

    bool run_trip(Int trip, Int start) {
        first_ = log_.trip[trip].first_stop;
        launched_ = 0;
        departure_ = far;
        if constexpr (writes) log_.trip[trip].start = start;
        const Int behind = stops_of(log_, trip).behind;
        for (Int index = first_; index < behind; ++index) {
            const Int node = log_.stop[index].node;
            Int arrival = start;
            if (index > first_) {
                const LoggedStop& before = log_.stop[index - 1];
                const BegunLeg leg{Rests(before.rests), begin_, before.node, node, leave_};
                if (limits_timed_travel(setting_.type)) {
                    Driver counted = driver_;
                    travel_ += paused_leg(setting_, leg).driven(counted);
                }
                arrival = come(setting_, leg, driver_);
                if (arrival < 0 || (!writes && lacks_rest(arrival))) return false;
            }
            if (!run_stop(index, arrival)) return false;
        }
        return true;
    }

    // Whether a driver who is followed has driven too long, or will have worked so by then.
    bool lacks_rest(Int arrival) const {
        return follows_driver(setting_.type) && may_drive(setting_.type, driver_, arrival) < 0;
    }

    bool run_stop(Int index, Int arrival) {
        LoggedStop& stop = log_.stop[index];
        const bool is_depot = stop.node < setting_.num_depots;
        const bool comes_back = is_depot && index > first_;
        const Int there =
            comes_back ? let_in(setting_.type, setting_.node, stop.node, arrival) : arrival;
        Int service_start = there;
        leave_ = index == first_ ? leaves_first(setting_.type, arrival) : there;
        if (!is_depot) {
            const Windows place = setting_.node[stop.node];
            Int ready = arrival, before = stop.arrival;
            if (!setting_.lag.empty()) {
                ready = starts().ready_at(setting_, stop.node, index, arrival);
                before = stop.start;
            }
            service_start = place.start_of_service(ready);
            if (!waits_.empty()) waits_[std::size_t(index)] = service_start - arrival;
            if (!is_allowed(place, ready, before)) return false;
            if (!writes && aboard_too_long(stop.node, departure_, service_start)) return false;
            leave_ = setting_.served_at(stop.node, ready);
            if (!starts_.empty()) starts_[std::size_t(index)] = service_start;
            if (!served_.empty() && !note_served(index, service_start)) return false;
        }
        free_ = busy_ = there;
        for (; op_ < log_.count.ops && log_.op[op_].stop == index; ++op_) {
            if (!run_operation(log_.op[op_], stop.node)) return false;
        }
        leave_ = std::max(leave_, free_);
        if (is_depot && leave_ > (comes_back ? closes_at : leaves_by)(setting_.type, setting_.node,
                                                                      stop.node)) {
            return false;
        }
        departure_ = std::min(departure_, leave_);
        if constexpr (writes) {
            stop.arrival = arrival;
            stop.start = service_start;
            stop.leave = leave_;
        }
        return true;
    }

    // Note when somebody is served; false if a shipment that is delivered was under way too long.
    bool note_served(Int index, Int start) {
        const Int node = log_.stop[index].node;
        served_[std::size_t(index)] = start + setting_.node[node].service_duration();
        return writes || is_brought_soon(node, index, start);
    }

    // Whether a shipment that is delivered was not under way too long, by the stops before `index`.
    bool is_brought_soon(Int node, Int index, Int start) const {
        if (!is_delivery(setting_.pair, node)) return true;
        for (Int before = index - 1; before >= first_; --before) {
            const Int pickup = log_.stop[before].node;
            if (!brings(setting_.pair, pickup, node)) continue;
            const Int left = served_[std::size_t(before)];
            if (excess_between(setting_.between, pickup, left, start) > 0) return false;
        }
        for (const LoggedSortie& sortie : log_.sortie.first(log_.count.sorties)) {
            const Int pickup = sortie.node;
            if (!brings(setting_.pair, pickup, node)) continue;
            const Int left = sortie.trial_ready;
            if (excess_between(setting_.between, pickup, left, start) > 0) return false;
        }
        return true;
    }

    bool run_operation(const Operation& operation, Int node) {
        const VehicleType& type = setting_.types[log_.sortie[operation.sortie].row];
        const bool instant = takes_no_time(type, operation.is_recovery != 0, launched_);
        std::optional<Int> end;
        if (operation.is_recovery != 0) {
            end = recover(operation.sortie, node);
        } else {
            end = launch(operation.sortie, node);
            if (end) departure_ = std::min(departure_, *end);
            ++launched_;
        }
        if (!end) return false;
        free_ = std::max(free_, *end);
        if (!instant) busy_ = free_;
        return true;
    }

    // Time one launch begun once the crew is free; return the take-off, if it is allowed.
    std::optional<Int> launch(Int index, Int node) {
        LoggedSortie& sortie = log_.sortie[index];
        const Int customer = sortie.node;
        const DroneKind drone_kind = drone_kind_of(setting_, sortie.row);
        const Windows place = drone_kind.node[customer];
        const bool is_flying = sortie.recovery_stop == in_flight;
        // Until all is done at a stop, it is left as service is over.
        const Int free =
            hands_over(setting_.pair, node, customer) ? std::max(free_, leave_) : free_;
        const Int takeoff = charges_aboard(drone_kind.type)
                                ? charged_takeoff(setting_, log_, index, first_, free, launched_)
                                : sortie_takeoff(setting_, log_, sortie, free, launched_);
        const Int arrival = takeoff + drone_kind.out(node, customer);
        // Who is still in flight may be launched before others.
        const bool may_be_sooner = writes && is_flying && order_may_change(setting_, node);
        if (!is_allowed(place, arrival, sortie.arrival) && !may_be_sooner) return std::nullopt;
        const Int start = place.start_of_service(arrival);
        const Int served = drone_kind.ready(node, customer, takeoff);
        sortie.trial_takeoff = takeoff;
        sortie.trial_ready = served;
        if (!flown_.empty()) flown_[std::size_t(index)] = start;
        if constexpr (writes) {
            sortie.takeoff = takeoff;
            sortie.arrival = arrival;
            sortie.start = start;
            sortie.ready = served;
        } else {
            if (is_flying && served > sortie.ready) return std::nullopt;
            if (aboard_too_long(customer, std::min(departure_, takeoff), start)) {
                return std::nullopt;
            }
            if (!served_.empty() && !is_brought_soon(customer, sortie.launch_stop + 1, start)) {
                return std::nullopt;
            }
        }
        return takeoff;
    }

    // Time one recovery begun once the crew is free, or later; return its end. One that takes no
    // time is held up by what takes time alone.
    //
    // If nothing is written, there is none where the drone doesn't last, or is in the air longer
    // than logged.
    std::optional<Int> recover(Int index, Int node) {
        LoggedSortie& sortie = log_.sortie[index];
        const Int takeoff = sortie.trial_takeoff;
        const DroneKind drone_kind = drone_kind_of(setting_, sortie.row);
        const Flight flight =
            drone_kind.flight(log_.stop[sortie.launch_stop].node, sortie.node, node);
        const Int back = sortie.trial_ready + flight.home;
        const Int begin = std::max(takes_no_time(drone_kind.type, true, 0) ? busy_ : free_, back);
        const Int end = recovery_end(drone_kind.type, begin);
        // A sortie as long as before may wait where that takes more.
        Int left = flight.left_after(takeoff, sortie.trial_ready, begin);
        if (charges_aboard(drone_kind.type)) {
            left -= battery_of(drone_kind.type) - sortie.trial_left;
            sortie.trial_left = left;
            sortie.trial_end = end;
        }
        if constexpr (writes) {
            sortie.left = left;
            sortie.recovery_start = begin;
            sortie.recovery_end = end;
            if (left < 0 || !within_endurance(drone_kind.type, takeoff, back, begin) ||
                begin > calm_until(drone_kind.type, takeoff, flight.zones)) {
                lasting_ = false;
            }
        } else {
            // In the same calm, so that all between is allowed as well.
            const bool lasts = begin - takeoff <= sortie.recovery_start - sortie.takeoff &&
                               begin <= calm_until(drone_kind.type, sortie.takeoff, flight.zones);
            if (left < 0 || !lasts) return std::nullopt;
        }
        return end;
    }

    // Check a window: when writing, that a hard one holds; else, that no lateness is added.
    //
    // With drones, also that it is the same window: who has to wait for another may then be met
    // sooner, so that a start might cost nothing though an earlier one does.
    bool is_allowed(Windows place, Int arrival, Int before) const {
        if constexpr (writes) return !place.too_late(arrival);
        if (log_.count.sorties > 0) return arrival <= place.in_same_window(before);
        return arrival <= place.as_late(before);
    }

    // Tell whether a parcel is too long aboard on a trip that has left at `departure`.
    bool aboard_too_long(Int node, Int departure, Int start) const {
        return some_limited(setting_.max_time_aboard) &&
               excess_aboard(setting_.max_time_aboard, node, departure, start) > 0;
    }

    const Setting& setting_;
    const VehicleLog& log_;
    Int op_ = 0, leave_ = 0;
    Int begin_ = 0;   // of the route
    Int travel_ = 0;  // on legs, where that hangs on when they are driven
    Driver driver_{};
    bool lasting_ = true, in_time_ = false;
    // Of the trip: its first stop, the launches so far, the first instant at which any has left.
    Int first_ = 0, launched_ = 0, departure_ = far;
    // Of who flies by itself: how long each stop is waited at, and how the battery is after a trip.
    std::vector<Int> waits_;
    std::vector<Int> served_;  // (stop,) where shipments may be under way for so long
    std::optional<Charge> charge_;
    std::vector<Int> starts_;  // (stop,) where lags count
    std::vector<Int> flown_;   // (sortie,) when service begins there, likewise
    // At the stop: when the crew is free, and when it is from what takes time.
    Int free_ = 0, busy_ = 0;
};

}  // namespace

Retimed retime(const Setting& setting, VehicleLog& log, Int first_trip, Int start) {
    Replay<true> replay(setting, log);
    if (replay.run(first_trip, start)) return Retimed::kept;
    return replay.in_time() ? Retimed::too_long : Retimed::too_late;
}

bool costs_nothing(const Setting& setting, VehicleLog& log, Int first_trip, Int start) {
    return Replay<false>(setting, log).run(first_trip, start);
}

namespace {

// By how much a parcel is too long aboard on the last trip; at most 0 if none is.
Int excess_of_parcels(const Setting& setting, const VehicleLog& log) {
    const Int first = log.trip[log.count.trips - 1].first_stop;
    const View<LoggedSortie, 1> sorties = log.sortie.first(log.count.sorties);
    Int departure = log.stop[first].leave;
    for (const LoggedSortie& sortie : sorties) {
        if (sortie.launch_stop == first) departure = std::min(departure, sortie.takeoff);
    }
    Int most = -far;
    const auto look_at = [&](Int node, Int start) {
        most = std::max(most, excess_aboard(setting.max_time_aboard, node, departure, start));
    };
    for (Int index = first; index < log.count.stops; ++index) {
        const LoggedStop& stop = log.stop[index];
        if (stop.node >= setting.num_depots) look_at(stop.node, stop.start);
    }
    for (const LoggedSortie& sortie : sorties) {
        if (sortie.launch_stop >= first) look_at(sortie.node, sortie.start);
    }
    return most;
}

// By how much a shipment is too long under way on the last trip; at most 0 if none is.
Int excess_of_pairs(const Setting& setting, const VehicleLog& log) {
    const Int first = log.trip[log.count.trips - 1].first_stop;
    Int most = -far;
    const auto deliver = [&](Int node, Int start, Int behind) {
        if (is_delivery(setting.pair, node)) {
            most = std::max(most, excess_under_way(setting, log, node, behind, start));
        }
    };
    for (Int index = first; index < log.count.stops; ++index) {
        deliver(log.stop[index].node, log.stop[index].start, index);
    }
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        if (sortie.launch_stop >= first) deliver(sortie.node, sortie.start, sortie.launch_stop + 1);
    }
    return most;
}

// By how much later the last trip has to begin at least to last in the air.
Int excess_in_air(const Setting& setting, const VehicleLog& log) {
    const VehicleType& type = setting.type;
    const Int trip = log.count.trips - 1;
    const auto [first, behind] = stops_of(log, trip);
    const Int start = log.stop[first].leave;
    Int most = log.stop[behind - 1].leave - start - longest_in_air(type);
    if (!is_limited(type)) return most;
    const FlownTrip flown =
        follow_trip(setting, log, trip, [&](Int index) { return waiting_at(log, index); });
    most = std::max(most, flown.excess());
    if (charges_between_trips(type)) {
        most = std::max(most, flown.excess_of_charge(charge_before(setting, log, trip), start));
    }
    return most;
}

}  // namespace

Int excess_under_way(const Setting& setting, const VehicleLog& log, Int delivery, Int behind,
                     Int start) {
    Int most = -far;
    for (const LoggedStop& stop : log.stop.first(behind)) {
        const Int pickup = stop.node;
        if (!brings(setting.pair, pickup, delivery)) continue;
        const Int left = stop.start + setting.node[pickup].service_duration();
        most = std::max(most, excess_between(setting.between, pickup, left, start));
    }
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        if (!brings(setting.pair, sortie.node, delivery)) continue;
        most = std::max(most, excess_between(setting.between, sortie.node, sortie.ready, start));
    }
    return most;
}

std::optional<Driver> driver_of(const Setting& setting, const VehicleLog& log, Int& driven) {
    const Int begin = log.trip[0].start;
    Driver driver = driver_from(setting.type, begin);
    driven = 0;
    for (Int trip = 0; trip < log.count.trips; ++trip) {
        const Int behind = stops_of(log, trip).behind;
        for (Int index = log.trip[trip].first_stop + 1; index < behind; ++index) {
            const PausedLeg begun = paused_leg(setting, leg_to(log, index));
            RestedLeg leg = begun.by(driver);
            const bool done = drive_with(leg, begun.rests);
            driver = begun.having_arrived(leg);
            if (!done || may_drive(setting.type, driver, leg.time()) < 0) return std::nullopt;
            driven += leg.driven();
        }
    }
    return driver;
}

bool has_travelled_within(const Setting& setting, const VehicleLog& log) {
    Driver driver = driver_from(setting.type, log.trip[0].start);
    return !limits_timed_travel(setting.type) ||
           may_travel(setting.type, travelled_on(setting, log, log.count.trips, driver));
}

bool has_rested(const Setting& setting, const VehicleLog& log) {
    if (!has_driving_rules(setting.type)) return true;
    Int driven = 0;
    const std::optional<Driver> driver = driver_of(setting, log, driven);
    return driver && may_travel(setting.type, driven) &&
           may_still_work(setting.type, *driver, log.stop[log.count.stops - 1].leave);
}

Int waits_for_calm(const Setting& setting, const VehicleLog& log) {
    const auto [first, behind] = stops_of(log, log.count.trips - 1);
    return wait_for_calm(setting.type, log.stop[first].leave, log.stop[behind - 1].leave,
                         zones_of_trip(setting, log, log.count.trips - 1));
}

Int most_excess(const Setting& setting, const VehicleLog& log) {
    Int most = -far;
    if (some_limited(setting.max_time_aboard)) most = excess_of_parcels(setting, log);
    if (some_limited(setting.between)) most = std::max(most, excess_of_pairs(setting, log));
    if (!setting.lag.empty()) {
        const Int first = log.trip[log.count.trips - 1].first_stop;
        most = std::max(most, logged_starts(log).most_excess(setting, first));
    }
    if (bounds_trips(setting.type)) most = std::max(most, excess_in_air(setting, log));
    return most;
}

Int time_to_turn(const Setting& setting, const VehicleLog& log) {
    const Int first = log.trip[log.count.trips - 1].first_stop;
    Int soonest = far;
    for (Int index = first + 1; index < log.count.stops; ++index) {
        const LoggedStop& before = log.stop[index - 1];
        const auto& [node, arrival, start, leave, rests] = log.stop[index];
        const Int driven = arrival - setup_beside(setting.type, setting.setup, before.node, node);
        soonest = std::min(soonest,
                           time_to_turn(setting.type, setting.profile_time, before.leave, driven));
        if (node < setting.num_depots) continue;
        const Int open = setting.across.empty() ? none : span_of(setting, node).soonest;
        soonest = std::min(soonest, time_to_turn(setting.node[node], arrival, open));
    }
    for (const LoggedSortie& sortie : log.sortie.first(log.count.sorties)) {
        if (sortie.launch_stop < first) continue;
        const Windows place = drone_kind_of(setting, sortie.row).node[sortie.node];
        soonest = std::min(soonest, time_to_turn(place, sortie.arrival, none));
    }
    return soonest;
}

Int latest_start(const Setting& setting, VehicleLog& log, Int trip, Int known) {
    Int low = known + 1;
    if (!costs_nothing(setting, log, trip, low)) return known;
    Int high = log.stop[log.count.stops - 1].leave + 1;
    while (high - low > 1) {
        const Int middle = (low + high) / 2;
        (costs_nothing(setting, log, trip, middle) ? low : high) = middle;
    }
    return low;
}

Int first_departure(const Setting& setting, const VehicleLog& log, Int start) {
    Int departure = leaves_first(setting.type, start);
    if (log.count.ops > 0 && log.op[0].stop == 0) {
        departure = sortie_takeoff(setting, log, log.sortie[log.op[0].sortie], start, 0);
    }
    return counted_from(setting.type, departure);
}

Int start_to_depart(const Setting& setting, const VehicleLog& log, Int departure) {
    if (log.count.ops == 0 || log.op[0].stop != 0) return departure;
    return launch_begin(setting.types[log.sortie[log.op[0].sortie].row], departure, 0);
}

Int start_within_work(const Setting& setting, VehicleLog& log, Int known) {
    if (has_begun(setting.type)) return known;
    const Int needed =
        log.stop[log.count.stops - 1].leave - longest_work(setting.type) - unpaid_in(setting, log);
    if (first_departure(setting, log, known) >= needed) return known;
    const Int later = start_to_depart(setting, log, needed);
    return costs_nothing(setting, log, 0, later) ? later : known;
}

}  // namespace tandem
