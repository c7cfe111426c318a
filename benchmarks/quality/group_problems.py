"""Random problems in which some customers can be served together alone, and their best plans.

One-way streets, rings and matrices with huge values where there is no road, with a closing time or
another limit that the direct ways there and back break. The best plan is found by trying every
order of every group on every vehicle, judged by the checker.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from model.judge.check import check
from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import time_route
from model.judge.timing import RouteDecision, TripDecision
from model.problem import (
    MAX_QUANTITY, UNLIMITED, Customer, Depot, IntArray, Overtime, Problem, Travel, VehicleType,
)
from model.solution import Solution
from model.travel.matrices import with_nowhere

SECOND = 1000

NO_ROAD = (100_000 * SECOND, 3_000 * SECOND, 500_000_000 * SECOND, 400 * SECOND)
"""What matrices say where there is no road."""

LEFT_OUT = 1e7
"""Cost of leaving somebody out, above that of any route."""


def draw_group(rng: np.random.Generator, most: int = 7) -> Problem:
    """Draw a problem of up to `most` customers, one to three vehicles and a rule or two."""
    number = int(rng.integers(2, most + 1))
    depots = 1 + int(rng.random() < 0.2)
    legs = _legs(rng, depots + number, depots)
    problem = Problem(
        depots=tuple(Depot(str(index)) for index in range(depots)),
        customers=tuple(_customer(rng, index) for index in range(number)),
        vehicle_types=tuple(_vehicles(rng, depots, number)),
        travel=(Travel(legs, np.minimum(10 * legs, MAX_QUANTITY)),),
        coordinates=rng.random((depots + number, 2)), unassigned_cost=LEFT_OUT)
    return _opened(problem) if rng.random() < 0.15 else problem


def _opened(problem: Problem) -> Problem:
    """Return a problem whose vehicles end wherever they are done."""
    end = problem.num_depots
    return replace(
        problem, depots=(*problem.depots, Depot("end", "nowhere")),
        travel=tuple(with_nowhere(each, end, False) for each in problem.travel),
        coordinates=np.insert(problem.coordinates, end, 0.0, axis=0),
        vehicle_types=tuple(replace(kind, end=end) for kind in problem.vehicle_types))


def _legs(rng: np.random.Generator, size: int, depots: int) -> IntArray:
    """Draw durations: roads are few and mostly one way."""
    legs = np.full((size, size), NO_ROAD[int(rng.integers(len(NO_ROAD)))], np.int64)
    roads = rng.random((size, size)) < rng.choice((0.15, 0.25, 0.4))
    if rng.random() < 0.5:
        order = [0, *(depots + rng.permutation(size - depots)).tolist()]
        for begin, node in zip(order, [*order[1:], 0], strict=True):
            roads[begin, node] = True
    legs[roads] = rng.integers(1, 13, int(roads.sum())) * 5 * SECOND
    if rng.random() < 0.3:  # some can be served alone
        near = depots + rng.integers(size - depots)
        legs[0, near] = legs[near, 0] = 10 * SECOND
    np.fill_diagonal(legs, 0)
    return legs


def _customer(rng: np.random.Generator, index: int) -> Customer:
    earliest = int(rng.integers(0, 12)) * 10 * SECOND if rng.random() < 0.2 else 0
    latest = earliest + int(rng.integers(1, 15)) * 10 * SECOND
    pickup = int(rng.random() < 0.15)
    return Customer(
        str(index), (1 - pickup,), pickup=(pickup,) if pickup else (),
        service_duration=int(rng.integers(0, 3)) * 5 * SECOND,
        earliest=earliest, latest=latest if rng.random() < 0.25 else UNLIMITED,
        skills=frozenset({"lift"} if rng.random() < 0.1 else ()),
        max_time_aboard=60 * SECOND if rng.random() < 0.05 else None)


def _vehicles(rng: np.random.Generator, depots: int, number: int) -> Iterator[VehicleType]:
    kinds = 1 + int(rng.random() < 0.3)
    for index in range(kinds):
        limit = int(rng.integers(3, 30)) * 10 * SECOND
        rule = int(rng.integers(5))
        yield VehicleType(
            f"van{index}", count=int(rng.integers(1, 4 - index)),
            capacity=(int(rng.integers(1, number + 2)),), travel=0,
            depot=int(rng.integers(depots)), fixed_cost=float(rng.integers(0, 2)) * 5,
            cost_per_km=float(rng.integers(0, 3)), cost_per_hour=float(rng.integers(0, 3)) * 10,
            latest=limit if rule != 1 or rng.random() < 0.5 else UNLIMITED,
            max_working_duration=limit if rule == 1 else None,
            max_trip_distance=limit * 8 if rule == 2 else None,
            overtime=Overtime(30.0, 60 * SECOND) if rng.random() < 0.05 else None,
            pickups="last" if rng.random() < 0.2 else "any",
            max_trips=int(rng.integers(2, 4)) if rule == 3 else 1,
            reload_duration=5 * SECOND if rng.random() < 0.5 else 0,
            start=int(rng.integers(depots)) if rng.random() < 0.2 else None,
            end=int(rng.integers(depots)) if rng.random() < 0.2 else None,
            skills=frozenset({"lift"} if rng.random() < 0.7 else ()))


def draw_streets(rng: np.random.Generator, number: int, vehicles: int,
                 spare: float = 1.0) -> Problem:
    """Draw one-way streets of so many customers, all of whom the vehicles can just serve.

    `spare` is how much longer than the longest of some routes the shift is.
    """
    place = rng.random((number + 1, 2))
    place[0] = 0.5
    apart = np.sqrt(((place[:, None] - place) ** 2).sum(axis=2))
    drive = (apart * 600 + 5).astype(np.int64) * SECOND
    roads = np.zeros(apart.shape, np.bool_)
    for node in range(number + 1):
        near = np.argsort(apart[node])[1:7]
        roads[node, near[rng.random(6) < 0.4]] = True
    left, longest = set(range(1, number + 1)), 0
    for _ in range(vehicles):
        at = time = 0
        for _ in range(min(len(left), -(-number // vehicles))):
            following = min(left, key=lambda node: float(apart[at, node]))
            left.discard(following)
            roads[at, following], time = True, time + int(drive[at, following])
            at = following
        roads[at, 0], longest = True, max(longest, time + int(drive[at, 0]))
    legs = np.where(roads, drive, NO_ROAD[0])
    np.fill_diagonal(legs, 0)
    return Problem(
        (Depot("depot"),), tuple(Customer(str(index), (1,)) for index in range(number)),
        (VehicleType("van", vehicles, (number,), 0, cost_per_km=1.0,
                     latest=int(longest * spare)),),
        (Travel(legs, np.minimum(10 * legs, MAX_QUANTITY)),), place, LEFT_OUT)


@dataclass(frozen=True)
class Best:
    """What the best of all plans serves and costs."""

    served: int
    cost: float


def best_plan(problem: Problem) -> Best:
    """Return what the best plan by trucks does, found by trying all."""
    number, cost = problem.num_customers, {0: 0.0}
    for kind, vehicles in enumerate(problem.vehicle_types):
        routes = _cheapest_routes(problem, kind)
        for _ in range(min(vehicles.count, number)):
            better = dict(cost)
            for (served, before), (group, price) in product(cost.items(), routes.items()):
                if not served & group and before + price < better.get(served | group, np.inf):
                    better[served | group] = before + price
            cost = better
    least, served = min((price + sum([
        problem.cost_of_leaving_out(customer) for index, customer in enumerate(problem.customers)
        if not group >> index & 1]), group) for group, price in cost.items())
    return Best(served.bit_count(), least)


def _cheapest_routes(problem: Problem, kind: int) -> dict[int, float]:
    """Return what the cheapest route of a vehicle costs by the customers it serves, as bits."""
    cheapest: dict[int, float] = {}
    for trips in _orders(problem, kind):
        timed = time_route(problem, RouteDecision(kind, 0, trips), "", EVERYTHING_OPEN)
        if not timed.judged.violations:
            mask = sum(1 << node - problem.num_depots for node in timed.judged.nodes)
            cost = timed.judged.cost.total
            cheapest[mask] = min(cost, cheapest.get(mask, np.inf))
    return cheapest


def _orders(problem: Problem, kind: int) -> Iterator[tuple[TripDecision, ...]]:
    """Yield all routes of a vehicle that aren't too late already on their way."""
    vehicles = problem.vehicle_types[kind]
    duration = problem.travel[vehicles.travel].duration
    over = vehicles.overtime.max_duration if vehicles.overtime else 0
    nodes = [node for node in range(problem.num_depots, problem.num_nodes)
             if vehicles.skills >= problem.customer_at(node).skills]

    def onward(done: tuple[TripDecision, ...], stops: tuple[int, ...], time: int,
               left: Sequence[int]) -> Iterator[tuple[TripDecision, ...]]:
        if time > vehicles.latest + over:
            return
        if len(stops) > 1:
            yield (*done, TripDecision((*stops, vehicles.ends_at)))
            if len(done) + 1 < vehicles.max_trips:
                for depot in vehicles.reload_places:
                    ready = time + duration.item(stops[-1], depot) + vehicles.reload_duration
                    trip = TripDecision((*stops, depot))
                    yield from onward((*done, trip), (depot,), ready, left)
        if len(stops) > vehicles.capacity[0] * 2:
            return
        for node in left:
            customer = problem.customer_at(node)
            arrival = time + duration.item(stops[-1], node)
            if arrival <= customer.latest:
                begin = max(arrival, customer.earliest)
                yield from onward(done, (*stops, node),
                                  begin + vehicles.service_at(customer),
                                  [other for other in left if other != node])

    yield from onward((), (vehicles.begins_at,), vehicles.earliest, nodes)


def what_comes(problem: Problem, plan: Solution) -> Best:
    """Return what a plan serves and costs.

    Raises
    ------
    ValueError
        If it breaks a rule.
    """
    evaluation = check(problem, plan)
    if evaluation.violations:
        raise ValueError(f"plan: {evaluation.violations} is not allowed")
    return Best(problem.num_customers - len(plan.unassigned), evaluation.cost.total)
