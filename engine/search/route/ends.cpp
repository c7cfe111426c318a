#include "search/route/ends.h"

namespace tandem {

void place_ends(const ProblemData& data, Int k, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const VehicleType& type = data.type[k];
    stops[0].node = type.begins_at;
    for (Int p = 1; p < route.length - 1; ++p) {
        if (stops[p].kind != end_stop) continue;
        if (!data.reload(k, stops[p].node)) stops[p].node = type.depot;
        stops[p + 1].node = stops[p].node;
    }
    stops[route.length - 1].node = type.ends_at;
}

Reload nearest_reload(const ProblemData& data, Int k, Int before, Int behind) {
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    const auto distance_by = [&](Int node) {
        return leg(legs, before, node).distance + leg(legs, node, behind).distance;
    };
    const Int depot = data.type[k].depot;
    Reload best{distance_by(depot), depot};
    for (Int node = 0; node < data.num_depots; ++node) {
        if (!data.reload(k, node)) continue;
        const Int distance = distance_by(node);
        if (distance < best.distance) best = {distance, node};
    }
    return best;
}

Int detour_by_reload(const ProblemData& data, Int k, Int before, Int node, Int behind, bool first) {
    const TravelLegs legs = legs_of(data.leg, data.type[k].travel);
    const Int direct = leg(legs, before, behind).distance;
    if (first) {
        return leg(legs, before, node).distance + nearest_reload(data, k, node, behind).distance -
               direct;
    }
    return nearest_reload(data, k, before, node).distance + leg(legs, node, behind).distance -
           direct;
}

}  // namespace tandem
