#include "search/route/stop_loads.h"

#include "rules/breaks.h"
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

namespace {

// What a sortie carries, and whether its drone may.
struct FlownCargo {
    Cargo cargo;
    bool may;
};

// Return the cargo of serving a customer by drone; a shipment that is delivered was aboard, unless
// it was fetched `within` the sortie, and with it what comes from the depot.
Cargo cargo_flown(const ProblemData& data, Int node, bool within, Int tier) {
    if (within || !is_delivery(data.pair, node)) return cargo_for(data.amount, node, tier);
    Cargo cargo = no_cargo;
    cargo.delivered = cargo.most =
        minus(delivered_of(data.amount, node, tier), picked_of(data.amount, node, tier));
    cargo.total_delivered = total_delivered(data.amount, node);
    return cargo;
}

// Let shipments that a sortie delivers leave the truck where it is launched. In place.
void unload_shipments(const ProblemData& data, const Sortie& sortie, StopLoad& launch, Int tier) {
    for (Int visit = 0; visit < sortie.count; ++visit) {
        if (!is_delivery(data.pair, sortie.nodes[visit]) ||
            is_brought_within(data.pair, sortie.nodes, visit)) {
            continue;
        }
        // They didn't come from the depot.
        const Amount change = picked_of(data.amount, sortie.nodes[visit], tier);
        add_left(launch, change, 0);
        add_come(launch, change, 0);
    }
}

// Return the cargo of a sortie that serves a customer more before its number `place`.
//
// And whether a drone of a row `k` may carry it. `nowhere`: nobody more.
FlownCargo flown(const ProblemData& data, Int k, const Sortie& sortie, Int place, Int node,
                 Int tier) {
    const VehicleType& type = data.type[k];
    Cargo cargo = no_cargo;
    bool in_order = true;
    const auto visit = [&](Int next, bool within) {
        const Cargo more = cargo_flown(data, next, within, tier);
        in_order = in_order && may_follow(type, cargo, more);
        cargo = followed(cargo, more);
    };
    for (Int index = 0; index < sortie.count; ++index) {
        if (index == place) visit(node, false);
        visit(sortie.nodes[index], is_brought_within(data.pair, sortie.nodes, index));
    }
    if (place == sortie.count) visit(node, false);
    return {cargo, in_order && lifts(type, cargo.most, tier)};
}

// Write what leaves and comes aboard at each stop. In place; false if a drone may not fly.
bool note_amounts(const ProblemData& data, const Fleet& fleet, Int slot, Int tier) {
    const auto [route, stops, trips, sorties] = tour_of(fleet, slot);
    const View<StopLoad, 1> stop_loads = fleet.stop_load[slot][tier];
    for (Int p = 0; p < route.length; ++p) {
        StopLoad& stop_load = stop_loads[p];
        stop_load.leaves = stop_load.comes = stop_load.stacks = 0;
        write_amount(nothing, stop_load.leaving);
        write_amount(nothing, stop_load.coming);
        if (stops[p].kind != customer_stop) continue;
        const Int node = stops[p].node;
        stop_load.stacks = stacked_at(data.pair, node);
        add_left(stop_load, delivered_of(data.amount, node, tier),
                 total_delivered(data.amount, node));
        add_come(stop_load, picked_of(data.amount, node, tier), total_picked(data.amount, node));
    }
    bool allowed = true;
    for (const Sortie& sortie : sorties_of(fleet, slot)) {
        const Int row = row_of_drone(data.type, route.type, sortie.drone);
        const auto [cargo, may] = flown(data, row, sortie, nowhere, nowhere, tier);
        allowed = allowed && may;
        add_left(stop_loads[sortie.launch], cargo.delivered, cargo.total_delivered);
        add_come(stop_loads[sortie.recovery], cargo.picked, cargo.total_picked);
        if (some_paired(data.pair)) {
            unload_shipments(data, sortie, stop_loads[sortie.launch], tier);
        }
    }
    return allowed;
}

// Note the breaks that can't be taken behind stops of a trip, `behind` not among them. In place.
void note_heavy(const VehicleType& type, View<Stop, 1> stops, View<const StopLoad, 1> stop_loads,
                Int first, Int behind, Int tier) {
    Amount load = nothing;
    for (Int p = first; p < behind; ++p) load = plus(load, amount_of(stop_loads[p].leaving));
    for (Int p = first; p < behind; ++p) {
        load = plus(minus(load, amount_of(stop_loads[p].leaving)), amount_of(stop_loads[p].coming));
        if (tier == 0) stops[p].heavy = 0;
        stops[p].heavy |= too_heavy_for(type, load, tier);
    }
}

}  // namespace

bool can_carry(const ProblemData& data, Int k, const Sortie& sortie, Int place, Int node) {
    if (tiers_of(data) == 0) {
        Amount load = place >= 0 ? demand_of(data.place[0][node]) : nothing;
        for (const Int node : sortie.customers()) load = plus(load, demand_of(data.place[0][node]));
        return lifts(data.type[k], load, 0);
    }
    for (Int tier = 0; tier < tiers_of(data); ++tier) {
        if (!flown(data, k, sortie, place, node, tier).may) return false;
    }
    return true;
}

bool weigh(const ProblemData& data, const Fleet& fleet, Int slot) {
    const auto [route, stops, trips, sorties] = tour_of(fleet, slot);
    const VehicleType& type = data.type[route.type];
    bool allowed = true;
    for (Int tier = 0; tier < tiers_aboard(fleet); ++tier) {
        allowed = note_amounts(data, fleet, slot, tier) && allowed;
        const View<StopLoad, 1> stop_loads = fleet.stop_load[slot][tier];
        Int first = 0, driven = 0;
        for (Int p = 0; p < route.length; ++p) {
            if (stops[p].kind == start_stop) {
                first = p;
                driven = 0;
            }
            stop_loads[p].driven = driven;
            driven += stops[p].leg;
            if (p + 1 == route.length || stops[p + 1].kind == start_stop) {
                allowed = weigh_trip(type, &stop_loads[first], &stop_loads[p] + 1, tier) && allowed;
                if (has_breaks(type)) note_heavy(type, stops, stop_loads, first, p + 1, tier);
            }
        }
    }
    return allowed;
}

double load_cost(const ProblemData& data, const Fleet& fleet, Int slot) {
    const Int k = fleet.route[slot].type;
    const View<const StopLoad, 1> stop_loads = fleet.stop_load[slot][0];
    double carried = 0.0;
    for (Int p = 0; p < fleet.route[slot].length; ++p) {
        const Int load = stop_loads[p].aboard[0] + data.type[k].carried;
        carried += double(load) * double(fleet.stop(slot, p).leg);
    }
    return load_cost(data.rate[k], carried);
}

double load_more(const ProblemData& data, const Fleet& fleet, Int slot, Int left, Int came,
                 Int node) {
    const View<const StopLoad, 1> stop_loads = fleet.stop_load[slot][0];
    const Trip& trip = fleet.trip(slot, fleet.stop(slot, left).trip);
    const Int parcel = delivered_of(data.amount, node, 0)[0];
    const Int taken = picked_of(data.amount, node, 0)[0];
    const double carried = double(parcel) * double(stop_loads[left].driven) +
                           double(taken) * double(trip.distance - stop_loads[came].driven);
    return load_cost(data.rate[fleet.route[slot].type], carried);
}

double load_more_behind(const ProblemData& data, const Fleet& fleet, Int slot, Int p, Int node,
                        const Detour& detour) {
    const Int k = fleet.route[slot].type;
    const Int parcel = delivered_of(data.amount, node, 0)[0];
    const Int taken = picked_of(data.amount, node, 0)[0];
    const Int load = fleet.stop_load(slot, 0, p).aboard[0] + data.type[k].carried;
    const double legs = double(load) * double(detour.distance) +
                        double(parcel) * double(detour.out.distance) +
                        double(taken) * double(detour.on.distance);
    return load_more(data, fleet, slot, p, p + 1, node) + load_cost(data.rate[k], legs);
}

bool can_take(const ProblemData& data, const Fleet& fleet, Int slot, Int k) {
    const VehicleType& type = data.type[k];
    if (!may_make(type, fleet.trip(slot, 0))) return false;
    for (Int tier = 0; tier < tiers_aboard(fleet); ++tier) {
        if (!holds_in(type, most_of(fleet.stop_load(slot, tier, 0)), tier)) return false;
    }
    return true;
}

}  // namespace tandem
