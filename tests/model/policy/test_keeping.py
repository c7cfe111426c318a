"""Parts of a plan that further samples keep."""

import numpy as np
import pytest

from model.engine.instance import pack
from model.policy.keeping import LEAST_ANEW, MOST_ANEW, MOST_ANEW_GREEDILY, part_to_keep
from model.problem import IntArray
from model.simulation.actions import DRIVE, LAUNCH, NUM_KINDS, OPEN, apply, reset
from tests.model.rollouts import legal, random_problems, roll
from tests.seeds import often


def is_service(action: int) -> bool:
    """Tell whether an action serves a customer."""
    return action % NUM_KINDS in (DRIVE, LAUNCH)


def node_of(action: int) -> int:
    """Return where an action leads."""
    return int(action // NUM_KINDS)


def nearest(drive: IntArray, seed: int, nodes: set[int]) -> int:
    """Return how far the nearest of some nodes is."""
    return min(int(drive[seed, node]) for node in nodes)


def services(actions: IntArray) -> int:
    """Return how many customers are served."""
    return int(np.isin(actions % NUM_KINDS, (DRIVE, LAUNCH)).sum())


def test_what_is_kept_is_legal_from_the_first_action_on() -> None:
    rng = np.random.default_rng(4)
    problems = random_problems(17, often(60))
    for problem, rollout in zip(problems, roll(problems, 5).rollouts, strict=True):
        instance = pack([problem])
        for _ in range(5):
            kept = part_to_keep(instance, np.array(rollout.actions), MOST_ANEW, rng)
            state = reset(instance, np.zeros(1, np.int64))
            for action in kept.tolist():
                assert action in legal(problem, instance, state)
                apply(instance, state, 0, action)


@pytest.mark.parametrize("most", [MOST_ANEW, MOST_ANEW_GREEDILY])
def test_the_share_planned_anew_is_as_drawn(most: float) -> None:
    problem = max(random_problems(23, 40), key=lambda problem: problem.num_customers)
    actions = np.array(roll([problem], 2).rollouts[0].actions)
    rng = np.random.default_rng(0)
    kept = [part_to_keep(pack([problem]), actions, most, rng) for _ in range(500)]
    shares = [1 - services(part) / services(actions) for part in kept]
    slack = 2 / services(actions)
    assert LEAST_ANEW - slack <= min(shares) < LEAST_ANEW + 0.1
    assert most - 0.1 < max(shares) <= most + slack


def test_vehicles_planned_anew_are_the_nearest_to_a_customer() -> None:
    problem = max(random_problems(31, 40), key=lambda problem: problem.num_customers)
    actions = np.array(roll([problem], 3).rollouts[0].actions)
    vehicle = np.cumsum(actions % NUM_KINDS == OPEN)
    nodes = {v: {node_of(action) for action in actions[vehicle == v] if is_service(action)}
             for v in set(vehicle.tolist())}
    drive = problem.travel[0].duration
    rng = np.random.default_rng(1)
    for _ in range(50):
        kept = {node_of(action) for action in part_to_keep(pack([problem]), actions, MOST_ANEW, rng)
                if is_service(action)}
        whole = [mine for mine in nodes.values() if mine <= kept]
        anew = [mine for mine in nodes.values() if not mine <= kept]
        assert 0 < len(whole) < len(nodes)
        assert any(max(nearest(drive, seed, mine) for mine in anew)
                   <= min(nearest(drive, seed, mine) for mine in whole)
                   for seed in set().union(*anew))


def test_nothing_of_an_empty_plan_is_kept() -> None:
    problem, = random_problems(1, 1)
    nothing = np.zeros(0, np.int64)
    assert len(part_to_keep(pack([problem]), nothing, MOST_ANEW, np.random.default_rng(0))) == 0
