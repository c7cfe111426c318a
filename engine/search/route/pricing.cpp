#include "search/route/pricing.h"

#include "rules/hub.h"
#include "search/route/charging.h"
#include "search/route/freshness.h"
#include "search/route/lags.h"
#include "search/route/stop_loads.h"

namespace tandem {
namespace {

// Return when truck or drone first leaves the depot on a settled route.
Int settled_departure(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                      View<const Sortie, 1> sorties) {
    return counted_from(data.type[route.type], departure_of(data, route, stops, sorties, 0));
}

// Tell whether a route with drones works too long unless it begins later than it could.
//
// Whether they then come in the order that its times were found by has to be seen.
bool has_to_wait(const ProblemData& data, const Route& route, View<const Stop, 1> stops,
                 View<const Sortie, 1> sorties) {
    if (route.sorties == 0) return false;
    const Int soonest = settled_departure(data, route, stops, sorties);
    return !may_work(data.type[route.type], route.end - soonest - route.unpaid);
}

}  // namespace

bool price_timed(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    const View<Trip, 1> trips = fleet.trip[slot];
    const View<Sortie, 1> sorties = fleet.sortie[slot];
    const VehicleType& type = data.type[route.type];
    const bool held_back = data.evaluation[route.type].held_back;
    Int departure = first_departure(data, route, stops, sorties);
    settled = held_back || has_to_wait(data, route, stops, sorties);
    if (settled) {
        if (!settle(data, route, stops, trips, sorties)) return false;
        departure = settled_departure(data, route, stops, sorties);
    }
    if (lags_count(data) && !keeps_all_lags(data, route, stops, sorties)) return false;
    route.working = route.end - departure - route.unpaid;
    if (!may_work(type, route.working)) return false;
    const auto [cost, early] = price_route(data, route, stops, trips, sorties);
    fleet.cost[slot] = cost;
    if (loads_cost(data, route.type)) fleet.cost[slot] += load_cost(data, fleet, slot);
    fleet.early[slot] = held_back ? early : 0.0;
    return true;
}

bool price_driven(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    const View<Trip, 1> trips = fleet.trip[slot];
    const View<Sortie, 1> sorties = fleet.sortie[slot];
    const VehicleType& type = data.type[route.type];
    if (holds_count(data, route.type) && !hold_trips(data, route, stops, trips, sorties)) {
        return false;
    }
    if (shares_chargers(type) && !charge_in_turn(data, fleet, slot)) return false;
    return price_timed(data, fleet, slot, settled);
}

bool price_loaded(const ProblemData& data, const Fleet& fleet, Int slot, bool& settled) {
    Route& route = fleet.route[slot];
    const View<Stop, 1> stops = fleet.stop[slot];
    clear_holds(route, stops, fleet.trip[slot]);
    return drive_forward(data, route, stops, fleet.sortie[slot]) &&
           price_driven(data, fleet, slot, settled);
}

}  // namespace tandem
