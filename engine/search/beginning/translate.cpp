#include "rules/hub.h"
#include "search/beginning/plans.h"
#include "search/insertion/alone.h"
#include "search/moves/exchanges.h"
#include "search/route/fairness.h"
#include "search/route/freshness.h"
#include "search/route/lags.h"
#include "search/route/refresh.h"
#include "search/search.h"

namespace tandem {

namespace {

// Where ways cost less than this share of what a later end does, the end is all that counts.
constexpr double next_to_nothing = 0.01;

// Let a route be as it is given or, if its vehicle is charged in turn, without those trips that
// can't be flown so. In place; false if nothing is left.
bool refresh_by_trips(const ProblemData& data, const Fleet& fleet, Int slot) {
    Route& route = fleet.route[slot];
    if (!shares_chargers(data.type[route.type])) return refresh(data, fleet, slot);
    if (refresh_as_planned(data, fleet, slot)) return true;
    const Int spare = fleet.route.size() - 2;
    keep_aside(fleet, slot, spare);
    if (refresh(data, fleet, slot)) return true;
    route.length = route.sorties = route.trips = 0;
    Int first = 0;
    bool done = false;
    for (Int p = 0; p < fleet.route[spare].length; ++p) {
        if (fleet.stop(spare, p).kind != end_stop) continue;
        const Int before = route.length;
        const bool fits = append(fleet, spare, first, p + 1, slot);
        first = p + 1;
        if (fits && refresh(data, fleet, slot)) {
            done = true;
            continue;
        }
        route.length = before;
        done = before > 0 && refresh(data, fleet, slot);
    }
    return done;
}

// Time a route whose trips begin as late as costs nothing. In place; false if no way was found.
bool time_anew(const ProblemData& data, Fleet& fleet, Int slot) {
    const Tour tour = tour_of(fleet, slot);
    const VehicleType& type = data.type[tour.route.type];
    if (orders_cross(data) || shares_chargers(type)) {
        load_trips(data, tour);
        keep_starts(data, tour);
        return drive_forward(data, tour);
    }
    if (hangs_on_begin(type)) {
        bool settled = false;
        return price_as_is(data, fleet, slot, no_bar, settled) && (settled || settle(data, tour));
    }
    load_trips(data, tour);
    clear_holds(tour);
    if (!drive_forward(data, tour)) return false;
    if (holds_count(data, tour.route.type) && !hold_trips(data, tour) &&
        !drive_forward(data, tour)) {
        return false;
    }
    return settle(data, tour);
}

// Prices a route for one customer alone by each type, driven and flown. A slot is scratch.
void price_alone(const ProblemData& data, Fleet& fleet, Int node, const View<double, 3>& alone) {
    const Int slot = fleet.route.size() - 1;
    for (Int k = 0; k < data.num_types; ++k) {
        for (Int by_drone = 0; by_drone < 2; ++by_drone) {
            // Of a shipment, drones may serve another end.
            const bool may_be = data.can(k, is_paired(data.pair, node) ? 0 : by_drone, node);
            const bool is_served = may_be && !is_other_end(data.pair, node) &&
                                   !data.deadline.passed() &&
                                   serve_alone(data, fleet, slot, k, node, by_drone == 1);
            alone(k, by_drone, node) = is_served ? fleet.cost[slot] : infeasible;
        }
    }
}

}  // namespace

void begin(const ProblemData& data, Searcher& searcher, Int num_routes) {
    const Fleet& now = searcher.now;
    SearchCounts& count = *searcher.count;
    for (Int node = 0; node < data.num_nodes; ++node) now.where[node].slot = nowhere;
    double cost = 0.0;
    Int kept = 0;  // relations of who is on routes before, none of whom others may join
    for (Int slot = 0; slot < num_routes; ++slot) {
        data.deadline.go_on_late();
        Route& route = now.route[slot];
        if (refresh_by_trips(data, now, slot) && (route.kept & kept) == 0) {
            kept |= route.kept;
            ++now.used[route.type];
            cost += now.cost[slot];
            locate(now, slot);
        } else {
            route.length = route.sorties = route.trips = 0;
            now.cost[slot] = 0.0;
        }
    }
    count.customers = 0;
    for (Int node = data.num_depots; node < data.num_nodes; ++node) {
        const Int unit = unit_of(data.pair, node);
        if (unit == node || is_other_end(data.pair, node)) ++count.customers;
        if (unit == node && now.where[served_place(data, now, node)].slot == nowhere) {
            searcher.missing.at(count.missing++) = node;
        }
    }
    for (Int slot = 0; slot < searcher.active.size(); ++slot) now.route[slot].stamp = 1;
    count.stamp = 1;
    count.changed = all_slots;
    list_active(searcher);
    searcher.value->cost =
        cost + left_out_cost(data, searcher.missing, count.missing) + plan_cost(data, searcher);
    keep_best(searcher);
}

double leg_cost(const ProblemData& data, const Searcher& searcher) {
    const Fleet& now = searcher.now;
    double cost = 0.0, by_end = 0.0;
    Int legs = 0, used = 0;
    for (Int slot = 0; slot < searcher.active.size(); ++slot) {
        const Rate& rate = data.rate[now.route[slot].type];
        const View<Stop, 1> stops = now.stop[slot];
        used += now.route[slot].length > 0;
        for (Int p = 0; p < now.route[slot].length - 1; ++p) {
            if (stops[p].kind != customer_stop || stops[p + 1].kind != customer_stop) continue;
            cost += drive_cost(rate, stops[p].leg) + usual_work_cost(rate, stops[p].gap);
            by_end += data.fairness.makespan * double(stops[p].gap);
            ++legs;
        }
    }
    // Where all vehicles end alike, the last end is later by each one's share.
    by_end /= double(std::max(Int{1}, used));
    if (cost < next_to_nothing * by_end) cost = by_end;
    if (cost > 0.0) return cost / double(legs);
    const double left_out = left_out_cost(data, searcher.missing, searcher.count->missing);
    return std::max(1e-9, (searcher.value->cost - left_out) / double(data.num_nodes));
}

bool finish_route(const ProblemData& data, Fleet& fleet, Int slot) {
    const VehicleType& type = data.type[fleet.route[slot].type];
    if (!is_timed_slowly(type)) {
        return time_anew(data, fleet, slot);
    }
    const Int spare = fleet.route.size() - 1;
    copy_route(fleet, slot, fleet, spare);
    if (!time_anew(data, fleet, slot)) {
        // Of the ways to rest while drones fly few are followed, which may be others now: it is
        // driven as it was timed.
        copy_route(fleet, spare, fleet, slot);
    }
    return true;
}

}  // namespace tandem

using namespace tandem;

extern "C" int tandem_begin(const tandem_problem_data* data, tandem_search* search,
                            const tandem_i64_1d* numbers) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        std::fill_n(search->alone.data(), 2 * search->alone.shape(0) * problem.num_nodes,
                    infeasible);
        for (Int node = problem.num_depots; node < problem.num_nodes; ++node) {
            price_alone(problem, search->now, node, search->alone);
        }
        begin(problem, *search, read_plan(search->now, *numbers));
    });
}

extern "C" int tandem_price_alone(const tandem_problem_data* data, tandem_search* search,
                                  int64_t node) {
    return guarded([&] { price_alone(data_of(*data), search->now, node, search->alone); });
}

extern "C" int tandem_leg_cost(const tandem_problem_data* data, tandem_search* search, double* cost,
                               double* missing) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        *cost = leg_cost(problem, *search);
        *missing = missing_cost(problem, *search);
    });
}
