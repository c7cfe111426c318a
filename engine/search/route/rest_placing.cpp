#include "search/route/rest_placing.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "rules/leg.h"
#include "rules/shift.h"
#include "rules/start.h"
#include "search/route/block.h"
#include "search/route/breaks.h"
#include "search/route/rarer.h"
#include "search/route/rest_labels.h"

namespace tandem {
namespace {

using Label = RestLabel;
using Labels = RestLabels;

// Let nobody rest behind a stop. In place.
void forget_rests(const VehicleType& type, Stop& stop) {
    stop.gap -= resting_in_gap(type, stop);
    stop.rests = 0;
}

class Placing {
public:
    Placing(const ProblemData& data, const Route& route, View<Stop, 1> stops,
            View<Sortie, 1> sorties, const LeastWork& least)
        : truck_(data, route.type),
          type_(truck_.type),
          stops_(stops.first(route.length)),
          sorties_(sorties.first(route.sorties)),
          least_(least) {
        if (truck_.resting) truck_.begin = begin_of(type_, stops_);
        for (Int number = 0; number < num_breaks(type_); ++number) {
            if (!over_before(type_, number, truck_.begin)) {
                due_[static_cast<std::size_t>(num_due_++)] = number;
            }
        }
    }

    bool run() {
        Label first{};
        first.depart = far;
        first.last = -1;
        first.time = begin_of(type_, stops_);
        first.driver = driver_from(type_, first.time);
        make_ready(truck_, stops_, sorties_);
        ahead_ = left_lasting_ = 0;
        for (Int p = 0; p < stops_.size(); ++p) {
            ahead_ += driving_at(p);
            left_lasting_ += lasting_at(p);
        }
        if (sorties_.empty() && !truck_.resting && !waits_.count()) {
            const Ending soonest = bound_of(first, first.time, left_lasting_, ahead_);
            for (const bool waiting : {false, true}) {
                Label label = first;
                if (rest_as_needed(label, waiting)) keep_if_best(label);
                if (is_known_ && !(soonest < ending_)) return write();
            }
        }
        there_->add(first);
        for (Int p = 0; p < stops_.size();) {
            if (stops_[p].kind == start_stop) {
                launched_ = 0;
                first_of_trip_ = sortie_;
            }
            p = pass_block(p) + 1;
        }
        for (const Label& label : *there_) keep_if_best(label);
        return is_known_ && write();
    }

private:
    // A leg, how long those behind it are, and where whoever gets there is noted.
    struct Way {
        Int p;  // the stop before it
        Int duration;
        Int setup;
        Int ahead;
        Int lasting;  // all behind it, as far as nobody waits or rests
        bool flying;
        bool may_rest;
        Labels& there;
    };

    bool is_last(Int p) const { return p + 1 == stops_.size(); }

    // Return how long the leg from a stop is, that of one where a trip ends.
    Int driving_at(Int p) const {
        if (stops_[p].kind == end_stop || is_last(p)) return 0;
        return driving_from(truck_.data, type_, stops_, p);
    }

    // Return how long service at a stop and the way to the next last, as far as nobody waits.
    Int lasting_at(Int p) const {
        const Stop& stop = stops_[p];
        const Int served =
            stop.kind == customer_stop ? truck_.places[stop.node].service_duration() : 0;
        return is_last(p) ? served : served + stop.gap - resting_in_gap(type_, stop);
    }

    // Return the leg from a stop, driven while drones are out or not. In place: what is ahead.
    Way way_from(Int p, bool flying, Labels& there) {
        const Int duration = driving_at(p);
        ahead_ -= duration;
        left_lasting_ -= lasting_at(p);
        const Int setup =
            is_last(p) ? 0 : setup_after(truck_.data.setup, stops_[p].node, stops_[p + 1].node);
        return {p,
                duration,
                setup,
                ahead_,
                left_lasting_,
                flying,
                !flying || may_rest_in_flights(type_),
                there};
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
        const Int ahead = ahead_, lasting = left_lasting_;
        for (const Label& label : here) {
            ahead_ = ahead;
            left_lasting_ = lasting;
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
    void pass(Label label, const Way& way) {
        Stop& stop = stops_[way.p];
        truck_.time_alone(stop, label.time);
        if (!may_arrive(stop, label.time)) return;
        if (waits_.count()) {
            stop.c = std::max(stop.c, waits_.leave_alone(way.p, label.time, label.waited));
            if (stop.c == far) return;
        }
        leave(behind_block(label, stop), way);
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
                label.time = leave_inside(first, q, last, reached);
                if (label.time == far || !may_still_work(type_, label.driver, label.time)) continue;
                label.airborne = takeoffs_of_flying(q);
                drive(label, way);
            }
        }
        const Way way = way_from(last, false, *there_);
        for (Label label : *inside_) {
            take_rests(label, first, last);
            if (leave_inside(first, last, last, reached) == far) continue;
            if (waits_.count()) waits_.pass({first, last + 1}, {sortie_, behind_}, label.waited);
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
        take_from(label.last, first);
    }

    // Take the rests up to one of those taken that are behind stop `first` or later, in order.
    void take_from(std::int32_t index, Int first) {
        std::array<std::int32_t, most_rests_on_route> found;
        std::size_t count = 0;
        for (; index >= 0 && taken_[index].stop >= first; index = taken_[index].before) {
            found[count++] = index;
        }
        while (count > 0) take(taken_[found[--count]]);
    }

    void rest_nowhere(Int first, Int last) {
        for (Int q = first; q < last; ++q) forget_rests(type_, stops_[q]);
    }

    void take(const TakenRest& taken) {
        Stop& stop = stops_[taken.stop];
        stop.rests = Rests(stop.rests).with(taken.number, RestPlace{taken.place}).packed();
        if (rests_in_gaps(type_)) stop.gap += rest_duration(type_, taken.number);
    }

    // Return when a stop of a block is left that is reached so; `far` if never, or, at its
    // last stop, if a rule is broken.
    Int leave_inside(Int first, Int q, Int last, const Label& reached) {
        if (waits_.count()) waits_.recall(reached.waited);
        for (Int s = sortie_; s < behind_; ++s) sorties_[s].state = sortie_waits;
        for (Int p = first; p <= q; ++p) stops_[p].leave = far;
        BlockSums sums;
        sums.time = reached.time;
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
        if (next.count == most_rests_on_route || next.on_leg == most_rests || taken_.is_full()) {
            return;
        }
        RestedLeg rested = leg;
        if (rested.take(number, place) == none) return;
        const std::int32_t before = taken_.count();
        const Int kept = kept_;
        note(next, way.p, number, place);
        if (place != RestPlace::arrival) {
            ride(next, way, rested, place);
        } else {
            come(next, way, rested);
            take_break(next, way, rested, place);
            const bool may_again = number == first_part || is_stated(number);
            if (may_again && may_need_rest(type_, rested.driver(), way.ahead)) {
                rest(next, way, rested, place);
            }
        }
        if (kept_ == kept) taken_.forget(before);
    }

    // Note a rest of a label behind stop `p`. In place.
    void note(Label& label, Int p, Int number, RestPlace place) {
        label.last =
            taken_.add({static_cast<std::int32_t>(p), label.last, static_cast<std::int8_t>(number),
                        static_cast<std::int8_t>(place)});
        ++label.count;
        ++label.on_leg;
    }

    // Note that a leg is over, unless a route is known that costs no more however this goes on.
    void come(Label label, const Way& way, const RestedLeg& leg) {
        arrive(label, way, leg, left_);
        if (!way.flying && is_known_ &&
            !(bound_of(label, label.time, way.lasting, way.ahead) < ending_)) {
            return;
        }
        if (way.there.add(label)) ++kept_;
    }

    // Let a label be where a leg ends that was begun at `left`. In place.
    void arrive(Label& label, const Way& way, const RestedLeg& leg, Int left) const {
        label.time = leg.time() + way.setup;
        if (!truck_.resting) label.cum += label.time - left;
        label.driver = leg.driver();
        if (!limits_work(type_)) label.driver.since = 0;
        label.on_leg = 0;
    }

    // Rest along a route without flights as late as allowed, or, if that is asked for, while
    // `waiting`. In place; false if that doesn't do.
    bool rest_as_needed(Label& label, bool waiting) {
        const Int ahead = ahead_, lasting = left_lasting_;
        bool done = true;
        for (Int p = 0; done && p < stops_.size(); ++p) {
            const Way way = way_from(p, false, *there_);
            truck_.time_alone(stops_[p], label.time);
            done = may_arrive(stops_[p], label.time);
            if (!done) break;
            label = behind_block(label, stops_[p]);
            done = may_still_work(type_, label.driver, label.time);
            if (!done || is_last(p)) break;
            if (stops_[p].kind == end_stop) {
                label.time += stops_[p].gap;
                label.cum += stops_[p].gap;
            } else {
                done = drive_as_needed(label, way, waiting);
            }
        }
        ahead_ = ahead;
        left_lasting_ = lasting;
        return done;
    }

    bool drive_as_needed(Label& label, const Way& way, bool waiting) {
        const Int left = label.time;
        RestedLeg leg(type_, truck_.begin, label.driver, left, way.duration);
        const auto rest_at = [&](RestPlace place) {
            const Int number = usual_rest(leg.driver());
            if (label.count == most_rests_on_route || label.on_leg == most_rests) return false;
            if (leg.take(number, place) == none) return false;
            note(label, way.p, number, place);
            return true;
        };
        while (leg.is_too_long()) {
            if (!rest_at(RestPlace::way)) return false;
        }
        RestedLeg arriving = leg;
        arriving.arrive();
        const auto [waits, ends] = stay_at(way.p + 1, arriving.time() + way.setup);
        const bool helps = waiting && arriving.driver().driven > 0 &&
                           may_need_rest(type_, arriving.driver(), way.ahead) &&
                           rest_duration(type_, usual_rest(arriving.driver())) <= waits;
        if ((helps || !may_still_work(type_, arriving.driver(), ends)) &&
            !rest_at(RestPlace::arrival)) {
            return false;
        }
        leg.arrive();
        arrive(label, way, leg, left);
        return true;
    }

    struct Stay {
        Int waits;  // for how long
        Int ends;
    };

    // Return how whoever reaches a stop without flights stays there.
    Stay stay_at(Int p, Int time) const {
        const Stop& stop = stops_[p];
        if (!has_window(stop)) return {0, time};
        const Windows place = truck_.places[stop.node];
        return {place.waiting(time), place.end_of_service(time)};
    }

    // What the end of a route costs, and when it is. Of two, that is better which is less.
    using Ending = std::pair<double, Int>;

    static constexpr double never = 1e300;

    Ending ending_of(Int end, Int working) const {
        if (!may_end(type_, end)) return {never, end};
        if (truck_.resting) return {0.0, end};
        if (!may_work(type_, working)) return {never, end};
        return {work_cost(truck_.data.rate[truck_.k], paid_work(type_, end, working)), end};
    }

    Int working_of(Int end, Int cum, Int depart) const {
        return end - counted_from(type_, std::min(depart, end - cum));
    }

    // Return what a route costs at least that has come somewhere at `time` with so much ahead.
    Ending bound_of(const Label& label, Int time, Int lasting, Int ahead) const {
        const Int more = lasting + least_rest(type_, label.driver, time, ahead, lasting);
        const Int end = std::max(time + more, least_.end);
        const Int working = working_of(end, label.cum + more, label.depart);
        return ending_of(end, std::max(working, least_.working));
    }

    // Keep a label that has come to the end if none is better. In place.
    void keep_if_best(const Label& label) {
        if (truck_.resting && lacks_break(label)) return;
        const Ending ending =
            ending_of(label.time, working_of(label.time, label.cum, label.depart));
        // Who is served too long behind another may not be if the route begins later.
        const std::pair value{label.waited.excess, ending};
        if (ending.first >= never || (is_known_ && !(value < std::pair{excess_, ending_}))) return;
        excess_ = label.waited.excess;
        ending_ = ending;
        best_ = label.last;
        is_known_ = true;
    }

    // Write the rests of the best route.
    bool write() {
        for (Stop& stop : stops_) forget_rests(type_, stop);
        take_from(best_, 0);
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
    Waits waits_{truck_, stops_, sorties_};
    Int num_due_ = 0;  // of the breaks that the beginning doesn't come too late for
    std::array<Int, most_breaks> due_{};
    std::array<Labels, 2> labels_;  // where the truck is, and where it comes, in turn
    Labels* there_ = labels_.data();
    std::array<Labels, 2> inside_rows_;  // likewise within a block
    Labels* inside_ = inside_rows_.data();
    TakenRests taken_;
    LeastWork least_;
    bool is_known_ = false;  // any way to the end, which costs so much, and has these rests
    Int excess_ = 0;
    Ending ending_{never, far};
    std::int32_t best_ = -1;
    Int kept_ = 0;          // labels
    Int left_ = 0;          // when the leg began
    Int ahead_ = 0;         // how long all legs from here are
    Int left_lasting_ = 0;  // and all from here, as far as nobody waits or rests
    Int sortie_ = 0;        // the first not passed, and the first behind the block
    Int behind_ = 0;
    Int launched_ = 0;  // on the trip
    Int first_of_trip_ = 0;
};

}  // namespace

Int resting_in_gap(const VehicleType& type, const Stop& stop) {
    return rests_in_gaps(type) ? duration_of(type, Rests(stop.rests)) : 0;
}

Int driving_from(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops,
                 Int p) {
    return stops[p].gap - resting_in_gap(type, stops[p]) -
           setup_after(data.setup, stops[p].node, stops[p + 1].node);
}

void clear_rests(const VehicleType& type, View<Stop, 1> stops) {
    for (Stop& stop : stops) forget_rests(type, stop);
}

bool place_rests(const ProblemData& data, const Route& route, View<Stop, 1> stops,
                 View<Sortie, 1> sorties, const LeastWork& least) {
    return Placing(data, route, stops, sorties, least).run();
}

}  // namespace tandem
