"""Who leaves now and who waits, in plans whose requests have a forecast, over HTTP."""

import re
from typing import Any

import httpx
import pytest

from app.schemas.response import PlanReply
from tests.app.plans.asking import judged

Data = dict[str, Any]

HOUR = 3600.0


def order(name: str, x: float, latest: float = 6 * HOUR, **more: Any) -> Data:
    """Return an order on a street, a kilometre and a minute per unit."""
    return {"id": name, "location": [x, 0], "demand": [1], "time_window": {"latest": latest},
            **more}


@pytest.fixture
def street() -> Data:
    """Return one order that must leave now, one beside it, and one on the other side."""
    return {
        "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [order("urgent", 10, latest=900), order("easy", 9), order("west", -10)],
        "fleet": [{"id": "van", "count": 3, "capacity": [2], "speed_kmh": 60, "max_trips": 3}],
        "forecast": {"past_days": [[order("came", -9, placed_at=1800)]]},
        "options": {"time_limit": 60, "search_iterations": 600},
    }


def planned(client: httpx.Client, request: Data) -> Data:
    """Return a plan that the service finds feasible."""
    reply = client.post("/plan", json=request)
    assert reply.status_code == 200, reply.text
    PlanReply.model_validate_json(reply.text)
    found: Data = reply.json()
    verdict = judged(client, request, found)
    assert (verdict["violations"], verdict["cost"]) == ([], pytest.approx(found["cost"]))
    return found


def begins(plan: Data) -> dict[str, float]:
    """Return when each customer's trip begins."""
    return {stop["id"]: trip["stops"][0]["departure"] for route in plan["routes"]
            for trip in route["trips"] for stop in trip["stops"] if stop["kind"] == "customer"}


def outlook(plan: Data) -> dict[str, tuple[bool, bool]]:
    """Return of each order whether it leaves, and whether it must."""
    return {each["id"]: (each["leaves"], each["must"]) for each in plan["outlook"]}


def test_who_must_leaves_who_is_near_rides_along_and_who_will_have_company_waits(
        service: httpx.Client, street: Data) -> None:
    plan = planned(service, street)
    assert outlook(plan) == {
        "urgent": (True, True), "easy": (True, False), "west": (False, False)}
    assert {name: begin >= HOUR for name, begin in begins(plan).items()} == {
        "urgent": False, "easy": False, "west": True}
    west = plan["outlook"][2]
    assert (west["futures"], west["later_in"], west["departure"]) == (30, 30, HOUR)
    assert west["text"] == (f"Waits: in 30 of 30 futures it rides along at 3600 s, "
                            f"for {west['saved']:.2f} less.")
    assert west["saved"] == pytest.approx(20 - 0.8 * 2)


def test_without_a_forecast_all_wait_who_can(service: httpx.Client, street: Data) -> None:
    plan = planned(service, street | {"forecast": {"every": 1800}})
    assert outlook(plan) == {
        "urgent": (True, True), "easy": (False, False), "west": (False, False)}
    assert plan["outlook"][1]["text"] == "Waits: without a forecast, as late as is safe."
    assert min(begin for name, begin in begins(plan).items() if name != "urgent") >= 1800


def test_rates_tell_what_may_come_and_what_is_aboard_is_settled(service: httpx.Client,
                                                               street: Data) -> None:
    first = planned(service, street)
    street["forecast"] = {"rates": [{"since": 0, "until": 2 * HOUR, "per_hour": 6, "like": [
        order("like", -9, latest=3 * HOUR)]}]}
    street["fleet"][0] |= {"count": 20, "capacity": [20]}
    street["plan_start"] = "2026-11-30T08:00:00+01:00"
    street["options"]["times"] = "clock"
    street["replan"] = {"plan": {"routes": first["routes"]}, "freeze_before": 400}
    plan = planned(service, street)
    assert outlook(plan) == {"west": (False, False)}
    assert re.fullmatch(r"Waits: in \d+ of 30 futures it rides along at (09|10):00:00, for "
                        r"\d+\.\d\d less\.", plan["outlook"][0]["text"])


def test_whoever_no_later_trip_could_take_leaves_now(service: httpx.Client,
                                                     street: Data) -> None:
    # One van, which is back too late to take anybody but those it takes along.
    street["fleet"] = [{"id": "van", "count": 1, "capacity": [3], "speed_kmh": 60}]
    plan = planned(service, street)
    assert plan["unassigned"] == []
    assert {leaves for leaves, _ in outlook(plan).values()} == {True}


@pytest.mark.parametrize(("came", "future"), [(-9, [0, -18]), (9, [0, 0])])
def test_quote_knows_what_rides_along_with_orders_to_come(
        service: httpx.Client, street: Data, came: float, future: list[float]) -> None:
    street["customers"] = [order("easy", 9)]
    street.pop("forecast")
    plan = planned(service, street)
    street["forecast"] = {"past_days": [[order("came", came, placed_at=2000)]]}
    slots = [{"latest": 3000}, {"earliest": 4000, "latest": 6000}, {"by": "drone"}]
    reply = service.post("/quote", json={
        "problem": street, "plan": plan, "order": order("new", -9.5), "slots": slots}).json()
    assert [each["of_which_future"] for each in reply["slots"]] == pytest.approx([*future, None])
    assert [each["cost"] for each in reply["slots"]] == pytest.approx(
        [19 + future[0], 19 + future[1], None])
    assert reply["best"] == (1 if came < 0 else 0)


def test_what_is_wrong_with_a_forecast_is_told_where_it_is(service: httpx.Client,
                                                          street: Data) -> None:
    street["forecast"]["past_days"] = [[], [order("came", -9) | {"demand": [1, 2]}]]
    street["fairness"] = {"makespan_cost_per_hour": 5}
    reply = service.post("/plan", json=street)
    assert reply.status_code == 422
    assert {(each["code"], each["path"]) for each in reply.json()["errors"]} == {
        ("DIMENSION_MISMATCH", "$.forecast.past_days[1][0].demand"),
        ("CONTRADICTION", "$.forecast")}
