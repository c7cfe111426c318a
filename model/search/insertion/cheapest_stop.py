"""The cheapest stop for a customer where only the distance of the detour counts."""

from model.kernel.compiled import inlined, pasted, spliced
from model.kernel.instance import FAR
from model.kernel.leg import LegRow, leg_from, leg_to, legs_from, legs_to, nearness
from model.kernel.load import release_of
from model.kernel.records import Record, Records
from model.kernel.stop import end_of_service, places_of, too_late
from model.problem import IntArray, UIntArray
from model.search.insertion.evaluate import INFEASIBLE, price_stop
from model.search.route.edit import AT_STOP
from model.search.route.goods import goods_may_join
from model.search.route.halts import Room, room_behind, room_on
from model.search.route.layout import CHANGING, MODE_SIMPLE, MODE_TIMED, NOWHERE, Fleet, World
from model.search.route.randomness import uniform
from model.search.route.rarer import tiers_of
from model.search.route.vehicles import larger_type, route_cost, takes


@spliced
def is_simple(world: World, fleet: Fleet, slot: int) -> bool:
    """Tell whether an insertion into a route costs its detour alone."""
    return (world.mode[fleet.route[slot].type] & MODE_SIMPLE > 0
            and fleet.route[slot].sorties == 0)


@spliced
def scan_stops(inward: LegRow, onward: LegRow, stops: Records, first: int, last: int,
               skipped: int, place: Records, room: Room, spare: int, rate: float, best: float,
               blink: float, rng: UIntArray) -> tuple[float, int]:
    """Find the cheapest place for a customer behind one of the stops from `first` to `last`.

    But for stop `skipped`, where cost is that of the detour, which is at most `spare`. `inward` and
    `onward` are the legs to and from the customer, (node, 2); a better place is overlooked with
    probability `blink`. Returns its cost and the stop, or `best` and -1 if none costs less.
    """
    chosen = -1
    for p in range(first, last + 1):
        out, on = leg_from(inward, stops[p].node), leg_to(onward, stops[p + 1].node)
        detour = out.distance + on.distance - stops[p].leg
        cost = detour * rate
        if cost >= best or detour > spare or p == skipped or not room_behind(room, p):
            continue
        arrival = stops[p].leave + out.duration
        if too_late(place, arrival):
            if too_late(place, stops[p].leave):
                break
            continue
        arrival = end_of_service(place, arrival) + on.duration
        if arrival <= stops[p + 1].latest and uniform(rng) >= blink:
            chosen, best = p, cost
    return best, chosen


@inlined
def scan_delayed(world: World, k: int, inward: LegRow, onward: LegRow, stops: Records,
                 start: int, first: int, last: int, node: int, room: Room, spare: int, rate: float,
                 best: float, blink: float, rng: UIntArray) -> tuple[float, int]:
    """As `scan_stops`, on a trip from stop `start` that has to wait for the customer's parcel."""
    places = places_of(world.place, world.type[k])
    chosen, place = -1, places[node]
    leave = release_of(place)
    if leave > stops[start].latest:
        return best, chosen
    for p in range(start, last + 1):
        if p > start:
            arrival = leave + stops[p - 1].gap
            if arrival > stops[p].latest:
                break
            leave = end_of_service(places[stops[p].node], arrival)
        if too_late(place, leave):
            break
        out, on = leg_from(inward, stops[p].node), leg_to(onward, stops[p + 1].node)
        detour = out.distance + on.distance - stops[p].leg
        cost = detour * rate
        arrival = leave + out.duration
        if (p < first or cost >= best or detour > spare or too_late(place, arrival)
                or not room_behind(room, p)):
            continue
        arrival = end_of_service(place, arrival) + on.duration
        if arrival <= stops[p + 1].latest and uniform(rng) >= blink:
            chosen, best = p, cost
    return best, chosen


@inlined
def scan_limited(world: World, fleet: Fleet, slot: int, first: int, last: int, node: int,
                 room: Room, spare: int, rate: float, best: float, blink: float, rng: UIntArray
                 ) -> tuple[float, int]:
    """As `scan_stops`, on a route whose vehicle may only work for some time."""
    kind = world.type[fleet.route[slot].type]
    chosen, stops, place = -1, fleet.stop[slot], places_of(world.place, kind)[node]
    m = kind.travel
    inward, onward = legs_to(world.back, m, node), legs_from(world.leg, m, node)
    for p in range(first, last + 1):
        out, on = leg_from(inward, stops[p].node), leg_to(onward, stops[p + 1].node)
        detour = out.distance + on.distance - stops[p].leg
        cost = detour * rate
        if cost >= best or detour > spare or not room_behind(room, p):
            continue
        if too_late(place, stops[p].leave):
            break
        if price_stop(world, fleet, slot, p, node) < INFEASIBLE and uniform(rng) >= blink:
            chosen, best = p, cost
    return best, chosen


@spliced
def scan_trip(world: World, fleet: Fleet, slot: int, index: int, first: int, last: int, node: int,
              by: int, best: float, blink: float, rng: UIntArray) -> tuple[float, int]:
    """Find the cheapest place for a customer on a trip, by type `by`. As `scan_stops`."""
    k, trip, stops = fleet.route[slot].type, fleet.trip[slot, index], fleet.stop[slot]
    m = world.type[k].travel
    inward, onward = legs_to(world.back, m, node), legs_from(world.leg, m, node)
    place, rate = places_of(world.place, world.type[k])[node], world.rate[by].distance
    room = room_on(world, fleet, slot, by, node)
    spare = world.type[k].max_trip_distance - trip.distance
    if world.mode[k] & MODE_TIMED:
        return scan_limited(world, fleet, slot, first, last, node, room, spare, rate, best, blink,
                            rng)
    if release_of(place) > stops[trip.first].leave:
        return scan_delayed(world, k, inward, onward, stops, trip.first, first, last, node,
                            room, spare, rate, best, blink, rng)
    return scan_stops(inward, onward, stops, first, last, -1, place, room, spare, rate, best,
                      blink, rng)


@spliced
def serving_type(world: World, fleet: Fleet, slot: int, index: int, node: int,
                 enlarge: bool) -> tuple[int, float]:
    """Return the type that would serve a customer more on a trip, and what it costs more.

    A larger one if `enlarge`; or `NOWHERE`.
    """
    k = fleet.route[slot].type
    if not goods_may_join(world, fleet, slot, index, node):
        return NOWHERE, 0.0
    if takes(world, fleet, slot, index, k, node):
        return k, world.rate[k].stop
    if not enlarge:
        return NOWHERE, 0.0
    by = larger_type(world, fleet, slot, node)
    if by < 0:
        return NOWHERE, 0.0
    cost = route_cost(world, by, fleet.trip[slot, 0]) + world.rate[by].stop
    return by, cost - fleet.cost[slot]


@spliced
def shortest_detour(inward: LegRow, onward: LegRow, stops: Records, last: int, place: Records,
                    room: Room, best: int) -> tuple[int, int]:
    """Return the shortest detour for a customer on a lean route, and the stop before it.

    Or `best` and -1 if there is none shorter.
    """
    chosen = -1
    for p in range(last):
        out, on = leg_from(inward, stops[p].node), leg_to(onward, stops[p + 1].node)
        detour = out.distance + on.distance - stops[p].leg
        if detour >= best or not room_behind(room, p):
            continue
        arrival = stops[p].leave + out.duration
        if too_late(place, arrival):
            if too_late(place, stops[p].leave):
                break
            continue
        arrival = end_of_service(place, arrival) + on.duration
        if arrival <= stops[p + 1].latest:
            chosen, best = p, detour
    return best, chosen


@spliced
def scan_kept(world: World, fleet: Fleet, slot: int, node: int, rate: float, best: float,
              kept: Record) -> tuple[float, int]:
    """As `scan_stops`, on a lean route that this turn doesn't change, but for overlooking.

    Most turns are undone, so that most routes are as when the customer was inserted before.
    """
    stamp = fleet.route[slot].stamp
    if kept.stamp != stamp or (kept.stop < 0 and kept.detour * rate < best):
        kind = world.type[fleet.route[slot].type]
        m = kind.travel
        most = FAR
        # Also where distance costs nothing, or a larger vehicle saves more than any detour costs.
        if abs(best) < FAR * rate:
            most = int(best / rate) + 1
        kept.stamp = stamp
        kept.detour, kept.stop = shortest_detour(
            legs_to(world.back, m, node), legs_from(world.leg, m, node), fleet.stop[slot],
            fleet.trip[slot, 0].last, places_of(world.place, kind)[node],
            room_on(world, fleet, slot, fleet.route[slot].type, node), most)
    cost = kept.detour * rate
    if cost >= best:
        return best, -1
    return cost, kept.stop


@spliced
def is_too_far(world: World, fleet: Fleet, slot: int, node: int, best: float,
               kept: Records) -> bool:
    """Tell whether a customer is known to cost no less than `best` on a route as it is.

    That is so of most routes, so nothing else is asked of them. `kept` as in `Searcher`.
    """
    stamp, rate = fleet.route[slot].stamp, world.rate[fleet.route[slot].type]
    return (world.scan_all and stamp != CHANGING and kept[node, slot].stamp == stamp
            and kept[node, slot].detour * rate.distance >= best - rate.stop)


@spliced
def scan_lean(world: World, fleet: Fleet, active: IntArray, num_active: int, node: int,
              best: float, enlarge: bool, kept: Records, move: Record, rng: UIntArray) -> float:
    """Find the cheapest stop where all routes are lean; return the best cost so far.

    In place: `move`, if that is a stop that costs less than `best`; also `kept`, as in `Searcher`.
    """
    for index in range(num_active):
        slot = active[index]
        if not enlarge and is_too_far(world, fleet, slot, node, best, kept):
            continue
        k = fleet.route[slot].type
        if not world.can[k, 0, node]:
            continue
        by, base = serving_type(world, fleet, slot, 0, node, enlarge)
        if by < 0 or (by != k and base >= best):
            continue
        rate = world.rate[by].distance
        skipped, changing = -1, not world.scan_all or fleet.route[slot].stamp == CHANGING
        # What is kept is where there is room on the vehicle as it is.
        changing = changing or (by != k and tiers_of(world) > 0)
        cost, p = best, -1
        if not changing:
            cost, p = scan_kept(world, fleet, slot, node, rate, best - base, kept[node, slot])
            if p >= 0 and uniform(rng) < world.blink:
                skipped, changing = p, True
        if changing:
            m = world.type[k].travel
            cost, p = scan_stops(
                legs_to(world.back, m, node), legs_from(world.leg, m, node), fleet.stop[slot], 0,
                fleet.trip[slot, 0].last - 1, skipped,
                places_of(world.place, world.type[k])[node],
                room_on(world, fleet, slot, by, node), FAR, rate, best - base, world.blink, rng)
        if p >= 0:
            best = cost + base
            move.kind, move.slot, move.first, move.type = AT_STOP, slot, p, by
    return best


@spliced
def scan_simple(world: World, fleet: Fleet, slot: int, node: int, enlarge: bool,
                bound: Record, move: Record, rng: UIntArray) -> None:
    """Find the cheapest stop on a route where only distance counts. As `places.try_route`."""
    k = fleet.route[slot].type
    for trip in range(fleet.route[slot].trips):
        by, base = serving_type(world, fleet, slot, trip, node, enlarge)
        if by < 0 or (by != k and base >= bound.best):
            continue
        cost, p = scan_trip(
            world, fleet, slot, trip, fleet.trip[slot, trip].first,
            fleet.trip[slot, trip].last - 1, node, by, bound.best - base, bound.blink, rng)
        if p >= 0:
            bound.best = cost + base
            move.kind, move.slot, move.first, move.type = AT_STOP, slot, p, by


@spliced
def is_too_far_beside(inward: LegRow, onward: LegRow, stops: Records, p: int, other: int,
                      rate: float, best: float) -> bool:
    """Tell whether to insert a customer beside stop `p`, at `other`, costs no less than `best`.

    By the triangle inequality, with a stop between which and this one the customer would come that
    is no nearer; beside that, if it is, the same place is looked at as well.
    """
    near = nearness(inward, onward, other)
    return (2 * near - max(stops[p - 1].leg, stops[p].leg)) * rate >= best


@pasted
def scan_beside(world: World, fleet: Fleet, node: int, best: float, enlarge: bool,
                move: Record, rng: UIntArray) -> float:
    """Find the cheapest stop beside neighbours where only distance counts. As `scan_lean`."""
    for rank in range(world.fit.shape[1]):
        other = int(world.fit[node, rank])
        slot = fleet.where[other].slot
        if slot < 0:
            continue
        k = fleet.route[slot].type
        if not (is_simple(world, fleet, slot) and world.can[k, 0, node]):
            continue
        p = fleet.where[other].position
        m, stops = world.type[k].travel, fleet.stop[slot]
        if not enlarge and is_too_far_beside(
                legs_to(world.back, m, node), legs_from(world.leg, m, node), stops, p, other,
                world.rate[k].distance, best - world.rate[k].stop):
            continue
        trip = stops[p].trip
        by, base = serving_type(world, fleet, slot, trip, node, enlarge)
        if by < 0 or (by != k and base >= best):
            continue
        cost, p = scan_trip(world, fleet, slot, trip, p - 1, p, node, by, best - base,
                            world.blink, rng)
        if p >= 0:
            best = cost + base
            move.kind, move.slot, move.first, move.type = AT_STOP, slot, p, by
    return best


@spliced
def scan_beside_lean(world: World, fleet: Fleet, node: int, best: float, enlarge: bool,
                     move: Record, rng: UIntArray) -> float:
    """Find the cheapest stop beside neighbours where all routes are lean. As `scan_lean`."""
    for rank in range(world.fit.shape[1]):
        other = int(world.fit[node, rank])
        slot, behind = fleet.where[other].slot, fleet.where[other].position
        if slot < 0:
            continue
        k = fleet.route[slot].type
        m, stops = world.type[k].travel, fleet.stop[slot]
        inward, onward = legs_to(world.back, m, node), legs_from(world.leg, m, node)
        if not enlarge and is_too_far_beside(inward, onward, stops, behind, other,
                                             world.rate[k].distance, best - world.rate[k].stop):
            continue
        if not world.can[k, 0, node]:
            continue
        by, base = serving_type(world, fleet, slot, 0, node, enlarge)
        if by < 0 or (by != k and base >= best):
            continue
        rate, place = world.rate[by].distance, places_of(world.place, world.type[k])[node]
        room = room_on(world, fleet, slot, by, node)
        for p in (behind - 1, behind):
            out, on = leg_from(inward, stops[p].node), leg_to(onward, stops[p + 1].node)
            cost = (out.distance + on.distance - stops[p].leg) * rate + base
            arrival = stops[p].leave + out.duration
            following = end_of_service(place, arrival) + on.duration
            if (cost < best and not too_late(place, arrival) and following <= stops[p + 1].latest
                    and room_behind(room, p) and uniform(rng) >= world.blink):
                best = cost
                move.kind, move.slot, move.first, move.type = AT_STOP, slot, p, by
    return best
