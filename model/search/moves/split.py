"""An order of customers, cut at best into what a truck and its drone do together.

The order is cut into operations that begin and end with truck and drone together, by dynamic
programming. Waiting for windows is left to the exact timing that follows.

References
----------
Agatz, Bouman and Schmidt (2018), optimization approaches for the traveling salesman problem with
drone, Transportation Science 52:965-981.
"""

import math

from model.kernel.compiled import inlined, spliced
from model.kernel.flight import (
    can_serve, can_wait, handling_duration, launch_duration, within_endurance,
)
from model.kernel.leg import leg, legs_of
from model.kernel.records import Records, record
from model.kernel.stop import places_by_air, places_of, service_duration
from model.problem import FloatArray, UIntArray
from model.search.route.layout import World
from model.search.route.randomness import below, uniform

LINE = record("node", "drive", "distance", "grounded", "before", "flight", "spared_drive",
              "spared_distance")
"""Node; driving and serving up to the arrival there; distance; how many so far no truck may serve;
the operation that ends there: the stop where it begins, the customer flown to; what a truck that
passes by the place is spared of both."""

NO_FLIGHT = 0
LONGEST_OPERATION = 12
"""Stops from the beginning of an operation to its end at most."""

SWAP, MOVE, REVERSE, KEEP = range(4)
KINDS = (SWAP, SWAP, MOVE, MOVE, MOVE, REVERSE, REVERSE, KEEP)
"""Changes of the order, those that pay more often."""

NEIGHBOURLY, NEIGHBOURS = 0.8, 8
"""How often a place is brought beside one of so many near neighbours, not just anywhere."""


@inlined
def place_near(world: World, line: Records, count: int, one: int, rng: UIntArray) -> int:
    """Return a random place in the line, most often that of a near neighbour of place `one`."""
    if uniform(rng) < NEIGHBOURLY:
        wanted = int(world.near[line[one].node, below(rng, min(NEIGHBOURS, world.near.shape[1]))])
        for place in range(1, count + 1):
            if line[place].node == wanted:
                return place
    return 1 + below(rng, count)


@inlined
def shift(line: Records, one: int, to: int) -> None:
    """Move what is at place `one` to place `to`. In place."""
    node, step = line[one].node, 1 if to > one else -1
    for position in range(one, to, step):
        line[position].node = line[position + step].node
    line[to].node = node


@inlined
def shuffle(world: World, line: Records, length: int, rng: UIntArray) -> None:
    """Change the order of the customers in the line a little. In place."""
    count = length - 2
    kind = KINDS[below(rng, len(KINDS))]
    one = 1 + below(rng, count)
    other = place_near(world, line, count, one, rng)
    if kind == KEEP or other == one:
        return
    if kind == MOVE:
        shift(line, one, other)
        return
    # Either way the neighbour comes beside place `one`, or the other way round.
    low, high = (one + 1, other) if other > one else (other, one - 1)
    if kind == SWAP:
        line[low].node, line[high].node = line[high].node, line[low].node
        return
    while low < high:
        line[low].node, line[high].node = line[high].node, line[low].node
        low, high = low + 1, high - 1


@spliced
def measure(world: World, k: int, line: Records, length: int) -> None:
    """Write what a truck that served the whole line would drive. In place."""
    legs = legs_of(world.leg, world.type[k].travel)
    places = places_of(world.place, world.type[k])
    line[0].drive = line[0].distance = line[0].grounded = 0
    for j in range(1, length):
        before, node = line[j - 1].node, line[j].node
        way = leg(legs, before, node)
        served = line[j - 1].drive + service_duration(places[before])
        line[j].drive = served + way.duration
        line[j].distance = line[j - 1].distance + way.distance
        line[j].grounded = line[j - 1].grounded
        if j < length - 1 and not world.can[k, 0, node]:
            line[j].grounded += 1
    for j in range(1, length - 1):
        direct = leg(legs, line[j - 1].node, line[j + 1].node)
        line[j].spared_drive = line[j + 1].drive - line[j - 1].drive - direct.duration
        line[j].spared_drive -= service_duration(places[line[j - 1].node])
        line[j].spared_distance = line[j + 1].distance - line[j - 1].distance
        line[j].spared_distance -= direct.distance


@spliced
def operation_cost(world: World, k: int, line: Records, i: int, j: int, flown: int,
                   most: float) -> float:
    """Return what it costs to go from place `i` to `j` while the drone serves place `flown`.

    Infinite if that can't be, or if what the truck does alone costs `most` or more.
    """
    kind, rate = world.type[k], world.rate[k]
    node, customer, to = line[i].node, line[flown].node, line[j].node
    drive = line[j].drive - line[i].drive - line[flown].spared_drive
    distance = line[j].distance - line[i].distance - line[flown].spared_distance
    here = service_duration(places_of(world.place, kind)[node])
    handled = handling_duration(kind)
    driven = drive - here + max(0, here - launch_duration(kind, 1))
    ground = distance * rate.distance + (j - i - 1) * rate.stop
    if (handled + driven) * rate.time + ground >= most:
        return math.inf
    flights = legs_of(world.leg, kind.drone_travel)
    homeward = legs_of(world.leg, kind.home_travel)
    place = places_by_air(world.place, kind)[customer]
    service = service_duration(place)
    out, home = leg(flights, node, customer), leg(homeward, customer, to)
    flight = out.duration + service + home.duration
    airborne = max(flight, driven)
    if not within_endurance(kind, 0, flight, airborne) or not can_wait(
            kind, place, out.duration, home.duration, airborne - flight):
        return math.inf
    return ((handled + airborne) * rate.time + ground
            + airborne * rate.drone_time
            + (out.distance + home.distance) * rate.drone_distance)


@inlined
def loop_cost(world: World, k: int, node: int, customer: int) -> float:
    """Return what a flight costs for which the truck waits at a stop."""
    kind, rate = world.type[k], world.rate[k]
    flights = legs_of(world.leg, kind.drone_travel)
    homeward = legs_of(world.leg, kind.home_travel)
    place = places_by_air(world.place, kind)[customer]
    service = service_duration(place)
    out, home = leg(flights, node, customer), leg(homeward, customer, node)
    airborne = out.duration + service + home.duration
    if not world.loops or not can_serve(kind, place, out.duration,
                                        home.duration):
        return math.inf
    handled = handling_duration(kind)
    return ((airborne + handled) * rate.time + airborne * rate.drone_time
            + (out.distance + home.distance) * rate.drone_distance)


@spliced
def extend(world: World, k: int, line: Records, cost: FloatArray, length: int, i: int) -> None:
    """Try all operations that begin at place `i`. In place."""
    rate = world.rate[k]
    legs = legs_of(world.leg, world.type[k].travel)
    here, loops = line[i].node, 0.0
    service = service_duration(places_of(world.place, world.type[k])[here])
    for j in range(i + 1, min(length, i + LONGEST_OPERATION + 1)):
        to = line[j].node
        lands = j == length - 1 or world.can[k, 0, to]
        grounded = line[j - 1].grounded - line[i].grounded
        if lands:
            way = leg(legs, here, to)
            total = (cost[i] + loops + (way.duration + service) * rate.time
                     + way.distance * rate.distance + rate.stop)
            if total < cost[j]:
                cost[j], line[j].before, line[j].flight = total, i, NO_FLIGHT
        if lands and grounded <= 1 and world.crossings:
            for flown in range(i + 1, j):
                customer = line[flown].node
                if not world.can[k, 1, customer] or (grounded == 1 and world.can[k, 0, customer]):
                    continue
                total = cost[i] + operation_cost(world, k, line, i, j, flown,
                                                 cost[j] - cost[i])
                if total < cost[j]:
                    cost[j], line[j].before, line[j].flight = total, i, flown
        if loops < math.inf:
            if world.can[k, 1, to]:
                loops += loop_cost(world, k, here, to)
            else:
                loops = math.inf


@spliced
def split(world: World, k: int, line: Records, cost: FloatArray, length: int) -> bool:
    """Cut the line into operations at least cost. In place; False if it can't be cut."""
    for j in range(length):
        cost[j] = math.inf
    cost[0] = 0.0
    for i in range(length - 1):
        if cost[i] < math.inf:
            extend(world, k, line, cost, length, i)
    return cost[length - 1] < math.inf


@spliced
def present_cost(world: World, k: int, line: Records, length: int) -> float:
    """Return what the operations that are noted in the line cost."""
    rate, legs = world.rate[k], legs_of(world.leg, world.type[k].travel)
    places = places_of(world.place, world.type[k])
    cost, j = 0.0, length - 1
    while j > 0:
        i, flown = line[j].before, line[j].flight
        if flown != NO_FLIGHT:
            cost += operation_cost(world, k, line, i, j, flown, math.inf)
        else:
            here = line[i].node
            way, service = leg(legs, here, line[j].node), service_duration(places[here])
            cost += (way.duration + service) * rate.time + way.distance * rate.distance
            cost += rate.stop
            for place in range(i + 1, j):
                cost += loop_cost(world, k, here, line[place].node)
        j = i
    return cost
