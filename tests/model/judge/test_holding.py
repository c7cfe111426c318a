"""How late a trip begins that would last too long."""

import numpy as np

from model.judge.check import check
from model.judge.flown_trips import excess_in_air
from model.judge.holding import held
from model.judge.timing import TripDecision, schedule_trip
from model.problem import UNLIMITED, Customer, Depot, Energy, Problem, Travel, VehicleType
from model.solution import Route, Solution, Trip

HOUR = 3_600_000


def test_a_trip_is_held_in_few_steps_though_each_helps_a_little() -> None:
    """The drone hovers for a window with little aboard, and could hover with a lot."""
    heavy = Customer("heavy", (1000,), latest=UNLIMITED)
    late = Customer("late", (0,), earliest=2000 * HOUR, latest=UNLIMITED)
    energy = Energy(HOUR * 1000, 1.0, (0, 1000), (1, 1), (1000, 5_000_000), (0, 0), (0, 0),
                    lands=False)
    kind = VehicleType("drone", 1, (1000,), 0, cost_per_km=1.0, flies=True, energy=energy)
    legs = np.array([[0, 1, 1], [1, 0, 1], [1, 1, 0]]) * 60_000
    problem = Problem((Depot("hub"),), (heavy, late), (kind,), (Travel(legs, legs),),
                      np.zeros((3, 2)), 1000.0)
    tried = list[Trip]()

    def begun_at(start: int) -> Trip:
        tried.append(schedule_trip(problem, kind, TripDecision((0, 1, 2, 0), start=start), 0))
        return tried[-1]

    trip, helps = held(problem, kind, begun_at(0), begun_at,
                       lambda timed: excess_in_air(problem, kind, timed))
    assert helps
    assert len(tried) < 20
    plan = Solution((Route(0, 0, (trip,)),))
    assert check(problem, plan).violations == ()
    assert schedule_trip(problem, kind, TripDecision((0, 1, 2, 0)), 0) == trip
