"""What is left to plan, as a problem of its own.

What one vehicle alone can do is a type of its own. The rest of a trip begins at the place where its
vehicle is, a depot here, and serves those whose parcels are aboard.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from model.judge.freshness import first_departure
from model.judge.hubs import batteries_taken
from model.judge.past import Past
from model.problem import BoolArray, Customer, Depot, FloatArray, Problem, VehicleType
from model.problem.altered import with_customers
from model.replanning.amend import customers_of
from model.replanning.kept import Kept
from model.replanning.relations import relations_left, relations_table
from model.replanning.shares import fairness_left
from model.replanning.spans import flown_alone, spans_left, with_spans
from model.replanning.workers import VehicleWorker, from_now_on
from model.solution import Vehicle

NOBODY, ANYBODY = -1, -2
"""Instead of the only type that may serve a customer."""


@dataclass(frozen=True)
class Remainder:
    """The problem that is left. Its depots are those of the whole, then places of vehicles."""

    problem: Problem
    nodes: tuple[int, ...]  # of the whole problem
    kinds: tuple[int, ...]  # by type: that of the whole problem
    workers: Mapping[int, VehicleWorker]  # types that are one vehicle

    @property
    def num_plain(self) -> int:
        """Types that aren't one vehicle; they come first."""
        return len(self.kinds) - len(self.workers)

    @property
    def numbers(self) -> dict[int, int]:
        """What number each customer of the whole problem has here."""
        first = self.problem.num_depots
        return {node: index for index, node in enumerate(self.nodes[first:], first)}

    @property
    def beginning(self) -> list[int]:
        """Types that may begin trips: all but those that are the rest of one."""
        return [kind for kind in range(len(self.kinds))
                if not (kind in self.workers and self.workers[kind].is_under_way)]

    def holding(self, held: Mapping[int, int]) -> "Remainder":
        """Return what is left where some of the whole's customers come no sooner to the depot."""
        if not held:
            return self
        return replace(self, problem=held_back(self.problem, {
            node: held[whole] for whole, node in self.numbers.items() if whole in held}))

    def without(self, nodes: Collection[int]) -> "Remainder":
        """Return what is left where nobody serves some of the whole's customers."""
        if not nodes:
            return self
        problem = self.problem
        table = (np.ones((len(self.kinds), len(self.nodes) - problem.num_depots), np.bool_)
                 if problem.may_serve is None else problem.may_serve.copy())
        table[:, [here - problem.num_depots for whole, here in self.numbers.items()
                  if whole in nodes]] = False
        return replace(self, problem=replace(problem, may_serve=table))

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

    def from_depot(self, kind: int, node: int) -> list[int]:
        """Return the types that may begin trips, of those of one type of the whole problem.

        Those that may serve a customer, who is at a node there, come first.
        """
        index, table = self.nodes.index(node) - self.problem.num_depots, self.problem.may_serve
        found = [here for here in self.beginning if self.kinds[here] == kind]
        return found if table is None else sorted(found, key=lambda here: not table[here, index])

    def drones_of(self, kind: int) -> Sequence[int]:
        """Return what numbers drones of a type have in the whole problem, by number."""
        worker = self.workers.get(kind)
        if worker is not None:
            return worker.drones
        return range(self.problem.vehicle_types[kind].num_drones)

    def _find(self, vehicle: Vehicle, is_under_way: bool) -> int | None:
        return next((kind for kind, worker in self.workers.items() if worker.vehicle == vehicle
                     and worker.is_under_way == is_under_way), None)


def what_is_left(problem: Problem, past: Past, kept: Mapping[Vehicle, Kept],
                 workers: Sequence[VehicleWorker]) -> Remainder | None:
    """Return what is left to plan; None if there is nobody to serve, or nobody who could.

    `past` knows which parcels are back at the depot.
    """
    settled = problem.all_places(set[int]().union(*(route.served for route in kept.values())))
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
    carriers = problem.at_all_places({node: own for own in workers for node in own.aboard})
    starts = [_start(problem, node, types[kind].id) for kind, node in places.items()]
    depots, may_stop = _sites(problem, kept, kinds, owners)
    depots = _hubs_left(problem, kept, depots)
    free = [_customer_left(problem, past, kept, node, carriers.get(node)) for node in nodes]
    first = len(source) - len(nodes)
    relations = relations_left(problem, owners, {
        node: index for index, node in enumerate(nodes, first)})
    customers = with_spans(free, first, spans_left(problem, past.now, kept, nodes), relations)
    left = replace(
        problem, depots=(*depots, *starts),
        may_stop=None if may_stop is None else np.hstack(
            [may_stop, np.ones((len(kinds), len(starts)), np.bool_)]),
        customers=customers,
        shipments=problem.shipments_among(source), choices=problem.choices_among(source),
        relations=relations,
        vehicle_types=tuple(types), coordinates=problem.coordinates[source],
        travel=tuple(each.among(np.array(source)) for each in problem.travel),
        may_serve=_table(problem, past, kinds, owners, nodes)
        & _goods_table(problem, kept, kinds, owners, nodes)
        & relations_table(problem, kept, kinds, owners, nodes) & ~flown_alone(free, customers),
        vehicle_costs=_vehicle_costs(problem, past, kinds, owners, nodes),
        fairness=fairness_left(problem, past, kept, owners))
    return Remainder(left, tuple(source), kinds, owners)


def _plain_types(problem: Problem, past: Past, kept: Mapping[Vehicle, Kept],
                 workers: Sequence[VehicleWorker]) -> dict[int, VehicleType]:
    """Return the types of vehicles that have done nothing yet, as many as there are."""
    taken = {*kept, *past.unavailable, *(worker.vehicle for worker in workers)}
    plain = {}
    for index, kind in enumerate(problem.vehicle_types):
        count = kind.count - sum(vehicle.type == index for vehicle in taken)
        begun = from_now_on(kind, past.now)
        if count > 0 and begun is not None:
            plain[index] = replace(begun, count=count, numbers=())
    return plain


def _table(problem: Problem, past: Past, kinds: Sequence[int], owners: Mapping[int, VehicleWorker],
           nodes: Sequence[int]) -> BoolArray:
    """Return (type, customer) who may serve whom of those who are left.

    Those whose parcels are aboard are served by that vehicle alone, on the trip that it is on if it
    can; whoever is pinned by one vehicle, and all others by any that begins at the depot.
    """
    under_way = {owner.vehicle: kind for kind, owner in owners.items() if owner.is_under_way}
    later = {owner.vehicle: kind for kind, owner in owners.items() if not owner.is_under_way}
    bound = {**past.pinned, **problem.at_all_places(past.carriers())}
    only = {node: later.get(vehicle, NOBODY) for node, vehicle in bound.items()}
    only |= problem.at_all_places({
        node: under_way[owner.vehicle] for owner in owners.values() for node in owner.aboard})
    sole = np.array([only.get(node, ANYBODY) for node in nodes], np.int64)
    numbers = np.arange(len(kinds))[:, None]
    begins = ~np.isin(numbers, list(under_way.values()))
    table: BoolArray = np.where(sole == ANYBODY, begins, numbers == sole)
    if problem.may_serve is not None:
        table &= problem.may_serve[np.array(kinds)[:, None], np.array(nodes) - problem.num_depots]
    return table


def _vehicle_costs(problem: Problem, past: Past, kinds: Sequence[int],
                   owners: Mapping[int, VehicleWorker], nodes: Sequence[int]) -> FloatArray | None:
    """Return (type, customer) what serving costs, and changing who does."""
    costs, earlier = problem.vehicle_costs_of(kinds, nodes), past.earlier
    if earlier is None or not earlier.prices.vehicle:
        return costs
    vehicles = [tuple(owners[kind].vehicle) if kind in owners else None
                for kind in range(len(kinds))]
    places = [earlier.places.get(problem.first_place(node)) for node in nodes]
    moved = earlier.prices.vehicle * np.array(
        [[place is not None and place.vehicle != vehicle for place in places]
         for vehicle in vehicles], np.float64)
    return moved if costs is None else costs + moved


def _sites(problem: Problem, kept: Mapping[Vehicle, Kept], kinds: Sequence[int],
           owners: Mapping[int, VehicleWorker]) -> tuple[tuple[Depot, ...], BoolArray | None]:
    """Return the depots, and (type, depot) who may stop at launch sites.

    Where somebody had to be served before who has been, that vehicle alone comes back.
    """
    if not problem.launch_sites:
        return problem.depots, problem.may_stop
    depots, ids = list(problem.depots), {
        problem.customer_at(node).id: vehicle for vehicle, route in kept.items()
        for node in route.served}
    table = np.ones((len(problem.vehicle_types), problem.num_depots), np.bool_)
    may_stop: BoolArray = (table if problem.may_stop is None else problem.may_stop)[list(kinds)]
    for site in problem.launch_sites:
        name = problem.depots[site].after
        if name in ids:
            depots[site] = replace(problem.depots[site], after=None)
            may_stop[:, site] &= [kind in owners and owners[kind].vehicle == ids[name]
                                  for kind in range(len(kinds))]
    return tuple(depots), may_stop


def _hubs_left(problem: Problem, kept: Mapping[Vehicle, Kept],
               depots: tuple[Depot, ...]) -> tuple[Depot, ...]:
    """Return depots without the batteries that trips that were begun have taken."""
    taken = batteries_taken(problem, [each.route for each in kept.values()])
    return tuple([replace(depot, batteries=_left(depot.batteries, taken[node]))
                  for node, depot in enumerate(depots)])


def _left(stock: int | None, taken: int) -> int | None:
    return None if stock is None else max(0, stock - taken)


def _start(problem: Problem, node: int, vehicle: str) -> Depot:
    """Return the place where a vehicle is as one where it begins."""
    place = problem.place_at(node)
    return Depot(f"start of {vehicle}", site=place.site, launch=place.launch, zones=place.zones)


def _goods_table(problem: Problem, kept: Mapping[Vehicle, Kept], kinds: Sequence[int],
                 owners: Mapping[int, VehicleWorker], nodes: Sequence[int]) -> BoolArray:
    """Return (type, customer) whose goods may join what each vehicle has carried today."""
    table = np.ones((len(kinds), len(nodes)), np.bool_)
    for kind, owner in owners.items() if problem.incompatible_goods else ():
        route = kept.get(owner.vehicle)
        if route is None:
            continue
        carried = {"vehicle": route.served, "trip": frozenset[int]()}
        if owner.is_under_way:
            carried["trip"] = frozenset(customers_of(problem, route.decision.trips[-1]))
        elif route.way_on is not None:
            carried["vehicle"] = route.served | set(route.way_on.aboard)
        barred = frozenset().union(*(
            each.goods - present if len(present) == 1 else each.goods
            for each in problem.incompatible_goods
            if (present := _goods_of(problem, carried[each.scope]) & each.goods)))
        table[kind] = [not problem.customer_at(node).goods & barred for node in nodes]
    return table


def _goods_of(problem: Problem, nodes: Collection[int]) -> frozenset[str]:
    """Return all goods of some customers."""
    return frozenset().union(*(problem.customer_at(node).goods for node in nodes))


def _customer_left(problem: Problem, past: Past, kept: Mapping[Vehicle, Kept], node: int,
                   carrier: VehicleWorker | None) -> Customer:
    """Return a customer who is left, whose parcel may be aboard a vehicle already."""
    customer = _back(problem.customer_at(node), past.returned.get(node, 0))
    limit = customer.max_time_aboard
    if carrier is None or limit is None:
        return customer
    kind = problem.vehicle_types[carrier.vehicle.type]
    departure = first_departure(kind, kept[carrier.vehicle].route.trips[-1])
    served = _served_by(customer, departure + limit)
    if served is not None:
        return served
    aboard = max(carrier.kind.earliest, carrier.kind.busy_until) - departure
    return replace(customer, max_time_aboard=max(0, limit - aboard))


def _served_by(customer: Customer, latest: int) -> Customer | None:
    """Return a customer whose service may start no later; None if windows can't say so.

    However long its vehicle waits before it goes on, the parcel is aboard.
    """
    gaps = tuple(gap for gap in customer.gaps if gap[1] <= latest)
    closes = [*(closing for closing, _ in customer.gaps), customer.latest][len(gaps)]
    is_soft = len(gaps) == len(customer.gaps) and customer.late_cost_per_hour is not None
    if latest < customer.earliest or (is_soft and closes < latest):
        return None
    return replace(customer, gaps=gaps, latest=min(closes, latest), late_cost_per_hour=None,
                   max_time_aboard=None)


def held_back(problem: Problem, held: Mapping[int, int]) -> Problem:
    """Return a problem in which parcels of some customers, by node, are at the depot later."""
    return with_customers(problem, {node: _back(problem.customer_at(node), until)
                                    for node, until in held.items()})


def _back(customer: Customer, returned: int) -> Customer:
    """Return a customer whose parcel may have to come back to the depot first."""
    if returned <= customer.release_time:
        return customer
    return replace(customer, release_time=returned)
