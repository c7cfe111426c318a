"""What is left to plan, as a problem of its own.

What one vehicle alone can do is a type of its own. A customer stands for the place from which it
goes on, its anchor: nothing of that vehicle's comes before, and only those whose parcels are aboard
come behind on the same trip.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from model.judge.past import Past, Vehicle
from model.problem import (
    MAX_QUANTITY, UNREACHABLE, BoolArray, Customer, IntArray, Problem, Travel, VehicleType,
)
from model.replanning.kept import Kept
from model.replanning.workers import Anchor, Worker

TRUCK, DRONE = "truck", "drone"

NOBODY, ANYBODY = -1, -2
"""Instead of the only type that may serve a customer."""


@dataclass(frozen=True)
class Remainder:
    """The problem that is left. Its nodes are depots, customers to plan, then anchors."""

    problem: Problem
    nodes: tuple[int, ...]  # of the whole problem; an anchor's is the place that it stands for
    kinds: tuple[int, ...]  # by type: that of the whole problem
    workers: Mapping[int, Worker]  # types that are one vehicle
    anchors: Mapping[int, int]  # by type, nodes here

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
    owners = dict(enumerate(workers, len(plain)))
    places = {kind: worker.anchor for kind, worker in owners.items() if worker.anchor is not None}
    first = problem.num_depots + len(nodes)
    anchors = {kind: first + index for index, kind in enumerate(places)}
    source = [*range(problem.num_depots), *nodes, *(anchor.node for anchor in places.values())]
    here = {node: index for index, node in enumerate(source[:first])}
    kinds = (*plain, *(own.vehicle.type for own in workers))
    travels = _Travels(problem, source)
    types = [travels.moved(kind) for kind in (*plain.values(), *(own.kind for own in workers))]
    for index, anchor in places.items():
        travels.begin(types[index], anchor, anchors[index],
                      [here[node] for node in owners[index].aboard])
    customers = [_back(problem.customer_at(node), past.returned.get(node, 0))
                 for node in nodes]
    customers += [_anchor_customer(types[kind], anchor) for kind, anchor in places.items()]
    table = _table(problem, past, kinds, owners, nodes)
    at_anchors = np.arange(len(kinds))[:, None] == np.array([*places], np.int64)
    left = Problem(problem.depots, tuple(customers), tuple(types), travels.built(),
                   problem.coordinates[source], problem.unassigned_cost,
                   problem.amount_decimals, np.hstack([table, at_anchors]))
    return Remainder(left, tuple(source), kinds, owners, anchors)


def _plain_types(problem: Problem, past: Past, kept: Mapping[Vehicle, Kept],
                 workers: Sequence[Worker]) -> dict[int, VehicleType]:
    """Return the types of vehicles that have done nothing yet, as many as there are."""
    taken = {*kept, *past.unavailable, *(worker.vehicle for worker in workers)}
    plain = {}
    for index, kind in enumerate(problem.vehicle_types):
        count = kind.count - sum(vehicle.type == index for vehicle in taken)
        earliest = max(kind.earliest, past.now)
        if count > 0 and earliest <= kind.latest:
            plain[index] = replace(kind, count=count, earliest=earliest)
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


def _anchor_customer(kind: VehicleType, anchor: Anchor) -> Customer:
    """Return the customer who is served at an anchor, at once."""
    return Customer(f"{kind.id} at {anchor.time} ms", anchor.load, anchor.service, anchor.time,
                    anchor.time, served_by="truck")


class _Travels:
    """Travel matrices between the nodes that are left, those of trucks and of drones apart."""

    def __init__(self, problem: Problem, source: Sequence[int]) -> None:
        self._problem = problem
        self._grid = np.ix_(source, source)
        self._index: dict[tuple[int, str], int] = {}
        self._matrices: list[tuple[IntArray, IntArray]] = []

    def built(self) -> tuple[Travel, ...]:
        """Return the matrices."""
        return tuple(Travel(duration, distance) for duration, distance in self._matrices)

    def moved(self, kind: VehicleType) -> VehicleType:
        """Return a type with the matrices for the nodes that are left."""
        drones = kind.drones
        if drones is not None:
            drones = replace(drones, travel=self._take(drones.travel, DRONE))
        return replace(kind, travel=self._take(kind.travel, TRUCK), drones=drones)

    def begin(self, kind: VehicleType, anchor: Anchor, node: int, aboard: Sequence[int]) -> None:
        """Let a vehicle begin at its anchor; where nothing is aboard, go home from there.

        In place.
        """
        duration, distance = self._matrices[kind.travel]
        duration[:, node] = MAX_QUANTITY
        duration[kind.depot, node] = 0
        distance[kind.depot, node] = anchor.driven
        if not aboard:
            duration[node, :] = MAX_QUANTITY
            duration[node, kind.depot] = distance[node, kind.depot] = 0
        # Nobody else may serve those whose parcels are aboard, so this bars nobody else's way.
        columns = np.array(aboard, np.int64)
        duration[:self._problem.num_depots, columns] = MAX_QUANTITY
        if kind.drones is not None:
            for flights in self._matrices[kind.drones.travel]:
                flights[:self._problem.num_depots, columns] = UNREACHABLE

    def _take(self, travel: int, use: str) -> int:
        key = travel, use
        if key not in self._index:
            self._index[key] = len(self._matrices)
            matrix = self._problem.travel[travel]
            self._matrices.append((matrix.duration[self._grid], matrix.distance[self._grid]))
        return self._index[key]
