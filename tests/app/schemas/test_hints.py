"""Errors say what helps where they are: which field was meant, its unit, its form."""

from typing import Any

import httpx
import pytest

from app.schemas.vehicle import CostsInput

Request = dict[str, Any]

WRONG: dict[str, tuple[tuple[Any, ...], Any, str, str]] = {
    # name: where, what is written, path, what is said
    "typo": (("customers", 0, "servce_duration"), 5, "", "Did you mean service_duration?"),
    "another's word": (("customers", 0, "service_time"), 5, "", "Did you mean service_duration?"),
    "deep typo": (("fleet", 0, "drones"), {"count": 1, "capacity": [1], "endurence": 9},
                  ".endurence", "Did you mean endurance?"),
    "in a list": (("customers", 0, "time_windows"), [{"erliest": 0}], "[0].erliest",
                  "Did you mean earliest?"),
    "few fields": (("fleet", 0, "costs"), {"petrol": 1}, ".petrol",
                   f"The fields here are {', '.join(sorted(CostsInput.model_fields))}."),
    "a word": (("coordinate_system",), "Geographic", "", "Did you mean 'geographic'?"),
    "no list": (("customers", 0, "demand"), 10, "", "write [10]."),
    "no list of words": (("customers", 0, "skills"), "cooled", "", 'write ["cooled"].'),
    "an object": (("depots",), {"id": "hub"}, "", "put what it lists between [ and ]"),
    "quoted": (("customers", 0, "service_duration"), "300", "", "write 300 without quotes."),
    "a duration": (("customers", 0, "service_duration"), "5 min", "",
                   "service_duration: Time spent at the customer in seconds."),
    "an instant": (("fleet", 0, "shift"), {"latest": [17]}, ".latest", "seconds since plan start"),
    "whole": (("fleet", 0, "count"), 2.0, "", "write 2."),
    "a number": (("customers", 0, "id"), 5, "", 'write "5".'),
    "a bound": (("fleet", 0, "speed_kmh"), 0, "", "must be at least 1: raise it. speed_kmh: Speed "
                "in km/h"),
    "a place as an object": (("customers", 0, "location"), {"lat": 52.5, "lng": 13.4}, "",
                             "`[longitude, latitude]` in degrees"),
    "a window as a list": (("customers", 0, "time_window"), [0, 9], "",
                           "Its fields are earliest, early_cost_per_hour"),
}


def put(request: Request, where: tuple[Any, ...], value: Any) -> str:
    """Write a value into a request and return its path."""
    part: Any = request
    for key in where[:-1]:
        part = part[key]
    part[where[-1]] = value
    return "$" + "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in where)


@pytest.mark.parametrize("name", WRONG)
def test_errors_say_what_to_write(client: httpx.Client, smallest: Request, name: str) -> None:
    where, value, further, words = WRONG[name]
    path = put(smallest, where, value) + further
    errors = client.post("/plan", json=smallest).json()["errors"]
    messages = [error["message"] for error in errors if error["path"] == path]
    assert len(messages) == 1, errors
    assert words in messages[0]


def test_a_missing_field_says_what_it_is(client: httpx.Client, smallest: Request) -> None:
    del smallest["customers"][0]["demand"]
    error, = client.post("/plan", json=smallest).json()["errors"]
    assert error["message"].startswith("This field is required: add it. demand: Amount to deliver")


@pytest.mark.parametrize(("endpoint", "around", "root"), [
    ("/warnings", lambda request: request, "$"),
    ("/jobs", lambda request: request, "$"),
    ("/check", lambda request: {"problem": request, "plan": {"routes": []}}, "$.problem"),
    ("/explain", lambda request: {"problem": request, "plan": {"routes": []}}, "$.problem"),
    ("/compare", lambda request: {"base": request, "fleets": {"a": request["fleet"]}}, "$.base"),
    ("/sweep", lambda request: {"base": request, "grid": {"unassigned_cost": [1]}}, "$.base"),
])
def test_every_endpoint_finds_the_field_that_was_meant(
        client: httpx.Client, smallest: Request, endpoint: str, around: Any, root: str) -> None:
    smallest["customers"][0]["demnd"] = [1]
    errors = client.post(endpoint, json=around(smallest)).json()["errors"]
    said = {error["path"]: error["message"] for error in errors}
    assert said[f"{root}.customers[0].demnd"].endswith("Did you mean demand?")


def test_what_surrounds_a_problem_is_looked_up_too(client: httpx.Client,
                                                   smallest: Request) -> None:
    body = {"problem": smallest, "plan": {"rotes": [], "routes": []}}
    error, = client.post("/check", json=body).json()["errors"]
    assert error["message"].endswith("Did you mean routes?")
