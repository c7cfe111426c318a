"""What candidates lead to: neighbours timed by hand on a straight street."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.policy.decision_features import Rollouts, Scene
from model.policy.problem_features import scales, tokens
from model.problem import Problem
from model.simulation.actions import DRIVE, LAUNCH, OPEN, apply, encode_action
from tests.conftest import MINUTE

TIMED = ["next_duration", "next_slack", "lost", "detour_before", "later_duration"]
PLACES = (0.0, 1.0, 2.0, 4.0, 8.0)


def prospects(problem: Problem, *actions: int) -> dict[int, np.ndarray]:
    """Return what is seen of each legal action after some actions, by code."""
    instance = pack([problem])
    scale = scales(instance)
    assert scale.near[0] == 4 * MINUTE  # neighbours are 1, 1, 2, 4 km away, 2 minutes a km
    types = tokens(instance, scale, problem.coordinates[None]).type
    rollouts = Rollouts(Scene(instance, scale, types), np.zeros(1, np.int64))
    seen = rollouts.seen
    for action in actions:
        apply(instance, rollouts.state, 0, action)
    rollouts.observe()
    return {int(code): np.array([seen.described[name][0, index] for name in TIMED]) for index, code
            in enumerate(seen.action[0, :seen.count[0]])}


def test_drives_are_timed_before_and_after(tiny_problem, customers, truck) -> None:
    first, *others = customers
    problem = tiny_problem(replace(first, latest=14 * MINUTE), *others, truck=truck, places=PLACES)
    # The truck is free at 2 km after 9 minutes. By way of customer 3, at 4 km, customer 1 is lost,
    # which would have been a detour of 4 minutes; customer 4 comes 8 minutes later.
    seen = prospects(problem, encode_action(OPEN, 0), encode_action(DRIVE, 2))
    np.testing.assert_allclose(seen[encode_action(DRIVE, 3)], [8 / 12, 1, 1 / 2, 4 / 4 / 3, 6 / 10],
                               rtol=1e-4)
    # After customer 1, customer 3 comes 6 minutes later. Before it, none is in time from here, but
    # another truck could come from customer 3.
    np.testing.assert_allclose(seen[encode_action(DRIVE, 1)], [6 / 10, 1, 0, 1, 6 / 10], rtol=1e-4)


def test_load_left_bounds_what_comes_next(tiny_problem, customers, truck) -> None:
    *others, last = customers
    small = replace(truck, capacity=(3000,))
    problem = tiny_problem(*others, replace(last, demand=(2000,)), truck=small, places=PLACES)
    seen = prospects(problem, encode_action(OPEN, 0), encode_action(DRIVE, 2))
    next_duration, _, lost, *_ = seen[encode_action(DRIVE, 3)]
    assert next_duration == pytest.approx(6 / 10)  # customer 1
    assert lost == 1 / 2  # customer 4, too heavy then


def test_flights_are_timed_to_where_the_truck_may_be(tiny_problem, customers, truck,
                                                     drones) -> None:
    problem = tiny_problem(*customers, truck=replace(truck, drones=drones), places=PLACES)
    seen = prospects(problem, encode_action(OPEN, 0), encode_action(DRIVE, 2))
    # The drone is ready at customer 3 after 2 + 5 minutes and meets the truck at customer 1 after
    # 10; at customer 4 the truck, that would have passed customer 3, needs not wait.
    np.testing.assert_allclose(seen[encode_action(LAUNCH, 3)], [10 / 14, 0, 0, 0, 0], rtol=1e-4)
    # From customer 1 they meet at customer 3 after 9 minutes; at customer 4 the truck waits one.
    np.testing.assert_allclose(seen[encode_action(LAUNCH, 1)], [9 / 13, 1 / 5, 0, 4 / 4 / 3, 0],
                               rtol=1e-4)
