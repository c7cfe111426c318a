"""A trip planned anew from one order of its customers, with the drone's split off at best.

The order is changed a little, then cut into operations that begin and end with truck and drone
together, by dynamic programming. Waiting for windows is left to the exact timing that follows.

References
----------
Agatz, Bouman and Schmidt (2018), optimization approaches for the traveling salesman problem with
drone, Transportation Science 52:965-981.
"""

import math

from model.compiled import inlined
from model.instance import (
    RATE_DRONE_HOUR, RATE_DRONE_KM, RATE_HOUR, RATE_KM, TYPE_DRONE_SERVICE, TYPE_DRONE_TRAVEL,
    TYPE_DRONES, TYPE_ENDURANCE, TYPE_LAUNCH, TYPE_RECOVERY, TYPE_TRAVEL, TYPE_WAITING_COUNTS,
)
from model.problem import FloatArray, IntArray
from model.search.draw import below, uniform
from model.search.edit import add_sortie, put
from model.search.exchange import append
from model.search.layout import (
    CUSTOMER, END, F_COUNT, F_LAUNCH, F_NODE, NOWHERE, P_SERVICE, R_LENGTH, R_SORTIES, R_TYPE,
    S_NODE, S_TRIP, START, T_FIRST, T_LAST, W_POSITION, W_SLOT, W_SORTIE, Fleet, World,
)
from model.search.refresh import locate, refresh
from model.search.state import Searcher, keep_aside, touch

L_NODE, L_DRIVE, L_DISTANCE, L_GROUNDED, L_BEFORE, L_FLIGHT = range(6)
LINE_COLUMNS = 6
"""Node; driving and serving up to the arrival there; distance; how many so far no truck may serve;
the operation that ends there: the stop where it begins, the customer flown to."""

NO_FLIGHT = 0
LONGEST_OPERATION = 12
"""Stops from the beginning of an operation to its end at most."""

SWAP, MOVE, REVERSE, KEEP = range(4)


@inlined
def line_up(fleet: Fleet, slot: int, index: int, line: IntArray) -> int:
    """Write a trip's places in the order they are left for; return how many.

    0 if a sortie serves several customers.
    """
    stops, sorties = fleet.stop[slot], fleet.sortie[slot]
    first, last = fleet.trip[slot, index, T_FIRST], fleet.trip[slot, index, T_LAST]
    length = 0
    for p in range(first, last + 1):
        line[length, L_NODE] = stops[p, S_NODE]
        length += 1
        for s in range(fleet.route[slot, R_SORTIES]):
            if sorties[s, F_LAUNCH] == p:
                if sorties[s, F_COUNT] > 1:
                    return 0
                line[length, L_NODE] = sorties[s, F_NODE]
                length += 1
    return length


@inlined
def shuffle(searcher: Searcher, length: int) -> None:
    """Change the order of the customers in the line a little. In place."""
    line, rng = searcher.line, searcher.rng
    count = length - 2
    kind = below(rng, 4)
    if kind == KEEP or count < 2:
        return
    one = 1 + below(rng, count)
    other = 1 + below(rng, count)
    if count > LONGEST_OPERATION and uniform(rng) < 0.8:
        other = max(1, min(count, one + below(rng, 2 * LONGEST_OPERATION + 1) - LONGEST_OPERATION))
    if kind == SWAP:
        line[one, L_NODE], line[other, L_NODE] = line[other, L_NODE], line[one, L_NODE]
    elif kind == MOVE:
        node, step = line[one, L_NODE], 1 if other > one else -1
        for position in range(one, other, step):
            line[position, L_NODE] = line[position + step, L_NODE]
        line[other, L_NODE] = node
    else:
        low, high = min(one, other), max(one, other)
        while low < high:
            line[low, L_NODE], line[high, L_NODE] = line[high, L_NODE], line[low, L_NODE]
            low, high = low + 1, high - 1


@inlined
def measure(world: World, k: int, line: IntArray, length: int) -> None:
    """Write what a truck that served the whole line would drive. In place."""
    legs = world.leg[world.type[k, TYPE_TRAVEL]]
    line[0, L_DRIVE] = line[0, L_DISTANCE] = line[0, L_GROUNDED] = 0
    for j in range(1, length):
        before, node = line[j - 1, L_NODE], line[j, L_NODE]
        leg = legs[before, node]
        service = world.place[before, P_SERVICE] if j > 1 else 0
        line[j, L_DRIVE] = line[j - 1, L_DRIVE] + service + leg[0]
        line[j, L_DISTANCE] = line[j - 1, L_DISTANCE] + leg[1]
        line[j, L_GROUNDED] = line[j - 1, L_GROUNDED]
        if j < length - 1 and not world.can[k, 0, node]:
            line[j, L_GROUNDED] += 1


@inlined
def operation_cost(world: World, k: int, line: IntArray, length: int, i: int, j: int,
                   flown: int) -> float:
    """Return what it costs to go from place `i` to `j` while the drone serves place `flown`."""
    columns, rate = world.type[k], world.rate[k]
    node, customer, to = line[i, L_NODE], line[flown, L_NODE], line[j, L_NODE]
    flights = world.leg[columns[TYPE_DRONE_TRAVEL]]
    service = columns[TYPE_DRONE_SERVICE]
    if service < 0:
        service = world.place[customer, P_SERVICE]
    flight = flights[node, customer, 0] + service + flights[customer, to, 0]
    legs = world.leg[columns[TYPE_TRAVEL]]
    before, behind = line[flown - 1, L_NODE], line[flown + 1, L_NODE]
    drive = (line[j, L_DRIVE] - line[i, L_DRIVE] - world.place[customer, P_SERVICE]
             + legs[before, behind, 0] - legs[before, customer, 0] - legs[customer, behind, 0])
    distance = (line[j, L_DISTANCE] - line[i, L_DISTANCE] + legs[before, behind, 1]
                - legs[before, customer, 1] - legs[customer, behind, 1])
    here = world.place[node, P_SERVICE] if i > 0 else 0
    airborne = max(flight, drive - here + max(0, here - columns[TYPE_LAUNCH]))
    counted = airborne if columns[TYPE_WAITING_COUNTS] else flight
    if counted > columns[TYPE_ENDURANCE]:
        return math.inf
    duration = columns[TYPE_LAUNCH] + airborne + columns[TYPE_RECOVERY]
    return (duration * rate[RATE_HOUR] + distance * rate[RATE_KM]
            + airborne * rate[RATE_DRONE_HOUR]
            + (flights[node, customer, 1] + flights[customer, to, 1]) * rate[RATE_DRONE_KM])


@inlined
def loop_cost(world: World, k: int, node: int, customer: int) -> float:
    """Return what a flight costs for which the truck waits at a stop."""
    columns, rate = world.type[k], world.rate[k]
    flights = world.leg[columns[TYPE_DRONE_TRAVEL]]
    service = columns[TYPE_DRONE_SERVICE]
    if service < 0:
        service = world.place[customer, P_SERVICE]
    airborne = flights[node, customer, 0] + service + flights[customer, node, 0]
    if airborne > columns[TYPE_ENDURANCE] or not world.loops:
        return math.inf
    handled = columns[TYPE_LAUNCH] + columns[TYPE_RECOVERY]
    return ((airborne + handled) * rate[RATE_HOUR] + airborne * rate[RATE_DRONE_HOUR]
            + (flights[node, customer, 1] + flights[customer, node, 1]) * rate[RATE_DRONE_KM])


@inlined
def extend(world: World, k: int, line: IntArray, cost: FloatArray, length: int, i: int) -> None:
    """Try all operations that begin at place `i`. In place."""
    rate = world.rate[k]
    legs = world.leg[world.type[k, TYPE_TRAVEL]]
    here, loops = line[i, L_NODE], 0.0
    service = world.place[here, P_SERVICE] if i > 0 else 0
    for j in range(i + 1, min(length, i + LONGEST_OPERATION + 1)):
        to = line[j, L_NODE]
        lands = j == length - 1 or world.can[k, 0, to]
        grounded = line[j - 1, L_GROUNDED] - line[i, L_GROUNDED]
        if lands and grounded <= j - 1 - i:
            leg = legs[here, to]
            total = (cost[i] + loops + (leg[0] + service) * rate[RATE_HOUR]
                     + leg[1] * rate[RATE_KM])
            if total < cost[j]:
                cost[j], line[j, L_BEFORE], line[j, L_FLIGHT] = total, i, NO_FLIGHT
        if lands and grounded <= 1 and world.crossings:
            for flown in range(i + 1, j):
                customer = line[flown, L_NODE]
                if not world.can[k, 1, customer] or (grounded == 1 and world.can[k, 0, customer]):
                    continue
                total = cost[i] + operation_cost(world, k, line, length, i, j, flown)
                if total < cost[j]:
                    cost[j], line[j, L_BEFORE], line[j, L_FLIGHT] = total, i, flown
        if loops < math.inf:
            if world.can[k, 1, to]:
                loops += loop_cost(world, k, here, to)
            else:
                loops = math.inf


@inlined
def split(world: World, k: int, line: IntArray, cost: FloatArray, length: int) -> bool:
    """Cut the line into operations at least cost. In place; False if it can't be cut."""
    for j in range(length):
        cost[j] = math.inf
    cost[0] = 0.0
    for i in range(length - 1):
        if cost[i] < math.inf:
            extend(world, k, line, cost, length, i)
    return cost[length - 1] < math.inf


@inlined
def write_trip(route: IntArray, stops: IntArray, sorties: IntArray, line: IntArray,
               length: int) -> None:
    """Append the trip that the operations make. In place; turns L_BEFORE round."""
    j, behind = length - 1, NOWHERE
    while j > 0:
        before = line[j, L_BEFORE]
        line[j, L_BEFORE] = behind
        behind, j = j, before
    line[0, L_BEFORE] = behind
    put(stops, route[R_LENGTH], line[0, L_NODE], START)
    i = 0
    while i < length - 1:
        j, p = line[i, L_BEFORE], route[R_LENGTH]
        flown = line[j, L_FLIGHT]
        if flown != NO_FLIGHT:
            add_sortie(route, sorties, p, p + flown_stops(i, j), 0, line[flown, L_NODE])
        for place in range(i + 1, j):
            if flown == NO_FLIGHT:
                add_sortie(route, sorties, p, p, 0, line[place, L_NODE])
            elif place != flown:
                route[R_LENGTH] += 1
                put(stops, route[R_LENGTH], line[place, L_NODE], CUSTOMER)
        route[R_LENGTH] += 1
        put(stops, route[R_LENGTH], line[j, L_NODE], END if j == length - 1 else CUSTOMER)
        i = j
    route[R_LENGTH] += 1


@inlined
def flown_stops(i: int, j: int) -> int:
    """Return how many stops the truck makes in an operation with a flight."""
    return j - i - 1


@inlined
def resplit(world: World, searcher: Searcher) -> bool:
    """Plan a random trip with one drone anew from a changed order of its customers.

    In place; tells whether the route was changed and keeps all rules; if not, it may be broken.
    """
    now = searcher.now
    node = world.num_depots + below(searcher.rng, world.num_nodes - world.num_depots)
    where = now.where[node]
    slot, p = where[W_SLOT], where[W_POSITION]
    if slot < 0 or world.type[now.route[slot, R_TYPE], TYPE_DRONES] != 1:
        return False
    if p < 0:
        p = now.sortie[slot, where[W_SORTIE], F_LAUNCH]
    k, index = now.route[slot, R_TYPE], now.stop[slot, p, S_TRIP]
    length = line_up(now, slot, index, searcher.line)
    if length < 4:
        return False
    shuffle(searcher, length)
    measure(world, k, searcher.line, length)
    if not split(world, k, searcher.line, searcher.line_cost, length):
        return False
    touch(searcher, slot)
    spare = len(now.route) - 2
    first, last = now.trip[slot, index, T_FIRST], now.trip[slot, index, T_LAST]
    keep_aside(now, slot, spare)
    route = now.route[slot]
    end = route[R_LENGTH]
    route[R_LENGTH] = route[R_SORTIES] = 0
    append(now, spare, 0, first, slot)
    write_trip(route, now.stop[slot], now.sortie[slot], searcher.line, length)
    append(now, spare, last + 1, end, slot)
    done = refresh(world, now, slot, searcher.acc)
    locate(now, slot)
    return done
