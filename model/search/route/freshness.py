"""Trips held back so that nobody's parcel is aboard for too long."""

from model.kernel.compiled import inlined
from model.kernel.instance import FAR
from model.kernel.load import excess_aboard
from model.kernel.records import Record, Records
from model.kernel.start import leaves_first
from model.kernel.stop import start_of_service
from model.search.route.layout import CUSTOMER, World
from model.search.route.rarer import time_aboard_counts
from model.search.route.routes import drive_forward


@inlined
def departure_of(world: World, route: Record, stops: Records, sorties: Records,
                 first: int) -> int:
    """Return when truck or drone first leaves the depot on the timed trip from stop `first` on."""
    departure = FAR
    for s in range(route.sorties):
        if sorties[s].launch == first:
            departure = min(departure, sorties[s].takeoff)
    if departure == FAR:
        begun = max(stops[first].arrival, max(stops[first].release, stops[first].hold))
        departure = leaves_first(world.type[route.type], begun)
    return departure


@inlined
def most_excess(world: World, route: Record, stops: Records, trip: Record,
                sorties: Records) -> int:
    """Return by how much a parcel is too long aboard on a timed trip; at most 0 if none is."""
    departure = departure_of(world, route, stops, sorties, trip.first)
    places, most = world.place[0], -FAR
    for p in range(trip.first, trip.last + 1):
        if stops[p].kind == CUSTOMER:
            node = stops[p].node
            start = start_of_service(places[node], stops[p].arrival)
            most = max(most, excess_aboard(world.fresh_for, node, departure, start))
    for s in range(route.sorties):
        if trip.first <= sorties[s].launch <= trip.last:
            for visit in range(sorties[s].count):
                node = sorties[s].nodes[visit]
                start = start_of_service(places[node], sorties[s].arrivals[visit])
                most = max(most, excess_aboard(world.fresh_for, node, departure, start))
    return most


@inlined
def any_too_long(world: World, route: Record, stops: Records, trips: Records,
                 sorties: Records) -> bool:
    """Tell whether somebody's parcel is too long aboard on a timed route."""
    if time_aboard_counts(world):
        for index in range(route.trips):
            if most_excess(world, route, stops, trips[index], sorties) > 0:
                return True
    return False


@inlined
def hold_trips(world: World, route: Record, stops: Records, trips: Records, sorties: Records,
               acc: Record) -> bool:
    """Let each trip of a timed route begin as soon as nobody's parcel is too long aboard.

    In place; False if that helps nobody, or a rule is broken.
    """
    for index in range(route.trips):
        trip = trips[index]
        excess = most_excess(world, route, stops, trip, sorties)
        while excess > 0:
            stop = stops[trip.first]
            stop.release = max(stop.arrival, stop.release) + excess
            if not drive_forward(world, route, stops, sorties, acc):
                return False
            left = most_excess(world, route, stops, trip, sorties)
            if left >= excess:
                return False
            excess = left
    return True
