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
    Int time = far;
    Int cum = 0;       // sum of all durations
    Int depart = far;  // the latest departure that costs nothing
    Driver driver{};
    Int count = 0;
    std::array<Taken, most_rests_on_route> taken{};
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
        first.time = std::max(type_.shift_earliest, std::max(stops_[0].release, stops_[0].hold));
        first.driver = driver_from(type_, first.time);
        labels_.add(first);
        const Int last = stops_.size() - 1;
        for (Int p = 0; p < last; ++p) {
            there_.clear();
            for (const Label& label : labels_) pass(label, p);
            labels_ = there_;
        }
        return write();
    }

private:
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
            there_.add(label);
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
        rest(label, p, leg, setup, RestPlace::arrival);
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
        there_.add(label);
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
        for (const Label& label : labels_) {
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
    Labels labels_;
    Labels there_;
    Int left_ = 0;  // when the leg began
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

}  // namespace

bool any_rest(const VehicleType& type, const Route& route, View<const Stop, 1> stops) {
    if (!has_driving_rules(type)) return false;
    const View<const Stop, 1> made = stops.first(route.length);
    return std::any_of(made.begin(), made.end(), [](const Stop& stop) { return stop.rests != 0; });
}

bool drive_by_rules(const ProblemData& data, Route& route, View<Stop, 1> stops,
                    View<Sortie, 1> sorties) {
    const VehicleType& type = data.type[route.type];
    clear_rests(type, stops.first(route.length));
    if (!drive_as_placed(data, route, stops, sorties)) return false;
    const Int driving = driving_on(data, type, stops.first(route.length));
    if (!may_drive_in_a_day(type, driving)) return false;
    const Int departure = first_departure(data, route, stops, sorties);
    if (needs_no_rest(type, driving, route.end - departure)) return true;
    if (Placing(data, route, stops).run()) {
        return drive_as_placed(data, route, stops, sorties);
    }
    if (stops[0].hold != none || departure <= stops[0].leave) return false;
    // Whoever begins later hasn't worked for so long.
    stops[0].hold = departure;
    return Placing(data, route, stops).run() && drive_as_placed(data, route, stops, sorties);
}

bool may_have_to_rest(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node) {
    const Route& route = fleet.route[slot];
    const VehicleType& type = data.type[route.type];
    const View<const Stop, 1> stops = fleet.stop[slot].first(route.length);
    if (any_rest(type, route, stops)) return true;
    const TravelLegs legs = legs_of(data.leg, type.travel);
    const Int longer = leg(legs, stops[p].node, node).duration +
                       leg(legs, node, stops[p + 1].node).duration - stops[p].gap;
    const Int more = std::max(Int{0}, longer);
    const Int served = data.place.by_truck(type)[node].service_duration();
    return !may_drive_in_a_day(type, driving_on(data, type, stops) + more) ||
           !needs_no_rest(type, driving_on(data, type, stops) + more,
                          route.working + more + served);
}

}  // namespace tandem
