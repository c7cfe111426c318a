"""Drones of several types on a truck, over HTTP."""

from typing import Any

import httpx
import pytest
from tests.app.plans.asking import planned

Request = dict[str, Any]

SMALL = {"id": "small", "count": 2, "capacity": [1], "speed_kmh": 90, "recovery_duration": 5}
LARGE = {"id": "large", "count": 1, "capacity": [10], "speed_kmh": 60, "recovery_duration": 20,
         "costs": {"per_km": 2.0}}


def flying(request: Request, *drones: Request) -> Request:
    """Return a request both of whose customers drones serve."""
    for customer in request["customers"]:
        customer["served_by"] = "drone"
    return request | {"fleet": [request["fleet"][0] | {"drones": list(drones)}]}


def judged(client: httpx.Client, request: Request, plan: Request) -> set[str]:
    reply = client.post("/check", json={"problem": request, "plan": plan})
    assert reply.status_code == 200, reply.text
    return {broken["code"] for broken in reply.json()["violations"]}


def flown_by(plan: Request, number: int) -> Request:
    """Return a plan whose only truck flies all sorties with another drone."""
    route, = plan["routes"]
    trips = [trip | {"sorties": [sortie | {"drone": f"{route['vehicle']}/drone-{number}"}
                                 for sortie in trip["sorties"]]} for trip in route["trips"]]
    return plan | {"routes": [route | {"trips": trips}]}


def test_a_reply_tells_the_type_of_drone(client: httpx.Client, smallest: Request) -> None:
    plan = planned(client, flying(smallest, LARGE))
    sorties = [sortie for trip in plan["routes"][0]["trips"] for sortie in trip["sorties"]]
    assert {(sortie["drone"], sortie["drone_type"]) for sortie in sorties} == {
        ("truck-1/drone-1", "large")}
    alone = planned(client, flying(smallest) | {
        "fleet": [smallest["fleet"][0] | {"drones": {"count": 1, "capacity": [10]}}]})
    assert "drone_type" not in alone["routes"][0]["trips"][0]["sorties"][0]


def test_the_number_of_a_drone_tells_by_which_type_it_is_judged(client: httpx.Client,
                                                                smallest: Request) -> None:
    plan = planned(client, flying(smallest, LARGE))
    both = flying(smallest, SMALL, LARGE)
    third = flown_by(plan, 3)
    assert judged(client, both, third) == set()
    verdict = client.post("/check", json={"problem": both, "plan": third}).json()
    assert verdict["cost"] == plan["cost"]
    assert judged(client, both, flown_by(plan, 2)) == {"PAYLOAD", "TIME_MISMATCH"}
    assert "COUNT" in judged(client, both, flown_by(plan, 4))
    assert judged(client, flying(smallest, SMALL | {"count": 0}, LARGE), plan) == set()


def test_service_lasts_as_long_as_is_stated_for_a_type_of_drones(client: httpx.Client,
                                                                smallest: Request) -> None:
    both = flying(smallest, SMALL, LARGE)
    both["customers"][0]["service_duration_by_type"] = {"truck/large": 77, "truck/small": 3}
    plan = planned(client, flying(both, LARGE) | {"customers": [
        customer | {"service_duration_by_type": {"truck/large": 77}}
        for customer in both["customers"][:1]] + both["customers"][1:]})
    assert judged(client, both, flown_by(plan, 3)) == set()
    visits = [visit for trip in plan["routes"][0]["trips"] for sortie in trip["sorties"]
              for visit in sortie["customers"] if visit["id"] == both["customers"][0]["id"]]
    assert visits[0]["departure"] - visits[0]["service_start"] == pytest.approx(77)


def test_who_is_too_heavy_for_small_drones_is_flown_to_by_a_large_one(
        client: httpx.Client, smallest: Request) -> None:
    request = flying(smallest, SMALL, LARGE)
    request["customers"][0]["demand"] = [1]
    plan = planned(client, request)
    flown = {visit["id"]: (sortie["drone"], sortie["drone_type"])
             for trip in plan["routes"][0]["trips"] for sortie in trip["sorties"]
             for visit in sortie["customers"]}
    light, heavy = (customer["id"] for customer in request["customers"])
    assert flown == {light: ("truck-1/drone-1", "small"), heavy: ("truck-1/drone-3", "large")}
    assert judged(client, request, plan) == set()
    why = client.post("/explain", json={"problem": request, "plan": plan, "customer": heavy,
                                        "drones": True})
    assert why.status_code == 200, why.text
    again = planned(client, request | {"replan": {"plan": plan}})
    assert again["routes"] == plan["routes"]


def test_a_day_under_way_goes_on_with_the_drones_of_its_types(client: httpx.Client,
                                                              smallest: Request) -> None:
    request = flying(smallest, SMALL, LARGE | {
        "launch_duration": 60, "turnaround": {"batteries": 1, "swap_duration": 30}})
    request["customers"][0]["demand"] = [1]
    plan = planned(client, request)
    sorties = [sortie for trip in plan["routes"][0]["trips"] for sortie in trip["sorties"]]
    now = max(sortie["launch_time"] for sortie in sorties) - 30
    again = planned(client, request | {"replan": {"plan": plan, "freeze_before": now}})
    kept = [sortie for trip in again["routes"][0]["trips"] for sortie in trip["sorties"]]
    assert [(sortie["drone"], sortie["drone_type"], sortie["launch_time"]) for sortie in kept] == [
        (sortie["drone"], sortie["drone_type"], sortie["launch_time"]) for sortie in sorties]
    fewer = flying(request, SMALL) | {"replan": {"plan": plan, "freeze_before": now + 31}}
    reply = client.post("/plan", json=fewer)
    assert [error["code"] for error in reply.json()["errors"]] == ["UNKNOWN_DRONE"]


@pytest.mark.parametrize(("drones", "code", "path"), [
    ([SMALL, LARGE | {"id": "small"}], "DUPLICATE_ID", "[1].id"),
    ([{key: value for key, value in SMALL.items() if key != "id"}], "MISSING_DRONE_ID", "[0].id"),
    ([SMALL, LARGE | {"capacity": [1, 2]}], "DIMENSION_MISMATCH", "[1].capacity"),
    ([SMALL, LARGE | {"capacity": "much"}], "WRONG_TYPE", "[1].capacity"),
    ([SMALL, LARGE | {"energy": {"battery_wh": 100}}], "POWER_OR_PRESET", "[1].energy"),
    ([SMALL | {"id": str(number)} for number in range(9)], "WRONG_LENGTH", ""),
    ("two", "WRONG_TYPE", "")])
def test_wrong_drones_are_refused(client: httpx.Client, smallest: Request, drones: Any,
                                  code: str, path: str) -> None:
    smallest["fleet"][0]["drones"] = drones
    reply = client.post("/check", json={"problem": smallest, "plan": {"routes": []}})
    assert [(error["code"], error["path"]) for error in reply.json()["errors"]] == [
        (code, f"$.problem.fleet[0].drones{path}")]


def test_who_names_drones_that_are_not_there_is_told(client: httpx.Client,
                                                     smallest: Request) -> None:
    request = flying(smallest, SMALL, LARGE)
    request["customers"][0]["service_duration_by_type"] = {"truck/drone": 1}
    reply = client.post("/check", json={"problem": request, "plan": {"routes": []}})
    assert [error["code"] for error in reply.json()["errors"]] == ["UNKNOWN_VEHICLE_TYPE"]
