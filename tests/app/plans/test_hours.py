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
    ({"latest": 600}, {"end": "open", "shift": {"earliest": 900}}, "DEPOT_CLOSED"),
])
def test_hours_that_leave_no_day_are_refused(client: httpx.Client, smallest: Request, hours: Any,
                                             more: Any, code: str) -> None:
    smallest["depots"][0]["time_window"] = hours
    smallest["fleet"][0] |= more
    assert [code for code, _ in errors_of(client, smallest)] == [code]


def test_a_depot_that_is_wrong_makes_no_other_the_home(client: httpx.Client,
                                                       smallest: Request) -> None:
    home, = smallest["depots"]
    smallest["depots"] = [home | {"chargers": -1}, {
        "id": "other", "location": [1, 1], "time_window": {"earliest": 900}}]
    smallest["fleet"][0]["shift"] = {"latest": 600}
    errors = client.post("/plan", json=smallest).json()["errors"]
    assert [error["code"] for error in errors] == ["OUT_OF_RANGE"]


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


def test_who_comes_back_before_the_depot_opens_waits(client: httpx.Client,
                                                     smallest: Request) -> None:
    smallest["depots"] = [{"id": "yard", "location": [2000, 0], "time_window": {"earliest": 900}}]
    smallest["planar_unit"] = 1
    smallest["customers"] = [{"id": "near", "location": [1000, 0], "demand": [1],
                              "time_window": {"latest": 200}}]
    smallest["fleet"] = [{"id": "truck", "count": 1, "capacity": [1], "speed_kmh": 36,
                          "start_location": [0, 0], "max_working_duration": 3600,
                          "overtime": {"max_duration": 600, "cost_per_hour": 1}}]
    (route,) = client.post("/plan", json=smallest).json()["routes"]
    back = route["trips"][0]["stops"][-1]
    assert (back["arrival"], back["service_start"], back["departure"]) == (200, 900, 900)
    assert (back["waiting"], route["working_duration"]) == (700, 900)


def test_who_would_leave_after_the_depot_closes_is_told(client: httpx.Client,
                                                        smallest: Request) -> None:
    smallest["depots"][0] |= {"id": "hub", "time_window": {"latest": 300}}
    smallest["customers"] = [smallest["customers"][0] | {"release_time": 360}]
    smallest["fleet"][0]["end"] = "open"
    (left_out,) = client.post("/plan", json=smallest).json()["unassigned"]
    assert {reason["remedy"] for reason in left_out["reasons"]} == {
        "fits if hub closed 1 minute later"}


@pytest.mark.parametrize(("shift", "overtime", "remedy"), [
    (20_000, None, "fits if hub closed 47.5 minutes later"),
    (6000, None, "fits if hub closed 47.5 minutes later and if van's shift ended 7.5 minutes "
     "later"),
    (6000, {"max_duration": 600, "cost_per_hour": 1}, "fits if hub closed 47.5 minutes later")])
def test_a_depot_is_named_once_by_how_much_suffices_there_and_back(
        client: httpx.Client, shift: int, overtime: Request | None, remedy: str) -> None:
    request: Request = {
        "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0], "time_window": {"latest": 3600}}],
        "customers": [{"id": "a", "location": [5, 0], "demand": [1],
                       "time_window": {"earliest": 6000, "latest": 9000}}],
        "fleet": [{"id": "van", "count": 1, "capacity": [1], "shift": {"latest": shift},
                   "overtime": overtime}],
        "options": {"time_limit": 0}}
    (left_out,) = client.post("/plan", json=request).json()["unassigned"]
    (reason,) = left_out["reasons"]
    assert reason["message"] == "van would leave 32.5 minutes after hub closes."
    assert reason["remedy"] == remedy
    request["depots"][0]["time_window"]["latest"] += 2850
    if " and " in remedy:
        assert client.post("/plan", json=request).json()["unassigned"]
        request["fleet"][0]["shift"]["latest"] += 450
    assert not client.post("/plan", json=request).json()["unassigned"]


def test_overtime_is_named_once_for_shift_and_working_duration(client: httpx.Client,
                                                               smallest: Request) -> None:
    smallest["planar_unit"], smallest["depots"][0]["location"] = 1, [0, 0]
    smallest["customers"] = [{"id": "a", "location": [6000, 0], "demand": [1]}]
    smallest["fleet"] = [{"id": "van", "count": 1, "capacity": [1], "speed_kmh": 36,
                          "shift": {"latest": 1000}, "max_working_duration": 900,
                          "overtime": {"max_duration": 60, "cost_per_hour": 1}}]
    (left_out,) = client.post("/plan", json=smallest).json()["unassigned"]
    (reason,) = left_out["reasons"]
    assert reason["remedy"] == "fits if van could work 4 minutes more overtime"
    smallest["fleet"][0]["overtime"]["max_duration"] += 240
    assert not client.post("/plan", json=smallest).json()["unassigned"]


def test_vehicles_that_fly_have_depots_open_from_the_first(client: httpx.Client,
                                                           smallest: Request) -> None:
    smallest["depots"].append({"id": "yard", "location": [9, 9], "time_window": {"earliest": 600}})
    smallest["fleet"][0] |= {"flies": True, "max_trips": 2, "reload_depots": ["yard"]}
    assert [code for code, _ in errors_of(client, smallest)] == ["HOURS_DIFFER"]


def test_a_depot_that_closes_is_told_beside_overtime_without_end(client: httpx.Client,
                                                                 smallest: Request) -> None:
    smallest["depots"] = [{"id": "hub", "location": [0, 0], "time_window": {"latest": 3600}}]
    smallest["planar_unit"] = 1
    smallest["customers"] = [{"id": "far", "location": [20_000, 0], "demand": [1]}]
    smallest["fleet"] = [{"id": "van", "count": 1, "capacity": [1], "speed_kmh": 36,
                          "max_working_duration": 600, "overtime": {"cost_per_hour": 1}}]
    (left_out,) = client.post("/plan", json=smallest).json()["unassigned"]
    (reason,) = left_out["reasons"]
    assert reason["message"] == "van would be back 6.7 minutes after hub closes."
    assert reason["remedy"] == "fits if hub closed 6.7 minutes later"
    smallest["depots"][0]["time_window"]["latest"] += 402
    assert not client.post("/plan", json=smallest).json()["unassigned"]
