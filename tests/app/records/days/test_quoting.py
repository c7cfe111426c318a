"""Quotes of days: prices of slots, and orders accepted in them."""

import random
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import Any

import httpx
import pytest

from app.records.days import quoting
from app.records.days.store import DayStore
from app.schemas.quote import QuoteReply
from tests.app.records.days.living import (
    PROBLEM, Data, begun, clock, order, plan_of, planned, served_by, standing, told,
)
from tests.seeds import seeds

pytestmark = pytest.mark.slow

CENT = 0.01
NEW = order("N", 1, 2)["customer"]
SLOTS: list[Data] = [
    {"earliest": 0, "latest": 400}, {"earliest": 400, "latest": 900, "by": "truck"},
    {"earliest": 900}, {"earliest": 0, "latest": 100}, {"by": "drone"}]


def quoted(client: httpx.Client, day: str, slots: list[Data] = SLOTS,
           **asked: Any) -> dict[str, Any]:
    """Return a day's quote for an order."""
    reply = client.post(f"/days/{day}/quote", json={"order": NEW, "slots": slots} | asked)
    assert reply.status_code == 200, reply.text
    QuoteReply.model_validate_json(reply.text)
    return dict(reply.json())


def cheapest(client: httpx.Client, problem: Data, plan: Data, slot: Data) -> float | None:
    """Return what the cheapest place costs, by `POST /fit`; None: there is none."""
    window = {name: slot[name] for name in ("earliest", "latest") if name in slot}
    new = {**NEW, "time_window": window, "served_by": slot.get("by", "either")}
    places = client.post("/fit", json={"problem": problem, "plan": plan,
                                       "new_customer": new}).json()["places"]
    allowed = [place["cost"]["total"] for place in places if place["feasible"]]
    return min(allowed, default=None)


def searched(client: httpx.Client, problem: Data, plan: Data, slot: Data) -> float | None:
    """Return what a plan by search costs more with the order in a slot; None: it is left out."""
    window = {name: slot[name] for name in ("earliest", "latest") if name in slot}
    new = {**NEW, "time_window": window, "served_by": slot.get("by", "either")}
    found = client.post("/plan", json={
        "replan": {"plan": plan, "freeze_before": 0}, **problem,
        "customers": [*problem["customers"], new]}).json()
    without = plan["cost"]["total"]
    return None if found["unassigned"] else float(found["cost"]["total"] - without)


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("now", [None, 250, 700])
@pytest.mark.parametrize("seed", seeds(9))
def test_slot_costs_what_a_search_finds(service: httpx.Client, seed: int,
                                        now: float | None) -> None:
    draw = random.Random(seed)
    plan = service.post("/plan", json={**PROBLEM, "replan": {"plan": {"routes": []}}}).json()
    problem = PROBLEM if now is None else {
        **PROBLEM, "replan": {"plan": plan, "freeze_before": now}}
    slots = [{"earliest": (begin := draw.randrange(0, 2000)), "latest": begin + length}
             for length in (0, 60, 600, 3000)] + [{"by": "drone"}]
    slots += [{"earliest": 150 * number, "latest": 150 * number + 1500} for number in range(6)]
    reply = service.post("/quote", json={"problem": problem, "plan": plan, "order": NEW,
                                         "slots": slots}).json()
    costs = [each["cost"] for each in reply["slots"]]
    unsearched = service.post("/quote", json={"problem": problem, "plan": plan, "order": NEW,
                                              "slots": slots, "search": False}).json()["slots"]
    for slot, cost, each in zip(slots, costs, unsearched, strict=True):
        between = cheapest(service, problem, plan, slot)
        assert each["cost"] == between
        assert between is None or (cost is not None and cost <= between)
        found = searched(service, problem, plan, slot)
        assert found is None if cost is None else found is not None and found <= cost + CENT
    kept = [index for index, cost in enumerate(costs) if cost is not None]
    assert [each["feasible"] for each in reply["slots"]] == [cost is not None for cost in costs]
    assert reply["best"] == min(kept, key=lambda index: (costs[index], index), default=None)
    assert all(each["why"] for each in reply["slots"] if not each["feasible"])


def test_slot_accepted_is_kept(service: httpx.Client) -> None:
    day = begun(service)
    quote = quoted(service, day)
    assert [each["feasible"] for each in quote["slots"]] == [True, True, True, False, False]
    assert "N" not in {each.id for each in standing(service, day).orders}
    path = f"/days/{day}/quotes/{quote['token']}/accept"
    first, again = (service.post(path, json={"slot": 1}) for _ in range(2))
    assert (first.status_code, first.json()["accepted"]) == (202, again.json()["accepted"])
    found = {each.id: each for each in planned(service, day).orders}["N"]
    assert found.state == "planned"
    assert found.arrival is not None
    stop = next(stop for route in plan_of(service, day)["routes"] for trip in route["trips"]
                for stop in trip["stops"] if stop["id"] == "N")
    assert 400 <= stop["service_start"] <= 900


@pytest.mark.parametrize(("limits", "kept"), [
    ({}, [True, True]), ({"new_orders": "behind"}, [False, True])])
def test_quote_keeps_to_what_may_change(service: httpx.Client, limits: Data,
                                        kept: list[bool]) -> None:
    van = PROBLEM["fleet"][0] | {"capacity": [9], "count": 1}
    day = begun(service, PROBLEM | {"fleet": [van], "options": {"change_limits": limits}})
    quote = quoted(service, day, [{"latest": 500}, {"latest": 5000}],
                   order=order("N", 1, 0)["customer"])
    assert [each["feasible"] for each in quote["slots"]] == kept


def test_quote_goes_by_the_day_as_it_stands(service: httpx.Client) -> None:
    day = begun(service)
    told(service, day, clock(), at=3000)
    late = quoted(service, day, [{"latest": 2000}, {"earliest": 3000}])["slots"]
    assert [each["feasible"] for each in late] == [False, True]
    assert late[1]["arrival"] >= 3000
    assert late[1]["vehicle"] in {*served_by(plan_of(service, day)).values(), "van-1", "van-2",
                                  "van-3"}


def accepting(client: httpx.Client, day: str, token: str) -> httpx.Response:
    """Accept the first slot of a quote."""
    return client.post(f"/days/{day}/quotes/{token}/accept", json={"slot": 0})


def test_of_two_who_accept_the_last_slot_at_once_one_is_refused(
        service: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    van = PROBLEM["fleet"][0] | {"capacity": [7], "count": 1, "max_trips": 1}
    day = begun(service, PROBLEM | {"fleet": [van]})
    tokens = [quoted(service, day, [{"latest": 5000}], order=order(name, 1, 0)["customer"])["token"]
              for name in "NM"]
    append, both = DayStore.append, threading.Barrier(2)

    def append_at_once(*args: Any) -> None:
        with suppress(threading.BrokenBarrierError):
            both.wait(60)
        append(*args)

    monkeypatch.setattr(DayStore, "append", append_at_once)
    with ThreadPoolExecutor(2) as pool:
        replies = list(pool.map(lambda token: accepting(service, day, token), tokens))
    assert sorted(reply.status_code for reply in replies) == [202, 409]
    refused = max(replies, key=lambda reply: reply.status_code).json()
    assert refused["type"].endswith("slot-taken")
    kept = "NM"[replies.index(min(replies, key=lambda reply: reply.status_code))]
    orders = {each.id: each.state for each in planned(service, day).orders}
    assert {order: state for order, state in orders.items() if order in "NM"} == {kept: "planned"}


def test_slot_is_accepted_if_the_day_still_has_room(service: httpx.Client) -> None:
    van = PROBLEM["fleet"][0] | {"capacity": [8], "count": 1, "max_trips": 1}
    day = begun(service, PROBLEM | {"fleet": [van]})
    asked = {name: quoted(service, day, [{"latest": 5000}], order=order(name, 1, 0)["customer"])
             for name in "NMO"}
    # None is planned yet as the next is accepted, or it is: both are alike.
    codes = [accepting(service, day, quote["token"]).status_code for quote in asked.values()]
    assert codes == [202, 202, 409]
    more = quoted(service, day, [{"latest": 5000}], order=order("P", 1, 0)["customer"])
    assert more["best"] is None
    orders = {each.id: each.state for each in planned(service, day).orders}
    assert (orders["N"], orders["M"]) == ("planned", "planned")


def test_slot_that_has_passed_is_accepted_no_more(service: httpx.Client) -> None:
    day = begun(service)
    token = quoted(service, day, [{"latest": 400}])["token"]
    told(service, day, clock(), at=3000)
    assert accepting(service, day, token).status_code == 409


def test_only_what_was_quoted_is_accepted_and_only_soon(
        service: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    day, other = begun(service), begun(service)
    token = quoted(service, day)["token"]

    def accept(of: str, by: str, slot: int) -> int:
        return service.post(f"/days/{of}/quotes/{by}/accept", json={"slot": slot}).status_code

    assert accept(other, token, 0) == 410
    # Its last letter has bits that count for nothing.
    assert accept(day, f"{token[:-2]}{'A' if token[-2] != 'A' else 'B'}{token[-1]}", 0) == 410
    assert accept(day, token, 3) == 422
    assert accept(day, token, 40) == 422
    monkeypatch.setattr(quoting, "LAPSES", -1)
    assert accept(day, token, 0) == 410
    assert "N" not in {each.id for each in standing(service, day).orders}


def test_shipment_is_quoted_by_when_it_is_brought(service: httpx.Client) -> None:
    day = begun(service)
    shipment = {"id": "S", "amount": [1], "pickup": {"location": [1, 1]},
                "delivery": {"location": [2, 2]}}
    quote = quoted(service, day, [{"latest": 200}, {"earliest": 1000, "latest": 4000}],
                   order=None, shipment=shipment)
    assert [each["feasible"] for each in quote["slots"]] == [False, True]
    service.post(f"/days/{day}/quotes/{quote['token']}/accept", json={"slot": 1})
    planned(service, day)
    stop = next(stop for route in plan_of(service, day)["routes"] for trip in route["trips"]
                for stop in trip["stops"] if stop["kind"] == "delivery")
    assert 1000 <= stop["service_start"] <= 4000


def test_quote_of_nothing_or_of_two_is_refused(service: httpx.Client) -> None:
    day = begun(service)
    for asked in ({}, {"order": NEW, "shipment": {"id": "S", "delivery": {"location": [1, 1]}}}):
        reply = service.post(f"/days/{day}/quote", json={"slots": SLOTS} | asked)
        assert reply.status_code == 422
    ended = service.post(f"/days/{day}/quote", json={
        "order": NEW, "slots": [{"earliest": 2, "latest": 1}]})
    assert [error["path"] for error in ended.json()["errors"]] == ["$.slots[0]"]
