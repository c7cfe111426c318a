"""Routes of one trip where distance alone costs: only loads, departures and latest arrivals."""

from model.kernel.compiled import spliced
from model.kernel.leg import leg, legs_of
from model.kernel.load import demand_of
from model.kernel.records import Records
from model.kernel.start import leaves_first
from model.kernel.stop import end_of_service, latest_arrival, places_of, too_late
from model.search.route.halts import weigh
from model.search.route.layout import CUSTOMER, NOWHERE, Fleet, World, clear_trip, copy_lean
from model.search.route.rarer import tiers_aboard
from model.search.route.vehicles import add_load, may_make, route_cost


@spliced
def refresh_lean(world: World, fleet: Fleet, slot: int) -> bool:
    """Write what a lean route needs. In place; False if it breaks a rule."""
    route, stops, trip = fleet.route[slot], fleet.stop[slot], fleet.trip[slot, 0]
    k, last = route.type, route.length - 1
    kind = world.type[k]
    legs, places = legs_of(world.leg, kind.travel), places_of(world.place, kind)
    clear_trip(trip)
    route.trips, trip.last = 1, last
    time, node = leaves_first(kind, kind.shift_earliest), stops[0].node
    stops[0].leave, stops[0].flying, stops[0].trip = time, 0, 0
    for p in range(1, last + 1):
        following = stops[p].node
        way = leg(legs, node, following)
        stops[p - 1].gap, stops[p - 1].leg = way.duration, way.distance
        trip.distance += way.distance
        time += way.duration
        node = following
        if p < last:
            place = places[node]
            if too_late(place, time):
                return False
            time = end_of_service(place, time)
            add_load(trip, demand_of(place))
        stops[p].leave, stops[p].flying, stops[p].trip = time, 0, 0
    stops[last].leg = stops[last].gap = 0
    if not may_make(kind, trip):
        return False
    latest = kind.shift_latest
    stops[last].latest = latest
    for p in range(last - 1, 0, -1):
        latest = latest_arrival(places[stops[p].node], latest - stops[p].gap)
        stops[p].latest = latest
    stops[0].latest = latest - stops[0].gap
    fleet.cost[slot] = route_cost(world, k, trip)
    if tiers_aboard(fleet) > 0 and not weigh(world, fleet, slot):
        return False
    return time <= kind.shift_latest


@spliced
def shift_lean(fleet: Fleet, slot: int, p: int) -> None:
    """Move the stops from `p` on by one place. In place."""
    stops = fleet.stop[slot]
    for q in range(fleet.route[slot].length - 1, p - 1, -1):
        copy_lean(stops[q], stops[q + 1])
        if stops[q].kind == CUSTOMER:
            fleet.where[stops[q].node].position = q + 1
    fleet.route[slot].length += 1


@spliced
def insert_lean(world: World, fleet: Fleet, slot: int, p: int, node: int) -> None:
    """Insert a customer behind stop `p` where that is known to keep all rules. In place."""
    shift_lean(fleet, slot, p + 1)
    stops, trip = fleet.stop[slot], fleet.trip[slot, 0]
    k = fleet.route[slot].type
    legs = legs_of(world.leg, world.type[k].travel)
    new = stops[p + 1]
    new.node, new.kind, new.flying, new.trip = node, CUSTOMER, 0, 0
    where = fleet.where[node]
    where.slot, where.position, where.sortie = slot, p + 1, NOWHERE
    out, on = leg(legs, stops[p].node, node), leg(legs, node, stops[p + 2].node)
    detour = out.distance + on.distance - stops[p].leg
    stops[p].gap, stops[p].leg = out.duration, out.distance
    new.gap, new.leg = on.duration, on.distance
    trip.last += 1
    trip.distance += detour
    fleet.cost[slot] += detour * world.rate[k].distance + world.rate[k].stop
    add_load(trip, demand_of(world.place[0, node]))
    spread(places_of(world.place, world.type[k]), stops, trip.last, p + 1)
    if tiers_aboard(fleet) > 0:
        weigh(world, fleet, slot)


@spliced
def spread(places: Records, stops: Records, last: int, p: int) -> None:
    """Bring departures behind a new stop `p`, and latest arrivals before, up to date. In place."""
    time = stops[p - 1].leave
    for q in range(p, last + 1):
        time += stops[q - 1].gap
        if q < last:
            time = end_of_service(places[stops[q].node], time)
        if q > p and stops[q].leave == time:
            break
        stops[q].leave = time
    latest = stops[p + 1].latest
    for q in range(p, 0, -1):
        latest = latest_arrival(places[stops[q].node], latest - stops[q].gap)
        if q < p and stops[q].latest == latest:
            return
        stops[q].latest = latest
    stops[0].latest = latest - stops[0].gap
