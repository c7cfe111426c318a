"""Batteries that are swapped before launches, over HTTP."""

from typing import Any

import httpx
import pytest
from tests.app.plans.asking import planned

Request = dict[str, Any]


def flying(request: Request, **turnaround: Any) -> Request:
    """Return a request all of whose customers one drone serves, one flight after another."""
    for customer in request["customers"]:
        customer["served_by"] = "drone"
    request["fleet"][0]["drones"] = {"count": 1, "capacity": [10], "launch_duration": 20,
                                     "recovery_duration": 10, "turnaround": turnaround}
    return request


def handled(plan: Request) -> list[tuple[float, float]]:
    """Return when the sorties of the only trip take off, and when they are over."""
    trip, = plan["routes"][0]["trips"]
    return sorted((sortie["launch_time"], sortie["recovery_time"]) for sortie in trip["sorties"])


def test_a_launch_is_longer_once_there_was_one(client: httpx.Client, smallest: Request) -> None:
    request = flying(smallest, swap_duration=90)
    plan = planned(client, request)
    (_, aboard), (again, _) = handled(plan)
    assert again == pytest.approx(aboard + 90 + 20)
    assert client.post("/check", json={"problem": request, "plan": plan}).json()["feasible"]
    for change in ({"swap_duration": 91}, {"batteries": 1}):
        verdict = client.post("/check", json={"problem": flying(smallest, **change), "plan": plan})
        assert {broken["code"] for broken in verdict.json()["violations"]} >= {
            "BATTERIES" if "batteries" in change else "TIME_MISMATCH"}


def test_each_flight_of_a_trip_needs_a_battery(client: httpx.Client, smallest: Request) -> None:
    smallest["fleet"][0]["count"] = 2
    plan = planned(client, flying(smallest, batteries=1))
    assert [len(trip["sorties"]) for route in plan["routes"] for trip in route["trips"]] == [1, 1]
    plan = planned(client, flying(smallest, batteries=0))
    assert len(plan["unassigned"]) == 2
    for left_out in plan["unassigned"]:
        reason, = left_out["reasons"]
        assert (reason["code"], reason["remedy"]) == ("SORTIES", "fits if truck carried 1 battery")


def test_a_day_under_way_has_the_batteries_that_are_left(client: httpx.Client,
                                                         smallest: Request) -> None:
    request = flying(smallest, swap_duration=90, batteries=2)
    request["fleet"][0]["count"] = 1
    plan = planned(client, request)
    (launch, _), _ = handled(plan)
    replan = {"plan": plan, "freeze_before": launch + 1}
    again = planned(client, request | {"replan": replan})
    assert handled(again) == handled(plan)
    fewer = planned(client, flying(request, batteries=1) | {"replan": replan})
    assert handled(fewer) == handled(plan)[:1]
    assert len(fewer["unassigned"]) == 1


@pytest.mark.parametrize(("turnaround", "path"), [
    ({"swap_duration": -1}, "swap_duration"), ({"batteries": 1.5}, "batteries"),
    ({"batteries": -1}, "batteries"), ({"charge_w": -1}, "charge_w"),
    ({"charge_w": 100}, "charge_w")])
def test_wrong_turnarounds_are_refused(client: httpx.Client, smallest: Request,
                                       turnaround: Request, path: str) -> None:
    reply = client.post("/plan", json=flying(smallest, **turnaround))
    assert [error["path"] for error in reply.json()["errors"]] == [
        f"$.fleet[0].drones.turnaround.{path}"]
