"""Routes without times, timed by the judge."""

from dataclasses import replace

import numpy as np
import pytest

from model.judge.past import EVERYTHING_OPEN
from model.judge.retiming import time_route
from model.judge.timing import RouteDecision, TripDecision
from tests.model.search.break_days import judged_working, least_working, orders, small_day


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize(("seed", "is_soft"), [
    *((seed, False) for seed in (2, 4, 6, 7, 9, 21, 29, 35, 112)),
    *((seed, True) for seed in (48, 58, 151))])
def test_breaks_and_begin_of_an_order_are_the_best_of_all(seed: int, is_soft: bool) -> None:
    problem = small_day(np.random.default_rng(seed), is_soft)
    for order in filter(None, orders(problem)):
        assert judged_working(problem, order) == pytest.approx(least_working(problem, order))


def test_no_break_of_a_second_trip_lies_where_somebody_is_served_too_late_behind_another() -> None:
    problem = small_day(np.random.default_rng(1))
    truck, = problem.vehicle_types
    timed = time_route(
        replace(problem, vehicle_types=(replace(truck, max_trips=2),)),
        RouteDecision(0, 0, (TripDecision((0, 3, 0)), TripDecision((0, 1, 2, 0)))), "route",
        EVERYTHING_OPEN)
    assert timed.judged.violations == []
    assert sum(len(trip.breaks) for trip in timed.route.trips) == 1
