#include "search/route/resting.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "rules/leg.h"
#include "search/route/block.h"
#include "search/route/breaks.h"
#include "search/route/rarer.h"
#include "search/route/rest_labels.h"
#include "search/route/routes.h"

namespace tandem {
namespace {

using Label = RestLabel;
using Labels = RestLabels;
using Taken = TakenRest;

// Return how long the breaks behind a stop make its gap.
Int resting_in_gap(const VehicleType& type, const Stop& stop) {
    return rests_in_gaps(type) ? duration_of(type, Rests(stop.rests)) : 0;
}

// Return how long the leg from a stop is, without setup and rests.
Int driving_from(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops,
                 Int p) {
    return stops[p].gap - resting_in_gap(type, stops[p]) -
           setup_after(data.setup, stops[p].node, stops[p + 1].node);
}

// Let nobody rest behind a stop. In place.
void forget_rests(const VehicleType& type, Stop& stop) {
    stop.gap -= resting_in_gap(type, stop);
    stop.rests = 0;
}

class Placing {
public:
    Placing(const ProblemData& data, const Route& route, View<Stop, 1> stops,
            View<Sortie, 1> sorties)
        : truck_(data, route.type),
          type_(truck_.type),
          stops_(stops.first(route.length)),
          sorties_(sorties.first(route.sorties)) {
        if (truck_.resting) truck_.begin = begin_of(type_, stops_);
        for (Int number = 0; number < num_breaks(type_); ++number) {
            if (!over_before(type_, number, truck_.begin)) {
                due_[static_cast<std::size_t>(num_due_++)] = number;
            }
        }
    }

    bool run() {
        Label first;
        first.cum = first.airborne = first.next = first.count = 0;
        first.depart = far;
        first.time = begin_of(type_, stops_);
        first.driver = driver_from(type_, first.time);
        there_->add(first);
        make_ready(truck_, stops_, sorties_);
        ahead_ = 0;
        for (Int p = 0; p < stops_.size(); ++p) ahead_ += driving_at(p);
        for (Int p = 0; p < stops_.size();) {
            if (stops_[p].kind == start_stop) {
                launched_ = 0;
                first_of_trip_ = sortie_;
            }
            p = pass_block(p) + 1;
        }
        return write();
    }

private:
    // A leg, how long those behind it are, and where whoever gets there is noted.
    struct Way {
        Int p;  // the stop before it
        Int duration;
        Int setup;
        Int ahead;
        bool may_rest;
        Labels& there;
    };

    bool is_last(Int p) const { return p + 1 == stops_.size(); }

    // Return how long the leg from a stop is, that of one where a trip ends.
    Int driving_at(Int p) const {
        if (stops_[p].kind == end_stop || is_last(p)) return 0;
        return driving_from(truck_.data, type_, stops_, p);
    }

    // Return the leg from a stop, driven while drones are out or not. In place: what is ahead.
    Way way_from(Int p, bool flying, Labels& there) {
        const Int duration = driving_at(p);
        ahead_ -= duration;
        const Int setup =
            is_last(p) ? 0 : setup_after(truck_.data.setup, stops_[p].node, stops_[p + 1].node);
        return {p, duration, setup, ahead_, !flying || may_rest_in_flights(type_), there};
    }

    // Let all labels pass the block that begins at a stop, and come to the next; return its last
    // stop.
    Int pass_block(Int first) {
        Int last = first;
        behind_ = sortie_;
        for (; behind_ < sorties_.size() && sorties_[behind_].launch <= last; ++behind_) {
            last = std::max(last, sorties_[behind_].recovery);
        }
        const Labels& here = *there_;
        there_ = other(labels_, there_);
        there_->clear();
        if (behind_ == sortie_) {
            const Way way = way_from(first, false, *there_);
            for (const Label& label : here) pass(label, way);
            return last;
        }
        const Int ahead = ahead_;
        for (const Label& label : here) {
            ahead_ = ahead;
            fly(label, first, last);
        }
        launched_ += behind_ - sortie_;
        sortie_ = behind_;
        return last;
    }

    static Labels* other(std::array<Labels, 2>& two, const Labels* one) {
        return &two[one == two.data() ? 1 : 0];
    }

    // Leave a stop without sorties, reached so, and come to the next.
    void pass(const Label& label, const Way& way) {
        const Stop& stop = stops_[way.p];
        truck_.time_alone(stops_[way.p], label.time);
        if (may_arrive(stop, label.time)) leave(behind_block(label, stop), way);
    }

    static bool may_arrive(const Stop& stop, Int time) {
        return stop.lo <= time && time <= stop.hi;
    }

    // What a label becomes behind the block that begins with a stop.
    static Label behind_block(Label label, const Stop& stop) {
        label.depart = std::min(label.depart, stop.dep - label.cum);
        // With breaks, `d` is none, and when it leaves at best is asked behind.
        label.cum = std::max(label.cum + stop.d, none);
        label.time = std::max(label.time + stop.d, stop.c);
        return label;
    }

    // Leave the last stop of a block, and come to the next.
    void leave(Label label, const Way& way) {
        if (!may_still_work(type_, label.driver, label.time)) return;
        if (is_last(way.p)) {
            way.there.add(label);
        } else if (stops_[way.p].kind == end_stop) {
            label.time += stops_[way.p].gap;
            label.cum += stops_[way.p].gap;
            way.there.add(label);
        } else {
            drive(label, way);
        }
    }

    // Drive from a stop that is left so to the next.
    void drive(const Label& label, const Way& way) {
        left_ = label.time;
        ride(label, way, RestedLeg(type_, truck_.begin, label.driver, label.time, way.duration),
             RestPlace::departure);
    }

    // Leave a block with sorties, reached so, and come to the stop behind it.
    //
    // Who drives on while drones are out may rest on each leg: of all ways to have come to a stop
    // those are followed that may be best.
    void fly(const Label& reached, Int first, Int last) {
        inside_->clear();
        inside_->add(reached);
        for (Int q = first; q < last; ++q) {
            const Labels& here = *inside_;
            inside_ = other(inside_rows_, inside_);
            inside_->clear();
            const Way way = way_from(q, true, *inside_);
            for (Label label : here) {
                take_rests(label, first, last);
                label.time = leave_inside(first, q, last, reached.time);
                if (label.time == far || !may_still_work(type_, label.driver, label.time)) continue;
                label.airborne = takeoffs_of_flying(q);
                drive(label, way);
            }
        }
        const Way way = way_from(last, false, *there_);
        for (Label label : *inside_) {
            take_rests(label, first, last);
            if (leave_inside(first, last, last, reached.time) == far) continue;
            label.time = reached.time;
            label.cum = reached.cum;
            label.airborne = 0;
            const Stop& stop = stops_[first];
            if (may_arrive(stop, label.time)) leave(behind_block(label, stop), way);
        }
        rest_nowhere(first, last);
    }

    // Let the legs of a block have the rests of a label.
    void take_rests(const Label& label, Int first, Int last) {
        rest_nowhere(first, last);
        Int index = label.count;
        while (index > 0 && at(label, index - 1).stop >= first) --index;
        for (; index < label.count; ++index) take(at(label, index));
    }

    void rest_nowhere(Int first, Int last) {
        for (Int q = first; q < last; ++q) forget_rests(type_, stops_[q]);
    }

    void take(const Taken& taken) {
        const auto [p, number, place] = taken;
        Stop& stop = stops_[p];
        stop.rests = Rests(stop.rests).with(number, RestPlace{place}).packed();
        if (rests_in_gaps(type_)) stop.gap += rest_duration(type_, number);
    }

    // Return when a stop of a block is left that is reached at `time`; `far` if never, or, at its
    // last stop, if a rule is broken.
    Int leave_inside(Int first, Int q, Int last, Int time) {
        for (Int s = sortie_; s < behind_; ++s) sorties_[s].state = sortie_waits;
        for (Int p = first; p <= q; ++p) stops_[p].leave = far;
        BlockSums sums;
        sums.time = time;
        sums.oldest = sortie_;
        sums.launched = launched_;
        sums.first_sortie = first_of_trip_;
        const bool done = time_block(truck_, stops_, sorties_, first, sums) == last;
        return done || q < last ? stops_[q].leave : far;
    }

    // Return the sum of the take-offs of drones that are out when a stop is left.
    Int takeoffs_of_flying(Int q) const {
        Int sum = 0;
        for (Int s = sortie_; s < behind_; ++s) {
            if (sorties_[s].launch <= q && q < sorties_[s].recovery) sum += sorties_[s].takeoff;
        }
        return sum;
    }

    // Drive what is left of a leg, with rests where one has to, and perhaps one at its end, and
    // with breaks at this `place` of it and behind.
    void ride(const Label& label, const Way& way, const RestedLeg& leg, RestPlace place) {
        take_break(label, way, leg, place);
        if (leg.is_too_long()) {
            rest(label, way, leg, RestPlace::way);
            return;
        }
        RestedLeg arriving = leg;
        arriving.arrive();
        come(label, way, arriving);
        // Who may drive on to the end needs no rest.
        if (may_need_rest(type_, arriving.driver(), way.ahead)) {
            rest(label, way, leg, RestPlace::arrival);
        }
    }

    // Take each rest that may come next, and go on.
    void rest(const Label& label, const Way& way, const RestedLeg& leg, RestPlace place) {
        if (!way.may_rest) return;
        for (const Int number : {whole_rest, first_part, second_part}) {
            if (may_rest(type_, leg.driver(), number)) take_one(label, way, leg, number, place);
        }
    }

    // Take the next break that is stated, and go on.
    void take_break(const Label& label, const Way& way, const RestedLeg& leg, RestPlace place) {
        if (label.next == num_due_) return;
        const Int number = due_[static_cast<std::size_t>(label.next)];
        if (is_among(stops_[way.p].heavy, number)) return;
        Label next = label;
        ++next.next;
        if (place == RestPlace::departure) take_one(next, way, leg, number, place);
        if (place != RestPlace::arrival && may_rest_on_way(type_, number)) {
            take_one(next, way, leg, number, RestPlace::way);
        }
        take_one(next, way, leg, number, RestPlace::arrival);
    }

    // Take a break or a rest, and go on. Who has rested where a leg ends has driven nothing since,
    // but may have taken half a rest.
    void take_one(Label next, const Way& way, const RestedLeg& leg, Int number, RestPlace place) {
        if (next.count == most_rests_on_route || rests_on(next, way.p) == most_rests) return;
        RestedLeg rested = leg;
        if (rested.take(number, place) == none) return;
        next.taken[static_cast<std::size_t>(next.count++)] = {static_cast<std::int32_t>(way.p),
                                                              static_cast<std::int8_t>(number),
                                                              static_cast<std::int8_t>(place)};
        if (place != RestPlace::arrival) {
            ride(next, way, rested, place);
            return;
        }
        come(next, way, rested);
        take_break(next, way, rested, place);
        const bool may_again = number == first_part || is_stated(number);
        if (may_again && may_need_rest(type_, rested.driver(), way.ahead)) {
            rest(next, way, rested, place);
        }
    }

    // Note that a leg is over.
    void come(Label label, const Way& way, const RestedLeg& leg) {
        label.time = leg.time() + way.setup;
        if (!truck_.resting) label.cum += label.time - left_;
        label.driver = leg.driver();
        way.there.add(label);
    }

    Int rests_on(const Label& label, Int p) const {
        Int count = 0;
        for (Int index = label.count - 1; index >= 0 && at(label, index).stop == p; --index) {
            ++count;
        }
        return count;
    }

    static const Taken& at(const Label& label, Int index) {
        return label.taken[static_cast<std::size_t>(index)];
    }

    // Write the rests of the route whose work costs least, and of these that which ends first. With
    // breaks, that which ends first.
    bool write() {
        const Label* best = nullptr;
        std::pair<double, Int> least;
        for (const Label& label : *there_) {
            if (!may_end(type_, label.time)) continue;
            std::pair<double, Int> cost{0.0, label.time};
            if (truck_.resting) {
                if (lacks_break(label)) continue;
            } else {
                const Int departure = std::min(label.depart, label.time - label.cum);
                const Int working = label.time - counted_from(type_, departure);
                if (!may_work(type_, working)) continue;
                cost.first =
                    work_cost(truck_.data.rate[truck_.k], paid_work(type_, label.time, working));
            }
            if (best == nullptr || cost < least) {
                best = &label;
                least = cost;
            }
        }
        if (best == nullptr) return false;
        for (Int index = 0; index < best->count; ++index) take(at(*best, index));
        return true;
    }

    // Tell whether a route that has ended should have had a break more.
    bool lacks_break(const Label& label) const {
        return label.next < num_due_ && !none_due(type_, due_[static_cast<std::size_t>(label.next)],
                                                  truck_.begin, label.time);
    }

    Truck truck_;
    const VehicleType& type_;
    View<Stop, 1> stops_;
    View<Sortie, 1> sorties_;
    Int num_due_ = 0;  // of the breaks that the beginning doesn't come too late for
    std::array<Int, most_breaks> due_{};
    std::array<Labels, 2> labels_;  // where the truck is, and where it comes, in turn
    Labels* there_ = labels_.data();
    std::array<Labels, 2> inside_rows_;  // likewise within a block
    Labels* inside_ = inside_rows_.data();
    Int left_ = 0;    // when the leg began
    Int ahead_ = 0;   // how long all legs from here are
    Int sortie_ = 0;  // the first not passed, and the first behind the block
    Int behind_ = 0;
    Int launched_ = 0;  // on the trip
    Int first_of_trip_ = 0;
};

// Let nobody rest on a route. In place.
void clear_rests(const VehicleType& type, View<Stop, 1> stops) {
    for (Stop& stop : stops) forget_rests(type, stop);
}

// Return how long a driver of a route without rests is at the wheel.
Int driving_on(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops) {
    Int driving = 0;
    for (Int p = 0; p < stops.size(); ++p) {
        if (stops[p].kind != end_stop) driving += driving_from(data, type, stops, p);
    }
    return driving;
}

// Return when a timed route begins that begins as late as that costs nothing.
Int last_begin(const ProblemData& data, Route& route, View<const Stop, 1> stops,
               View<const Sortie, 1> sorties) {
    const Int departure = first_departure(data, route, stops, sorties);
    return counted_begin(data.type[route.type], departure - route.offset);
}

// Let a timed route without rests begin at `hold`, if it ends no later then. In place; false if
// not, and it is as before.
bool begin_later(const ProblemData& data, Route& route, View<Stop, 1> stops,
                 View<Sortie, 1> sorties, Int hold) {
    const Int end = route.end, before = std::exchange(stops[0].hold, hold);
    if (drive_as_placed(data, route, stops, sorties) && route.end <= end) return true;
    stops[0].hold = before;
    drive_as_placed(data, route, stops, sorties);
    return false;
}

// Write rests and times of a route that begins no sooner than `hold`. In place; false if a rule is
// broken.
bool rest_from(const ProblemData& data, Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties,
               Int hold) {
    clear_rests(data.type[route.type], stops.first(route.length));
    stops[0].hold = hold;
    return Placing(data, route, stops, sorties).run() &&
           drive_as_placed(data, route, stops, sorties);
}

// Return by how much later than soonest a timed route without drones may begin and end no later.
Int slack_of_begin(const ProblemData& data, const Route& route, View<const Stop, 1> stops) {
    const NodeTable places = data.place.by_truck(data.type[route.type]);
    Int waited = 0, slack = far;
    for (const Stop& stop : stops.first(route.length)) {
        if (!has_window(stop)) continue;
        const Windows place = places[stop.node];
        slack = std::min(slack, waited + place.as_late(stop.arrival) - stop.arrival);
        waited += place.waiting(stop.arrival);
    }
    return std::min(slack, waited);
}

// As `drive_by_rules`, of a driver who has breaks, too.
bool drive_with_breaks(const ProblemData& data, Route& route, View<Stop, 1> stops,
                       View<Sortie, 1> sorties) {
    const VehicleType& type = data.type[route.type];
    const bool driven = drive_as_placed(data, route, stops, sorties);
    if (driven) {
        const Int driving = driving_on(data, type, stops.first(route.length));
        const Int begin = counted_begin(type, begin_of(type, stops));
        if (!any_break_due(type, route, stops) && needs_no_rest(type, driving, route.end - begin)) {
            route.driving = driving;
            return true;
        }
    }
    // Whoever rests is later everywhere, which helps drones alone.
    if (!driven && route.sorties == 0) return false;
    const bool may_wait =
        driven && limits_work(type) && route.sorties == 0 && stops[0].hold == none;
    const Int slack = may_wait ? slack_of_begin(data, route, stops) : 0;
    route.driving = far;
    const Int later = begin_of(type, stops) + slack;
    const bool rested = rest_from(data, route, stops, sorties, stops[0].hold);
    if (slack == 0) return rested;
    // Whoever begins later hasn't worked for so long.
    const Int end = rested ? route.end : far;
    if (rest_from(data, route, stops, sorties, later) && route.end <= end) return true;
    return rested && rest_from(data, route, stops, sorties, none);
}

}  // namespace

bool any_rest(const VehicleType& type, const Route& route) {
    return has_driving_rules(type) && route.driving == far;
}

bool drive_by_rules(const ProblemData& data, Route& route, View<Stop, 1> stops,
                    View<Sortie, 1> sorties) {
    const VehicleType& type = data.type[route.type];
    clear_rests(type, stops.first(route.length));
    if (has_breaks(type)) return drive_with_breaks(data, route, stops, sorties);
    if (!drive_as_placed(data, route, stops, sorties)) return false;
    const Int driving = driving_on(data, type, stops.first(route.length));
    const Int soonest = counted_begin(type, begin_of(type, stops));
    const Int latest = last_begin(data, route, stops, sorties);
    route.driving = driving;
    // With drones, who may come in another order then, a route may have to begin before.
    const Int begin = route.sorties > 0 ? soonest : latest;
    if (needs_no_rest(type, driving, route.end - begin)) return true;
    const bool may_wait = stops[0].hold == none && latest > soonest;
    if (may_wait && needs_no_rest(type, driving, route.end - latest) &&
        begin_later(data, route, stops, sorties, latest)) {
        return true;
    }
    route.driving = far;
    if (!rest_from(data, route, stops, sorties, stops[0].hold)) {
        // Whoever begins later hasn't worked for so long.
        return may_wait && rest_from(data, route, stops, sorties, latest);
    }
    if (!limits_work(type) || stops[0].hold != none) return true;
    const Int later = last_begin(data, route, stops, sorties);
    const Int end = route.end, working = end - later;
    if (later <= soonest) return true;
    if (rest_from(data, route, stops, sorties, later) && route.end <= end &&
        route.end - last_begin(data, route, stops, sorties) < working) {
        return true;
    }
    return rest_from(data, route, stops, sorties, none);
}

bool may_have_to_rest(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node) {
    const Route& route = fleet.route[slot];
    const VehicleType& type = data.type[route.type];
    const View<const Stop, 1> stops = fleet.stop[slot];
    if (any_rest(type, route) || (route.sorties > 0 && limits_work(type))) return true;
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Int longer = leg(legs, stops[p].node, node).duration +
                       leg(legs, node, stops[p + 1].node).duration - stops[p].gap;
    const Int more = std::max(Int{0}, longer);
    const Int served = data.place.by_truck(type)[node].service_duration();
    return !needs_no_rest(type, route.driving + more, route.working + more + served);
}

}  // namespace tandem
