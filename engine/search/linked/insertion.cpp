#include "search/linked/insertion.h"

#include <algorithm>
#include <cmath>

#include "rules/alarm.h"
#include "rules/leg.h"
#include "rules/load.h"
#include "rules/window.h"
#include "search/insertion/evaluate.h"
#include "search/insertion/passing.h"
#include "search/insertion/places.h"
#include "search/linked/chain.h"
#include "search/linked/retype.h"
#include "search/moves/recreate.h"
#include "search/route/edit.h"
#include "search/route/randomness.h"
#include "search/route/state.h"

namespace tandem {

namespace {

// A customer to be inserted, the legs there and from there, and whether a route may be given a
// larger type for him.
struct Newcomer {
    Int node;
    LegRow inward;
    LegRow onward;
    bool enlarge;
};

// Which route a customer joins, `nowhere` if it can't; by which type, and at what cost but for that
// of the detour.
struct Joining {
    Int slot;
    Int type;
    double cost;
};

// Two between whom a customer may come, or a depot, and how far they are apart.
struct Gap {
    Int before;
    Int behind;
    Int distance;
};

// Looks for the cheapest place for one customer, and writes it to `searcher.move`.
class Places {
public:
    Places(const World& world, Searcher& searcher, const Linked& linked, const Newcomer& newcomer,
           double best)
        : world_(world), searcher_(searcher), linked_(linked), newcomer_(newcomer), best_(best) {}

    double best() const { return best_; }

    // Tries a customer beside neighbours.
    //
    // Most are passed over by the triangle inequality: unless who comes before or behind a
    // neighbour is nearer, beside whom the same place is looked at, it costs as much as the way
    // there and back, less the longer of the neighbour's legs.
    void try_beside() {
        const auto others = world_.fit[newcomer_.node];
        const auto near = linked_.near[newcomer_.node];
        Int most = longest_detour();
        for (Int rank = 0; rank < others.size(); ++rank) {
            const Int other = others[rank];
            if (other < 0) break;
            const Link& at = linked_.link[other];
            if (at.slot < 0 || 2 * Int{near[rank]} - std::max(at.inward, at.onward) >= most) {
                continue;
            }
            const Joining joins = joining(at.slot);
            if (joins.slot < 0) continue;
            const double before = best_;
            try_between(joins, {other, at.behind, at.onward});
            try_between(joins, {at.before, other, at.inward});
            if (best_ < before) most = longest_detour();
        }
    }

    // Tries a customer first and last on routes drawn, as `insertion/passing` says.
    void try_passing() {
        const Int number = searcher_.count->active;
        if (number == 0) return;
        const Int begin = below(searcher_.rng, number);
        const Int end = begin + std::min(most_drawn, number / each_drawn);
        for (Int index = begin; index < end; ++index) {
            const Int slot = searcher_.active[index < number ? index : index - number];
            const Joining joins = joining(slot);
            if (joins.slot >= 0) try_ends(joins);
        }
    }

    // Tries a customer on all routes with room.
    void try_everywhere() {
        for (const Int slot : searcher_.active.first(searcher_.count->active)) {
            if (rung(world_.stop)) break;
            const Joining joins = joining(slot);
            if (joins.slot < 0) continue;
            try_ends(joins);
            const Run& run = linked_.run[slot];
            for (Int before = run.first; before != run.last;) {
                const Link& at = linked_.link[before];
                try_between(joins, {before, at.behind, at.onward});
                before = at.behind;
            }
        }
    }

private:
    // A detour, and all longer ones, that costs no less than the best, whoever drives it.
    Int longest_detour() const {
        const Least& cheapest = *linked_.cheapest;
        const double most = best_ - cheapest.stop;
        if (cheapest.distance == 0.0 || most >= double(far) * cheapest.distance) return far;
        return Int(std::ceil(most / cheapest.distance));
    }

    // Who would serve a customer more on a route: a larger type if that may be.
    Joining joining(Int slot) const {
        const Run& run = linked_.run[slot];
        const Int node = newcomer_.node;
        if (world_.can(run.type, 0, node) &&
            fits(world_.type[run.type], amount_of(run.load), world_.place[0][node])) {
            return {slot, run.type, world_.rate[run.type].stop};
        }
        if (newcomer_.enlarge) {
            const Int by = larger_for(world_, searcher_, run, node);
            if (by >= 0) {
                const double more =
                    cost_of_run(world_, by, run) - cost_of_run(world_, run.type, run);
                return {slot, by, more + world_.rate[by].stop};
            }
        }
        return {nowhere, nowhere, 0.0};
    }

    // Whether a customer may come between two by what windows, and the shift, allow.
    bool keeps_windows(const VehicleType& type, const Gap& gap) const {
        const NodeRows place = places_of(world_.place, type)[newcomer_.node];
        const Int arrival = leaves_at(world_, linked_, type, gap.before) +
                            leg_from(newcomer_.inward, gap.before).duration;
        if (too_late(place, arrival)) return false;
        return end_of_service(place, arrival) + leg_to(newcomer_.onward, gap.behind).duration <=
               due_at(world_, linked_, type, gap.behind);
    }

    // Tries a customer between two.
    void try_between(const Joining& joins, const Gap& gap) {
        const Int detour = distance_from(newcomer_.inward, gap.before) +
                           distance_to(newcomer_.onward, gap.behind) - gap.distance;
        const double cost = double(detour) * world_.rate[joins.type].distance + joins.cost;
        if (cost >= best_) return;
        if (linked_.timed && !keeps_windows(world_.type[joins.type], gap)) return;
        if (uniform(searcher_.rng) < world_.blink) return;
        Move& move = *searcher_.move;
        move.kind = at_stop;
        move.slot = joins.slot;
        move.first = gap.before;
        move.type = joins.type;
        best_ = cost;
    }

    // Tries a customer first and last on a route.
    void try_ends(const Joining& joins) {
        const Run& run = linked_.run[joins.slot];
        const VehicleType& type = world_.type[run.type];
        try_between(joins, {type.begins_at, run.first, linked_.link[run.first].inward});
        try_between(joins, {run.last, type.ends_at, linked_.link[run.last].onward});
    }

    const World& world_;
    Searcher& searcher_;
    const Linked& linked_;
    const Newcomer& newcomer_;
    double best_;
};

// Inserts a customer where `searcher.move` says. False if no slot is free.
bool insert_linked(const World& world, Searcher& searcher, Linked& linked, Int node) {
    const Move& move = *searcher.move;
    Int slot = move.slot;
    Int before = move.first;
    if (opens_route(move)) {
        slot = free_slot(world, searcher, move.type);
        if (slot < 0) return false;
        before = world.type[move.type].begins_at;
        open_run(world, searcher, linked, slot, move.type);
    } else if (move.type != linked.run[slot].type) {
        give_run(searcher, linked, slot, move.type);
    }
    tie_in(world, linked, slot, before, node);
    if (linked.timed) {
        drive_on(world, linked, slot, node, 2);
        look_back(world, linked, slot, node, 2);
    }
    return true;
}

// Finds the cheapest place for a customer, a route of his own alone if he has to open one; returns
// what it costs.
double find_linked(const World& world, Searcher& searcher, const Linked& linked,
                   const Newcomer& newcomer, bool opens) {
    Places places(world, searcher, linked, newcomer, try_new_route(world, searcher, newcomer.node));
    if (!opens) {
        places.try_beside();
        places.try_passing();
    }
    if (places.best() == infeasible) places.try_everywhere();
    return places.best();
}

}  // namespace

Recreated recreate_linked(const World& world, Searcher& searcher, Linked& linked, Int first,
                          double spare) {
    const View<Int, 1> absent = searcher.absent;
    const Int m = world.type[0].travel;  // that of all types, looked up once for each customer
    const bool opening = uniform(searcher.rng) < opening_share;
    const bool enlarge = world.traded && uniform(searcher.rng) < enlarged;
    double total = 0.0;
    Int left = first;
    for (Int index = first; index < searcher.count->absent; ++index) {
        const Int node = absent[index];
        if (rung(world.stop)) return {false, total};
        const Newcomer newcomer{node, legs_to(world.back, m, node), legs_from(world.leg, m, node),
                                enlarge};
        const bool opens = opening && index == first;
        const double cost = find_linked(world, searcher, linked, newcomer, opens);
        const double left_out = world.unassigned_cost + world.unassigned_more[node];
        const bool wanted = cost < left_out || opens;
        if (cost != infeasible && wanted && insert_linked(world, searcher, linked, node)) {
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
