"""Routes without times are driven with breaks and rests as the search places them."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import judge_route
from model.judge.past import Past
from model.judge.retiming import read_route, time_route
from model.problem import Problem
from model.search.driven import driven_by_search
from model.search.improve import SearchConfig, improve
from model.solution import Solution
from tests.model.tiny import draw_tiny
from tests.model.tiny_breaks import with_breaks
from tests.model.tiny_driving import with_driving
from tests.seeds import often

pytestmark = pytest.mark.thorough


def drawn(seed: int) -> Problem:
    rng = np.random.default_rng(seed)
    return with_driving(rng, with_breaks(rng, draw_tiny(rng)))


def test_routes_that_can_be_driven_are_without_their_times() -> None:
    mended = 0
    for seed in range(often(60)):
        problem = drawn(seed)
        plan = improve(problem, pack([problem]), Solution((), problem.left_out(())),
                       SearchConfig(seed, turns=20)).solution
        for route in plan.routes:
            stated = read_route(problem, route)
            bare = replace(stated, trips=tuple([
                replace(trip, operations=None, start=None, breaks=()) for trip in stated.trips]))
            timed = time_route(problem, bare, "", Past())
            if timed.judged.violations:
                driven = driven_by_search(problem, timed.route)
                assert driven is not None
                assert judge_route(problem, driven, "").violations == []
                mended += 1
    assert mended >= often(3)
