#include "search/route/vehicles.h"

namespace tandem {

bool may_launch(const VehicleType& type, const Route& route, View<const Sortie, 1> sorties,
                const Trip& trip) {
    if (allows_sorties(type, route.sorties + 1)) return true;
    Int count = 1;
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        if (trip.first <= sortie.launch && sortie.launch <= trip.last) ++count;
    }
    return allows_sorties(type, count);
}

Int num_flown(View<const VehicleType, 1> types, Int k, View<const Sortie, 1> sorties, Int first,
              Int behind, Int row) {
    Int count = 0;
    for (Int s = first; s < behind; ++s) {
        if (row_of_drone(types, k, sorties[s].drone) == row) ++count;
    }
    return count;
}

bool have_batteries(View<const VehicleType, 1> types, Int k, View<const Sortie, 1> sorties,
                    Int first, Int behind) {
    if (!are_several(types[k])) return true;
    for (Int row = first_drone_row(types, k); row >= 0; row = next_drone_row(types, row)) {
        if (!allows_sorties(types[row], num_flown(types, k, sorties, first, behind, row))) {
            return false;
        }
    }
    return true;
}

bool has_battery(View<const VehicleType, 1> types, const Route& route,
                 View<const Sortie, 1> sorties, const Trip& trip, Int row) {
    if (!are_several(types[route.type])) return true;
    Int first = 0;
    while (first < route.sorties && sorties[first].launch < trip.first) ++first;
    Int behind = first;
    while (behind < route.sorties && sorties[behind].launch <= trip.last) ++behind;
    const Int flown = num_flown(types, route.type, sorties, first, behind, row);
    return allows_sorties(types[row], flown + 1);
}

Int launch_changed(const VehicleType& type, const Route& route, View<const Sortie, 1> sorties,
                   const Trip& trip, Int p, bool is_sortie) {
    if (!launches_differ(type)) return nowhere;
    const Int first = is_sortie ? trip.first : p + 1;
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        if (first <= sortie.launch && sortie.launch <= trip.last) return sortie.launch;
    }
    return nowhere;
}

bool may_fit_in_tiers(const ProblemData& data, const Fleet& fleet, Int slot, Int index, Int k,
                      Int node) {
    const VehicleType& type = data.type[k];
    const Trip& trip = fleet.trip(slot, index);
    for (Int tier = 0; tier < tiers_aboard(fleet); ++tier) {
        const View<const StopLoad, 1> stop_loads = fleet.stop_load[slot][tier];
        const Amount taken =
            plus(amount_of(stop_loads[trip.last].behind), picked_of(data.amount, node, tier));
        if (!holds_in(type, taken, tier) ||
            !holds_in(type, most_of(stop_loads[trip.first]), tier)) {
            return false;
        }
    }
    return true;
}

void change_type(const ProblemData& data, const Fleet& fleet, Int slot, Int k) {
    --fleet.used[fleet.route[slot].type];
    ++fleet.used[k];
    fleet.route[slot].type = k;
    fleet.cost[slot] = route_cost(data, k, haul_of(fleet.trip(slot, 0)));
}

}  // namespace tandem
