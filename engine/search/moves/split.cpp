#include "search/moves/split.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "randomness.h"
#include "rules/flight.h"
#include "rules/leg.h"
#include "rules/shift.h"
#include "rules/window.h"

namespace tandem {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

constexpr Int longest_operation = 12;  // stops from its beginning to its end at most

// How often a place is brought beside a near neighbour, not just anywhere.
constexpr double neighbourly_share = 0.8;

// Changes of the order.
enum class Change { swap, move, reverse, keep };

// Those that pay come more often.
constexpr std::array changes{Change::swap, Change::swap,    Change::move,    Change::move,
                             Change::move, Change::reverse, Change::reverse, Change::keep};

// Return a random place in the line, most often that of a near neighbour of place `one`.
Int place_near(const ProblemData& data, View<const Line, 1> line, Int count, Int one,
               View<std::uint64_t, 1> rng) {
    if (uniform(rng) < neighbourly_share) {
        const View<const std::int32_t, 1> near = data.near[line[one].node];
        const Int wanted = near[below(rng, std::min(near_places, near.size()))];
        for (Int place = 1; place <= count; ++place) {
            if (line[place].node == wanted) return place;
        }
    }
    return 1 + below(rng, count);
}

// A flight to a customer and back to the truck, and how far that is.
struct WayByAir {
    Flight flight;
    Int distance;
};

WayByAir way_by_air(const ProblemData& data, const VehicleType& type, Windows place, Int from,
                    Int customer, Int to) {
    const Leg out = leg(legs_of(data.leg, type.drone_travel), from, customer);
    const Leg home = leg(legs_of(data.leg, type.home_travel), customer, to);
    return {{type, place, out.duration, home.duration}, out.distance + home.distance};
}

// Operations from place `i` of a line on which the drone of a vehicle serves one of the customers
// between while the truck serves the others.
class Crossing {
public:
    Crossing(const ProblemData& data, Int k, View<const Line, 1> line, Int i)
        : data_(data),
          type_(data.type[k]),
          rate_(data.rate[k]),
          places_(data.place.by_air(type_)),
          line_(line),
          i_(i),
          handled_(handling_duration(type_)) {
        const Int here = data.place.by_truck(type_)[line[i].node].service_duration();
        launched_ = std::max(Int{0}, here - launch_duration(type_, 1)) - here;
    }

    // Return what it costs to go to place `j` while the drone serves place `flown`.
    //
    // Infinite if that can't be, or if what the truck does alone costs `most` or more.
    double cost(Int j, Int flown, double most) const {
        const Line& spared = line_[flown];
        const Int drive = driven(j, spared.spared_drive);
        const double alone = ground(j, spared.spared_distance);
        if (usual_work_cost(rate_, handled_ + drive) + alone >= most) return infinite;
        const auto [flight, distance] = way_by_air(data_, type_, places_[spared.node],
                                                   line_[i_].node, spared.node, line_[j].node);
        const Int back = flight.duration();
        const Int airborne = std::max(back, drive);
        if (!within_endurance(type_, 0, back, airborne) || !flight.can_wait(airborne - back)) {
            return infinite;
        }
        return usual_work_cost(rate_, handled_ + airborne) + alone +
               airborne_cost(rate_, airborne) + flown_cost(rate_, distance);
    }

private:
    Int driven(Int j, Int spared) const {
        return line_[j].drive - line_[i_].drive - spared + launched_;
    }

    double ground(Int j, Int spared) const {
        return drive_cost(rate_, line_[j].distance - line_[i_].distance - spared) +
               stops_cost(rate_, j - i_ - 1);
    }

    const ProblemData& data_;
    const VehicleType& type_;
    Rate rate_;
    NodeTable places_;
    View<const Line, 1> line_;
    Int i_;
    Int handled_;
    Int launched_;  // how much longer the truck is there than the launch takes, less the service
};

// Return what a flight costs for which the truck waits at a stop.
double loop_cost(const ProblemData& data, Int k, Int node, Int customer) {
    const VehicleType& type = data.type[k];
    const Rate& rate = data.rate[k];
    const auto [flight, distance] =
        way_by_air(data, type, data.place.by_air(type)[customer], node, customer, node);
    if (!data.strategy.loops || !flight.can_serve()) return infinite;
    const Int duration = flight.duration();
    return usual_work_cost(rate, duration + handling_duration(type)) +
           airborne_cost(rate, duration) + flown_cost(rate, distance);
}

// Return what it costs to come so far, be served and drive to the next stop.
double driven_on(const Rate& rate, double before, const Leg& way, Int service) {
    return before + usual_work_cost(rate, way.duration + service) + drive_cost(rate, way.distance) +
           rate.stop;
}

// Places of a line whose customers a drone may serve, from one on to where operations end.
struct Flyable {
    std::array<Int, longest_operation> place;
    Int count = 0;
};

// Try all operations from place `i` to `j` with one flight across. In place.
void cross(View<const bool, 1> drives, const Crossing& crossing, const Flyable& flyable,
           View<Line, 1> line, View<double, 1> cost, Int i, Int j) {
    const Int grounded = line[j - 1].grounded - line[i].grounded;
    if (grounded > 1) return;
    for (Int index = 0; index < flyable.count; ++index) {
        const Int flown = flyable.place[static_cast<std::size_t>(index)];
        if (grounded == 1 && drives[line[flown].node]) continue;
        const double total = cost[i] + crossing.cost(j, flown, cost[j] - cost[i]);
        if (total < cost[j]) {
            cost[j] = total;
            line[j].before = i;
            line[j].flight = flown;
        }
    }
}

// Try all operations that begin at place `i`. In place.
void extend(const ProblemData& data, Int k, View<Line, 1> line, View<double, 1> cost, Int length,
            Int i) {
    const Rate& rate = data.rate[k];
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    const View<const bool, 1> drives = data.can[k][0], flies = data.can[k][1];
    const Int here = line[i].node;
    const Int service = data.place.by_truck(data.type[k])[here].service_duration();
    const Crossing crossing(data, k, line, i);
    Flyable flyable;
    double loops = 0.0;
    for (Int j = i + 1; j < std::min(length, i + longest_operation + 1); ++j) {
        const Int to = line[j].node;
        if (j == length - 1 || drives[to]) {
            const double total = driven_on(rate, cost[i] + loops, leg(legs, here, to), service);
            if (total < cost[j]) {
                cost[j] = total;
                line[j].before = i;
                line[j].flight = no_flight;
            }
            if (data.strategy.crossings) cross(drives, crossing, flyable, line, cost, i, j);
        }
        if (flies[to]) flyable.place[static_cast<std::size_t>(flyable.count++)] = j;
        if (loops < infinite) {
            loops = flies[to] ? loops + loop_cost(data, k, here, to) : infinite;
        }
    }
}

}  // namespace

void shift(View<Line, 1> line, Int one, Int to) {
    const Int node = line[one].node;
    const Int step = to > one ? 1 : -1;
    for (Int place = one; place != to; place += step) line[place].node = line[place + step].node;
    line[to].node = node;
}

void shuffle(const ProblemData& data, View<Line, 1> line, Int length, View<std::uint64_t, 1> rng) {
    const Int count = length - 2;
    const Change change =
        changes[static_cast<std::size_t>(below(rng, static_cast<Int>(changes.size())))];
    const Int one = 1 + below(rng, count);
    const Int other = place_near(data, line, count, one, rng);
    if (change == Change::keep || other == one) return;
    if (change == Change::move) {
        shift(line, one, other);
        return;
    }
    // Either way the neighbour comes beside place `one`, or the other way round.
    Int low = other > one ? one + 1 : other;
    Int high = other > one ? other : one - 1;
    if (change == Change::swap) {
        std::swap(line[low].node, line[high].node);
        return;
    }
    for (; low < high; ++low, --high) std::swap(line[low].node, line[high].node);
}

void measure(const ProblemData& data, Int k, View<Line, 1> line, Int length) {
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    const NodeTable places = data.place.by_truck(data.type[k]);
    line[0].drive = line[0].distance = line[0].grounded = 0;
    for (Int j = 1; j < length; ++j) {
        const Line& last = line[j - 1];
        Line& next = line[j];
        const Leg way = leg(legs, last.node, next.node);
        next.drive = last.drive + places[last.node].service_duration() + way.duration;
        next.distance = last.distance + way.distance;
        next.grounded = last.grounded;
        if (j < length - 1 && !data.can(k, 0, next.node)) ++next.grounded;
    }
    for (Int j = 1; j < length - 1; ++j) {
        const Line& last = line[j - 1];
        const Line& next = line[j + 1];
        const Leg direct = leg(legs, last.node, next.node);
        line[j].spared_drive =
            next.drive - last.drive - direct.duration - places[last.node].service_duration();
        line[j].spared_distance = next.distance - last.distance - direct.distance;
    }
}

bool split(const ProblemData& data, Int k, View<Line, 1> line, View<double, 1> cost, Int length) {
    std::fill_n(cost.begin(), length, infinite);
    cost[0] = 0.0;
    for (Int i = 0; i < length - 1; ++i) {
        if (cost[i] < infinite) extend(data, k, line, cost, length, i);
    }
    return cost[length - 1] < infinite;
}

double present_cost(const ProblemData& data, Int k, View<const Line, 1> line, Int length) {
    const Rate& rate = data.rate[k];
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    const NodeTable places = data.place.by_truck(data.type[k]);
    double cost = 0.0;
    for (Int j = length - 1; j > 0; j = line[j].before) {
        const Int i = line[j].before;
        if (line[j].flight != no_flight) {
            cost += Crossing(data, k, line, i).cost(j, line[j].flight, infinite);
            continue;
        }
        const Int here = line[i].node;
        const Leg way = leg(legs, here, line[j].node);
        cost += usual_work_cost(rate, way.duration + places[here].service_duration()) +
                drive_cost(rate, way.distance);
        cost += rate.stop;
        for (Int place = i + 1; place < j; ++place) {
            cost += loop_cost(data, k, here, line[place].node);
        }
    }
    return cost;
}

}  // namespace tandem
