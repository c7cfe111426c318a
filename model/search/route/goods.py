"""Goods that must not be carried together: what each trip and each route bars."""

from model.kernel.compiled import inlined, spliced
from model.kernel.load import barred_on_trip, barred_on_vehicle, go_together
from model.kernel.records import Record, Records
from model.search.route.layout import CUSTOMER, Fleet, World
from model.search.route.rarer import goods_count


@inlined
def _take(goods: Record, route: Record, trip: Record) -> bool:
    """Put a customer's goods on a trip. In place; False if something there bars them."""
    if not go_together(goods, trip.barred, route.barred):
        return False
    trip.barred |= barred_on_trip(goods)
    route.barred |= barred_on_vehicle(goods)
    return True


@inlined
def take_goods(goods: Records, route: Record, stops: Records, trips: Records,
               sorties: Records) -> bool:
    """Write what the trips of a route bar, and all of it. In place; False if goods clash."""
    route.barred = 0
    for index in range(route.trips):
        trips[index].barred = 0
    for p in range(route.length):
        if stops[p].kind == CUSTOMER and not _take(goods[stops[p].node], route,
                                                   trips[stops[p].trip]):
            return False
    for s in range(route.sorties):
        for visit in range(sorties[s].count):
            if not _take(goods[sorties[s].nodes[visit]], route,
                         trips[stops[sorties[s].launch].trip]):
                return False
    return True


@spliced
def goods_may_join(world: World, fleet: Fleet, slot: int, trip: int, node: int) -> bool:
    """Tell whether a customer's goods may go on a trip."""
    return not goods_count(world) or go_together(
        world.goods[node], fleet.trip[slot, trip].barred, fleet.route[slot].barred)


@spliced
def goods_may_follow(world: World, fleet: Fleet, slot: int, node: int) -> bool:
    """Tell whether a customer's goods may go on another trip of a route."""
    return not goods_count(world) or go_together(world.goods[node], 0,
                                                      fleet.route[slot].barred)
