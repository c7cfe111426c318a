"""What an insertion costs: from the blocks around it, or by timing the whole route again."""

from model.kernel.compiled import inlined, spliced
from model.kernel.copying import copy_row
from model.kernel.instance import (
    RATE_HOUR, RATE_KM, TYPE_END, TYPE_MAX_WORKING, TYPE_RELOAD, TYPE_TRAVEL, FAR, NODE_RELEASE,
    NONE, TYPE_START,
)
from model.kernel.leg import leg, leg_at, legs_of, legs_to
from model.kernel.start import counted_from
from model.kernel.stop import as_late, end_of_service, service_duration, too_late
from model.problem import IntArray
from model.search.route.block import make_ready, plain_block, time_block
from model.search.route.edit import (
    BY_SORTIE, BY_TRUCK, FLIGHT_TRIP, FROM_START, M_FIRST, M_KIND, M_LAST, M_SLOT, M_SORTIE,
    NEW_TRIP, ON_SORTIE, WAYS, apply, begin_route,
)
from model.search.route.layout import (
    CUSTOMER, END, F_LAUNCH, F_RECOVERY, MODE_PRICED, MODE_PROFILE, MODE_SETTLED, R_LENGTH,
    R_OFFSET, R_SORTIES, R_TYPE, R_WORKING, SEQUENCE_COLUMNS, START, S_ARRIVAL, S_BEFORE, S_BLOCK,
    S_C, S_CUM, S_D, S_DEP, S_DEPART, S_EARLY, S_END, S_FLYING, S_GAP, S_HI, S_HOLD, S_KIND, S_LAST,
    S_LATEST, S_LEAVE, S_LEG, S_LO, S_NODE, S_RELEASE, S_REST, S_TRIP, T_FIRST, T_RELEASE, Fleet,
    World,
)
from model.search.route.refresh import refresh
from model.search.route.routes import sortie_cost, window_cost

INFEASIBLE = 1e300


@inlined
def copy_part(fleet: Fleet, slot: int, first: int, last: int, to: int) -> int:
    """Copy the sequence of stops `first` to `last` with their sorties to another slot.

    In place; returns how many sorties were skipped.
    """
    source, target = fleet.stop[slot], fleet.stop[to]
    for p in range(first, last + 1):
        for column in range(SEQUENCE_COLUMNS):
            target[p - first, column] = source[p, column]
        target[p - first, S_HOLD] = NONE
    skipped, count = 0, 0
    sorties, copies = fleet.sortie[slot], fleet.sortie[to]
    for s in range(fleet.route[slot, R_SORTIES]):
        launch = sorties[s, F_LAUNCH]
        if launch < first:
            skipped += 1
        elif launch <= last:
            copy_row(sorties[s], copies[count])
            copies[count, F_LAUNCH] -= first
            copies[count, F_RECOVERY] -= first
            count += 1
    copy_row(fleet.route[slot], fleet.route[to])
    fleet.route[to, R_LENGTH], fleet.route[to, R_SORTIES] = last - first + 1, count
    return skipped


@inlined
def part_of(fleet: Fleet, slot: int, move: IntArray, held: bool) -> tuple[int, int]:
    """Return the first and last stop of the blocks that a move changes.

    `held` tells that the trip will begin later, so that all from its beginning on changes.
    """
    stops = fleet.stop[slot]
    kind, p = move[M_KIND], move[M_FIRST]
    q = p + 1
    if kind == BY_SORTIE:
        q = move[M_LAST]
    elif kind == ON_SORTIE:
        p = fleet.sortie[slot, move[M_SORTIE], F_LAUNCH]
        q = fleet.sortie[slot, move[M_SORTIE], F_RECOVERY]
    p, q = max(p, 0), min(q, fleet.route[slot, R_LENGTH] - 1)
    if held:
        p = fleet.trip[slot, stops[p, S_TRIP], T_FIRST]
    return stops[p, S_BLOCK], stops[stops[q, S_BLOCK], S_LAST]


@inlined
def time_part(world: World, fleet: Fleet, slot: int, first: int, to: int, acc: IntArray) -> bool:
    """Time the changed stops in slot `to`, which take the place of those from `first` on.

    In place; False if a rule is broken. Leaves the sums so far in the route of slot `to`.
    """
    route, stops, sorties = fleet.route[to], fleet.stop[to], fleet.sortie[to]
    old = fleet.stop[slot]
    k, length, count = route[R_TYPE], route[R_LENGTH], route[R_SORTIES]
    legs = legs_of(world.leg, world.type[k, TYPE_TRAVEL])
    time, cum = old[first, S_ARRIVAL], old[first, S_BEFORE]
    depart = old[first - 1, S_DEPART] if first > 0 else FAR
    make_ready(world, k, stops, sorties, count)
    p = s = driven = 0
    while p < length:
        stop = stops[p]
        last = p
        if s < count and sorties[s, F_LAUNCH] == p:
            last = time_block(world, k, stops, length, sorties, count, p, s, time, acc)
            if last < 0:
                return False
            while s < count and sorties[s, F_LAUNCH] <= last:
                s += 1
            for q in range(p, last):
                driven += leg(legs, stops[q, S_NODE], stops[q + 1, S_NODE]).distance
        else:
            plain_block(world, k, stop, time)
        if time > stop[S_HI] or time < stop[S_LO]:
            return False
        depart = min(depart, stop[S_DEP] - cum)
        cum += stop[S_D]
        time = max(time + stop[S_D], stop[S_C])
        p = last + 1
        if p < length:
            if stops[last, S_KIND] == END:
                gap = world.type[k, TYPE_RELOAD]
            else:
                way = leg(legs, stops[last, S_NODE], stops[p, S_NODE])
                gap = way.duration
                driven += way.distance
            cum, time = cum + gap, time + gap
    acc[0], acc[1], acc[2], acc[3] = time, cum, depart, driven
    return True


@inlined
def price_part(world: World, fleet: Fleet, slot: int, first: int, last: int, to: int,
               acc: IntArray) -> float:
    """Return what it costs to put the stops in slot `to` in the place of `first` to `last`."""
    if not time_part(world, fleet, slot, first, to, acc):
        return INFEASIBLE
    time, cum, depart, driven = acc[0], acc[1], acc[2], acc[3]
    route, old = fleet.route[slot], fleet.stop[slot]
    k, end = route[R_TYPE], time
    if last + 1 < route[R_LENGTH]:
        arrival = time + old[last, S_GAP]
        behind = old[last + 1]
        cum += old[last, S_GAP]
        if arrival > behind[S_LATEST] or arrival < behind[S_EARLY]:
            return INFEASIBLE
        depart = min(depart, behind[S_LATEST] - cum)
        cum += behind[S_REST]
        end = max(arrival + behind[S_REST], behind[S_END])
    working = end - counted_from(world.type[k], min(depart, end - cum)) - route[R_OFFSET]
    if working > world.type[k, TYPE_MAX_WORKING]:
        return INFEASIBLE
    for p in range(first, last):
        driven -= old[p, S_LEG]
    cost = driven * world.rate[k, RATE_KM] + (working - route[R_WORKING]) * world.rate[k, RATE_HOUR]
    for s in range(fleet.route[to, R_SORTIES]):
        cost += sortie_cost(world, k, fleet.stop[to], fleet.sortie[to, s])
    for s in range(route[R_SORTIES]):
        if first <= fleet.sortie[slot, s, F_LAUNCH] <= last:
            cost -= sortie_cost(world, k, old, fleet.sortie[slot, s])
    return cost


@inlined
def serve_alone(world: World, fleet: Fleet, slot: int, k: int, node: int, by_drone: bool,
                acc: IntArray) -> bool:
    """Write the route that serves a customer alone at the least cost. In place; False if none may.

    Where it begins and ends at one place, a drone leaves from the start, and comes back there.
    """
    start, end = world.type[k, TYPE_START], world.type[k, TYPE_END]
    first = FROM_START if by_drone else BY_TRUCK
    last = WAYS if by_drone and start != end else first
    best, chosen, done = INFEASIBLE, first, False
    for tried in range(first, last + 1):
        # The last time, the best of them is written once more.
        way = chosen if tried == last else tried
        begin_route(fleet.route[slot], fleet.stop[slot], fleet.sortie[slot], k, start, end, node,
                    way)
        done = refresh(world, fleet, slot, acc)
        if done and fleet.cost[slot] < best:
            best, chosen = fleet.cost[slot], way
    return done


@inlined
def give_releases(fleet: Fleet, to: int, alone: bool, trip: IntArray, release: int) -> None:
    """Let the trips in slot `to` begin no earlier than their parcels are there.

    In place; `alone` tells that the customer has a trip of its own.
    """
    for p in range(fleet.route[to, R_LENGTH]):
        stop = fleet.stop[to, p]
        if stop[S_KIND] == START:
            if stop[S_RELEASE] == NONE:
                stop[S_RELEASE] = release
                if not alone:
                    stop[S_RELEASE] = max(release, trip[T_RELEASE])
            elif p == 0 and not alone:
                stop[S_RELEASE] = max(stop[S_RELEASE], release)


@inlined
def price_move(world: World, fleet: Fleet, move: IntArray, node: int, acc: IntArray) -> float:
    """Return what it costs to insert a customer as `move` says; INFEASIBLE if it can't be."""
    slot, to = move[M_SLOT], len(fleet.route) - 1
    route = fleet.route[slot]
    k = route[R_TYPE]
    depot = world.type[k, TYPE_END]
    if world.mode[k] & MODE_PRICED:
        copy_part(fleet, slot, 0, route[R_LENGTH] - 1, to)
        apply(depot, fleet.route[to], fleet.stop[to], fleet.sortie[to], move, node, 0, 0)
        if not refresh(world, fleet, to, acc):
            return INFEASIBLE
        return fleet.cost[to] - fleet.cost[slot]
    kind = move[M_KIND]
    trip = fleet.trip[slot, fleet.stop[slot, max(move[M_FIRST], 0), S_TRIP]]
    if kind == ON_SORTIE:
        trip = fleet.trip[slot, fleet.stop[slot, fleet.sortie[slot, move[M_SORTIE], F_LAUNCH],
                                           S_TRIP]]
    release = world.place[node, NODE_RELEASE]
    alone = kind in (NEW_TRIP, FLIGHT_TRIP)
    held = not alone and release > trip[T_RELEASE]
    first, last = part_of(fleet, slot, move, held)
    skipped = copy_part(fleet, slot, first, last, to)
    apply(depot, fleet.route[to], fleet.stop[to], fleet.sortie[to], move, node, first, skipped)
    give_releases(fleet, to, alone, trip, release)
    return price_part(world, fleet, slot, first, last, to, acc)


@spliced
def stands_alone(world: World, fleet: Fleet, slot: int, p: int, node: int) -> bool:
    """Tell whether `price_stop` can price a customer behind stop `p`.

    No drone is in the air there, the trip needs not wait for the parcel and, if lateness counts,
    no drone flies at all, so that stops follow one another in time.
    """
    mode = world.mode[fleet.route[slot, R_TYPE]]
    stop = fleet.stop[slot, p]
    if mode & MODE_PRICED and (mode & (MODE_SETTLED | MODE_PROFILE)
                               or fleet.route[slot, R_SORTIES] > 0):
        return False
    return (stop[S_FLYING] == 0
            and world.place[node, NODE_RELEASE] <= fleet.trip[slot, stop[S_TRIP], T_RELEASE])


@inlined
def follow(world: World, route: IntArray, stops: IntArray, p: int, time: int, cum: int,
           depart: int) -> tuple[float, int, int, int]:
    """Return what lateness costs more if stop `p` is reached at `time`, and how the route ends.

    That is its end, the sum of all durations, and the latest departure that costs nothing; `cum`
    and `depart` are those up to stop `p`. No drone flies.
    """
    cost, last = 0.0, route[R_LENGTH] - 1
    for q in range(p, last + 1):
        stop = stops[q]
        leave = time
        if stop[S_KIND] == CUSTOMER:
            node = stop[S_NODE]
            place = world.place[node]
            cost += window_cost(world, node, time) - window_cost(world, node, stop[S_ARRIVAL])
            depart = min(depart, as_late(place, time) - cum)
            leave, cum = end_of_service(place, time), cum + service_duration(place)
        elif stop[S_KIND] == START:
            leave = max(time, stop[S_RELEASE])
        time = leave
        if q < last:
            time, cum = time + stop[S_GAP], cum + stop[S_GAP]
    return cost, time, cum, depart


@spliced
def price_stop(world: World, fleet: Fleet, slot: int, p: int, node: int) -> float:
    """Return what it costs to insert a customer behind stop `p`; INFEASIBLE if it can't be.

    For where `stands_alone`; in constant time unless lateness costs.
    """
    route, stops, place = fleet.route[slot], fleet.stop[slot], world.place[node]
    k, here, behind = route[R_TYPE], stops[p], stops[p + 1]
    m = world.type[k, TYPE_TRAVEL]
    out = leg_at(legs_to(world.back, m, node), here[S_NODE])
    on = leg(legs_of(world.leg, m), node, behind[S_NODE])
    time, cum = here[S_LEAVE] + out.duration, here[S_CUM] + out.duration
    if too_late(place, time):
        return INFEASIBLE
    cost = (out.distance + on.distance - here[S_LEG]) * world.rate[k, RATE_KM]
    depart = min(here[S_DEPART], as_late(place, time) - cum)
    late = window_cost(world, node, time)
    time = end_of_service(place, time) + on.duration
    cum += service_duration(place) + on.duration
    if time > behind[S_LATEST] or time < behind[S_EARLY]:
        return INFEASIBLE
    if world.mode[k] & MODE_PRICED:
        later, end, cum, depart = follow(world, route, stops, p + 1, time, cum, depart)
        cost += late + later
    else:
        depart = min(depart, behind[S_LATEST] - cum)
        end, cum = max(time + behind[S_REST], behind[S_END]), cum + behind[S_REST]
    working = end - counted_from(world.type[k], min(depart, end - cum)) - route[R_OFFSET]
    if working > world.type[k, TYPE_MAX_WORKING]:
        return INFEASIBLE
    return cost + (working - route[R_WORKING]) * world.rate[k, RATE_HOUR]
