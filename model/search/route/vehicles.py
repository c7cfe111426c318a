"""What trips and sorties carry, and what a lean route costs by vehicles of each type."""

import math

from model.kernel.compiled import inlined, spliced
from model.kernel.load import NOTHING, Amount, demand_of, fits, plus
from model.kernel.records import Record
from model.search.route.layout import NOWHERE, Fleet, World


@spliced
def route_cost(world: World, k: int, distance: int) -> float:
    """Return the cost of a lean route by a vehicle of type `k`."""
    return world.rate[k].fixed + distance * world.rate[k].distance


@inlined
def load_of(trip: Record) -> Amount:
    """Return what a trip carries from the depot."""
    return trip.load[0], trip.load[1], trip.load[2]


@inlined
def add_load(trip: Record, amount: Amount) -> None:
    """Let a trip carry more. In place."""
    trip.load[0], trip.load[1], trip.load[2] = plus(load_of(trip), amount)


@spliced
def payload(world: World, sortie: Record) -> Amount:
    """Return what a sortie carries."""
    carried = NOTHING
    for visit in range(sortie.count):
        carried = plus(carried, demand_of(world.place[sortie.nodes[visit]]))
    return carried


@inlined
def larger_type(world: World, fleet: Fleet, slot: int, node: int) -> int:
    """Return the type for which a route would be exchanged to take a customer more.

    The cheapest that is left and holds them all; NOWHERE if there is none.
    """
    k, trip = fleet.route[slot].type, fleet.trip[slot, 0]
    chosen, best = NOWHERE, math.inf
    for other in range(world.num_types):
        if (not world.swap[k, other] or other == k or not world.can[other, 0, node]
                or fleet.used[other] >= world.type[other].count):
            continue
        cost = route_cost(world, other, trip.distance)
        if cost < best and fits(world.type[other], load_of(trip), world.place[node]):
            chosen, best = other, cost
    return chosen


@inlined
def change_type(world: World, fleet: Fleet, slot: int, k: int) -> None:
    """Let a vehicle of another type drive a lean route. In place."""
    fleet.used[fleet.route[slot].type] -= 1
    fleet.used[k] += 1
    fleet.route[slot].type = k
    fleet.cost[slot] = route_cost(world, k, fleet.trip[slot, 0].distance)
