"""Random plans' flights are flown as planned, whatever file tells them, as others read it.

The study of two hundred plans is `python -m benchmarks.fuzz.flights`.
"""

import copy
import json
import random
from pathlib import Path
from typing import Any

import httpx
import pytest
from shapely import Polygon

from benchmarks.fuzz.flight_readers import (
    READERS, Read, Step, read_geojson, read_plans,
)
from benchmarks.fuzz.flights import FlightStudy, Planned, random_city
from benchmarks.fuzz.problems import Fault
from tests.conftest import eventually

pytestmark = pytest.mark.slow

Data = dict[str, Any]

CITIES = 30

EXAMPLE = Path(__file__).parents[3] / "app" / "schemas" / "examples" / "flights.json"


@pytest.fixture(scope="module")
def study(client: httpx.Client) -> FlightStudy:
    """Return the study of some cities."""
    study = FlightStudy(client)
    for seed in range(CITIES):
        study.try_city(seed)
    return study


def test_flights_are_read_back_as_planned(study: FlightStudy) -> None:
    assert set(study.read) == set(READERS)
    assert len(set(study.read.values())) == 1
    assert min(study.read.values()) > CITIES
    assert study.bent > 50


def test_flights_of_a_job_are_those_of_its_plan(client: httpx.Client) -> None:
    problem = json.loads(EXAMPLE.read_text("utf-8"))["problem"] | {
        "options": {"search_iterations": 500, "time_limit": 60}}
    job = client.post("/jobs", json=problem).json()["id"]
    done = eventually(lambda: (read := client.get(f"/jobs/{job}").json())["finished_at"] and read)
    assert done["state"] == "done", done
    flown = client.get(f"/jobs/{job}/flights", params={"format": "qgc-wpl", "per": "vehicle"})
    asked = client.post("/flights", json={
        "problem": problem, "plan": done["result"], "format": "qgc-wpl", "per": "vehicle"})
    assert (flown.status_code, flown.headers["content-type"]) == (200, "application/zip")
    assert flown.headers["content-disposition"] == asked.headers["content-disposition"]
    assert flown.content == asked.content


HUB, DOOR, AROUND = (0.0, 0.0), (0.01, 0.0), (0.005, 0.003)
PLANNED = Planned(
    0.0, 320.0, [HUB, DOOR, HUB], [60.0], 0.0, lands=True,
    recovery_begins=300.0,
    zones=[Polygon([(0.004, -0.001), (0.006, -0.001), (0.006, 0.001), (0.004, 0.001)])])
SPEED = 10.77
"""At which the way around takes 120 s."""


def flown(*places: tuple[float, float], **changes: Any) -> Read:
    """Return a flight over some places that lands at a door for a minute, and at the hub."""
    steps = [Step(place, SPEED, 60.0 if place == DOOR else 0.0) for place in places]
    return Read(**{"steps": steps, "landings": [DOOR, HUB], "heights": {100.0}} | changes)


def test_flight_as_planned_is_no_fault() -> None:
    PLANNED.hold_to(flown(HUB, AROUND, DOOR, AROUND, HUB))


@pytest.mark.parametrize(("flight", "fault"), [
    (flown(HUB, DOOR, AROUND, HUB), "through a zone"),
    (flown(HUB, AROUND, HUB), "leaves out"),
    (flown(HUB, AROUND, DOOR, AROUND), "leaves out"),
    (flown(HUB, AROUND, DOOR, AROUND, HUB, landings=[HUB]), "lands at"),
    (flown(HUB, AROUND, DOOR, AROUND, HUB, heights={50.0}), "heights"),
    (flown(HUB, AROUND, DOOR, AROUND, DOOR, AROUND, HUB), "takes"),
    (flown(HUB, AROUND, DOOR, AROUND, HUB, launch_time=0.0, recovery_time=300.0), "not"),
])
def test_other_flights_are_faults(flight: Read, fault: str) -> None:
    with pytest.raises(Fault, match=fault):
        PLANNED.hold_to(flight)


def mission(client: httpx.Client) -> Data:
    body = json.loads(EXAMPLE.read_text("utf-8"))
    reply = client.post("/flights", json=body)
    assert reply.status_code == 200
    plan: Data = reply.json()
    return plan


@pytest.mark.parametrize("change", [
    lambda plan: plan.pop("mission"),
    lambda plan: plan["mission"]["items"][0].pop("doJumpId"),
    lambda plan: plan["mission"]["items"][0].update(params=[0, 0]),
    lambda plan: plan["mission"]["items"][0].update(frame=0),
    lambda plan: plan["mission"]["items"][2].update(command=20),
    lambda plan: plan["geoFence"]["polygons"][0].update(polygon=[[1, 2]]),
])
def test_plans_that_are_none_are_not_read(client: httpx.Client, change: Any) -> None:
    plan = mission(client)
    flights, fences = read_plans({"a.plan": json.dumps(plan).encode()})
    assert (len(flights), len(fences)) == (1, 1)
    broken = copy.deepcopy(plan)
    change(broken)
    with pytest.raises(ValueError, match=r"."):
        read_plans({"a.plan": json.dumps(broken).encode()})


def test_lines_are_read_with_where_they_land() -> None:
    line = [[0, 0, 0], [0, 0, 9], [1, 0, 9], [1, 0, 0], [1, 0, 0], [1, 0, 9], [2, 0, 9], [2, 0, 0]]
    features = [{"geometry": {"type": "LineString", "coordinates": line},
                 "properties": {"launch_time": 1, "recovery_time": 2}}]
    (flight,), fences = read_geojson({"a": json.dumps({"features": features}).encode()})
    assert (flight.landings, flight.heights, fences) == ([(1, 0), (2, 0)], {9}, [])
    assert flight.way == [(0, 0), (1, 0), (2, 0)]


def test_cities_have_what_flights_meet() -> None:
    cities = [random_city(random.Random(seed)) for seed in range(CITIES)]
    for areas in ("no_fly", "zones"):
        assert 0 < sum(bool(city["airspace"][areas]) for city in cities) < CITIES
    assert 0 < sum(len(city["fleet"]) - 1 for city in cities) < CITIES
    assert 0 < sum("energy" in city["fleet"][0]["drones"] for city in cities) < CITIES
