#include "search/route/ends.h"

#include "rules/leg.h"

namespace tandem {

void place_ends(const World& world, Int k, const Route& route, View<Stop, 1> stops) {
    const VehicleType& type = world.type[k];
    stops[0].node = type.begins_at;
    for (Int p = 1; p < route.length - 1; ++p) {
        if (stops[p].kind != end_stop) continue;
        if (!world.reload(k, stops[p].node)) stops[p].node = type.depot;
        stops[p + 1].node = stops[p].node;
    }
    stops[route.length - 1].node = type.ends_at;
}

Reload nearest_reload(const World& world, Int k, Int before, Int behind) {
    const TravelLegs legs = legs_of(world.leg, world.type[k].travel);
    const auto distance_by = [&](Int node) {
        return leg(legs, before, node).distance + leg(legs, node, behind).distance;
    };
    const Int depot = world.type[k].depot;
    Reload best{distance_by(depot), depot};
    for (Int node = 0; node < world.num_depots; ++node) {
        if (!world.reload(k, node)) continue;
        const Int distance = distance_by(node);
        if (distance < best.distance) best = {distance, node};
    }
    return best;
}

Int detour_by_reload(const World& world, Int k, Int before, Int node, Int behind, bool first) {
    const TravelLegs legs = legs_of(world.leg, world.type[k].travel);
    const Int direct = leg(legs, before, behind).distance;
    if (first) {
        return leg(legs, before, node).distance + nearest_reload(world, k, node, behind).distance -
               direct;
    }
    return nearest_reload(world, k, before, node).distance + leg(legs, node, behind).distance -
           direct;
}

}  // namespace tandem
