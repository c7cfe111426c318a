"""What trips and sorties carry, and what a lean route costs by vehicles of each type."""

import math

from model.kernel.compiled import inlined, spliced
from model.kernel.drone_types import (
    are_several, first_drone_row, next_drone_row, row_of_drone,
)
from model.kernel.flight import launches_differ
from model.kernel.load import (
    Amount, amount_of, fits, holds, holds_in, most_of, picked_of, plus, write_amount,
)
from model.kernel.records import Record, Records
from model.kernel.shift import allows_sorties, allows_stops
from model.search.route.layout import NOWHERE, Fleet, World
from model.search.route.rarer import tiers_aboard


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


@inlined
def num_flown(types: Records, k: int, sorties: Records, first: int, behind: int, row: int) -> int:
    """Return how many of a truck's sorties from `first` on are flown by drones of a row."""
    count = 0
    for s in range(first, behind):
        if row_of_drone(types, k, sorties[s].drone) == row:
            count += 1
    return count


@inlined
def have_batteries(types: Records, k: int, sorties: Records, first: int, behind: int) -> bool:
    """Tell whether there are batteries for the sorties of a trip.

    Where drones are of one type, `allows_sorties` tells that already.
    """
    if not are_several(types[k]):
        return True
    row = first_drone_row(types, k)
    while row >= 0:
        if not allows_sorties(types[row], num_flown(types, k, sorties, first, behind, row)):
            return False
        row = next_drone_row(types, row)
    return True


@inlined
def has_battery(types: Records, route: Record, sorties: Records, trip: Record, row: int) -> bool:
    """Tell whether drones of a row have a battery for one more sortie on a trip.

    Where they are of one type, `may_launch` tells that already.
    """
    if not are_several(types[route.type]):
        return True
    first = 0
    while first < route.sorties and sorties[first].launch < trip.first:
        first += 1
    behind = first
    while behind < route.sorties and sorties[behind].launch <= trip.last:
        behind += 1
    return allows_sorties(
        types[row], num_flown(types, route.type, sorties, first, behind, row) + 1)


@inlined
def launches_before(kind: Record, route: Record, sorties: Records, trip: Record, p: int) -> int:
    """Return how many launches of a trip come before its stop `p`, if that matters."""
    count = 0
    if launches_differ(kind):
        for s in range(route.sorties):
            if trip.first <= sorties[s].launch < p:
                count += 1
    return count


@inlined
def launch_changed(kind: Record, route: Record, sorties: Records, trip: Record, p: int,
                   is_sortie: bool) -> int:
    """Return the stop of the launch that takes another time since a trip changes at stop `p`.

    That was the trip's first launch where a sortie from stop `p` comes before it; where the trip is
    cut behind stop `p`, the next launch becomes one. NOWHERE: none does.
    """
    if not launches_differ(kind):
        return NOWHERE
    first = trip.first if is_sortie else p + 1
    for s in range(route.sorties):
        if first <= sorties[s].launch <= trip.last:
            return sorties[s].launch
    return NOWHERE


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
def load_of(trip: Record) -> Amount:
    """Return what a trip carries from the depot."""
    return amount_of(trip.load)


@inlined
def add_load(trip: Record, amount: Amount) -> None:
    """Let a trip carry more. In place."""
    write_amount(plus(load_of(trip), amount), trip.load)


@inlined
def may_fit(world: World, fleet: Fleet, slot: int, index: int, k: int, node: int) -> bool:
    """Tell whether a vehicle of type `k` may hold what a trip does and a customer's amounts.

    Where more than its load tells, that hangs on where the customer is served: see `has_room`.
    """
    kind, trip = world.type[k], fleet.trip[slot, index]
    if not fits(kind, load_of(trip), world.place[0, node]):
        return False
    for tier in range(tiers_aboard(fleet)):
        halts = fleet.halt[slot, tier]
        taken = plus(amount_of(halts[trip.last].behind), picked_of(world.amount, node, tier))
        if not (holds_in(kind, taken, tier) and holds_in(kind, most_of(halts[trip.first]), tier)):
            return False
    return True


@inlined
def takes(world: World, fleet: Fleet, slot: int, index: int, k: int, node: int) -> bool:
    """Tell whether a vehicle of type `k` may fit a customer in as well, and stop once more."""
    return (may_fit(world, fleet, slot, index, k, node)
            and allows_stops(world.type[k], stops_on(fleet.trip[slot, index]) + 1))


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
        if cost < best and takes(world, fleet, slot, 0, other, node):
            chosen, best = other, cost
    return chosen


@inlined
def change_type(world: World, fleet: Fleet, slot: int, k: int) -> None:
    """Let a vehicle of another type drive a lean route. In place."""
    fleet.used[fleet.route[slot].type] -= 1
    fleet.used[k] += 1
    fleet.route[slot].type = k
    fleet.cost[slot] = route_cost(world, k, fleet.trip[slot, 0])
