"""Code that was compiled for problems which state no rarer rule."""

from collections.abc import Callable

import numpy as np
import pytest

from model.kernel.instance import pack
from model.kernel.plain import is_plain
from model.problem import Problem
from model.search import world as worlds
from model.search.improve import SearchConfig, improve
from model.search.world import make_world
from model.solution import Solution
from tests.model.tiny import (
    draw_tiny, with_beginnings, with_charging, with_dimensions, with_drone_types, with_duty,
    with_energy, with_gaps, with_goods, with_limits_aboard, with_open_ends, with_own_costs,
    with_own_durations, with_pickups, with_places, with_reloads, with_setups, with_table,
    with_turnaround,
)
from training.instances import VALIDATED, generate

Rule = Callable[[np.random.Generator, Problem], Problem]

SEEDS, TURNS = 12, 60


def unchanged(_: np.random.Generator, problem: Problem) -> Problem:
    """Return a problem as it is."""
    return problem


def says_plain(problem: Problem) -> bool:
    """Tell whether the search takes the code for plain problems."""
    world = make_world(problem, pack([problem]))
    assert is_plain(world.type[0]) == is_plain(world.place[0, 0, 0])
    return is_plain(world.type[0])


def plan(problem: Problem) -> Solution:
    """Return a plan after some turns."""
    return improve(problem, pack([problem]), Solution((), ()),
                   SearchConfig(turns=TURNS)).solution


@pytest.mark.parametrize("variant", VALIDATED)
def test_problems_of_the_first_classes_are_plain(variant: str) -> None:
    assert says_plain(generate(np.random.default_rng(0), 12, variant))


@pytest.mark.parametrize("rule", [
    unchanged, with_beginnings, with_charging, with_dimensions, with_drone_types, with_duty,
    with_energy, with_gaps, with_goods, with_limits_aboard, with_open_ends, with_own_costs,
    with_own_durations, with_pickups, with_places, with_reloads, with_setups, with_table,
    with_turnaround,
])
def test_plans_are_the_same_by_either_code(rule: Rule, monkeypatch: pytest.MonkeyPatch) -> None:
    plain = 0
    for seed in range(SEEDS):
        rng = np.random.default_rng(seed)
        problem = rule(rng, draw_tiny(rng))
        found = plan(problem)
        plain += says_plain(problem)
        with monkeypatch.context() as patch:
            patch.setattr(worlds, "_is_plain", lambda *_: False)
            assert not says_plain(problem)
            assert plan(problem) == found
    if rule is unchanged:
        assert plain == SEEDS
