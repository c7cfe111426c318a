#include "search/beginning/plans.h"
#include "search/route/fairness.h"
#include "search/route/state.h"
#include "search/search.h"

namespace tandem {

void disband(const ProblemData& data, Searcher& searcher) {
    const Fleet& now = searcher.now;
    SearchCounts& count = *searcher.count;
    ++count.stamp;
    count.changed = all_slots;
    count.absent = 0;
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        Route& route = now.route[slot];
        route.stamp = count.stamp;
        route.length = route.sorties = route.trips = 0;
        now.cost[slot] = 0.0;
    }
    std::ranges::fill(now.used, 0);
    for (Int node = 0; node < now.where.size(); ++node) {
        if (now.where[node].slot < 0) continue;
        now.where[node].slot = nowhere;
        if (!is_other_end(data.pair, node)) {
            searcher.missing.at(count.missing++) = unit_of(data.pair, node);
        }
    }
    list_active(searcher);
}

// Return how seldom those of a route were left out after a turn, and how few they are; least first.
Int absences_of(const ProblemData& data, const Searcher& searcher, Int slot) {
    const Fleet& now = searcher.now;
    Int sum = 0;
    for (const Stop& stop : stops_of(now, slot)) {
        if (stop.kind == customer_stop && !is_other_end(data.pair, stop.node)) {
            sum += 1 + searcher.absences[stop.node];
        }
    }
    return sum;
}

void give_up_route(const ProblemData& data, Searcher& searcher) {
    const Fleet& now = searcher.now;
    SearchCounts& count = *searcher.count;
    const View<const Int, 1> active = searcher.active.first(count.active);
    Int slot = active[0];
    for (const Int other : active) {
        if (absences_of(data, searcher, other) < absences_of(data, searcher, slot)) slot = other;
    }
    Route& route = now.route[slot];
    double cost = searcher.value->cost - now.cost[slot] - plan_cost(data, searcher);
    for (const Stop& stop : stops_of(now, slot)) {
        if (stop.kind != customer_stop) continue;
        now.where[stop.node].slot = nowhere;
        if (is_other_end(data.pair, stop.node)) continue;
        searcher.missing.at(count.missing++) = stop.node;
        cost += data.unassigned_cost + data.unassigned_more[stop.node];
    }
    route.stamp = ++count.stamp;
    route.length = route.sorties = route.trips = 0;
    now.cost[slot] = 0.0;
    --now.used[route.type];
    list_anew(searcher, slot, false);
    note_changed(searcher, slot);
    searcher.value->cost = cost + plan_cost(data, searcher);
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_give_up_route(const tandem_problem_data* data, tandem_search* search) {
    return guarded([&] {
        Searcher& searching = *search;
        give_up_route(data_of(*data), searching);
    });
}

extern "C" int tandem_disband(const tandem_problem_data* data, tandem_search* search) {
    return guarded([&] {
        Searcher& searching = *search;
        disband(data_of(*data), searching);
    });
}
