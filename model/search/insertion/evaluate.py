"""What an insertion costs: from the blocks around it, or by timing the whole route again."""

from model.kernel.compiled import inlined, spliced
from model.kernel.drone_types import drone_row_at, first_drone, num_drone_rows
from model.kernel.instance import FAR, NONE
from model.kernel.leg import leg, leg_from, legs_of, legs_to
from model.kernel.load import release_of
from model.kernel.records import Record, Records
from model.kernel.start import counted_from
from model.kernel.stop import as_late, end_of_service, places_of, service_duration, too_late
from model.search.route.block import make_ready, plain_block, time_block
from model.search.route.edit import (
    AT_STOP, BY_SORTIE, BY_TRUCK, FLIGHT_TRIP, FROM_START, NEW_TRIP, ON_SORTIE, TRIP_FROM,
    TRIP_UNTIL, WAYS, apply, begin_route,
)
from model.search.route.ends import is_apart
from model.search.route.halts import load_more_behind
from model.search.route.layout import (
    CUSTOMER, END, MODE_PRICED, MODE_RETIMED, MODE_SETTLED, START, Fleet, World, copy_sequence,
)
from model.search.route.rarer import loads_cost
from model.search.route.refresh import refresh
from model.search.route.routes import longer_cost, sortie_cost, window_cost
from model.search.route.vehicles import launch_changed, launches_before

INFEASIBLE = 1e300


@inlined
def copy_part(fleet: Fleet, slot: int, first: int, last: int, to: int) -> int:
    """Copy the sequence of stops `first` to `last` with their sorties to another slot.

    In place; returns how many sorties were skipped.
    """
    source, target = fleet.stop[slot], fleet.stop[to]
    for p in range(first, last + 1):
        copy_sequence(source[p], target[p - first])
        target[p - first].hold = NONE
    skipped, count = 0, 0
    sorties, copies = fleet.sortie[slot], fleet.sortie[to]
    for s in range(fleet.route[slot].sorties):
        launch = sorties[s].launch
        if launch < first:
            skipped += 1
        elif launch <= last:
            copies[count] = sorties[s]
            copies[count].launch -= first
            copies[count].recovery -= first
            count += 1
    fleet.route[to] = fleet.route[slot]
    fleet.route[to].length, fleet.route[to].sorties = last - first + 1, count
    return skipped


@inlined
def part_of(vehicle_type: Record, fleet: Fleet, slot: int, move: Record,
            held: bool) -> tuple[int, int]:
    """Return the first and last stop of the blocks that a move changes.

    `held` tells that the trip will begin later, so that all from its beginning on changes.
    """
    stops = fleet.stop[slot]
    kind, p = move.kind, move.first
    q = p + 1
    if kind == BY_SORTIE:
        q = move.last
    elif kind == ON_SORTIE:
        p = fleet.sortie[slot, move.sortie].launch
        q = fleet.sortie[slot, move.sortie].recovery
    p, q = max(p, 0), min(q, fleet.route[slot].length - 1)
    if kind in (BY_SORTIE, TRIP_FROM, TRIP_UNTIL):
        q = max(q, launch_changed(vehicle_type, fleet.route[slot], fleet.sortie[slot],
                                  fleet.trip[slot, stops[p].trip], p, kind == BY_SORTIE))
    if held:
        p = fleet.trip[slot, stops[p].trip].first
    return stops[p].block, stops[stops[q].block].last


@spliced
def time_part(world: World, fleet: Fleet, slot: int, first: int, to: int, acc: Record) -> bool:
    """Time the changed stops in slot `to`, which take the place of those from `first` on.

    In place; False if a rule is broken. Leaves the sums so far in the route of slot `to`.
    """
    route, stops, sorties = fleet.route[to], fleet.stop[to], fleet.sortie[to]
    old = fleet.stop[slot]
    k, length, count = route.type, route.length, route.sorties
    legs = legs_of(world.leg, world.type[k].travel)
    time, cum = old[first].arrival, old[first].before
    depart = old[first - 1].depart if first > 0 else FAR
    make_ready(world, k, stops, sorties, count)
    acc.launched = launches_before(world.type[k], fleet.route[slot], fleet.sortie[slot],
                                   fleet.trip[slot, old[first].trip], first)
    p = s = driven = 0
    while p < length:
        stop, last = stops[p], p
        if stop.kind == START:
            acc.launched = 0
        if s < count and sorties[s].launch == p:
            last = time_block(world, k, stops, length, sorties, count, p, s, time, acc)
            if last < 0:
                return False
            while s < count and sorties[s].launch <= last:
                s += 1
            for q in range(p, last):
                driven += leg(legs, stops[q].node, stops[q + 1].node).distance
        else:
            plain_block(world, k, stop, time)
        if time > stop.hi or time < stop.lo:
            return False
        depart = min(depart, stop.dep - cum)
        cum += stop.d
        time = max(time + stop.d, stop.c)
        p = last + 1
        if p < length:
            if stops[last].kind == END:
                gap = world.type[k].reload_duration
            else:
                way = leg(legs, stops[last].node, stops[p].node)
                gap = way.duration
                driven += way.distance
            cum, time = cum + gap, time + gap
    acc.end, acc.cum, acc.depart, acc.driven = time, cum, depart, driven
    return True


@spliced
def price_part(world: World, fleet: Fleet, slot: int, first: int, last: int, to: int,
               acc: Record) -> float:
    """Return what it costs to put the stops in slot `to` in the place of `first` to `last`."""
    if not time_part(world, fleet, slot, first, to, acc):
        return INFEASIBLE
    time, cum, depart, driven = acc.end, acc.cum, acc.depart, acc.driven
    route, old = fleet.route[slot], fleet.stop[slot]
    k, end = route.type, time
    if last + 1 < route.length:
        arrival = time + old[last].gap
        behind = old[last + 1]
        cum += old[last].gap
        if arrival > behind.latest or arrival < behind.early:
            return INFEASIBLE
        depart = min(depart, behind.latest - cum)
        cum += behind.rest
        end = max(arrival + behind.rest, behind.end)
    working = end - counted_from(world.type[k], min(depart, end - cum)) - route.offset
    if working > world.type[k].max_working_duration:
        return INFEASIBLE
    for p in range(first, last):
        driven -= old[p].leg
    cost = driven * world.rate[k].distance + longer_cost(
        world.type[k], world.rate[k], route, end, working)
    for s in range(fleet.route[to].sorties):
        cost += sortie_cost(world, k, fleet.stop[to], fleet.sortie[to, s])
    for s in range(route.sorties):
        if first <= fleet.sortie[slot, s].launch <= last:
            cost -= sortie_cost(world, k, old, fleet.sortie[slot, s])
    return cost


@inlined
def serve_alone(world: World, fleet: Fleet, slot: int, k: int, node: int, by_drone: bool,
                acc: Record) -> bool:
    """Write the route that serves a customer alone at the least cost. In place; False if none may.

    Where it begins and ends at one place, a drone leaves from the start, and comes back there.
    """
    start, end = world.type[k].begins_at, world.type[k].ends_at
    first = FROM_START if by_drone else BY_TRUCK
    ways = WAYS - FROM_START if by_drone and start != end else 1
    number = ways * num_drone_rows(world.type, k) if by_drone else 1
    best, chosen, done = INFEASIBLE, 0, False
    for tried in range(number if number == 1 else number + 1):
        # The last time, the best of them is written once more.
        option = chosen if tried == number else tried
        row = drone_row_at(world.type, k, option // ways)
        done = not by_drone or world.can[row, 1, node]
        if done:
            begin_route(fleet.route[slot], fleet.stop[slot], fleet.sortie[slot], k, start, end,
                        node, first + option % ways, first_drone(world.type, k, row))
            done = refresh(world, fleet, slot, acc)
        if done and fleet.cost[slot] < best:
            best, chosen = fleet.cost[slot], option
    return done


@inlined
def give_releases(fleet: Fleet, to: int, alone: bool, trip: Record, release: int) -> None:
    """Let the trips in slot `to` begin no earlier than their parcels are there.

    In place; `alone` tells that the customer has a trip of its own.
    """
    for p in range(fleet.route[to].length):
        stop = fleet.stop[to, p]
        if stop.kind == START:
            if stop.release == NONE:
                stop.release = release
                if not alone:
                    stop.release = max(release, trip.release)
            elif p == 0 and not alone:
                stop.release = max(stop.release, release)


@spliced
def price_move(world: World, fleet: Fleet, move: Record, node: int, acc: Record) -> float:
    """Return what it costs to insert a customer as `move` says; INFEASIBLE if it can't be."""
    slot, to = move.slot, len(fleet.route) - 1
    route = fleet.route[slot]
    k = route.type
    depot = world.type[k].depot
    if world.mode[k] & MODE_PRICED or (is_apart(world, k) and move.kind >= NEW_TRIP):
        copy_part(fleet, slot, 0, route.length - 1, to)
        apply(depot, fleet.route[to], fleet.stop[to], fleet.sortie[to], move, node, 0, 0)
        if not refresh(world, fleet, to, acc):
            return INFEASIBLE
        return fleet.cost[to] - fleet.cost[slot]
    kind = move.kind
    trip = fleet.trip[slot, fleet.stop[slot, max(move.first, 0)].trip]
    if kind == ON_SORTIE:
        trip = fleet.trip[slot, fleet.stop[slot, fleet.sortie[slot, move.sortie].launch].trip]
    release = release_of(world.place[0, node])
    alone = kind in (NEW_TRIP, FLIGHT_TRIP)
    held = not alone and release > trip.release
    first, last = part_of(world.type[k], fleet, slot, move, held)
    skipped = copy_part(fleet, slot, first, last, to)
    apply(depot, fleet.route[to], fleet.stop[to], fleet.sortie[to], move, node, first, skipped)
    give_releases(fleet, to, alone, trip, release)
    cost = price_part(world, fleet, slot, first, last, to, acc)
    if kind in (AT_STOP, NEW_TRIP, TRIP_FROM, TRIP_UNTIL):
        cost += world.rate[k].stop
    return cost


@spliced
def stands_alone(world: World, fleet: Fleet, slot: int, p: int, node: int) -> bool:
    """Tell whether `price_stop` can price a customer behind stop `p`.

    No drone is in the air there, the trip needs not wait for the parcel and, if lateness counts,
    no drone flies at all, so that stops follow one another in time.
    """
    mode = world.mode[fleet.route[slot].type]
    stop = fleet.stop[slot, p]
    if mode & MODE_PRICED and (mode & (MODE_SETTLED | MODE_RETIMED)
                               or fleet.route[slot].sorties > 0):
        return False
    return (stop.flying == 0
            and release_of(world.place[0, node]) <= fleet.trip[slot, stop.trip].release)


@inlined
def follow(world: World, route: Record, stops: Records, p: int, time: int, cum: int,
           depart: int) -> tuple[float, int, int, int]:
    """Return what lateness costs more if stop `p` is reached at `time`, and how the route ends.

    That is its end, the sum of all durations, and the latest departure that costs nothing; `cum`
    and `depart` are those up to stop `p`. No drone flies.
    """
    cost, last = 0.0, route.length - 1
    places = places_of(world.place, world.type[route.type])
    for q in range(p, last + 1):
        stop = stops[q]
        leave = time
        if stop.kind == CUSTOMER:
            node = stop.node
            place = places[node]
            cost += window_cost(world, node, time) - stop.window_cost
            depart = min(depart, as_late(place, time) - cum)
            leave, cum = end_of_service(place, time), cum + service_duration(place)
        elif stop.kind == START:
            leave = max(time, stop.release)
        time = leave
        if q < last:
            time, cum = time + stop.gap, cum + stop.gap
    return cost, time, cum, depart


@spliced
def price_stop(world: World, fleet: Fleet, slot: int, p: int, node: int) -> float:
    """Return what it costs to insert a customer behind stop `p`; INFEASIBLE if it can't be.

    For where `stands_alone`; in constant time unless lateness costs.
    """
    route, stops = fleet.route[slot], fleet.stop[slot]
    k, here, behind = route.type, stops[p], stops[p + 1]
    place = places_of(world.place, world.type[k])[node]
    m = world.type[k].travel
    out = leg_from(legs_to(world.back, m, node), here.node)
    on = leg(legs_of(world.leg, m), node, behind.node)
    time, cum = here.leave + out.duration, here.cum + out.duration
    if too_late(place, time):
        return INFEASIBLE
    cost = (out.distance + on.distance - here.leg) * world.rate[k].distance
    if loads_cost(world, k):
        cost += load_more_behind(world, fleet, slot, p, node, out.distance, on.distance)
    depart = min(here.depart, as_late(place, time) - cum)
    late = window_cost(world, node, time)
    time = end_of_service(place, time) + on.duration
    cum += service_duration(place) + on.duration
    if time > behind.latest or time < behind.early:
        return INFEASIBLE
    if world.mode[k] & MODE_PRICED:
        later, end, cum, depart = follow(world, route, stops, p + 1, time, cum, depart)
        cost += late + later
    else:
        depart = min(depart, behind.latest - cum)
        end, cum = max(time + behind.rest, behind.end), cum + behind.rest
    working = end - counted_from(world.type[k], min(depart, end - cum)) - route.offset
    if working > world.type[k].max_working_duration:
        return INFEASIBLE
    return cost + world.rate[k].stop + longer_cost(
        world.type[k], world.rate[k], route, end, working)
