"""Days under way without a depot, a vehicle or a type that the plan given has, over HTTP."""

import copy
from typing import Any

import httpx
import pytest

from tests.app.plans.test_task import halts, refused, replanned, street, tour, visit

__all__ = ["street", "tour"]

pytestmark = pytest.mark.slow

Request = dict[str, Any]


def in_the_afternoon(vehicle: str, kind: str, depot: str) -> dict[str, Any]:
    """Return a route that serves d and leaves at 600 s."""
    stops = [visit("depot", depot, 600, 600), visit("customer", "d", 840, 900),
             visit("depot", depot, 1140, 1140)]
    return {"vehicle": vehicle, "type": kind, "trips": [{"stops": stops}]}


@pytest.mark.parametrize("now", [None, 200])
@pytest.mark.parametrize(("vehicle", "kind", "depot"), [
    ("truck-2", "truck", "old"), ("truck-3", "truck", "hub"), ("van-1", "van", "hub"),
    ("van-1", "van", "old")])
def test_what_is_gone_is_dropped_where_it_has_not_begun(
        searching: httpx.Client, street: Request, tour: Request, vehicle: str, kind: str,
        depot: str, now: float | None) -> None:
    plan = {"routes": [in_the_afternoon(vehicle, kind, depot), *tour["routes"]], "unassigned": []}
    found = replanned(searching, street, plan=plan, freeze_before=now)
    assert found["status"] == "complete"
    assert {route["vehicle"] for route in found["routes"]} <= {"truck-1", "truck-2"}
    assert {stop["id"] for route in found["routes"] for trip in route["trips"]
            for stop in trip["stops"] if stop["kind"] == "depot"} == {"hub"}
    if now is not None:
        assert halts(found, "truck-1") == [
            [("hub", 0), ("a", 120), ("b", 240), ("c", 360), ("hub", 540)]]


@pytest.mark.parametrize(("vehicle", "kind", "depot", "code", "path"), [
    ("truck-2", "truck", "old", "UNKNOWN_DEPOT", "trips[0].stops[0].id"),
    ("truck-3", "truck", "hub", "UNKNOWN_VEHICLE", "vehicle"),
    ("van-1", "van", "hub", "UNKNOWN_VEHICLE_TYPE", "type")])
def test_what_is_gone_is_refused_where_it_has_begun(
        searching: httpx.Client, street: Request, tour: Request, vehicle: str, kind: str,
        depot: str, code: str, path: str) -> None:
    plan = tour | {"routes": [*tour["routes"], in_the_afternoon(vehicle, kind, depot)]}
    plan["unassigned"] = []
    assert refused(searching, street, plan=plan, freeze_before=600)[:1] == [
        (code, f".plan.routes[1].{path}")]


@pytest.mark.parametrize(("now", "is_bound"), [(200, False), (350, False), (365, True),
                                               (600, True)])
def test_depot_that_a_trip_ends_at_may_close_until_it_is_driven_to(
        searching: httpx.Client, street: Request, tour: Request, now: float,
        is_bound: bool) -> None:
    street["depots"].append({"id": "far", "location": [4, 0]})
    street["fleet"][0] |= {"max_trips": 2, "reload_depots": ["far"]}
    street["customers"].pop()
    stops = tour["routes"][0]["trips"][0]["stops"]
    stops[-1] = visit("depot", "far", 420, 420)
    tour["unassigned"] = []
    replanned(searching, street, plan=tour, freeze_before=now)
    street["depots"].pop()
    street["fleet"][0]["reload_depots"] = []
    if is_bound:
        assert refused(searching, street, plan=tour, freeze_before=now) == [
            ("UNKNOWN_DEPOT", ".plan.routes[0].trips[0].stops[4].id")]
    else:
        found = replanned(searching, street, plan=tour, freeze_before=now)
        assert halts(found, "truck-1")[0][-1] == ("hub", 540)


def test_route_of_a_type_that_is_gone_may_have_ended_at_a_customer(
        searching: httpx.Client, street: Request, tour: Request) -> None:
    gone = in_the_afternoon("van-1", "van", "hub")
    gone["trips"][0]["stops"].pop()
    plan = {"routes": [gone, *tour["routes"]], "unassigned": []}
    assert replanned(searching, street, plan=plan, freeze_before=200)["status"] == "complete"


def test_vehicle_that_is_gone_and_never_left_may_be_unavailable(
        searching: httpx.Client, street: Request, tour: Request) -> None:
    gone = in_the_afternoon("truck-3", "truck", "hub")
    plan = {"routes": [gone, *tour["routes"]], "unassigned": []}
    for names in ["truck-3"], ["truck-3/drone-1"], ["truck-3", "truck-1"]:
        replanned(searching, street, plan=plan, freeze_before=200, unavailable=names)
    assert refused(searching, street, plan=plan, freeze_before=200,
                   unavailable=["truck-4", "truck-3"]) == [("UNKNOWN_VEHICLE", ".unavailable[0]")]


def test_pin_to_a_vehicle_that_is_gone_is_refused(searching: httpx.Client, street: Request,
                                                  tour: Request) -> None:
    plan = tour | {"routes": [*tour["routes"], in_the_afternoon("truck-3", "truck", "hub")],
                   "unassigned": []}
    assert refused(searching, street, plan=plan, pinned=["d"]) == [
        ("UNKNOWN_VEHICLE", ".pinned[0]")]
    assert replanned(searching, street, plan=plan, pin_all=True)["status"] == "complete"


def test_what_can_not_have_been_is_told_where_it_is_stated_behind_a_route_that_is_gone(
        searching: httpx.Client, street: Request, tour: Request) -> None:
    street["fleet"][0]["drones"] = {"count": 1, "capacity": [9]}
    street["airspace"] = {"no_fly": [[[3.9, -0.1], [4.1, -0.1], [4.1, 0.1], [3.9, 0.1]]]}
    visits = [{"id": "d", "arrival": 70, "service_start": 70, "departure": 80}]
    route = copy.deepcopy(tour["routes"][0])
    route["trips"][0]["sorties"] = [{
        "drone": "truck-1/drone-1", "launch_stop": 1, "recovery_stop": 1, "launch_time": 60,
        "recovery_time": 120, "customers": visits}]
    street["customers"].append({"id": "e", "location": [1, 1], "demand": [1]})
    gone = in_the_afternoon("truck-3", "truck", "hub")
    gone["trips"][0]["stops"][1]["id"] = "e"
    plan = {"routes": [gone, route], "unassigned": []}
    assert set(refused(searching, street, plan=plan, freeze_before=100)) == {
        ("SETTLED_PART", ".plan.routes[1].trips[0].sorties[0]")}
