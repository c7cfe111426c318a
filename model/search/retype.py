"""Another type of vehicle for a route."""

import math

from model.alarm import rung
from model.compiled import inlined, spliced
from model.instance import (
    MAX_DIMENSIONS, RATE_FIXED, RATE_KM, TYPE_CAPACITY, TYPE_COUNT, TYPE_DEPOT, TYPE_DRONES,
    TYPE_MAX_TRIPS, TYPE_PAYLOAD,
)
from model.problem import IntArray
from model.search.draw import below
from model.search.layout import (
    CUSTOMER, F_COUNT, F_DRONE, F_NODE, MODE_LEAN, NOWHERE, P_DEMAND, R_LENGTH, R_SORTIES, R_TRIPS,
    R_TYPE, S_KIND, S_NODE, T_DISTANCE, T_LOAD, Fleet, World,
)
from model.search.refresh import refresh
from model.search.state import I_ACTIVE, I_TOUCHED, Searcher, keep_aside, touch


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


@spliced
def lifts(world: World, sortie: IntArray, k: int, node: int) -> bool:
    """Tell whether a type's drone lifts a customer's parcel on top of a sortie's."""
    for dimension in range(MAX_DIMENSIONS):
        payload = world.place[node, P_DEMAND + dimension]
        for visit in range(sortie[F_COUNT]):
            payload += world.place[sortie[F_NODE + visit], P_DEMAND + dimension]
        if payload > world.type[k, TYPE_PAYLOAD + dimension]:
            return False
    return True


@inlined
def may_drive(world: World, fleet: Fleet, slot: int, k: int) -> bool:
    """Tell whether type `k` has the depot, trips, drones and skills that a route needs."""
    route, stops, sorties = fleet.route[slot], fleet.stop[slot], fleet.sortie[slot]
    nothing = world.type[k, TYPE_DEPOT]
    if (world.type[k, TYPE_DEPOT] != world.type[route[R_TYPE], TYPE_DEPOT]
            or route[R_TRIPS] > world.type[k, TYPE_MAX_TRIPS]):
        return False
    for p in range(route[R_LENGTH]):
        if stops[p, S_KIND] == CUSTOMER and not world.can[k, 0, stops[p, S_NODE]]:
            return False
    for s in range(route[R_SORTIES]):
        sortie = sorties[s]
        if (sortie[F_DRONE] >= world.type[k, TYPE_DRONES] or sortie[F_COUNT] > world.visits[k]
                or not lifts(world, sortie, k, nothing)):
            return False
        for visit in range(sortie[F_COUNT]):
            if not world.can[k, 1, sortie[F_NODE + visit]]:
                return False
    return True


@inlined
def give_type(world: World, searcher: Searcher, slot: int, k: int, cheaper: bool) -> None:
    """Let another type drive a touched route, if that keeps all rules. In place.

    `cheaper`: and only if it costs less.
    """
    now = searcher.now
    former, cost = now.route[slot, R_TYPE], now.cost[slot]
    if (k == former or world.swap[former, k] or now.used[k] >= world.type[k, TYPE_COUNT]
            or not may_drive(world, now, slot, k)):
        return
    spare = len(now.route) - 2
    keep_aside(now, slot, spare)
    now.route[slot, R_TYPE] = k
    if refresh(world, now, slot, searcher.acc) and not (cheaper and now.cost[slot] >= cost - 1e-9):
        now.used[former] -= 1
        now.used[k] += 1
    else:
        keep_aside(now, spare, slot)
        refresh(world, now, slot, searcher.acc)


@inlined
def draw_type(world: World, searcher: Searcher) -> None:
    """Give one of the routes touched this turn a vehicle of any type. In place."""
    slot = searcher.touched[below(searcher.rng, searcher.count[I_TOUCHED])]
    if searcher.now.route[slot, R_LENGTH] > 0:
        give_type(world, searcher, slot, below(searcher.rng, world.num_types), False)


@inlined
def cheapen_types(world: World, searcher: Searcher) -> None:
    """Give the routes touched this turn the types that drive them at the least cost. In place."""
    for index in range(searcher.count[I_TOUCHED]):
        slot = searcher.touched[index]
        if searcher.now.route[slot, R_LENGTH] > 0:
            for k in range(world.num_types):
                if rung(world.stop):
                    return
                give_type(world, searcher, slot, k, True)
