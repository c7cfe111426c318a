"""Insertions that begin a trip more on a route, or split one, where distance alone costs."""

from model.kernel.compiled import inlined, spliced
from model.kernel.instance import FAR
from model.kernel.leg import leg, legs_of
from model.kernel.load import (
    EMPTY, barred_on_trip, cargo_at, cargo_for, demand_of, followed, go_together, holds, may_be_all,
    may_follow, plus, release_of,
)
from model.kernel.records import Records
from model.kernel.shift import allows_stops
from model.kernel.stop import end_of_service, places_of, too_late
from model.search.route.edit import NEW_TRIP, TRIP_UNTIL
from model.search.route.layout import CUSTOMER, Fleet, World
from model.search.route.rarer import goods_count, tiers_aboard, tiers_of


@inlined
def part_joins(world: World, fleet: Fleet, slot: int, first: int, last: int, node: int) -> bool:
    """Tell whether a customer's goods may go with those from stop `first` to `last` of a trip."""
    if not goods_count(world):
        return True
    stops, sorties, barred = fleet.stop[slot], fleet.sortie[slot], 0
    for q in range(first, last + 1):
        if stops[q].kind == CUSTOMER:
            barred |= barred_on_trip(world.goods[stops[q].node])
    for s in range(fleet.route[slot].sorties):
        if first <= sorties[s].launch <= last:
            for visit in range(sorties[s].count):
                barred |= barred_on_trip(world.goods[sorties[s].nodes[visit]])
    return go_together(world.goods[node], barred, fleet.route[slot].barred)


@spliced
def part_fits(world: World, fleet: Fleet, slot: int, p: int, node: int, front: bool) -> bool:
    """Tell whether a customer may join a trip's up to stop `p`, or the rest, by what is carried."""
    stops, sorties = fleet.stop[slot], fleet.sortie[slot]
    trip = fleet.trip[slot, stops[p].trip]
    first, last = (trip.first, p) if front else (p + 1, trip.last)
    if not part_joins(world, fleet, slot, first, last, node):
        return False
    load, count = demand_of(world.place[0, node]), 1
    for q in range(first, last + 1):
        if stops[q].kind == CUSTOMER:
            count += 1
            load = plus(load, demand_of(world.place[0, stops[q].node]))
    kind = world.type[fleet.route[slot].type]
    if not allows_stops(kind, count):
        return False
    if tiers_aboard(fleet) > 0:
        for tier in range(tiers_aboard(fleet)):
            if not halves_fit(world, fleet, slot, p, node, front, tier):
                return False
        return True
    for s in range(fleet.route[slot].sorties):
        if first <= sorties[s].launch <= last:
            for visit in range(sorties[s].count):
                load = plus(load, demand_of(world.place[0, sorties[s].nodes[visit]]))
    return holds(kind, load)


@inlined
def halves_fit(world: World, fleet: Fleet, slot: int, p: int, node: int, front: bool,
               tier: int) -> bool:
    """Tell whether a trip split behind stop `p` may be two, a customer more at the split.

    `front`: at the end of the first.
    """
    halts, kind = fleet.halt[slot, tier], world.type[fleet.route[slot].type]
    trip, more = fleet.trip[slot, fleet.stop[slot, p].trip], cargo_for(world.amount, node, tier)
    one = other = EMPTY
    for q in range(trip.first, p + 1):
        one = followed(one, cargo_at(halts[q]))
    for q in range(p + 1, trip.last + 1):
        other = followed(other, cargo_at(halts[q]))
    if front:
        return (may_follow(kind, one, more) and may_be_all(kind, followed(one, more), tier)
                and may_be_all(kind, other, tier))
    return (may_follow(kind, more, other) and may_be_all(kind, followed(more, other), tier)
            and may_be_all(kind, one, tier))


@spliced
def may_begin(world: World, k: int, node: int) -> bool:
    """Tell whether a vehicle of type `k` may serve a customer on a trip of its own, by loads."""
    for tier in range(tiers_of(world)):
        if not may_be_all(world.type[k], cargo_for(world.amount, node, tier), tier):
            return False
    return True


@spliced
def serve_at(places: Records, node: int, arrival: int) -> int:
    """Return when a truck that arrives at a customer has served; FAR if it is too late."""
    place = places[node]
    return FAR if too_late(place, arrival) else end_of_service(place, arrival)


@spliced
def drive_to(places: Records, stops: Records, first: int, last: int, time: int) -> int:
    """Return when a truck that leaves stop `first` at `time` leaves stop `last`; FAR: too late."""
    for p in range(first + 1, last + 1):
        time = serve_at(places, stops[p].node, time + stops[p - 1].gap)
        if time >= FAR:
            break
    return time


@inlined
def split_fits(world: World, fleet: Fleet, slot: int, p: int, node: int, until: bool) -> bool:
    """Tell whether a trip can be split behind stop `p`, a customer more before or behind the split.

    `until`: before. Loads are not looked at.
    """
    stops = fleet.stop[slot]
    kind, trip = world.type[fleet.route[slot].type], fleet.trip[slot, stops[p].trip]
    places = places_of(world.place, kind)
    legs, depot = legs_of(world.leg, kind.travel), kind.depot
    first, last = trip.first, trip.last
    front = rear = front_length = rear_length = 0
    for q in range(first, last):
        release = release_of(places[stops[q].node]) if q > first else 0
        if q <= p:
            front = max(front, release)
        else:
            rear = max(rear, release)
            rear_length += stops[q].leg
        if q < p:
            front_length += stops[q].leg
    release = release_of(places[node])
    if until:
        front = max(front, release)
    else:
        rear = max(rear, release)
    here, there = stops[p].node, stops[p + 1].node
    time = drive_to(places, stops, first, p, max(stops[first].arrival, front))
    if until:
        time = serve_at(places, node, time + leg(legs, here, node).duration)
        front_length += leg(legs, here, node).distance
        here = node
    time += leg(legs, here, depot).duration
    front_length += leg(legs, here, depot).distance
    if time > kind.shift_latest:
        return False
    time = max(time + kind.reload_duration, rear)
    here = depot
    if not until:
        time = serve_at(places, node, time + leg(legs, depot, node).duration)
        rear_length += leg(legs, depot, node).distance
        here = node
    rear_length += leg(legs, here, there).distance
    return (time + leg(legs, here, there).duration <= stops[p + 1].latest
            and max(front_length, rear_length) <= kind.max_trip_distance)


@spliced
def trip_fits(world: World, fleet: Fleet, slot: int, p: int, node: int) -> bool:
    """Tell whether a customer can be served by a trip of its own behind stop `p`, or -1."""
    route, stops = fleet.route[slot], fleet.stop[slot]
    kind = world.type[route.type]
    places = places_of(world.place, kind)
    legs, depot = legs_of(world.leg, kind.travel), kind.depot
    time = kind.shift_earliest
    if p >= 0:
        time = stops[p].leave + kind.reload_duration
    time = max(time, release_of(places[node]))
    out, home = leg(legs, depot, node), leg(legs, node, depot)
    time = serve_at(places, node, time + out.duration) + home.duration
    if p + 1 < route.length and time + kind.reload_duration > stops[p + 1].latest:
        return False
    return (time <= kind.shift_latest
            and out.distance + home.distance <= kind.max_trip_distance)


@spliced
def more_trips_fit(world: World, fleet: Fleet, slot: int, p: int, node: int, kind: int) -> bool:
    """Tell whether a simple route may have a trip more as a move of `kind` behind stop `p` says."""
    if kind == NEW_TRIP:
        return trip_fits(world, fleet, slot, p, node)
    return split_fits(world, fleet, slot, p, node, kind == TRIP_UNTIL)
