"""Who goes with whom, over HTTP and back."""

from collections.abc import Callable
from typing import Any

import httpx
import pytest

from app.schemas.explain import ExplainReply
from app.schemas.fit import FitReply
from app.schemas.response import PlanReply

Request = dict[str, Any]


@pytest.fixture
def related(smallest: Request) -> Request:
    """Return four customers, two at each end of a street, and trucks that hold two each."""
    smallest["options"] = {"search_iterations": 400, "time_limit": 60}
    smallest["fleet"][0] |= {"count": 2, "capacity": [2], "costs": {"per_km": 1.0}}
    smallest["customers"] = [{"id": name, "location": [x, 0], "demand": [1]}
                             for name, x in (("A", -9), ("B", -8), ("C", 8), ("D", 9))]
    return smallest


def vehicle_of(plan: dict[str, Any]) -> dict[str, str]:
    return {stop["id"]: route["vehicle"] for route in plan["routes"] for trip in route["trips"]
            for stop in trip["stops"] if stop["kind"] == "customer"}


@pytest.mark.parametrize(("relations", "pairs"), [
    ([], {"AB", "CD"}),
    ([{"kind": "together", "customers": ["A", "C"]}], {"AC", "BD"}),
    ([{"kind": "apart", "customers": ["A", "B"]},
      {"kind": "apart", "customers": ["A", "D"], "scope": "trip"}], {"AC", "BD"}),
])
def test_customers_go_with_whom_relations_say(service: httpx.Client, related: Request,
                                              relations: list[Any], pairs: set[str]) -> None:
    related["relations"] = relations
    plan = service.post("/plan", json=related).json()
    PlanReply.model_validate(plan)
    own = vehicle_of(plan)
    assert {"".join(sorted(each for each in own if own[each] == vehicle))
            for vehicle in own.values()} == pairs
    checked = service.post("/check", json={"problem": related, "plan": plan}).json()
    assert checked["feasible"], checked
    related["relations"] = [{"kind": "apart" if len(relations) == 1 else "together",
                             "customers": ["A", "C"] if len(relations) == 1 else ["A", "D"]}]
    checked = service.post("/check", json={"problem": related, "plan": plan}).json()
    assert [each["code"] for each in checked["violations"]] == ["RELATION"]


def half_planned(related: Request) -> Request:
    """Return what is asked where A goes with C, truck-1 serves B, and nobody all others."""
    related["relations"] = [{"kind": "together", "customers": ["A", "C"]}]
    related["customers"][1] |= {"vehicles": {"allowed": ["truck-1"]}}
    hub = {"kind": "depot", "id": related["depots"][0]["id"]}
    new = related["customers"].pop(0)
    return {"problem": related, "new_customer": new, "plan": {
        "routes": [{"vehicle": "truck-1", "type": "truck", "trips": [
            {"stops": [hub, {"kind": "customer", "id": "B"}, hub], "sorties": []}]}],
        "unassigned": [{"id": "D"}]}}


def test_who_is_left_out_fits_with_all_who_go_along(service: httpx.Client, related: Request
                                                    ) -> None:
    asked = half_planned(related)
    told = service.post("/fit", json=asked).json()
    FitReply.model_validate(told)
    # truck-1 has room for one of both, whom relations bind to be served by one vehicle.
    best, = told["places"]
    assert (best["vehicle"], best["companions"], best["cost"]["unassigned"]) == (
        "truck-2", ["C"], 0)
    assert best["cost"]["total"] == pytest.approx(34)
    assert vehicle_of({"routes": [best["route"]]}) == {"A": "truck-2", "C": "truck-2"}
    other, = told["others"]
    assert (other["vehicle"], other["companions"]) == ("truck-1", ["C"])
    assert [each["code"] for each in other["reasons"]] == ["CAPACITY"]
    # Nobody can be served with whom no vehicle has room for: then he fits alone.
    related["customers"][1]["demand"] = [3]
    told = service.post("/fit", json=asked).json()
    assert all(each["feasible"] and "companions" not in each for each in told["places"])


def test_who_is_served_goes_along_where_another_vehicle_serves_the_new_one(
        service: httpx.Client, related: Request) -> None:
    asked = half_planned(related)
    best, = service.post("/fit", json=asked).json()["places"]
    plan = asked["plan"]
    plan["routes"].append(best["route"])
    trip = best["route"]["trips"][0]
    trip["stops"] = [stop for stop in trip["stops"] if stop["id"] != "A"]
    told = service.post("/fit", json=asked | {"count": 9}).json()
    assert {(each["vehicle"], *each.get("companions", [])) for each in told["places"]} == {
        ("truck-2",)}
    related["fleet"][0]["count"] += 1
    plan["unassigned"].clear()
    trip["stops"].insert(1, {"kind": "customer", "id": "D"})
    for stop in trip["stops"]:
        stop.pop("arrival", None)
    best, = service.post("/fit", json=asked).json()["places"]
    assert (best["vehicle"], best["companions"], best["cost"]["total"]) == (
        "truck-3", ["C"], pytest.approx(34))


def test_other_vehicles_are_told_of_with_all_who_go_together(service: httpx.Client,
                                                             related: Request) -> None:
    related["relations"] = [{"kind": "together", "customers": ["A", "C"]}]
    plan = service.post("/plan", json=related).json()
    asked = {"problem": related, "plan": plan, "customer": "A"}
    told = service.post("/explain", json=asked).json()
    ExplainReply.model_validate(told)
    moved, = [each for each in told["alternatives"] if each["kind"] == "vehicle"]
    assert (moved["companions"], moved["vehicle"] != vehicle_of(plan)["A"]) == (["C"], True)
    # There is room for two on each, and B and D stay.
    assert {each["code"] for each in moved["reasons"]} == {"CAPACITY"}
    related["fleet"][0]["capacity"] = [4]
    told = service.post("/explain", json=asked).json()
    moved, = [each for each in told["alternatives"] if each["kind"] == "vehicle"]
    assert (moved["companions"], moved["feasible"]) == (["C"], True)


def test_who_is_left_out_by_a_relation_is_told_which(service: httpx.Client,
                                                     related: Request) -> None:
    related["relations"] = [{"kind": "together", "customers": ["A", "C", "D"]},
                            {"kind": "apart", "customers": ["B", "C"]}]
    related["customers"][3]["demand"] = [2]
    plan = service.post("/plan", json=related).json()
    left, = plan["unassigned"]
    own = vehicle_of(plan)
    reason, = left["reasons"]
    assert reason["code"] == "RELATION"
    assert left["id"] == "D"
    assert set(own) == {"A", "B", "C"}
    assert own["A"] == own["C"] != own["B"]
    assert reason["message"] == (f"It is to be served together with A and C, which {own['A']} "
                                 "serves, and has no room for it.")
    asked = {"problem": related, "plan": plan, "customer": "D"}
    assert service.post("/explain", json=asked).status_code == 200


def test_who_is_kept_apart_from_all_asks_for_one_vehicle_more(service: httpx.Client,
                                                              related: Request) -> None:
    related["relations"] = [{"kind": "apart", "customers": ["A", "B", "C"]}]
    plan = service.post("/plan", json=related).json()
    left, = plan["unassigned"]
    assert [(each["code"], each["remedy"]) for each in left["reasons"]] == [
        ("RELATION", "fits with one more vehicle of truck")]
    related["fleet"][0]["count"] += 1
    assert service.post("/plan", json=related).json()["unassigned"] == []


@pytest.mark.parametrize(("relations", "errors"), [
    ([{"kind": "together", "customers": ["A", "X", "A"]}],
     [("UNKNOWN_CUSTOMER", "$.relations[0].customers[1]"),
      ("DUPLICATE_ID", "$.relations[0].customers[2]")]),
    ([{"kind": "together", "customers": ["A", "B", "C"]},
      {"kind": "apart", "customers": ["D", "C", "B"]}], [("CONTRADICTION", "$.relations[0]")]),
    ([{"kind": "together", "customers": ["A", "B"], "scope": "trip"},
      {"kind": "apart", "customers": ["A", "B"], "scope": "trip"}],
     [("CONTRADICTION", "$.relations[0]")]),
    ([{"kind": "together", "customers": ["A", "E/locker"]}],
     [("UNKNOWN_CUSTOMER", "$.relations[0].customers[1]")]),
    ([{"kind": "together", "customers": ["s/pickup", "s/delivery"]}],
     [("WRONG_LENGTH", "$.relations[0].customers")]),
    ([{"kind": "before", "customers": ["s/delivery", "A", "s/pickup"]}],
     [("CONTRADICTION", "$.relations[0].customers[2]")]),
    ([{"kind": "apart", "customers": ["s/delivery", "A"]},
      {"kind": "before", "customers": ["A", "s/pickup"]}], [("CONTRADICTION", "$.relations[1]")]),
    ([{"kind": "before", "customers": ["A", "B"]}, {"kind": "before", "customers": ["B", "A"]}],
     [("CONTRADICTION", "$.relations[1]")]),
    ([{"kind": "before", "customers": ["A", "B"], "min_lag": 9, "max_lag": 8}],
     [("OUT_OF_RANGE", "$.relations[0].max_lag")]),
    ([{"kind": "before", "customers": ["A", "B"], "same_vehicle": False, "scope": "trip"}],
     [("RELATION_WITH", "$.relations[0].scope")]),
    ([{"kind": "before", "customers": ["A", "F"], "same_vehicle": False}],
     [("RELATION_WITH", "$.relations[0].customers[1]")]),
    ([{"kind": "apart", "customers": ["A", "B"], "min_lag": 5}],
     [("RELATION_WITH", "$.relations[0].min_lag")]),
    ([{"kind": "apart", "customers": ["A", "B"]}] * 63, [("WRONG_LENGTH", "$.relations")]),
])
def test_relations_that_make_no_sense_are_refused(client: httpx.Client, related: Request,
                                                  relations: list[Any],
                                                  errors: list[tuple[str, str]]) -> None:
    related["relations"] = relations
    related["customers"].append({"id": "E", "location": [0, 1], "demand": [1], "alternatives": [
        {"id": "locker", "location": [0, 2]}]})
    related["customers"].append({"id": "F", "location": [0, 3], "demand": [1],
                                 "served_by": "drone"})
    related["shipments"] = [{"id": "s", "amount": [1], "pickup": {"location": [3, 0]},
                             "delivery": {"location": [1, 0]}}]
    told = client.post("/plan", json=related).json()["errors"]
    assert [(each["code"], each["path"]) for each in told] == errors


def test_one_vehicle_may_serve_apart_on_two_trips(service: httpx.Client,
                                                  related: Request) -> None:
    related["relations"] = [
        {"kind": "together", "customers": ["A", "B"]},
        {"kind": "apart", "customers": ["A", "B"], "scope": "trip"}]
    related["fleet"][0] |= {"count": 1, "max_trips": 4}
    plan = service.post("/plan", json=related).json()
    assert plan["unassigned"] == []
    trips = [{stop["id"] for stop in trip["stops"]} for trip in plan["routes"][0]["trips"]]
    assert not any({"A", "B"} <= each for each in trips)


@pytest.mark.parametrize(("lags", "waits"), [
    ({}, 0), ({"min_lag": 7200, "max_lag": 7200}, 7200), ({"min_lag": 10, "scope": "trip"}, 0)])
def test_customers_are_served_in_the_order_that_is_stated(
        service: httpx.Client, related: Request, lags: dict[str, Any], waits: int) -> None:
    related["relations"] = [{"kind": "before", "customers": ["D", "A"], **lags}]
    related["fleet"][0] |= {"count": 1, "capacity": [4], "costs": {"per_km": 1, "per_hour": 1}}
    plan = service.post("/plan", json=related).json()
    assert plan["unassigned"] == []
    trip, = plan["routes"][0]["trips"]
    start = {stop["id"]: stop["service_start"] for stop in trip["stops"][1:-1]}
    # Whoever has to wait does so at A: B lies on the way there or back.
    assert (start["A"] - start["D"] == waits) if waits else (start["A"] > start["D"])
    checked = service.post("/check", json={"problem": related, "plan": plan}).json()
    assert checked["feasible"], checked
    related["relations"] = [{"kind": "before", "customers": ["A", "D"]}]
    checked = service.post("/check", json={"problem": related, "plan": plan}).json()
    assert {each["code"] for each in checked["violations"]} >= {"RELATION"}


def test_any_vehicles_serve_an_order_and_wait_for_each_other(
        service: httpx.Client, related: Request) -> None:
    order = {"kind": "before", "customers": ["A", "D"], "same_vehicle": False,
             "min_lag": 3600, "max_lag": 3600}
    related["relations"] = [order]
    related["customers"][3]["time_window"] = {"earliest": 1, "latest": 5400}
    plan = service.post("/plan", json=related).json()
    assert plan["unassigned"] == []
    own = vehicle_of(plan)
    assert own["A"] == own["B"] != own["C"] == own["D"]
    start = {stop["id"]: stop["service_start"] for route in plan["routes"]
             for trip in route["trips"] for stop in trip["stops"]}
    assert start["D"] - start["A"] == 3600
    checked = service.post("/check", json={"problem": related, "plan": plan}).json()
    assert checked["feasible"], checked
    for change, code in (({"min_lag": 3601, "max_lag": 3700}, "RELATION"),
                         ({"customers": ["D", "A"]}, "RELATION")):
        related["relations"] = [order | change]
        checked = service.post("/check", json={"problem": related, "plan": plan}).json()
        assert [each["code"] for each in checked["violations"]] == [code]


@pytest.mark.parametrize("same_vehicle", [True, False])
def test_an_order_holds_wherever_customers_are_served(
        service: httpx.Client, related: Request, same_vehicle: bool) -> None:
    related["customers"][3]["alternatives"] = [{"id": "locker", "location": [-8, 1]}]
    related["relations"] = [{"kind": "before", "customers": ["D", "B"], "min_lag": 3600,
                             "same_vehicle": same_vehicle}]
    plan = service.post("/plan", json=related).json()
    assert plan["unassigned"] == []
    served = {stop["id"]: stop for route in plan["routes"] for trip in route["trips"]
              for stop in trip["stops"]}
    # Where any truck may, one that serves C does, too.
    assert ("alternative" in served["D"]) == same_vehicle
    assert served["B"]["service_start"] - served["D"]["service_start"] >= 3600
    checked = service.post("/check", json={"problem": related, "plan": plan}).json()
    assert checked["feasible"], checked
    related["relations"][0]["customers"] = ["B", "D"]
    checked = service.post("/check", json={"problem": related, "plan": plan}).json()
    assert {each["code"] for each in checked["violations"]} >= {"RELATION"}


@pytest.mark.parametrize("same_vehicle", [True, False])
def test_who_must_be_served_is_however_long_that_takes(
        service: httpx.Client, related: Request, same_vehicle: bool) -> None:
    related["fleet"][0] |= {"count": 1, "capacity": [4], "costs": {"per_hour": 50}}
    related["relations"] = [{"kind": "before", "customers": ["A", "B", "D"], "min_lag": 360_000,
                             "same_vehicle": same_vehicle}]
    plan = service.post("/plan", json=related).json()
    assert plan["unassigned"] == []


def test_whom_others_keep_from_his_place_in_an_order_is_told_so(
        service: httpx.Client, related: Request) -> None:
    related["relations"] = [{"kind": "before", "customers": ["A", "D"], "same_vehicle": False,
                             "min_lag": 7200}]
    related["customers"][0]["unassigned_cost"] = 9000
    related["customers"][3] |= {"time_window": {"earliest": 0, "latest": 7200},
                                "unassigned_cost": 100}
    # Where being late costs, whoever is served anyhow isn't bound by any end.
    related["customers"][1] |= {"time_window": {"latest": 60, "late_cost_per_hour": 1},
                                "unassigned_cost": 0.01}
    related["relations"].append({"kind": "before", "customers": ["C", "B"], "same_vehicle": False})
    plan = service.post("/plan", json=related).json()
    left = plan["unassigned"][-1]
    assert left["id"] == "D"
    assert [(each["code"], each["message"]) for each in left["reasons"]] == [
        ("RELATION", "truck can't serve it in its order with A, as the plan serves these.")]
    asked = {"problem": related, "plan": plan, "customer": "D"}
    assert service.post("/explain", json=asked).status_code == 200
    related["relations"][0]["min_lag"] = 3600
    fits = service.post("/fit", json={"problem": related, "plan": plan, "customer": "D"}).json()
    assert fits["places"], fits


@pytest.mark.parametrize("same_vehicle", [True, False])
def test_who_was_served_holds_back_whom_an_order_puts_behind(
        service: httpx.Client, related: Request, same_vehicle: bool) -> None:
    order = {"kind": "before", "customers": ["A", "B", "C"], "min_lag": 5400,
             "same_vehicle": same_vehicle}
    late, related["customers"] = related["customers"][2], related["customers"][:2]
    related["fleet"][0] |= {"max_trips": 2, "costs": {"per_km": 1, "per_hour": 1}}
    plan = service.post("/plan", json=related | {"relations": [
        order | {"customers": ["A", "B"]}]}).json()
    before = _stops(plan)
    begun = before["A"]["service_start"]
    related["replan"] = {"plan": plan, "freeze_before": before["A"]["departure"]}
    related["customers"].append(late)
    related["relations"] = [order | {"min_lag": 7200}]
    later = service.post("/plan", json=related).json()
    assert later["unassigned"] == []
    found, own = _stops(later), vehicle_of(later)
    assert found["A"] == before["A"]
    assert found["B"]["service_start"] == begun + 7200
    assert found["C"]["service_start"] >= begun + 14400
    assert (own["A"] == own["C"]) >= same_vehicle
    checked = service.post("/check", json={"problem": related, "plan": later}).json()
    assert checked["feasible"], checked
    # Whoever was to come first can't any more.
    related["relations"] = [order | {"customers": ["C", "A"]}]
    left, = service.post("/plan", json=related).json()["unassigned"]
    assert left["id"] == "C"
    assert left["reasons"][0]["code"] == "RELATION"


def _stops(plan: dict[str, Any]) -> dict[str, Any]:
    return {stop["id"]: stop for route in plan["routes"] for trip in route["trips"]
            for stop in trip["stops"]}


@pytest.mark.parametrize(("relation", "holds"), [
    ({"kind": "together", "customers": ["D", "s/delivery"]},
     lambda own, start: own["D"] == own["s/pickup"]),
    ({"kind": "apart", "customers": ["A", "s/delivery"]},
     lambda own, start: own["A"] != own["s/pickup"]),
    ({"kind": "before", "customers": ["s/delivery", "A"], "min_lag": 600},
     lambda own, start: start["A"] - start["s/delivery"] >= 600),
    ({"kind": "before", "customers": ["A", "s/pickup"], "same_vehicle": False},
     lambda own, start: start["A"] <= start["s/pickup"]),
    ({"kind": "before", "customers": ["s/pickup", "s/delivery"], "min_lag": 3600},
     lambda own, start: start["s/delivery"] - start["s/pickup"] >= 3600)])
def test_ends_of_shipments_go_with_whom_relations_say(
        service: httpx.Client, related: Request, relation: dict[str, Any],
        holds: Callable[[dict[str, str], dict[str, float]], bool]) -> None:
    related["shipments"] = [{"id": "s", "amount": [1], "pickup": {"location": [-9, 1]},
                             "delivery": {"location": [-7, 1]}}]
    related["fleet"][0]["max_trips"] = 3
    related["relations"] = [relation]
    plan = service.post("/plan", json=related).json()
    assert plan["unassigned"] == []
    own, start = dict[str, str](), dict[str, float]()
    for route in plan["routes"]:
        for stop in (stop for trip in route["trips"] for stop in trip["stops"][1:-1]):
            name = stop["id"] if stop["kind"] == "customer" else f"s/{stop['kind']}"
            own[name], start[name] = route["vehicle"], stop["service_start"]
    assert holds(own, start)
    checked = service.post("/check", json={"problem": related, "plan": plan}).json()
    assert checked["feasible"], checked


@pytest.mark.parametrize("sites", [True, False])
def test_drivers_who_rest_keep_orders_beside_stops_for_drones(
        service: httpx.Client, related: Request, sites: bool) -> None:
    related["fleet"][0] |= {"driving_rules": {"preset": "eu-561"}, "revisits": not sites}
    related["launch_sites"] = [{"id": "L", "location": [1, 1]}] if sites else []
    related["fleet"][0]["drones"] = {"count": 1, "capacity": [1], "speed_kmh": 60}
    related["relations"] = [{"kind": "before", "customers": ["A", "B"]}]
    plan = service.post("/plan", json=related).json()
    assert plan["status"] == "complete"
    assert service.post("/check", json={"problem": related, "plan": plan}).json()["feasible"]
