#include "search/route/rest_legs.h"

namespace tandem {

void RestLegs::drive(const RestLabel& label, const Way& way, RestLabels& there) {
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

}  // namespace tandem
