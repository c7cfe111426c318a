"""How customers are served, over HTTP: setups, times by type, fresh and incompatible goods."""

from typing import Any

import httpx
import pytest

from tests.app.plans.asking import planned_and_judged

Request = dict[str, Any]


@pytest.fixture
def street() -> Request:
    """Return a request with a depot and two customers, each 1 km, so a minute, from the next.

    One asks for a setup and long service, the other for what is not older than ten minutes.
    """
    return {
        "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [
            {"id": "near", "location": [1, 0], "demand": [1], "setup_duration": 30,
             "service_duration": 5, "service_duration_by_type": {"van": 120}},
            {"id": "far", "location": [2, 0], "demand": [1], "max_time_aboard": 600,
             "time_window": {"earliest": 3600}}],
        "fleet": [{"id": "van", "count": 1, "capacity": [2], "speed_kmh": 60,
                   "costs": {"per_hour": 1}}],
        "options": {"time_limit": 0, "search_iterations": 50},
    }


def stops_of(plan: Request) -> dict[str, Request]:
    """Return the customers' stops, and the first one, at the depot."""
    stops = [stop for route in plan["routes"] for trip in route["trips"] for stop in trip["stops"]]
    return {stop["id"]: stop for stop in reversed(stops)}


def test_a_van_sets_up_serves_and_leaves_as_late_as_goods_have_to_be_fresh(
        client: httpx.Client, street: Request) -> None:
    stops = stops_of(planned_and_judged(client, street))
    near, far = stops["near"], stops["far"]
    assert near["setup"] == near["service_start"] - near["arrival"] == 30
    assert near["departure"] - near["service_start"] == 120
    assert near["waiting"] == 0
    assert "setup" not in far
    assert far["service_start"] == 3600
    assert far["service_start"] - stops["hub"]["departure"] <= 600


def test_setups_of_plans_sent_are_told_as_setups_and_not_as_waiting(client: httpx.Client,
                                                                    street: Request) -> None:
    street["fleet"] = [{"id": "van", "count": 2, "capacity": [2], "speed_kmh": 60, "drones": {
        "count": 1, "capacity": [1], "speed_kmh": 60}}]
    street["customers"][1] = {"id": "far", "location": [2, 0], "demand": [1],
                              "setup_duration": 45}
    street["customers"].append({"id": "by air", "location": [0, 1], "demand": [1],
                                "setup_duration": 15, "served_by": "drone"})
    times = {"arrival": 0.0, "service_start": 0.0, "departure": 0.0}
    depot = {"kind": "depot", "id": "hub"}
    timed = {"vehicle": "van-1", "type": "van", "trips": [{"stops": [
        depot | times,
        {"kind": "customer", "id": "far", "arrival": 120, "service_start": 165, "departure": 165},
        depot | dict.fromkeys(times, 285)], "sorties": [
            {"drone": "van-1/drone-1", "launch_stop": 0, "recovery_stop": 2, "launch_time": 0,
             "recovery_time": 285, "customers": [
                {"id": "by air", "arrival": 60, "service_start": 75, "departure": 75}]}]}]}
    plan = {"routes": [timed, {"vehicle": "van-2", "type": "van", "trips": [
        {"stops": [depot, {"kind": "customer", "id": "near"}, depot], "sorties": []}]}]}
    told = client.post("/check", json={"problem": street, "plan": plan}).json()
    assert told["feasible"], told
    stops = stops_of(told)
    assert (stops["near"]["setup"], stops["near"]["waiting"]) == (30, 0)
    assert (stops["far"]["setup"], stops["far"]["waiting"]) == (45, 0)
    (sortie,) = told["routes"][0]["trips"][0]["sorties"]
    assert sortie["customers"][0]["setup"] == 15


@pytest.mark.parametrize("launched", [0, 99])
def test_a_sortie_that_cannot_be_is_told_though_setups_are_read(
        client: httpx.Client, street: Request, launched: int) -> None:
    street["fleet"][0]["drones"] = {"count": 1, "capacity": [1]}
    plan = planned_and_judged(client, street)
    plan["routes"][0]["trips"][0]["sorties"] = [
        {"drone": "van-1/drone-1", "launch_stop": launched, "recovery_stop": 1, "launch_time": 0,
         "recovery_time": 0, "customers": []}]
    told = client.post("/check", json={"problem": street, "plan": plan})
    assert told.status_code == 200, told.text
    assert not told.json()["feasible"]


def test_what_is_too_long_aboard_is_said_and_how_it_could_be_served(client: httpx.Client,
                                                                    street: Request) -> None:
    plan = planned_and_judged(client, street)
    street["customers"][1]["max_time_aboard"] = 60
    verdict = client.post("/check", json={"problem": street, "plan": plan}).json()
    assert [violation["code"] for violation in verdict["violations"]] == ["TIME_ABOARD"]
    left, = planned_and_judged(client, street)["unassigned"]
    assert left["id"] == "far"
    reason, = left["reasons"]
    assert (reason["code"], reason["remedy"]) == (
        "TIME_ABOARD", "fits if it could be aboard 1 minute longer")


def test_incompatible_goods_go_by_other_trips(client: httpx.Client, street: Request) -> None:
    for customer, goods in zip(street["customers"], ("paint", "food"), strict=True):
        customer["goods"] = [goods]
    street["fleet"][0] |= {"count": 2}
    assert len(planned_and_judged(client, street)["routes"]) == 1
    street["incompatible_goods"] = [{"goods": ["food", "paint"]}]
    plan = planned_and_judged(client, street)
    assert plan["summary"]["served"] == len(plan["routes"]) == 2


def test_a_day_under_way_goes_on_with_setups_and_fresh_goods(client: httpx.Client,
                                                             street: Request) -> None:
    plan = planned_and_judged(client, street)
    before = stops_of(plan)
    now = before["near"]["arrival"] + 10
    later = street | {"replan": {"plan": {"routes": plan["routes"]}, "freeze_before": now}}
    reply = client.post("/plan", json=later)
    assert reply.status_code == 200, reply.text
    after = stops_of(reply.json())
    assert after["near"] == before["near"]
    assert after["far"]["service_start"] - after["hub"]["departure"] <= 600
