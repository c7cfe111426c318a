"""What trips and sorties carry, and what a lean route costs by vehicles of each type."""

import math

from model.kernel.compiled import inlined, spliced
from model.kernel.load import NOTHING, Amount, demand_of, fits, holds, plus
from model.kernel.records import Record, Records
from model.kernel.shift import allows_sorties, allows_stops
from model.search.route.layout import NOWHERE, Fleet, World


@inlined
def stops_on(trip: Record) -> int:
    """Return how many customers the truck itself serves on a trip."""
    return trip.last - trip.first - 1


@inlined
def may_launch(kind: Record, route: Record, sorties: Records, trip: Record) -> bool:
    """Tell whether a sortie more may be flown on a trip of a route, by their number."""
    if allows_sorties(kind, route.sorties + 1):
        return True
    count = 1
    for s in range(route.sorties):
        if trip.first <= sorties[s].launch <= trip.last:
            count += 1
    return allows_sorties(kind, count)


@spliced
def route_cost(world: World, k: int, trip: Record) -> float:
    """Return what a lean route's only trip costs by a vehicle of type `k`."""
    rate = world.rate[k]
    return rate.fixed + trip.distance * rate.distance + stops_on(trip) * rate.stop


@inlined
def may_make(kind: Record, trip: Record) -> bool:
    """Tell whether a vehicle of a type holds what a trip carries, and may stop so often."""
    return holds(kind, load_of(trip)) and allows_stops(kind, stops_on(trip))


@inlined
def takes(kind: Record, trip: Record, place: Records) -> bool:
    """Tell whether a vehicle of a type holds a customer's parcel more, and may stop once more."""
    return fits(kind, load_of(trip), place) and allows_stops(kind, stops_on(trip) + 1)


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
        cost = route_cost(world, other, trip) + world.rate[other].stop
        if cost < best and takes(world.type[other], trip, world.place[node]):
            chosen, best = other, cost
    return chosen


@inlined
def change_type(world: World, fleet: Fleet, slot: int, k: int) -> None:
    """Let a vehicle of another type drive a lean route. In place."""
    fleet.used[fleet.route[slot].type] -= 1
    fleet.used[k] += 1
    fleet.route[slot].type = k
    fleet.cost[slot] = route_cost(world, k, fleet.trip[slot, 0])
