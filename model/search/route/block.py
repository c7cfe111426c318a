"""Timing of a block: the stops of a truck from one where all drones are aboard to the next.

By pairs `(d, c)`, which docs/search.md derives under "Times on a route".
"""

from model.kernel.clock import is_steady, leg_end, setup_beside
from model.kernel.compiled import inlined, spliced
from model.kernel.energy import (
    after_hovering, charges_aboard, hovers_at_customers, is_limited, longest_hover,
)
from model.kernel.flight import (
    counted_until, earliest_back, endurance_of, held_until, lasting_within, launch_begin,
    recovery_end, take_off, unreachable,
)
from model.kernel.instance import FAR, NONE
from model.kernel.leg import TravelLegs, leg, legs_of
from model.kernel.records import Record, Records, record
from model.kernel.start import leaves_first
from model.kernel.stop import (
    allowed_within, are_single, end_of_service, in_same_window, latest_allowed, places_of,
    service_duration, start_within, too_late,
)
from model.search.route.batteries import await_charge, charge, hover, note_charge
from model.search.route.craft import Skies, craft_of, skies_of
from model.search.route.layout import CUSTOMER, DONE, END, FLYING, START, WAITING, World

SUMS = record("time", "free_d", "free_c", "hi", "lo", "dep", "oldest", "flying",
              # Of the trip so far: launches, and its first sortie.
              "launched", "first_sortie",
              # Of the route so far: how long launches wait for batteries to be charged.
              "awaited",
              # What `evaluate` makes of a part.
              "end", "cum", "depart", "driven")


@inlined
def origin(world: World, k: int, time: int) -> tuple[int, int]:
    """Return the pair of an arrival at `time`, at the beginning of a block."""
    if is_steady(world.type[k]):
        return 0, NONE
    return NONE, time


@inlined
def travel(world: World, k: int, node: int, to: int, duration: int, d: int,
           c: int) -> tuple[int, int]:
    """Return the pair at the end of a leg of `duration` at full speed, from `node` to another."""
    if is_steady(world.type[k]):
        return d + duration, c + duration
    arrival = leg_end(world.type[k], world.profile_time[k], world.profile_factor[k], duration, c)
    return NONE, arrival + setup_beside(world.type[k], world.setup, node, to)


@inlined
def serve(world: World, k: int, stop: Record, time: int, d: int, c: int) -> tuple[int, int]:
    """Return the pair at the end of what a truck does at a stop by itself, reached at (d, c)."""
    kind = stop.kind
    if kind == CUSTOMER:
        place = places_of(world.place, world.type[k])[stop.node]
        start_d, start_c = start_within(place, time, d, c)
        return start_d + service_duration(place), start_c + service_duration(place)
    if kind == START:
        ready = max(c, max(stop.release, stop.hold))
        return d, leaves_first(world.type[k], ready)
    return d, c


@inlined
def plain_block(world: World, k: int, stop: Record, time: int) -> None:
    """Write the block of a stop without launches, reached at `time`. In place."""
    d, c = origin(world, k, time)
    stop.d, stop.c = serve(world, k, stop, time, d, c)
    stop.lo, stop.hi, stop.dep = NONE, FAR, FAR
    if stop.kind == CUSTOMER:
        place = world.place[0, stop.node]
        stop.hi = latest_allowed(place)
        stop.dep = in_same_window(place, time)
    elif stop.kind == END:
        stop.hi = world.type[k].shift_latest


@inlined
def make_ready(world: World, k: int, stops: Records, sorties: Records, count: int) -> None:
    """Have the sorties of a route wait for their launches. In place.

    And write how long each is held back: until windows let it be back within its limit. Where some
    have several, that hangs on when it could begin, and is for `soonest_takeoff`.
    """
    skies, single = skies_of(world, k), are_single(world.place[0, 0])
    for s in range(count):
        sortie = sorties[s]
        kind, places, legs, homeward = craft_of(skies, sortie)
        node = sortie.home = stops[sortie.recovery].node
        sortie.state, sortie.held, sortie.limit = WAITING, NONE, endurance_of(kind)
        if is_limited(kind):
            charge(places, legs, homeward, kind, sortie, stops[sortie.launch].node)
        if not single:
            continue
        back, home = 0, leg(homeward, sortie.nodes[sortie.count - 1], node).duration
        for index in range(sortie.count - 1, -1, -1):
            customer = sortie.nodes[index]
            place = places[customer]
            back = max(back, earliest_back(place, NONE, home))
            home += service_duration(place)
            if index > 0:
                home += leg(legs, sortie.nodes[index - 1], customer).duration
        sortie.held = held_until(back, sortie.limit)


@inlined
def held_by_windows(places: Records, legs: TravelLegs, homeward: TravelLegs, kind: Record,
                    sortie: Record, node: int, takeoff: int) -> int:
    """Return until when the windows hold a sortie back that it meets if it leaves at `takeoff`."""
    time, back, here = takeoff, NONE, node
    for index in range(sortie.count):
        customer = sortie.nodes[index]
        place, flight = places[customer], leg(legs, here, customer).duration
        back = max(back + flight + service_duration(place),
                   earliest_back(place, time + flight, 0))
        time = end_of_service(place, time + flight)
        here = customer
    return held_until(back + leg(homeward, here, sortie.home).duration, sortie.limit)


@inlined
def soonest_takeoff(places: Records, legs: TravelLegs, homeward: TravelLegs, kind: Record,
                    sortie: Record, node: int, takeoff: int) -> int:
    """Return when a sortie takes off at `node` that can at `takeoff`: then, or held back."""
    takeoff = max(takeoff, sortie.held)
    if charges_aboard(kind):
        takeoff = max(takeoff, sortie.charged)
    if are_single(places[0]):
        return takeoff
    held = held_by_windows(places, legs, homeward, kind, sortie, node, takeoff)
    while held > takeoff:
        takeoff = held
        held = held_by_windows(places, legs, homeward, kind, sortie, node, takeoff)
    return takeoff


@inlined
def bound_arrival(acc: Record, first: int, last: int) -> None:
    """Let the truck arrive at the block from `first` to `last`. In place."""
    acc.lo, acc.hi = max(acc.lo, first), min(acc.hi, last)


@inlined
def reach(place: Records, arrival: int, d: int, c: int, acc: Record) -> bool:
    """Bound the truck's arrival by the window of a customer reached at (d, c), at `arrival`.

    In place; False if that is too late however soon the truck arrives.
    """
    if too_late(place, c):
        return False
    first, last = allowed_within(place, acc.time, d, c)
    bound_arrival(acc, first, last)
    acc.dep = min(acc.dep, in_same_window(place, arrival) - d)
    return True


@inlined
def fly_out(places: Records, legs: TravelLegs, homeward: TravelLegs, kind: Record, sortie: Record,
            node: int, acc: Record) -> bool:
    """Launch a sortie from `node` once the truck's crew is free. In place; False if not allowed."""
    d = take_off(kind, acc.free_d, acc.launched)
    c = take_off(kind, acc.free_c, acc.launched)
    takeoff = max(acc.time + d, c)
    held = soonest_takeoff(places, legs, homeward, kind, sortie, node, takeoff)
    if held > takeoff:
        c = held
    if charges_aboard(kind):
        free = d
        d = max(d, await_charge(kind, sortie, max(acc.time + d, c), acc.time))
        acc.awaited += d - free
    acc.free_d, acc.free_c = d, c
    sortie.takeoff_d, sortie.takeoff_c = d, c
    sortie.takeoff = max(acc.time + d, c)
    for index in range(sortie.count):
        customer = sortie.nodes[index]
        flight = leg(legs, node, customer).duration
        place = places[customer]
        d, c = d + flight, c + flight
        arrival = max(acc.time + d, c)
        if unreachable(flight) or not reach(place, arrival, d, c, acc):
            return False
        sortie.arrivals[index] = arrival
        d, c = start_within(place, acc.time, d, c)
        service = service_duration(place)
        d, c = d + service, c + service
        node = customer
    sortie.ready_d, sortie.ready_c = d, c
    sortie.state = FLYING
    acc.flying += 1
    acc.launched += 1
    if hovers_at_customers(kind):
        hover(places, kind, sortie, acc)
    return not is_limited(kind) or sortie.left >= 0


@inlined
def bring_home(homeward: TravelLegs, kind: Record, sortie: Record, node: int,
               acc: Record) -> bool:
    """Recover a sortie at `node`. In place; False if endurance or energy forbids it."""
    last = sortie.nodes[sortie.count - 1]
    flight = leg(homeward, last, node).duration
    back_d, back_c = sortie.ready_d + flight, sortie.ready_c + flight
    begin_d, begin_c = max(acc.free_d, back_d), max(acc.free_c, back_c)
    if unreachable(flight):
        return False
    first, last = lasting_within(endurance_of(kind), sortie.takeoff_d, sortie.takeoff_c,
                                 counted_until(kind, back_d, begin_d),
                                 counted_until(kind, back_c, begin_c))
    bound_arrival(acc, first, last)
    if is_limited(kind):
        first, last = lasting_within(longest_hover(kind, sortie.left, sortie.taken), back_d, back_c,
                                     begin_d, begin_c)
        bound_arrival(acc, first, last)
        # A sortie as long as before may wait where that takes more.
        acc.dep = min(acc.dep, last)
    begin = max(acc.time + begin_d, begin_c)
    sortie.begin = begin
    if charges_aboard(kind):
        sortie.left = after_hovering(kind, sortie.left, sortie.taken,
                                     begin - max(acc.time + back_d, back_c))
    slack = begin - begin_d
    if sortie.takeoff - sortie.takeoff_d > slack:
        acc.dep = min(acc.dep, slack)
    acc.free_d = recovery_end(kind, begin_d)
    acc.free_c = recovery_end(kind, begin_c)
    sortie.state = DONE
    acc.flying -= 1
    return acc.lo <= acc.hi


@inlined
def is_aboard(sorties: Records, index: int, oldest: int) -> bool:
    """Tell whether the drone of a sortie has ended all sorties before it."""
    for other in range(oldest, index):
        if sorties[other].drone == sorties[index].drone and sorties[other].state != DONE:
            return False
    return True


@inlined
def next_operation(skies: Skies, sorties: Records, count: int, p: int, node: int,
                   acc: Record) -> int:
    """Return the sortie whose launch or recovery at stop `p` can begin first; -1: none is left.

    A drone that is there is recovered before another is launched.
    """
    chosen, earliest = -1, FAR
    free = max(acc.time + acc.free_d, acc.free_c)
    for index in range(acc.oldest, count):
        if sorties[index].launch > p:
            break
        begin = FAR
        if sorties[index].state == FLYING:
            if sorties[index].recovery == p:
                _, _, _, homeward = craft_of(skies, sorties[index])
                last = sorties[index].nodes[sorties[index].count - 1]
                flight = leg(homeward, last, node).duration
                begin = max(2 * free, 2 * (max(acc.time + sorties[index].ready_d,
                                               sorties[index].ready_c) + flight))
        elif (sorties[index].state == WAITING and sorties[index].launch == p
              and is_aboard(sorties, index, acc.oldest)):
            kind, places, legs, homeward = craft_of(skies, sorties[index])
            if charges_aboard(kind):
                note_charge(kind, sorties, index, acc.first_sortie)
            takeoff = soonest_takeoff(places, legs, homeward, kind, sorties[index], node,
                                      take_off(kind, free, acc.launched))
            begin = 2 * launch_begin(kind, takeoff, acc.launched) + 1
        if begin < earliest:
            chosen, earliest = index, begin
    return chosen


@inlined
def operate(skies: Skies, sorties: Records, count: int, p: int, node: int, acc: Record) -> bool:
    """Launch and recover all that stop `p` asks for. In place; False if not allowed."""
    while True:
        index = next_operation(skies, sorties, count, p, node, acc)
        if index < 0:
            break
        kind, places, legs, homeward = craft_of(skies, sorties[index])
        if sorties[index].state == FLYING:
            if not bring_home(homeward, kind, sorties[index], node, acc):
                return False
        elif not fly_out(places, legs, homeward, kind, sorties[index], node, acc):
            return False
    for index in range(acc.oldest, count):
        if sorties[index].launch > p:
            break
        if sorties[index].state == WAITING:
            return False
    while acc.oldest < count and sorties[acc.oldest].state == DONE:
        acc.oldest += 1
    return True


@inlined
def note_idle(places: Records, stops: Records, first: int, last: int) -> None:
    """Write how long the truck waits for drones in a block, at all stops but the last. In place."""
    idle = stops[first].d
    for p in range(first, last + 1):
        if stops[p].kind == CUSTOMER:
            idle -= service_duration(places[stops[p].node])
        if p < last:
            idle -= stops[p].gap
    for p in range(first, last):
        stops[p].idle = idle
    stops[last].idle = 0


@spliced
def time_block(world: World, k: int, stops: Records, length: int, sorties: Records, count: int,
               first: int, oldest: int, time: int, acc: Record) -> int:
    """Write the block from stop `first`, which the truck reaches at `time`. In place.

    `oldest` is the first sortie not yet over. Returns the block's last stop, -1 if not allowed.
    """
    vehicle_type = world.type[k]
    places, skies = places_of(world.place, vehicle_type), skies_of(world, k)
    d, c = origin(world, k, time)
    acc.time, acc.hi, acc.lo, acc.dep = time, FAR, NONE, FAR
    acc.oldest, acc.flying, p = oldest, 0, first
    while True:
        stop = stops[p]
        kind, node = stop.kind, stop.node
        stop.arrival, stop.block = max(time + d, c), first
        if kind == CUSTOMER:
            if not reach(places[node], stop.arrival, d, c, acc):
                return -1
        elif kind == START:
            c = max(c, max(stop.release, stop.hold))
        acc.free_d, acc.free_c = d, c
        d, c = serve(world, k, stop, time, d, c)
        if not operate(skies, sorties, count, p, node, acc):
            return -1
        d, c = max(d, acc.free_d), max(c, acc.free_c)
        stop.leave, stop.flying = max(time + d, c), acc.flying
        stop.latest, stop.early = FAR, NONE
        if kind == END:
            if c > vehicle_type.shift_latest:
                return -1
            acc.hi = min(acc.hi, vehicle_type.shift_latest - d)
        if acc.flying == 0:
            break
        if kind == END or p + 1 >= length:
            return -1
        legs = legs_of(world.leg, vehicle_type.travel)
        stop.gap = leg(legs, node, stops[p + 1].node).duration
        d, c = travel(world, k, node, stops[p + 1].node, stop.gap, d, c)
        p += 1
    stops[first].d, stops[first].c, stops[first].hi = d, c, acc.hi
    stops[first].lo, stops[first].dep = acc.lo, acc.dep
    note_idle(places, stops, first, p)
    return p
