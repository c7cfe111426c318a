"""The work on a request before its search ends with its time, its client and its process."""

import json
import math
import random
import time
from collections.abc import Callable
from dataclasses import replace
from itertools import count
from types import SimpleNamespace
from typing import Any

import httpx
import pytest

from app.plans.service import preparing
from app.plans.task import task_of
from app.records.jobs.reading import JobReader
from app.requests.bounds import Bounds
from app.requests.conversion import ground, travels, work
from app.requests.conversion.preparing import (
    PATIENCE, PATIENCE_WITH_OTHERS, Preparing, StoppedError,
)
from app.requests.reading import read_request
from app.schemas.errors import InvalidRequestError
from app.schemas.request import OptionsInput
from app.serving.settings import Settings
from model.travel.airspace import Flights
from tests.app.conftest import FirstFitPlanner, ready

Request = dict[str, Any]


@pytest.fixture
def client(serve: Callable[..., httpx.Client]) -> httpx.Client:
    """Return a client of a service that is ready."""
    return ready(serve(FirstFitPlanner(), Settings(role="api")))


def circle(corners: int, x: float = 0.0, radius: float = 1000.0) -> list[list[float]]:
    angles = [2 * math.pi * corner / corners for corner in range(corners)]
    return [[x + radius * math.cos(angle), radius * math.sin(angle)] for angle in angles]


def crowd(customers: int, no_fly: list[list[list[float]]], **options: Any) -> Request:
    """Return customers around no-fly areas, for a truck with a drone."""
    rng = random.Random(0)
    drones = {"count": 1, "capacity": [1]}
    return {
        "depots": [{"id": "hub", "location": [-5000, -5000]}],
        "customers": [{"id": str(number), "demand": [1],
                       "location": [rng.uniform(-5000, 5000), rng.uniform(-5000, 5000)]}
                      for number in range(customers)],
        "fleet": [{"id": "truck", "count": 1, "capacity": [9], "drones": drones}],
        "airspace": {"no_fly": no_fly}, "options": options}


def bars(count: int) -> list[list[list[float]]]:
    """Return areas of which each crosses half of the others."""
    lying = [[[-5.0, y], [9e3, y], [9e3, y + 1.0], [-5.0, y + 1.0]]
             for y in (10.0 * number for number in range(count))]
    return lying + [[[y, x] for x, y in ring] for ring in lying]


def test_more_work_than_the_time_limit_allows_is_refused_with_an_estimate(
        client: httpx.Client) -> None:
    request = crowd(3000, [circle(500), circle(500, 500.0)], time_limit=0.2)
    reply = client.post("/plan", json=request)
    assert reply.status_code == 422
    [error] = reply.json()["errors"]
    assert error["code"] == "TOO_MUCH_WORK"
    for word in ("take about", "time_limit of 0.2 s", "TANDEM_MAX_PLAN_SECONDS"):
        assert word in error["message"]


def test_who_has_too_many_customers_for_a_second_is_told_what_is_enough(
        serve: Callable[..., httpx.Client], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(travels, "COMPUTED_FROM", 0)
    monkeypatch.setattr(travels, "COMPUTED", 1.6e-4 * 6700)  # seconds for three places, not 20,000
    client = ready(serve(FirstFitPlanner(), Settings(role="api", max_plan_seconds=7.0)))
    [error] = client.post("/plan", json=crowd(2, [])).json()["errors"]
    assert (error["code"], error["path"]) == ("TOO_MUCH_WORK", "$.options.time_limit")
    for words in ("time_limit of 1 s, which holds where none is stated",
                  "options.time_limit of 5 s or more", "up to 7 s (TANDEM_MAX_PLAN_SECONDS)",
                  "POST /jobs"):
        assert words in error["message"]
    assert client.post("/plan", json=crowd(2, [], time_limit=5)).status_code == 200


def test_who_has_too_many_customers_for_any_limit_is_sent_to_jobs(
        serve: Callable[..., httpx.Client], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(travels, "COMPUTED_FROM", 0)
    monkeypatch.setattr(travels, "COMPUTED", 7.0)
    client = ready(serve(FirstFitPlanner(), Settings(role="api", max_plan_seconds=7.0)))
    [error] = client.post("/plan", json=crowd(2, [])).json()["errors"]
    assert ": submit a job (POST /jobs)" in error["message"]
    assert "no more than 7 s can be asked for here" in error["message"]


def test_without_a_time_limit_the_setting_limits_the_work(
        serve: Callable[..., httpx.Client]) -> None:
    client = ready(serve(FirstFitPlanner(), Settings(role="api", max_plan_seconds=0.2)))
    request = {"problem": crowd(3000, [circle(500)]), "plan": {"routes": []}}
    [error] = client.post("/check", json=request).json()["errors"]
    assert "the 0.2 s of TANDEM_MAX_PLAN_SECONDS" in error["message"]


@pytest.mark.thorough
def test_areas_that_cross_too_often_are_refused_with_an_estimate(client: httpx.Client) -> None:
    assert client.post("/plan", json=crowd(1, bars(60), time_limit=10)).status_code == 200
    reply = client.post("/plan", json=crowd(1, bars(1000), time_limit=10))
    [error] = reply.json()["errors"]
    assert (error["code"], error["path"]) == ("TOO_MUCH_WORK", "$.options.time_limit")
    assert "no-fly areas with fewer corners" in error["message"]


@pytest.mark.parametrize("constant", ["REPLANNED_ROUTE", "REPLANNED_CUSTOMER", "RENUMBERED"])
def test_a_plan_to_go_on_from_that_takes_too_long_is_refused_with_an_estimate(
        client: httpx.Client, monkeypatch: pytest.MonkeyPatch, smallest: Request,
        constant: str) -> None:
    plan = client.post("/plan", json=smallest).json()
    going_on = smallest | {"replan": {"plan": plan}}
    assert client.post("/plan", json=going_on).status_code == 200
    monkeypatch.setattr(work, constant, 1000.0)
    [error] = client.post("/plan", json=going_on).json()["errors"]
    assert error["code"] == "TOO_MUCH_WORK"
    assert error["message"].startswith("Legs and the plan to go on from take about")


def test_a_small_request_is_planned_though_the_machine_stood_for_hours(
        serve: Callable[..., httpx.Client], monkeypatch: pytest.MonkeyPatch) -> None:
    hours = count(0, 3600)
    monkeypatch.setattr("app.requests.conversion.preparing.time", SimpleNamespace(
        perf_counter=lambda: float(next(hours)), thread_time=time.thread_time))
    client = ready(serve(FirstFitPlanner(), Settings(role="api", max_plan_seconds=1.0)))
    request = crowd(6, [circle(50)], time_limit=0.1)
    reply = client.post("/plan", json=request)
    assert (reply.status_code, reply.json()["unassigned"]) == (200, [])
    asked = {"problem": request, "plan": reply.json()}
    assert client.post("/check", json=asked).status_code == 200
    assert next(hours) > 0


def test_a_large_request_is_refused_by_its_work_though_the_clock_stands(
        client: httpx.Client, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(travels, "legs_seconds", lambda *_: 0.0)
    seconds = count()
    monkeypatch.setattr("app.requests.conversion.preparing.time", SimpleNamespace(
        perf_counter=lambda: 50.0, thread_time=lambda: 0.1 * next(seconds)))
    [error] = client.post("/plan", json=crowd(300, [circle(100)], time_limit=1)).json()["errors"]
    assert error["code"] == "TOO_MUCH_WORK"
    assert "s so far" in error["message"] or "take about" in error["message"]


def test_work_ends_when_it_takes_too_long_though_the_estimate_did_not(
        monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(travels, "legs_seconds", lambda *_: 0.0)
    request = read_request(json.dumps(crowd(300, [circle(100)])).encode(), None)
    past = Preparing(seconds=1.0, limit="a limit", began=-1e9)
    with pytest.raises(InvalidRequestError) as refusal:
        task_of(request, past)
    assert refusal.value.errors[0].code == "TOO_MUCH_WORK"


@pytest.fixture
def at(monkeypatch: pytest.MonkeyPatch) -> Callable[..., Preparing]:
    """Return a function that returns work on which some seconds were spent, and no more are."""
    monkeypatch.setattr("app.requests.conversion.preparing.time",
                        SimpleNamespace(perf_counter=lambda: 0.0, thread_time=lambda: 50.0))
    return lambda spent, limit: Preparing(seconds=limit, limit="a limit", began=50.0 - spent)


@pytest.mark.parametrize(("limit", "spent"), [(0.0, 0.4), (0.15, 0.3), (0.5, 0.48), (1.0, 0.85)])
def test_little_work_goes_on_though_the_machine_was_busy(
        at: Callable[..., Preparing], limit: float, spent: float) -> None:
    at(spent, limit).pause()
    at(spent, limit).expect(0.01)


@pytest.mark.parametrize(("limit", "spent", "expected"), [
    (0.0, 0.0, 0.11), (0.15, 0.0, 0.14), (0.15, 0.45, 0.1), (1.0, 0.0, 0.91), (1.0, 0.8, 0.11),
    (10.0, 8.0, 1.1)])
def test_work_that_does_not_fit_is_refused_before_it_is_done(
        at: Callable[..., Preparing], limit: float, spent: float, expected: float) -> None:
    at(spent, limit).pause()
    with pytest.raises(InvalidRequestError) as refusal:
        at(spent, limit).expect(expected)
    assert "take about" in refusal.value.errors[0].message


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Return a list of the one time that it is, while nothing is worked."""
    now = [50.0]
    monkeypatch.setattr("app.requests.conversion.preparing.time",
                        SimpleNamespace(perf_counter=lambda: now[0], thread_time=lambda: 0.0))
    return now


def test_what_roads_take_comes_on_top_of_a_limit_that_nobody_stated(clock: list[float]) -> None:
    work = replace(preparing(OptionsInput(), Bounds(time_limit=60.0), lambda: False), began=0.0)
    with work.waiting() as until:
        assert until == 50.0 + 0.9 + PATIENCE_WITH_OTHERS
        clock[0] += 3.0
        work.pause()
    assert work.waited == 3.0
    work.pause()
    work.expect(0.8)
    with work.waiting() as until:
        assert until == 50.0 + 0.9 + PATIENCE_WITH_OTHERS
        clock[0] += PATIENCE_WITH_OTHERS
    assert work.waited == PATIENCE_WITH_OTHERS
    with pytest.raises(InvalidRequestError):
        work.pause()


@pytest.mark.parametrize(("options", "bound", "longest"), [
    (OptionsInput(time_limit=1.0), 60.0, 0.9), (OptionsInput(), 5.0, 5.9)])
def test_roads_have_no_longer_than_is_stated(clock: list[float], options: OptionsInput,
                                             bound: float, longest: float) -> None:
    work = replace(preparing(options, Bounds(time_limit=bound), lambda: False), began=0.0)
    with work.waiting() as until:
        assert until == 50.0 + longest
        clock[0] += longest + 0.1
    with pytest.raises(InvalidRequestError):
        work.pause()


@pytest.mark.parametrize(("limit", "spent"), [(0.0, 0.51), (0.15, 0.51), (1.0, 0.91), (10.0, 9.1)])
def test_work_ends_at_nine_tenths_of_a_time_limit_or_half_a_second(
        at: Callable[..., Preparing], limit: float, spent: float) -> None:
    with pytest.raises(InvalidRequestError) as refusal:
        at(spent, limit).pause()
    assert "so far" in refusal.value.errors[0].message


def test_work_ends_when_it_is_told_to() -> None:
    request = read_request(json.dumps(crowd(300, [circle(100)])).encode(), None)
    with pytest.raises(StoppedError):
        task_of(request, Preparing(lambda: True, began=-1e9))


def test_what_is_nearly_ready_is_done() -> None:
    stopped = Preparing(lambda: True)
    assert PATIENCE > 0
    stopped.pause()


@pytest.fixture
def flown(monkeypatch: pytest.MonkeyPatch) -> list[Flights]:
    """Count how often it is found out who sees whom."""
    made = []

    def note(*given: Any) -> Flights:
        made.append(Flights(*given))
        return made[-1]

    monkeypatch.setattr(ground, "Flights", note)
    return made


def sweep(grid: Request) -> bytes:
    base = crowd(5, [circle(50)]) | {"replan": {"plan": {"routes": []}}}
    return json.dumps({"base": base, "grid": grid}).encode()


def test_scenarios_on_the_same_ground_share_their_flights(flown: list[Flights]) -> None:
    reader = JobReader(["attention"], Settings())
    grid = {"fleet[0].drones.speed_kmh": [40, 50, 60], "customers[0].service_duration": [1, 2]}
    assert reader.validate("sweep", sweep(grid)) == 6
    assert len(flown) == 1


def test_scenarios_on_other_ground_fly_anew(flown: list[Flights]) -> None:
    reader = JobReader(["attention"], Settings())
    assert reader.validate("sweep", sweep({"planar_unit": [1, 2]})) == 2
    assert len(flown) == 2


def test_a_sweep_is_let_go_when_its_client_leaves(flown: list[Flights],
                                                  monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.requests.conversion.preparing.PATIENCE", 0.0)
    reader = JobReader(["attention"], Settings())
    with pytest.raises(StoppedError):
        reader.validate("sweep", sweep({"planar_unit": [1, 2, 3]}), lambda: len(flown) == 1)
    assert len(flown) == 1
