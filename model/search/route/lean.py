"""Routes of one trip where distance alone costs: only loads, departures and latest arrivals."""

from model.kernel.compiled import inlined, spliced
from model.kernel.copying import clear
from model.kernel.instance import RATE_FIXED, RATE_KM, TYPE_EARLIEST, TYPE_LATEST, TYPE_TRAVEL
from model.kernel.leg import leg, legs_of
from model.kernel.load import demand_of, holds
from model.kernel.start import leaves_first
from model.kernel.stop import end_of_service, latest_arrival, too_late
from model.problem import IntArray
from model.search.route.layout import (
    CUSTOMER, LEAN_COLUMNS, NOWHERE, R_LENGTH, R_TRIPS, R_TYPE, S_FLYING, S_GAP, S_KIND, S_LATEST,
    S_LEAVE, S_LEG, S_NODE, S_TRIP, T_DISTANCE, T_LAST, W_POSITION, W_SLOT, W_SORTIE, Fleet, World,
)
from model.search.route.vehicles import add_load, load_of


@inlined
def refresh_lean(world: World, fleet: Fleet, slot: int) -> bool:
    """Write what a lean route needs. In place; False if it breaks a rule."""
    route, stops, trip = fleet.route[slot], fleet.stop[slot], fleet.trip[slot, 0]
    k, last = route[R_TYPE], route[R_LENGTH] - 1
    columns = world.type[k]
    legs = legs_of(world.leg, columns[TYPE_TRAVEL])
    clear(trip)
    route[R_TRIPS], trip[T_LAST] = 1, last
    time, node = leaves_first(columns, columns[TYPE_EARLIEST]), stops[0, S_NODE]
    stops[0, S_LEAVE], stops[0, S_FLYING], stops[0, S_TRIP] = time, 0, 0
    for p in range(1, last + 1):
        following = stops[p, S_NODE]
        way = leg(legs, node, following)
        stops[p - 1, S_GAP], stops[p - 1, S_LEG] = way.duration, way.distance
        trip[T_DISTANCE] += way.distance
        time += way.duration
        node = following
        if p < last:
            place = world.place[node]
            if too_late(place, time):
                return False
            time = end_of_service(place, time)
            add_load(trip, demand_of(place))
        stops[p, S_LEAVE], stops[p, S_FLYING], stops[p, S_TRIP] = time, 0, 0
    stops[last, S_LEG] = stops[last, S_GAP] = 0
    if not holds(columns, load_of(trip)):
        return False
    latest = columns[TYPE_LATEST]
    stops[last, S_LATEST] = latest
    for p in range(last - 1, 0, -1):
        latest = latest_arrival(world.place[stops[p, S_NODE]], latest - stops[p, S_GAP])
        stops[p, S_LATEST] = latest
    stops[0, S_LATEST] = latest - stops[0, S_GAP]
    fleet.cost[slot] = world.rate[k, RATE_FIXED] + trip[T_DISTANCE] * world.rate[k, RATE_KM]
    return time <= columns[TYPE_LATEST]


@spliced
def shift_lean(fleet: Fleet, slot: int, p: int) -> None:
    """Move the stops from `p` on by one place. In place."""
    stops = fleet.stop[slot]
    for q in range(fleet.route[slot, R_LENGTH] - 1, p - 1, -1):
        for column in range(LEAN_COLUMNS):
            stops[q + 1, column] = stops[q, column]
        if stops[q, S_KIND] == CUSTOMER:
            fleet.where[stops[q, S_NODE], W_POSITION] = q + 1
    fleet.route[slot, R_LENGTH] += 1


@spliced
def insert_lean(world: World, fleet: Fleet, slot: int, p: int, node: int) -> None:
    """Insert a customer behind stop `p` where that is known to keep all rules. In place."""
    shift_lean(fleet, slot, p + 1)
    stops, trip = fleet.stop[slot], fleet.trip[slot, 0]
    k = fleet.route[slot, R_TYPE]
    legs = legs_of(world.leg, world.type[k, TYPE_TRAVEL])
    new = stops[p + 1]
    new[S_NODE], new[S_KIND], new[S_FLYING], new[S_TRIP] = node, CUSTOMER, 0, 0
    where = fleet.where[node]
    where[W_SLOT], where[W_POSITION], where[W_SORTIE] = slot, p + 1, NOWHERE
    out, on = leg(legs, stops[p, S_NODE], node), leg(legs, node, stops[p + 2, S_NODE])
    detour = out.distance + on.distance - stops[p, S_LEG]
    stops[p, S_GAP], stops[p, S_LEG] = out.duration, out.distance
    new[S_GAP], new[S_LEG] = on.duration, on.distance
    trip[T_LAST] += 1
    trip[T_DISTANCE] += detour
    fleet.cost[slot] += detour * world.rate[k, RATE_KM]
    add_load(trip, demand_of(world.place[node]))
    spread(world, stops, trip[T_LAST], p + 1)


@spliced
def spread(world: World, stops: IntArray, last: int, p: int) -> None:
    """Bring departures behind a new stop `p`, and latest arrivals before, up to date. In place."""
    time = stops[p - 1, S_LEAVE]
    for q in range(p, last + 1):
        time += stops[q - 1, S_GAP]
        if q < last:
            time = end_of_service(world.place[stops[q, S_NODE]], time)
        if q > p and stops[q, S_LEAVE] == time:
            break
        stops[q, S_LEAVE] = time
    latest = stops[p + 1, S_LATEST]
    for q in range(p, 0, -1):
        latest = latest_arrival(world.place[stops[q, S_NODE]], latest - stops[q, S_GAP])
        if q < p and stops[q, S_LATEST] == latest:
            return
        stops[q, S_LATEST] = latest
    stops[0, S_LATEST] = latest - stops[0, S_GAP]
