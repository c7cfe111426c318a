"""Vehicles that break down, and drones that are lost, over HTTP."""

import copy
from typing import Any

import httpx
import pytest

from app.schemas.response import PlanReply
from tests.app.plans.asking import judged

Request = dict[str, Any]


@pytest.fixture
def street() -> Request:
    """Return three customers along a street, a kilometre and a minute apart, and two vans."""
    return {
        "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": name, "location": [place, 0], "demand": [1], "service_duration": 60}
                      for place, name in enumerate("abc", 1)],
        "fleet": [{"id": "van", "count": 2, "capacity": [10], "speed_kmh": 60}],
        "options": {"time_limit": 60, "search_iterations": 40},
    }


def plan_of(*stops: tuple[str, str, float, float], **trip: Any) -> Request:
    """Return a plan of one trip of the first van, by kind, id, arrival and departure."""
    told = [{"kind": kind, "id": name, "arrival": arrival, "service_start": arrival,
             "departure": departure} for kind, name, arrival, departure in stops]
    return {"routes": [{"vehicle": "van-1", "type": "van", "trips": [{"stops": told, **trip}]}]}


TOUR = plan_of(("depot", "hub", 0, 0), ("customer", "a", 60, 120), ("customer", "b", 180, 240),
               ("customer", "c", 300, 360), ("depot", "hub", 540, 540))


def replanned(client: httpx.Client, request: Request, plan: Request, now: float,
              **terms: Any) -> Request:
    """Return the plan that goes on, which the service has to find feasible at the same cost."""
    body = request | {"replan": {"plan": plan, "freeze_before": now, **terms}}
    reply = client.post("/plan", json=body)
    assert reply.status_code == 200, reply.text
    found: Request = reply.json()
    PlanReply.model_validate(found)
    verdict = judged(client, body, found)
    assert (verdict["violations"], verdict["cost"]) == ([], pytest.approx(found["cost"]))
    return found


def times(plan: Request, vehicle: str) -> list[tuple[str, float, float]]:
    """Return the stops of a vehicle's only trip: id, arrival and departure."""
    (trips,) = [route["trips"] for route in plan["routes"] if route["vehicle"] == vehicle]
    (trip,) = trips
    return [(stop["id"], stop["arrival"], stop["departure"]) for stop in trip["stops"]]


def test_reply_tells_from_where_parcels_of_a_broken_vehicle_come(searching: httpx.Client,
                                                                 street: Request) -> None:
    plan = replanned(searching, street, TOUR, 150, unavailable=["van-1"], parcels_back=500)
    assert plan["replan"]["parcels"] == [
        {"id": name, "vehicle": "van-1", "back": 500, "depot": "hub", "by": "van-2"}
        for name in "bc"]
    street["fleet"][0]["count"] = 1
    alone = replanned(searching, street, TOUR, 150, unavailable=["van-1"])
    assert alone["replan"]["parcels"] == [
        {"id": name, "vehicle": "van-1", "back": 150, "depot": None, "by": None} for name in "bc"]


@pytest.mark.parametrize("now", [30, 130, 200, 250, 310])
def test_others_bring_a_shipment_that_a_broken_vehicle_has_fetched(
        searching: httpx.Client, street: Request, now: float) -> None:
    places = {name: {"location": [place, 0], "service_duration": 60}
              for place, name in ((2, "pickup"), (3, "delivery"))}
    street |= {"customers": street["customers"][:1],
               "shipments": [{"id": "s1", "amount": [2], **places}]}
    tour = plan_of(("depot", "hub", 0, 0), ("customer", "a", 60, 120), ("pickup", "s1", 180, 240),
                   ("delivery", "s1", 300, 360), ("depot", "hub", 540, 540))
    terms = {"unavailable": ["van-1"], "parcels_back": 800}
    plan = replanned(searching, street, tour, now, **terms)
    is_aboard = now in (200, 250)
    parcel = {"vehicle": "van-1", "back": 800, "depot": "hub", "by": "van-2"}
    assert plan["replan"].get("parcels", []) == [
        {"id": name, **parcel} for name, aboard in (("a", now == 30), ("s1/delivery", is_aboard))
        if aboard]
    if is_aboard:
        assert times(plan, "van-2") == [("hub", 800, 800), ("s1", 980, 1040), ("hub", 1220, 1220)]
        for asked in {"shipment": "s1"}, {"customer": "s1/delivery"}:
            for path in "/explain", "/fit":
                replan = {"plan": tour, "freeze_before": now, **terms}
                body = {"problem": street | {"replan": replan}, "plan": plan, **asked}
                reply = searching.post(path, json=body)
                assert reply.status_code == 200, reply.text
                assert reply.json()["here"]["vehicle"] == "van-2"
    for later in 700, 850, 1000, 1300:
        again = replanned(searching, street, plan, later, **terms | {
            "parcels_back": max(later, 800)})
        assert again["routes"] == plan["routes"]
    street["fleet"][0]["count"] = 1
    alone = replanned(searching, street, tour, now, **terms)
    left = [] if now == 310 else [("shipment", "s1")]
    assert [(each.get("kind"), each["id"]) for each in alone["unassigned"]
            if each["id"] != "a"] == left
    assert alone["summary"]["must_unserved"] == len(alone["unassigned"])
    replanned(searching, street, alone, later, **terms | {"parcels_back": later})


def test_others_fetch_what_a_broken_vehicle_has_not_of_a_shipment(searching: httpx.Client,
                                                                  street: Request) -> None:
    pickups = [{"id": name, "location": [place, 0], "amount": [1]}
               for place, name in ((1, "x"), (2, "y"))]
    street |= {"customers": [], "shipments": [
        {"id": "s1", "delivery": {"location": [3, 0]}, "pickups": pickups}]}
    tour = plan_of(("depot", "hub", 0, 0), ("pickup", "s1", 60, 60), ("pickup", "s1", 120, 120),
                   ("delivery", "s1", 180, 180), ("depot", "hub", 360, 360))
    stops = tour["routes"][0]["trips"][0]["stops"]
    stops[1]["part"], stops[2]["part"] = "x", "y"
    terms = {"unavailable": ["van-1"], "parcels_back": 200}
    plan = replanned(searching, street, tour, 90, **terms)
    assert plan["replan"]["parcels"] == [
        {"id": "s1/delivery", "vehicle": "van-1", "back": 200, "depot": "hub", "by": "van-2"}]
    assert times(plan, "van-2") == [("hub", 200, 200), ("s1", 320, 320), ("s1", 380, 380),
                                    ("hub", 560, 560)]
    for path in "/explain", "/fit":
        problem = street | {"replan": {"plan": tour, "freeze_before": 90, **terms}}
        body = {"problem": problem, "plan": plan, "shipment": "s1"}
        reply = searching.post(path, json=body)
        assert (reply.status_code, reply.json()["here"]["vehicle"]) == (200, "van-2"), reply.text
    for later in 210, 350, 400, 600:
        again = replanned(searching, street, plan, later, **terms | {
            "parcels_back": max(later, 200)})
        assert again["routes"] == plan["routes"]
    both = {"unavailable": ["van-1", "van-2"], "parcels_back": 900}
    street["fleet"][0]["count"] = 3
    third = replanned(searching, street, plan, 300, **both)
    assert times(third, "van-3") == [("hub", 900, 900), ("s1", 1020, 1020), ("s1", 1080, 1080),
                                     ("hub", 1260, 1260)]
    third = replanned(searching, street, plan, 350, **both)
    assert times(third, "van-3") == [("hub", 900, 900), ("s1", 1080, 1080), ("hub", 1260, 1260)]
    street["fleet"][0] |= {"count": 2, "capacity": [1]}
    assert [left["id"] for left in replanned(searching, street, tour, 90, **terms)["unassigned"]
            ] == ["s1"]
    street["fleet"][0]["capacity"] = [10]
    plan = replanned(searching, street, tour, 130, unavailable=["van-1"])
    assert [each["id"] for each in plan["replan"]["parcels"]] == ["s1/delivery"]
    assert times(plan, "van-2") == [("hub", 130, 130), ("s1", 310, 310), ("hub", 490, 490)]


@pytest.mark.parametrize(("relation", "why"), [
    ({"kind": "together", "customers": ["a", "c"]},
     "It is to be served together with a, which van-1 has served, and that does nothing more."),
    ({"kind": "before", "customers": ["a", "c"]},
     "It is to be served together with a, which van-1 has served, and that does nothing more."),
    ({"kind": "apart", "customers": ["d", "c"]}, "It is kept apart from d, whom van serves.")])
def test_who_may_not_join_whom_vehicles_serve_is_told_by_which_relation(
        searching: httpx.Client, street: Request, relation: Request, why: str) -> None:
    street["customers"].append({"id": "d", "location": [-1, 0], "demand": [1]})
    street["fleet"][0]["max_trips"] = 2
    street["relations"] = [relation]
    tour = TOUR | {"routes": [*TOUR["routes"], *plan_of(
        ("depot", "hub", 0, 0), ("customer", "d", 60, 60), ("depot", "hub", 120, 120))["routes"]]}
    tour["routes"][1] |= {"vehicle": "van-2"}
    plan = replanned(searching, street, tour, 150, unavailable=["van-1"])
    remedy, changes = "fits without its relations", [{"path": "$.relations", "to": []}]
    assert plan["unassigned"] == [{"id": "c", "reasons": [{
        "vehicle_type": "van", "code": "RELATION", "message": why, "remedy": remedy,
        "changes": changes, "remedies": [{"code": "RELATIONS", "who": "c", "changes": changes,
                                          "suffices": True, "text": remedy}]}]}]
    street["relations"] = []
    assert replanned(searching, street, tour, 150, unavailable=["van-1"])["unassigned"] == []


def test_who_may_not_join_what_vehicles_have_carried_is_told_so(searching: httpx.Client,
                                                                street: Request) -> None:
    street["customers"] = [each | {"goods": [name]} for each, name in zip(
        street["customers"], ["food", "food", "paint"], strict=True)]
    street["incompatible_goods"] = [{"goods": ["food", "paint"], "scope": "vehicle"}]
    street["fleet"][0] |= {"count": 1, "max_trips": 2}
    tour = plan_of(("depot", "hub", 0, 0), ("customer", "a", 60, 120), ("customer", "b", 180, 240),
                   ("depot", "hub", 360, 360))
    plan = replanned(searching, street, tour, 150)
    assert plan["unassigned"] == [{"id": "c", "reasons": [{
        "vehicle_type": "van", "code": "GOODS", "remedy": None, "changes": [], "remedies": [],
        "message": "Its goods may not join what van has carried today."}]}]


def test_reply_tells_of_parcels_of_a_trip_that_vanishes(searching: httpx.Client,
                                                        street: Request) -> None:
    plan = replanned(searching, street, TOUR, 30, unavailable=["van-1"], parcels_back=500)
    assert [parcel["id"] for parcel in plan["replan"]["parcels"]] == ["a", "b", "c"]
    assert plan["summary"]["served"] == 3


@pytest.mark.parametrize(("drive", "anywhere"), [(0, False), (20, True), (60, True)])
def test_a_break_that_was_over_before_a_vehicle_broke_down_stays(
        searching: httpx.Client, street: Request, drive: float, anywhere: bool) -> None:
    street["fleet"][0]["breaks"] = [{
        "id": "nap", "duration": 30, "start": {"earliest": 120 + drive, "latest": 180},
        "at": "anywhere" if anywhere else "stop"}]
    plan = plan_of(("depot", "hub", 0, 0), ("customer", "a", 60, 120),
                   ("break", "nap", 120 + drive, 150 + drive), ("customer", "b", 210, 330),
                   ("depot", "hub", 450, 450))
    plan["routes"][0]["trips"][0]["stops"][3]["service_start"] = 270
    street["customers"][1]["time_window"] = {"earliest": 270}
    found = replanned(searching, street, plan, 220, unavailable=["van-1"])
    assert times(found, "van-1")[2] == ("nap", 120 + drive, 150 + drive)


def test_nothing_is_told_of_parcels_if_no_vehicle_is_broken(searching: httpx.Client,
                                                            street: Request) -> None:
    assert "parcels" not in replanned(searching, street, TOUR, 150)["replan"]


def test_broken_vehicle_on_an_open_route_has_worked_until_its_last_service(
        searching: httpx.Client, street: Request) -> None:
    street["fleet"][0] |= {"end": "open", "costs": {"per_hour": 60}}
    tour = plan_of(("depot", "hub", 0, 0), ("customer", "a", 60, 120),
                   ("customer", "b", 1000, 1060))
    plan = replanned(searching, street, tour, 700, unavailable=["van-1"])
    assert times(plan, "van-1") == [("hub", 0, 0), ("a", 60, 120)]
    (route,) = [route for route in plan["routes"] if route["vehicle"] == "van-1"]
    assert (route["working_duration"], route["cost"]) == (120, 2 + 1)


def to_the_launch(street: Request) -> Request:
    """Return the plan of a van that drives from its start to the depot, and launches there."""
    street["fleet"] = [{
        "id": "van", "count": 1, "capacity": [10], "speed_kmh": 60, "start_location": [0, 5],
        "drones": {"count": 1, "capacity": [2], "speed_kmh": 60}}]
    street["customers"] = [{"id": name, "location": [place, 0], "demand": [1]}
                           for place, name in enumerate("ab", 1)]
    visits = [{"id": name, "arrival": arrival, "service_start": arrival, "departure": arrival}
              for name, arrival in (("a", 360), ("b", 540))]
    return plan_of(("start", "van", 0, 0), ("depot", "hub", 300, 660), sorties=[
        {"drone": "van-1/drone-1", "launch_stop": 1, "recovery_stop": 1, "customers": [visit],
         "launch_time": begin, "recovery_time": end}
        for visit, begin, end in zip(visits, (300, 420), (420, 660), strict=True)])


def test_van_on_its_way_to_a_launch_drives_on_if_its_drone_is_lost(searching: httpx.Client,
                                                                   street: Request) -> None:
    tour = to_the_launch(street)
    assert judged(searching, street, tour)["violations"] == []
    plan = replanned(searching, street, tour, 100, unavailable=["van-1/drone-1"])
    assert times(plan, "van-1") == [("van", 0, 0), ("hub", 300, 300)]
    assert [reason["code"] for left in plan["unassigned"] for reason in left["reasons"]] == [
        "ABOARD", "ABOARD"]
    # That plan can be gone on from.
    later = replanned(searching, street, plan, 200, unavailable=["van-1/drone-1"])
    assert times(later, "van-1") == times(plan, "van-1")
    later = replanned(searching, street, plan, 400, unavailable=["van-1/drone-1"])
    assert times(later, "van-1") == times(plan, "van-1")


def test_van_on_its_way_to_a_launch_drives_on_if_orders_are_cancelled(searching: httpx.Client,
                                                                      street: Request) -> None:
    tour = to_the_launch(street)
    street["customers"].pop()
    plan = replanned(searching, street, tour, 100)
    assert times(plan, "van-1") == [("van", 0, 0), ("hub", 300, 420)]
    street["customers"].clear()
    plan = replanned(searching, street, tour, 100)
    assert times(plan, "van-1") == [("van", 0, 0), ("hub", 300, 300)]


def test_next_trip_begins_when_the_planned_way_home_ends(searching: httpx.Client) -> None:
    # From a straight home takes 500, by b as planned 200.
    table = [[0, 100, 300, 100], [500, 0, 100, 500], [100, 300, 0, 500], [100, 500, 500, 0]]
    request = {"depots": [{"id": "d", "location_index": 0}],
               "matrices": {"truck": {"durations": table, "distances": table}},
               "customers": [{"id": name, "location_index": place, "demand": [1]}
                             for place, name in enumerate("abe", 1)],
               "fleet": [{"id": "van", "count": 1, "capacity": [2], "max_trips": 2,
                          "costs": {"per_hour": 36}}],
               "options": {"time_limit": 60, "search_iterations": 40}}
    plan = plan_of(("depot", "d", 0, 0), ("customer", "a", 100, 100), ("customer", "b", 200, 200),
                   ("depot", "d", 300, 300))
    more = plan_of(("depot", "d", 300, 300), ("customer", "e", 400, 400), ("depot", "d", 500, 500))
    plan["routes"][0]["trips"] += more["routes"][0]["trips"]
    assert replanned(searching, request, plan, 50)["cost"]["total"] == pytest.approx(5.5)


def late(tour: Request, delay: float) -> Request:
    """Return a tour whose van comes so much later to the first place, and leaves it so."""
    plan = copy.deepcopy(tour)
    first = plan["routes"][0]["trips"][0]["stops"][1]
    for name in ("arrival", "service_start", "departure"):
        first[name] += delay
    return plan


TEA = {"id": "tea", "duration": 60, "start": {"earliest": 360, "latest": 600}, "at": "anywhere"}
SERVED = (("depot", "hub", 0, 0), ("customer", "a", 60, 120), ("customer", "b", 180, 240),
          ("customer", "c", 300, 360))
RESTED = plan_of(*SERVED, ("break", "tea", 360, 420), ("depot", "hub", 600, 600))


@pytest.mark.parametrize("delay", [20, 200, 2000])
def test_what_follows_a_late_stop_is_timed_anew_for_drivers_who_rest(
        searching: httpx.Client, street: Request, delay: float) -> None:
    street["fleet"][0]["breaks"] = [TEA]
    plan = replanned(searching, street, late(RESTED, delay), 50)
    assert times(plan, "van-1")[1:4] == [
        ("a", 60 + delay, 120 + delay), ("b", 180 + delay, 240 + delay),
        ("c", 300 + delay, 360 + delay)]
    assert times(plan, "van-1")[-1][1] == 600 + delay
    assert [item["code"] for item in plan["replan"]["excused"]] == ["BREAK"] * (delay > 240)


def test_a_driver_who_is_late_rests_by_the_driving_rules(searching: httpx.Client,
                                                         street: Request) -> None:
    street["fleet"][0]["driving_rules"] = {"max_driving": 200, "break_duration": 60}
    rested = plan_of(*SERVED, ("break", "rest", 360, 420), ("depot", "hub", 600, 600))
    plan = replanned(searching, street, late(rested, 300), 50)
    assert times(plan, "van-1")[3:] == [("c", 600, 660), ("rest", 660, 720), ("hub", 900, 900)]


@pytest.mark.parametrize("delay", [20, 2000])
def test_a_late_van_brings_its_shipments_later(searching: httpx.Client, street: Request,
                                               delay: float) -> None:
    request = street | {"customers": street["customers"][:1], "shipments": [
        {"id": "s", "amount": [1], "pickup": {"location": [2, 0], "service_duration": 60},
         "delivery": {"location": [3, 0], "service_duration": 60}}]}
    tour = plan_of(("depot", "hub", 0, 0), ("customer", "a", 60, 120), ("pickup", "s", 180, 240),
                   ("delivery", "s", 300, 360), ("depot", "hub", 540, 540))
    plan = replanned(searching, request, late(tour, delay), 50)
    assert [arrival for _, arrival, _ in times(plan, "van-1")] == [
        0, 60 + delay, 180 + delay, 300 + delay, 540 + delay]


def test_a_late_van_still_waits_where_it_has_time(searching: httpx.Client,
                                                  street: Request) -> None:
    street["fleet"][0]["breaks"] = [TEA]
    street["customers"][1]["time_window"] = {"earliest": 400, "latest": 500}
    tour = plan_of(("depot", "hub", 0, 0), ("customer", "a", 60, 120), ("customer", "b", 180, 460),
                   ("break", "tea", 460, 520), ("customer", "c", 580, 640),
                   ("depot", "hub", 820, 820))
    tour["routes"][0]["trips"][0]["stops"][2]["service_start"] = 400
    plan = replanned(searching, street, late(tour, 100), 50)
    assert times(plan, "van-1")[2:] == [("b", 280, 460), ("tea", 460, 520), ("c", 580, 640),
                                        ("hub", 820, 820)]


def test_what_changes_of_the_plan_costs_what_the_request_says(searching: httpx.Client,
                                                             street: Request) -> None:
    # One van alone would drive less.
    plan = plan_of(("depot", "hub", 0, 0), ("customer", "b", 120, 180), ("depot", "hub", 300, 300))
    second = plan_of(("depot", "hub", 0, 0), ("customer", "c", 180, 240),
                     ("customer", "a", 360, 420), ("depot", "hub", 480, 480))["routes"][0]
    plan["routes"].append(second | {"vehicle": "van-2"})
    body = {**street, "replan": {"plan": plan, "promised": {"b": 120}}}
    prices = {"vehicle": 100.0, "position": 30.0, "promise_per_minute": 0.0}
    held = searching.post("/plan", json=body | {
        "options": {**street["options"], "change_costs": prices}}).json()
    assert held["replan"]["changes"] == {"vehicle": 0, "position": 0, "promise": 0}
    assert held["cost"]["changes"] == 0
    prices = {"vehicle": 0.25, "position": 0.5, "promise_per_minute": 0.01}
    body["options"] = {**street["options"], "change_costs": prices}
    moved = searching.post("/plan", json=body).json()
    changes = moved["replan"]["changes"]
    assert changes["vehicle"] > 0
    assert moved["cost"]["changes"] == pytest.approx(
        0.25 * changes["vehicle"] + 0.5 * changes["position"] + 0.01 * changes["promise"] / 60)
    assert moved["cost"]["total"] < held["cost"]["total"]
    verdict = judged(searching, body, moved)
    assert (verdict["violations"], verdict["cost"]) == ([], pytest.approx(moved["cost"]))
    assert "changes" not in searching.post("/plan", json={
        **street, "replan": {"plan": plan}}).json()["replan"]
