"""Bringing a route up to date after its sequence has changed."""

from model.kernel.clock import is_steady, leg_start, setup_beside
from model.kernel.compiled import inlined, pasted, spliced
from model.kernel.instance import FAR, NONE
from model.kernel.records import Record, Records
from model.kernel.start import counted_from
from model.kernel.stop import latest_free_arrival, places_of
from model.problem import UIntArray
from model.search.route.ends import is_apart, nearest_reload
from model.search.route.freshness import any_too_long, departure_of, hold_trips
from model.search.route.goods import take_goods
from model.search.route.halts import load_cost, weigh
from model.search.route.layout import (
    CUSTOMER, ELSEWHERE, END, MODE_LEAN, MODE_RETIMED, MODE_SETTLED, NOWHERE, START, Fleet, World,
)
from model.search.route.lean import refresh_lean
from model.search.route.randomness import below
from model.search.route.rarer import goods_count, loads_cost, tiers_aboard, time_aboard_counts
from model.search.route.routes import (
    drive_forward, first_departure, load_trips, look_back, open_up, price_route,
)

HALVINGS = 6
"""Attempts to find out how late a trip may begin whose drones come in another order if it waits."""

MOST_DRAWS = 64
"""Draws after which a search for one of few customers ends."""


@inlined
def latest_hold(world: World, route: Record, stops: Records, sorties: Records,
                first: int) -> int:
    """Return the latest start of the trip that begins at stop `first` which costs nothing.

    If all is retimed, either by moving the whole trip within the windows that are met, or stop by
    stop, which may reach others but leaves blocks with sorties as they are.
    """
    k, length = route.type, route.length
    hold = NONE
    if is_steady(world.type[k]):
        base = stops[first].before
        hold = route.end - (route.cum - base)
        p = first
        while p < length:
            hold = min(hold, stops[p].dep - (stops[p].before - base))
            p = stops[p].last + 1
    if world.mode[k] & MODE_RETIMED:
        hold = max(hold, latest_by_stops(world, route, stops, sorties, first))
    return hold


@inlined
def has_sortie(route: Record, sorties: Records, p: int) -> bool:
    """Tell whether a drone is launched or recovered at a stop or in the air meanwhile."""
    found = False
    for s in range(route.sorties):
        found = found or sorties[s].launch <= p <= sorties[s].recovery
    return found


@inlined
def latest_by_stops(world: World, route: Record, stops: Records, sorties: Records,
                      first: int) -> int:
    """Return the latest start of a trip that costs nothing, by each stop's last arrival."""
    k, length = route.type, route.length
    places = places_of(world.place, world.type[k])
    leave = FAR
    p = length - 1
    while p >= first:
        stop = stops[p]
        plain = not has_sortie(route, sorties, p)
        arrival = stop.arrival
        if p == length - 1 and plain:
            leave = stop.leave
        if plain and stop.kind == CUSTOMER:
            arrival = latest_free_arrival(places[stop.node], stop.arrival, leave)
        elif plain:
            arrival = leave
        leave = arrival
        if p > first:
            gap = stops[p - 1].gap
            if stop.kind == START:
                leave = arrival - gap
            else:
                arrival -= setup_beside(world.type[k], world.setup, stops[p - 1].node, stop.node)
                leave = leg_start(world.type[k], world.profile_time[k], world.profile_factor[k],
                                  gap, arrival)
        p -= 1
    return leave


@inlined
def clear_holds(route: Record, stops: Records, trips: Records) -> None:
    """Let every trip begin as soon as possible. In place."""
    for index in range(route.trips):
        stops[trips[index].first].hold = NONE


@spliced
def settle(world: World, route: Record, stops: Records, trips: Records, sorties: Records,
           acc: Record) -> bool:
    """Let each trip of a timed route begin as late as costs nothing. In place."""
    for index in range(route.trips):
        first = trips[index].first
        stop = stops[first]
        hold = latest_hold(world, route, stops, sorties, first)
        soonest = max(stop.arrival, stop.release)
        if hold > soonest:
            end, found, failed, tried = route.end, NONE, hold, hold
            for _ in range(1 + HALVINGS):
                stop.hold = tried
                if (drive_forward(world, route, stops, sorties, acc) and route.end <= end
                        and not any_too_long(world, route, stops, trips, sorties)):
                    found = tried
                else:
                    # Drones in another order of arrival took longer.
                    failed = tried
                if found == hold:
                    break
                tried = (max(found, soonest) + failed) // 2
            if stop.hold != found:
                stop.hold = found
                if not drive_forward(world, route, stops, sorties, acc):
                    return False
    return True


@inlined
def settled_departure(world: World, route: Record, stops: Records, sorties: Records) -> int:
    """Return when truck or drone first leaves the depot on a settled route."""
    return counted_from(world.type[route.type], departure_of(world, route, stops, sorties, 0))


@inlined
def has_to_wait(world: World, route: Record, stops: Records, sorties: Records) -> bool:
    """Tell whether a route with drones works too long unless it begins later than it could.

    Whether they then come in the order that its times were found by has to be seen.
    """
    if route.sorties == 0:
        return False
    soonest = settled_departure(world, route, stops, sorties)
    return route.end - soonest > world.type[route.type].max_working_duration


@inlined
def refresh(world: World, fleet: Fleet, slot: int, acc: Record) -> bool:
    """Write all that follows from the sequence of a route. In place; False if it breaks a rule.

    Where trips may end at several places, that which costs least is chosen between two.
    """
    route = fleet.route[slot]
    if world.mode[route.type] & MODE_LEAN:
        return refresh_lean(world, fleet, slot)
    if not refresh_as_is(world, fleet, slot, acc):
        return False
    if is_apart(world, route.type) and route.trips > 1:
        choose_reloads(world, fleet, slot, acc)
    return True


@inlined
def choose_reloads(world: World, fleet: Fleet, slot: int, acc: Record) -> None:
    """Let the trips of a route end, and the next begin, where that costs least. In place."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    for p in range(1, route.length - 1):
        if stops[p].kind != END:
            continue
        node, cost = stops[p].node, fleet.cost[slot]
        _, place = nearest_reload(world, route.type, stops[p - 1].node, stops[p + 2].node)
        if place == node:
            continue
        for end in (place, node):
            stops[p].node = end
            if refresh_as_is(world, fleet, slot, acc) and fleet.cost[slot] < cost:
                break


@inlined
def refresh_as_is(world: World, fleet: Fleet, slot: int, acc: Record) -> bool:
    """As `refresh`, of a route that isn't lean, with trips that end where they do."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    trips, sorties = fleet.trip[slot], fleet.sortie[slot]
    mode = world.mode[route.type]
    if not load_trips(world, route, stops, trips, sorties):
        return False
    if goods_count(world) and not take_goods(world.goods, route, stops, trips, sorties):
        return False
    if tiers_aboard(fleet) > 0 and not weigh(world, fleet, slot):
        return False
    clear_holds(route, stops, trips)
    if not drive_forward(world, route, stops, sorties, acc):
        return False
    if time_aboard_counts(world) and not hold_trips(world, route, stops, trips, sorties, acc):
        return False
    depart = first_departure(world, route, stops, sorties)
    settled = mode & MODE_SETTLED > 0 or has_to_wait(world, route, stops, sorties)
    if settled:
        if not settle(world, route, stops, trips, sorties, acc):
            return False
        depart = settled_departure(world, route, stops, sorties)
    route.working = route.end - depart
    if route.working > world.type[route.type].max_working_duration:
        return False
    fleet.cost[slot], early = price_route(world, route, stops, trips, sorties)
    if loads_cost(world, route.type):
        fleet.cost[slot] += load_cost(world, fleet, slot)
    fleet.early[slot] = early if mode & MODE_SETTLED else 0.0
    if settled:
        clear_holds(route, stops, trips)
        drive_forward(world, route, stops, sorties, acc)
    if mode & MODE_RETIMED:
        open_up(route, stops)
    else:
        look_back(world, route, stops)
    return True


@spliced
def idle_time(route: Record) -> int:
    """Return how much of the time that a route works is waiting, which a change may use up.

    For windows, or batteries.
    """
    return route.working + route.offset - route.cum + route.awaited


@spliced
def any_customer(world: World, fleet: Fleet, rng: UIntArray) -> int:
    """Return a random customer whom this thread deals with, served or left out.

    Whoever comes last if this thread deals with too few to be found.
    """
    number = world.num_nodes - world.num_depots
    node = world.num_depots
    for _ in range(MOST_DRAWS):
        node = world.num_depots + below(rng, number)
        if fleet.where[node].slot != ELSEWHERE:
            break
    return node


@spliced
def draw_customer(world: World, fleet: Fleet, focus: int, rng: UIntArray) -> int:
    """Return a random customer near `focus`, or anywhere if that is NOWHERE. As `any_customer`."""
    if focus >= 0:
        rank = below(rng, world.near.shape[1] + 1)
        node = focus
        if rank > 0:
            node = int(world.near[focus, rank - 1])
        if node >= 0 and fleet.where[node].slot != ELSEWHERE:
            return node
    return any_customer(world, fleet, rng)


@spliced
def stop_beside(fleet: Fleet, node: int) -> int:
    """Return the stop at a customer, or the one from where a drone flies there."""
    p = fleet.where[node].position
    if p < 0:
        p = fleet.sortie[fleet.where[node].slot, fleet.where[node].sortie].launch
    return p


@pasted
def locate(fleet: Fleet, slot: int) -> None:
    """Write where the customers of a route are. In place."""
    note_places(fleet.where, fleet.route[slot], fleet.stop[slot], fleet.sortie[slot], slot)


@inlined
def note_places(places: Records, route: Record, stops: Records, sorties: Records,
                slot: int) -> None:
    """Write where the customers of the route in a slot are. In place: `places` (node,) PLACE."""
    for p in range(route.length):
        if stops[p].kind == CUSTOMER:
            where = places[stops[p].node]
            where.slot, where.position, where.sortie = slot, p, NOWHERE
    for s in range(route.sorties):
        for visit in range(sorties[s].count):
            where = places[sorties[s].nodes[visit]]
            where.slot, where.position, where.sortie = slot, NOWHERE, s
