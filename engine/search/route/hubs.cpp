#include "search/route/hubs.h"

#include "rules/hub.h"
#include "search/route/rarer.h"

namespace tandem {
namespace {

// Call `visit` with the slot and the depot of each battery that routes take.
template <class Visit>
void for_each_battery(const ProblemData& data, const Fleet& fleet, const Visit& visit) {
    for (Int slot = 0; slot < fleet.route.size() - scratch_slots; ++slot) {
        const Route& route = fleet.route[slot];
        if (route.length == 0 || !takes_batteries(data.type[route.type])) continue;
        for (const Stop& stop : stops_of(fleet, slot)) {
            if (stop.kind == start_stop) visit(slot, stop.node);
        }
    }
}

// Return how many batteries of a depot the routes take.
Int batteries_taken(const ProblemData& data, const Fleet& fleet, Int depot) {
    Int taken = 0;
    for_each_battery(data, fleet, [&](Int, Int node) { taken += node == depot; });
    return taken;
}

}  // namespace

void count_batteries(const ProblemData& data, const Fleet& fleet, View<Int, 2> taken) {
    if (!hubs_count(data)) return;
    for_each_battery(data, fleet, [&](Int slot, Int depot) { ++taken(slot, depot); });
}

bool may_take_off(const ProblemData& data, const Fleet& fleet, Int k, Int depot) {
    if (!hubs_count(data)) return true;
    const VehicleType& type = data.type[k];
    const Hub& begun = data.hub[depot];
    return !takes_batteries(type) || begun.batteries >= unlimited ||
           has_battery_for(type, begun, batteries_taken(data, fleet, depot));
}

bool may_take_off_again(const ProblemData& data, const Fleet& fleet, Int k) {
    for (Int node = 0; node < data.num_depots; ++node) {
        if (data.reload(k, node) && may_take_off(data, fleet, k, node)) return true;
    }
    return false;
}

bool has_batteries(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Route& route = fleet.route[slot];
    if (!hubs_count(data) || slot >= fleet.route.size() - scratch_slots ||
        !takes_batteries(data.type[route.type])) {
        return true;
    }
    const View<const Trip, 1> trips = trips_of(fleet, slot);
    return std::ranges::all_of(trips, [&](const Trip& trip) {
        const Int depot = fleet.stop(slot, trip.first).node, stock = data.hub[depot].batteries;
        return stock >= unlimited || batteries_taken(data, fleet, depot) <= stock;
    });
}

}  // namespace tandem
