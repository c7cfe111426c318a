"""A judge that remembers says what one says who doesn't."""

from copy import deepcopy
from dataclasses import replace

import pytest

from model.judge import memory
from model.judge.check import check
from model.judge.memory import Memory
from model.engine.instance import pack
from model.policy.extract import extract
from model.solution import Route
from tests.model.rollouts import random_problems, roll


def later(route: Route) -> Route:
    """Return a route whose first stop is left a millisecond later than it can be."""
    trip = route.trips[0]
    first = replace(trip.stops[0], departure=trip.stops[0].departure + 1)
    return replace(route, trips=(replace(trip, stops=(first, *trip.stops[1:])), *route.trips[1:]))


def test_whatever_was_judged_before_the_verdict_is_the_same() -> None:
    problems = random_problems(3, 24, 12)
    batch = roll(problems, 0)
    for row, problem in enumerate(problems):
        plan = extract(problem, pack([problem]), batch.rollouts[row].actions)
        broken = replace(plan, routes=tuple(map(later, plan.routes)))
        turned = replace(plan, routes=plan.routes[::-1])
        half = replace(plan, routes=(*plan.routes[1:], *map(later, plan.routes[:1])))
        judge = Memory(problem)
        for other in (plan, broken, turned, half, plan, broken):
            assert judge.check(other) == check(problem, other)


def test_no_route_is_judged_again_that_stayed_as_it_was(monkeypatch: pytest.MonkeyPatch) -> None:
    problem, = random_problems(3, 1, 12)
    plan = extract(problem, pack([problem]), roll([problem], 0).rollouts[0].actions)
    judge = Memory(problem)
    first = judge.check(plan)
    monkeypatch.setattr(memory, "judge_route", None)
    assert judge.check(deepcopy(plan)) == first
