#include "search/sharing.h"

#include <algorithm>

#include "guard.h"
#include "rules/pair.h"
#include "search/route/fairness.h"
#include "search/route/refresh.h"
#include "search/route/state.h"
#include "search/search.h"

namespace tandem {

namespace {

// Copies the routes of the whole that a thread owns to the first slots of its part, empties all
// others, and returns what the routes cost.
double take_routes(const ProblemData& data, const Searcher& whole, Searcher& part,
                   View<const Int, 1> owner, Int number) {
    const Fleet& now = part.now;
    const SearchCounts& count = *part.count;
    double cost = 0.0;
    Int filled = 0;
    for (const Int slot : whole.active.first(whole.count->active)) {
        if (owner[slot] != number) continue;
        data.deadline.go_on();
        copy_route(whole.now, slot, now, filled);
        locate(now, filled);
        cost += now.cost[filled];
        ++filled;
    }
    for (Int slot = 0; slot < part.active.size(); ++slot) {
        Route& route = now.route[slot];
        if (slot >= filled) {
            route.length = route.sorties = route.trips = 0;
            now.cost[slot] = 0.0;
        }
        route.stamp = count.stamp;
    }
    return cost;
}

}  // namespace

void take_part(const ProblemData& data, const Searcher& whole, Searcher& part,
               View<const Int, 1> owner, Int number, View<const Int, 1> missing,
               View<const Int, 1> spare) {
    const Fleet& now = part.now;
    SearchCounts& count = *part.count;
    ++count.stamp;
    for (Place& place : now.where) place.slot = elsewhere;
    const double cost = take_routes(data, whole, part, owner, number);
    for (Int k = 0; k < data.num_types; ++k) now.used[k] = data.type[k].count - spare[k];
    list_active(part);
    count.changed = all_slots;
    for (const Int node : missing) leave_out(data, now, node);
    count.missing = missing.size();
    std::copy(missing.begin(), missing.end(), part.missing.begin());
    count.customers = 0;
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        const bool counts =
            is_paired(data.pair, node) || node == served_place(data, now, unit_of(data.pair, node));
        if (counts && now.where[node].slot != elsewhere) ++count.customers;
    }
    part.value->cost = cost + left_out_cost(data, missing, missing.size()) + plan_cost(data, part);
    keep_best(part);
}

Int add_routes(const ProblemData& data, Searcher& whole, const Searcher& part, Int filled) {
    const Fleet& now = whole.now;
    SearchCounts& count = *whole.count;
    for (const Int slot : part.active.first(part.count->active)) {
        copy_route(part.now, slot, now, filled);
        ++now.used[now.route[filled].type];
        locate(now, filled);
        ++filled;
    }
    for (const Int node : part.missing.first(part.count->missing)) {
        leave_out(data, now, node);
        whole.missing.at(count.missing++) = node;
    }
    list_active(whole);
    return filled;
}

Int add_best(Searcher& whole, const Searcher& part, Int filled) {
    SearchCounts& count = *whole.count;
    for (Int slot = 0; slot < part.active.size(); ++slot) {
        if (part.best.route[slot].length == 0) continue;
        copy_route(part.best, slot, whole.best, filled++);
    }
    for (const Int node : part.best_missing.first(part.count->best_missing)) {
        whole.best_missing.at(count.best_missing++) = node;
    }
    return filled;
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_take_part(const tandem_problem_data* data, const tandem_searcher* whole,
                                const tandem_searcher* part, const tandem_i64_1d* owner,
                                int64_t number, const tandem_i64_1d* missing,
                                const tandem_i64_1d* spare) {
    return guarded([&] {
        Searcher taking = searcher_of(*part);
        take_part(data_of(*data), searcher_of(*whole), taking, *owner, number, *missing, *spare);
    });
}

extern "C" int tandem_add_routes(const tandem_problem_data* data, const tandem_searcher* whole,
                                 const tandem_searcher* part, int64_t filled, int64_t* slots) {
    return guarded([&] {
        Searcher all = searcher_of(*whole);
        *slots = add_routes(data_of(*data), all, searcher_of(*part), filled);
    });
}

extern "C" int tandem_add_best(const tandem_searcher* whole, const tandem_searcher* part,
                               int64_t filled, int64_t* slots) {
    return guarded([&] {
        Searcher all = searcher_of(*whole);
        *slots = add_best(all, searcher_of(*part), filled);
    });
}
