"""Who is left out for the wind is told how strong it is, and when, over HTTP."""

from typing import Any

import httpx
import pytest
from tests.app.plans.asking import planned

Request = dict[str, Any]

HOUR = 3600
BLOWN = [{"from": 0, "speed_kmh": 10}, {"from": HOUR, "speed_kmh": 20, "gust_kmh": 55},
         {"from": 2 * HOUR, "speed_kmh": 10}]


def windy(request: Request, **kind: Any) -> Request:
    """Return a request for one customer whose window lies in an hour of strong gusts."""
    request["customers"] = [request["customers"][1] | {
        "served_by": "drone", "time_window": {"earliest": HOUR + 600, "latest": HOUR + 1200}}]
    request["airspace"] = {"wind": BLOWN}
    request["fleet"][0] |= kind
    return request


def storm(**changed: Any) -> Request:
    return {"vehicle_type": "truck", "drone_type": None, "max_wind_kmh": 40, "strongest_kmh": 55,
            "begin": HOUR, "end": 2 * HOUR} | changed


def test_who_can_not_be_flown_to_for_the_wind_is_told_when_it_blows(
        client: httpx.Client, smallest: Request) -> None:
    request = windy(smallest, drones={"count": 1, "capacity": [10], "max_wind_kmh": 40})
    plan = planned(client, request)
    reason, = plan["unassigned"][0]["reasons"]
    assert reason["message"].endswith(". It blows up to 55 km/h from 3600 s until 7200 s.")
    assert reason["wind"] == [storm()]
    why = client.post("/explain", json={"problem": request, "plan": plan,
                                        "customer": request["customers"][0]["id"]}).json()
    assert why["wind"] == why["reasons"][0]["wind"] == [storm()]


def test_who_is_never_flown_to_for_the_wind_is_told_how_strong_it_is(
        client: httpx.Client, smallest: Request) -> None:
    request = windy(smallest, drones={"count": 1, "capacity": [10], "max_wind_kmh": 40})
    request["airspace"] = {"wind": {"speed_kmh": 45}}
    reason, = planned(client, request)["unassigned"][0]["reasons"]
    assert reason["code"] == "WIND"
    assert reason["message"] == ("The wind is too strong for a flight there and back, by "
                                 "max_wind_kmh. It blows up to 45 km/h from 0 s.")
    assert reason["wind"] == [storm(strongest_kmh=45, begin=0, end=None)]


def test_it_is_told_in_times_of_the_day(client: httpx.Client, smallest: Request) -> None:
    request = windy(smallest, drones={"count": 1, "capacity": [10], "max_wind_kmh": 40})
    request |= {"plan_start": "2026-06-01T08:00:00+02:00"}
    request["options"] = {"times": "clock"}
    reason, = planned(client, request)["unassigned"][0]["reasons"]
    assert "up to 55 km/h from 09:00:00 until 10:00:00" in reason["message"]
    assert reason["wind"][0]["begin"] == "09:00:00"


@pytest.mark.parametrize(("changed", "code"), [
    ({}, "TIME_WINDOW"), ({"shift": {"latest": 2 * HOUR + 60}}, "SHIFT")])
def test_whom_vehicles_that_fly_come_too_late_to_for_the_wind_is_told_when_it_blows(
        client: httpx.Client, smallest: Request, changed: Request, code: str) -> None:
    request = windy(smallest, flies=True, max_wind_kmh=40, **changed)
    if changed:
        request["customers"][0]["time_window"]["latest"] = 3 * HOUR
    reason, = planned(client, request)["unassigned"][0]["reasons"]
    assert (reason["code"], reason["wind"]) == (code, [storm()])
    assert reason["message"].endswith(". It blows up to 55 km/h from 3600 s until 7200 s.")


def test_other_reasons_are_told_as_ever(client: httpx.Client, smallest: Request) -> None:
    request = windy(smallest, drones={"count": 1, "capacity": [0], "max_wind_kmh": 40})
    reason, = planned(client, request)["unassigned"][0]["reasons"]
    assert "wind" not in reason
