"""Another type of vehicle for a route."""


from model.kernel.alarm import rung
from model.kernel.compiled import inlined
from model.kernel.instance import TYPE_COUNT, TYPE_DRONES, TYPE_END, TYPE_MAX_TRIPS, TYPE_START
from model.kernel.load import holds, lifts
from model.search.route.layout import (
    CUSTOMER, F_COUNT, F_DRONE, F_NODE, MODE_LEAN, R_LENGTH, R_SORTIES, R_TRIPS,
    R_TYPE, S_KIND, S_NODE, T_DISTANCE, Fleet, World,
)
from model.search.route.randomness import below
from model.search.route.refresh import refresh
from model.search.route.state import I_ACTIVE, I_TOUCHED, Searcher, keep_aside, touch
from model.search.route.vehicles import change_type, load_of, payload, route_cost


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
        if (cost < now.cost[slot] + now.cost[other] - 1e-9
                and holds(world.type[by], load_of(now.trip[slot, 0]))
                and holds(world.type[k], load_of(now.trip[other, 0]))):
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
                    and holds(world.type[k], load_of(trip))):
                change_type(world, now, slot, k)
        trade(world, searcher, slot)


@inlined
def may_drive(world: World, fleet: Fleet, slot: int, k: int) -> bool:
    """Tell whether type `k` has the places, trips, drones and skills that a route needs."""
    route, stops, sorties = fleet.route[slot], fleet.stop[slot], fleet.sortie[slot]
    former = world.type[route[R_TYPE]]
    if (world.type[k, TYPE_START] != former[TYPE_START]
            or world.type[k, TYPE_END] != former[TYPE_END]
            or route[R_TRIPS] > world.type[k, TYPE_MAX_TRIPS]):
        return False
    for p in range(route[R_LENGTH]):
        if stops[p, S_KIND] == CUSTOMER and not world.can[k, 0, stops[p, S_NODE]]:
            return False
    for s in range(route[R_SORTIES]):
        sortie = sorties[s]
        if (sortie[F_DRONE] >= world.type[k, TYPE_DRONES] or sortie[F_COUNT] > world.visits[k]
                or not lifts(world.type[k], payload(world, sortie))):
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
