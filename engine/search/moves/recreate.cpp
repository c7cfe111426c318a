#include "search/moves/recreate.h"

#include "search/insertion/alone.h"
#include "search/insertion/places.h"
#include "search/moves/halting.h"
#include "search/route/fairness.h"
#include "search/route/goods.h"
#include "search/route/refresh.h"

namespace tandem {
namespace {

constexpr std::array orders{by_chance, by_chance, by_chance, by_chance, by_demand,
                            by_demand, by_demand, by_demand, by_far,    by_far,
                            by_close,  by_width,  by_width,  by_latest};

// Up to how many customers are sorted by insertion alone; where all are, that takes too long.
constexpr Int few_to_sort = 64;

// How often those come first whom it costs most to leave out, where that differs.
constexpr double dearest_first = 0.5;

// How often those come first who were left out most often, where somebody lacks: who fits in few
// places has to have them before others do.
constexpr double hardest_first = 0.5;

constexpr double opened_anyhow = 0.3;  // share of shipments that drones may fly

// By how much, at most, what the plan as a whole would cost more is taken to count in a turn, since
// it is estimated.
constexpr double heaviest = 2.0;

// Returns where a customer comes in an order; least first.
double order_key(const ProblemData& data, const Searcher& searcher, Int order, Int node) {
    const View<std::uint64_t, 1> rng = searcher.rng;
    const Windows place = data.place[0][node];
    switch (order) {
        case by_cost:
            return -data.unassigned_more[node];
        case by_absences:
            return -double(searcher.absences[node]) - uniform(rng);
        case by_demand:
            if (tiers_of(data) > 0) {
                return -double(total_delivered(data.amount, node) +
                               total_picked(data.amount, node));
            }
            return -double(total(demand_of(place)));
        case by_far:
        case by_close: {
            const VehicleType& type = data.type[0];
            const double distance =
                double(leg(legs_of(data.leg, type.travel), type.begins_at, node).distance);
            return order == by_far ? -distance : distance;
        }
        case by_width:
            return double(place.width());
        case by_latest:
            return double(place.closing());
        default:
            return uniform(rng);
    }
}

// Tells whether a shipment opens a route in any way that goes, by a draw: what is cheapest for it
// alone binds truck and drones, whatever comes then.
bool opens_anyhow(const ProblemData& data, const Searcher& searcher, Int node, Int k) {
    return is_pickup(data.pair, node) && flies_some_end(data, k, node) &&
           uniform(searcher.rng) < opened_anyhow;
}

// Serves a customer by a route of its own. False if no slot is free.
bool open_route(const ProblemData& data, const Searcher& searcher, Int node, Int k, bool by_drone) {
    const Fleet& now = searcher.now;
    const Int slot = free_slot(data, searcher, k);
    if (slot < 0) return false;
    touch(searcher, slot);
    if (!(opens_anyhow(data, searcher, node, k) &&
          serve_alone_anyhow(data, now, slot, k, node, searcher.rng)) &&
        !serve_alone(data, now, slot, k, node, by_drone)) {
        now.route[slot].length = 0;
        now.cost[slot] = 0.0;
        return false;
    }
    now.used[k] += 1;
    locate(now, slot);
    list_anew(searcher, slot, true);
    return true;
}

// Inserts a customer as a move says. False if that breaks a rule.
bool insert(const ProblemData& data, const Searcher& searcher, Int node, const Move& move) {
    const Fleet& now = searcher.now;
    if (opens_route(move)) {
        return open_route(data, searcher, node, move.type, flies(move));
    }
    const Int slot = move.slot;
    touch(searcher, slot);
    Route& route = now.route[slot];
    const Int spare = now.route.size() - 2;
    set_aside(data, now, slot, spare);
    const Int former = route.type;
    const bool retyped = data.evaluation[former].by_distance && move.type != former;
    if (retyped) change_type(data, now, slot, move.type);
    const bool allowed = apply(sequence_in(now, slot), move) && refresh(data, now, slot);
    if (!allowed) {
        if (retyped) change_type(data, now, slot, former);
        put_back(data, now, slot, spare);
    }
    locate(now, slot);
    return allowed;
}

// Tells whether there is room for several trips of a vehicle.
bool several_trips(const Searcher& searcher) { return searcher.now.trip.shape(1) > 2; }

// Finds where a customer is inserted best, who goes with nobody served. In place.
void find_anywhere(const Insertion& insertion, bool opens, bool scan_all) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Int active = searcher.count->active;
    Int tried = 0;
    MoreTrips which = MoreTrips::any;
    if (opens) {
        try_new_route(data, searcher, node, best);
    } else if (!scan_all) {
        find_beside(insertion);
        if (several_trips(searcher) &&
            (opens_route(best.move) || uniform(searcher.rng) < more_trips)) {
            tried = drawn_for_trips;
        }
    }
    if (best.cost == infeasible) {
        find_place(insertion);
        if (best.cost == infeasible || uniform(searcher.rng) < more_trips) tried = active;
    }
    // A vehicle that ends soon may well make a trip more.
    if (tried == 0 && !opens && best.weight > 0.0 && several_trips(searcher)) {
        tried = active;
        which = MoreTrips::alone;
    }
    if (tried > 0) try_trips(insertion, tried, which);
}

// Finds where a customer is inserted best, at home if he has one. In place.
void find(const Insertion& insertion, Int home, bool opens, bool scan_all) {
    if (home == nowhere) {
        find_anywhere(insertion, opens, scan_all);
    } else if (home >= 0) {
        find_at_home(insertion, home);
    }
}

// Finds where a customer is inserted best at any of his places, and returns that. In place.
Int find_best(const Insertion& insertion, Int home, bool opens, bool scan_all) {
    const auto [data, searcher, node, enlarge, best] = insertion;
    const Best untried = best;
    Int chosen = node;
    find(insertion, home, opens, scan_all);
    if (is_paired(data.pair, node)) return node;
    for_each_place(data.pair, node, [&](Int place) {
        if (place == node) return;
        Best there = untried;
        find({data, searcher, place, enlarge, there}, home, opens, scan_all);
        if (there.cost >= best.cost) return;
        best = there;
        chosen = place;
    });
    return chosen;
}

}  // namespace

Int draw_order(const ProblemData& data, View<std::uint64_t, 1> rng, bool lacks) {
    if (lacks && uniform(rng) < hardest_first) return by_absences;
    if (is_dearer_to_some(data) && uniform(rng) < dearest_first) return by_cost;
    return orders[std::size_t(below(rng, orders.size()))];
}

void sort_absent(const ProblemData& data, const Searcher& searcher, Int first, Int order) {
    const View<Int, 1> absent = searcher.absent;
    const View<double, 1> key = searcher.scratch->key;
    const Int last = searcher.count->absent;
    for (Int index = first; index < last; ++index) {
        key[absent[index]] = order_key(data, searcher, order, absent[index]);
    }
    Int gap = 1;
    while (few_to_sort * gap < last - first) gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3) {
        for (Int index = first + gap; index < last; ++index) {
            const Int node = absent[index];
            Int place = index;
            while (place >= first + gap && key[absent[place - gap]] > key[node]) {
                absent[place] = absent[place - gap];
                place -= gap;
            }
            absent[place] = node;
        }
    }
}

bool recreate(const ProblemData& data, const Searcher& searcher, Int first, bool scan_all,
              Spare spare) {
    const View<Int, 1> absent = searcher.absent;
    SearchCounts& count = *searcher.count;
    const bool enlarge = data.strategy.swap_vehicles && uniform(searcher.rng) < enlarged;
    const bool opens_first = uniform(searcher.rng) < opening_share;
    const double weight = plan_costs(data) ? heaviest * uniform(searcher.rng) : 0.0;
    Int left = first;
    for (Int index = first; index < count.absent; ++index) {
        const Int node = absent[index];
        if (data.deadline.passed()) {
            absent.at(left++) = node;
            continue;
        }
        if (has_halts(data) && uniform(searcher.rng) < halting_share)
            halt_for(data, searcher, node);
        const Int home = home_of(data, searcher, node);
        const bool opens = opens_first && index == first && home == nowhere;
        Best best{data.strategy.blink, searcher.rng};
        if (weight > 0.0) {
            best.shares = shares_of(data, searcher);
            best.weight = weight;
        }
        const Insertion insertion{data, searcher, node, enlarge, best};
        const Int chosen = find_best(insertion, home, opens, scan_all);
        const double left_out = data.unassigned_cost + data.unassigned_more[node];
        const bool wanted = best.cost < left_out || opens;
        const bool is_absent =
            best.cost == infeasible || !wanted || !insert(data, searcher, chosen, best.move);
        if (is_absent) absent.at(left++) = node;
        if (!spare.spend(std::min(best.cost, left_out), is_absent && data.must_serve[node])) {
            count.absent = left;
            return false;
        }
    }
    count.absent = left;
    if (has_halts(data)) drop_idle_halts(data, searcher);
    return true;
}

}  // namespace tandem
