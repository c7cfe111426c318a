"""Another type of vehicle for a route."""


from model.kernel.alarm import rung
from model.kernel.compiled import inlined
from model.kernel.drone_types import row_of_drone
from model.search.route.halts import can_carry, can_take
from model.search.route.layout import CUSTOMER, MODE_LEAN, NOWHERE, Fleet, World
from model.search.route.randomness import below
from model.search.route.refresh import refresh
from model.search.route.state import Searcher, keep_aside, touch
from model.search.route.vehicles import change_type, route_cost


@inlined
def trade(world: World, searcher: Searcher, slot: int) -> None:
    """Swap vehicles with another route where that is cheaper. In place."""
    now = searcher.now
    for index in range(searcher.count.active):
        other = searcher.active[index]
        k, by = now.route[slot].type, now.route[other].type
        if by == k or not world.swap[k, by]:
            continue
        cost = (route_cost(world, by, now.trip[slot, 0])
                + route_cost(world, k, now.trip[other, 0]))
        if (cost < now.cost[slot] + now.cost[other] - 1e-9
                and can_take(world, now, slot, by)
                and can_take(world, now, other, k)):
            touch(searcher, other)
            change_type(world, now, slot, by)
            change_type(world, now, other, k)


@inlined
def improve_types(world: World, searcher: Searcher) -> None:
    """Give the routes touched this turn the cheapest vehicles left, or others'. In place."""
    now = searcher.now
    for index in range(searcher.count.touched):
        slot = searcher.touched[index]
        if now.route[slot].length == 0 or not world.mode[now.route[slot].type] & MODE_LEAN:
            continue
        trip = now.trip[slot, 0]
        for k in range(world.num_types):
            if (world.swap[now.route[slot].type, k]
                    and now.used[k] < world.type[k].count
                    and route_cost(world, k, trip) < now.cost[slot] - 1e-9
                    and can_take(world, now, slot, k)):
                change_type(world, now, slot, k)
        trade(world, searcher, slot)


@inlined
def may_drive(world: World, fleet: Fleet, slot: int, k: int) -> bool:
    """Tell whether type `k` has the places, trips, drones and skills that a route needs."""
    route, stops, sorties = fleet.route[slot], fleet.stop[slot], fleet.sortie[slot]
    former = world.type[route.type]
    if (world.type[k].begins_at != former.begins_at
            or world.type[k].ends_at != former.ends_at
            or route.trips > world.type[k].max_trips
            or (route.trips > 1 and world.type[k].depot != former.depot)):
        return False
    for p in range(route.length):
        if stops[p].kind == CUSTOMER and not world.can[k, 0, stops[p].node]:
            return False
    for s in range(route.sorties):
        sortie = sorties[s]
        row = row_of_drone(world.type, k, sortie.drone)
        if (sortie.drone >= world.type[k].drones or sortie.count > world.visits[row]
                or not can_carry(world, row, sortie, NOWHERE, NOWHERE)):
            return False
        for visit in range(sortie.count):
            if not world.can[row, 1, sortie.nodes[visit]]:
                return False
    return True


@inlined
def give_type(world: World, searcher: Searcher, slot: int, k: int, cheaper: bool) -> None:
    """Let another type drive a touched route, if that keeps all rules. In place.

    `cheaper`: and only if it costs less.
    """
    now = searcher.now
    former, cost = now.route[slot].type, now.cost[slot]
    if (k == former or world.swap[former, k] or now.used[k] >= world.type[k].count
            or not may_drive(world, now, slot, k)):
        return
    spare = len(now.route) - 2
    keep_aside(now, slot, spare)
    now.route[slot].type = k
    if refresh(world, now, slot, searcher.acc) and not (cheaper and now.cost[slot] >= cost - 1e-9):
        now.used[former] -= 1
        now.used[k] += 1
    else:
        keep_aside(now, spare, slot)
        refresh(world, now, slot, searcher.acc)


@inlined
def draw_type(world: World, searcher: Searcher) -> None:
    """Give one of the routes touched this turn a vehicle of any type. In place."""
    slot = searcher.touched[below(searcher.rng, searcher.count.touched)]
    if searcher.now.route[slot].length > 0:
        give_type(world, searcher, slot, below(searcher.rng, world.num_types), False)


@inlined
def cheapen_types(world: World, searcher: Searcher) -> None:
    """Give the routes touched this turn the types that drive them at the least cost. In place."""
    for index in range(searcher.count.touched):
        slot = searcher.touched[index]
        if searcher.now.route[slot].length > 0:
            for k in range(world.num_types):
                if rung(world.stop):
                    return
                give_type(world, searcher, slot, k, True)
