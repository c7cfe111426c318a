"""The cheapest place for a customer."""

from model.compiled import inlined, pasted, spliced
from model.instance import (
    MAX_DIMENSIONS, RATE_DRONE_KM, RATE_HOUR, RATE_KM, TYPE_COUNT, TYPE_DEPOT, TYPE_DRONES,
    TYPE_DRONE_SERVICE, TYPE_DRONE_TRAVEL, TYPE_ENDURANCE, TYPE_LAUNCH, TYPE_MAX_TRIPS,
    TYPE_PAYLOAD, TYPE_RECOVERY, TYPE_TRAVEL, TYPE_WAITING_COUNTS,
)
from model.problem import UNREACHABLE, FloatArray, IntArray, UIntArray
from model.search.draw import uniform
from model.search.edit import (
    AT_STOP, BY_SORTIE, FLIGHT_TRIP, M_DRONE, M_FIRST, M_KIND, M_LAST, M_SLOT, M_SORTIE, M_TYPE,
    NEW_ROUTE, NEW_TRIP, ON_SORTIE, TRIP_FROM, TRIP_UNTIL,
)
from model.search.evaluate import INFEASIBLE, price_move
from model.search.layout import (
    END, F_COUNT, F_DRONE, F_LAUNCH, F_NODE, F_RECOVERY, MODE_TIMED, NOWHERE, P_DEMAND, P_EARLIEST,
    P_LIMIT, P_SERVICE, R_LENGTH, R_SORTIES, R_TRIPS, R_TYPE, S_ARRIVAL, S_FLYING, S_GAP, S_IDLE,
    S_KIND, S_LATEST, S_LEAVE, S_LEG, S_NODE, S_TRIP, START, T_FIRST, T_LAST, W_SLOT, Fleet, World,
)
from model.search.refresh import idle_time, stop_beside
from model.search.rows import copy_row
from model.search.scan import fits, is_simple, scan_beside, scan_beside_lean, scan_lean, scan_simple
from model.search.splitting import more_trips_fit, part_fits

MORE_TRIPS = 0.2
"""How often a customer who can go on a trip as it is may begin or split one."""

MAX_SPAN = 8
"""How many stops after its launch a sortie is recovered at most."""


@spliced
def next_stop(world: World, k: int, back: IntArray, leg: IntArray, stops: IntArray, first: int,
              last: int, place: IntArray, spare: int, best: float) -> int:
    """Return the first stop from `first` to `last` behind which a customer may cost less.

    `spare` is the time that the route could work longer at no cost; returns -1 if there is none.
    """
    timed = world.mode[k] & MODE_TIMED
    rate, per_time = world.rate[k, RATE_KM], world.rate[k, RATE_HOUR]
    for p in range(first, last + 1):
        here, there = stops[p, S_NODE], stops[p + 1, S_NODE]
        cost = (back[here, 1] + leg[there, 1] - stops[p, S_LEG]) * rate
        if timed:
            # While drones fly, the truck may have time before they are back.
            longer = back[here, 0] + leg[there, 0] + place[P_SERVICE] - stops[p, S_GAP]
            cost += max(0, longer - spare - stops[p, S_IDLE]) * per_time
        if cost >= best:
            continue
        arrival = stops[p, S_LEAVE] + back[here, 0]
        leave = max(arrival, place[P_EARLIEST]) + place[P_SERVICE] + leg[there, 0]
        if arrival <= place[P_LIMIT] and leave <= stops[p + 1, S_LATEST]:
            return p
    return -1


@inlined
def take_if_cheaper(world: World, fleet: Fleet, node: int, best: float, move: IntArray,
                    trial: IntArray, rng: UIntArray, acc: IntArray) -> float:
    """Let `move` be the insertion in `trial` if that costs less than `best`, but for a blink.

    In place; returns the best cost so far.
    """
    cost = price_move(world, fleet, trial, node, acc)
    if cost < best and uniform(rng) >= world.blink:
        best = cost
        copy_row(trial, move)
    return best


@spliced
def try_stops(world: World, fleet: Fleet, slot: int, first: int, last: int, node: int,
              best: float, move: IntArray, trial: IntArray, rng: UIntArray,
              acc: IntArray) -> float:
    """Try a customer behind each stop from `first` to `last` where more than distance counts.

    In place: `move` takes the insertion if it is the best. Returns the best cost so far.
    """
    k = fleet.route[slot, R_TYPE]
    m = world.type[k, TYPE_TRAVEL]
    back, leg, stops = world.back[m, node], world.leg[m, node], fleet.stop[slot]
    place = world.place[node]
    spare = idle_time(fleet.route[slot])
    trial[M_KIND], trial[M_SLOT] = AT_STOP, slot
    p = first
    while True:
        p = next_stop(world, k, back, leg, stops, p, last, place, spare, best)
        if p < 0:
            return best
        trial[M_FIRST] = p
        best = take_if_cheaper(world, fleet, node, best, move, trial, rng, acc)
        p += 1


@spliced
def free_drone(world: World, fleet: Fleet, slot: int, launch: int, recovery: int) -> int:
    """Return a drone that is aboard from stop `launch` to `recovery`; -1 if there is none.

    That which flies least from and to these stops, so that drones fly side by side.
    """
    sorties = fleet.sortie[slot]
    chosen, fewest = NOWHERE, 0
    for drone in range(world.type[fleet.route[slot, R_TYPE], TYPE_DRONES]):
        free, beside = True, 0
        for s in range(fleet.route[slot, R_SORTIES]):
            if sorties[s, F_DRONE] == drone:
                first, last = sorties[s, F_LAUNCH], sorties[s, F_RECOVERY]
                if first <= recovery and launch <= last:
                    beside += 1
                if first < recovery and launch < last:
                    free = False
                if launch == recovery and first < launch < last:
                    free = False
                if first == last and launch < first < recovery:
                    free = False
                if first == launch and recovery > launch and last > first:
                    free = False
        if free and (chosen == NOWHERE or beside < fewest):
            chosen, fewest = drone, beside
    return chosen


@spliced
def try_sorties(world: World, fleet: Fleet, slot: int, launch: int, node: int, best: float,
                move: IntArray, trial: IntArray, rng: UIntArray, acc: IntArray) -> float:
    """Try a customer on sorties of its own from stop `launch`. As `try_stops`."""
    k = fleet.route[slot, R_TYPE]
    columns = world.type[k]
    flights, stops = columns[TYPE_DRONE_TRAVEL], fleet.stop[slot]
    out = world.back[flights, node, stops[launch, S_NODE]]
    if stops[launch, S_KIND] == END or out[0] >= UNREACHABLE:
        return best
    service = columns[TYPE_DRONE_SERVICE]
    if service < 0:
        service = world.place[node, P_SERVICE]
    last = fleet.trip[slot, stops[launch, S_TRIP], T_LAST]
    trial[M_KIND], trial[M_SLOT], trial[M_FIRST] = BY_SORTIE, slot, launch
    first = launch if world.loops else launch + 1
    last = min(last, launch + MAX_SPAN) if world.crossings else launch
    begun = (stops[launch, S_ARRIVAL] + columns[TYPE_RECOVERY] - idle_time(fleet.route[slot])
             + (columns[TYPE_LAUNCH] if launch > 0 else 0))
    per_time, per_distance = world.rate[k, RATE_HOUR], world.rate[k, RATE_DRONE_KM]
    for recovery in range(first, last + 1):
        home = world.leg[flights, node, stops[recovery, S_NODE]]
        away = stops[recovery, S_ARRIVAL] - stops[launch, S_LEAVE]
        if columns[TYPE_WAITING_COUNTS] and away > columns[TYPE_ENDURANCE]:
            break
        flight = out[0] + service + home[0]
        # The truck leaves no sooner than the drone is aboard, whatever else it has time for.
        longer = max(0, begun + flight - stops[recovery, S_LEAVE])
        if (home[0] >= UNREACHABLE or flight > columns[TYPE_ENDURANCE]
                or (out[1] + home[1]) * per_distance + longer * per_time >= best):
            continue
        drone = free_drone(world, fleet, slot, launch, recovery)
        if drone < 0:
            continue
        trial[M_LAST], trial[M_DRONE] = recovery, drone
        best = take_if_cheaper(world, fleet, node, best, move, trial, rng, acc)
    return best


@spliced
def lifts(world: World, sortie: IntArray, k: int, node: int) -> bool:
    """Tell whether a customer's demand fits on top of a sortie's payload."""
    for dimension in range(MAX_DIMENSIONS):
        payload = world.place[node, P_DEMAND + dimension]
        for visit in range(sortie[F_COUNT]):
            payload += world.place[sortie[F_NODE + visit], P_DEMAND + dimension]
        if payload > world.type[k, TYPE_PAYLOAD + dimension]:
            return False
    return True


@inlined
def try_joining(world: World, fleet: Fleet, slot: int, node: int, best: float, move: IntArray,
                trial: IntArray, rng: UIntArray, acc: IntArray) -> float:
    """Try a customer on the sorties of a route. As `try_stops`."""
    k = fleet.route[slot, R_TYPE]
    sorties = fleet.sortie[slot]
    for s in range(fleet.route[slot, R_SORTIES]):
        trip = fleet.stop[slot, sorties[s, F_LAUNCH], S_TRIP]
        if (sorties[s, F_COUNT] >= world.visits[k]
                or not fits(world.place, node, fleet.trip[slot], trip, world.type[k])
                or not lifts(world, sorties[s], k, node)):
            continue
        for place in range(sorties[s, F_COUNT] + 1):
            trial[M_KIND], trial[M_SLOT], trial[M_FIRST] = ON_SORTIE, slot, place
            trial[M_SORTIE] = s
            best = take_if_cheaper(world, fleet, node, best, move, trial, rng, acc)
    return best


@inlined
def try_flight_trips(world: World, fleet: Fleet, slot: int, node: int, best: float, move: IntArray,
                     trial: IntArray, rng: UIntArray, acc: IntArray) -> float:
    """Try a customer on trips that a drone flies alone. As `try_stops`."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    k = route[R_TYPE]
    flights, depot = world.type[k, TYPE_DRONE_TRAVEL], world.type[k, TYPE_DEPOT]
    out, home = world.back[flights, node, depot], world.leg[flights, node, depot]
    if (not world.loops or out[0] >= UNREACHABLE or home[0] >= UNREACHABLE
            or (out[1] + home[1]) * world.rate[k, RATE_DRONE_KM] >= best):
        return best
    trial[M_KIND], trial[M_SLOT] = FLIGHT_TRIP, slot
    for p in range(-1, route[R_LENGTH]):
        if p < 0 or stops[p, S_KIND] == END:
            trial[M_FIRST] = p
            best = take_if_cheaper(world, fleet, node, best, move, trial, rng, acc)
    return best


@inlined
def try_trips(world: World, fleet: Fleet, slot: int, node: int, best: float, move: IntArray,
              trial: IntArray, rng: UIntArray, acc: IntArray) -> float:
    """Try a customer where a trip more begins or ends. As `try_stops`."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    k = route[R_TYPE]
    m, depot = world.type[k, TYPE_TRAVEL], world.type[k, TYPE_DEPOT]
    rate = world.rate[k, RATE_KM]
    out, home = world.back[m, node, depot, 1], world.leg[m, node, depot, 1]
    simple = is_simple(world, fleet, slot)
    trial[M_SLOT] = slot
    for p in range(-1, route[R_LENGTH]):
        kind = NEW_TRIP
        bound = (out + home) * rate
        if p >= 0 and stops[p, S_KIND] != END:
            if stops[p, S_FLYING] > 0 or stops[p, S_KIND] == START or stops[p + 1, S_KIND] == END:
                continue
            here, there = stops[p, S_NODE], stops[p + 1, S_NODE]
            base = -stops[p, S_LEG]
            until = (base + world.back[m, node, here, 1] + home
                     + world.leg[m, depot, there, 1]) * rate
            bound = (base + world.leg[m, here, depot, 1] + out
                     + world.leg[m, node, there, 1]) * rate
            kind = TRIP_FROM
            if until < bound:
                kind, bound = TRIP_UNTIL, until
            if bound < best and not part_fits(world, fleet, slot, p, node, kind == TRIP_UNTIL):
                continue
        if bound >= best or (p >= 0 and stops[p, S_LEAVE] > world.place[node, P_LIMIT]):
            continue
        trial[M_KIND], trial[M_FIRST] = kind, p
        if not simple:
            best = take_if_cheaper(world, fleet, node, best, move, trial, rng, acc)
        elif more_trips_fit(world, fleet, slot, p, node, kind) and uniform(rng) >= world.blink:
            best = bound
            copy_row(trial, move)
    return best


@pasted
def try_new_route(world: World, fleet: Fleet, alone: FloatArray, node: int, best: float,
                  move: IntArray, rng: UIntArray) -> float:
    """Try a customer on a route of its own. As `try_stops`."""
    for k in range(world.num_types):
        if fleet.used[k] >= world.type[k, TYPE_COUNT]:
            continue
        for by_drone in range(2 if world.loops else 1):
            cost = alone[k, by_drone, node]
            if cost < best and uniform(rng) >= world.blink:
                best = cost
                move[M_KIND], move[M_TYPE] = NEW_ROUTE + by_drone, k
    return best


@inlined
def try_trip(world: World, fleet: Fleet, slot: int, index: int, node: int, best: float,
             move: IntArray, trial: IntArray, rng: UIntArray, acc: IntArray) -> float:
    """Try a customer on a trip that `scan_simple` left out, or by a sortie. As `try_stops`."""
    k = fleet.route[slot, R_TYPE]
    first, last = fleet.trip[slot, index, T_FIRST], fleet.trip[slot, index, T_LAST]
    simple = is_simple(world, fleet, slot)
    if world.can[k, 0, node] and not simple:
        best = try_stops(world, fleet, slot, first, last - 1, node, best, move, trial, rng, acc)
    if world.can[k, 1, node]:
        for p in range(first, last):
            best = try_sorties(world, fleet, slot, p, node, best, move, trial, rng, acc)
    return best


@pasted
def find_place(world: World, fleet: Fleet, alone: FloatArray, active: IntArray, num_active: int,
               node: int, enlarge: bool, kept: IntArray, move: IntArray, trial: IntArray,
               rng: UIntArray, acc: IntArray) -> float:
    """Find the cheapest insertion of a customer; return its cost, INFEASIBLE if there is none.

    In place: `move`, and `kept` as in `Searcher`.
    """
    best = try_new_route(world, fleet, alone, node, INFEASIBLE, move, rng)
    if not world.general:
        return scan_lean(world, fleet, active, num_active, node, best, enlarge, kept, move, rng)
    best = scan_simple(world, fleet, active, num_active, node, best, enlarge, move, rng)
    more_trips = best == INFEASIBLE or uniform(rng) < MORE_TRIPS
    for index in range(num_active):
        slot = active[index]
        k = fleet.route[slot, R_TYPE]
        by_truck, by_drone = world.can[k, 0, node], world.can[k, 1, node]
        if not (by_truck or by_drone):
            continue
        simple = is_simple(world, fleet, slot)
        if by_drone or not simple:
            for trip in range(fleet.route[slot, R_TRIPS]):
                if fits(world.place, node, fleet.trip[slot], trip, world.type[k]):
                    best = try_trip(world, fleet, slot, trip, node, best, move, trial, rng, acc)
        if world.visits[k] > 1 and by_drone:
            best = try_joining(world, fleet, slot, node, best, move, trial, rng, acc)
        if more_trips and fleet.route[slot, R_TRIPS] < world.type[k, TYPE_MAX_TRIPS]:
            if by_truck:
                best = try_trips(world, fleet, slot, node, best, move, trial, rng, acc)
            if by_drone:
                best = try_flight_trips(world, fleet, slot, node, best, move, trial, rng, acc)
    return best


@pasted
def find_beside(world: World, fleet: Fleet, alone: FloatArray, node: int, enlarge: bool,
                move: IntArray, trial: IntArray, rng: UIntArray, acc: IntArray) -> float:
    """Find the cheapest insertion of a customer beside its neighbours. As `find_place`."""
    best = try_new_route(world, fleet, alone, node, INFEASIBLE, move, rng)
    if not world.general:
        return scan_beside_lean(world, fleet, node, best, enlarge, move, rng)
    best = scan_beside(world, fleet, node, best, enlarge, move, rng)
    for rank in range(world.fit.shape[1]):
        other = world.fit[node, rank]
        slot = fleet.where[other, W_SLOT]
        if slot < 0:
            continue
        k = fleet.route[slot, R_TYPE]
        by_truck, by_drone = world.can[k, 0, node], world.can[k, 1, node]
        simple = is_simple(world, fleet, slot)
        if not (by_drone or (by_truck and not simple)):
            continue
        p = stop_beside(fleet, other)
        trip = fleet.stop[slot, p, S_TRIP]
        if not fits(world.place, node, fleet.trip[slot], trip, world.type[k]):
            continue
        first = max(p - 1, fleet.trip[slot, trip, T_FIRST])
        if by_truck and not simple:
            best = try_stops(world, fleet, slot, first, p, node, best, move, trial, rng, acc)
        if by_drone:
            for q in range(first, p + 1):
                best = try_sorties(world, fleet, slot, q, node, best, move, trial, rng, acc)
    return best
