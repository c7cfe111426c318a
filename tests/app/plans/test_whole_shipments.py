"""Whole shipments over HTTP: where they fit plans best, and what they cost elsewhere."""

from collections.abc import Iterator, Sequence
from itertools import permutations
from typing import Any

import httpx
import pytest

from app.schemas.explain import ExplainReply
from app.schemas.fit import FitReply
from model.counsel import shipment_screening
from model.problem import MOST_PICKUPS
from tests.app.plans.asking import refused

Request = dict[str, Any]


@pytest.fixture
def paired(smallest: Request) -> Request:
    """Return the smallest request with a shipment."""
    smallest["options"] = {"search_iterations": 50, "time_limit": 60}
    smallest["shipments"] = [{
        "id": "s1", "amount": [1], "pickup": {"location": [3, 0]},
        "delivery": {"location": [1, 0], "service_duration": 60}}]
    return smallest


def fitted(client: httpx.Client, body: Request) -> dict[str, Any]:
    reply = client.post("/fit", json={"options": {"time_limit": 30}} | body)
    assert reply.status_code == 200, reply.text
    FitReply.model_validate(reply.json())
    return reply.json()


@pytest.mark.parametrize("in_parts", [False, True])
def test_a_whole_shipment_is_fitted_and_explained(client: httpx.Client, paired: Request,
                                                  in_parts: bool) -> None:
    paired["fleet"][0] |= {"count": 2, "costs": {"fixed": 5, "per_km": 1}}
    [shipment] = paired["shipments"]
    if in_parts:
        one, other = ({"id": name, "amount": [0.5], "location": place}
                      for name, place in (("farm", [3, 0]), ("mill", [3, 1])))
        shipment = {"id": "s1", "pickups": [one, other], "delivery": shipment["delivery"]}
    paired["shipments"] = []
    plan = client.post("/plan", json=paired).json()
    told = fitted(client, {"problem": paired, "plan": plan, "new_shipment": shipment, "count": 20})
    assert (told["customer"], told["shipment"], told["here"]) == (None, "s1", None)
    paired["shipments"] = [shipment]
    for place in told["places"]:
        assert [end["kind"] for end in place["ends"]][-1] == "delivery"
        assert {end.get("part") for end in place["ends"]} == (
            {None, "farm", "mill"} if in_parts else {None})
        assert all(end["arrival"] <= end["service_start"] for end in place["ends"])
        others = [each for each in plan["routes"] if each["vehicle"] != place["vehicle"]]
        whole = {"routes": [*others, place["route"]], "unassigned": []}
        checked = client.post("/check", json={"problem": paired, "plan": whole}).json()
        assert checked["feasible"] == place["feasible"], checked
        assert checked["cost"]["total"] == pytest.approx(
            plan["cost"]["total"] + place["cost"]["total"])
    costs = [place["cost"]["total"] for place in told["places"] if place["feasible"]]
    assert len(costs) > 3
    assert costs == sorted(costs)
    best = told["places"][0]
    planned = {"routes": [*[each for each in plan["routes"] if each["vehicle"] != best["vehicle"]],
                          best["route"]], "unassigned": []}
    ask = {"problem": paired, "plan": planned, "shipment": "s1"}
    again = fitted(client, ask | {"one_per_vehicle": True})
    assert again["here"]["saving"]["total"] == pytest.approx(best["cost"]["total"])
    assert again["here"]["ends"] == best["ends"]
    explained = client.post("/explain", json=ask).json()
    ExplainReply.model_validate(explained)
    kinds = {each["kind"]: each for each in explained["alternatives"]}
    assert {"vehicle", "unassigned"} <= kinds.keys()
    assert kinds["vehicle"]["vehicle"] != best["vehicle"]
    assert len(kinds["vehicle"]["ends"]) == len(best["ends"])
    assert kinds["vehicle"]["cost"]["total"] >= 0


def test_few_orders_of_many_pickups_are_tried(client: httpx.Client, paired: Request,
                                              monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = []

    def counted(some: Sequence[object]) -> Iterator[tuple[object, ...]]:
        for order in permutations(some):
            drawn.append(order)
            yield order

    monkeypatch.setattr(shipment_screening, "permutations", counted)
    [shipment] = paired["shipments"]
    paired["shipments"] = []
    plan = client.post("/plan", json=paired).json()
    many = {"id": "s1", "delivery": shipment["delivery"], "pickups": [
        {"id": str(number), "amount": [9], "location": [3, number]}
        for number in range(MOST_PICKUPS)]}
    told = fitted(client, {"problem": paired, "plan": plan, "new_shipment": many})["places"]
    assert not told[0]["feasible"]
    assert 0 < len(drawn) < 1000


def test_a_shipment_left_out_is_told_why_and_who_asks_wrongly_too(client: httpx.Client,
                                                                  paired: Request) -> None:
    paired["shipments"][0]["amount"] = [99]
    plan = client.post("/plan", json=paired).json()
    ask = {"problem": paired, "plan": plan}
    told = client.post("/explain", json=ask | {"shipment": "s1"}).json()
    ExplainReply.model_validate(told)
    assert (told["customer"], told["shipment"], told["here"]) == (None, "s1", None)
    assert [reason["code"] for reason in told["reasons"]] == ["CAPACITY"]
    assert {reason["code"] for each in told["alternatives"]
            for reason in each["reasons"]} == {"CAPACITY"}
    assert refused(client, ask | {"shipment": "s2"}, "/explain") == [
        ("UNKNOWN_SHIPMENT", "$.shipment")]
    assert refused(client, ask | {"shipment": "s1", "customer": "A"}, "/explain") == [
        ("UNKNOWN_FIELD", "$.shipment")]
    assert refused(client, ask | {"shipment": "s1", "customer": "A"}, "/fit") == [
        ("UNKNOWN_FIELD", "$.customer")]
    assert refused(client, ask, "/fit") == [("MISSING_FIELD", "$.customer")]
    assert refused(client, ask | {"shipment": "s2"}, "/fit") == [
        ("UNKNOWN_SHIPMENT", "$.shipment")]
    assert set(refused(client, ask | {"new_shipment": paired["shipments"][0] | {
        "amount": [1, 1]}}, "/fit")) >= {("DIMENSION_MISMATCH", "$.new_shipment.amount"),
                                         ("DUPLICATE_ID", "$.new_shipment.id")}
