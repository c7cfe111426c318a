#include "search/moves/store.h"

#include <algorithm>
#include <limits>

#include "guard.h"
#include "randomness.h"
#include "search/anneal.h"
#include "search/moves/recreate.h"
#include "search/moves/resplit.h"
#include "search/moves/retype.h"
#include "search/moves/ruin.h"
#include "search/moves/two_opt_star.h"
#include "search/route/refresh.h"
#include "search/route/state.h"

namespace tandem {
namespace {

// From how many places on all who are inserted at the beginning come beside neighbours or on a new
// route, too: looking at all routes for each takes time that grows with the square.
constexpr Int built_beside_from = 2000;

constexpr Int resplits = 30;  // trips with one drone planned anew from their order each turn

// Routes in rows of stops, with all that `Fleet` knows of them.
class RouteStore {
public:
    RouteStore(const World& world, Searcher& searcher) : world_(world), searcher_(searcher) {}

    void ruin(Int first) {
        remove_strings(first);
        SearchCounts& count = *searcher_.count;
        if (world_.mixed && count.touched > 0 && uniform(searcher_.rng) < retyped_share) {
            draw_type(world_, searcher_);
        }
    }

    bool recreate(Int first, double spare) {
        return tandem::recreate(world_, searcher_, first, world_.scan_all, spare);
    }

    // Inserts who is absent, from a number on, whatever that costs.
    void insert_all(Int first) {
        const bool scan_all = world_.scan_all || world_.num_nodes < built_beside_from;
        tandem::recreate(world_, searcher_, first, scan_all,
                         std::numeric_limits<double>::infinity());
    }

    void retype() {
        if (world_.traded) improve_types(world_, searcher_);
        if (world_.mixed) cheapen_types(world_, searcher_);
    }

    Int parts() const { return world_.single_drones ? 1 + resplits : 1; }

    // Swaps tails of routes first, then plans a trip anew.
    bool move_part(Int part, double rise) {
        SearchCounts& count = *searcher_.count;
        count.touched = 0;
        const bool is_moved =
            part == 0 ? exchange_tails(world_, searcher_, rise) : resplit(world_, searcher_, rise);
        if (!is_moved) return false;
        // Who is left out stays the same, and isn't listed as absent yet.
        count.absent = count.missing;
        std::copy_n(searcher_.missing.begin(), count.missing, searcher_.absent.begin());
        return true;
    }

    void trade() { improve_types(world_, searcher_); }

    bool is_worth(double rise) const { return served_cost() < searcher_.value->cost + rise; }

    double served_cost() const { return tandem::served_cost(searcher_); }

    void accept(double cost) {
        list_touched(searcher_);
        tandem::accept(searcher_, cost);
    }

    void keep_best() { tandem::keep_best(searcher_); }

    void take_back() {
        const Fleet& now = searcher_.now;
        const SearchCounts& count = *searcher_.count;
        if (count.touched == 0) return;
        for (Int index = 0; index < count.touched; ++index) {
            const Int slot = searcher_.touched[index];
            const Route& route = now.route[slot];
            if (route.length > 0) --now.used[route.type];
            copy_route(searcher_.before, index, now, slot, count.lean != 0);
            if (route.length > 0) {
                ++now.used[route.type];
                locate(now, slot);
            }
        }
        for (Int node : searcher_.missing.first(count.missing)) now.where[node].slot = nowhere;
        list_touched(searcher_);
    }

private:
    // Removes strings of customers near each other.
    void remove_strings(Int first) {
        Fleet& now = searcher_.now;
        const View<Int, 1> absent = searcher_.absent;
        const Int before = searcher_.count->absent;
        auto [total, num_touched, seed] =
            choose(world_, searcher_, longest_string(searcher_), absent, before, searcher_.moved);
        if (first > 0) try_near(world_, searcher_, seed, first, before);
        for (Int slot : searcher_.moved.first(num_touched)) touch(searcher_, slot);
        for (Int slot : searcher_.touched.first(num_touched)) {
            total = remove_marked(world_, now, slot, searcher_.marked, absent, total,
                                  searcher_.moved, *searcher_.acc);
            if (now.route[slot].length > 0) locate(now, slot);
        }
        for (Int index = before; index < total; ++index) {
            searcher_.marked[absent[index]] = false;
            now.where[absent[index]].slot = nowhere;
        }
        searcher_.count->absent = total;
        list_touched(searcher_);
    }

    const World& world_;
    Searcher& searcher_;
};

}  // namespace

void anneal_routes(const World& world, Searcher& searcher, Int turns) {
    RouteStore routes(world, searcher);
    anneal(world, searcher, routes, turns);
}

void insert_all(const World& world, Searcher& searcher, Int turns, Int order) {
    RouteStore routes(world, searcher);
    for (Int turn = 0; turn < turns; ++turn) {
        const Int first = begin_turn(world, searcher, searcher.count->missing);
        sort_absent(world, searcher, first, order);
        uniform(searcher.rng);  // As a turn draws that may be taken back.
        routes.insert_all(first);
        go_on(searcher, routes, turn_cost(world, searcher, routes.served_cost()));
        searcher.value->temperature *= searcher.value->cooling;
    }
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_anneal(const tandem_world* world, const tandem_searcher* searcher,
                             int64_t turns, int64_t order) {
    return guarded([&] {
        const World problem = world_of(*world);
        Searcher working = searcher_of(*searcher);
        if (order == any_order) {
            anneal_routes(problem, working, turns);
        } else {
            insert_all(problem, working, turns, order);
        }
    });
}
