"""What is left to plan, as a problem of its own.

What one vehicle alone can do is a type of its own. The rest of a trip begins at the place where its
vehicle is, a depot here, and serves those whose parcels are aboard.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from model.judge.past import Past, Vehicle
from model.problem import BoolArray, Customer, Depot, Problem, Travel, VehicleType
from model.replanning.kept import Kept
from model.replanning.workers import Worker, from_now_on

NOBODY, ANYBODY = -1, -2
"""Instead of the only type that may serve a customer."""


@dataclass(frozen=True)
class Remainder:
    """The problem that is left. Its depots are those of the whole, then places of vehicles."""

    problem: Problem
    nodes: tuple[int, ...]  # of the whole problem
    kinds: tuple[int, ...]  # by type: that of the whole problem
    workers: Mapping[int, Worker]  # types that are one vehicle

    @property
    def num_plain(self) -> int:
        """Types that aren't one vehicle; they come first."""
        return len(self.kinds) - len(self.workers)

    def under_way(self, vehicle: Vehicle) -> int | None:
        """Return the type that is the rest of a vehicle's trip."""
        return self._find(vehicle, True)

    def later(self, vehicle: Vehicle) -> int | None:
        """Return the type that may begin trips with a vehicle."""
        own = self._find(vehicle, False)
        if own is not None:
            return own
        plain = self.kinds[:self.num_plain]
        return plain.index(vehicle.type) if vehicle.type in plain else None

    def from_depot(self, kind: int) -> list[int]:
        """Return the types that may begin trips, of those of one type of the whole problem."""
        return [here for here, whole in enumerate(self.kinds) if whole == kind
                and not (here in self.workers and self.workers[here].is_under_way)]

    def _find(self, vehicle: Vehicle, is_under_way: bool) -> int | None:
        return next((kind for kind, worker in self.workers.items() if worker.vehicle == vehicle
                     and worker.is_under_way == is_under_way), None)


def what_is_left(problem: Problem, past: Past, kept: Mapping[Vehicle, Kept],
                 workers: Sequence[Worker]) -> Remainder | None:
    """Return what is left to plan; None if there is nobody to serve, or nobody who could.

    `past` knows which parcels are back at the depot.
    """
    settled = set[int]().union(*(route.served for route in kept.values()))
    nodes = [node for node in range(problem.num_depots, problem.num_nodes) if node not in settled]
    plain = _plain_types(problem, past, kept, workers)
    if not nodes or not (plain or workers):
        return None
    kinds = (*plain, *(own.vehicle.type for own in workers))
    owners = dict(enumerate(workers, len(plain)))
    places = {kind: own.place for kind, own in owners.items() if own.place is not None}
    source = [*range(problem.num_depots), *places.values(), *nodes]
    start = {kind: problem.num_depots + index for index, kind in enumerate(places)}
    types = [replace(kind, start=start.get(index, kind.start))
             for index, kind in enumerate((*plain.values(), *(own.kind for own in workers)))]
    grid = np.ix_(source, source)
    left = replace(
        problem,
        depots=(*problem.depots, *(Depot(f"start of {types[kind].id}") for kind in places)),
        customers=tuple(_back(problem.customer_at(node), past.returned.get(node, 0))
                        for node in nodes),
        vehicle_types=tuple(types), coordinates=problem.coordinates[source],
        travel=tuple(Travel(each.duration[grid], each.distance[grid]) for each in problem.travel),
        may_serve=_table(problem, past, kinds, owners, nodes))
    return Remainder(left, tuple(source), kinds, owners)


def _plain_types(problem: Problem, past: Past, kept: Mapping[Vehicle, Kept],
                 workers: Sequence[Worker]) -> dict[int, VehicleType]:
    """Return the types of vehicles that have done nothing yet, as many as there are."""
    taken = {*kept, *past.unavailable, *(worker.vehicle for worker in workers)}
    plain = {}
    for index, kind in enumerate(problem.vehicle_types):
        count = kind.count - sum(vehicle.type == index for vehicle in taken)
        begun = from_now_on(kind, past.now)
        if count > 0 and begun is not None:
            plain[index] = replace(begun, count=count, numbers=())
    return plain


def _table(problem: Problem, past: Past, kinds: Sequence[int], owners: Mapping[int, Worker],
           nodes: Sequence[int]) -> BoolArray:
    """Return (type, customer) who may serve whom of those who are left.

    A vehicle on a trip serves those whose parcels are aboard and nobody else does; whoever is
    pinned is served by one vehicle alone, and all others by any that begins at the depot.
    """
    under_way = {owner.vehicle: kind for kind, owner in owners.items() if owner.is_under_way}
    later = {owner.vehicle: kind for kind, owner in owners.items() if not owner.is_under_way}
    only = {node: later.get(vehicle, NOBODY) for node, vehicle in past.pinned.items()}
    only |= {node: under_way[owner.vehicle] for owner in owners.values() for node in owner.aboard}
    sole = np.array([only.get(node, ANYBODY) for node in nodes], np.int64)
    numbers = np.arange(len(kinds))[:, None]
    begins = ~np.isin(numbers, list(under_way.values()))
    table: BoolArray = np.where(sole == ANYBODY, begins, numbers == sole)
    if problem.may_serve is not None:
        table &= problem.may_serve[np.array(kinds)[:, None], np.array(nodes) - problem.num_depots]
    return table


def _back(customer: Customer, returned: int) -> Customer:
    """Return a customer whose parcel may have to come back to the depot first."""
    return replace(customer, release_time=max(customer.release_time, returned))
