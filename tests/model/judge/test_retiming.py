"""Routes without times, timed by the judge."""

import numpy as np
import pytest

from model.judge.past import Past
from model.judge.retiming import time_route
from model.judge.timing import RouteDecision, TripDecision
from tests.model.search.break_days import small_day


@pytest.mark.parametrize(("seed", "order", "working"), [
    (4, (1, 2, 3), 0.0), (19, (1,), 4.5), (19, (2, 1), 5.0), (34, (1, 2, 3, 4), 14.5)])
def test_breaks_lie_by_when_a_route_had_better_begin(seed: int, order: tuple[int, ...],
                                                     working: float) -> None:
    """As cheaply as enumeration finds; begun at once, it would break a rule, or wait for longer."""
    problem = small_day(np.random.default_rng(seed))
    timed = time_route(problem, RouteDecision(0, 0, (TripDecision((0, *order, 0)),)), "route",
                       Past())
    assert not timed.judged.violations
    assert timed.judged.cost.time == pytest.approx(working)
