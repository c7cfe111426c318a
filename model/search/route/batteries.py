"""What sorties take of batteries, and what these have, on a route that is timed."""

from model.kernel.clock import is_steady
from model.kernel.compiled import inlined
from model.kernel.energy import (
    after_hovering, after_leg, battery_of, charged, charged_by, first_charge, hovers_at_customers,
)
from model.kernel.flight import launch_begin, longest_hold, recovery_end, take_off
from model.kernel.instance import NONE
from model.kernel.leg import TravelLegs, leg
from model.kernel.load import weight_brought, weight_taken
from model.kernel.records import Record, Records
from model.kernel.stop import service_duration, waiting


@inlined
def charge(places: Records, legs: TravelLegs, homeward: TravelLegs, kind: Record, sortie: Record,
           node: int) -> None:
    """Write what a sortie launched at `node` may hover for, without and before windows. In place.

    That is what its flight leaves of its battery.
    """
    sortie.taken = 0
    for index in range(sortie.count):
        sortie.taken += weight_taken(places[sortie.nodes[index]])
    left, aboard, flown, here = battery_of(kind), sortie.taken, 0, sortie.home
    most = aboard
    for index in range(sortie.count - 1, -1, -1):
        customer = sortie.nodes[index]
        place, way = places[customer], homeward if index == sortie.count - 1 else legs
        flight = leg(way, customer, here).duration
        left = after_leg(kind, left, aboard, flight)
        aboard += weight_brought(place) - weight_taken(place)
        most = max(most, aboard)
        service = service_duration(place)
        if hovers_at_customers(kind):
            left = after_hovering(kind, left, aboard, service)
        flown += flight + service
        here = customer
    flight = leg(legs, node, here).duration
    sortie.left = after_leg(kind, left, aboard, flight)
    sortie.limit = longest_hold(kind, flown + flight, sortie.left, most)


@inlined
def hover(places: Records, kind: Record, sortie: Record, acc: Record) -> None:
    """Take what a sortie whose arrivals are known needs to wait for windows in the air. In place.

    Later it waits no longer, as long as windows are the same; sooner, nothing is said of.
    """
    aboard = sortie.taken
    for index in range(sortie.count - 1, -1, -1):
        place = places[sortie.nodes[index]]
        aboard += weight_brought(place) - weight_taken(place)
        waited = waiting(place, sortie.arrivals[index])
        if waited > 0:
            sortie.left = after_hovering(kind, sortie.left, aboard, waited)
            acc.lo = max(acc.lo, acc.time)


@inlined
def note_charge(kind: Record, sorties: Records, index: int, first: int) -> None:
    """Write with what the drone of a sortie has come aboard, and when it can fly. In place.

    All that it flies before is timed; its trip's first sortie is `first`.
    """
    sortie = sorties[index]
    sortie.kept, sortie.since = first_charge(kind, sortie.drone)
    sortie.follows = 0
    for other in range(first, index):
        if sorties[other].drone == sortie.drone:
            sortie.kept, sortie.follows = sorties[other].left, 1
            sortie.since = recovery_end(kind, sorties[other].begin)
    ready = charged_by(kind, sortie.kept, sortie.since, sortie.left)
    sortie.charged = take_off(kind, ready, 1)


@inlined
def await_charge(kind: Record, sortie: Record, takeoff: int, time: int) -> int:
    """Let a sortie take off with what its battery then has. In place.

    Returns how long after `time`, when the truck reaches the block, that is at least, if the drone
    is charged from a recovery on, which comes as much later as the truck.
    """
    there = charged(kind, sortie.kept, sortie.since, launch_begin(kind, takeoff, 1))
    sortie.left -= battery_of(kind) - there
    return sortie.charged - time if is_steady(kind) and sortie.follows == 1 else NONE
