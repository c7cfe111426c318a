from dataclasses import replace

import pytest

from model.problem import MAX_QUANTITY, UNLIMITED, DroneType, DrivingRules, Overtime, VehicleType
from model.problem.limits import LIMITS, limits_of

VAN = VehicleType(
    "van", 2, (5000,), 0, latest=9, max_working_duration=8, max_trip_distance=7,
    max_distance=11, max_travel_duration=6, max_stops=5, max_sorties=4, overtime=Overtime(1.0, 3),
    driving=DrivingRules(10, 1, max_driving_per_day=20, max_work=15))


def test_limits_of_a_vehicle_are_those_that_it_states():
    stated = {name: value for name, _, value in limits_of(VAN, "vehicle_type", "flyer")}
    assert stated == {"shift": 9, "work": 8, "trip_distance": 7, "distance": 11, "travel": 6,
                      "stops": 5, "sorties": 4, "overtime": 3, "driving": 10, "driving_day": 20,
                      "work_spell": 15}
    assert [*limits_of(VehicleType("van", 1, (1,), 0), "vehicle_type", "flyer")] == []


@pytest.mark.parametrize("name", [name for name, _, _ in limits_of(VAN, "vehicle_type")])
def test_raised_limits_are_others_alone(name):
    limit = LIMITS[name]
    raised = limit.raised(VAN, limit.step.size)
    assert limit.of(raised) == (limit.of(VAN) or 0) + limit.step.size
    others = {other: value for other, _, value in limits_of(raised, "vehicle_type")
              if other != name}
    assert others == {other: value for other, _, value in limits_of(VAN, "vehicle_type")
                      if other != name}


def test_no_limit_is_raised_to_more_than_a_problem_may_state():
    far = replace(VAN, max_working_duration=MAX_QUANTITY, latest=UNLIMITED - 1)
    assert LIMITS["work"].raised(far, 60_000) == far
    assert LIMITS["shift"].raised(far, 60_000).latest == UNLIMITED


def test_drones_have_limits_of_their_own():
    drones = DroneType(1, (1000,), 0, endurance=30, max_range=40, batteries=3)
    assert {name: value for name, _, value in limits_of(drones, "flyer", "drones")} == {
        "endurance": 30, "range": 40, "batteries_aboard": 3}
