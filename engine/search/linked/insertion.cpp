#include <cmath>

#include "search/insertion/places.h"
#include "search/linked/aboard.h"
#include "search/linked/chain.h"
#include "search/linked/room.h"
#include "search/linked/turn.h"
#include "search/moves/recreate.h"

namespace tandem {

namespace {

// A route that serves a town far away passes customers to whom nobody on it is near: a stop on the
// way there from the depot, or back, costs next to nothing, and no neighbour shows it. So some
// routes are drawn: one of how many, and how many at most.
constexpr Int each_drawn = 4;
constexpr Int most_drawn = 16;

// Up to how many nodes all legs fit a processor's cache, so that they needn't be asked for.
constexpr Int most_at_hand = 400;

// Which route a customer joins, and how who would serve there meets him.
struct LinkedJoining : Joining {
    const Newcomer* newcomer;
};

// Two between whom a customer may come, or a depot, and how much longer that is.
struct Gap {
    Int before, behind, detour;
};

// Looks for the cheapest place for one customer.
class CheapestLink {
public:
    CheapestLink(const Insertion& insertion, const Linked& linked)
        : data_(insertion.data),
          searcher_(insertion.searcher),
          linked_(linked),
          newcomer_(newcomer_for(data_, data_.type[0], insertion.node)),
          enlarge_(insertion.enlarge),
          is_near_known_(linked.one_travel && are_same(newcomer_.inward, newcomer_.onward)),
          is_told_first_(linked.one_travel && newcomer_.inward.stated != nullptr),
          lists_first_(!is_told_first_ || data_.num_nodes > most_at_hand),
          has_windows_(linked.timed && data_.place.variants() == 1),
          room_(data_, insertion.node, enlarge_),
          best_(insertion.best) {
        set_longest_detour();
    }

    // Tries a customer beside neighbours.
    //
    // Most of the time goes into getting legs from memory, so that those of several neighbours are
    // asked for at once, and into branches that can't be foreseen, as which detours are too long
    // and where windows are missed, so that there are none where neighbours are passed over.
    void try_beside() {
        const Int size = num_listed();
        for (Int first = 0; first < size;) {
            // Beside the nearest there mostly is a place that rules out most of the others.
            const Int behind = std::min(first == 0 ? nearest_of_all : first + at_once, size);
            std::array<Neighbour, at_once> neighbours;
            std::size_t count = choose(first, behind, neighbours);
            if (lists_first_) count = ask_for_legs(neighbours, count);
            for (std::size_t index = 0; index < count; ++index) {
                if (may_be_best(neighbours[index])) try_neighbour(neighbours[index]);
            }
            first = behind;
        }
    }

    // Tries a customer first and last on routes drawn.
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
            LinkedJoining joins;
            if (may_be_best_at_ends(slots[index]) && may_join(slots[index], joins)) try_ends(joins);
        }
    }

    // Tries a customer on all routes with room.
    void try_everywhere() {
        for (const Int slot : searcher_.active.first(searcher_.count->active)) {
            if (data_.deadline.passed()) break;
            LinkedJoining joins;
            if (!may_join(slot, joins)) continue;
            try_ends(joins);
            const Run& run = linked_.run[slot];
            for (Int before = run.first; before != run.last;) {
                const Link& at = linked_.link[before];
                try_between(joins, between(joins, before, at.behind, at.onward));
                before = at.behind;
            }
        }
    }

private:
    // Who may be the neighbour of a customer, and how near they are.
    struct Neighbour {
        std::int32_t node, nearest;
    };

    static constexpr Int nearest_of_all = 8;
    static constexpr Int at_once = 32;

    // How many neighbours are listed.
    Int num_listed() const {
        Int size = data_.granular.shape(1);
        while (size > 0 && data_.granular(newcomer_.node, size - 1) < 0) --size;
        return size;
    }

    // The least that a detour beside a neighbour can be, as far as it is looked at there.
    //
    // By the triangle inequality, unless who comes before or behind a neighbour is nearer, beside
    // whom the same place is looked at, it is as long as the way there and back, less the longer of
    // the neighbour's legs.
    Int least_beside(const Neighbour& neighbour) const {
        return 2 * Int{neighbour.nearest} - linked_.reach[neighbour.node];
    }

    // Lists neighbours, of those by rank from `first` to `behind`, beside whom a detour may be
    // short enough; returns how many.
    std::size_t choose(Int first, Int behind, std::array<Neighbour, at_once>& chosen) const {
        const std::int32_t* const others = &data_.granular(newcomer_.node, 0);
        const std::int32_t* const near = &linked_.near(newcomer_.node, 0);
        const Int longest = longest_detour_;
        std::size_t count = 0;
        for (Int rank = first; rank < behind; ++rank) {
            chosen[count] = {others[rank], near[rank]};
            count += least_beside(chosen[count]) < longest;
        }
        return count;
    }

    // Asks for the legs to and from who is beside neighbours, but for those on full routes, who are
    // left out; returns how many remain.
    std::size_t ask_for_legs(std::array<Neighbour, at_once>& neighbours, std::size_t count) const {
        std::size_t left = 0;
        for (std::size_t index = 0; index < count; ++index) {
            const Neighbour neighbour = neighbours[index];
            neighbours[left] = neighbour;
            left += room_.may_be_on(linked_.run[linked_.link[neighbour.node].slot]);
        }
        for (std::size_t index = 0; index < left; ++index) {
            const Link& at = linked_.link[neighbours[index].node];
            prefetch(newcomer_.onward, at.behind);
            prefetch(newcomer_.inward, at.before);
        }
        return left;
    }

    // Whether a place beside a neighbour may be the best yet; true as well where legs don't tell.
    bool may_be_best(const Neighbour& neighbour) const {
        const Int node = neighbour.node, nearest = neighbour.nearest;
        const Link& at = linked_.link[node];
        const int may = int{lists_first_ || room_.may_be_on(linked_.run[at.slot])} &
                        int{least_beside(neighbour) < longest_detour_};
        if (!is_told_first_) return may != 0;
        const Int inward = is_near_known_ ? nearest : distance_from(newcomer_.inward, node);
        const Int onward = is_near_known_ ? nearest : distance_to(newcomer_.onward, node);
        const Int on = distance_to(newcomer_.onward, at.behind);
        const Int there = distance_from(newcomer_.inward, at.before);
        return (may & (may_come_between(node, at.behind, inward + on - at.onward) |
                       may_come_between(at.before, node, there + onward - at.inward))) != 0;
    }

    // The same of places first and last on a route.
    bool may_be_best_at_ends(Int slot) const {
        if (!is_told_first_) return true;
        const Run& run = linked_.run[slot];
        const VehicleType& type = data_.type[run.type];
        const Int begins =
            newcomer_.further(type.begins_at, run.first, linked_.link[run.first].inward);
        const Int ends = newcomer_.further(run.last, type.ends_at, linked_.link[run.last].onward);
        return (may_come_between(type.begins_at, run.first, begins) |
                may_come_between(run.last, type.ends_at, ends)) != 0;
    }

    // Whether a detour between two is short enough, and within what windows they and the customer
    // have; 0 or 1.
    int may_come_between(Int before, Int behind, Int detour) const {
        const int is_short = detour < longest_detour_;
        if (!has_windows_) return is_short;
        Front front = front_at(data_, linked_, before);
        const int is_served =
            front.serve(newcomer_.place, leg_from(newcomer_.inward, before).duration);
        front.drive(leg_to(newcomer_.onward, behind).duration);
        return is_short & is_served & int{rear_at(data_, linked_, behind).allows(front)};
    }

    void try_neighbour(const Neighbour& neighbour) {
        const Int node = neighbour.node, nearest = neighbour.nearest;
        const Link& at = linked_.link[node];
        LinkedJoining joins;
        if (!may_join(at.slot, joins)) return;
        Int inward = nearest, onward = nearest;
        if (!is_near_known_ || nearest == farthest) {
            inward = distance_from(joins.newcomer->inward, node);
            onward = distance_to(joins.newcomer->onward, node);
        }
        const Int on = distance_to(joins.newcomer->onward, at.behind);
        try_between(joins, {node, at.behind, inward + on - at.onward});
        const Int there = distance_from(joins.newcomer->inward, at.before);
        try_between(joins, {at.before, node, there + onward - at.inward});
    }

    // Two who are so far apart.
    static Gap between(const LinkedJoining& joins, Int before, Int behind, Int apart) {
        return {before, behind, joins.newcomer->further(before, behind, apart)};
    }

    // Writes a detour that, as all longer ones, costs no less than the best, whoever drives it.
    void set_longest_detour() {
        const CheapestVehicle& cheapest = linked_.cheapest;
        const double most = best_.cost - cheapest.stop;
        const bool is_any = cheapest.distance == 0.0 || most >= double(far) * cheapest.distance;
        longest_detour_ = is_any ? far : Int(std::ceil(most / cheapest.distance));
    }

    // Whether somebody may serve a customer more on a route, and who that is: a larger type if that
    // may be.
    bool may_join(Int slot, LinkedJoining& joins) {
        const Run& run = linked_.run[slot];
        if (room_.is_on(run) && has_stop_left(run) &&
            (!looks_aboard(linked_) || may_hold(slot, run.type))) {
            const Rate& rate = data_.rate[run.type];
            joins = {{newcomer_.node, slot, run.type, rate.distance, rate.stop},
                     newcomer_by(run.type)};
            return true;
        }
        return enlarge_ && may_join_enlarged(slot, joins);
    }

    bool has_stop_left(const Run& run) const {
        return allows_stops(data_.type[run.type], run.count + 1);
    }

    bool may_hold(Int slot, Int k) const {
        return may_hold_more(data_, linked_, slot, data_.type[k], newcomer_.node);
    }

    // The customer as vehicles of a type meet him; until that is asked again.
    const Newcomer* newcomer_by(Int k) {
        if (linked_.one_travel && data_.place.variants() == 1) return &newcomer_;
        return &other_.emplace(newcomer_for(data_, data_.type[k], newcomer_.node));
    }

    [[gnu::noinline]] bool may_join_enlarged(Int slot, LinkedJoining& joins) {
        const Run& run = linked_.run[slot];
        const Haul haul = haul_of(run);
        const auto fits = [&](Int k) { return !looks_aboard(linked_) || may_hold(slot, k); };
        const Int by = larger_type(data_, searcher_.now, run.type, haul, newcomer_.node, fits);
        if (by < 0) return false;
        const Rate& rate = data_.rate[by];
        const double more = route_cost(data_, by, haul) - route_cost(data_, run.type, haul);
        joins = {{newcomer_.node, slot, by, rate.distance, more + rate.stop}, newcomer_by(by)};
        return true;
    }

    // Whether a customer may come between two by what windows, and the shift, allow.
    bool keeps_windows(const LinkedJoining& joins, const Gap& gap) const {
        const VehicleType& type = data_.type[joins.type];
        return joins.newcomer->comes_between(gap.before, front_at(data_, linked_, type, gap.before),
                                             gap.behind, rear_at(data_, linked_, type, gap.behind));
    }

    // Tries a customer between two.
    void try_between(const LinkedJoining& joins, const Gap& gap) {
        const auto may_come = [&] {
            return (!linked_.timed || keeps_windows(joins, gap)) &&
                   (!looks_aboard(linked_) ||
                    has_room_between(data_, linked_, joins, gap.before, gap.behind));
        };
        if (best_.try_behind(joins, gap.before, gap.detour, may_come)) set_longest_detour();
    }

    // Tries a customer first and last on a route.
    void try_ends(const LinkedJoining& joins) {
        const Run& run = linked_.run[joins.slot];
        const VehicleType& type = data_.type[run.type];
        const Link& first = linked_.link[run.first];
        const Link& last = linked_.link[run.last];
        try_between(joins, between(joins, type.begins_at, run.first, first.inward));
        try_between(joins, between(joins, run.last, type.ends_at, last.onward));
    }

    const ProblemData& data_;
    const Searcher& searcher_;
    const Linked& linked_;
    const Newcomer newcomer_;  // as all vehicles, or those of the first type, meet him
    const bool enlarge_;
    const bool is_near_known_;  // `Linked::near` tells legs there and back
    const bool is_told_first_;  // most places are ruled out by stated legs, the same for all types
    const bool lists_first_;    // whose routes aren't full, as legs have to be got from far away
    const bool has_windows_;    // and by windows, the same likewise
    const RoomByType room_;
    Best& best_;
    Int longest_detour_ = far;
    // As vehicles of the type meet him that `newcomer_by` was asked for last, where they differ.
    std::optional<Newcomer> other_;
};

// Inserts a customer as a move says. False if no slot is free.
bool insert(const ProblemData& data, Searcher& searcher, Linked& linked, Int node,
            const Move& move) {
    Int slot = move.slot, before = move.first;
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

}  // namespace

Recreated recreate_linked(const ProblemData& data, Searcher& searcher, Linked& linked, Int first,
                          Spare spare, bool scan_all) {
    const View<Int, 1> absent = searcher.absent;
    const bool enlarge = data.strategy.swap_vehicles && uniform(searcher.rng) < enlarged;
    const bool opens_first = uniform(searcher.rng) < opening_share;
    double total = 0.0;
    Int left = first;
    for (Int index = first; index < searcher.count->absent; ++index) {
        const Int node = absent[index];
        if (data.deadline.passed()) {
            absent.at(left++) = node;
            continue;
        }
        const bool opens = opens_first && index == first;
        Best best{data.strategy.blink, searcher.rng};
        try_new_route(data, searcher, node, best);
        CheapestLink places({data, searcher, node, enlarge, best}, linked);
        if (!opens && !scan_all) {
            places.try_beside();
            places.try_passing();
        }
        if ((!opens && scan_all) || best.cost == infeasible) places.try_everywhere();
        const double left_out = data.unassigned_cost + data.unassigned_more[node];
        const bool wanted = best.cost < left_out || opens;
        const bool is_absent =
            best.cost == infeasible || !wanted || !insert(data, searcher, linked, node, best.move);
        if (is_absent) {
            absent.at(left++) = node;
        } else {
            total += best.cost;
        }
        if (!spare.spend(std::min(best.cost, left_out), is_absent && data.must_serve[node])) {
            searcher.count->absent = left;
            return {false, total};
        }
    }
    searcher.count->absent = left;
    return {true, total};
}

}  // namespace tandem
