"""Drivers rest as brute force has it, minute by minute, where roads are slow for hours, too."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.breaks import BreakDecision
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import (
    FULL_SPEED, REST, UNLIMITED, Customer, DrivingRules, DroneType, Fairness, Problem,
    SpeedProfile, Travel, VehicleType,
)
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from tests.model.judge.test_driving import INTERRUPTED, street
from tests.model.tiny_breaks import short_day

MINUTE = 60_000

LONGEST = 16 * MINUTE
"""How long a leg takes at most, half as fast."""


def drawn(rng: np.random.Generator) -> Problem:
    """Draw two customers with windows, and a driver who may need a rest."""
    def resting(truck: VehicleType) -> VehicleType:
        work = int(rng.integers(14, 20)) * MINUTE if rng.random() < 0.5 else UNLIMITED
        return replace(truck, driving=DrivingRules(
            int(rng.integers(9, 13)) * MINUTE, int(rng.integers(1, 5)) * MINUTE, max_work=work))

    return short_day(rng, resting)


def slow(rng: np.random.Generator) -> Problem:
    """Draw the same where it is slow for a while, only the end costs, and work isn't bounded.

    So none begins later, of whom some instants alone are tried.
    """
    problem = drawn(rng)
    begin = int(rng.integers(2, 25))
    times = (begin * MINUTE, (begin + int(rng.integers(2, 15))) * MINUTE)
    profile = SpeedProfile(times, (FULL_SPEED, FULL_SPEED // 2, FULL_SPEED))
    kind, = problem.vehicle_types
    assert kind.driving is not None
    return replace(problem, fairness=Fairness(60.0), vehicle_types=(replace(
        kind, speed_profile=profile, cost_per_hour=0.0,
        driving=replace(kind.driving, max_work=UNLIMITED)),))


def cheapest(problem: Problem) -> float:
    """Return what the cheapest plan costs with a rest at most, on the way as late as may be."""
    return min((cost for size in (1, 2) for nodes in permutations((1, 2), size)
                for start in range(0, 40 * MINUTE, MINUTE)
                for cost in costs(problem, nodes, start)), default=2 * problem.unassigned_cost)


def costs(problem: Problem, nodes: tuple[int, ...], start: int) -> Iterator[float]:
    """Yield what plans cost that serve these in order, by a route that begins then; without a rest
    if that may be.
    """
    left = tuple(node for node in (1, 2) if node not in nodes)

    def cost(*breaks: BreakDecision) -> float | None:
        trip = TripDecision((0, *nodes, 0), start=start, breaks=breaks)
        judged = check(problem, Solution((schedule(problem, RouteDecision(0, 0, (trip,))),), left))
        return judged.cost.total if judged.is_feasible else None

    rules = problem.vehicle_types[0].driving
    assert rules is not None
    found = [cost()]
    for leg in range(len(nodes) + 1 if found == [None] else 0):
        found += [cost(BreakDecision(REST, leg, place, 0, rules.rest))
                  for place in ("departure", "arrival")]
        on_way = (cost(BreakDecision(REST, leg, "way", driven, rules.rest))
                  for driven in range(LONGEST, 0, -MINUTE))
        found.append(next((each for each in on_way if each is not None), None))
    yield from (each for each in found if each is not None)


def break_counts(problem: Problem) -> list[int]:
    """Return how often each driver rests who serves all of a problem, as legally."""
    found = improve(problem, pack([problem]), Solution((), problem.left_out(())),
                    SearchConfig(turns=20)).solution
    assert found.unassigned == ()
    assert check(problem, found).violations == ()
    return [sum(len(trip.breaks) for trip in route.trips) for route in found.routes]


@pytest.mark.parametrize(("setup", "rests"), [(5, 0), (4, 1)])
def test_setup_and_service_interrupt_driving_together(setup: int, rests: int) -> None:
    served = Customer("a", (1,), service_duration=5 * MINUTE, setup_duration=setup * MINUTE)
    assert break_counts(replace(street(INTERRUPTED, served), unassigned_cost=1e6)) == [rests]


@pytest.mark.parametrize(("apart", "rests"), [(0, 0), (1, 1)])
def test_service_at_one_place_interrupts_driving_together(apart: int, rests: int) -> None:
    served = (Customer(name, (1,), service_duration=5 * MINUTE) for name in "ab")
    legs = np.array([[0, 10, 10], [10, 0, apart], [10, apart, 0]]) * MINUTE
    problem = replace(street(INTERRUPTED, *served), travel=(Travel(legs, legs),),
                      unassigned_cost=1e6)
    assert break_counts(problem) == [rests]


def test_a_driver_rests_while_a_drone_from_the_depot_is_out() -> None:
    """The flight takes 21 minutes."""
    problem = street(DrivingRules(UNLIMITED, 5 * MINUTE, max_work=16 * MINUTE),
                     Customer("a", (1,), service_duration=MINUTE, served_by="drone"))
    van = replace(problem.vehicle_types[0], drones=DroneType(1, (1,), 0, UNLIMITED))
    assert break_counts(replace(problem, vehicle_types=(van,), unassigned_cost=1e6)) == [1]


@pytest.mark.slow
@pytest.mark.thorough
@pytest.mark.parametrize(("draw", "seed"), [
    *((drawn, seed) for seed in (1, 4, 9)), *((slow, seed) for seed in (5, 9))])
def test_one_rest_is_taken_where_it_costs_least(draw: Callable[[np.random.Generator], Problem],
                                                seed: int) -> None:
    problem = draw(np.random.default_rng(seed))
    found = improve(problem, pack([problem]), Solution((), (1, 2)),
                    SearchConfig(turns=100)).solution
    judged = check(problem, found)
    assert judged.violations == ()
    assert sum(len(trip.breaks) for route in found.routes for trip in route.trips) == 1
    assert judged.cost.total == pytest.approx(cheapest(problem))
