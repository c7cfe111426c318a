#include "search/route/goods.h"

namespace tandem {
namespace {

// Put a customer on a trip. In place; false if something there bars his goods.
bool take(const Goods& goods, Route& route, Trip& trip) {
    if (!go_together(goods, trip.barred, route.barred)) return false;
    trip.barred |= barred_on_trip(goods);
    route.barred |= barred_on_vehicle(goods);
    trip.kept |= kept_on_trip(goods);
    route.kept |= kept_by_vehicle(goods);
    return true;
}

// Tell whether customers who go on one trip are on several.
bool parts_any(View<const Trip, 1> trips) {
    Int seen = 0;
    return std::ranges::any_of(trips, [&](const Trip& trip) {
        const bool again = (seen & trip.kept) != 0;
        seen |= trip.kept;
        return again;
    });
}

}  // namespace

bool take_goods(View<const Goods, 1> goods, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    route.barred = route.kept = 0;
    for (Trip& trip : trips.first(route.trips)) trip.barred = trip.kept = 0;
    for (const Stop& stop : stops.first(route.length)) {
        if (stop.kind == customer_stop && !take(goods[stop.node], route, trips[stop.trip])) {
            return false;
        }
    }
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        Trip& trip = trips[stops[sortie.launch].trip];
        for (const Int node : sortie.customers()) {
            if (!take(goods[node], route, trip)) return false;
        }
    }
    return route.trips < 2 || !parts_any(trips.first(route.trips));
}

Int home_of(const ProblemData& data, const Searcher& searcher, Int node) {
    const Int kept = goods_count(data) ? kept_by_vehicle(data.goods[node]) : 0;
    if (kept == 0) return nowhere;
    Int home = nowhere;
    for (const Int slot : searcher.active.first(searcher.count->active)) {
        const Route& route = searcher.now.route[slot];
        if (route.length == 0 || (route.kept & kept) == 0) continue;
        if (home != nowhere) return elsewhere;
        home = slot;
    }
    return home;
}

namespace {

// Tell whether all shipments on a trip are whole, by its sorties among some; `node_at` tells who
// is served at each stop.
template <class NodeAt>
bool keep_pairs(const ProblemData& data, View<const Sortie, 1> sorties, const Trip& trip,
                const NodeAt& node_at) {
    // By its truck, or by another sortie than that which delivers.
    const auto comes_before = [&](Int pickup, Int behind, const Sortie* delivering) {
        for (Int p = behind - 1; p > trip.first; --p) {
            if (node_at(p) == pickup) return true;
        }
        return std::ranges::any_of(sorties, [&](const Sortie& sortie) {
            return &sortie != delivering && sortie.launch >= trip.first &&
                   sortie.recovery < behind && sortie.serves(pickup);
        });
    };
    WholePairs pairs(data.pair);
    const auto serve = [&](Int node, Int stop) {
        pairs.serve(node, [&](Int pickup) { return comes_before(pickup, stop, nullptr); });
    };
    for (Int p = trip.first + 1; p < trip.last; ++p) {
        if (node_at(p) >= 0) serve(node_at(p), p);
    }
    for (const Sortie& sortie : sorties) {
        if (sortie.launch < trip.first || sortie.launch > trip.last) continue;
        for (Int visit = 0; visit < sortie.count; ++visit) {
            pairs.serve(sortie.nodes[visit], [&](Int pickup) {
                return is_brought_within(data.pair, sortie.nodes, visit) ||
                       comes_before(pickup, sortie.launch + 1, &sortie);
            });
        }
    }
    return pairs.are_kept();
}

}  // namespace

bool keeps_pairs(const ProblemData& data, const Tour& tour) {
    const auto& [route, stops, trips, sorties] = tour;
    const View<const Trip, 1> made = trips.first(route.trips);
    const auto node_at = [&](Int p) {
        return stops[p].kind == customer_stop ? stops[p].node : nowhere;
    };
    return std::ranges::all_of(made, [&](const Trip& trip) {
        return keep_pairs(data, sorties.first(route.sorties), trip, node_at) &&
               (!is_stack(data.type[route.type]) ||
                keeps_stack(data.pair, trip.first + 1, trip.last, node_at));
    });
}

}  // namespace tandem
