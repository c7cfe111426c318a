// Who goes with whom: goods that each trip and each route bars, whom they keep together, and whole
// shipments.
#pragma once

#include "rules/company.h"
#include "search/route/rarer.h"

namespace tandem {

// Write what the trips of a route bar and keep together, and all of it. In place; false if goods
// clash, or customers are parted.
bool take_goods(View<const Goods, 1> goods, const Tour& tour);

// What a trip, or a part of one, bars and keeps together.
struct Company {
    Int barred, kept;
};

// Tell whether a customer may go with some on a trip, which is on a route or would be.
inline bool may_accompany(const Goods& goods, Company there, const Route& route) {
    return go_together(goods, there.barred, route.barred) &&
           joins_trip(goods, there.kept, route.kept);
}

// Tell whether a customer may go on a trip, by his goods and by who goes with him.
inline bool goods_may_join(const ProblemData& data, const Fleet& fleet, Int slot, Int trip,
                           Int node) {
    const Trip& on = fleet.trip(slot, trip);
    return !goods_count(data) ||
           may_accompany(data.goods[node], {on.barred, on.kept}, fleet.route[slot]);
}

// Tell whether a customer may go on another trip of a route, likewise.
inline bool goods_may_follow(const ProblemData& data, const Fleet& fleet, Int slot, Int node) {
    return !goods_count(data) || may_accompany(data.goods[node], {0, 0}, fleet.route[slot]);
}

// Return the only route that may serve a customer since others are there; `nowhere` if any may, and
// `elsewhere` if none.
Int home_of(const ProblemData& data, const Searcher& searcher, Int node);

// Tell whether each trip serves whole shipments, each picked up first, and unloads from a stack
// what lies on it.
bool keeps_pairs(const ProblemData& data, const Tour& tour);

}  // namespace tandem
