"""Timing of a block: the stops of a truck from one where all drones are aboard to the next."""

from model.kernel.clock import arrival_by_profile
from model.kernel.compiled import inlined
from model.kernel.instance import (
    FAR, NODE_EARLIEST, NODE_LATEST, NODE_LIMIT, NODE_SERVICE, NO_PROFILE, TYPE_DRONE_SERVICE,
    TYPE_DRONE_TRAVEL, TYPE_ENDURANCE, TYPE_LATEST, TYPE_LAUNCH, TYPE_PROFILE, TYPE_RECOVERY,
    TYPE_TRAVEL, TYPE_WAITING_COUNTS,
)
from model.problem import UNREACHABLE, IntArray
from model.search.route.layout import (
    CUSTOMER, DONE, END, FLYING, F_BEGIN, F_COUNT, F_DRONE, F_HELD, F_LAUNCH, F_NODE, F_READY_C,
    F_READY_D, F_RECOVERY, F_STATE, F_TAKEOFF, F_TAKEOFF_C, F_TAKEOFF_D, NONE, START, S_ARRIVAL,
    S_BLOCK, S_C, S_D, S_DEP, S_EARLY, S_FLYING, S_GAP, S_HI, S_HOLD, S_IDLE, S_KIND, S_LATEST,
    S_LEAVE, S_LO, S_NODE, S_RELEASE, WAITING, World,
)

A_TIME, A_FREE_D, A_FREE_C, A_HI, A_LO, A_DEP, A_OLDEST, A_FLYING = range(8)


@inlined
def origin(world: World, k: int, time: int) -> tuple[int, int]:
    """Return the pair of an arrival at `time`, at the beginning of a block."""
    if world.type[k, TYPE_PROFILE] == NO_PROFILE:
        return 0, NONE
    return NONE, time


@inlined
def travel(world: World, k: int, duration: int, d: int, c: int) -> tuple[int, int]:
    """Return the pair at the end of a leg of `duration` at full speed."""
    changes = world.type[k, TYPE_PROFILE]
    if changes == NO_PROFILE:
        return d + duration, c + duration
    return NONE, arrival_by_profile(world.profile_time[k], world.profile_factor[k], changes,
                                    duration, c)


@inlined
def serve(world: World, stop: IntArray, d: int, c: int) -> tuple[int, int]:
    """Return the pair at the end of what a truck does at a stop by itself, reached at (d, c)."""
    kind = stop[S_KIND]
    if kind == CUSTOMER:
        place = world.place[stop[S_NODE]]
        return d + place[NODE_SERVICE], max(c, place[NODE_EARLIEST]) + place[NODE_SERVICE]
    if kind == START:
        return d, max(c, max(stop[S_RELEASE], stop[S_HOLD]))
    return d, c


@inlined
def plain_block(world: World, k: int, stop: IntArray, time: int) -> None:
    """Write the block of a stop without launches, reached at `time`. In place."""
    d, c = origin(world, k, time)
    stop[S_D], stop[S_C] = serve(world, stop, d, c)
    stop[S_HI], stop[S_LO], stop[S_DEP] = FAR, NONE, FAR
    if stop[S_KIND] == CUSTOMER:
        place = world.place[stop[S_NODE]]
        stop[S_HI], stop[S_DEP] = place[NODE_LIMIT], max(time, place[NODE_LATEST])
    elif stop[S_KIND] == END:
        stop[S_HI] = world.type[k, TYPE_LATEST]


@inlined
def make_ready(world: World, k: int, stops: IntArray, sorties: IntArray, count: int) -> None:
    """Have the sorties of a route wait for their launches. In place.

    And write how long each is held back: until windows let it be back within the endurance.
    """
    columns = world.type[k]
    legs, own = world.leg[columns[TYPE_DRONE_TRAVEL]], columns[TYPE_DRONE_SERVICE]
    for s in range(count):
        sortie = sorties[s]
        node = stops[sortie[F_RECOVERY], S_NODE]
        back = to_fly = 0
        for index in range(sortie[F_COUNT] - 1, -1, -1):
            customer = sortie[F_NODE + index]
            place = world.place[customer]
            to_fly += legs[customer, node, 0] + (own if own >= 0 else place[NODE_SERVICE])
            back = max(back, place[NODE_EARLIEST] + to_fly)
            node = customer
        sortie[F_STATE], sortie[F_HELD] = WAITING, back - columns[TYPE_ENDURANCE]


@inlined
def fly_out(places: IntArray, legs: IntArray, columns: IntArray, sortie: IntArray, node: int,
            acc: IntArray) -> bool:
    """Launch a sortie from `node` once the truck's crew is free. In place; False if not allowed."""
    own, arrivals = columns[TYPE_DRONE_SERVICE], (F_NODE + len(sortie)) // 2
    d = acc[A_FREE_D] + columns[TYPE_LAUNCH]
    c = max(acc[A_FREE_C] + columns[TYPE_LAUNCH], sortie[F_HELD])
    acc[A_FREE_D], acc[A_FREE_C] = d, c
    sortie[F_TAKEOFF_D], sortie[F_TAKEOFF_C] = d, c
    sortie[F_TAKEOFF] = max(acc[A_TIME] + d, c)
    for index in range(sortie[F_COUNT]):
        customer = sortie[F_NODE + index]
        flight = legs[node, customer, 0]
        place = places[customer]
        d, c = d + flight, c + flight
        arrival = max(acc[A_TIME] + d, c)
        if flight >= UNREACHABLE or c > place[NODE_LIMIT]:
            return False
        sortie[arrivals + index] = arrival
        acc[A_HI] = min(acc[A_HI], place[NODE_LIMIT] - d)
        acc[A_DEP] = min(acc[A_DEP], max(arrival, place[NODE_LATEST]) - d)
        service = own if own >= 0 else place[NODE_SERVICE]
        d, c = d + service, max(c, place[NODE_EARLIEST]) + service
        node = customer
    sortie[F_READY_D], sortie[F_READY_C] = d, c
    sortie[F_STATE] = FLYING
    acc[A_FLYING] += 1
    return True


@inlined
def bound_arrival(sortie: IntArray, d: int, c: int, endurance: int, acc: IntArray) -> bool:
    """Bound the truck's arrival so that (d, c) comes within the endurance after take-off.

    In place; False if no arrival will do.
    """
    takeoff_d, takeoff_c = sortie[F_TAKEOFF_D], sortie[F_TAKEOFF_C]
    if d - takeoff_d <= endurance:
        if c - takeoff_c > endurance:
            acc[A_LO] = max(acc[A_LO], c - endurance - takeoff_d)
    else:
        if c - takeoff_c > endurance:
            return False
        acc[A_HI] = min(acc[A_HI], endurance + takeoff_c - d)
    return acc[A_LO] <= acc[A_HI]


@inlined
def bring_home(legs: IntArray, columns: IntArray, sortie: IntArray, node: int,
               acc: IntArray) -> bool:
    """Recover a sortie at `node`. In place; False if endurance forbids it."""
    last = sortie[F_NODE + sortie[F_COUNT] - 1]
    flight = legs[last, node, 0]
    back_d, back_c = sortie[F_READY_D] + flight, sortie[F_READY_C] + flight
    begin_d, begin_c = max(acc[A_FREE_D], back_d), max(acc[A_FREE_C], back_c)
    if flight >= UNREACHABLE:
        return False
    within = True
    if columns[TYPE_WAITING_COUNTS]:
        within = bound_arrival(sortie, begin_d, begin_c, columns[TYPE_ENDURANCE], acc)
    else:
        within = bound_arrival(sortie, back_d, back_c, columns[TYPE_ENDURANCE], acc)
    begin = max(acc[A_TIME] + begin_d, begin_c)
    sortie[F_BEGIN] = begin
    slack = begin - begin_d
    if sortie[F_TAKEOFF] - sortie[F_TAKEOFF_D] > slack:
        acc[A_DEP] = min(acc[A_DEP], slack)
    acc[A_FREE_D] = begin_d + columns[TYPE_RECOVERY]
    acc[A_FREE_C] = begin_c + columns[TYPE_RECOVERY]
    sortie[F_STATE] = DONE
    acc[A_FLYING] -= 1
    return within


@inlined
def is_aboard(sorties: IntArray, index: int, oldest: int) -> bool:
    """Tell whether the drone of a sortie has ended all sorties before it."""
    for other in range(oldest, index):
        if sorties[other, F_DRONE] == sorties[index, F_DRONE] and sorties[other, F_STATE] != DONE:
            return False
    return True


@inlined
def next_operation(legs: IntArray, columns: IntArray, sorties: IntArray, count: int, p: int,
                   node: int, acc: IntArray) -> int:
    """Return the sortie whose launch or recovery at stop `p` can begin first; -1: none is left.

    A drone that is there is recovered before another is launched.
    """
    chosen, earliest = -1, FAR
    free = max(acc[A_TIME] + acc[A_FREE_D], acc[A_FREE_C])
    for index in range(acc[A_OLDEST], count):
        if sorties[index, F_LAUNCH] > p:
            break
        begin = FAR
        if sorties[index, F_STATE] == FLYING:
            if sorties[index, F_RECOVERY] == p:
                last = sorties[index, F_NODE + sorties[index, F_COUNT] - 1]
                flight = legs[last, node, 0]
                begin = max(2 * free, 2 * (max(acc[A_TIME] + sorties[index, F_READY_D],
                                               sorties[index, F_READY_C]) + flight))
        elif (sorties[index, F_STATE] == WAITING and sorties[index, F_LAUNCH] == p
              and is_aboard(sorties, index, acc[A_OLDEST])):
            begin = 2 * max(free, sorties[index, F_HELD] - columns[TYPE_LAUNCH]) + 1
        if begin < earliest:
            chosen, earliest = index, begin
    return chosen


@inlined
def operate(places: IntArray, legs: IntArray, columns: IntArray, sorties: IntArray, count: int,
            p: int, node: int, acc: IntArray) -> bool:
    """Launch and recover all that stop `p` asks for. In place; False if not allowed.

    `legs` (origin, to, 2) are flown; `columns` are those of the vehicle type.
    """
    # The whole world would be copied at each call.
    while True:
        index = next_operation(legs, columns, sorties, count, p, node, acc)
        if index < 0:
            break
        if sorties[index, F_STATE] == FLYING:
            if not bring_home(legs, columns, sorties[index], node, acc):
                return False
        elif not fly_out(places, legs, columns, sorties[index], node, acc):
            return False
    for index in range(acc[A_OLDEST], count):
        if sorties[index, F_LAUNCH] > p:
            break
        if sorties[index, F_STATE] == WAITING:
            return False
    while acc[A_OLDEST] < count and sorties[acc[A_OLDEST], F_STATE] == DONE:
        acc[A_OLDEST] += 1
    return True


@inlined
def note_idle(places: IntArray, stops: IntArray, first: int, last: int) -> None:
    """Write how long the truck waits for drones in a block, at all stops but the last. In place."""
    idle = stops[first, S_D]
    for p in range(first, last + 1):
        if stops[p, S_KIND] == CUSTOMER:
            idle -= places[stops[p, S_NODE], NODE_SERVICE]
        if p < last:
            idle -= stops[p, S_GAP]
    for p in range(first, last):
        stops[p, S_IDLE] = idle
    stops[last, S_IDLE] = 0


@inlined
def time_block(world: World, k: int, stops: IntArray, length: int, sorties: IntArray, count: int,
               first: int, oldest: int, time: int, acc: IntArray) -> int:
    """Write the block from stop `first`, which the truck reaches at `time`. In place.

    `oldest` is the first sortie not yet over. Returns the block's last stop, -1 if not allowed.
    """
    columns = world.type[k]
    flights = world.leg[columns[TYPE_DRONE_TRAVEL]]
    d, c = origin(world, k, time)
    acc[A_TIME], acc[A_HI], acc[A_LO], acc[A_DEP] = time, FAR, NONE, FAR
    acc[A_OLDEST], acc[A_FLYING], p = oldest, 0, first
    while True:
        stop = stops[p]
        kind, node = stop[S_KIND], stop[S_NODE]
        stop[S_ARRIVAL], stop[S_BLOCK] = max(time + d, c), first
        if kind == CUSTOMER:
            place = world.place[node]
            if c > place[NODE_LIMIT]:
                return -1
            acc[A_HI] = min(acc[A_HI], place[NODE_LIMIT] - d)
            acc[A_DEP] = min(acc[A_DEP], max(stop[S_ARRIVAL], place[NODE_LATEST]) - d)
        elif kind == START:
            c = max(c, max(stop[S_RELEASE], stop[S_HOLD]))
        acc[A_FREE_D], acc[A_FREE_C] = d, c
        d, c = serve(world, stop, d, c)
        if not operate(world.place, flights, columns, sorties, count, p, node, acc):
            return -1
        d, c = max(d, acc[A_FREE_D]), max(c, acc[A_FREE_C])
        stop[S_LEAVE], stop[S_FLYING] = max(time + d, c), acc[A_FLYING]
        stop[S_LATEST], stop[S_EARLY] = FAR, NONE
        if kind == END:
            if c > columns[TYPE_LATEST]:
                return -1
            acc[A_HI] = min(acc[A_HI], columns[TYPE_LATEST] - d)
        if acc[A_FLYING] == 0:
            break
        if kind == END or p + 1 >= length:
            return -1
        stop[S_GAP] = world.leg[columns[TYPE_TRAVEL], node, stops[p + 1, S_NODE], 0]
        d, c = travel(world, k, stop[S_GAP], d, c)
        p += 1
    stops[first, S_D], stops[first, S_C], stops[first, S_HI] = d, c, acc[A_HI]
    stops[first, S_LO], stops[first, S_DEP] = acc[A_LO], acc[A_DEP]
    note_idle(world.place, stops, first, p)
    return p
