"""Rests that driving rules ask for, over HTTP."""

import json
import random
import time
from typing import Any

import httpx
import pytest

from app.plans.task import task_of
from app.requests.reading import read_request
from model.planner import complete_plan
from model.together.pulling import nobody_served
from tests.app.plans.asking import planned
from tests.app.plans.test_breaks import breaks_of
from tests.app.plans.test_hubs import is_feasible

Request = dict[str, Any]


@pytest.fixture
def far() -> Request:
    """Return a request for which one truck drives for six hours, 90 minutes from stop to stop."""
    return {
        "coordinate_system": "planar", "planar_unit": 1000,
        "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": name, "location": place, "demand": [1], "service_duration": 600}
                      for name, place in (("a", [90, 0]), ("b", [90, 90]), ("c", [0, 90]))],
        "fleet": [{"id": "van", "count": 1, "capacity": [3], "speed_kmh": 60,
                   "driving_rules": {"preset": "eu-561"}}],
        "options": {"time_limit": 60, "search_iterations": 200}}


def test_who_drives_for_too_long_rests_and_the_plan_says_by_which_rule(
        service: httpx.Client, far: Request) -> None:
    plan = planned(service, far)
    assert plan["status"] == "complete"
    rest, = breaks_of(plan)
    assert (rest["id"], rest["departure"] - rest["service_start"]) == ("rest", 2700)
    law, = plan["driving_rules"]
    assert law["planned"]["max_driving"] == law["max_driving"] == 16_200
    assert "561/2006" in law["source"]
    assert is_feasible(service, far, plan)
    for trip in (trip for route in plan["routes"] for trip in route["trips"]):
        trip["stops"] = [stop for stop in trip["stops"] if stop["kind"] != "break"]
    answer = service.post("/check", json={"problem": far, "plan": plan}).json()
    assert "DRIVING" in {each["code"] for each in answer["violations"]}


@pytest.mark.parametrize(("minutes", "pauses"), [(45, ["lunch"]), (30, ["rest", "lunch"]),
                                                 (10, ["lunch", "rest"])])
def test_a_break_that_is_long_enough_is_a_rest_or_a_part_of_one(
        service: httpx.Client, far: Request, minutes: int, pauses: list[str]) -> None:
    far["fleet"][0] |= {"costs": {"per_hour": 30}, "breaks": [{
        "id": "lunch", "duration": 60 * minutes, "at": "anywhere",
        "start": {"earliest": 12_000, "latest": 13_000}, "after_departure": True}]}
    plan = planned(service, far)
    assert [each["id"] for each in breaks_of(plan)] == pauses
    assert is_feasible(service, far, plan)
    resting = sum(each["departure"] - each["service_start"] for each in breaks_of(plan))
    assert resting == 60 * (minutes if minutes == 45 else 45 if minutes == 30 else 55)


def test_who_drives_slowly_rests_more_often(service: httpx.Client, far: Request) -> None:
    far["fleet"][0] |= {
        "driving_rules": {"max_driving": 16_200, "break_duration": 2700},
        "speed_profile": [{"from": 0, "speed_kmh": 60}, {"from": 5400, "speed_kmh": 30}]}
    plan = planned(service, far)
    assert plan["status"] == "complete"
    assert [each["id"] for each in breaks_of(plan)] == ["rest", "rest"]
    assert is_feasible(service, far, plan)
    later = planned(service, far | {"replan": {"plan": plan, "freeze_before": 20_000}})
    assert [each["id"] for each in breaks_of(later)] == ["rest", "rest"]
    assert is_feasible(service, far, later)


def test_a_rest_may_lie_in_waiting(service: httpx.Client, far: Request) -> None:
    far["customers"][1]["time_window"] = {"earliest": 14_400}
    waits = planned(service, far)
    del far["fleet"][0]["driving_rules"]
    assert waits["routes"][0]["trips"][0]["stops"][-1]["departure"] == (
        planned(service, far)["routes"][0]["trips"][0]["stops"][-1]["departure"])
    assert breaks_of(waits)


def test_a_rest_may_lie_in_a_flight(service: httpx.Client, far: Request) -> None:
    far["fleet"][0] |= {"costs": {"per_hour": 30}, "drones": {
        "count": 1, "capacity": [1], "speed_kmh": 60, "endurance": 20_000}}
    far["customers"][1]["location"] = [90, 160]
    for each, by in zip(far["customers"], ("truck", "drone", "truck"), strict=True):
        each["served_by"] = by
    plan = planned(service, far)
    assert is_feasible(service, far, plan)
    assert "break" in kinds_in_flight(plan)
    far["fleet"][0]["driving_rules"]["while_drones_fly"] = False
    attends = planned(service, far)
    assert "break" not in kinds_in_flight(attends)
    assert breaks_of(attends)
    assert service.post("/check", json={"problem": far, "plan": plan}).json()["violations"]
    del far["fleet"][0]["driving_rules"]
    free = planned(service, far)
    assert free["cost"]["total"] == plan["cost"]["total"] < attends["cost"]["total"]


def kinds_in_flight(plan: dict[str, Any]) -> set[str]:
    """Return the kinds of stops between the launch and the recovery of the only sortie."""
    trip, = plan["routes"][0]["trips"]
    sortie, = trip["sorties"]
    return {stop["kind"] for stop in
            trip["stops"][sortie["launch_stop"] + 1:sortie["recovery_stop"]]}


def test_the_longest_travel_duration_leaves_out_waiting_service_and_rests(
        service: httpx.Client, far: Request) -> None:
    far["customers"][1]["time_window"] = {"earliest": 30_000}
    far["fleet"][0]["max_travel_duration"] = 21_600
    assert planned(service, far)["status"] == "complete"
    far["fleet"][0]["max_travel_duration"] = 21_599
    plan = planned(service, far)
    assert plan["unassigned"]
    assert is_feasible(service, far, plan)
    far["fleet"][0]["max_travel_duration"] = 10_000
    reasons = [reason for left in planned(service, far)["unassigned"]
               for reason in left["reasons"]]
    assert {(reason["code"], reason["remedy"]) for reason in reasons} == {
        ("TRAVEL_DURATION", "fits if van could travel 13.4 minutes longer"),
        ("TRAVEL_DURATION", "fits if van could travel 87.9 minutes longer")}


def test_how_long_legs_are_hangs_on_when_they_are_driven(service: httpx.Client,
                                                         smallest: Request) -> None:
    # Ten minutes there and back, twenty in the first hour, when the parcel has to be there.
    smallest["customers"] = [{"id": "A", "location": [3, 4], "demand": [1],
                              "time_window": {"latest": 3000}}]
    smallest["fleet"][0] |= {"speed_kmh": 60, "max_travel_duration": 1000, "speed_profile": [
        {"from": 0, "speed_kmh": 30}, {"from": 3600, "speed_kmh": 60}]}
    smallest["options"] = {"search_iterations": 100, "time_limit": 60}
    left, = planned(service, smallest)["unassigned"]
    assert {(reason["code"], reason["remedy"]) for reason in left["reasons"]} == {
        ("TRAVEL_DURATION", "fits if truck could travel 3.4 minutes longer")}
    smallest["customers"][0]["time_window"]["latest"] = 9000
    plan = planned(service, smallest)
    assert plan["status"] == "complete"
    assert plan["routes"][0]["trips"][0]["stops"][0]["departure"] >= 3000


def test_a_day_that_is_too_long_is_told(service: httpx.Client, far: Request) -> None:
    far["fleet"][0]["driving_rules"] = {"preset": "eu-561", "driven_before": 10_000}
    far["customers"][1]["location"] = [9, 500]
    plan = planned(service, far)
    left, = plan["unassigned"]
    assert {(reason["code"], reason["remedy"]) for reason in left["reasons"]} == {
        ("DRIVING", "fits if van's drivers could drive 1166.9 minutes a day")}


def test_looser_numbers_are_told(service: httpx.Client, far: Request) -> None:
    far["fleet"][0]["driving_rules"] |= {"max_driving": 20_000, "split": [900, 600]}
    paths = {each["path"] for each in planned(service, far)["warnings"]
             if each["code"] == "LOOSER_THAN_PRESET"}
    assert paths == {"$.fleet[0].driving_rules.max_driving", "$.fleet[0].driving_rules.split[1]"}


def test_us_rules_bound_the_working_day(service: httpx.Client, far: Request) -> None:
    far["fleet"][0]["driving_rules"] = {"preset": "us-hos"}
    law, = planned(service, far)["driving_rules"]
    assert law["planned"]["max_working_duration"] == 50_400


@pytest.mark.parametrize(("rules", "rests", "seconds"), [
    ({"preset": "us-hos"}, 0, 37_800),
    ({"preset": "us-hos", "other_work_interrupts": False}, 1, 39_600),
    ({"max_driving": 28_800, "break_duration": 1800, "other_work_interrupts": True}, 0, 37_800),
    ({"max_driving": 28_800, "break_duration": 1801, "other_work_interrupts": True}, 1, 39_601)])
def test_half_an_hour_of_unloading_interrupts_driving_in_the_us(
        service: httpx.Client, far: Request, rules: Request, rests: int, seconds: float) -> None:
    far["customers"] = [{"id": "a", "location": [300, 0], "demand": [1],
                         "service_duration": 1800}]
    far["fleet"][0] |= {"driving_rules": rules, "costs": {"per_hour": 1}}
    plan = planned(service, far)
    assert len(breaks_of(plan)) == rests
    assert plan["routes"][0]["working_duration"] == seconds
    assert is_feasible(service, far, plan)
    for law in plan.get("driving_rules", []):
        assert law["other_work_interrupts"] is True
        assert law["planned"]["other_work_interrupts"] is (rests == 0)


def test_what_interrupts_more_than_the_rule_allows_is_told(service: httpx.Client,
                                                           far: Request) -> None:
    far["fleet"][0]["driving_rules"]["other_work_interrupts"] = True
    path, = [each["path"] for each in planned(service, far)["warnings"]
             if each["code"] == "LOOSER_THAN_PRESET"]
    assert path == "$.fleet[0].driving_rules.other_work_interrupts"


def test_breaks_too_short_for_a_rest_are_work(service: httpx.Client, far: Request) -> None:
    """Driving takes 28 minutes, and the break five."""
    far["customers"] = [{"id": "a", "location": [14, 0], "demand": [1]}]
    far["fleet"][0] |= {
        "driving_rules": {"break_duration": 900, "max_work_before_break": 1800},
        "breaks": [{"id": "short", "duration": 300, "at": "anywhere",
                    "start": {"earliest": 600, "latest": 600}}]}
    plan = planned(service, far)
    assert [each["id"] for each in breaks_of(plan)] == ["short", "rest"]
    assert is_feasible(service, far, plan)


@pytest.mark.parametrize(("changes", "code", "path"), [
    ({"driving_rules": {"max_driving": 9}}, "MISSING_BREAK_DURATION",
     "$.fleet[0].driving_rules.break_duration"),
    ({"driving_rules": {"preset": "eu-561", "split": [9]}}, "WRONG_LENGTH",
     "$.fleet[0].driving_rules.split"),
    ({"breaks": [{"id": "rest", "duration": 9}]}, "DUPLICATE_ID", "$.fleet[0].breaks[0].id")])
def test_what_cannot_be_kept_is_told(service: httpx.Client, far: Request, changes: Request,
                                     code: str, path: str) -> None:
    far["fleet"][0] |= changes
    error, = service.post("/plan", json=far).json()["errors"]
    assert (error["code"], error["path"]) == (code, path)


@pytest.mark.parametrize(("place", "status"), [([60, 0], "complete"), ([100, 0], "partial")])
def test_what_was_driven_before_counts_on_a_day_under_way(
        service: httpx.Client, far: Request, place: list[float], status: str) -> None:
    far["fleet"][0]["max_trips"] = 2
    plan = planned(service, far)
    trip, = plan["routes"][0]["trips"]
    far["customers"].append({"id": "new", "location": place, "demand": [1]})
    later = planned(service, far | {"replan": {
        "plan": plan, "freeze_before": trip["stops"][0]["departure"] + 1}})
    assert later["status"] == status
    assert later["routes"][0]["trips"][0] == trip


def test_the_first_part_of_a_rest_that_was_taken_before_counts_on_a_day_under_way(
        service: httpx.Client, far: Request) -> None:
    far["fleet"][0] |= {"max_trips": 2, "costs": {"per_hour": 30}, "breaks": [{
        "id": "coffee", "duration": 900, "after_departure": True,
        "start": {"earliest": 5400, "latest": 7200}}]}
    far["customers"][1:] = []
    plan = planned(service, far)
    trip, = plan["routes"][0]["trips"]
    assert [each["id"] for each in breaks_of(plan)] == ["coffee"]
    far["customers"].append({"id": "new", "location": [60, 0], "demand": [1]})
    far["fleet"][0]["driving_rules"]["max_driving"] = 14_400
    later = planned(service, far | {"replan": {
        "plan": plan, "freeze_before": trip["stops"][0]["departure"] + 1}})
    assert later["status"] == "complete"
    rests = [each["departure"] - each["service_start"] for each in breaks_of(later)
             if each["id"] == "rest"]
    assert rests == [1800]


def test_drivers_begin_at_few_of_many_speeds_where_trips_are_held_for_what_is_aboard(
        monkeypatch: pytest.MonkeyPatch) -> None:
    # Each price of a place once held the trip anew from each of 200 speeds: seven seconds.
    monkeypatch.setattr("model.planner.LEAST_UNHURRIED", 60.0)
    rng = random.Random(1)
    request = {
        "planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
        "customers": [{"id": str(number), "demand": [1], "max_time_aboard": 1800,
                       "location": [rng.uniform(-3, 3), rng.uniform(-3, 3)]}
                      for number in range(30)],
        "fleet": [{"id": "van", "count": 1, "capacity": [50], "speed_kmh": 30,
                   "driving_rules": {"preset": "eu-561"},
                   "speed_profile": [{"from": 300 * step, "speed_kmh": 20 + 7 * step % 41}
                                     for step in range(200)]}]}
    task = task_of(read_request(json.dumps(request).encode(), None))
    began = time.process_time()
    plan = complete_plan(task.problem, nobody_served(task.problem), 0, lambda: False).solution
    assert time.process_time() - began < 2
    assert task.check(plan).is_feasible
    assert len(plan.unassigned) < 10
