#include "search/route/rests.h"

namespace tandem {
namespace {

// How a driver rests who looks no further than the next stop.
enum class Manner {
    late,     // as late as allowed
    waiting,  // or while waiting
    halving,  // the first part where a break that is stated can be the second
};

class LateRests {
public:
    LateRests(const RestRoute& route, TakenRests& taken, Manner manner)
        : route_(route), type_(route.type), taken_(taken), manner_(manner) {}

    // Come from the beginning of a route to its end. In place; false if that doesn't do.
    bool run(RestLabel& label, Ahead ahead) {
        for (Int p = 0;; ++p) {
            const LegAhead way = route_.way_from(p, ahead, false);
            if (!route_.reach_alone(p, label.time) || !route_.leave_block(label, p)) return false;
            if (route_.is_last(p)) return true;
            if (route_.stops[p].kind == end_stop) {
                route_.reload(label, p);
            } else if (!(label.next < route_.due.count() ? drive_with_breaks(label, way)
                                                         : drive(label, way))) {
                return false;
            }
            ahead = way.ahead;
        }
    }

private:
    // Take a break or a rest on a leg. In place; false if it can't be.
    bool take(RestLabel& label, RestedLeg& leg, Int p, Int number, RestPlace place) {
        if (!has_room(label) || taken_.is_full() || leg.take(number, place) == none) return false;
        taken_.note(label, p, number, place);
        return true;
    }

    bool drive(RestLabel& label, const LegAhead& way) {
        const Int left = label.time;
        RestedLeg leg = route_.leg_of(label, way);
        const auto rest_at = [&](RestPlace place) {
            return take(label, leg, way.p, usual_rest(leg.driver()), place);
        };
        while (leg.is_too_long()) {
            if (!rest_at(RestPlace::way)) return false;
        }
        RestedLeg arriving = leg;
        arriving.arrive();
        const Driver& driver = arriving.driver();
        const auto [waits, ends] = route_.stay_at(way.p + 1, arriving.time() + way.setup);
        const bool helps = manner_ == Manner::waiting && driver.driven > 0 &&
                           route_.may_need_rest(driver, way.ahead) &&
                           rest_duration(type_, usual_rest(driver)) <= waits;
        if ((helps || !may_still_work(type_, driver, ends)) && !rest_at(RestPlace::arrival)) {
            return false;
        }
        leg.arrive();
        route_.arrive(label, way, leg, left);
        return true;
    }

    // As `drive`, of who has breaks to come.
    bool drive_with_breaks(RestLabel& label, const LegAhead& way) {
        const Int left = label.time;
        RestedLeg leg = route_.leg_of(label, way);
        const auto stay = [&](Int arrival) {
            return route_.stay_at(way.p + 1, arrival + way.setup);
        };
        const auto opens = [&](Int arrival) { return arrival + stay(arrival).waits; };
        const auto ends = [&](Int arrival) { return stay(arrival).ends; };
        if (manner_ == Manner::halving && !halve(label, leg, way, ends)) return false;
        if (label.next < route_.due.count()) {
            const std::optional<Rests> rests =
                Unforeseeing(type_, leg, opens, ends)
                    .run({route_.due[label.next], route_.stops[way.p].heavy, route_.truck.begin});
            if (!rests) return false;
            for (Int index = 0; index < rests->count(); ++index) {
                const Int number = rests->number(index);
                if (!take(label, leg, way.p, number, rests->place(index))) return false;
                if (is_stated(number)) ++label.next;
            }
        }
        if (!leg.arrive()) return false;
        route_.arrive(label, way, leg, left);
        return true;
    }

    // Take half a rest and behind it a break that is the other half, where that can't be put off.
    // In place; false if they can't be.
    template <class Ends>
    bool halve(RestLabel& label, RestedLeg& leg, const LegAhead& way, const Ends& ends) {
        const Int number = route_.due[label.next], half = rest_duration(type_, first_part);
        if (!completes_rest(leg, number) || is_among(route_.stops[way.p].heavy, number))
            return true;
        const Int latest = break_of(type_, number, route_.truck.begin).latest - half;
        RestedLeg arriving = leg;
        const bool arrives = !leg.is_too_long() && arriving.arrive();
        if (arrives && ends(arriving.time()) <= latest) return true;
        const bool there = arrives && arriving.time() <= latest;
        const RestPlace before = there ? RestPlace::arrival : RestPlace::departure;
        const bool on_way = !there && may_rest_on_way(type_, number);
        if (!take(label, leg, way.p, first_part, before) ||
            !take(label, leg, way.p, number, on_way ? RestPlace::way : before)) {
            return false;
        }
        ++label.next;
        return true;
    }

    // Tell whether a break would be the second part of a rest behind a first one.
    bool completes_rest(const RestedLeg& leg, Int number) const {
        const Int length = length_of(type_, number);
        return may_rest(type_, leg.driver(), first_part) &&
               length >= rest_duration(type_, second_part) &&
               length < rest_duration(type_, whole_rest);
    }

    const RestRoute& route_;
    const VehicleType& type_;
    TakenRests& taken_;
    const Manner manner_;
};

}  // namespace

void RestLegs::drive(const RestLabel& label, const LegAhead& way, RestLabels& there) {
    way_ = way;
    left_ = label.time;
    there_ = &there;
    const RestedLeg leg = route_.leg_of(label, way);
    ride(label, leg, RestPlace::departure);
    // While it is slow, who rests before a leg may be sooner than who does so behind it.
    if (left_ < route_.truck.speeds.last_change()) rest(label, leg, RestPlace::departure);
}

// Drive what is left of a leg, with rests where one has to, and perhaps one at its end, and with
// breaks at this `place` of it and behind.
void RestLegs::ride(const RestLabel& label, const RestedLeg& leg, RestPlace place) {
    take_break(label, leg, place);
    if (leg.is_too_long()) {
        rest(label, leg, RestPlace::way);
        return;
    }
    RestedLeg arriving = leg;
    arriving.arrive();
    come(label, arriving);
    // Who may drive on to the end needs no rest.
    if (route_.may_need_rest(arriving.driver(), way_.ahead)) {
        rest(label, leg, RestPlace::arrival);
    }
}

// Take each rest that may come next, and go on.
void RestLegs::rest(const RestLabel& label, const RestedLeg& leg, RestPlace place) {
    if (!way_.may_rest) return;
    for (const Int number : {whole_rest, first_part, second_part}) {
        if (may_rest(type_, leg.driver(), number)) take(label, leg, number, place);
    }
}

// Take the next break that is stated, and go on.
void RestLegs::take_break(const RestLabel& label, const RestedLeg& leg, RestPlace place) {
    if (label.next == route_.due.count()) return;
    const Int number = route_.due[label.next];
    if (is_among(route_.stops[way_.p].heavy, number)) return;
    if (place != RestPlace::arrival && is_put_off(leg, number)) place = RestPlace::arrival;
    RestLabel next = label;
    ++next.next;
    if (place == RestPlace::departure) take(next, leg, number, place);
    if (place != RestPlace::arrival && may_rest_on_way(type_, number)) {
        take(next, leg, number, RestPlace::way);
    }
    take(next, leg, number, RestPlace::arrival);
}

// Tell whether who takes a break at the end of the leg is no later than who does so before, as its
// window isn't open until then. Where no drones fly few ways are followed that differ by that.
bool RestLegs::is_put_off(const RestedLeg& leg, Int number) const {
    if (route_.sorties.empty() || leg.is_too_long()) return false;
    RestedLeg arriving = leg;
    arriving.arrive();
    return arriving.time() <= break_of(type_, number, route_.truck.begin).earliest;
}

// Take a break or a rest, and go on. Who has rested where a leg ends has driven nothing since, but
// may have taken half a rest.
void RestLegs::take(RestLabel next, const RestedLeg& leg, Int number, RestPlace place) {
    if (!has_room(next) || taken_.is_full()) return;
    RestedLeg rested = leg;
    if (rested.take(number, place) == none || !may_be_best(next, rested)) return;
    const std::int32_t before = taken_.count();
    const Int kept = kept_;
    taken_.note(next, way_.p, number, place);
    if (place != RestPlace::arrival) {
        ride(next, rested, place);
    } else {
        // Who is no better there than somebody else isn't behind another break either.
        if (come(next, rested)) take_break(next, rested, place);
        const bool may_again = number == first_part || is_stated(number);
        if (may_again && route_.may_need_rest(rested.driver(), way_.ahead)) {
            rest(next, rested, place);
        }
    }
    if (kept_ == kept) taken_.forget(before);
}

// Note that a leg is over, if that may be best; tells.
bool RestLegs::come(RestLabel label, const RestedLeg& leg) {
    if (!may_be_best(label, leg)) return false;
    route_.arrive(label, way_, leg, left_);
    const bool kept = there_->add(label);
    kept_ += kept ? 1 : 0;
    return kept;
}

// Tell whether a way may be better than the best known, somewhere on the leg.
bool RestLegs::may_be_best(const RestLabel& label, const RestedLeg& leg) const {
    if (leg.time() + way_.setup + leg.left() > route_.stops[way_.p + 1].latest) return false;
    if (label.next < route_.due.count() &&
        leg.time() > break_of(type_, route_.due[label.next], route_.truck.begin).latest) {
        return false;
    }
    if (!best_.is_known()) return true;
    RestLabel there = label;
    route_.arrive(there, way_, leg, left_);
    const Ahead ahead{way_.ahead.driving + leg.left(), way_.ahead.lasting + leg.left()};
    return best_.may_be_better(route_.bound_of(there, there.time, ahead));
}

bool rest_late(const RestRoute& route, BestRests& best, TakenRests& taken) {
    const RestLabel first = route.beginning();
    const Ahead ahead = route.whole();
    const Ending soonest = route.bound_of(first, first.time, ahead);
    for (const Manner manner : {Manner::late, Manner::waiting, Manner::halving}) {
        if (manner == Manner::halving && route.due.count() == 0) break;
        RestLabel label = first;
        if (LateRests(route, taken, manner).run(label, ahead)) {
            best.keep(label, route.ending_of(label));
        }
        if (!best.may_be_better(soonest)) return true;
    }
    return false;
}

}  // namespace tandem
