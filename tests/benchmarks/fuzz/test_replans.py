"""Days that change while they go on are planned soundly, and faults are seen.

The study of two thousand is `python -m benchmarks.fuzz.replans`.
"""

import json
import random
from typing import Any

import httpx
import pytest

from benchmarks.fuzz.changing_days import Change, committed_to, morning, what_happens
from benchmarks.fuzz.problems import Fault
from benchmarks.fuzz.replans import Days, aboard
from benchmarks.fuzz.things_gone import with_a_thing_gone

pytestmark = pytest.mark.slow

Data = dict[str, Any]

DAYS = 40

ONCE_MOVED = (0, 16, 44, 56, 1466, 20_036)
"""Seeds of days on which parcels changed vehicles or were left out, though the plan given delivers
them, or a customer was served twice."""


def test_days_that_change_are_planned_soundly(client: httpx.Client) -> None:
    days = Days(client)
    for seed in (*range(DAYS), *ONCE_MOVED):
        days.try_day(seed)
    assert days.replanned > DAYS
    assert days.compared > DAYS
    assert set(days.statuses) == {"/plan 200", "/check 200"}


def test_days_of_which_something_is_gone_are_planned_or_refused(client: httpx.Client) -> None:
    days = Days(client)
    for seed in range(DAYS // 3):
        days.try_gone(seed)
    assert days.replanned > DAYS // 5
    assert set(days.statuses) == {"/plan 200", "/plan 422", "/check 200"}


def test_days_on_which_nothing_has_changed_cost_no_more(client: httpx.Client) -> None:
    days = Days(client)
    for seed in range(DAYS):
        days.try_unchanged(seed)
    assert days.replanned > DAYS // 2


def test_late_vehicles_are_nowhere_sooner_than_they_can_be(client: httpx.Client) -> None:
    days = Days(client)
    for seed in range(DAYS // 2):
        days.try_late(seed)
    assert days.replanned > DAYS // 4


def stop(name: str, arrival: float, departure: float) -> Data:
    """Return a stop, at which service begins at once."""
    return {"kind": "depot" if name == "hub" else "customer", "id": name, "arrival": arrival,
            "service_start": arrival, "departure": departure}


@pytest.fixture
def tour() -> Data:
    """Return a plan of one van, whose drone is in the air from 45 to 70."""
    flight = {"drone": "t-1/drone-1", "launch_time": 45.0, "launch_stop": 1, "recovery_stop": 2,
              "recovery_time": 70.0, "customers": [{"id": "C", "service_start": 60.0}]}
    stops = [stop("hub", 0, 10), stop("A", 20, 45), stop("B", 49, 70), stop("D", 80, 90),
             stop("hub", 99, 99)]
    return {"routes": [{"vehicle": "t-1", "type": "t", "trips": [
        {"stops": stops, "sorties": [flight]}]}], "unassigned": []}


FLEET = {"fleet": [{"id": "t", "drones": {"launch_duration": 5}}]}


def test_aboard_is_what_has_left_and_is_not_served(tour: Data) -> None:
    assert aboard(tour, 5.0) == {}
    assert aboard(tour, 15.0) == {"t-1": {"A", "B", "C", "D"}}
    assert aboard(tour, 48.0) == {"t-1": {"B", "C", "D"}}
    assert aboard(tour, 95.0) == {"t-1": set()}
    assert aboard(tour, 99.0) == {}


def test_whoever_a_vehicle_is_bound_for_is_committed_to(tour: Data) -> None:
    assert set(committed_to(tour, 5.0, FLEET)) == set()
    assert set(committed_to(tour, 39.0, FLEET)) == {"A"}
    assert set(committed_to(tour, 40.0, FLEET)) == {"A", "B", "C"}
    assert set(committed_to(tour, 75.0, FLEET)) == {"A", "B", "C", "D"}


def reply(tour: Data, vehicle: str, *reasons: str, **replan: Any) -> Data:
    """Return a plan in which D is another vehicle's, or nobody's for some reasons."""
    trips = [{"stops": [stop("hub", 0, 10), stop("D", 20, 30)], "sorties": []}]
    left = [{"id": "D", "reasons": [{"code": code} for code in reasons]}] if reasons else []
    routes = [] if reasons else [{"vehicle": vehicle, "trips": trips}]
    return {"routes": [*tour["routes"][1:], *routes], "unassigned": left, "replan": replan}


@pytest.mark.parametrize(("broken", "answer", "fault"), [
    ((), ("t-1",), None), ((), ("t-2",), "D is aboard t-1, and t-2 is to serve it"),
    ((), ("t-1", "SEARCH"), "D is aboard t-1, but"), ((), ("t-1", "ABOARD"), None),
    (("t-1",), ("t-2",), "not told of")])
def test_parcels_that_move_are_faults(tour: Data, broken: tuple[str, ...],
                                      answer: tuple[str, ...], fault: str | None) -> None:
    days = Days(httpx.Client())
    change = Change({"customers": [{"id": "D"}]}, 48.0, frozenset(broken))
    if fault is None:
        days.hold_aboard(change, tour, reply(tour, *answer))
    else:
        with pytest.raises(Fault, match=fault):
            days.hold_aboard(change, tour, reply(tour, *answer))
    told = reply(tour, "t-2", parcels=[{"id": "D", "vehicle": "t-1"}])
    days.hold_aboard(Change(change.request, 48.0, frozenset({"t-1"})), tour, told)


def test_one_thing_alone_is_taken_away_or_changed() -> None:
    request = morning(random.Random(3))
    before = json.dumps(request)
    found = [with_a_thing_gone(random.Random(seed), request) for seed in range(100)]
    assert json.dumps(request) == before
    assert all(later != request for later in found)
    assert len({json.dumps(later) for later in found}) > 30
    assert all(later["options"] == request["options"] for later in found)


def test_days_are_drawn_from_the_generator_alone(tour: Data) -> None:
    assert morning(random.Random(3)) == morning(random.Random(3))
    request = morning(random.Random(3)) | FLEET
    first, second = (what_happens(random.Random(5), request, tour) for _ in range(2))
    assert first == second
