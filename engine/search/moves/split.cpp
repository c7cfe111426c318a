#include "search/moves/split.h"

#include <utility>

#include "randomness.h"
#include "search/moves/operations.h"

namespace tandem {
namespace {

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

// Return what it costs to go from place `i` to `j` while the drone serves place `flown`; infinite
// if that can't be.
double cost_across(const ProblemData& data, Int k, View<const Line, 1> line, Int i, Int j,
                   Int flown) {
    const Line &from = line[i], &spared = line[flown], &to = line[j];
    const Drive drive{to.drive - from.drive - spared.spared_drive,
                      to.distance - from.distance - spared.spared_distance, j - i - 1};
    return cost_across(data, k, from.node, spared.node, to.node, drive);
}

}  // namespace

void shift(View<Line, 1> line, Int one, Int to) {
    const Int node = line[one].node;
    const Int step = to > one ? 1 : -1;
    for (Int place = one; place != to; place += step) line[place].node = line[place + step].node;
    line[to].node = node;
}

Places shuffle(const ProblemData& data, View<Line, 1> line, Int length,
               View<std::uint64_t, 1> rng) {
    const Int count = length - 2;
    const Change change = changes[std::size_t(below(rng, Int(changes.size())))];
    const Int one = 1 + below(rng, count);
    const Int other = place_near(data, line, count, one, rng);
    if (change == Change::keep || other == one) return {1, 0};
    if (change == Change::move) {
        shift(line, one, other);
        return {std::min(one, other), std::max(one, other)};
    }
    // Either way the neighbour comes beside place `one`, or the other way round.
    const Places changed = other > one ? Places{one + 1, other} : Places{other, one - 1};
    Int low = changed.first, high = changed.last;
    if (change == Change::swap) {
        std::swap(line[low].node, line[high].node);
        return changed;
    }
    for (; low < high; ++low, --high) std::swap(line[low].node, line[high].node);
    return changed;
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

double present_cost(const ProblemData& data, Int k, View<const Line, 1> line, Int length) {
    const Rate& rate = data.rate[k];
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    const NodeTable places = data.place.by_truck(data.type[k]);
    double cost = 0.0;
    for (Int j = length - 1; j > 0; j = line[j].before) {
        const Int i = line[j].before;
        if (line[j].flight != no_flight) {
            cost += cost_across(data, k, line, i, j, line[j].flight);
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
