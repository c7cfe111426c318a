
#include "search/anneal.h"
#include "search/moves/best_part.h"
#include "search/moves/exchanges.h"
#include "search/moves/resplit.h"
#include "search/moves/ruin.h"
#include "search/moves/small_moves.h"
#include "search/route/fairness.h"
#include "search/route/lags.h"
#include "search/route/rarer.h"
#include "search/route/refresh.h"
#include "search/route/state.h"
#include "search/search.h"

namespace tandem {
namespace {

// How many trips with one drone are planned anew from their order each turn; where trips are
// annealed by small moves, too, it is fewer.
constexpr Int resplits = 30, resplits_beside = 10;

constexpr Int moved_ends = 1;  // of shipments that drones may serve, tried elsewhere each turn

constexpr double best_part_share = 0.0002;  // how often one is planned at best, instead

// Routes in rows of stops, with all that `Fleet` knows of them.
class RouteStore {
public:
    RouteStore(const ProblemData& data, Searcher& searcher)
        : data_(data),
          searcher_(searcher),
          resplit_(data, searcher),
          best_part_(data, searcher),
          small_moves_(data, searcher),
          all_paired_(all_paired(data.pair, data.num_depots)),
          plan_cost_(plan_cost(data, searcher)) {}

    void ruin(Int first) {
        resplit_.forget();
        remove_strings(first);
        SearchCounts& count = *searcher_.count;
        if (data_.strategy.change_vehicles && count.touched > 0 &&
            uniform(searcher_.rng) < retyped_share) {
            draw_type(data_, searcher_);
        }
    }

    bool recreate(Int first, Spare spare) {
        return tandem::recreate(data_, searcher_, first, data_.strategy.scan_all, spare);
    }

    // Inserts who is absent, from a number on, whatever that costs.
    void insert_all(Int first) {
        const bool scan_all = data_.strategy.scan_all || data_.num_nodes < built_beside_from;
        tandem::recreate(data_, searcher_, first, scan_all, {});
    }

    void retype() {
        if (data_.strategy.swap_vehicles) improve_types(data_, searcher_);
        if (data_.strategy.change_vehicles) cheapen_types(data_, searcher_);
    }

    Int parts() const {
        if (data_.strategy.small_moves) return 2 + resplits_now();
        if (data_.strategy.resplit) return 1 + resplits;
        if (data_.strategy.fly_shipments) return 1 + moved_ends;
        // Tails of routes hold whole shipments but seldom.
        return all_paired_ ? 0 : 1;
    }

    // Swaps tails of routes first, then plans trips anew, and anneals some by small moves last.
    bool move_part(Int part, double rise) {
        SearchCounts& count = *searcher_.count;
        count.touched = 0;
        const bool by_small_moves = data_.strategy.small_moves && part > resplits_now();
        const bool is_moved = part == 0        ? two_opt_star(data_, searcher_, rise)
                              : by_small_moves ? small_moves_.attempt()
                                               : plan_anew(rise);
        if (!is_moved) return false;
        // Who is left out stays the same, and isn't listed as absent yet.
        count.absent = count.missing;
        copy_first(searcher_.missing, count.missing, searcher_.absent);
        if (by_small_moves) return true;
        if (data_.strategy.swap_vehicles && uniform(searcher_.rng) < retyped_share) {
            improve_types(data_, searcher_);
        }
        return served_cost() < searcher_.value->cost + rise;
    }

    double served_cost() const {
        return tandem::served_cost(searcher_) + (plan_cost(data_, searcher_) - plan_cost_);
    }

    void accept(double cost) {
        list_touched(searcher_);
        tandem::accept(searcher_, cost);
        plan_cost_ = plan_cost(data_, searcher_);
    }

    void keep_best() { tandem::keep_best(searcher_); }

    void take_back() {
        const Fleet& now = searcher_.now;
        const SearchCounts& count = *searcher_.count;
        if (count.touched == 0) return;
        forget_places();
        for (Int index = 0; index < count.touched; ++index) {
            const Int slot = searcher_.touched[index];
            const Route& route = now.route[slot];
            if (route.length > 0) --now.used[route.type];
            copy_route(searcher_.before, index, now, slot);
            if (route.length > 0) {
                ++now.used[route.type];
                locate(now, slot);
            }
        }
        for (Int node : searcher_.missing.first(count.missing)) leave_out(data_, now, node);
        list_touched(searcher_);
    }

private:
    // Notes that nobody is on the routes touched, who may be served at another place than before.
    void forget_places() const {
        if (!some_paired(data_.pair)) return;
        for (const Int slot : searcher_.touched.first(searcher_.count->touched)) {
            for_each_served(searcher_.now, slot,
                            [&](Int node) { leave_out(data_, searcher_.now, node); });
        }
    }

    // Serves an end of a shipment otherwise, or plans a part of a trip with one drone anew.
    bool plan_anew(double rise) {
        if (data_.strategy.fly_shipments) return move_end(data_, searcher_, rise);
        if (has_halts(data_) && uniform(searcher_.rng) < best_part_share) {
            resplit_.forget();
            return best_part_.attempt();
        }
        return resplit_.attempt(rise);
    }

    // How many trips are planned anew from their order this turn. Small moves find no stops at
    // launch sites.
    Int resplits_now() const {
        return small_moves_.can_do() && !has_halts(data_) ? resplits_beside : resplits;
    }

    Int num_trips() const {
        Int trips = 0;
        for (const Int slot : searcher_.active.first(searcher_.count->active)) {
            trips += searcher_.now.route[slot].trips;
        }
        return trips;
    }

    // Removes strings of customers near each other.
    void remove_strings(Int first) {
        Fleet& now = searcher_.now;
        const Int before = searcher_.count->absent;
        Removed removed{searcher_.marked, searcher_.absent, before, data_.pair};
        const auto [num_touched, seed] =
            choose(data_, searcher_, longest_string(searcher_, num_trips()), removed,
                   searcher_.scratch->moved);
        mark_company(data_, now, searcher_.rng, removed, before);
        if (orders_cross(data_)) {
            // Nobody waits any more for whoever is about to be removed.
            for (Int index = before; index < removed.count; ++index) {
                leave_out(data_, now, removed.absent[index]);
            }
        }
        if (first > 0) try_near(data_, searcher_, seed, first, before);
        for (Int slot : searcher_.scratch->moved.view().first(num_touched)) touch(searcher_, slot);
        for (Int slot : searcher_.touched.first(num_touched)) {
            remove_marked(data_, now, slot, removed, searcher_.scratch->moved);
            if (now.route[slot].length > 0) locate(now, slot);
        }
        for (Int index = before; index < removed.count; ++index) {
            const Int node = removed.absent[index];
            removed.unmark(node);
            leave_out(data_, now, node);
        }
        searcher_.count->absent = removed.count;
        list_touched(searcher_);
    }

    const ProblemData& data_;
    Searcher& searcher_;
    Resplit resplit_;
    BestPart best_part_;
    SmallMoves small_moves_;
    const bool all_paired_;
    double plan_cost_;  // of the routes as they are, but for this turn
};

}  // namespace

void anneal_routes(const ProblemData& data, Searcher& searcher, Int turns) {
    RouteStore routes(data, searcher);
    anneal(data, searcher, routes, turns);
}

void insert_all(const ProblemData& data, Searcher& searcher, Int order) {
    RouteStore routes(data, searcher);
    insert_all(data, searcher, routes, order);
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_anneal(const tandem_problem_data* data, tandem_search* search, int64_t turns,
                             int64_t order) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        Searcher& working = looking(problem, *search);
        if (order == any_order) {
            anneal_routes(problem, working, turns);
        } else {
            for (Int turn = 0; turn < turns; ++turn) insert_all(problem, working, order);
        }
    });
}
