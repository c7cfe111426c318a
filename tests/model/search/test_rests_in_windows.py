"""Those who may not work for long without a rest begin late where customers have two windows."""

from dataclasses import replace

import numpy as np
import pytest

from model.engine.instance import pack
from model.judge.check import check
from model.problem import (
    UNLIMITED, Break, Customer, Depot, DrivingRules, Problem, Travel, VehicleType,
)
from model.search.improve import SearchConfig, improve
from model.solution import Route, Solution, Stop, Trip
from tests.model.tiny_breaks import short_day
from tests.seeds import often

MINUTE = 60_000


def test_driver_begins_late_rather_than_rest_where_no_time_is_paid() -> None:
    """Served in the second window, the first customer is no more than 45 minutes from the end.

    A search that let it begin sooner, and still have no rest, would break the rule.
    """
    legs = np.array([[0, 48, 71], [48, 0, 90], [71, 90, 0]]) * 1000
    first = Customer("first", (1,), earliest=628_000, latest=4_828_000,
                     gaps=((2_428_000, 3_028_000),))
    second = Customer("second", (1,), earliest=6_524_000, latest=6_824_000)
    driver = VehicleType("van", 1, (2,), 0, latest=12_000_000, cost_per_km=1.0,
                         driving=DrivingRules(UNLIMITED, 900_000, max_work=2_700_000))
    problem = Problem((Depot("hub"),), (first, second), (driver,), (Travel(legs, legs),),
                      np.zeros((3, 2)), unassigned_cost=100.0)
    for seed in range(5):
        plan = improve(problem, pack([problem]), Solution((), (1, 2)),
                       SearchConfig(seed, turns=300)).solution
        assert check(problem, plan).violations == ()
        assert plan.unassigned == ()
        trip, = plan.routes[0].trips
        assert trip.breaks == ()
        assert trip.stops[0].departure == 4_780_000


def drawn(rng: np.random.Generator) -> Problem:
    """Draw customers with one or two windows, and a driver who may not work for long."""
    def resting(truck: VehicleType) -> VehicleType:
        rest, work = (int(rng.integers(*some)) * MINUTE for some in ((5, 16), (20, 50)))
        return replace(truck, latest=400 * MINUTE, cost_per_hour=30.0 * int(rng.integers(2)),
                       driving=DrivingRules(UNLIMITED, rest, max_work=work))

    def several(customer: Customer) -> Customer:
        opens, *lengths = (int(rng.integers(1, most)) * MINUTE for most in (40, 30, 30, 50))
        closes, again = opens + lengths[0], opens + lengths[0] + lengths[1]
        if rng.random() < 0.4:
            return replace(customer, earliest=opens + 60 * MINUTE, latest=closes + 60 * MINUTE)
        return replace(customer, earliest=opens, latest=again + lengths[2],
                       gaps=((closes, again),))

    problem = short_day(rng, resting)
    return replace(problem, customers=tuple(map(several, problem.customers)))


@pytest.mark.parametrize("first", [0, 20, 40][:often(3)])
def test_no_search_breaks_rules_where_customers_have_two_windows(first: int) -> None:
    for seed in range(first, first + 20):
        problem = drawn(np.random.default_rng(seed))
        plan = improve(problem, pack([problem]), Solution((), (1, 2)),
                       SearchConfig(turns=60)).solution
        assert check(problem, plan).violations == (), seed


def test_eight_breaks_and_rests_are_placed_best_where_customers_are_waited_for() -> None:
    """All ways to take breaks on a leg once filled the room that there is for rests.

    Customers four minutes apart open every twenty minutes; who waits for them rests meanwhile.
    """
    places = np.arange(21) * 4 * MINUTE
    legs = np.abs(places[:, None] - places)
    breaks = tuple(Break(str(number), 5 * MINUTE, 30 * (number + 1) * MINUTE,
                         (30 * number + 70) * MINUTE, after_departure=True, anywhere=True,
                         paid=number % 2 == 1) for number in range(8))
    rules = DrivingRules(270 * MINUTE, 45 * MINUTE, (15 * MINUTE, 30 * MINUTE),
                         max_work=360 * MINUTE)
    van = VehicleType("van", 1, (20,), 0, latest=1440 * MINUTE, cost_per_km=1.0, cost_per_hour=1.0,
                      breaks=breaks, driving=rules)
    customers = tuple(Customer(str(number), (1,), MINUTE, 20 * number * MINUTE)
                      for number in range(20))
    problem = Problem((Depot("hub"),), customers, (van,), (Travel(legs, legs),),
                      np.zeros((21, 2)), unassigned_cost=1000.0)
    given = Trip(tuple(Stop(node, 0, 0, 0) for node in (*range(21), 0)))
    found = improve(problem, pack([problem]), Solution((Route(0, 0, (given,)),), ()),
                    SearchConfig(turns=0))
    assert check(problem, found.solution).violations == ()
    assert found.cost == pytest.approx(14.7, abs=1e-9)
