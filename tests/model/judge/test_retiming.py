"""Routes without times, timed by the judge."""

import numpy as np
import pytest

from tests.model.search.break_days import judged_working, least_working, orders, small_day


@pytest.mark.parametrize(("seed", "is_soft"), [
    *((seed, False) for seed in (2, 4, 6, 7, 9, 21, 29, 35, 112)),
    *((seed, True) for seed in (48, 58, 151))])
def test_breaks_and_begin_of_an_order_are_the_best_of_all(seed: int, is_soft: bool) -> None:
    problem = small_day(np.random.default_rng(seed), is_soft)
    for order in filter(None, orders(problem)):
        assert judged_working(problem, order) == pytest.approx(least_working(problem, order))
