#include "search/moves/anneal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "guard.h"
#include "randomness.h"
#include "search/moves/recreate.h"
#include "search/moves/resplit.h"
#include "search/moves/retype.h"
#include "search/moves/ruin.h"
#include "search/moves/two_opt_star.h"
#include "search/route/refresh.h"
#include "search/route/state.h"

namespace tandem {
namespace {

// How likely each of those near the ruin is tried before others, where there are more.
constexpr double tried_near_share = 0.5;

// From how many places on all who are inserted at the beginning come beside neighbours or on a new
// route, too: looking at all routes for each takes time that grows with the square.
constexpr Int built_beside_from = 2000;

constexpr Int resplits = 30;  // trips with one drone planned anew from their order each turn

// Remove strings of customers near each other. In place.
void ruin(const World& world, Searcher& searcher, Int first) {
    Fleet& now = searcher.now;
    const View<Int, 1> absent = searcher.absent;
    const Int before = searcher.count->absent;
    auto [total, num_touched, seed] =
        choose(world, searcher, longest_string(searcher), absent, before, searcher.moved);
    if (first > 0) try_near(world, searcher, seed, first, before);
    for (Int slot : searcher.moved.first(num_touched)) touch(searcher, slot);
    for (Int slot : searcher.touched.first(num_touched)) {
        total = remove_marked(world, now, slot, searcher.marked, absent, total, searcher.moved,
                              *searcher.acc);
        if (now.route[slot].length > 0) locate(now, slot);
    }
    for (Int index = before; index < total; ++index) {
        searcher.marked[absent[index]] = false;
        now.where[absent[index]].slot = nowhere;
    }
    searcher.count->absent = total;
    list_touched(searcher);
}

// Tell whether customers are tried on all routes, not beside neighbours alone.
bool looks_everywhere(const World& world, bool building) {
    return world.scan_all || (building && world.num_nodes < built_beside_from);
}

// Return what the routes cost before who is absent is inserted, from number `first` on.
double cost_to_insert(const World& world, const Searcher& searcher, Int first) {
    const Int missing = searcher.count->missing;
    double cost = served_cost(searcher);
    if (missing > 0) {
        cost += left_out_cost(world, searcher.absent, first) -
                left_out_cost(world, searcher.missing, missing);
    }
    return cost;
}

// Take back this turn. In place.
void undo(Searcher& searcher) {
    const Fleet& now = searcher.now;
    const SearchCounts& count = *searcher.count;
    for (Int index = 0; index < count.touched; ++index) {
        const Int slot = searcher.touched[index];
        const Route& route = now.route[slot];
        if (route.length > 0) --now.used[route.type];
        copy_route(searcher.before, index, now, slot, count.lean != 0);
        if (route.length > 0) {
            ++now.used[route.type];
            locate(now, slot);
        }
    }
    for (Int node : searcher.missing.first(count.missing)) now.where[node].slot = nowhere;
    list_touched(searcher);
}

// Return by how much a turn may raise the cost, drawn by the temperature.
double draw_rise(const Searcher& searcher) {
    return -searcher.value->temperature * std::log(1.0 - uniform(searcher.rng));
}

// Go on from this turn's routes, and keep them if they are the best. In place.
void go_on(Searcher& searcher, double cost) {
    accept(searcher, cost);
    if (cost < searcher.value->best) keep_best(searcher);
}

// Swap tails of routes, or plan a trip anew, if that is accepted. In place.
void move_parts(const World& world, Searcher& searcher, bool tails) {
    SearchCounts& count = *searcher.count;
    const double rise = draw_rise(searcher);
    count.touched = 0;
    count.absent = count.missing;
    if (tails ? exchange_tails(world, searcher, rise) : resplit(world, searcher, rise)) {
        if (world.traded && uniform(searcher.rng) < retyped_share) improve_types(world, searcher);
        // Who is left out stays the same, and isn't listed as absent yet.
        const double cost = served_cost(searcher);
        if (cost < searcher.value->cost + rise) {
            std::copy_n(searcher.missing.begin(), count.missing, searcher.absent.begin());
            list_touched(searcher);
            go_on(searcher, cost);
            return;
        }
    }
    if (count.touched > 0) undo(searcher);
}

// Ruin and recreate once. In place; false, with nothing changed, once the search must end.
bool take_turn(const World& world, Searcher& searcher) {
    SearchCounts& count = *searcher.count;
    const Int first = begin_turn(world, searcher, most_missing);
    ruin(world, searcher, first);
    if (world.mixed && count.touched > 0 && uniform(searcher.rng) < retyped_share) {
        draw_type(world, searcher);
    }
    sort_absent(world, searcher, first, draw_order(world, searcher.rng));
    const double limit = searcher.value->cost + draw_rise(searcher);
    const bool retyped = (world.traded || world.mixed) && uniform(searcher.rng) < retyped_share;
    double spare = std::numeric_limits<double>::infinity();
    if (!retyped && counts_up(world, searcher)) {
        spare = limit - cost_to_insert(world, searcher, first);
    }
    const bool done = recreate(world, searcher, first, looks_everywhere(world, false), spare);
    if (world.deadline.passed()) {
        undo(searcher);
        --count.turn;
        return false;
    }
    if (done && retyped) {
        if (world.traded) improve_types(world, searcher);
        if (world.mixed) cheapen_types(world, searcher);
    }
    const double cost = turn_cost(world, searcher);
    const bool scarce = !world.optional && count.absent > 0;
    const bool forced = done && scarce && rarer_absences(world, searcher);
    if (cost < limit || forced) {
        go_on(searcher, cost);
    } else {
        undo(searcher);
    }
    return true;
}

// Insert all who are left out in an order, whatever that costs. In place.
void insert_all(const World& world, Searcher& searcher, Int order) {
    const Int first = begin_turn(world, searcher, searcher.count->missing);
    sort_absent(world, searcher, first, order);
    uniform(searcher.rng);  // As a turn draws that may be taken back.
    recreate(world, searcher, first, looks_everywhere(world, true),
             std::numeric_limits<double>::infinity());
    go_on(searcher, turn_cost(world, searcher));
}

}  // namespace

Int begin_turn(const World& world, Searcher& searcher, Int most) {
    SearchCounts& count = *searcher.count;
    const View<Int, 1> absent = searcher.absent;
    ++count.turn;
    count.touched = 0;
    if (count.stay > 0 && count.turn % count.stay == 0) {
        count.focus = any_customer(world, searcher.now, searcher.rng);
    }
    const Int total = count.missing;
    std::copy_n(searcher.missing.begin(), total, absent.begin());
    const Int alone = std::max(Int{0}, total - most);
    for (Int index = total - 1; index >= alone; --index) {
        std::swap(absent[index], absent[below(searcher.rng, index + 1)]);
    }
    count.absent = total;
    return alone;
}

void try_near(const World& world, Searcher& searcher, Int seed, Int first, Int total) {
    const View<Int, 1> absent = searcher.absent;
    const View<bool, 1> marked = searcher.marked;
    const View<const std::int32_t, 1> near = world.near[seed];
    Int chosen = 0;
    for (Int rank = -1; rank < near.size(); ++rank) {
        const Int node = rank < 0 ? seed : near[rank];
        if (node < 0 || chosen == total - first) break;
        if (searcher.now.where[node].slot == nowhere && !world.must_serve[node] &&
            (rank < 0 || uniform(searcher.rng) < tried_near_share)) {
            marked[node] = true;
            ++chosen;
        }
    }
    Int last = total;
    for (Int index = total - 1; index >= 0; --index) {
        if (!marked[absent[index]]) continue;
        --last;
        marked[absent[index]] = false;
        std::swap(absent[index], absent[last]);
    }
}

bool rarer_absences(const World& world, Searcher& searcher) {
    const View<Int, 1> absences = searcher.absences;
    const View<const Int, 1> missing = searcher.missing;
    const View<const Int, 1> absent = searcher.absent;
    const Int num_missing = searcher.count->missing;
    const Int num_absent = searcher.count->absent;
    Int before = 0;
    Int after = 0;
    Int more = 0;
    for (Int node : missing.first(num_missing)) {
        if (!world.must_serve[node]) continue;
        before += absences[node];
        --more;
    }
    for (Int node : absent.first(num_absent)) {
        if (!world.must_serve[node]) continue;
        after += absences[node]++;
        ++more;
    }
    const bool dearer =
        left_out_cost(world, absent, num_absent) > left_out_cost(world, missing, num_missing);
    return more == 0 && after < before && !dearer;
}

bool counts_up(const World& world, const Searcher& searcher) {
    return world.adds_up && (searcher.count->missing == 0 || world.optional);
}

void anneal(const World& world, Searcher& searcher, Int turns, Int order) {
    for (Int turn = 0; turn < turns; ++turn) {
        if (order != any_order) {
            insert_all(world, searcher, order);
        } else {
            if (!take_turn(world, searcher)) return;
            const Int parts = world.single_drones ? 1 + resplits : 1;
            for (Int part = 0; part < parts; ++part) {
                if ((part > 0 || world.tails) && !world.deadline.passed()) {
                    move_parts(world, searcher, part == 0);
                }
            }
        }
        searcher.value->temperature *= searcher.value->cooling;
    }
}

}  // namespace tandem

extern "C" int tandem_anneal(const tandem_world* world, const tandem_searcher* searcher,
                             int64_t turns, int64_t order) {
    return tandem::guarded([&] {
        tandem::Searcher working = tandem::searcher_of(*searcher);
        tandem::anneal(tandem::world_of(*world), working, turns, order);
    });
}
