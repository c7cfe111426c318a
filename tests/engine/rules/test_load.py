"""Tests of the engine's loads against plain sums."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.amount_rows import DIMENSIONS_PER_TIER
from model.engine.instance import pack
from model.engine.records import Record, Records
from model.judge.check import check
from model.judge.timing import RouteDecision, TripDecision, schedule
from model.problem import IntArray, Problem
from model.solution import Solution
from tests.engine.rules.asking import asked
from tests.model.tiny import draw_tiny, with_dimensions, with_pickups
from tests.seeds import seeds

pytestmark = [pytest.mark.slow, pytest.mark.thorough]


def judged(kind: Record, places: Records) -> tuple[int, ...]:
    """Tell whether a vehicle holds all customers, holds the last on top, a drone lifts them."""
    return asked("demands_held", 3, kind, places, *places.shape)


def left(kind: Record, place: Records) -> tuple[int, ...]:
    """Tell whether a customer's demand is within a capacity, both amounts, and what is left."""
    return asked("capacity_left", 3, kind, place)


def drawn(seed: int) -> list[tuple[Problem, IntArray, list[int]]]:
    """Return problems of up to three dimensions, their first vehicle type's row, some customers."""
    rng = np.random.default_rng(seed)
    found = []
    for index in range(200):
        problem = draw_tiny(rng)
        count = index % DIMENSIONS_PER_TIER + 1
        drones = problem.vehicle_types[0].drones
        kind = replace(
            problem.vehicle_types[0], capacity=tuple(rng.integers(2, 9, count).tolist()),
            drones=drones and replace(drones, capacity=tuple(rng.integers(1, 5, count).tolist())))
        problem = replace(
            problem, vehicle_types=(kind,), amount_decimals=(3,) * count,
            customers=tuple(replace(customer, demand=tuple(rng.integers(0, 4, count).tolist()))
                            for customer in problem.customers))
        chosen = rng.permutation(np.arange(problem.num_depots, problem.num_nodes))
        found.append((problem, pack([problem]).type[0, 0],
                      chosen[: rng.integers(1, len(chosen) + 1)].tolist()))
    return found


def test_loads_fit_in_all_dimensions_or_not_at_all() -> None:
    seen = set()
    for problem, vehicle_type, nodes in drawn(seed=21):
        kind = problem.vehicle_types[0]
        load = np.sum([problem.customer_at(node).demand for node in nodes], axis=0)
        held = bool((load <= kind.capacity).all())
        lifted = bool((load <= (kind.drones.capacity if kind.drones else 0)).all())
        assert judged(vehicle_type, pack([problem]).node[0, 0][nodes]) == (held, held, lifted)
        seen.add((held, lifted))
    assert seen >= {(True, True), (True, False), (False, False)}


def test_what_is_left_is_what_was_there_less_the_demand() -> None:
    for problem, vehicle_type, nodes in drawn(seed=22):
        kind, demand = problem.vehicle_types[0], problem.customer_at(nodes[0]).demand
        inside = all(one <= most for one, most in zip(demand, kind.capacity, strict=True))
        assert left(vehicle_type, pack([problem]).node[0, 0, nodes[0]]) == (
            inside, sum(demand), sum(kind.capacity) - sum(demand))


def weighed(kind: Record, amounts: IntArray, nodes: IntArray, more: int) -> tuple[bool, list[bool]]:
    """Tell whether a vehicle may serve some in turn, and behind which stops one more."""
    allowed, *rooms = asked("rooms_between", len(nodes) + 2, kind, amounts, *amounts.shape[:2],
                            nodes, len(nodes), more)
    return bool(allowed), [bool(room) for room in rooms]


def is_legal(problem: Problem, nodes: list[int]) -> bool:
    """Tell whether the checker lets a truck serve some in turn, by loads alone."""
    kind, = problem.vehicle_types
    decision = RouteDecision(0, 0, (TripDecision((kind.begins_at, *nodes, kind.ends_at)),))
    broken = check(problem, Solution((schedule(problem, decision),))).violations
    return not {item.code for item in broken} & {"CAPACITY", "PICKUP_ORDER"}


def test_there_is_room_where_the_checker_says_so() -> None:
    seen = set()
    for seed in seeds(300):
        rng = np.random.default_rng(seed)
        problem = with_pickups(rng, draw_tiny(rng, drone_share=0.0))
        if seed % 3 == 0:
            problem = with_dimensions(rng, problem)
        problem = replace(problem, vehicle_types=problem.vehicle_types[:1])
        *nodes, more = rng.permutation(
            np.arange(problem.num_depots, problem.num_nodes)).tolist()
        instance = pack([problem])
        if instance.amount.shape[2] == 0:
            continue
        allowed, rooms = weighed(instance.type[0, 0], instance.amount[0], np.array(nodes), more)
        assert allowed == is_legal(problem, nodes), f"seed {seed}"
        if allowed:
            expected = [is_legal(problem, [*nodes[:p], more, *nodes[p:]])
                        for p in range(len(nodes) + 1)]
            assert rooms == expected, f"seed {seed}"
            seen.update(expected)
    assert seen == {True, False}
