#include "search/linked/anneal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "guard.h"
#include "randomness.h"
#include "search/linked/chain.h"
#include "search/linked/insertion.h"
#include "search/linked/retype.h"
#include "search/linked/strings.h"
#include "search/linked/tails.h"
#include "search/moves/anneal.h"
#include "search/moves/recreate.h"
#include "search/route/state.h"

namespace tandem {

namespace {

// Lists the routes of this turn as changed since the best, and notes nothing more.
void list_changes(Searcher& searcher, Linked& linked) {
    const Noted& noted = *linked.noted;
    for (const Piece& piece : linked.piece.first(noted.pieces)) note_changed(searcher, piece.slot);
    for (const Entry& entry : linked.entry.first(noted.entries)) {
        note_changed(searcher, linked.link[entry.node].slot);
    }
    for (const Int slot : linked.retyped.first(noted.retyped)) note_changed(searcher, slot);
    forget(linked);
}

// Goes on from this turn's routes.
void accept_linked(Searcher& searcher, Linked& linked, double cost) {
    SearchCounts& count = *searcher.count;
    list_changes(searcher, linked);
    const auto missing = searcher.missing.first(count.missing);
    const auto absent = searcher.absent.first(count.absent);
    for (const Int node : missing) searcher.now.where[node].slot = 0;
    for (const Int node : absent) searcher.now.where[node].slot = nowhere;
    count.missing = count.absent;
    std::copy(absent.begin(), absent.end(), searcher.missing.begin());
    searcher.value->cost = cost;
}

// Takes the routes as they are for the best.
void keep_best_linked(Searcher& searcher, Linked& linked) {
    const SearchCounts& count = *searcher.count;
    if (count.changed == all_slots) list_all_changed(searcher);
    for (const Int slot : searcher.changed.first(count.changed)) {
        searcher.is_changed[slot] = false;
        linked.best_first[slot] = nowhere;
        if (searcher.rank[slot] >= count.active) continue;
        const Run& run = linked.run[slot];
        linked.best_first[slot] = run.first;
        linked.best_type[slot] = run.type;
        Int node = run.first;
        for (Int number = 0; number < run.count; ++number) {
            const Int behind = linked.link[node].behind;
            linked.best_behind[node] = behind;
            node = behind;
        }
    }
    keep_totals(searcher);
}

// Swaps tails of routes if that is accepted.
void move_tails(const World& world, Searcher& searcher, Linked& linked) {
    auto [slot, other, cost] = exchange_tails_linked(world, searcher, linked);
    if (slot < 0) return;
    if (world.traded && uniform(searcher.rng) < retyped_share) {
        const double saved = cheapen_run(world, searcher, linked, slot);
        cost -= saved + cheapen_run(world, searcher, linked, other);
    }
    note_changed(searcher, slot);
    note_changed(searcher, other);
    list_changes(searcher, linked);
    searcher.value->cost += cost;
    if (searcher.value->cost < searcher.value->best) keep_best_linked(searcher, linked);
}

// Removes strings of customers and inserts all who are absent then; keeps that if it is accepted.
// False if the search must end, and all is as if the turn had not begun.
bool ruin_and_recreate(const World& world, Searcher& searcher, Linked& linked) {
    SearchValues& value = *searcher.value;
    SearchCounts& count = *searcher.count;
    const Int first = begin_turn(world, searcher, most_missing);
    const Int tried = count.absent;
    const auto [saved, seed] = ruin_linked(world, searcher, linked);
    if (first > 0) try_near(world, searcher, seed, first, tried);
    sort_absent(world, searcher, first, draw_order(world, searcher.rng));
    const double limit = value.cost - value.temperature * std::log(1.0 - uniform(searcher.rng));
    double left_out = 0.0;
    if (count.missing > 0) left_out = left_out_cost(world, searcher.missing, count.missing);
    const bool retyped = world.traded && uniform(searcher.rng) < retyped_share;
    double spare = std::numeric_limits<double>::infinity();
    if (!retyped && counts_up(world, searcher)) {
        spare =
            limit - (value.cost - saved - left_out + left_out_cost(world, searcher.absent, first));
    }
    auto [done, added] = recreate_linked(world, searcher, linked, first, spare);
    if (world.deadline.passed()) {
        take_back(world, searcher, linked);
        --count.turn;
        return false;
    }
    if (done && retyped) added -= cheapen_runs(world, searcher, linked);
    const double cost =
        value.cost - saved + added - left_out + left_out_cost(world, searcher.absent, count.absent);
    const bool scarce = !world.optional && count.absent > 0;
    const bool forced = done && scarce && rarer_absences(world, searcher);
    if (done && (cost < limit || forced)) {
        accept_linked(searcher, linked, cost);
        if (cost < value.best) keep_best_linked(searcher, linked);
    } else {
        take_back(world, searcher, linked);
    }
    return true;
}

}  // namespace

void anneal_linked(const World& world, Searcher& searcher, Linked& linked, Int turns) {
    for (Int turn = 0; turn < turns; ++turn) {
        if (!ruin_and_recreate(world, searcher, linked)) return;
        if (world.tails) move_tails(world, searcher, linked);
        searcher.value->temperature *= searcher.value->cooling;
    }
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_anneal_linked(const tandem_world* world, const tandem_searcher* searcher,
                                    const tandem_linked* linked, int64_t turns) {
    return guarded([&] {
        Searcher searching = searcher_of(*searcher);
        Linked routes = linked_of(*linked);
        anneal_linked(world_of(*world), searching, routes, turns);
    });
}
