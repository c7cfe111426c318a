// Routes shared between threads: a region for each, or the cheapest of all for everyone.
#include <vector>

#include "rules/hub.h"
#include "search/route/fairness.h"
#include "search/route/hubs.h"
#include "search/route/refresh.h"
#include "search/route/state.h"
#include "search/search.h"

namespace tandem {

namespace {

// Routes of which a search takes some.
struct TakenRoutes {
    const Fleet& from;
    View<const Int, 1> slots, missing;
    View<const Int, 1> used;  // vehicles, by type
};

// Copies the routes to the first slots of a part, empties all others, and returns what they cost.
double take_routes(const ProblemData& data, const TakenRoutes& taken, Searcher& part) {
    const Fleet& now = part.now;
    double cost = 0.0;
    Int filled = 0;
    for (const Int slot : taken.slots) {
        data.deadline.go_on();
        copy_route(taken.from, slot, now, filled);
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
        route.stamp = part.count->stamp;
    }
    return cost;
}

void take(const ProblemData& data, const TakenRoutes& taken, Searcher& part) {
    const Fleet& now = part.now;
    SearchCounts& count = *part.count;
    ++count.stamp;
    for (Place& place : now.where) place.slot = elsewhere;
    const double cost = take_routes(data, taken, part);
    copy_first(taken.used, data.num_types, now.used);
    list_active(part);
    count.changed = all_slots;
    for (const Int node : taken.missing) leave_out(data, now, node);
    count.missing = taken.missing.size();
    copy_first(taken.missing, count.missing, part.missing);
    count.customers = 0;
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        const bool counts =
            is_paired(data.pair, node) || node == served_place(data, now, unit_of(data.pair, node));
        if (counts && now.where[node].slot != elsewhere) ++count.customers;
    }
    part.value->cost = cost + missing_cost(data, part) + plan_cost(data, part);
    keep_best(part);
}

// Goes on from all routes as they are.
void take_all(const ProblemData& data, const Searcher& whole, Searcher& part) {
    const SearchCounts& count = *whole.count;
    part.active = part.slots;
    take(data,
         {whole.now, whole.active.first(count.active), whole.missing.first(count.missing),
          whole.now.used},
         part);
}

// Goes on from the best routes.
void take_best(const ProblemData& data, Searcher& searcher) {
    const Fleet& best = searcher.best;
    std::vector<Int> used;
    std::ranges::fill(best.used, 0);
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        if (best.route[slot].length == 0) continue;
        used.push_back(slot);
        ++best.used[best.route[slot].type];
    }
    take(data,
         {best,
          {used.data(), {std::ssize(used)}},
          searcher.best_missing.first(searcher.count->best_missing),
          best.used},
         searcher);
}

// Copies a part's routes behind those that there are, or in their places if it is `alone`, and
// leaves out whom it does.
void add_routes(const ProblemData& data, Searcher& whole, const Searcher& part, bool alone) {
    const Fleet& now = whole.now;
    SearchCounts& count = *whole.count;
    if (alone) {
        for (Route& route : now.route) route.length = 0;
        for (Place& place : now.where) place.slot = nowhere;
        std::ranges::fill(now.used, 0);
        count.missing = count.active = 0;
    }
    Int filled = count.active;
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
}

// Likewise its best routes.
void add_best(Searcher& whole, const Searcher& part, bool alone) {
    const Fleet& best = whole.best;
    SearchCounts& count = *whole.count;
    if (alone) {
        for (Route& route : best.route) route.length = 0;
        count.best_missing = 0;
    }
    Int filled = 0;
    while (filled < whole.active.size() && best.route[filled].length > 0) ++filled;
    for (Int slot = 0; slot < part.active.size(); ++slot) {
        if (part.best.route[slot].length > 0) copy_route(part.best, slot, best, filled++);
    }
    for (const Int node : part.best_missing.first(part.count->best_missing)) {
        whole.best_missing.at(count.best_missing++) = node;
    }
    for (Route& route : best.route) route.stamp = others;
    count.changed = all_slots;
}

}  // namespace
}  // namespace tandem

using namespace tandem;

int tandem_write_slots(tandem_search* search, const tandem_i64_1d* slots) {
    return guarded([&] {
        const View<Place, 1> where = search->now.where;
        for (Int node = 0; node < where.size(); ++node) (*slots)[node] = where[node].slot;
    });
}

int tandem_write_taken(const tandem_problem_data* data, tandem_search* search,
                       const tandem_i64_2d* taken) {
    return guarded([&] { count_batteries(data_of(*data), search->now, *taken); });
}

int tandem_write_served(tandem_search* search, const tandem_i64_1d* nodes, int64_t* count) {
    return guarded([&] {
        *count = 0;
        for (const Int slot : search->active.first(search->count->active)) {
            for (Int p = 1; p < search->now.route[slot].length - 1; ++p) {
                nodes->at((*count)++) = search->now.stop(slot, p).node;
            }
            nodes->at((*count)++) = nowhere;
        }
    });
}

int tandem_size_of_best(tandem_search* search, int64_t* routes, int64_t* sorties) {
    return guarded([&] {
        *routes = *sorties = 0;
        for (const Route& route : search->best.route.first(search->active.size())) {
            if (route.length == 0) continue;
            ++*routes;
            *sorties += route.sorties;
        }
    });
}

int tandem_take_part(const tandem_problem_data* data, tandem_search* whole, tandem_search* part,
                     int64_t slots, const tandem_i64_1d* owner, int64_t number,
                     const tandem_i64_1d* missing, const tandem_i64_1d* used) {
    return guarded([&] {
        std::vector<Int> own;
        for (const Int slot : whole->active.first(whole->count->active)) {
            if ((*owner)[slot] == number) own.push_back(slot);
        }
        part->active = part->slots.first(slots);
        take(data_of(*data), {whole->now, {own.data(), {std::ssize(own)}}, *missing, *used}, *part);
    });
}

int tandem_take_all(const tandem_problem_data* data, tandem_search* whole, tandem_search* part) {
    return guarded([&] { take_all(data_of(*data), *whole, *part); });
}

int tandem_take_best(const tandem_problem_data* data, tandem_search* search) {
    return guarded([&] { take_best(data_of(*data), *search); });
}

int tandem_add_routes(const tandem_problem_data* data, tandem_search* whole, tandem_search* part,
                      bool best, bool alone) {
    return guarded([&] {
        if (best) return add_best(*whole, *part, alone);
        add_routes(data_of(*data), *whole, *part, alone);
    });
}
