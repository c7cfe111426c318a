"""Customers whom relations keep together, all moved to another vehicle at once, by way of trial."""

import time
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

from model.counsel.bench import Bench, Drafted, Trial
from model.counsel.screening import best_first
from model.judge.check import JudgedRoute
from model.judge.places import find_place
from model.problem import Shipment
from model.solution import Vehicle


class Effort(NamedTuple):
    """How much is tried with a vehicle."""

    tries: int  # places for each of them, the likeliest ones
    width: int  # ways to place some of them that are gone on with, the best ones


EFFORTS = Effort(3, 1), Effort(16, 12)
"""All vehicles are tried with the first, then with the next while there is time."""


class MovedUnit(NamedTuple):
    """A customer, or all ends of a shipment, which move as one."""

    node: int
    shipment: Shipment | None = None

    @property
    def nodes(self) -> tuple[int, ...]:
        """All that it has."""
        return (self.node,) if self.shipment is None else self.shipment.nodes


@dataclass(frozen=True)
class Way:
    """A plan with some of them at places of a vehicle, and its routes as judged."""

    trial: Trial
    judged: Mapping[int, JudgedRoute]


def companions_of(bench: Bench) -> tuple[MovedUnit, ...]:
    """Return with whom a customer or shipment has to move to another vehicle, of those served.

    Nobody goes along with one end of a shipment, which the other binds, nor where one of them is
    on a trip that has begun.
    """
    found = _bound_to(bench, _served(bench))
    moved = {*bench.nodes, *(node for unit in found for node in unit.nodes)}
    return () if _begun(bench) & moved else found


def companions_to(bench: Bench) -> tuple[MovedUnit, ...]:
    """Return the same of those left out, too; but for whoever is on a trip that has begun."""
    problem, served, begun = bench.problem, _served(bench), _begun(bench)
    places = problem.all_places(served)
    left_out = [node for node in range(problem.num_depots, problem.num_nodes)
                if node == problem.first_place(node) and node not in places]
    return tuple([unit for unit in _bound_to(bench, [*served, *left_out])
                  if begun.isdisjoint((*bench.nodes, *unit.nodes))])


def not_with(bench: Bench, companions: tuple[MovedUnit, ...],
             vehicle: Vehicle) -> tuple[MovedUnit, ...]:
    """Return those whom a vehicle doesn't serve."""
    own = [find_place(bench.plan.solution, unit.node) for unit in companions]
    return tuple([unit for unit, found in zip(companions, own, strict=True)
                  if found is None or found.place.vehicle != vehicle])


def _served(bench: Bench) -> list[int]:
    """Return the nodes that a plan serves, in its order."""
    return [node for route in bench.plan.solution.routes for node in route.served]


def _begun(bench: Bench) -> set[int]:
    """Return the nodes of trips that have begun."""
    return {node for trips in bench.setting.past.trips.values() for trip in trips
            for node in trip.aboard | trip.served}


def _bound_to(bench: Bench, among: Iterable[int]) -> tuple[MovedUnit, ...]:
    """Return who of some nodes has to be served by the vehicle that serves a customer."""
    problem, known = bench.problem, [*among]
    if not problem.keeps_together or (bench.shipment is None and bench.node in problem.shipment_at):
        return ()
    found, asked = dict[int, MovedUnit](), [*bench.nodes]
    for node in asked:
        bound = {other for relation in problem.relations
                 if relation.keeps_together and node in relation.nodes for other in relation.nodes}
        for other in known:
            if other in bound and other not in bench.nodes and problem.unit_of(other) not in found:
                shipment = problem.shipment_at.get(other)
                unit = MovedUnit(problem.unit_of(other), shipment)
                found[unit.node] = unit
                asked += unit.nodes
    return tuple(found.values())


def move_all(bench: Bench, along: Mapping[Vehicle, tuple[MovedUnit, ...]], until: float
             ) -> tuple[dict[Vehicle, Trial], bool]:
    """Return what is found by an instant if each vehicle serves a customer and who goes along.

    And whether all of them were tried.
    """
    left_out = {companions: _without(bench, companions) for companions in {*along.values()}}
    best = dict[Vehicle, Trial]()
    for effort, (vehicle, companions) in product(EFFORTS, along.items()):
        trial = _move_together(bench, companions, left_out[companions], vehicle, effort, until)
        if trial is not None:
            best[vehicle] = min(trial, best.get(vehicle, trial), key=lambda trial: trial.rank)
        elif time.perf_counter() >= until:
            return best, False
    return best, True


def _move_together(bench: Bench, companions: tuple[MovedUnit, ...], left_out: Way, vehicle: Vehicle,
                   effort: Effort, until: float) -> Trial | None:
    """Return a plan in which a vehicle serves a customer with all who are bound to go with him.

    The best of those tried, one after another being placed; None: there was no time until an
    instant, on `time.perf_counter`, or the vehicle has no places.
    """
    ways = [left_out]
    for unit in (MovedUnit(bench.node, bench.shipment), *companions):
        drafts: list[tuple[tuple[int, float], Bench, Drafted]] = []
        for way in ways:
            own = Bench(bench.problem, way.trial.solution, unit.node, bench.setting, way.judged,
                        unit.shipment)
            cost = way.trial.evaluation.cost.total
            drafts += [((len(draft.timed.judged.violations), cost + draft.added), own, draft)
                       for draft in _drafts(own, vehicle, effort.tries, until)]
            if time.perf_counter() >= until:
                return None
        best = sorted(drafts, key=lambda each: each[0])[:effort.width]
        ways = [Way(own.finish(draft), {**own.judged, draft.index: draft.timed.judged})
                for _, own, draft in best]
    return min([way.trial for way in ways], key=lambda trial: trial.rank, default=None)


def _without(bench: Bench, companions: tuple[MovedUnit, ...]) -> Way:
    """Return the plan that leaves all of them out."""
    trial, judged = bench.left_out, bench.judged
    for unit in companions:
        own = Bench(bench.problem, trial.solution, unit.node, bench.setting, judged, unit.shipment)
        trial, judged = own.left_out, own.judged
    return Way(trial, judged)


def _drafts(bench: Bench, vehicle: Vehicle, tries: int, until: float) -> Iterator[Drafted]:
    """Yield routes of a vehicle with a customer or shipment at its likeliest places."""
    for guess in best_first(bench.guesses(until=until, wanted=vehicle.__eq__))[:tries]:
        if time.perf_counter() < until:
            yield bench.draft(guess.place)
