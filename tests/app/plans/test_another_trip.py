"""A vehicle that is back may go out again: offered where a customer is left out, and true."""

from typing import Any

import httpx

from app.schemas.response import PlanReply

Data = dict[str, Any]

ANOTHER = "fits if van could make another trip"


def day(*customers: str, **vehicle: Any) -> Data:
    """Return a day of one van, whose customers are six minutes away."""
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
            "customers": [{"id": name, "location": [6, 0], "demand": [5]} for name in customers],
            "fleet": [{"id": "van", "count": 1, "capacity": [5], "speed_kmh": 60} | vehicle],
            "options": {"time_limit": 60, "search_iterations": 50}}


def test_another_trip_serves_who_is_left_out(client: httpx.Client,
                                             searching: httpx.Client) -> None:
    plan = client.post("/plan", json=day("A", "B")).json()
    PlanReply.model_validate(plan)
    (left_out,) = plan["unassigned"]
    (reason,) = left_out["reasons"]
    assert (reason["remedy"], reason["other_remedy"]) == ("fits with one more vehicle", ANOTHER)
    again = searching.post("/plan", json=day("A", "B", max_trips=2) | {"replan": {"plan": plan}})
    assert again.json()["unassigned"] == []


def test_parcel_that_came_in_late_is_offered_the_van_that_is_back(
        client: httpx.Client, searching: httpx.Client) -> None:
    plan = client.post("/plan", json=day("A")).json()
    onward = {"replan": {"plan": plan, "freeze_before": 7200}}
    late = searching.post("/plan", json=day("A", "B") | onward).json()
    PlanReply.model_validate(late)
    (left_out,) = late["unassigned"]
    (reason,) = left_out["reasons"]
    assert (reason["code"], reason["remedy"]) == ("FLEET_EXHAUSTED", ANOTHER)
    served = searching.post("/plan", json=day("A", "B", max_trips=2) | onward).json()
    assert served["unassigned"] == []
    first, second = served["routes"][0]["trips"]
    assert first == plan["routes"][0]["trips"][0]
    assert second["stops"][0]["departure"] >= 7200


def test_no_trip_is_offered_that_ends_after_the_shift(client: httpx.Client,
                                                      searching: httpx.Client) -> None:
    shift = {"shift": {"latest": 7200 + 700}}
    plan = client.post("/plan", json=day("A", **shift)).json()
    late = searching.post("/plan", json=day("A", "B", **shift) | {
        "replan": {"plan": plan, "freeze_before": 7200}}).json()
    (left_out,) = late["unassigned"]
    assert [reason["remedy"] for reason in left_out["reasons"]] == [None]


def test_explaining_offers_it_too(client: httpx.Client) -> None:
    problem = day("A", "B")
    plan = client.post("/plan", json=problem).json()
    left_out = plan["unassigned"][0]["id"]
    told = client.post("/explain", json={
        "problem": problem, "plan": plan, "customer": left_out}).json()
    assert [reason["other_remedy"] for reason in told["reasons"]] == [ANOTHER]
