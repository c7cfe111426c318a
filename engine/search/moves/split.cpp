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
double cost_across(const OperationData& by, View<const Line, 1> line, Int i, Int j, Int flown) {
    const Line &from = line[i], &spared = line[flown], &to = line[j];
    const Drive drive{to.drive - from.drive - spared.spared_drive,
                      to.distance - from.distance - spared.spared_distance, j - i - 1};
    return cost_across(by, from.node, spared.node, to.node, drive);
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
    const OperationData by(data, k);
    const Rate& rate = *by.rate;
    double cost = 0.0;
    for (Int j = length - 1; j > 0; j = line[j].before) {
        const Int i = line[j].before;
        if (line[j].flight != no_flight) {
            cost += cost_across(by, line, i, j, line[j].flight);
            continue;
        }
        const Int here = line[i].node;
        const Leg way = leg(by.drive, here, line[j].node);
        cost += usual_work_cost(rate, way.duration + by.by_truck[here].service_duration()) +
                drive_cost(rate, way.distance);
        cost += rate.stop;
        for (Int place = i + 1; place < j; ++place) {
            cost += loop_cost(by, here, line[place].node);
        }
    }
    return cost;
}

namespace {

using Some = Vector<double, at_once>;

constexpr std::array<double, at_once> ascending{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};

// Return the numbers of a row from a place on.
Some some(const double* row, Int place) {
    Some numbers;
    load(row + place, numbers);
    return numbers;
}

// An operation that ends at a place, and what all up to there costs.
struct EndedOperation {
    double cost;
    Int before, flight;

    // Of those that cost the same, that which begins first is taken, then that which flies least
    // far along the line.
    bool is_better(const EndedOperation& other) const {
        if (cost != other.cost) return cost < other.cost;
        return before != other.before ? before < other.before : flight < other.flight;
    }
};

// Finds the best operation up to each place of a line, one place after another.
class Splitting {
public:
    Splitting(const ProblemData& data, Int k, View<Line, 1> line, Int length, SplitScratch& scratch)
        : data_(data), by_(data, k), line_(line), length_(length), scratch_(scratch), k_(k) {}

    // Let operations begin where the line does.
    void begin() { begin_at(0, 0.0); }

    // Let operations that end at place `first` or behind begin where those of another split do.
    void begin_behind(const SplitScratch& before, Int first) {
        for (Int place = std::max(Int{0}, first - longest_operation); place < first; ++place) {
            scratch_.cost[place] = before.cost[place];
            scratch_.drive[place] = before.drive[place];
            scratch_.distance[place] = before.distance[place];
            scratch_.loops[place] = 0.0;
            scratch_.looped_until[place] = place + 1;
            scratch_.out[place] = before.out[place];
        }
    }

    void end_at(Int j) {
        EndedOperation best{infinite_cost, 0, no_flight};
        if (j == length_ - 1 || drives_[line_[j].node]) {
            drive_to(j, best);
            if (data_.strategy.crossings && !waits_for_drones(type_) &&
                is_launch_place(data_.no_launch, line_[j].node)) {
                cross_to(j, best);
            }
        }
        line_[j].before = best.before;
        line_[j].flight = best.flight;
        begin_at(j, best.cost);
    }

private:
    static std::size_t at(Int place) { return std::size_t(place); }

    // Let operations begin at a place, up to where all costs so much, and fly there.
    void begin_at(Int place, double cost) {
        const Line& here = line_[place];
        const Int stays = stay_beside_launch(type_, by_.by_truck[here.node].service_duration());
        scratch_.cost[place] = cost;
        scratch_.loops[place] = 0.0;
        scratch_.looped_until[place] = place + 1;
        scratch_.drive[place] = double(here.drive - stays);
        scratch_.distance[place] = double(here.distance);
        if (!data_.strategy.crossings || place == 0 || place == length_ - 1 || !flies_[here.node])
            return;
        const LegRow inward = legs_to(data_.back, type_.drone_travel, here.node);
        SplitScratch::WaysOut& out = scratch_.out[place];
        std::fill(out.duration.begin() + longest_operation - 1, out.duration.end(), infinite_cost);
        for (Int back = 1; back < std::min(longest_operation, place + 1); ++back) {
            const Int from = line_[place - back].node;
            Leg way = leg_from(inward, from);
            if (!is_launch_place(data_.no_launch, from)) way.duration = unreachable_leg;
            out.duration[at(longest_operation - 1 - back)] = double(way.duration);
            out.distance[at(longest_operation - 1 - back)] = double(way.distance);
        }
    }

    // Try all operations on which the truck drives to place `j` itself. In place.
    //
    // Those that begin nearest are tried first, which mostly rules out the others.
    void drive_to(Int j, EndedOperation& best) {
        for (Int i = j - 1; i >= std::max(Int{0}, j - longest_operation); --i) {
            const double before = loop(i, j, best.cost);
            if (!(before <= best.cost)) continue;
            const Int here = line_[i].node;
            const double cost = driven_on(rate_, before, leg(by_.drive, here, line_[j].node),
                                          by_.by_truck[here].service_duration());
            if (cost <= best.cost) best = {cost, i, no_flight};
        }
    }

    // Return what all costs up to place `i`, with flights to those up to `j` for which the truck
    // waits there; not all of them once it is more than `most`.
    double loop(Int i, Int j, double most) {
        double& loops = scratch_.loops[i];
        Int& until = scratch_.looped_until[i];
        for (; until < j && scratch_.cost[i] + loops <= most; ++until) {
            const Int customer = line_[until].node;
            loops += flies_[customer] ? loop_cost(by_, line_[i].node, customer) : infinite_cost;
        }
        return scratch_.cost[i] + loops;
    }

    // Try all operations on which the drone flies across to place `j`. In place.
    void cross_to(Int j, EndedOperation& best) {
        // From where on all between are served by the truck, and all but one.
        Int all = j, all_but_one = j;
        for (Int i = j - 2; i >= std::max(Int{0}, j - longest_operation); --i) {
            const Int grounded = line_[j - 1].grounded - line_[i].grounded;
            if (grounded > 1) break;
            all_but_one = i;
            if (grounded == 0) all = i;
        }
        for (Int flown = j - 1; flown > all_but_one; --flown) {
            const Int node = line_[flown].node;
            if (flies_[node]) fly_over(flown, drives_[node] ? all : all_but_one, j, best);
        }
    }

    // Try all operations from place `first` or behind on which the drone serves place `flown`,
    // and then flies to `j`. In place.
    void fly_over(Int flown, Int first, Int j, EndedOperation& best) {
        const Line &spared = line_[flown], &to = line_[j];
        const Leg home = leg_to(legs_from(data_.leg, type_.home_travel, spared.node), to.node);
        const Int back = by_.by_air[spared.node].service_duration() + home.duration;
        if (!can_last(type_, back)) return;
        const auto drive_until = double(to.drive - spared.spared_drive);
        const auto distance_until = double(to.distance - spared.spared_distance);
        const auto handled = double(handling_duration(type_));
        const SplitScratch::WaysOut& out = scratch_.out[flown];
        for (Int i = first; i < flown; i += at_once) {
            const Int way = i + longest_operation - 1 - flown;
            const Some flight = some(out.duration.data(), way) + double(back);
            const Some distance = some(out.distance.data(), way) + double(home.distance);
            const Some airborne = larger(flight, drive_until - some(&scratch_.drive[0], i));
            const Some stops = double(j - i - 1) - some(ascending.data(), 0);
            const Some alone = drive_cost(rate_, distance_until - some(&scratch_.distance[0], i)) +
                               stops_cost(rate_, stops);
            const Some cost = some(&scratch_.cost[0], i) +
                              crossing_cost(rate_, airborne + handled, airborne, distance, alone);
            const Some allowed = where_at_most(counted_until(type_, flight, airborne),
                                               double(endurance_of(type_)), cost, infinite_cost);
            if (least_of(allowed) <= best.cost) take_best(allowed, i, flown, j, best);
        }
    }

    // Take the best of operations that begin at place `first` and behind. In place.
    void take_best(const Some& allowed, Int first, Int flown, Int j, EndedOperation& best) const {
        std::array<double, at_once> cost;
        store(allowed, cost.data());
        while (true) {
            const auto least = std::min_element(cost.begin(), cost.end());
            const EndedOperation found{*least, first + (least - cost.begin()), flown};
            if (found.cost == infinite_cost || !found.is_better(best)) return;
            if (can_fly(found.before, flown, j)) {
                best = found;
                return;
            }
            *least = infinite_cost;
        }
    }

    // Tell whether the customer isn't too far away, and the drone's battery lasts until the truck
    // is there.
    bool can_fly(Int i, Int flown, Int j) const {
        const Int customer = line_[flown].node;
        if (!in_range(data_, type_, line_[i].node, customer) ||
            !in_range(data_, type_, line_[j].node, customer)) {
            return false;
        }
        if (!is_limited(type_)) return true;
        const Flight flight = way_by_air(by_, line_[i].node, customer, line_[j].node).flight;
        const Int drive = line_[j].drive - line_[flown].spared_drive - Int(scratch_.drive[i]);
        return flight.can_wait(std::max(Int{0}, drive - flight.duration()));
    }

    const ProblemData& data_;
    const OperationData by_;
    const View<Line, 1> line_;
    const Int length_;
    SplitScratch& scratch_;
    const Int k_;
    const VehicleType& type_ = data_.type[k_];
    const Rate rate_ = data_.rate[k_];
    const View<const bool, 1> drives_ = data_.can[k_][0];
    const View<const bool, 1> flies_ = data_.can[k_][1];
};

}  // namespace

double split(const ProblemData& data, Int k, View<Line, 1> line, Int length,
             SplitScratch& scratch) {
    Splitting splitting(data, k, line, length, scratch);
    splitting.begin();
    for (Int j = 1; j < length; ++j) splitting.end_at(j);
    return scratch.cost[length - 1];
}

double split_changed(const ProblemData& data, Int k, View<Line, 1> line, Int length,
                     const Changed& changed, SplitScratch& scratch) {
    Splitting splitting(data, k, line, length, scratch);
    const auto [first, last, more] = changed.places;
    splitting.begin_behind(changed.before, first);
    Int dearer = 0;
    for (Int j = first; j < length; ++j) {
        splitting.end_at(j);
        if (j <= last) continue;
        // All that comes costs as before from here on, wherever an operation begins.
        dearer = scratch.cost[j] - changed.before.cost[j - more] < changed.most ? 0 : dearer + 1;
        if (dearer == longest_operation) return infinite_cost;
    }
    return scratch.cost[length - 1];
}

}  // namespace tandem
