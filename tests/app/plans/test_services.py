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
