"""A vehicle drives so far and no farther on all its trips together, whatever is asked of it."""

from typing import Any

import httpx
import pytest

from examples.remedy import applied
from tests.app.plans.asking import planned

Request = dict[str, Any]


@pytest.fixture
def two_trips(smallest: Request) -> Request:
    """Return two customers 1 km away, of whom a van has room for one at a time."""
    smallest["customers"] = [{"id": name, "location": [0, 1], "demand": [1]} for name in "AB"]
    smallest["fleet"][0] |= {"id": "van", "count": 1, "capacity": [1], "max_trips": 2,
                             "speed_kmh": 60, "max_distance": 4000, "max_trip_distance": 2500}
    smallest["options"] = {"search_iterations": 100, "time_limit": 60}
    return smallest


def test_all_trips_together_are_no_longer(service: httpx.Client, two_trips: Request) -> None:
    plan = planned(service, two_trips)
    assert plan["status"] == "complete"
    two_trips["fleet"][0]["max_distance"] = 3999
    assert len(planned(service, two_trips)["unassigned"]) == 1
    reply = service.post("/check", json={"problem": two_trips, "plan": plan}).json()
    assert [each["code"] for each in reply["violations"]] == ["DISTANCE"]


def test_what_the_remedy_changes_has_all_served(service: httpx.Client, two_trips: Request) -> None:
    two_trips["fleet"][0]["max_distance"] = 1500
    for left in planned(service, two_trips)["unassigned"]:
        reason, = left["reasons"]
        assert (reason["code"], reason["remedy"]) == (
            "DISTANCE", "fits if van could drive 0.5 km farther")
    changed = applied(two_trips, reason["changes"])
    assert changed["fleet"][0]["max_distance"] == 2000
    assert len(planned(service, changed)["unassigned"]) == 1


def test_a_day_goes_on_with_what_is_left_of_it(service: httpx.Client, two_trips: Request) -> None:
    plan = planned(service, two_trips)
    new = {"id": "C", "location": [0, 1], "demand": [1]}
    two_trips["fleet"][0] |= {"max_trips": 3, "max_distance": 5999}
    two_trips["customers"].append(new)
    two_trips["replan"] = {"plan": plan, "freeze_before": 210}
    left, = planned(service, two_trips)["unassigned"]
    assert left["id"] == "C"
    two_trips["fleet"][0]["max_distance"] = 6000
    assert planned(service, two_trips)["status"] == "complete"
