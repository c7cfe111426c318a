"""Timing of a block: the stops of a truck from one where all drones are aboard to the next."""

from model.kernel.clock import is_steady, leg_end
from model.kernel.compiled import inlined
from model.kernel.flight import (
    counted_until, drone_service, earliest_back, enduring_within, held_until, launch_begin,
    recovery_end, take_off, unreachable,
)
from model.kernel.instance import FAR, NONE, TYPE_DRONE_TRAVEL, TYPE_LATEST, TYPE_TRAVEL
from model.kernel.leg import leg, legs_of
from model.kernel.start import leaves_first
from model.kernel.stop import allowed_within, as_late, service_duration, start_within, too_late
from model.problem import IntArray
from model.search.route.layout import (
    CUSTOMER, DONE, END, FLYING, F_BEGIN, F_COUNT, F_DRONE, F_HELD, F_LAUNCH, F_NODE, F_READY_C,
    F_READY_D, F_RECOVERY, F_STATE, F_TAKEOFF, F_TAKEOFF_C, F_TAKEOFF_D, START, S_ARRIVAL, S_BLOCK,
    S_C, S_D, S_DEP, S_EARLY, S_FLYING, S_GAP, S_HI, S_HOLD, S_IDLE, S_KIND, S_LATEST, S_LEAVE,
    S_LO, S_NODE, S_RELEASE, WAITING, World,
)

A_TIME, A_FREE_D, A_FREE_C, A_HI, A_LO, A_DEP, A_OLDEST, A_FLYING = range(8)


@inlined
def origin(world: World, k: int, time: int) -> tuple[int, int]:
    """Return the pair of an arrival at `time`, at the beginning of a block."""
    if is_steady(world.type[k]):
        return 0, NONE
    return NONE, time


@inlined
def travel(world: World, k: int, duration: int, d: int, c: int) -> tuple[int, int]:
    """Return the pair at the end of a leg of `duration` at full speed."""
    if is_steady(world.type[k]):
        return d + duration, c + duration
    return NONE, leg_end(world.type[k], world.profile_time[k], world.profile_factor[k], duration, c)


@inlined
def serve(world: World, k: int, stop: IntArray, time: int, d: int, c: int) -> tuple[int, int]:
    """Return the pair at the end of what a truck does at a stop by itself, reached at (d, c)."""
    kind = stop[S_KIND]
    if kind == CUSTOMER:
        place = world.place[stop[S_NODE]]
        start_d, start_c = start_within(place, time, d, c)
        return start_d + service_duration(place), start_c + service_duration(place)
    if kind == START:
        ready = max(c, max(stop[S_RELEASE], stop[S_HOLD]))
        return d, leaves_first(world.type[k], ready)
    return d, c


@inlined
def plain_block(world: World, k: int, stop: IntArray, time: int) -> None:
    """Write the block of a stop without launches, reached at `time`. In place."""
    d, c = origin(world, k, time)
    stop[S_D], stop[S_C] = serve(world, k, stop, time, d, c)
    stop[S_LO], stop[S_HI], stop[S_DEP] = NONE, FAR, FAR
    if stop[S_KIND] == CUSTOMER:
        place = world.place[stop[S_NODE]]
        stop[S_LO], stop[S_HI] = allowed_within(place, time, 0, NONE)
        stop[S_DEP] = as_late(place, time)
    elif stop[S_KIND] == END:
        stop[S_HI] = world.type[k, TYPE_LATEST]


@inlined
def make_ready(world: World, k: int, stops: IntArray, sorties: IntArray, count: int) -> None:
    """Have the sorties of a route wait for their launches. In place.

    And write how long each is held back: until windows let it be back within the endurance.
    """
    columns = world.type[k]
    legs = legs_of(world.leg, columns[TYPE_DRONE_TRAVEL])
    for s in range(count):
        sortie = sorties[s]
        node = stops[sortie[F_RECOVERY], S_NODE]
        back = home = 0
        for index in range(sortie[F_COUNT] - 1, -1, -1):
            customer = sortie[F_NODE + index]
            place = world.place[customer]
            home += leg(legs, customer, node).duration
            back = max(back, earliest_back(columns, place, home))
            home += drone_service(columns, place)
            node = customer
        sortie[F_STATE], sortie[F_HELD] = WAITING, held_until(columns, back)


@inlined
def bound_arrival(acc: IntArray, first: int, last: int) -> None:
    """Let the truck arrive at the block from `first` to `last`. In place."""
    acc[A_LO], acc[A_HI] = max(acc[A_LO], first), min(acc[A_HI], last)


@inlined
def reach(place: IntArray, arrival: int, d: int, c: int, acc: IntArray) -> bool:
    """Bound the truck's arrival by the window of a customer reached at (d, c), at `arrival`.

    In place; False if that is too late however soon the truck arrives.
    """
    if too_late(place, c):
        return False
    first, last = allowed_within(place, acc[A_TIME], d, c)
    bound_arrival(acc, first, last)
    acc[A_DEP] = min(acc[A_DEP], as_late(place, arrival) - d)
    return True


@inlined
def fly_out(places: IntArray, legs: IntArray, columns: IntArray, sortie: IntArray, node: int,
            acc: IntArray) -> bool:
    """Launch a sortie from `node` once the truck's crew is free. In place; False if not allowed."""
    arrivals = (F_NODE + len(sortie)) // 2
    d = take_off(columns, acc[A_FREE_D])
    c = max(take_off(columns, acc[A_FREE_C]), sortie[F_HELD])
    acc[A_FREE_D], acc[A_FREE_C] = d, c
    sortie[F_TAKEOFF_D], sortie[F_TAKEOFF_C] = d, c
    sortie[F_TAKEOFF] = max(acc[A_TIME] + d, c)
    for index in range(sortie[F_COUNT]):
        customer = sortie[F_NODE + index]
        flight = leg(legs, node, customer).duration
        place = places[customer]
        d, c = d + flight, c + flight
        arrival = max(acc[A_TIME] + d, c)
        if unreachable(flight) or not reach(place, arrival, d, c, acc):
            return False
        sortie[arrivals + index] = arrival
        d, c = start_within(place, acc[A_TIME], d, c)
        service = drone_service(columns, place)
        d, c = d + service, c + service
        node = customer
    sortie[F_READY_D], sortie[F_READY_C] = d, c
    sortie[F_STATE] = FLYING
    acc[A_FLYING] += 1
    return True


@inlined
def bring_home(legs: IntArray, columns: IntArray, sortie: IntArray, node: int,
               acc: IntArray) -> bool:
    """Recover a sortie at `node`. In place; False if endurance forbids it."""
    last = sortie[F_NODE + sortie[F_COUNT] - 1]
    flight = leg(legs, last, node).duration
    back_d, back_c = sortie[F_READY_D] + flight, sortie[F_READY_C] + flight
    begin_d, begin_c = max(acc[A_FREE_D], back_d), max(acc[A_FREE_C], back_c)
    if unreachable(flight):
        return False
    first, last = enduring_within(columns, sortie[F_TAKEOFF_D], sortie[F_TAKEOFF_C],
                                  counted_until(columns, back_d, begin_d),
                                  counted_until(columns, back_c, begin_c))
    bound_arrival(acc, first, last)
    begin = max(acc[A_TIME] + begin_d, begin_c)
    sortie[F_BEGIN] = begin
    slack = begin - begin_d
    if sortie[F_TAKEOFF] - sortie[F_TAKEOFF_D] > slack:
        acc[A_DEP] = min(acc[A_DEP], slack)
    acc[A_FREE_D] = recovery_end(columns, begin_d)
    acc[A_FREE_C] = recovery_end(columns, begin_c)
    sortie[F_STATE] = DONE
    acc[A_FLYING] -= 1
    return acc[A_LO] <= acc[A_HI]


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
                flight = leg(legs, last, node).duration
                begin = max(2 * free, 2 * (max(acc[A_TIME] + sorties[index, F_READY_D],
                                               sorties[index, F_READY_C]) + flight))
        elif (sorties[index, F_STATE] == WAITING and sorties[index, F_LAUNCH] == p
              and is_aboard(sorties, index, acc[A_OLDEST])):
            begin = 2 * max(free, launch_begin(columns, sorties[index, F_HELD])) + 1
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
            idle -= service_duration(places[stops[p, S_NODE]])
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
    flights = legs_of(world.leg, columns[TYPE_DRONE_TRAVEL])
    d, c = origin(world, k, time)
    acc[A_TIME], acc[A_HI], acc[A_LO], acc[A_DEP] = time, FAR, NONE, FAR
    acc[A_OLDEST], acc[A_FLYING], p = oldest, 0, first
    while True:
        stop = stops[p]
        kind, node = stop[S_KIND], stop[S_NODE]
        stop[S_ARRIVAL], stop[S_BLOCK] = max(time + d, c), first
        if kind == CUSTOMER:
            if not reach(world.place[node], stop[S_ARRIVAL], d, c, acc):
                return -1
        elif kind == START:
            c = max(c, max(stop[S_RELEASE], stop[S_HOLD]))
        acc[A_FREE_D], acc[A_FREE_C] = d, c
        d, c = serve(world, k, stop, time, d, c)
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
        legs = legs_of(world.leg, columns[TYPE_TRAVEL])
        stop[S_GAP] = leg(legs, node, stops[p + 1, S_NODE]).duration
        d, c = travel(world, k, stop[S_GAP], d, c)
        p += 1
    stops[first, S_D], stops[first, S_C], stops[first, S_HI] = d, c, acc[A_HI]
    stops[first, S_LO], stops[first, S_DEP] = acc[A_LO], acc[A_DEP]
    note_idle(world.place, stops, first, p)
    return p
