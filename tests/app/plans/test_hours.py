"""Depots that open and close."""

from typing import Any

import httpx
import pytest

from tests.app.plans.test_routes import errors_of

Request = dict[str, Any]


@pytest.mark.parametrize(("hours", "more", "code"), [
    ({"latest": 600}, {"shift": {"earliest": 900}}, "DEPOT_CLOSED"),
    ({"earliest": 600}, {"shift": {"latest": 300}, "overtime": {"cost_per_hour": 1}},
     "DEPOT_CLOSED"),
    ({"latest": 600}, {"end": {"location": [9, 9]}, "max_trips": 2}, "HOURS_DIFFER"),
    ({"earliest": 600}, {"start_location": [9, 9]}, "HOURS_DIFFER"),
    ({"latest": 600}, {"overtime": {"cost_per_hour": 1}, "max_working_duration": 60,
                       "shift": {"latest": 300}}, "HOURS_AND_OVERTIME"),
])
def test_hours_that_leave_no_day_are_refused(client: httpx.Client, smallest: Request, hours: Any,
                                             more: Any, code: str) -> None:
    smallest["depots"][0]["time_window"] = hours
    smallest["fleet"][0] |= more
    assert [code for code, _ in errors_of(client, smallest)] == [code]


def test_depots_that_close_say_so(client: httpx.Client, smallest: Request) -> None:
    smallest["fleet"][0] |= {"speed_kmh": 36, "count": 1, "max_trips": 9}
    smallest["customers"] = [{"id": "far", "location": [6000, 0], "demand": [1]},
                             {"id": "near", "location": [1000, 0], "demand": [1]}]
    smallest["planar_unit"], smallest["depots"][0]["location"] = 1, [0, 0]
    smallest["depots"][0]["time_window"] = {"earliest": 100, "latest": 400}
    reply = client.post("/plan", json=smallest).json()
    (trip,) = reply["routes"][0]["trips"]
    assert trip["stops"][0]["departure"] >= 100
    (left_out,) = reply["unassigned"]
    depot = smallest["depots"][0]["id"]
    (reason,) = left_out["reasons"]
    assert reason["remedy"] == f"fits if {depot} closed 15 minutes later"
