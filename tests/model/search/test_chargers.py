"""A search in which drones wait for each other to be charged."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import permutations

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import Problem
from model.search.improve import SearchConfig, improve
from model.policy.extract import extract
from model.solution import Solution
from tests.model.chargers import MINUTE, battery_of, charged_street, order
from tests.model.fliers import charging, from_few_hubs, from_hubs
from tests.model.rollouts import roll
from tests.model.tiny import draw_tiny, with_gaps, with_open_reloads, with_reloads


def searched(problem: Problem, turns: int, seed: int = 0) -> Solution:
    """Return what a search finds, which the judge has nothing against."""
    plan = improve(problem, pack([problem], False), Solution((), ()),
                   SearchConfig(seed, turns=turns)).solution
    assert check(problem, plan).violations == ()
    return plan


def test_drones_wait_for_the_only_place() -> None:
    """The four can be served in time only if both fly again, one charged behind the other."""
    customers = [order("a", 2), order("b", 2), order("c", 8), order("d", 10)]
    assert searched(charged_street(*customers, chargers=1), 200).unassigned == ()
    customers[3] = order("d", 9)
    assert len(searched(charged_street(*customers, chargers=1), 200).unassigned) == 1
    assert searched(charged_street(*customers, chargers=2), 200).unassigned == ()


def _orders(nodes: Sequence[int]) -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
    """Yield all ways in which two vehicles fly to some customers, one a trip, in their order."""
    for order_of in permutations(nodes):
        for split in range(len(nodes) + 1):
            yield order_of[:split], order_of[split:]


def _can_be_flown(problem: Problem, plan: tuple[tuple[int, ...], ...], places: int) -> bool:
    """Tell whether trips are in time where vehicles are charged for their next trip alone, in any
    order.
    """
    queue = [vehicle for vehicle, nodes in enumerate(plan) for _ in nodes]
    return any(_is_in_time(problem, plan, turn, places) for turn in set(permutations(queue)))


def _is_in_time(problem: Problem, plan: tuple[tuple[int, ...], ...], turn: Sequence[int],
                places: int) -> bool:
    kind, duration = problem.vehicle_types[0], problem.travel[0].duration
    full = battery_of(kind).available // battery_of(kind).charge
    free, level, flown, since = [0] * len(plan), [full] * len(plan), [0] * len(plan), [0] * places
    for vehicle in turn:
        node = plan[vehicle][flown[vehicle]]
        away = duration.item(0, node)
        start, lacking = free[vehicle], 2 * away - level[vehicle]
        if 2 * away > full:
            return False
        if lacking > 0:
            if not places:
                return False
            place = since.index(min(since))
            start = since[place] = max(free[vehicle], since[place]) + lacking
            level[vehicle] += lacking
        start = max(start, problem.customer_at(node).release_time)
        if start + MINUTE + away > problem.customer_at(node).latest:
            return False
        level[vehicle] -= 2 * away
        free[vehicle] = start + 2 * MINUTE + 2 * away
        flown[vehicle] += 1
    return True


@pytest.mark.parametrize("places", [0, 1])
def test_no_more_are_left_out_than_by_brute_force(places: int) -> None:
    left_out = 0
    for seed in range(6):
        rng = np.random.default_rng(seed)
        customers = [order(str(index), int(rng.integers(3, 18)), int(rng.integers(0, 4)))
                     for index in range(4)]
        problem = charged_street(*customers, chargers=places, minutes=int(rng.integers(4, 7)),
                                 far=tuple(rng.integers(1, 3, 4).tolist()))
        served = max(sum(bool(mask >> index & 1) for index in range(4)) for mask in range(16)
                     if any(_can_be_flown(problem, plan, places) for plan in _orders(
                         [index + 1 for index in range(4) if mask >> index & 1])))
        left = len(searched(problem, 300).unassigned)
        assert left <= 4 - served, seed
        left_out += left
    assert left_out > 0


def test_few_places_serve_more_than_a_vehicle_each() -> None:
    """Six drones share two places; each flies more often than a battery lasts."""
    problem = charging(from_hubs(np.random.default_rng(1), 40, 8), 2)
    kind = problem.vehicle_types[0]
    longest = 2 * int(problem.travel[kind.travel].duration[0].max())
    energy = replace(battery_of(kind), available=longest * 1000, charge=3000)
    problem = replace(problem, vehicle_types=(replace(kind, energy=energy, count=6),))
    plan = searched(problem, 400)
    charged = {route.vehicle for route in plan.routes for trip in route.trips if trip.charges}
    assert len(charged) > 2


def _reloading(seed: int) -> Problem:
    """Draw a problem of trips in the air that begin at several depots with little there."""
    rng = np.random.default_rng(seed)
    problem = draw_tiny(rng)
    rng.random()
    change = (with_reloads, with_open_reloads)[int(rng.integers(2))]
    problem = from_few_hubs(rng, change(rng, problem))
    return with_gaps(rng, problem) if rng.random() < 0.3 else problem


@pytest.mark.parametrize("seed", [55, 760, 999, 2707])
def test_rollouts_are_charged_where_and_when_their_trips_begin(seed: int) -> None:
    """Another depot than their own, at which they reload, may have no place for that.

    Who begins the first trip later is charged for less time before the second (2707).
    """
    problem = _reloading(seed)
    rollout = roll([problem], seed).rollouts[0]
    plan = extract(problem, pack([problem]), rollout.actions)
    assert not check(problem, plan).violations


@pytest.mark.parametrize("seed", [2, 148])
def test_packed_trips_take_batteries_where_they_begin(seed: int) -> None:
    """That is another depot than their own, with no battery."""
    searched(_reloading(seed), 5)
