"""Insertions that begin a trip more on a route, or split one, where distance alone costs."""

from model.kernel.compiled import inlined, spliced
from model.kernel.instance import (
    MAX_DIMENSIONS, TYPE_CAPACITY, TYPE_END, TYPE_EARLIEST, TYPE_LATEST, TYPE_MAX_DISTANCE,
    TYPE_RELOAD, TYPE_TRAVEL, FAR, NODE_DEMAND, NODE_RELEASE,
)
from model.kernel.stop import end_of_service, too_late
from model.problem import IntArray
from model.search.route.edit import NEW_TRIP, TRIP_UNTIL
from model.search.route.layout import (
    CUSTOMER, F_COUNT, F_LAUNCH, F_NODE, R_LENGTH, R_SORTIES, R_TYPE, S_ARRIVAL, S_GAP, S_KIND,
    S_LATEST, S_LEAVE, S_LEG, S_NODE, S_TRIP, T_FIRST, T_LAST, Fleet, World,
)


@spliced
def part_fits(world: World, fleet: Fleet, slot: int, p: int, node: int, front: bool) -> bool:
    """Tell whether a customer's demand fits on top of a trip's up to stop `p`, or of the rest."""
    stops, sorties = fleet.stop[slot], fleet.sortie[slot]
    trip = fleet.trip[slot, stops[p, S_TRIP]]
    first, last = (trip[T_FIRST], p) if front else (p + 1, trip[T_LAST])
    for dimension in range(MAX_DIMENSIONS):
        load = world.place[node, NODE_DEMAND + dimension]
        for q in range(first, last + 1):
            if stops[q, S_KIND] == CUSTOMER:
                load += world.place[stops[q, S_NODE], NODE_DEMAND + dimension]
        for s in range(fleet.route[slot, R_SORTIES]):
            if first <= sorties[s, F_LAUNCH] <= last:
                for visit in range(sorties[s, F_COUNT]):
                    load += world.place[sorties[s, F_NODE + visit], NODE_DEMAND + dimension]
        if load > world.type[fleet.route[slot, R_TYPE], TYPE_CAPACITY + dimension]:
            return False
    return True


@spliced
def serve_at(world: World, node: int, arrival: int) -> int:
    """Return when a truck that arrives at a customer has served; FAR if it is too late."""
    place = world.place[node]
    return FAR if too_late(place, arrival) else end_of_service(place, arrival)


@spliced
def drive_to(world: World, stops: IntArray, first: int, last: int, time: int) -> int:
    """Return when a truck that leaves stop `first` at `time` leaves stop `last`; FAR: too late."""
    for p in range(first + 1, last + 1):
        time = serve_at(world, stops[p, S_NODE], time + stops[p - 1, S_GAP])
        if time >= FAR:
            break
    return time


@inlined
def split_fits(world: World, fleet: Fleet, slot: int, p: int, node: int, until: bool) -> bool:
    """Tell whether a trip can be split behind stop `p`, a customer more before or behind the split.

    `until`: before. Loads are not looked at.
    """
    stops = fleet.stop[slot]
    columns, trip = world.type[fleet.route[slot, R_TYPE]], fleet.trip[slot, stops[p, S_TRIP]]
    legs, depot = world.leg[columns[TYPE_TRAVEL]], columns[TYPE_END]
    first, last = trip[T_FIRST], trip[T_LAST]
    front = rear = front_length = rear_length = 0
    for q in range(first, last):
        release = world.place[stops[q, S_NODE], NODE_RELEASE] if q > first else 0
        if q <= p:
            front = max(front, release)
        else:
            rear = max(rear, release)
            rear_length += stops[q, S_LEG]
        if q < p:
            front_length += stops[q, S_LEG]
    release = world.place[node, NODE_RELEASE]
    if until:
        front = max(front, release)
    else:
        rear = max(rear, release)
    here, there = stops[p, S_NODE], stops[p + 1, S_NODE]
    time = drive_to(world, stops, first, p, max(stops[first, S_ARRIVAL], front))
    if until:
        time = serve_at(world, node, time + legs[here, node, 0])
        front_length += legs[here, node, 1]
        here = node
    time += legs[here, depot, 0]
    front_length += legs[here, depot, 1]
    if time > columns[TYPE_LATEST]:
        return False
    time = max(time + columns[TYPE_RELOAD], rear)
    here = depot
    if not until:
        time = serve_at(world, node, time + legs[depot, node, 0])
        rear_length += legs[depot, node, 1]
        here = node
    rear_length += legs[here, there, 1]
    return (time + legs[here, there, 0] <= stops[p + 1, S_LATEST]
            and max(front_length, rear_length) <= columns[TYPE_MAX_DISTANCE])


@spliced
def trip_fits(world: World, fleet: Fleet, slot: int, p: int, node: int) -> bool:
    """Tell whether a customer can be served by a trip of its own behind stop `p`, or -1."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    columns = world.type[route[R_TYPE]]
    legs, depot = world.leg[columns[TYPE_TRAVEL]], columns[TYPE_END]
    time = columns[TYPE_EARLIEST]
    if p >= 0:
        time = stops[p, S_LEAVE] + columns[TYPE_RELOAD]
    time = max(time, world.place[node, NODE_RELEASE])
    time = serve_at(world, node, time + legs[depot, node, 0]) + legs[node, depot, 0]
    if p + 1 < route[R_LENGTH] and time + columns[TYPE_RELOAD] > stops[p + 1, S_LATEST]:
        return False
    return (time <= columns[TYPE_LATEST]
            and legs[depot, node, 1] + legs[node, depot, 1] <= columns[TYPE_MAX_DISTANCE])


@spliced
def more_trips_fit(world: World, fleet: Fleet, slot: int, p: int, node: int, kind: int) -> bool:
    """Tell whether a simple route may have a trip more as a move of `kind` behind stop `p` says."""
    if kind == NEW_TRIP:
        return trip_fits(world, fleet, slot, p, node)
    return split_fits(world, fleet, slot, p, node, kind == TRIP_UNTIL)
