#include "randomness.h"
#include "rules/launch_place.h"
#include "search/moves/exchanges.h"
#include "search/route/refresh.h"
#include "search/route/stop_loads.h"
#include "search/route/vehicles.h"

namespace tandem {
namespace {

constexpr double least_saving = 1e-9;  // by less, nothing is cheaper

// Swap vehicles with another route where that is cheaper. In place.
void trade(const ProblemData& data, Searcher& searcher, Int slot) {
    Fleet& now = searcher.now;
    for (Int other : searcher.active.first(searcher.count->active)) {
        const Int k = now.route[slot].type;
        const Int by = now.route[other].type;
        if (by == k || !data.swap(k, by)) continue;
        const double cost = route_cost(data, by, haul_of(now.trip(slot, 0))) +
                            route_cost(data, k, haul_of(now.trip(other, 0)));
        if (cost < now.cost[slot] + now.cost[other] - least_saving &&
            can_take(data, now, slot, by) && can_take(data, now, other, k)) {
            touch(searcher, other);
            change_type(data, now, slot, by);
            change_type(data, now, other, k);
        }
    }
}

// Tell whether the drones of type `k` may fly a sortie of a truck.
bool may_fly(const ProblemData& data, Int k, const Sortie& sortie) {
    const Int row = row_of_drone(data.type, k, sortie.drone);
    if (sortie.drone >= data.type[k].drones || sortie.count > data.visits[row] ||
        !can_carry(data, row, sortie, nowhere, nowhere)) {
        return false;
    }
    for (const Int node : sortie.customers()) {
        if (!data.can(row, 1, node)) return false;
    }
    return true;
}

// Tell whether type `k` has the places, trips, drones and skills that a route needs.
bool may_drive(const ProblemData& data, const Fleet& fleet, Int slot, Int k) {
    const Route& route = fleet.route[slot];
    const VehicleType& former = data.type[route.type];
    const VehicleType& type = data.type[k];
    if (type.begins_at != former.begins_at || type.ends_at != former.ends_at ||
        route.trips > type.max_trips || (route.trips > 1 && type.depot != former.depot)) {
        return false;
    }
    for (const Stop& stop : stops_of(fleet, slot)) {
        if (stop.kind == customer_stop && !data.can(k, 0, stop.node)) return false;
        if (stop.kind == halt_stop && !may_halt(data.halts, k, stop.node)) return false;
    }
    for (const Sortie& sortie : sorties_of(fleet, slot)) {
        if (!may_fly(data, k, sortie)) return false;
    }
    return true;
}

// Let another type drive a touched route, if that keeps all rules. In place.
//
// `cheaper`: and only if it costs less.
void give_type(const ProblemData& data, Searcher& searcher, Int slot, Int k, bool cheaper) {
    Fleet& now = searcher.now;
    const Int former = now.route[slot].type;
    const double cost = now.cost[slot];
    if (k == former || data.swap(former, k) || !is_left(data, now, k) ||
        !may_drive(data, now, slot, k)) {
        return;
    }
    const Int spare = now.route.size() - 2;
    set_aside(data, now, slot, spare);
    now.route[slot].type = k;
    if (refresh(data, now, slot) && !(cheaper && now.cost[slot] >= cost - least_saving)) {
        --now.used[former];
        ++now.used[k];
    } else {
        put_back(data, now, slot, spare);
    }
}

}  // namespace

void improve_types(const ProblemData& data, Searcher& searcher) {
    Fleet& now = searcher.now;
    // Trading touches others, which get the cheapest vehicles in their turn.
    for (Int index = 0; index < searcher.count->touched; ++index) {
        const Int slot = searcher.touched[index];
        const Route& route = now.route[slot];
        if (route.length == 0 || !data.evaluation[route.type].by_distance) continue;
        const Haul haul = haul_of(now.trip(slot, 0));
        for (Int k = 0; k < data.num_types; ++k) {
            if (data.swap(route.type, k) && is_left(data, now, k) &&
                route_cost(data, k, haul) < now.cost[slot] - least_saving &&
                can_take(data, now, slot, k)) {
                change_type(data, now, slot, k);
            }
        }
        trade(data, searcher, slot);
    }
}

void draw_type(const ProblemData& data, Searcher& searcher) {
    const Int slot = searcher.touched[below(searcher.rng, searcher.count->touched)];
    if (searcher.now.route[slot].length > 0) {
        give_type(data, searcher, slot, below(searcher.rng, data.num_types), false);
    }
}

void cheapen_types(const ProblemData& data, Searcher& searcher) {
    for (Int slot : searcher.touched.first(searcher.count->touched)) {
        if (searcher.now.route[slot].length == 0) continue;
        for (Int k = 0; k < data.num_types; ++k) {
            if (data.deadline.passed()) return;
            give_type(data, searcher, slot, k, true);
        }
    }
}

}  // namespace tandem
