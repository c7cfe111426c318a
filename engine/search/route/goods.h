// Goods that must not be carried together: what each trip and each route bars.
#pragma once

#include "rules/load.h"
#include "search/route/layout.h"
#include "search/route/rarer.h"

namespace tandem {

// Write what the trips of a route bar, and all of it. In place; false if goods clash.
bool take_goods(View<const Goods, 1> goods, Route& route, View<const Stop, 1> stops,
                View<Trip, 1> trips, View<const Sortie, 1> sorties);

// Tell whether a customer's goods may go on a trip.
inline bool goods_may_join(const ProblemData& data, const Fleet& fleet, Int slot, Int trip,
                           Int node) {
    return !goods_count(data) ||
           go_together(data.goods[node], fleet.trip(slot, trip).barred, fleet.route[slot].barred);
}

// Tell whether a customer's goods may go on another trip of a route.
inline bool goods_may_follow(const ProblemData& data, const Fleet& fleet, Int slot, Int node) {
    return !goods_count(data) || go_together(data.goods[node], 0, fleet.route[slot].barred);
}

}  // namespace tandem
