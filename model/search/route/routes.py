"""All that follows from the sequence of a route: loads, times, where it bends, its cost."""

from model.kernel.compiled import inlined, spliced
from model.kernel.drone_types import are_several, row_of_drone
from model.kernel.flight import launch_duration, recovery_end
from model.kernel.instance import FAR, NONE
from model.kernel.leg import leg, legs_of
from model.kernel.load import demand_of, release_of
from model.kernel.records import Record, Records
from model.kernel.shift import allows_sorties, overtime
from model.kernel.start import counted_from, has_begun
from model.kernel.stop import are_single, lateness, latest_arrival, places_of, waiting
from model.search.route.block import make_ready, plain_block, time_block, travel
from model.search.route.ends import is_apart, place_ends
from model.search.route.layout import CUSTOMER, END, MODE_PRICED, START, World, clear_trip
from model.search.route.vehicles import add_load, have_batteries, may_make


@inlined
def carry(world: World, trip: Record, node: int) -> None:
    """Put a customer's parcel on a trip. In place."""
    place = world.place[0, node]
    trip.release = max(trip.release, release_of(place))
    add_load(trip, demand_of(place))


@inlined
def load_trips(world: World, route: Record, stops: Records, trips: Records,
               sorties: Records) -> bool:
    """Write loads, releases and distances of the trips. In place; False if one is too much."""
    k = route.type
    vehicle_type = world.type[k]
    legs = legs_of(world.leg, vehicle_type.travel)
    index, s, flown = -1, 0, 0
    if is_apart(world, k):
        place_ends(world, k, route, stops)
    most_trips, most_distance = len(trips), vehicle_type.max_trip_distance
    for p in range(route.length):
        stop = stops[p]
        kind = stop.kind
        if kind == START:
            index += 1
            if index >= vehicle_type.max_trips or index >= most_trips:
                return False
            clear_trip(trips[index])
            flown = s
            trips[index].first = p
        trip = trips[index]
        stop.trip = index
        if kind == CUSTOMER:
            carry(world, trip, stop.node)
        while s < route.sorties and sorties[s].launch == p:
            for visit in range(sorties[s].count):
                carry(world, trip, sorties[s].nodes[visit])
            s += 1
        if kind == END:
            trip.last = p
            stops[trip.first].release = trip.release
            if (trip.distance > most_distance or not may_make(vehicle_type, trip)
                    or not allows_sorties(vehicle_type, s - flown)
                    or not have_batteries(world.type, k, sorties, flown, s)):
                return False
            stop.leg, stop.gap = 0, vehicle_type.reload_duration
        else:
            way = leg(legs, stop.node, stops[p + 1].node)
            stop.gap, stop.leg = way.duration, way.distance
            trip.distance += way.distance
    route.trips = index + 1
    return True


@inlined
def drive_forward(world: World, route: Record, stops: Records, sorties: Records,
                  acc: Record) -> bool:
    """Write times as soon as possible, stop after stop. In place; False if a rule is broken."""
    k, length, count = route.type, route.length, route.sorties
    time = world.type[k].shift_earliest
    cum, depart, acc.awaited = 0, FAR, 0
    make_ready(world, k, stops, sorties, count)
    p = s = 0
    while p < length:
        stop = stops[p]
        last = p
        if stop.kind == START:
            acc.launched, acc.first_sortie = 0, s
        if s < count and sorties[s].launch == p:
            last = time_block(world, k, stops, length, sorties, count, p, s, time, acc)
            if last < 0:
                return False
            while s < count and sorties[s].launch <= last:
                s += 1
        else:
            plain_block(world, k, stop, time)
            stop.flying, stop.block, stop.idle = 0, p, 0
        if time > stop.hi or time < stop.lo:
            return False
        stop.arrival, stop.before, stop.last = time, cum, last
        depart = min(depart, stop.dep - cum)
        cum += stop.d
        leave = max(time + stop.d, stop.c)
        behind = stops[last]
        behind.leave, behind.cum, behind.depart = leave, cum, depart
        time = leave
        if behind.kind == END:
            time += behind.gap
        else:
            _, time = travel(world, k, behind.node, stops[last + 1].node, behind.gap, NONE, leave)
        cum += behind.gap
        p = last + 1
    route.end, route.cum = stops[length - 1].leave, stops[length - 1].cum
    route.awaited = acc.awaited
    return True


@inlined
def look_back(world: World, route: Record, stops: Records) -> None:
    """Write how late, and how early, each block may be reached, and what follows it. In place.

    As docs/search.md derives under "Times on a route".
    """
    latest, earliest, rest, end = FAR, NONE, 0, NONE
    places = places_of(world.place, world.type[route.type])
    single = are_single(places[0])
    q = route.length - 1
    gap = 0
    while q >= 0:
        p = stops[q].block
        stop = stops[p]
        d, c = stop.d, stop.c
        if q < route.length - 1:
            gap = stops[q].gap
        early = stop.lo
        if c < earliest - gap:
            early = max(early, earliest - gap - d)
        leave = latest - gap
        latest = min(stop.hi, leave - d)
        if stop.kind == CUSTOMER and not single:
            # No drone flies, or the route would be retimed.
            latest = latest_arrival(places[stop.node], leave)
        earliest = early
        end = max(c + gap + rest, end)
        rest += d + gap
        stop.latest, stop.early, stop.rest, stop.end = latest, early, rest, end
        q = p - 1


@inlined
def open_up(route: Record, stops: Records) -> None:
    """Mark a route whose legs change with time: nothing is known of later arrivals. In place."""
    for p in range(route.length):
        stops[p].latest, stops[p].early = FAR, NONE


@spliced
def lateness_cost(world: World, node: int, arrival: int) -> float:
    """Return what being late at a customer costs; nothing at a depot."""
    return lateness(world.place[0, node], arrival) * world.price[node].lateness


@spliced
def waiting_cost(world: World, node: int, arrival: int) -> float:
    """Return what being early at a customer costs."""
    return waiting(world.place[0, node], arrival) * world.price[node].waiting


@spliced
def window_cost(world: World, node: int, arrival: int) -> float:
    """Return what being late, or early, at a customer costs."""
    return lateness_cost(world, node, arrival) + waiting_cost(world, node, arrival)


@inlined
def price_windows(world: World, route: Record, stops: Records,
                  sorties: Records) -> tuple[float, float]:
    """Return what lateness and what waiting cost on a timed route."""
    late = early = 0.0
    for p in range(route.length):
        if stops[p].kind == CUSTOMER:
            costs = (lateness_cost(world, stops[p].node, stops[p].arrival),
                     waiting_cost(world, stops[p].node, stops[p].arrival))
            stops[p].window_cost = costs[0] + costs[1]
            late, early = late + costs[0], early + costs[1]
    for s in range(route.sorties):
        for visit in range(sorties[s].count):
            node = sorties[s].nodes[visit]
            arrival = sorties[s].arrivals[visit]
            late += lateness_cost(world, node, arrival)
            early += waiting_cost(world, node, arrival)
    return late, early


@inlined
def sortie_cost(world: World, k: int, stops: Records, sortie: Record) -> float:
    """Return what the flight of a sortie costs."""
    row = row_of_drone(world.type, k, sortie.drone)
    flights = legs_of(world.leg, world.type[row].drone_travel)
    node, flown = stops[sortie.launch].node, 0
    for visit in range(sortie.count):
        following = sortie.nodes[visit]
        flown += leg(flights, node, following).distance
        node = following
    flown += leg(flights, node, stops[sortie.recovery].node).distance
    airborne = recovery_end(world.type[row], sortie.begin) - sortie.takeoff
    return flown * world.rate[row].drone_distance + airborne * world.rate[row].drone_time


@inlined
def first_departure(world: World, route: Record, stops: Records, sorties: Records) -> int:
    """Return when truck or drone first leaves the depot, as late as costs nothing."""
    depart = min(stops[route.length - 1].depart, route.end - route.cum)
    offset, kind = 0, world.type[route.type]
    if route.sorties > 0 and sorties[0].launch == 0 and not has_begun(kind):
        first = 0
        if are_several(kind):
            for s in range(1, route.sorties):
                if sorties[s].launch == 0 and sorties[s].takeoff < sorties[first].takeoff:
                    first = s
        drones = world.type[row_of_drone(world.type, route.type, sorties[first].drone)]
        offset = launch_duration(drones, 0)
    route.offset = offset
    return counted_from(kind, depart + offset)


@inlined
def longer_cost(kind: Record, rate: Record, route: Record, end: int, working: int) -> float:
    """Return what it costs more that a route ends at `end` and works so long."""
    cost = (working - route.working) * rate.time
    if rate.overtime > 0.0:
        more = overtime(kind, end, working) - overtime(kind, route.end, route.working)
        cost += more * rate.overtime
    return cost


@spliced
def price_route(world: World, route: Record, stops: Records, trips: Records,
                sorties: Records) -> tuple[float, float]:
    """Return the cost of a timed route, and what waiting for windows costs of it."""
    k = route.type
    cost, early = world.rate[k].fixed, 0.0
    for index in range(route.trips):
        cost += trips[index].distance * world.rate[k].distance
    cost += (route.length - 2 * route.trips) * world.rate[k].stop
    cost += route.working * world.rate[k].time
    if world.rate[k].overtime > 0.0:
        cost += overtime(world.type[k], route.end, route.working) * world.rate[k].overtime
    for s in range(route.sorties):
        cost += sortie_cost(world, k, stops, sorties[s])
    if world.mode[k] & MODE_PRICED:
        late, early = price_windows(world, route, stops, sorties)
        cost += late + early
    return cost, early
