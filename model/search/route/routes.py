"""All that follows from the sequence of a route: loads, times, where it bends, its cost."""

from model.kernel.compiled import inlined, spliced
from model.kernel.copying import clear
from model.kernel.flight import launch_duration, recovery_end
from model.kernel.instance import (
    FAR, NODE_RELEASE, NONE, RATE_DRONE_HOUR, RATE_DRONE_KM, RATE_FIXED, RATE_HOUR, RATE_KM,
    TYPE_DRONE_TRAVEL, TYPE_EARLIEST, TYPE_MAX_DISTANCE, TYPE_MAX_TRIPS, TYPE_RELOAD, TYPE_TRAVEL,
)
from model.kernel.leg import leg, legs_of
from model.kernel.load import demand_of, holds
from model.kernel.start import counted_from, has_begun
from model.kernel.stop import lateness, waiting
from model.problem import IntArray
from model.search.route.block import make_ready, plain_block, time_block, travel
from model.search.route.layout import (
    CUSTOMER, END, F_BEGIN, F_COUNT, F_LAUNCH, F_NODE, F_RECOVERY, F_TAKEOFF, MODE_PRICED, R_CUM,
    R_END, R_LENGTH, R_OFFSET, R_SORTIES, R_TRIPS, R_TYPE, R_WORKING, START, S_ARRIVAL, S_BEFORE,
    S_BLOCK, S_C, S_CUM, S_D, S_DEP, S_DEPART, S_EARLY, S_END, S_FLYING, S_GAP, S_HI, S_IDLE,
    S_KIND, S_LAST, S_LATEST, S_LEAVE, S_LEG, S_LO, S_NODE, S_RELEASE, S_REST, S_TRIP, T_DISTANCE,
    T_FIRST, T_LAST, T_RELEASE, World,
)
from model.search.route.vehicles import add_load, load_of


@inlined
def carry(world: World, trip: IntArray, node: int) -> None:
    """Put a customer's parcel on a trip. In place."""
    place = world.place[node]
    trip[T_RELEASE] = max(trip[T_RELEASE], place[NODE_RELEASE])
    add_load(trip, demand_of(place))


@inlined
def load_trips(world: World, route: IntArray, stops: IntArray, trips: IntArray,
               sorties: IntArray) -> bool:
    """Write loads, releases and distances of the trips. In place; False if one is too much."""
    k = route[R_TYPE]
    columns = world.type[k]
    legs = legs_of(world.leg, columns[TYPE_TRAVEL])
    index, s = -1, 0
    most_trips, most_distance = len(trips), columns[TYPE_MAX_DISTANCE]
    for p in range(route[R_LENGTH]):
        stop = stops[p]
        kind = stop[S_KIND]
        if kind == START:
            index += 1
            if index >= columns[TYPE_MAX_TRIPS] or index >= most_trips:
                return False
            clear(trips[index])
            trips[index, T_FIRST] = p
        trip = trips[index]
        stop[S_TRIP] = index
        if kind == CUSTOMER:
            carry(world, trip, stop[S_NODE])
        while s < route[R_SORTIES] and sorties[s, F_LAUNCH] == p:
            for visit in range(sorties[s, F_COUNT]):
                carry(world, trip, sorties[s, F_NODE + visit])
            s += 1
        if kind == END:
            trip[T_LAST] = p
            stops[trip[T_FIRST], S_RELEASE] = trip[T_RELEASE]
            if trip[T_DISTANCE] > most_distance or not holds(columns, load_of(trip)):
                return False
            stop[S_LEG], stop[S_GAP] = 0, columns[TYPE_RELOAD]
        else:
            way = leg(legs, stop[S_NODE], stops[p + 1, S_NODE])
            stop[S_GAP], stop[S_LEG] = way.duration, way.distance
            trip[T_DISTANCE] += way.distance
    route[R_TRIPS] = index + 1
    return True


@inlined
def drive_forward(world: World, route: IntArray, stops: IntArray, sorties: IntArray,
                  acc: IntArray) -> bool:
    """Write times as soon as possible, stop after stop. In place; False if a rule is broken."""
    k, length, count = route[R_TYPE], route[R_LENGTH], route[R_SORTIES]
    time = world.type[k, TYPE_EARLIEST]
    cum, depart = 0, FAR
    make_ready(world, k, stops, sorties, count)
    p = s = 0
    while p < length:
        stop = stops[p]
        last = p
        if s < count and sorties[s, F_LAUNCH] == p:
            last = time_block(world, k, stops, length, sorties, count, p, s, time, acc)
            if last < 0:
                return False
            while s < count and sorties[s, F_LAUNCH] <= last:
                s += 1
        else:
            plain_block(world, k, stop, time)
            stop[S_FLYING], stop[S_BLOCK], stop[S_IDLE] = 0, p, 0
        if time > stop[S_HI] or time < stop[S_LO]:
            return False
        stop[S_ARRIVAL], stop[S_BEFORE], stop[S_LAST] = time, cum, last
        depart = min(depart, stop[S_DEP] - cum)
        cum += stop[S_D]
        leave = max(time + stop[S_D], stop[S_C])
        behind = stops[last]
        behind[S_LEAVE], behind[S_CUM], behind[S_DEPART] = leave, cum, depart
        time = leave
        if behind[S_KIND] == END:
            time += behind[S_GAP]
        else:
            _, time = travel(world, k, behind[S_GAP], NONE, leave)
        cum += behind[S_GAP]
        p = last + 1
    route[R_END], route[R_CUM] = stops[length - 1, S_LEAVE], stops[length - 1, S_CUM]
    return True


@inlined
def look_back(world: World, route: IntArray, stops: IntArray) -> None:
    """Write how late, and how early, each block may be reached, and what follows it. In place."""
    latest, earliest, rest, end = FAR, NONE, 0, NONE
    q = route[R_LENGTH] - 1
    gap = 0
    while q >= 0:
        p = stops[q, S_BLOCK]
        stop = stops[p]
        d, c = stop[S_D], stop[S_C]
        if q < route[R_LENGTH] - 1:
            gap = stops[q, S_GAP]
        early = stop[S_LO]
        if c < earliest - gap:
            early = max(early, earliest - gap - d)
        latest = min(stop[S_HI], latest - gap - d)
        earliest = early
        end = max(c + gap + rest, end)
        rest += d + gap
        stop[S_LATEST], stop[S_EARLY], stop[S_REST], stop[S_END] = latest, early, rest, end
        q = p - 1


@inlined
def open_up(route: IntArray, stops: IntArray) -> None:
    """Mark a route whose legs change with time: nothing is known of later arrivals. In place."""
    for p in range(route[R_LENGTH]):
        stops[p, S_LATEST], stops[p, S_EARLY] = FAR, NONE


@spliced
def lateness_cost(world: World, node: int, arrival: int) -> float:
    """Return what being late at a customer costs; nothing at a depot."""
    return lateness(world.place[node], arrival) * world.price[node, 0]


@spliced
def waiting_cost(world: World, node: int, arrival: int) -> float:
    """Return what being early at a customer costs."""
    return waiting(world.place[node], arrival) * world.price[node, 1]


@spliced
def window_cost(world: World, node: int, arrival: int) -> float:
    """Return what being late, or early, at a customer costs."""
    return lateness_cost(world, node, arrival) + waiting_cost(world, node, arrival)


@inlined
def price_windows(world: World, route: IntArray, stops: IntArray,
                  sorties: IntArray) -> tuple[float, float]:
    """Return what lateness and what waiting cost on a timed route."""
    late = early = 0.0
    for p in range(route[R_LENGTH]):
        if stops[p, S_KIND] == CUSTOMER:
            late += lateness_cost(world, stops[p, S_NODE], stops[p, S_ARRIVAL])
            early += waiting_cost(world, stops[p, S_NODE], stops[p, S_ARRIVAL])
    for s in range(route[R_SORTIES]):
        for visit in range(sorties[s, F_COUNT]):
            node = sorties[s, F_NODE + visit]
            arrival = sorties[s, F_NODE + world.max_visits + visit]
            late += lateness_cost(world, node, arrival)
            early += waiting_cost(world, node, arrival)
    return late, early


@inlined
def sortie_cost(world: World, k: int, stops: IntArray, sortie: IntArray) -> float:
    """Return what the flight of a sortie costs."""
    flights = legs_of(world.leg, world.type[k, TYPE_DRONE_TRAVEL])
    node, flown = stops[sortie[F_LAUNCH], S_NODE], 0
    for visit in range(sortie[F_COUNT]):
        following = sortie[F_NODE + visit]
        flown += leg(flights, node, following).distance
        node = following
    flown += leg(flights, node, stops[sortie[F_RECOVERY], S_NODE]).distance
    airborne = recovery_end(world.type[k], sortie[F_BEGIN]) - sortie[F_TAKEOFF]
    return flown * world.rate[k, RATE_DRONE_KM] + airborne * world.rate[k, RATE_DRONE_HOUR]


@inlined
def first_departure(world: World, route: IntArray, stops: IntArray, sorties: IntArray) -> int:
    """Return when truck or drone first leaves the depot, as late as costs nothing."""
    depart = min(stops[route[R_LENGTH] - 1, S_DEPART], route[R_END] - route[R_CUM])
    offset, columns = 0, world.type[route[R_TYPE]]
    if route[R_SORTIES] > 0 and sorties[0, F_LAUNCH] == 0 and not has_begun(columns):
        offset = launch_duration(columns)
    route[R_OFFSET] = offset
    return counted_from(columns, depart + offset)


@inlined
def price_route(world: World, route: IntArray, stops: IntArray, trips: IntArray,
                sorties: IntArray) -> tuple[float, float]:
    """Return the cost of a timed route, and what waiting for windows costs of it."""
    k = route[R_TYPE]
    cost, early = world.rate[k, RATE_FIXED], 0.0
    for index in range(route[R_TRIPS]):
        cost += trips[index, T_DISTANCE] * world.rate[k, RATE_KM]
    cost += route[R_WORKING] * world.rate[k, RATE_HOUR]
    for s in range(route[R_SORTIES]):
        cost += sortie_cost(world, k, stops, sorties[s])
    if world.mode[k] & MODE_PRICED:
        late, early = price_windows(world, route, stops, sorties)
        cost += late + early
    return cost, early
