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
    const Int travel = data.type[k].travel;
    // There are few such places, so their rows stay in the cache.
    const auto distance_by = [&](Int node) {
        return distance_from(legs_to(data.back, travel, node), before) +
               distance_to(legs_from(data.leg, travel, node), behind);
    };
    const Int depot = data.type[k].depot;
    Reload best{distance_by(depot), depot};
    if (!is_apart(data, k)) return best;
    for (Int node = 0; node < data.num_depots; ++node) {
        if (!data.reload(k, node)) continue;
        const Int distance = distance_by(node);
        if (distance < best.distance) best = {distance, node};
    }
    return best;
}

Int way_by_reload(const ProblemData& data, Int k, Int before, Int node, Int behind, bool first) {
    const Int travel = data.type[k].travel;
    if (first) {
        return distance_from(legs_to(data.back, travel, node), before) +
               nearest_reload(data, k, node, behind).distance;
    }
    return nearest_reload(data, k, before, node).distance +
           distance_to(legs_from(data.leg, travel, node), behind);
}

}  // namespace tandem
