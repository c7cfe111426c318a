#include "search/route/resting.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "rules/leg.h"
#include "search/route/block.h"
#include "search/route/breaks.h"
#include "search/route/rarer.h"
#include "search/route/routes.h"

namespace tandem {
namespace {

constexpr std::size_t most_labels = 48;

// Which rest is taken, on the leg behind which stop, and where.
struct Taken {
    std::int32_t stop;
    std::int8_t number;
    std::int8_t place;
};

// A driver who has come somewhere, with the rests so far.
struct Label {
    Int time;
    Int cum;     // sum of all durations
    Int depart;  // the latest departure that costs nothing
    Driver driver;
    Int count;
    std::array<Taken, most_rests_on_route> taken;  // so many of them are written
};

// Tell whether one is no worse than another, whatever comes.
bool is_no_worse(const Label& one, const Label& other) {
    return one.time <= other.time && one.cum <= other.cum && one.depart >= other.depart &&
           one.driver.driven <= other.driver.driven && one.driver.since >= other.driver.since &&
           one.driver.half_rested >= other.driver.half_rested;
}

// Labels of which none is no worse than another.
class Labels {
public:
    const Label* begin() const { return label_.data(); }
    const Label* end() const { return label_.data() + count_; }
    void clear() { count_ = 0; }

    // Keep a label unless another is no worse; where there are too many, that goes which is last.
    void add(const Label& label) {
        std::size_t kept = 0;
        for (std::size_t index = 0; index < count_; ++index) {
            if (is_no_worse(label_[index], label)) return;
        }
        for (std::size_t index = 0; index < count_; ++index) {
            if (is_no_worse(label, label_[index])) continue;
            if (kept != index) label_[kept] = label_[index];
            ++kept;
        }
        count_ = kept;
        if (count_ < most_labels) {
            label_[count_++] = label;
            return;
        }
        Label& last = *std::max_element(
            label_.begin(), label_.end(),
            [](const Label& one, const Label& other) { return one.time < other.time; });
        if (label.time < last.time) last = label;
    }

private:
    std::array<Label, most_labels> label_;
    std::size_t count_ = 0;
};

// Return how long the leg from a stop is, without setup and rests.
Int driving_from(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops,
                 Int p) {
    return stops[p].gap - duration_of(type, Rests(stops[p].rests)) -
           setup_after(data.setup, stops[p].node, stops[p + 1].node);
}

class Placing {
public:
    Placing(const ProblemData& data, const Route& route, View<Stop, 1> stops)
        : truck_(data, route.type), type_(truck_.type), stops_(stops.first(route.length)) {}

    bool run() {
        Label first;
        first.cum = first.count = 0;
        first.depart = far;
        first.time = std::max(type_.shift_earliest, std::max(stops_[0].release, stops_[0].hold));
        first.driver = driver_from(type_, first.time);
        there_->add(first);
        const Int last = stops_.size() - 1;
        ahead_ = 0;
        for (Int p = 0; p < last; ++p) ahead_ += driving_at(p);
        for (Int p = 0; p < last; ++p) {
            ahead_ -= driving_at(p);
            Labels& here = labels_[static_cast<std::size_t>(p & 1)];
            there_ = &labels_[static_cast<std::size_t>((p + 1) & 1)];
            there_->clear();
            for (const Label& label : here) pass(label, p);
        }
        return write();
    }

private:
    // Return how long the leg from a stop is, that of one where no trip ends.
    Int driving_at(Int p) const {
        return stops_[p].kind == end_stop ? 0 : driving_from(truck_.data, type_, stops_, p);
    }

    // Leave stop `p`, reached so, and come to the next.
    void pass(Label label, Int p) {
        Stop& stop = stops_[p];
        truck_.time_alone(stop, label.time);
        if (label.time > stop.hi || label.time < stop.lo) return;
        label.depart = std::min(label.depart, stop.dep - label.cum);
        label.cum += stop.d;
        label.time = std::max(label.time + stop.d, stop.c);
        if (!may_still_work(type_, label.driver, label.time)) return;
        if (stop.kind == end_stop) {
            label.time += stop.gap;
            label.cum += stop.gap;
            there_->add(label);
            return;
        }
        const Int setup = setup_after(truck_.data.setup, stop.node, stops_[p + 1].node);
        left_ = label.time;
        ride(label, p, RestedLeg(type_, label.driver, label.time, stop.gap - setup), setup);
    }

    // Drive a leg, with rests where one has to, and perhaps one at its end.
    void ride(const Label& label, Int p, const RestedLeg& leg, Int setup) {
        if (leg.is_too_long()) {
            rest(label, p, leg, setup, RestPlace::way);
            return;
        }
        RestedLeg arriving = leg;
        arriving.arrive();
        come(label, arriving, setup);
        // Who may drive on to the end needs no rest.
        if (may_need_rest(type_, arriving.driver(), ahead_)) {
            rest(label, p, leg, setup, RestPlace::arrival);
        }
    }

    // Take each rest that may come next, and go on. Who has rested where a leg ends has driven
    // nothing since, but may have taken half a rest.
    void rest(const Label& label, Int p, const RestedLeg& leg, Int setup, RestPlace place) {
        if (label.count == most_rests_on_route || rests_on(label, p) == most_rests) return;
        for (const Int number : {whole_rest, first_part, second_part}) {
            if (!may_rest(type_, leg.driver(), number)) continue;
            RestedLeg rested = leg;
            if (rested.take(number, place) == none) continue;
            Label next = label;
            next.taken[static_cast<std::size_t>(next.count++)] = {static_cast<std::int32_t>(p),
                                                                  static_cast<std::int8_t>(number),
                                                                  static_cast<std::int8_t>(place)};
            if (place == RestPlace::way) {
                ride(next, p, rested, setup);
            } else {
                come(next, rested, setup);
                if (number == first_part) rest(next, p, rested, setup, place);
            }
        }
    }

    // Note that a leg is over.
    void come(Label label, const RestedLeg& leg, Int setup) {
        label.time = leg.time() + setup;
        label.cum += label.time - left_;
        label.driver = leg.driver();
        there_->add(label);
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

    // Write the rests of the route whose work costs least, and of these that which ends first.
    bool write() {
        const Label* best = nullptr;
        std::pair<double, Int> least;
        for (const Label& label : *there_) {
            if (!may_still_work(type_, label.driver, label.time) || !may_end(type_, label.time)) {
                continue;
            }
            const Int departure = std::min(label.depart, label.time - label.cum);
            const Int working = label.time - counted_from(type_, departure);
            if (!may_work(type_, working)) continue;
            const Rate& rate = truck_.data.rate[truck_.k];
            const std::pair<double, Int> cost{
                work_cost(rate, paid_work(type_, label.time, working)), label.time};
            if (best == nullptr || cost < least) {
                best = &label;
                least = cost;
            }
        }
        if (best == nullptr) return false;
        for (Int index = 0; index < best->count; ++index) {
            const auto [p, number, place] = at(*best, index);
            Stop& stop = stops_[p];
            stop.rests = Rests(stop.rests).with(number, RestPlace{place}).packed();
            stop.gap += rest_duration(type_, number);
        }
        return true;
    }

    Truck truck_;
    const VehicleType& type_;
    View<Stop, 1> stops_;
    std::array<Labels, 2> labels_;  // where the truck is, and where it comes, in turn
    Labels* there_ = labels_.data();
    Int left_ = 0;   // when the leg began
    Int ahead_ = 0;  // how long all legs behind it are
};

// Let nobody rest on a route. In place.
void clear_rests(const VehicleType& type, View<Stop, 1> stops) {
    for (Stop& stop : stops) {
        stop.gap -= duration_of(type, Rests(stop.rests));
        stop.rests = 0;
    }
}

// Return how long a driver of a route without rests is at the wheel.
Int driving_on(const ProblemData& data, const VehicleType& type, View<const Stop, 1> stops) {
    Int driving = 0;
    for (Int p = 0; p < stops.size(); ++p) {
        if (stops[p].kind != end_stop) driving += driving_from(data, type, stops, p);
    }
    return driving;
}

// Write rests and times of a route that begins no sooner than `hold`. In place; false if a rule is
// broken.
bool rest_from(const ProblemData& data, Route& route, View<Stop, 1> stops, View<Sortie, 1> sorties,
               Int hold) {
    clear_rests(data.type[route.type], stops.first(route.length));
    stops[0].hold = hold;
    return Placing(data, route, stops).run() && drive_as_placed(data, route, stops, sorties);
}

}  // namespace

bool any_rest(const VehicleType& type, const Route& route) {
    return has_driving_rules(type) && route.driving == far;
}

bool drive_by_rules(const ProblemData& data, Route& route, View<Stop, 1> stops,
                    View<Sortie, 1> sorties) {
    const VehicleType& type = data.type[route.type];
    clear_rests(type, stops.first(route.length));
    if (!drive_as_placed(data, route, stops, sorties)) return false;
    const Int driving = driving_on(data, type, stops.first(route.length));
    const Int departure = first_departure(data, route, stops, sorties);
    route.driving = driving;
    if (needs_no_rest(type, driving, route.end - departure)) return true;
    route.driving = far;
    if (!rest_from(data, route, stops, sorties, stops[0].hold)) {
        // Whoever begins later hasn't worked for so long.
        return stops[0].hold == none && departure > stops[0].leave &&
               rest_from(data, route, stops, sorties, departure);
    }
    if (!limits_work(type) || stops[0].hold != none) return true;
    const Int later = first_departure(data, route, stops, sorties);
    const Int end = route.end, working = end - later;
    if (later <= stops[0].leave) return true;
    if (rest_from(data, route, stops, sorties, later) && route.end <= end &&
        route.end - first_departure(data, route, stops, sorties) < working) {
        return true;
    }
    return rest_from(data, route, stops, sorties, none);
}

bool may_have_to_rest(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node) {
    const Route& route = fleet.route[slot];
    const VehicleType& type = data.type[route.type];
    const View<const Stop, 1> stops = fleet.stop[slot];
    if (any_rest(type, route)) return true;
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Int longer = leg(legs, stops[p].node, node).duration +
                       leg(legs, node, stops[p + 1].node).duration - stops[p].gap;
    const Int more = std::max(Int{0}, longer);
    const Int served = data.place.by_truck(type)[node].service_duration();
    return !needs_no_rest(type, route.driving + more, route.working + more + served);
}

}  // namespace tandem
