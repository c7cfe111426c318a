"""What vehicles of each type hold and lift, and what a lean route costs by each."""

import math

from model.kernel.compiled import inlined, spliced
from model.kernel.instance import (
    MAX_DIMENSIONS, NODE_DEMAND, RATE_FIXED, RATE_KM, TYPE_CAPACITY, TYPE_COUNT, TYPE_PAYLOAD,
)
from model.problem import IntArray
from model.search.route.layout import (
    F_COUNT, F_NODE, NOWHERE, R_TYPE, T_DISTANCE, T_LOAD, Fleet, World,
)


@spliced
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
            load = trip[T_LOAD + dimension] + world.place[node, NODE_DEMAND + dimension]
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


@spliced
def lifts(world: World, sortie: IntArray, k: int, node: int) -> bool:
    """Tell whether a type's drone lifts a customer's parcel on top of a sortie's."""
    for dimension in range(MAX_DIMENSIONS):
        payload = world.place[node, NODE_DEMAND + dimension]
        for visit in range(sortie[F_COUNT]):
            payload += world.place[sortie[F_NODE + visit], NODE_DEMAND + dimension]
        if payload > world.type[k, TYPE_PAYLOAD + dimension]:
            return False
    return True
