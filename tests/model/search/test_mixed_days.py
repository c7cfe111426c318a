"""Rules of a working day mixed: rollouts keep them, and the search finds the cheapest plan.

The count of two thousand is `python -m tests.model.search.many_days`.
"""

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.policy.extract import extract
from tests.model.rollouts import roll
from tests.model.search.many_days import Day, day_of, told
from tests.model.search.mixed_days import mixed_day
from tests.seeds import seeds

pytestmark = pytest.mark.slow


def test_rollouts_keep_rules_that_mix() -> None:
    for seed in seeds(100):
        problem = mixed_day(np.random.default_rng(seed))
        plan = extract(problem, pack([problem]), roll([problem], seed).rollouts[0].actions)
        assert check(problem, plan).violations == (), seed


def test_search_finds_the_cheapest_plan_where_rules_mix() -> None:
    days = [day_of(seed, patience=0) for seed in range(6)]
    assert [day.seed for day in days if day.broken or day.gap > 1e-9] == []


def test_what_was_missed_is_told() -> None:
    days = [Day(1, ("breaks",), 10.0, 11.0), Day(2, ()), Day(3, (), 5.0, 5.0)]
    assert told(days).startswith("2 days enumerated, 1 took too long; 1 missed, by 10.00%")
