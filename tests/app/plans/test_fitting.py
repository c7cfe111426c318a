"""Where customers fit best, and plans whose times are left out, over HTTP."""

from collections.abc import Iterator
from random import Random
from typing import Any

import httpx
import pytest

from app.schemas.fit import FitReply
from tests.app.plans.asking import documented, judged, planned, refused
from tests.seeds import seeds

Request = dict[str, Any]


@pytest.fixture
def asked() -> Request:
    """Return the documented example: two trucks and a new customer."""
    return documented("fit")


def fitted(client: httpx.Client, body: Request) -> dict[str, Any]:
    """Return the service's reply."""
    reply = client.post("/fit", json={"options": {"time_limit": 30}} | body)
    assert reply.status_code == 200, reply.text
    FitReply.model_validate(reply.json())
    return reply.json()


def untimed(plan: Request) -> Request:
    """Return a plan's decisions without any time."""
    return {"routes": [
        {"vehicle": route["vehicle"], "type": route["type"], "trips": [
            {"stops": [{"kind": stop["kind"], "id": stop["id"]} for stop in trip["stops"]],
             "sorties": [
                 {name: sortie[name] for name in ("drone", "launch_stop", "recovery_stop")}
                 | {"customers": [{"id": visit["id"]} for visit in sortie["customers"]]}
                 for sortie in trip["sorties"]]}
            for trip in route["trips"]]}
        for route in plan["routes"]],
        "unassigned": [{"id": each["id"]} for each in plan["unassigned"]]}


def problem_of(seed: int) -> Request:
    """Return a tiny problem with windows, and one customer more than its plan is made for."""
    random = Random(seed)
    customers = [
        {"id": str(number), "location": [random.randint(-9, 9), random.randint(-9, 9)],
         "demand": [random.randint(1, 4)], "service_duration": 60,
         "time_window": {"earliest": random.randint(0, 900), "latest": random.randint(1800, 4800)}}
        for number in range(6)]
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
            "customers": customers,
            "fleet": [{"id": "truck", "count": 3, "capacity": [9], "speed_kmh": 60,
                       "costs": {"fixed": 3, "per_km": 1, "per_hour": 20}}]}


def charging(seed: int) -> Request:
    """Return a problem of a drone that is charged between two flights, with an odd load."""
    random = Random(seed)
    customers = [{"id": str(number), "location": [random.randint(-9, 9), random.randint(-9, 9)],
                  "demand": [round(random.uniform(0.1, 2), 2)], "service_duration": 60,
                  "served_by": "drone" if number < 3 else "truck"} for number in range(6)]
    energy = {"battery_wh": 15, "kg_per_unit": 0.3,
              "power": {"cruise_w": 33.3333, "cruise_w_per_kg": 7.77}}
    return {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
            "customers": customers,
            "fleet": [{"id": "truck", "count": 3, "capacity": [9], "speed_kmh": 60, "drones": {
                "count": 1, "capacity": [50], "speed_kmh": 60, "energy": energy,
                "turnaround": {"charge_w": 50, "swap_duration": 0}}}]}


@pytest.mark.parametrize("seed", seeds(15))
def test_route_beside_those_of_charged_drones_is_a_plan(client: httpx.Client, seed: int) -> None:
    whole = charging(seed)
    *others, new = whole["customers"]
    problem = whole | {"customers": others}
    plan = planned(client, problem)
    for place in fitted(client, {"problem": problem, "plan": plan, "new_customer": new})["places"]:
        route = place["route"]
        routes = [one for one in plan["routes"] if one["vehicle"] != route["vehicle"]]
        verdict = judged(client, whole, plan | {"routes": [*routes, route]})
        assert [item["code"] for item in verdict["violations"]
                if item["code"] == "TIME_MISMATCH"] == []


def every_place(plan: Request, name: str) -> Iterator[Request]:
    """Yield a plan with a customer at each place of the trucks, and alone with one more."""
    stop = {"kind": "customer", "id": name}
    hub = {"kind": "depot", "id": "hub"}
    for index, route in enumerate(plan["routes"]):
        stops = untimed(plan)["routes"][index]["trips"][0]["stops"]
        for place in range(1, len(stops)):
            trip = {"stops": [*stops[:place], stop, *stops[place:]]}
            yield {"routes": [*plan["routes"][:index],
                              {"vehicle": route["vehicle"], "type": "truck", "trips": [trip]},
                              *plan["routes"][index + 1:]]}
    if len(plan["routes"]) < 3:
        name = f"truck-{len(plan['routes']) + 1}"
        yield {"routes": [*plan["routes"], {"vehicle": name, "type": "truck",
                                            "trips": [{"stops": [hub, stop, hub]}]}]}


@pytest.mark.parametrize("seed", range(6))
def test_the_best_place_is_the_cheapest_of_all(client: httpx.Client, seed: int) -> None:
    problem = problem_of(seed)
    new = problem["customers"][-1]
    fewer = problem | {"customers": problem["customers"][:-1]}
    plan = planned(client, fewer)
    assert plan["status"] == "complete"
    told = fitted(client, {"problem": fewer, "plan": plan, "new_customer": new, "count": 20,
                           "options": {"time_limit": 10}})
    assert told["complete"]
    tried = [judged(client, problem, each) for each in every_place(plan, new["id"])]
    costs = sorted(each["cost"]["total"] for each in tried if each["feasible"])
    assert [place["cost"]["total"] + plan["cost"]["total"] for place in told["places"]
            ] == pytest.approx(costs)
    assert all(place["feasible"] and not place["reasons"] for place in told["places"])
    taken = told["places"][0]["route"]
    routes = [route for route in plan["routes"] if route["vehicle"] != taken["vehicle"]]
    verdict = judged(client, problem, {"routes": [*routes, taken]})
    assert verdict["feasible"]
    assert verdict["cost"]["total"] == pytest.approx(costs[0])


def test_the_documented_example_says_who_can_and_why_others_cannot(client: httpx.Client,
                                                                   asked: Request) -> None:
    told = fitted(client, asked)
    assert (told["customer"], told["here"], told["complete"]) == ("D", None, True)
    assert [(place["vehicle"], place["cost"]["total"]) for place in told["places"]] == [
        ("truck-2", pytest.approx(2)), ("truck-2", pytest.approx(2))]
    (other,) = told["others"]
    assert (other["vehicle"], other["feasible"]) == ("truck-1", False)
    assert {reason["code"] for reason in other["reasons"]} == {"CAPACITY"}


def test_each_vehicle_is_told_once_if_that_is_asked_for(client: httpx.Client,
                                                        asked: Request) -> None:
    asked["problem"]["fleet"][0] |= {"count": 4, "max_trips": 2}
    told = fitted(client, asked | {"one_per_vehicle": True})
    vehicles = [place["vehicle"] for place in told["places"]]
    # Of those that stay at home, one; truck-1, which is full, on a trip of its own.
    assert sorted(vehicles) == ["truck-1", "truck-2", "truck-3"]
    costs = [place["cost"]["total"] for place in told["places"]]
    assert costs == sorted(costs)
    assert all(place["feasible"] for place in told["places"])
    own = {place["vehicle"]: place["position"]["own_trip"] for place in told["places"]}
    assert own["truck-1"]


def test_each_vehicle_is_told_once_if_companions_may_move_too(client: httpx.Client,
                                                              asked: Request) -> None:
    """A is on truck-1, and nobody has room for D: truck-2 for neither with A nor without."""
    asked["problem"]["relations"] = [{"kind": "together", "customers": ["A", "D"]}]
    asked["new_customer"]["demand"] = [16]
    told = fitted(client, asked | {"one_per_vehicle": True})
    assert sorted(place["vehicle"] for place in told["places"]) == ["truck-1", "truck-2"]


@pytest.mark.parametrize("one_per_vehicle", [False, True])
def test_a_customer_of_several_places_is_put_at_each(client: httpx.Client, asked: Request,
                                                     one_per_vehicle: bool) -> None:
    home = fitted(client, asked | {"count": 20})["places"]
    own = min(place["cost"]["total"] for place in home)
    asked["new_customer"]["alternatives"] = [
        {"id": "desk", "location": asked["problem"]["depots"][0]["location"], "cost": 0.5},
        {"id": "far", "location": [90, 90]}]
    told = fitted(client, asked | {"count": 20, "one_per_vehicle": one_per_vehicle})
    first = told["places"][0]
    assert (first["alternative"], first["cost"]["total"]) == ("desk", pytest.approx(0.5))
    if one_per_vehicle:
        vehicles = [place["vehicle"] for place in told["places"]]
        assert len({*vehicles}) == len(vehicles)
    else:
        assert {place.get("alternative") for place in told["places"]} == {None, "desk", "far"}
        assert own == pytest.approx(min(place["cost"]["total"] for place in told["places"]
                                        if "alternative" not in place))
    problem = asked["problem"] | {
        "customers": [*asked["problem"]["customers"], asked["new_customer"]]}
    routes = [route for route in asked["plan"]["routes"] if route["vehicle"] != first["vehicle"]]
    plan = {"routes": [*routes, first["route"]]}
    verdict = judged(client, problem, plan)
    assert verdict["feasible"]
    assert verdict["cost"]["total"] == pytest.approx(told["cost"]["total"] + 0.5)
    again = fitted(client, {"problem": problem, "plan": plan, "customer": "D", "count": 20,
                            "one_per_vehicle": one_per_vehicle})
    assert again["here"]["alternative"] == "desk"
    assert again["here"]["saving"]["total"] == pytest.approx(0.5)
    if not one_per_vehicle:
        assert own == pytest.approx(min(place["cost"]["total"] for place in again["places"]
                                        if "alternative" not in place))


def test_customers_of_the_plan_are_put_elsewhere_or_on_drones(client: httpx.Client) -> None:
    example = documented("explain")
    body = {"problem": example["problem"], "plan": example["plan"], "customer": "C", "count": 20}
    told = fitted(client, body)
    assert told["here"]["by"] == "drone"
    assert told["here"]["saving"]["total"] == pytest.approx(4 * 0.25)
    (truck,) = [place for place in told["places"] if place["position"]["after"] == "B"
                and place["by"] == "truck"]
    # From B to C and home from there, by truck.
    assert truck["cost"]["total"] == pytest.approx(2 + 40 ** 0.5 - 6)
    assert {place["by"] for place in told["places"]} == {"truck", "drone"}


def test_rules_that_the_plan_breaks_already_forbid_no_place(client: httpx.Client,
                                                            asked: Request) -> None:
    asked["problem"]["customers"][0]["time_window"] = {"latest": 1}
    before = fitted(client, asked)
    assert [place["vehicle"] for place in before["places"]] == ["truck-2", "truck-2"]
    assert all(place["feasible"] for place in before["places"])


def test_if_no_place_is_allowed_the_least_wrong_are_told(client: httpx.Client,
                                                         asked: Request) -> None:
    asked["new_customer"]["demand"] = [16]
    told = fitted(client, asked)
    assert len(told["places"]) == 3
    for place in told["places"]:
        assert (place["feasible"], place["reasons"][0]["code"]) == (False, "CAPACITY")


def test_what_is_asked_for_wrongly_is_refused(client: httpx.Client, asked: Request) -> None:
    assert refused(client, asked | {"customer": "A"}, "/fit") == [("UNKNOWN_FIELD", "$.customer")]
    assert refused(client, asked | {"new_customer": None}, "/fit") == [
        ("MISSING_FIELD", "$.customer")]
    assert refused(client, asked | {"customer": "nobody", "new_customer": None}, "/fit") == [
        ("UNKNOWN_CUSTOMER", "$.customer")]
    assert refused(client, asked | {"options": {"time_limit": 1e5}}, "/fit") == [
        ("OUT_OF_RANGE", "$.options.time_limit")]
    wrong = asked | {"new_customer": asked["new_customer"] | {"id": "A", "demand": [1, 1]}}
    assert {path for _, path in refused(client, wrong, "/fit")} == {
        "$.new_customer.id", "$.new_customer.demand"}
    asked["plan"]["routes"][0]["trips"][0]["stops"].pop()
    assert ("ILLEGAL_PLAN", "$.plan.routes[0].trips[0].stops[2]") in refused(client, asked, "/fit")


def test_a_plan_of_decisions_alone_is_timed(client: httpx.Client, with_drones: Request) -> None:
    plan = planned(client, with_drones)
    verdict = judged(client, with_drones, untimed(plan))
    assert verdict["feasible"]
    assert verdict["summary"]["served"] == plan["summary"]["served"]
    again = judged(client, with_drones, {"routes": verdict["routes"],
                                         "unassigned": plan["unassigned"]})
    assert again == {name: value for name, value in verdict.items() if name != "routes"}


def test_only_vehicles_without_times_are_timed_anew(client: httpx.Client, asked: Request) -> None:
    problem = asked["problem"]
    first = judged(client, problem, asked["plan"])["routes"]
    for stop in first[0]["trips"][0]["stops"]:
        for name in ("arrival", "service_start", "departure"):
            stop[name] += 600
    swapped = untimed({"routes": first, "unassigned": []})["routes"][1]
    verdict = judged(client, problem, {"routes": [first[0], swapped]})
    assert verdict["routes"] == first
    stated = swapped["trips"][0]["stops"]
    stated[0]["arrival"] = 7200
    assert [stop["arrival"] for stop in judged(client, problem, {"routes": [first[0], swapped]})[
        "routes"][1]["trips"][0]["stops"]] in ([0, 300, 660], [7200, 7500, 7860])


def test_routes_that_make_no_sense_are_null(client: httpx.Client, asked: Request) -> None:
    asked["plan"]["routes"][1]["trips"][0]["stops"].pop()
    verdict = judged(client, asked["problem"], asked["plan"])
    assert not verdict["feasible"]
    assert [route is None for route in verdict["routes"]] == [False, True]


def test_what_has_happened_is_told_where_it_is_changed(client: httpx.Client,
                                                       with_drones: Request) -> None:
    plan = planned(client, with_drones)
    first = plan["routes"][0]["trips"][0]["stops"][1]
    problem = with_drones | {"replan": {"plan": plan, "freeze_before": first["departure"]}}
    plan = planned(client, problem)
    assert judged(client, problem, untimed(plan))["feasible"]
    del plan["routes"][0]["trips"][0]["stops"][1]
    for sortie in plan["routes"][0]["trips"][0]["sorties"]:
        sortie["launch_stop"] = sortie["recovery_stop"] = 0
    codes = {item["code"] for item in judged(client, problem, untimed(plan))["violations"]}
    assert {"FROZEN", "MISSING"} <= codes
    assert "TIME_MISMATCH" not in codes


def test_who_was_served_fits_nowhere_else(client: httpx.Client) -> None:
    problem = problem_of(0)
    plan = planned(client, problem)
    served = plan["routes"][0]["trips"][0]["stops"][1]
    problem |= {"replan": {"plan": plan, "freeze_before": served["departure"]}}
    found = fitted(client, {"problem": problem, "plan": plan, "customer": served["id"]})
    elsewhere = [place for place in found["places"] + found["others"]
                 if place["vehicle"] != plan["routes"][0]["vehicle"]]
    assert elsewhere
    assert all("FROZEN" in {reason["code"] for reason in place["reasons"]} for place in elsewhere)


def test_vehicle_that_a_plan_states_twice_goes_on_with_its_first_route(
        client: httpx.Client) -> None:
    whole = problem_of(0)
    whole["customers"][0] |= {"max_time_aboard": 3600}
    plan = {"routes": [{"vehicle": "truck-1", "type": "truck", "trips": [{"stops": [
        {"kind": kind, "id": name} for kind, name in (
            ("depot", "hub"), *(("customer", each) for each in names), ("depot", "hub"))],
        "sorties": []}]} for names in ("1", "2345")], "unassigned": [{"id": "0"}]}
    found = fitted(client, {"problem": whole, "plan": plan, "customer": "0"})
    assert {each["vehicle"] for each in found["places"]} <= {"truck-1", "truck-2"}
