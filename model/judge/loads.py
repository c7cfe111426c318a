"""What is aboard a truck from stop to stop, and a drone from customer to customer."""

from collections.abc import Iterator, Sequence
from itertools import combinations

from model.judge.pairs import brought_within, change_aboard, flown_back, flown_out
from model.problem import Customer, Problem, VehicleType
from model.solution import Sortie, Trip

Amount = tuple[int, ...]
"""By dimension, in parts."""


def _plus(one: Amount, other: Amount) -> Amount:
    return tuple([a + b for a, b in zip(one, other, strict=True)])


def highest(loads: Sequence[Amount]) -> Amount:
    """Return the most that is aboard at any point, each dimension by itself."""
    return tuple(map(max, zip(*loads, strict=True)))


def trip_loads(problem: Problem, kind: VehicleType, trip: Trip) -> list[Amount]:
    """Return what is on the truck before anything leaves it, then when it leaves each stop.

    A drone's parcels leave the truck where it is launched, what it picks up comes aboard where it
    is recovered. At the last stop that which is brought there is still aboard.
    """
    load = kind.initial_load or (0,) * problem.num_dimensions
    loads = [load]
    for customers in reversed(_leaving(problem, trip)):
        for customer in customers:
            load = _plus(load, customer.demand)
        loads.append(load)
    loads.reverse()
    taken = (0,) * problem.num_dimensions
    for index, customers in enumerate(_coming(problem, trip), 1):
        for customer in customers:
            if customer.pickup:
                taken = _plus(taken, customer.pickup)
        if any(taken):
            loads[index] = _plus(loads[index], taken)
    if problem.shipments:
        _add_shipments(problem, trip, loads)
    return loads


def _add_shipments(problem: Problem, trip: Trip, loads: list[Amount]) -> None:
    """Add what is aboard of shipments on leaving each stop. In place.

    Drones leave with what they deliver, and bring what they fetch where they are recovered, but for
    what they deliver themselves.
    """
    served = [[stop.node] for stop in trip.stops]
    for sortie in trip.sorties:
        within = brought_within(problem, sortie.nodes)
        for visit in sortie.visits:
            each = problem.shipment_at.get(visit.node)
            if each is not None and each.delivery in within:
                continue
            fetches = each is not None and visit.node != each.delivery
            served[sortie.recovery_stop if fetches else sortie.launch_stop].append(visit.node)
    aboard = (0,) * problem.num_dimensions
    for index, nodes in enumerate(served, 1):
        for node in nodes:
            change = change_aboard(problem, node)
            if change is not None:
                aboard = _plus(aboard, change)
        loads[index] = _plus(loads[index], aboard)


def _leaving(problem: Problem, trip: Trip) -> list[list[Customer]]:
    """Return whose parcels leave the truck at each stop."""
    return _by_stop(problem, trip, [sortie.launch_stop for sortie in trip.sorties])


def _coming(problem: Problem, trip: Trip) -> list[list[Customer]]:
    """Return whose pickups come aboard the truck at each stop."""
    return _by_stop(problem, trip, [sortie.recovery_stop for sortie in trip.sorties])


def _by_stop(problem: Problem, trip: Trip, flown_at: list[int]) -> list[list[Customer]]:
    """Return who counts at each stop: whom the truck serves there, and those of sorties."""
    customers, first = problem.customers, problem.num_depots
    groups = [[], *([] if stop.is_launch_site else [customers[stop.node - first]]
                    for stop in trip.stops[1:-1]), []]
    for sortie, stop in zip(trip.sorties, flown_at, strict=True):
        groups[stop] += [customers[visit.node - first] for visit in sortie.visits]
    return groups


def sortie_loads(problem: Problem, sortie: Sortie) -> list[Amount]:
    """Return what a drone carries at take-off, then when it leaves each customer."""
    load = (0,) * problem.num_dimensions
    loads, within = [load], brought_within(problem, sortie.nodes)
    for visit in reversed(sortie.visits):
        load = _plus(load, problem.customer_at(visit.node).demand if visit.node in within
                     else flown_out(problem, visit.node))
        loads.append(load)
    loads.reverse()
    taken = (0,) * problem.num_dimensions
    for index, visit in enumerate(sortie.visits, 1):
        change = change_aboard(problem, visit.node) if visit.node in within else None
        taken = _plus(taken, change or flown_back(problem, visit.node))
        loads[index] = _plus(loads[index], taken)
    return loads


def picks_up_early(problem: Problem, kind: VehicleType, trip: Trip) -> Iterator[str]:
    """Yield where a trip doesn't pick up last: after all it delivers, which is something.

    As part of a path: of a stop, or a sortie; of the trip itself where nothing is delivered.
    """
    delivers, picks_up = zip(*moved_at(problem, trip), strict=True)
    if any(picks_up) and not (kind.has_delivered or any(delivers)):
        yield ""
    yield from comes_early(problem, trip)


def moved_at(problem: Problem, trip: Trip) -> Iterator[tuple[bool, bool]]:
    """Yield whether customers' parcels leave the truck at each stop, and pickups come aboard."""
    for leaving, coming in zip(_leaving(problem, trip), _coming(problem, trip), strict=True):
        yield (any(any(customer.demand) for customer in leaving),
               any(any(customer.pickup) for customer in coming))


def comes_early(problem: Problem, trip: Trip) -> Iterator[str]:
    """Yield, as parts of a path, where a trip picks up before a parcel leaves it."""
    delivers, picks_up = zip(*moved_at(problem, trip), strict=True)
    for index, picks in enumerate(picks_up):
        if picks and any(delivers[index + 1:]):
            yield f".stops[{index}]"
    for number, sortie in enumerate(trip.sorties):
        customers = [problem.customer_at(visit.node) for visit in sortie.visits]
        if any(any(one.pickup) and any(other.demand) for one, other in combinations(customers, 2)):
            yield f".sorties[{number}]"
