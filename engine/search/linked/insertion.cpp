#include "search/linked/insertion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "randomness.h"
#include "rules/leg.h"
#include "rules/load.h"
#include "rules/window.h"
#include "search/insertion/evaluate.h"
#include "search/insertion/passing.h"
#include "search/insertion/places.h"
#include "search/linked/aboard.h"
#include "search/linked/chain.h"
#include "search/linked/retype.h"
#include "search/moves/recreate.h"
#include "search/route/edit.h"
#include "search/route/state.h"
#include "search/scratch.h"

namespace tandem {

namespace {

// From which distance on `Linked::near` doesn't tell.
constexpr Int farthest = std::numeric_limits<std::int32_t>::max();

// The legs of a travel to a customer, and from there.
struct Ways {
    LegRow inward;
    LegRow onward;
};

Ways ways_beside(const ProblemData& data, Int m, Int node) {
    return {legs_to(data.back, m, node), legs_from(data.leg, m, node)};
}

// A customer to be inserted, how all vehicles, or those of the first type, drive there and on, and
// whether a route may be given a larger type for him.
struct Newcomer {
    Int node;
    Ways ways;
    bool enlarge;
    bool same_back;  // `Linked::near` tells legs there and back
};

Newcomer newcomer_at(const ProblemData& data, const Linked& linked, Int node, bool enlarge) {
    const Ways ways = ways_beside(data, data.type[0].travel, node);
    return {node, ways, enlarge, linked.one_travel && are_same(ways.inward, ways.onward)};
}

// What routes may carry at most, by type, so that they may serve a customer more; less than nothing
// if none of the type may.
class Room {
public:
    // `enlarge` tells that a route may be given a larger type.
    Room(const ProblemData& data, Int node, bool enlarge) : data_(data), node_(node) {
        if (enlarge || data.num_types > most_known) {
            same_for_all_ = most_known;
        } else if (data.num_types == 1) {
            same_for_all_ = 0;
        }
        const Int count = std::min(data.num_types, most_known);
        for (Int k = 0; k < count; ++k) most_[std::size_t(k)] = most(k);
        most_[most_known] = {far, far, far};
    }

    // Whether the vehicle of a route may serve the customer more, and holds what that takes.
    bool is_on(const Run& run) const {
        const Amount load = amount_of(run.load);
        return within(load, run.type < most_known ? most_[std::size_t(run.type)] : most(run.type));
    }

    // The same without branches; true as well where another type might.
    bool may_be_on(const Run& run) const {
        // A run's type isn't waited for where there is but one.
        const Amount& most = most_[std::size_t(same_for_all_ < 0 ? run.type : same_for_all_)];
        const Int fits[] = {run.load[0] <= most[0], run.load[1] <= most[1], run.load[2] <= most[2]};
        return fits[0] + fits[1] + fits[2] == 3;
    }

private:
    static constexpr Int most_known = 8;

    Amount most(Int k) const {
        if (!data_.can(k, 0, node_)) return {-1, -1, -1};
        return minus(capacity_of(data_.type[k]), demand_of(data_.place[0][node_]));
    }

    const ProblemData& data_;
    const Int node_;
    Int same_for_all_ = nowhere;  // what is the most for all types, by number
    std::array<Amount, most_known + 1> most_;
};

// Which route a customer joins, by which type and which legs, what driving costs that, and what all
// costs but for the detour.
struct Joining {
    Int slot;
    Int type;
    const Ways* ways;
    double rate;
    double cost;
};

// Two between whom a customer may come, or a depot, and how much longer that is.
struct Gap {
    Int before;
    Int behind;
    Int detour;
};

// Looks for the cheapest place for one customer, and writes it to `searcher.scratch->move`.
class Places {
public:
    Places(const ProblemData& data, Searcher& searcher, const Linked& linked,
           const Newcomer& newcomer, double best)
        : data_(data),
          searcher_(searcher),
          linked_(linked),
          newcomer_(newcomer),
          room_(data, newcomer.node, newcomer.enlarge),
          best_(best) {
        set_longest_detour();
    }

    double best() const { return best_; }

    // Tries a customer beside neighbours.
    //
    // Most of the time goes into getting legs from memory, so that those of several neighbours are
    // asked for at once, and into branches that can't be foreseen, so that there are none where
    // neighbours are passed over.
    void try_beside() {
        const Int size = num_listed();
        for (Int first = 0; first < size;) {
            // Beside the nearest there mostly is a place that rules out most of the others.
            const Int behind = std::min(first == 0 ? nearest_of_all : first + at_once, size);
            std::array<Neighbour, at_once> neighbours;
            const std::size_t count = choose(first, behind, neighbours);
            for (std::size_t index = 0; index < count; ++index) {
                const Link& at = linked_.link[neighbours[index].node];
                prefetch(newcomer_.ways.onward, at.behind);
                prefetch(newcomer_.ways.inward, at.before);
            }
            for (std::size_t index = 0; index < count; ++index) try_neighbour(neighbours[index]);
            first = behind;
        }
    }

    // Tries a customer first and last on routes drawn, as `insertion/passing` says.
    void try_passing() {
        const Int number = searcher_.count->active;
        if (number == 0) return;
        const Int begin = below(searcher_.rng, number);
        const Int drawn = std::min(most_drawn, number / each_drawn);
        std::array<Int, most_drawn> slots;
        std::size_t count = 0;
        for (Int index = begin; index < begin + drawn; ++index) {
            const Int slot = searcher_.active[index < number ? index : index - number];
            slots[count] = slot;
            count += room_.may_be_on(linked_.run[slot]);
        }
        for (std::size_t index = 0; index < count; ++index) {
            Joining joins;
            if (may_join(slots[index], joins)) try_ends(joins);
        }
    }

    // Tries a customer on all routes with room.
    void try_everywhere() {
        for (const Int slot : searcher_.active.first(searcher_.count->active)) {
            if (data_.deadline.passed()) break;
            Joining joins;
            if (!may_join(slot, joins)) continue;
            try_ends(joins);
            const Run& run = linked_.run[slot];
            for (Int before = run.first; before != run.last;) {
                const Link& at = linked_.link[before];
                try_between(joins, between(*joins.ways, before, at.behind, at.onward));
                before = at.behind;
            }
        }
    }

private:
    // Who may be the neighbour of a customer, and how near they are.
    struct Neighbour {
        std::int32_t node;
        std::int32_t nearest;
    };

    static constexpr Int nearest_of_all = 8;
    static constexpr Int at_once = 32;

    // How many neighbours are listed.
    Int num_listed() const {
        Int size = data_.fit.shape(1);
        while (size > 0 && data_.fit(newcomer_.node, size - 1) < 0) --size;
        return size;
    }

    // Whether a place beside a neighbour may be the best yet.
    //
    // Most may not by the triangle inequality: unless who comes before or behind a neighbour is
    // nearer, beside whom the same place is looked at, it costs as much as the way there and back,
    // less the longer of the neighbour's legs.
    bool may_be_beside(Int node, Int nearest) const {
        return 2 * nearest - linked_.reach[node] < longest_detour_;
    }

    // Lists neighbours, of those by rank from `first` to `behind`, whose places may be the best
    // yet, and whose routes may be joined; returns how many.
    std::size_t choose(Int first, Int behind, std::array<Neighbour, at_once>& chosen) const {
        const std::int32_t* const others = &data_.fit(newcomer_.node, 0);
        const std::int32_t* const near = &linked_.near(newcomer_.node, 0);
        const Link* const link = linked_.link.data();
        const Int* const reach = linked_.reach.data();
        const Int longest = longest_detour_;
        std::size_t count = 0;
        for (Int rank = first; rank < behind; ++rank) {
            chosen[count] = {others[rank], near[rank]};
            count += 2 * Int{near[rank]} - reach[others[rank]] < longest;
        }
        std::size_t left = 0;
        for (std::size_t index = 0; index < count; ++index) {
            const Neighbour neighbour = chosen[index];
            chosen[left] = neighbour;
            left += room_.may_be_on(linked_.run[link[neighbour.node].slot]);
        }
        return left;
    }

    void try_neighbour(const Neighbour& neighbour) {
        const Int node = neighbour.node;
        const Int nearest = neighbour.nearest;
        const Link& at = linked_.link[node];
        Joining joins;
        if (!may_be_beside(node, nearest) || !may_join(at.slot, joins)) return;
        Int inward = nearest;
        Int onward = nearest;
        if (!newcomer_.same_back || nearest == farthest) {
            inward = distance_from(joins.ways->inward, node);
            onward = distance_to(joins.ways->onward, node);
        }
        const Int on = distance_to(joins.ways->onward, at.behind);
        try_between(joins, {node, at.behind, inward + on - at.onward});
        const Int there = distance_from(joins.ways->inward, at.before);
        try_between(joins, {at.before, node, there + onward - at.inward});
    }

    // Two who are so far apart.
    static Gap between(const Ways& ways, Int before, Int behind, Int distance) {
        return {before, behind,
                distance_from(ways.inward, before) + distance_to(ways.onward, behind) - distance};
    }

    // Writes a detour that, as all longer ones, costs no less than the best, whoever drives it.
    void set_longest_detour() {
        const Least& cheapest = *linked_.cheapest;
        const double most = best_ - cheapest.stop;
        const bool is_any = cheapest.distance == 0.0 || most >= double(far) * cheapest.distance;
        longest_detour_ = is_any ? far : Int(std::ceil(most / cheapest.distance));
    }

    // Whether somebody may serve a customer more on a route, and who that is: a larger type if that
    // may be.
    bool may_join(Int slot, Joining& joins) {
        const Run& run = linked_.run[slot];
        if (room_.is_on(run) && has_stop_left(run) &&
            (!looks_aboard(linked_) || may_hold(slot, run.type))) {
            const Rate& rate = data_.rate[run.type];
            joins = {slot, run.type, ways_by(run.type), rate.distance, rate.stop};
            return true;
        }
        return newcomer_.enlarge && may_join_enlarged(slot, joins);
    }

    bool has_stop_left(const Run& run) const {
        return allows_stops(data_.type[run.type], run.count + 1);
    }

    bool may_hold(Int slot, Int k) const {
        return may_hold_more(data_, linked_, slot, data_.type[k], newcomer_.node);
    }

    // How vehicles of a type drive to the customer and on; until that is asked again.
    const Ways* ways_by(Int k) {
        if (linked_.one_travel) return &newcomer_.ways;
        ways_ = ways_beside(data_, data_.type[k].travel, newcomer_.node);
        return &ways_;
    }

    [[gnu::noinline]] bool may_join_enlarged(Int slot, Joining& joins) {
        const Run& run = linked_.run[slot];
        const Haul haul = haul_of(run);
        const auto fits = [&](Int k) { return !looks_aboard(linked_) || may_hold(slot, k); };
        const Int by = larger_type(data_, searcher_.now, run.type, haul, newcomer_.node, fits);
        if (by < 0) return false;
        const Rate& rate = data_.rate[by];
        const double more = route_cost(data_, by, haul) - route_cost(data_, run.type, haul);
        joins = {slot, by, ways_by(by), rate.distance, more + rate.stop};
        return true;
    }

    // Whether a customer may come between two by what windows, and the shift, allow.
    bool keeps_windows(const Joining& joins, const Gap& gap) const {
        const VehicleType& type = data_.type[joins.type];
        const Int arrival = leaves_at(data_, linked_, type, gap.before) +
                            leg_from(joins.ways->inward, gap.before).duration;
        const Windows place = data_.place.by_truck(type)[newcomer_.node];
        if (place.too_late(arrival)) return false;
        return place.end_of_service(arrival) + leg_to(joins.ways->onward, gap.behind).duration <=
               due_at(data_, linked_, type, gap.behind);
    }

    // Tries a customer between two.
    void try_between(const Joining& joins, const Gap& gap) {
        const double cost = double(gap.detour) * joins.rate + joins.cost;
        if (cost < best_) take(joins, gap, cost);
    }

    // Takes a place between two for the best if it may be there and isn't overlooked.
    void take(const Joining& joins, const Gap& gap, double cost) {
        if (linked_.timed && !keeps_windows(joins, gap)) return;
        if (looks_aboard(linked_) &&
            !has_room_between(data_, linked_, joins.slot, data_.type[joins.type], gap.before,
                              gap.behind, newcomer_.node)) {
            return;
        }
        if (uniform(searcher_.rng) < data_.strategy.blink) return;
        Move& move = searcher_.scratch->move;
        move.kind = at_stop;
        move.slot = joins.slot;
        move.first = gap.before;
        move.type = joins.type;
        best_ = cost;
        set_longest_detour();
    }

    // Tries a customer first and last on a route.
    void try_ends(const Joining& joins) {
        const Run& run = linked_.run[joins.slot];
        const VehicleType& type = data_.type[run.type];
        const Link& first = linked_.link[run.first];
        const Link& last = linked_.link[run.last];
        try_between(joins, between(*joins.ways, type.begins_at, run.first, first.inward));
        try_between(joins, between(*joins.ways, run.last, type.ends_at, last.onward));
    }

    const ProblemData& data_;
    Searcher& searcher_;
    const Linked& linked_;
    const Newcomer& newcomer_;
    const Room room_;
    double best_;
    Int longest_detour_ = far;
    Ways ways_;  // of whom `ways_by` was asked last, where they differ
};

// Inserts a customer where `searcher.scratch->move` says. False if no slot is free.
bool insert_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int node) {
    const Move& move = searcher.scratch->move;
    Int slot = move.slot;
    Int before = move.first;
    if (opens_route(move)) {
        slot = free_slot(data, searcher, move.type);
        if (slot < 0) return false;
        before = data.type[move.type].begins_at;
        open_run(data, searcher, linked, slot, move.type);
    } else if (move.type != linked.run[slot].type) {
        give_run(searcher, linked, slot, move.type);
    }
    tie_in(data, linked, slot, before, node);
    if (linked.timed) {
        drive_on(data, linked, slot, node, 2);
        look_back(data, linked, slot, node, 2);
    }
    return true;
}

// Finds the cheapest place for a customer, a route of his own alone if he has to open one; returns
// what it costs.
double find_linked(const ProblemData& data, Searcher& searcher, const Linked& linked,
                   const Newcomer& newcomer, bool opens) {
    Places places(data, searcher, linked, newcomer, try_new_route(data, searcher, newcomer.node));
    if (!opens) {
        places.try_beside();
        places.try_passing();
    }
    if (places.best() == infeasible) places.try_everywhere();
    return places.best();
}

}  // namespace

Recreated recreate_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int first,
                          double spare) {
    const View<Int, 1> absent = searcher.absent;
    const bool opening = uniform(searcher.rng) < opening_share;
    const bool enlarge = data.strategy.swap_vehicles && uniform(searcher.rng) < enlarged;
    double total = 0.0;
    Int left = first;
    for (Int index = first; index < searcher.count->absent; ++index) {
        const Int node = absent[index];
        if (data.deadline.passed()) return {false, total};
        const Newcomer newcomer = newcomer_at(data, linked, node, enlarge);
        const bool opens = opening && index == first;
        const double cost = find_linked(data, searcher, linked, newcomer, opens);
        const double left_out = data.unassigned_cost + data.unassigned_more[node];
        const bool wanted = cost < left_out || opens;
        if (cost != infeasible && wanted && insert_linked(data, searcher, linked, node)) {
            total += cost;
        } else {
            absent[left++] = node;
        }
        spare -= std::min(cost, left_out);
        if (spare < 0.0) return {false, total};
    }
    searcher.count->absent = left;
    return {true, total};
}

}  // namespace tandem
