"""Days told over HTTP, and the plans that follow."""

import time
from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime, timedelta
from typing import Any

import httpx
import pytest

from app.records.dispatches.schemas import DriverDay
from tests.app.records.days.living import (
    PROBLEM, begun, clock, followed, order, plan_of, planned, served_by, standing, told,
)
from tests.app.records.dispatches.days import event, holding, token_of

pytestmark = pytest.mark.slow


def test_orders_come_in_and_are_cancelled(service: httpx.Client) -> None:
    day = begun(service)
    assert set(served_by(plan_of(service, day))) == set("ABCDEF")
    told(service, day, clock(), order("G", 1, 1), {"kind": "order.cancelled", "order": "F"}, at=10)
    assert set(served_by(plan_of(service, day))) == set("ABCDEG")
    assert standing(service, day).now == 10
    told(service, day, {"kind": "order.changed", "customer": {
        **PROBLEM["customers"][0], "demand": [2]}}, at=20)
    plan = plan_of(service, day)
    assert [trip["load"] for route in plan["routes"] for trip in route["trips"]
            if any(stop["id"] == "A" for stop in trip["stops"])] == [[2]]
    checked = service.post("/check", json={"problem": {**PROBLEM, "customers": [
        *({**each, "demand": [2]} if each["id"] == "A" else each
          for each in PROBLEM["customers"] if each["id"] != "F"),
        order("G", 1, 1)["customer"]]}, "plan": plan}).json()
    assert checked["feasible"], checked


def test_nobody_moves_where_that_is_dear_and_what_was_told_is_the_promise(
        service: httpx.Client) -> None:
    prices = {"vehicle": 1000.0, "position": 1000.0, "promise_per_minute": 1.0}
    day = begun(service, PROBLEM | {"options": {"change_costs": prices}, "fleet": [
        {**PROBLEM["fleet"][0], "capacity": [3]}]})
    before = plan_of(service, day)
    arrivals = {stop["id"]: stop["arrival"] for route in before["routes"]
                for trip in route["trips"] for stop in trip["stops"]}
    told(service, day, clock(), order("G", 1, 1), at=10)
    plan = plan_of(service, day)
    by = served_by(plan)
    assert {name: by[name] for name in "ABCDEF"} == served_by(before)
    assert "G" in by
    late = sum(abs(stop["arrival"] - arrivals[stop["id"]]) for route in plan["routes"]
               for trip in route["trips"] for stop in trip["stops"][1:-1] if stop["id"] != "G")
    assert plan["replan"]["changes"] == {
        "vehicle": 0, "position": 0, "promise": pytest.approx(late)}
    assert plan["cost"]["changes"] == pytest.approx(late / 60)


def test_whoever_opens_a_day_gets_its_problem_and_finds_it_among_plans_on_the_road(
        service: httpx.Client) -> None:
    day = begun(service, id="found-again")
    told(service, day, order("G", -2, 0), {"kind": "order.cancelled", "order": "F"}, at=10)
    problem = service.get("/days/found-again/problem").json()
    assert [each["id"] for each in problem["customers"]] == ["A", "B", "C", "D", "E", "G"]
    assert problem["fleet"] == PROBLEM["fleet"]
    listed = {each["id"]: each["day"] for each in service.get("/dispatches").json()["dispatches"]}
    assert listed[standing(service, day).dispatch] == "found-again"


def test_who_may_wait_does_so_until_the_next_departure(service: httpx.Client) -> None:
    day = begun(service, PROBLEM | {"options": {"search_iterations": 1200}, "forecast": {
        "every": 3000, "past_days": [[{**order("near", 0, -8)["customer"], "placed_at": 500}]]}},
        plan_within=30)
    told(service, day, clock(), order("H", 2, 1, time_window={"latest": 900}),
         order("alone", 0, -8), at=10)
    plan = plan_of(service, day)
    outlook = {each["id"]: each for each in plan["outlook"]}
    assert outlook["H"]["leaves"]
    assert outlook["H"]["must"]
    begins = {stop["id"]: trip["stops"][0]["departure"] for route in plan["routes"]
              for trip in route["trips"] for stop in trip["stops"]}
    assert {name: each["leaves"] for name, each in outlook.items()} == {
        name: begins[name] < 3000 for name in (*"ABCDEF", "H", "alone")}
    assert not outlook["alone"]["leaves"]


def test_whoever_leaves_before_the_depot_opens_is_planned_on_from(service: httpx.Client) -> None:
    day = begun(service)
    before = plan_of(service, day)["routes"][0]
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": before["vehicle"],
                                 "at": 50}, at=60)
    plan = plan_of(service, day)
    trip = next(each for each in plan["routes"]
                if each["vehicle"] == before["vehicle"])["trips"][0]
    assert trip["stops"][0]["departure"] == 50
    assert {each["code"] for each in plan["replan"]["excused"]} == {"SHIFT"}


def test_what_has_happened_stays_and_is_planned_on_from(service: httpx.Client) -> None:
    day = begun(service)
    before = plan_of(service, day)
    route = next(route for route in before["routes"] if len(route["trips"][0]["stops"]) > 3)
    vehicle, stops = route["vehicle"], route["trips"][0]["stops"]
    first, second = (stop["id"] for stop in stops[1:3])
    at = stops[1]["departure"] + 100
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": vehicle, "at": 200},
         {"kind": "vehicle.served", "vehicle": vehicle, "order": first}, at=at)
    found = {each.id: each for each in standing(service, day).orders}
    assert (found[first].state, found[first].arrival) == ("served", stops[1]["arrival"] + 100)
    # It drives to the second: nobody can take that back.
    told(service, day, {"kind": "order.cancelled", "order": second}, order("G", 1, 0), at=at + 1)
    plan = plan_of(service, day)
    assert served_by(plan)[first] == served_by(plan)[second] == vehicle
    trip = next(each for each in plan["routes"] if each["vehicle"] == vehicle)["trips"][0]
    assert trip["stops"][0]["departure"] == 200
    assert "G" not in [stop["id"] for stop in trip["stops"]]
    assert "G" in served_by(plan)


def test_event_that_is_sent_again_counts_once(service: httpx.Client) -> None:
    day = begun(service)
    sent = [{"event_id": "one", "at": 5, **order("G", 1, 1)}, {"event_id": "two", "at": 5,
                                                               **clock()}]
    replies = [service.post(f"/days/{day}/events", json=sent).json() for _ in range(3)]
    assert replies[0]["accepted"] == replies[1]["accepted"] == replies[2]["accepted"]
    changed = service.post(f"/days/{day}/events", json=[
        {"event_id": "one", "at": 9, **order("H", 1, 1)}]).json()
    assert changed["accepted"] == replies[0]["accepted"][:1]
    names = {each.id for each in planned(service, day).orders}
    assert names == set("ABCDEFG")


def test_who_tell_at_once_wait_for_each_other(service: httpx.Client) -> None:
    day = begun(service)
    names = [f"G{number}" for number in range(24)]

    def tell(name: str) -> int:
        reply = service.post(f"/days/{day}/events", json=[
            {"event_id": name, "at": 1, **order(name, 1, 1)}])
        assert reply.status_code == 202, reply.text
        return int(reply.json()["accepted"][0]["number"])

    with ThreadPoolExecutor(8) as pool:
        numbers = list(pool.map(tell, names))
    assert len(set(numbers)) == len(names)
    assert {each.id for each in planned(service, day).orders} == {*"ABCDEF", *names}


def test_same_request_finds_its_day(service: httpx.Client) -> None:
    request = {"problem": PROBLEM, "id": "monday"}
    first, again = (service.post("/days", json=request).json() for _ in range(2))
    assert (first["id"], first["dispatch"]) == ("monday", again["dispatch"])
    other = service.post("/days", json=request | {"plan_within": 3})
    assert (other.status_code, other.json()["type"]) == (409, "urn:tandem:error:day-taken")
    assert service.get(f"/days/{first['dispatch']}").json()["id"] == "monday"
    assert service.get("/days/tuesday").status_code == 404


def test_vehicle_that_breaks_down_has_done_what_it_told(service: httpx.Client) -> None:
    day = begun(service)
    before = plan_of(service, day)
    route = next(route for route in before["routes"] if len(route["trips"][0]["stops"]) > 3)
    vehicle, stops = route["vehicle"], route["trips"][0]["stops"]
    first, second = (stop["id"] for stop in stops[1:3])
    # By the plan both would have been served.
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": vehicle, "at": 100},
         {"kind": "vehicle.served", "vehicle": vehicle, "order": first, "at": 400},
         {"kind": "vehicle.broken", "vehicle": vehicle, "reason": "Engine"}, at=3000)
    plan, now = plan_of(service, day), standing(service, day)
    served = served_by(plan)
    assert (served[first], served[second] == vehicle) == (vehicle, False)
    assert now.out == [vehicle]
    assert {each.id: each.state for each in now.orders}[second] == "planned"
    told(service, day, order("G", 1, 1), at=3001)
    assert served_by(plan_of(service, day))["G"] != vehicle


def test_what_contradicts_itself_is_planned_on_from(service: httpx.Client) -> None:
    day = begun(service, {**PROBLEM, "fleet": [{**PROBLEM["fleet"][0], "count": 1,
                                                "max_trips": 3}]})
    trips = plan_of(service, day)["routes"][0]["trips"]
    first, second = (trip["stops"][1]["id"] for trip in trips[:2])
    # The second trip began before the first was over.
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": "van-1", "at": 150},
         {"kind": "vehicle.departed", "vehicle": "van-1", "at": 400},
         {"kind": "vehicle.served", "vehicle": "van-1", "order": first, "at": 900},
         {"kind": "vehicle.served", "vehicle": "van-1", "order": second, "at": 700},
         {"kind": "vehicle.arrived", "vehicle": "van-1", "at": 600}, at=1000)
    found = {each.id: each.state for each in standing(service, day).orders}
    assert found[first] == found[second] == "served"
    told(service, day, order("G", 1, 1), at=1001)
    assert "G" in served_by(plan_of(service, day))


def test_what_was_told_late_is_put_where_it_belongs(service: httpx.Client) -> None:
    day = begun(service)
    told(service, day, clock(), order("G", 1, 1), at=50)
    told(service, day, {"kind": "order.changed", "customer": order("G", 2, 2)["customer"]}, at=60)
    told(service, day, {"kind": "order.changed", "customer": order("G", 9, 9)["customer"]}, at=55)
    plan = plan_of(service, day)
    checked = service.post("/check", json={"plan": plan, "problem": {**PROBLEM, "customers": [
        *PROBLEM["customers"], order("G", 2, 2)["customer"]]}}).json()
    assert checked["feasible"], checked


def test_order_served_by_another_than_planned_is_served(service: httpx.Client) -> None:
    day = begun(service)
    planned_by = served_by(plan_of(service, day))["A"]
    other = next(f"van-{number}" for number in (1, 2, 3) if f"van-{number}" != planned_by)
    told(service, day, clock(), {"kind": "vehicle.served", "vehicle": other, "order": "A"}, at=1)
    assert "A" not in served_by(plan_of(service, day))
    found = {each.id: each for each in standing(service, day).orders}["A"]
    assert (found.state, found.vehicle) == ("served", other)


def test_delay_moves_arrivals_and_is_told_once(service: httpx.Client) -> None:
    day = begun(service)
    before = {each.id: each for each in standing(service, day).orders}
    assert all(each.told == each.arrival for each in before.values())
    vehicle = before["A"].vehicle
    told(service, day, clock(), {"kind": "vehicle.departed", "vehicle": vehicle, "at": 100},
         {"kind": "vehicle.delayed", "vehicle": vehicle, "by": 900}, at=101)
    after = {each.id: each for each in standing(service, day).orders}
    late = [order for order, each in after.items() if each.vehicle == vehicle]
    for name in late:
        arrival, planned_for = after[name].arrival, before[name].arrival
        assert planned_for is not None
        assert after[name].told == arrival == planned_for + 900
    revision = standing(service, day).revision
    told(service, day, clock(), at=102)
    news = events_after(service, day, revision, 2)
    assert [kind for kind, _ in news] == ["clock", "plan.changed"]


def test_orders_that_will_be_late_are_told_with_why(service: httpx.Client) -> None:
    problem = {**PROBLEM, "fleet": [{**PROBLEM["fleet"][0], "count": 1, "max_trips": 1}]}
    day = begun(service, {**problem, "customers": PROBLEM["customers"][:1]})
    told(service, day, clock(), order("G", 1, 1, time_window={"latest": 0.5}), at=1)
    found = {each.id: each for each in standing(service, day).orders}["G"]
    assert (found.state, found.at_risk) == ("left_out", True)
    told(service, day, {"kind": "order.changed",
                        "customer": order("G", 1, 1)["customer"]}, at=2)
    assert not any(each.at_risk for each in standing(service, day).orders)
    risks = [about for kind, about in events_after(service, day, 0, 6) if kind == "order.at_risk"]
    assert [about["at_risk"] for about in risks] == [True, False]
    assert risks[0]["reason"]["code"]


def test_who_follows_gets_each_event_once_and_goes_on_behind_the_last(
        service: httpx.Client) -> None:
    day = begun(service)
    first = followed(service, day, 3)
    assert [event["number"] for event in first] == [1, 2, 3]
    rest = followed(service, day, 5, {"Last-Event-ID": "3"})
    assert [event["number"] for event in rest] == [4, 5, 6, 7, 8]
    assert {event["kind"] for event in first + rest} == {"day.begun", "plan.changed",
                                                         "eta.changed"}


def test_drivers_marks_are_events_of_the_day(service: httpx.Client) -> None:
    began = datetime.now(UTC) - timedelta(hours=1)
    day = begun(service, {**PROBLEM, "plan_start": began.isoformat()}, clock=None)
    dispatch = standing(service, day).dispatch
    link = service.get(f"/dispatches/{dispatch}").json()["links"][0]
    renewed = service.post(f"/dispatches/{dispatch}/links/{link['id']}").json()["links"][0]
    token = token_of(renewed)
    seen = DriverDay.model_validate_json(
        service.get("/drive/day", headers=holding(token)).text)
    departs, stops = seen.steps[0], seen.steps[1]
    when = datetime.now(UTC).isoformat()
    service.post("/drive/events", headers=holding(token), json={"now": when, "events": [
        event("e1", departs.id, when), event("e2", stops.id, when)]})
    now = planned(service, day)
    assert {each.id: each.state for each in now.orders}[stops.place] == "served"
    kinds = [(each["kind"], each["vehicle"]) for each in followed(service, day, now.revision)]
    assert ("vehicle.departed", link["vehicle"]) in kinds
    assert ("vehicle.served", link["vehicle"]) in kinds
    # And what is told by others is seen on the phone.
    told(service, day, {"kind": "vehicle.broken", "vehicle": link["vehicle"],
                        "at": time.time() - began.timestamp()})
    again = DriverDay.model_validate_json(service.get("/drive/day", headers=holding(token)).text)
    assert "vehicle" in [each.id for each in again.standing]


@pytest.mark.parametrize(("told_wrongly", "path", "code"), [
    ({"kind": "order.cancelled", "order": "Z"}, "$[0].order", "UNKNOWN_CUSTOMER"),
    ({"kind": "vehicle.departed", "vehicle": "van-9"}, "$[0].vehicle", "UNKNOWN_VEHICLE"),
    ({"kind": "drone.lost", "drone": "truck-1/drone-1"}, "$[0].drone", "UNKNOWN_VEHICLE"),
    (order("A", 1, 1) | {"customer": {"id": "A"}}, "$[0].customer.demand", "MISSING_FIELD"),
    (order("G", 1, 1, demand=[1, 2]), "$[0].customer", "DIMENSION_MISMATCH"),
    ({"kind": "order.placed"}, "$[0]", "MISSING_FIELD"),
    ({"kind": "vehicle.flew", "vehicle": "van-1"}, "$[0]", "WRONG_TYPE"),
])
def test_wrong_events_are_refused_where_they_are_wrong(
        service: httpx.Client, told_wrongly: dict[str, Any], path: str, code: str) -> None:
    day = begun(service)
    reply = service.post(f"/days/{day}/events", json=[{"event_id": "e", "at": 1} | told_wrongly])
    assert reply.status_code == 422, reply.text
    errors = [(error["path"], error["code"]) for error in reply.json()["errors"]]
    assert any(found.startswith(path) and each == code for found, each in errors), errors
    assert standing(service, day).revision == begun_revision(service, day)


def test_day_without_orders_is_planned(service: httpx.Client) -> None:
    day = begun(service, {**PROBLEM, "customers": []})
    assert plan_of(service, day)["routes"] == []
    told(service, day, clock(), order("G", 1, 1), at=300)
    plan = plan_of(service, day)
    assert set(served_by(plan)) == {"G"}
    assert plan["routes"][0]["trips"][0]["stops"][0]["departure"] >= 300


def begun_revision(client: httpx.Client, day: str) -> int:
    """Return the number of a day's last event if nothing was told of it."""
    return 2 + len(standing(client, day).orders)


def events_after(client: httpx.Client, day: str, number: int,
                 least: int) -> list[tuple[str, dict[str, Any]]]:
    """Return a day's events behind the one of a number: kind, and what they are about."""
    count = max(least, standing(client, day).revision - number)
    return [(event["kind"], event["about"])
            for event in followed(client, day, count, {"Last-Event-ID": str(number)})]
