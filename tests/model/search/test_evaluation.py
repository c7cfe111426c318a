"""How routes are timed and priced is what the page on the search says, rule by rule."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from model.kernel.instance import pack
from model.problem import (
    FULL_SPEED, MS_PER_HOUR, DroneType, Energy, Overtime, Problem, SpeedProfile, VehicleType,
)
from model.search.problem_data import make_data
from tests.model.search.pages import table
from training.instances import generate

HOUR = MS_PER_HOUR
ASPECTS = ("timed", "priced", "held back", "retimed", "by detour")
BATTERY = Energy(10**9, 1.0, (0, 1000), *((1000, 2000),) * 4, charge=500)
DRONES = DroneType(count=2, capacity=(10**6,), travel=0)


def with_customers(**stated: object) -> Callable[[Problem], Problem]:
    """Return what lets the first customer state something."""
    return lambda problem: replace(problem, customers=(
        replace(problem.customers[0], **stated), *problem.customers[1:]))


def with_vehicles(**stated: object) -> Callable[[Problem], Problem]:
    """Return what lets all vehicles state something."""
    return lambda problem: replace(problem, vehicle_types=tuple(
        replace(kind, **stated) for kind in problem.vehicle_types))


RULES = {
    "nothing": with_vehicles(),
    "working time costs": with_vehicles(cost_per_hour=1.0),
    "overtime costs": with_vehicles(latest=8 * HOUR, overtime=Overtime(1.0)),
    "working time is limited": with_vehicles(max_working_duration=8 * HOUR),
    "trips are several": with_vehicles(max_trips=2),
    "parcels come later": with_customers(release_time=HOUR),
    "trucks have drones": with_vehicles(drones=DRONES),
    "lateness costs": with_customers(latest=HOUR, late_cost_per_hour=1.0),
    "waiting costs": with_customers(earliest=HOUR, early_cost_per_hour=1.0),
    "speed changes": with_vehicles(
        speed_profile=SpeedProfile((HOUR,), (FULL_SPEED, FULL_SPEED // 2))),
    "drones are charged aboard": with_vehicles(drones=replace(DRONES, energy=BATTERY)),
    "windows are several": with_customers(gaps=((HOUR, 2 * HOUR),)),
    "time aboard is limited": with_customers(max_time_aboard=HOUR),
    "what is aboard costs": with_vehicles(cost_per_load_km=1.0),
}


def plain() -> Problem:
    """Return a problem of hard windows, loads and distance alone."""
    problem = generate(np.random.default_rng(0), 5, "cvrp")
    truck = problem.vehicle_types[0]
    kind = VehicleType(truck.id, truck.count, truck.capacity, truck.travel, cost_per_km=1.0)
    windowed = replace(problem.customers[1], latest=6 * HOUR)
    return replace(problem, vehicle_types=(kind,),
                   customers=(problem.customers[0], windowed, *problem.customers[2:]))


@pytest.mark.parametrize(("stated", "told"), table("timed").items())
def test_routes_are_evaluated_as_the_page_says(stated: str, told: dict[str, str]) -> None:
    problem = plain()
    for rule in stated.split(", "):
        problem = RULES[rule](problem)
    evaluation = make_data(problem, pack([problem])).evaluation[0]
    assert {name: "yes" if evaluation[name.replace(" ", "_")] else "" for name in ASPECTS} == told


def test_the_page_has_each_rule_and_aspect() -> None:
    rows = table("timed")
    assert {rule for stated in rows for rule in stated.split(", ")} == set(RULES)
    assert tuple(rows["nothing"]) == ASPECTS
