"""A region of a plan as a problem of its own, whose costs are the region's share of the whole's."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from model.problem import Depot, Problem
from model.search.beginning.stock import batteries_taken
from model.search.regions.region import Region
from model.solution import Solution, Vehicle, renumbered


@dataclass(frozen=True)
class RegionProblem:
    """A region as a problem: all depots, its customers and its vehicles."""

    problem: Problem
    nodes: tuple[int, ...]  # (node,) those of the whole problem
    vehicles: tuple[tuple[Vehicle, ...], ...]  # (type, number) those of the whole problem

    def outward(self, plan: Solution) -> Solution:
        """Return a plan of this part in the numbers of the whole problem."""
        return renumbered(plan, self.nodes.__getitem__,
                           lambda kind, number: self.vehicles[kind][number])

    def inward(self, plan: Solution) -> Solution:
        """Return a plan of the region in the numbers of this part; raises `KeyError` if it isn't.
        """
        return renumbered(plan, self._number.__getitem__,
                           lambda kind, number: self._vehicle[Vehicle(kind, number)])

    @cached_property
    def _number(self) -> dict[int, int]:
        return {node: number for number, node in enumerate(self.nodes)}

    @cached_property
    def _vehicle(self) -> dict[Vehicle, Vehicle]:
        return {vehicle: Vehicle(kind, number) for kind, all_of_it in enumerate(self.vehicles)
                for number, vehicle in enumerate(all_of_it)}


def part_of(problem: Problem, region: Region) -> RegionProblem:
    """Return a region of a plan as a problem of its own.

    Raises
    ------
    ValueError
        If it has no customers or no vehicles.
    """
    first = problem.num_depots
    served = region.plan.served
    customers = sorted((*served, *region.plan.unassigned))
    if problem.choices:
        customers = sorted({place for node in customers for place in problem.places_of(node)})
    if not customers or not region.vehicles:
        raise ValueError(f"region: {len(customers)} customers and {len(region.vehicles)} vehicles "
                         "are not allowed")
    kinds = sorted({kind for kind, _ in region.vehicles})
    vehicles = tuple(tuple(vehicle for vehicle in region.vehicles if vehicle[0] == kind)
                     for kind in kinds)
    nodes = (*range(first), *customers)
    chosen = np.array(nodes)
    may_serve = problem.may_serve
    if may_serve is not None:
        may_serve = may_serve[np.ix_(np.array(kinds), chosen[first:] - first)]
    parted = _parted(problem, region, nodes)
    if parted:
        if may_serve is None:
            may_serve = np.ones((len(kinds), len(customers)), np.bool_)
        may_serve[:, [node in parted for node in customers]] = False
    may_stop = None if problem.may_stop is None else problem.may_stop[kinds]
    return RegionProblem(replace(
        problem, depots=_depots_for(problem, region),
        customers=tuple(problem.customers[node - first] for node in customers),
        vehicle_types=tuple(replace(problem.vehicle_types[kind], count=len(all_of_it), numbers=())
                            for kind, all_of_it in zip(kinds, vehicles, strict=True)),
        travel=tuple(legs.among(chosen) for legs in problem.travel),
        coordinates=problem.coordinates[chosen],
        may_serve=may_serve, vehicle_costs=problem.vehicle_costs_of(kinds, customers),
        may_stop=may_stop, shipments=problem.shipments_among(nodes),
        relations=problem.relations_among(nodes), choices=problem.choices_among(nodes),
    ), nodes, vehicles)


def _parted(problem: Problem, region: Region, nodes: Collection[int]) -> set[int]:
    """Return those left out who go with somebody of another region."""
    if not problem.keeps_together:
        return set()
    there = frozenset(nodes)
    return {node for each in problem.relations if each.keeps_together
            and not there.issuperset(each.nodes) for node in each.nodes}.intersection(
                region.plan.unassigned)


def _depots_for(problem: Problem, region: Region) -> tuple[Depot, ...]:
    """Return depots that have as many batteries as the region takes."""
    return tuple([
        depot if depot.batteries is None else
        replace(depot, batteries=batteries_taken(problem, region.plan.routes, node))
        for node, depot in enumerate(problem.depots)])
