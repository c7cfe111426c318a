"""Another type of vehicle for a route."""

import math

from model.compiled import inlined
from model.instance import MAX_DIMENSIONS, RATE_FIXED, RATE_KM, TYPE_CAPACITY, TYPE_COUNT
from model.problem import IntArray
from model.search.layout import (
    MODE_LEAN, NOWHERE, P_DEMAND, R_LENGTH, R_TYPE, T_DISTANCE, T_LOAD, Fleet, World,
)
from model.search.state import I_ACTIVE, I_TOUCHED, Searcher, touch


@inlined
def route_cost(world: World, k: int, distance: int) -> float:
    """Return the cost of a lean route by a vehicle of type `k`."""
    return world.rate[k, RATE_FIXED] + distance * world.rate[k, RATE_KM]


@inlined
def holds(world: World, k: int, trip: IntArray) -> bool:
    """Tell whether a vehicle of type `k` holds the load of a trip."""
    for dimension in range(MAX_DIMENSIONS):
        if trip[T_LOAD + dimension] > world.type[k, TYPE_CAPACITY + dimension]:
            return False
    return True


@inlined
def larger_type(world: World, fleet: Fleet, slot: int, node: int) -> int:
    """Return the type for which a route would be exchanged to take a customer more.

    The cheapest that is left and holds them all; NOWHERE if there is none.
    """
    k, trip = fleet.route[slot, R_TYPE], fleet.trip[slot, 0]
    chosen, best = NOWHERE, math.inf
    for other in range(world.num_types):
        if (not world.swap[k, other] or other == k or not world.can[other, 0, node]
                or fleet.used[other] >= world.type[other, TYPE_COUNT]):
            continue
        cost = route_cost(world, other, trip[T_DISTANCE])
        fits = cost < best
        for dimension in range(MAX_DIMENSIONS):
            load = trip[T_LOAD + dimension] + world.place[node, P_DEMAND + dimension]
            fits = fits and load <= world.type[other, TYPE_CAPACITY + dimension]
        if fits:
            chosen, best = other, cost
    return chosen


@inlined
def change_type(world: World, fleet: Fleet, slot: int, k: int) -> None:
    """Let a vehicle of another type drive a lean route. In place."""
    fleet.used[fleet.route[slot, R_TYPE]] -= 1
    fleet.used[k] += 1
    fleet.route[slot, R_TYPE] = k
    fleet.cost[slot] = route_cost(world, k, fleet.trip[slot, 0, T_DISTANCE])


@inlined
def trade(world: World, searcher: Searcher, slot: int) -> None:
    """Swap vehicles with another route where that is cheaper. In place."""
    now = searcher.now
    for index in range(searcher.count[I_ACTIVE]):
        other = searcher.active[index]
        k, by = now.route[slot, R_TYPE], now.route[other, R_TYPE]
        if by == k or not world.swap[k, by]:
            continue
        cost = (route_cost(world, by, now.trip[slot, 0, T_DISTANCE])
                + route_cost(world, k, now.trip[other, 0, T_DISTANCE]))
        if (cost < now.cost[slot] + now.cost[other] - 1e-9 and holds(world, by, now.trip[slot, 0])
                and holds(world, k, now.trip[other, 0])):
            touch(searcher, other)
            change_type(world, now, slot, by)
            change_type(world, now, other, k)


@inlined
def improve_types(world: World, searcher: Searcher) -> None:
    """Give the routes touched this turn the cheapest vehicles left, or others'. In place."""
    now = searcher.now
    for index in range(searcher.count[I_TOUCHED]):
        slot = searcher.touched[index]
        if now.route[slot, R_LENGTH] == 0 or not world.mode[now.route[slot, R_TYPE]] & MODE_LEAN:
            continue
        trip = now.trip[slot, 0]
        for k in range(world.num_types):
            if (world.swap[now.route[slot, R_TYPE], k]
                    and now.used[k] < world.type[k, TYPE_COUNT]
                    and route_cost(world, k, trip[T_DISTANCE]) < now.cost[slot] - 1e-9
                    and holds(world, k, trip)):
                change_type(world, now, slot, k)
        trade(world, searcher, slot)
