#include "search/route/goods.h"

namespace tandem {
namespace {

// Put a customer's goods on a trip. In place; false if something there bars them.
bool take(const Goods& goods, Route& route, Trip& trip) {
    if (!go_together(goods, trip.barred, route.barred)) return false;
    trip.barred |= barred_on_trip(goods);
    route.barred |= barred_on_vehicle(goods);
    return true;
}

}  // namespace

bool take_goods(View<const Goods, 1> goods, Route& route, View<const Stop, 1> stops,
                View<Trip, 1> trips, View<const Sortie, 1> sorties) {
    route.barred = 0;
    for (Trip& trip : trips.first(route.trips)) trip.barred = 0;
    for (const Stop& stop : stops.first(route.length)) {
        if (stop.kind == customer_stop && !take(goods[stop.node], route, trips[stop.trip])) {
            return false;
        }
    }
    for (const Sortie& sortie : sorties.first(route.sorties)) {
        Trip& trip = trips[stops[sortie.launch].trip];
        for (Int visit = 0; visit < sortie.count; ++visit) {
            if (!take(goods[sortie.nodes[visit]], route, trip)) return false;
        }
    }
    return true;
}

}  // namespace tandem
