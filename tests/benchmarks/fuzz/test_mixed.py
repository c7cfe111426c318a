"""Problems that mix all rules are planned, and what plans say of them is read from replies alone.

The study of ten thousand is `python -m benchmarks.fuzz.mixed`.
"""

import copy
import json
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx
import pytest

from benchmarks.fuzz.mixed import MixedStudy, Outcome, outcomes_in, told
from benchmarks.fuzz.mixed_problems import mixed_request
from benchmarks.fuzz.plain_facts import faults_of, met_in

pytestmark = pytest.mark.slow

Data = dict[str, Any]

PROBLEMS = 12

ONCE_BROKEN = (1643, 2975, 3118, 5114, 9086, 9436, 2_000_112,
               2_000_496, 2_000_997, 2_001_223, 2_109_296, 2_109_391)
"""Seeds of problems that once were answered with 500, or whose plans were refused: a damaged plan
without stops, or with a drone launched at a break; an open route that ends at a launch site; breaks
that follow the departure; shipments whose pickup has no way home; a lag between routes whose
driver rests while drones fly; a break at a stop behind a rest on the way; shipments that were
brought, asked about; a truck that stays at its depot for its drones, which lost them; and routes
with a lag between them, priced one by one."""


def test_problems_that_mix_all_rules_are_planned_soundly(client: httpx.Client) -> None:
    study = MixedStudy(client)
    outcomes = [study.outcome_of(seed) for seed in (*range(PROBLEMS), *ONCE_BROKEN)]
    assert [each.fault for each in outcomes if each.fault is not None] == []
    planned = [each for each in outcomes if not each.is_refused]
    assert len(planned) > 0.8 * len(outcomes)
    assert sum(len(each.stated) > 1 for each in planned) > 0.8 * len(planned)
    assert sum(each.served for each in planned) > 0.7 * sum(each.orders for each in planned)
    assert told(outcomes).startswith(f"{len(planned)} problems planned")


def test_mixed_requests_are_drawn_from_the_generator_alone() -> None:
    drawn = [mixed_request(random.Random(seed)) for seed in range(30)]
    assert drawn == [mixed_request(random.Random(seed)) for seed in range(30)]
    assert len({json.dumps(request) for request in drawn}) == 30


def test_what_came_of_problems_is_gone_on_from(tmp_path: Path) -> None:
    log = tmp_path / "mixed.jsonl"
    assert outcomes_in(log) == []
    log.write_text('{"seed": 3, "fault": "late"}\n', "utf-8")
    assert outcomes_in(log) == [Outcome(3, fault="late")]
    assert told(outcomes_in(log)).endswith("seed 3: late\n1 faults")


def stop(kind: str, name: str, begin: float, end: float) -> Data:
    """Return a stop where service begins at once."""
    return {"kind": kind, "id": name, "arrival": begin, "service_start": begin, "departure": end}


@pytest.fixture
def request_of_day() -> Data:
    """Return a request that states much of what is read."""
    return {
        "depots": [{"id": "hub", "time_window": {"earliest": 0, "latest": 5000}}],
        "customers": [{"id": "A"}, {"id": "B"}, {"id": "C", "vehicle_costs": {"t": 1}}],
        "shipments": [{"id": "s", "pickup": {}, "delivery": {}, "max_time_between": 900}],
        "relations": [{"kind": "before", "customers": ["A", "B"], "min_lag": 100, "max_lag": 2000},
                      {"kind": "apart", "customers": ["A", "C"]}],
        "fleet": [{"id": "t", "max_travel_duration": 2000,
                   "drones": {"count": 1}, "breaks": [
                       {"id": "tea", "duration": 300, "after_departure": False,
                        "start": {"earliest": 600, "latest": 1000}}]},
                  {"id": "u", "driving_rules": {
                      "max_driving": 1000, "break_duration": 300, "split": None,
                      "max_driving_per_day": None, "max_work_before_break": None}}]}


@pytest.fixture
def day() -> Data:
    """Return a plan of it."""
    stops = [stop("depot", "hub", 0, 0), stop("customer", "A", 400, 500),
             stop("break", "tea", 700, 1000), stop("pickup", "s", 1100, 1100),
             stop("customer", "B", 1300, 1400), stop("delivery", "s", 1600, 1600),
             stop("depot", "hub", 2000, 2000)]
    other = [stop("depot", "hub", 0, 0), stop("customer", "C", 800, 800),
             stop("break", "rest", 1000, 1300), stop("depot", "hub", 2000, 2000)]
    flight = {"drone": "t-1/drone-1", "customers": [], "launch_stop": 1, "recovery_stop": 3,
              "launch_time": 500.0, "recovery_time": 1100.0}
    return {"cost": {"makespan": 1.0, "balance": 0.0}, "unassigned": [], "routes": [
        {"vehicle": "t-1", "type": "t", "trips": [{"stops": stops, "sorties": [flight]}]},
        {"vehicle": "u-1", "type": "u", "trips": [{"stops": other, "sorties": []}]}]}


def test_a_sound_day_has_no_faults(request_of_day: Data, day: Data) -> None:
    assert list(faults_of(request_of_day, day)) == []
    assert met_in(request_of_day, day) == {
        "apart", "breaks", "driving_rules", "shipments", "vehicle_costs", "before", "makespan"}


@pytest.mark.parametrize(("kinds", "launch", "recovery", "fault"), [
    (["pickup"], 1, 3, None), (["pickup"], 1, 4, "before its pickup"),
    (["delivery"], 4, 5, None), (["delivery"], 3, 5, "before its pickup"),
    (["pickup", "delivery"], 1, 3, None), (["delivery", "pickup"], 1, 3, "before its pickup")])
def test_ends_that_drones_serve_are_read(request_of_day: Data, day: Data, kinds: list[str],
                                         launch: int, recovery: int, fault: str | None) -> None:
    flown = [stop for stop in _stops(day) if stop["kind"] in kinds]
    flown.sort(key=lambda stop: kinds.index(stop["kind"]))
    for stop in flown:
        _stops(day).remove(stop)
    [flight] = day["routes"][0]["trips"][0]["sorties"]
    flight |= {"customers": flown, "launch_stop": launch, "recovery_stop": recovery}
    request_of_day["fleet"][0]["drones"]["max_customers_per_sortie"] = 2
    told = list(faults_of(request_of_day, day))
    assert told == [] if fault is None else any(fault in each for each in told), told


@pytest.mark.parametrize(("takeoff", "is_sound"), [(1100, True), (1099, False)])
def test_what_is_picked_up_at_a_stop_flies_from_there_afterwards(
        request_of_day: Data, day: Data, takeoff: float, is_sound: bool) -> None:
    [delivery] = [stop for stop in _stops(day) if stop["kind"] == "delivery"]
    _stops(day).remove(delivery)
    [flight] = day["routes"][0]["trips"][0]["sorties"]
    flight |= {"customers": [delivery], "launch_stop": 3, "recovery_stop": 5,
               "launch_time": takeoff, "recovery_time": 2000.0}
    assert (list(faults_of(request_of_day, day)) == []) == is_sound


def _stops(day: Data, route: int = 0) -> list[Data]:
    stops: list[Data] = day["routes"][route]["trips"][0]["stops"]
    return stops


@pytest.mark.parametrize(("change", "fault"), [
    (lambda day: _stops(day)[2].update(service_start=1001), "break tea begins"),
    (lambda day: _stops(day)[2].update(departure=900), "not as long"),
    (lambda day: day["routes"][0]["trips"][0]["sorties"][0].update(recovery_time=800),
     "in break tea"),
    (lambda day: _stops(day, 1).pop(2), "driving rule: wheel"),
    (lambda day: _stops(day)[6].update(arrival=5001, departure=5001), "while it is closed"),
    (lambda day: _stops(day).pop(3), "before its pickup"),
    (lambda day: _stops(day).pop(5), "aren't delivered"),
    (lambda day: _stops(day)[5].update(service_start=2001), "aboard for 901"),
    (lambda day: day["unassigned"].append({"kind": "shipment", "id": "x"}), "neither brought"),
    (lambda day: _stops(day)[4].update(service_start=450), "too soon after A"),
    (lambda day: _stops(day)[4].update(service_start=2401), "too late after A"),
    (lambda day: _stops(day).insert(1, _stops(day, 1).pop(1)), "are not kept apart"),
    (lambda day: _stops(day, 1).insert(2, _stops(day).pop(4)), "are not kept together")])
def test_what_breaks_a_rule_is_told(request_of_day: Data, day: Data,
                                    change: Callable[[Data], object], fault: str) -> None:
    day = copy.deepcopy(day)
    change(day)
    assert any(fault in told for told in faults_of(request_of_day, day))
