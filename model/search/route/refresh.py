"""Bringing a route up to date after its sequence has changed."""

from model.kernel.clock import leg_start
from model.kernel.compiled import inlined, spliced
from model.kernel.instance import FAR, NONE, TYPE_MAX_WORKING
from model.kernel.start import counted_from, leaves_first
from model.kernel.stop import latest_free_arrival
from model.problem import IntArray, UIntArray
from model.search.route.layout import (
    CUSTOMER, ELSEWHERE, F_COUNT, F_LAUNCH, F_NODE, F_RECOVERY, F_TAKEOFF, MODE_LEAN, MODE_PROFILE,
    MODE_SETTLED, NOWHERE, R_CUM, R_END, R_LENGTH, R_OFFSET, R_SORTIES, R_TRIPS, R_TYPE, R_WORKING,
    START, S_ARRIVAL, S_BEFORE, S_DEP, S_GAP, S_HOLD, S_KIND, S_LAST, S_LEAVE, S_NODE, S_RELEASE,
    T_FIRST, W_POSITION, W_SLOT, W_SORTIE, Fleet, World,
)
from model.search.route.lean import refresh_lean
from model.search.route.randomness import below
from model.search.route.routes import (
    drive_forward, first_departure, load_trips, look_back, open_up, price_route,
)

MOST_DRAWS = 64
"""Draws after which a search for one of few customers ends."""


@inlined
def latest_hold(world: World, route: IntArray, stops: IntArray, sorties: IntArray,
                first: int) -> int:
    """Return the latest start of the trip that begins at stop `first` which costs nothing.

    Where speed changes with time, no later than keeps all blocks with sorties as they are.
    """
    k, length = route[R_TYPE], route[R_LENGTH]
    if not world.mode[k] & MODE_PROFILE:
        base = stops[first, S_BEFORE]
        hold = route[R_END] - (route[R_CUM] - base)
        p = first
        while p < length:
            hold = min(hold, stops[p, S_DEP] - (stops[p, S_BEFORE] - base))
            p = stops[p, S_LAST] + 1
        return hold
    return latest_by_profile(world, route, stops, sorties, first)


@inlined
def has_sortie(route: IntArray, sorties: IntArray, p: int) -> bool:
    """Tell whether a drone is launched or recovered at a stop or in the air meanwhile."""
    found = False
    for s in range(route[R_SORTIES]):
        found = found or sorties[s, F_LAUNCH] <= p <= sorties[s, F_RECOVERY]
    return found


@inlined
def latest_by_profile(world: World, route: IntArray, stops: IntArray, sorties: IntArray,
                      first: int) -> int:
    """Return the latest start of a trip that costs nothing where speed changes. See above."""
    k, length = route[R_TYPE], route[R_LENGTH]
    leave = FAR
    p = length - 1
    while p >= first:
        stop = stops[p]
        plain = not has_sortie(route, sorties, p)
        arrival = stop[S_ARRIVAL]
        if p == length - 1 and plain:
            leave = stop[S_LEAVE]
        if plain and stop[S_KIND] == CUSTOMER:
            place = world.place[stop[S_NODE]]
            arrival = latest_free_arrival(place, stop[S_ARRIVAL], leave)
        elif plain:
            arrival = leave
        leave = arrival
        if p > first:
            gap = stops[p - 1, S_GAP]
            if stop[S_KIND] == START:
                leave = arrival - gap
            else:
                leave = leg_start(world.type[k], world.profile_time[k], world.profile_factor[k],
                                  gap, arrival)
        p -= 1
    return leave


@inlined
def clear_holds(route: IntArray, stops: IntArray, trips: IntArray) -> None:
    """Let every trip begin as soon as possible. In place."""
    for index in range(route[R_TRIPS]):
        stops[trips[index, T_FIRST], S_HOLD] = NONE


@inlined
def settle(world: World, route: IntArray, stops: IntArray, trips: IntArray, sorties: IntArray,
           acc: IntArray) -> bool:
    """Let each trip of a timed route begin as late as costs nothing. In place."""
    for index in range(route[R_TRIPS]):
        first = trips[index, T_FIRST]
        stop = stops[first]
        hold = latest_hold(world, route, stops, sorties, first)
        if hold > max(stop[S_ARRIVAL], stop[S_RELEASE]):
            end = route[R_END]
            stop[S_HOLD] = hold
            if not drive_forward(world, route, stops, sorties, acc) or route[R_END] > end:
                # Drones in another order of arrival took longer.
                stop[S_HOLD] = NONE
                if not drive_forward(world, route, stops, sorties, acc):
                    return False
    return True


@inlined
def settled_departure(world: World, route: IntArray, stops: IntArray, sorties: IntArray) -> int:
    """Return when truck or drone first leaves the depot on a settled route."""
    depart, columns = FAR, world.type[route[R_TYPE]]
    for s in range(route[R_SORTIES]):
        if sorties[s, F_LAUNCH] == 0:
            depart = min(depart, sorties[s, F_TAKEOFF])
    if depart == FAR:
        depart = max(stops[0, S_ARRIVAL], max(stops[0, S_RELEASE], stops[0, S_HOLD]))
        depart = leaves_first(columns, depart)
    return counted_from(columns, depart)


@inlined
def refresh(world: World, fleet: Fleet, slot: int, acc: IntArray) -> bool:
    """Write all that follows from the sequence of a route. In place; False if it breaks a rule."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    trips, sorties = fleet.trip[slot], fleet.sortie[slot]
    mode = world.mode[route[R_TYPE]]
    if mode & MODE_LEAN:
        return refresh_lean(world, fleet, slot)
    if not load_trips(world, route, stops, trips, sorties):
        return False
    clear_holds(route, stops, trips)
    if not drive_forward(world, route, stops, sorties, acc):
        return False
    depart = first_departure(world, route, stops, sorties)
    if mode & MODE_SETTLED:
        if not settle(world, route, stops, trips, sorties, acc):
            return False
        depart = settled_departure(world, route, stops, sorties)
    route[R_WORKING] = route[R_END] - depart
    if route[R_WORKING] > world.type[route[R_TYPE], TYPE_MAX_WORKING]:
        return False
    fleet.cost[slot], early = price_route(world, route, stops, trips, sorties)
    fleet.early[slot] = early if mode & MODE_SETTLED else 0.0
    if mode & MODE_SETTLED:
        clear_holds(route, stops, trips)
        drive_forward(world, route, stops, sorties, acc)
    if mode & MODE_PROFILE:
        open_up(route, stops)
    else:
        look_back(world, route, stops)
    return True


@spliced
def idle_time(route: IntArray) -> int:
    """Return how much of the time that a route works is waiting, which a change may use up."""
    return route[R_WORKING] + route[R_OFFSET] - route[R_CUM]


@spliced
def any_customer(world: World, fleet: Fleet, rng: UIntArray) -> int:
    """Return a random customer whom this thread deals with, served or left out.

    Whoever comes last if this thread deals with too few to be found.
    """
    number = world.num_nodes - world.num_depots
    node = world.num_depots
    for _ in range(MOST_DRAWS):
        node = world.num_depots + below(rng, number)
        if fleet.where[node, W_SLOT] != ELSEWHERE:
            break
    return node


@spliced
def stop_beside(fleet: Fleet, node: int) -> int:
    """Return the stop at a customer, or the one from where a drone flies there."""
    p = fleet.where[node, W_POSITION]
    if p < 0:
        p = fleet.sortie[fleet.where[node, W_SLOT], fleet.where[node, W_SORTIE], F_LAUNCH]
    return p


@inlined
def locate(fleet: Fleet, slot: int) -> None:
    """Write where the customers of a route are. In place."""
    route, stops, sorties = fleet.route[slot], fleet.stop[slot], fleet.sortie[slot]
    for p in range(route[R_LENGTH]):
        if stops[p, S_KIND] == CUSTOMER:
            where = fleet.where[stops[p, S_NODE]]
            where[W_SLOT], where[W_POSITION], where[W_SORTIE] = slot, p, NOWHERE
    for s in range(route[R_SORTIES]):
        for visit in range(sorties[s, F_COUNT]):
            where = fleet.where[sorties[s, F_NODE + visit]]
            where[W_SLOT], where[W_POSITION], where[W_SORTIE] = slot, NOWHERE, s
