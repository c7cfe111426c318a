"""Plans of so many places that most legs are estimated, and none that is driven."""

import time
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from pydantic_core import to_json

from app.maps.remote.asking import ShouldStop
from app.maps.roads import nearness
from app.maps.roads.engine import (
    USUAL, Block, Driving, RoadRoute, RoadTable, RoadsUnavailableError, whole,
)
from app.maps.roads.roads import Roads
from app.plans import far_plans
from app.plans.service import plan_options
from app.plans.task import Task, task_of
from app.requests.conversion import far_legs
from app.requests.conversion.preparing import Preparing
from app.requests.plan_reading import plan_to_solution
from app.requests.reading import read_request
from app.schemas.errors import NoRoadsError
from model.judge.accepting import Completed
from model.problem import FloatArray
from tests.app.conftest import FirstFitPlanner
from tests.app.maps.roads.test_legs import request

pytestmark = pytest.mark.slow

PLACES = 26


class Plain:
    """Roads that are longer one way than the other, as far as is asked; counts the legs."""

    name = "plain"

    def __init__(self) -> None:
        self.legs, self.answers = 0, 0
        self.driving: list[Driving] = []
        self.fails_after = 1_000

    def build(self) -> str:
        return "1"

    def table(self, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              wanted: Sequence[Block] | None = None,
              driving: Driving = USUAL) -> RoadTable:
        self.answers += 1
        if self.answers > self.fails_after:
            raise RoadsUnavailableError("They are down.")
        self.driving.append(driving)
        count = len(lon_lat)
        assert driving.curb is None or len(driving.curb) == count
        seconds = np.full((count, count), np.nan)
        for block in whole(count) if wanted is None else wanted:
            self.legs += len(block.origins) * len(block.destinations)
            for origin in block.origins:
                for destination in block.destinations:
                    seconds[origin, destination] = driven(lon_lat[origin], lon_lat[destination])
        np.fill_diagonal(seconds, 0.0)
        return RoadTable(seconds, 12 * seconds, lon_lat, np.zeros(count))

    def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
        raise RoadsUnavailableError("Nobody asks this one for lines.")

    def close(self) -> None:
        self.legs = 0


def driven(here: FloatArray, there: FloatArray) -> float:
    """Return the true seconds of a leg: no estimate by neighbours comes to the same."""
    east, north = np.abs(there - here)
    bend = np.sin(1e4 * here[0] + 7e3 * there[1]) ** 2
    return float(np.ceil(9_000 * (2 * east + north) * (1 + bend)))


@pytest.fixture(autouse=True)
def few_are_many(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(nearness, "GROUP", 3)
    monkeypatch.setattr(nearness, "NEAREST", 6)
    monkeypatch.setattr(far_legs, "LEGS_AT_ONCE", 5)


def spread_request(**changes: Any) -> dict[str, Any]:
    """Return customers in no order over a town, whom two trucks serve."""
    scattered = np.random.default_rng(3).uniform((25.0, 60.0), (25.2, 60.1), (PLACES - 1, 2))
    customers = [{"id": str(number), "location": place, "demand": [1]}
                 for number, place in enumerate(np.round(scattered, 6).tolist())]
    return {**request(), "customers": customers,
            "fleet": [{"id": "t", "count": 2, "capacity": [15]}],
            "options": {"time_limit": 2, "search_iterations": 10}, **changes}


def prepared(stated: dict[str, Any], engine: Plain) -> Task:
    roads = Roads({"truck": engine}, full_up_to=10)
    return task_of(read_request(to_json(stated), None), Preparing(), roads=roads)


def planned(stated: dict[str, Any], engine: Plain) -> dict[str, Any]:
    task = prepared(stated, engine)
    options = plan_options(read_request(to_json(stated), None).options)
    return task.reply(options, task.plan(FirstFitPlanner(), options, time.perf_counter()))


def seconds_apart(stated: dict[str, Any], reply: dict[str, Any]) -> list[tuple[float, float]]:
    """Return how long each leg of a plan is, as it says and in truth."""
    place = {each["id"]: np.array(each["location"])
             for each in (*stated["depots"], *stated["customers"])}
    return [(stop["arrival"] - before["departure"], driven(place[before["id"]], place[stop["id"]]))
            for route in reply["routes"] for trip in route["trips"]
            for before, stop in pairwise(trip["stops"])]


def test_all_legs_of_a_plan_are_true_though_few_were_asked_for() -> None:
    engine, stated = Plain(), spread_request()
    reply = planned(stated, engine)
    assert reply["summary"]["served"] == PLACES - 1
    legs = seconds_apart(stated, reply)
    assert len(legs) > PLACES
    assert all(told == true for told, true in legs)
    assert engine.legs < 0.7 * PLACES**2
    assert reply["legs"][0]["estimated"] == 0
    assert "estimated in the search" in reply["legs"][0]["note"]


def test_far_legs_are_driven_as_near_ones_are() -> None:
    engine = Plain()
    stated = spread_request(roads={"approach": "curb"})
    stated["fleet"][0]["avoid"] = ["tolls"]
    planned(stated, engine)
    assert len(engine.driving) > 1
    for driving in engine.driving:
        assert driving.avoid == ("tolls",)
        assert driving.curb is not None
        # The first of all that are asked for is the depot.
        assert driving.curb.tolist() == [False, *[True] * (len(driving.curb) - 1)]


def test_windows_hold_by_true_legs(monkeypatch: pytest.MonkeyPatch) -> None:
    # The search would put those back whose routes broke rules by true legs.
    monkeypatch.setattr(far_plans, "complete_plan",
                        lambda problem, begun, seed, stop: Completed(begun, True))
    stated = spread_request()
    for customer in stated["customers"]:
        customer["time_window"] = {"earliest": 0, "latest": 9_000}
    reply = planned(stated, Plain())
    assert all(told == true for told, true in seconds_apart(stated, reply))
    served = [stop for route in reply["routes"] for trip in route["trips"]
              for stop in trip["stops"] if stop["kind"] == "customer"]
    assert served
    assert max(stop["service_start"] for stop in served) <= 9_000


def test_any_plan_is_judged_by_true_legs() -> None:
    stated = spread_request()
    task = prepared(stated, Plain())
    plan = planned(stated, Plain())
    evaluation = task.check(plan_to_solution(to_json(plan), task.problem))
    assert evaluation.is_feasible
    assert evaluation.cost.total == pytest.approx(plan["cost"]["total"], rel=1e-9)


def test_no_plan_leaves_whose_legs_nobody_tells() -> None:
    engine = Plain()
    engine.fails_after = 1
    with pytest.raises(NoRoadsError, match=r"They are down\."):
        planned(spread_request(), engine)


def test_a_plan_that_goes_on_has_all_legs() -> None:
    stated = spread_request()
    plan, engine = planned(stated, Plain()), Plain()
    prepared(stated | {"replan": {"plan": plan}}, engine)
    assert engine.legs == PLACES**2


def test_what_is_near_or_of_the_hub_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(nearness, "NEAREST", 20)
    places = np.random.default_rng(1).uniform(0.0, 0.1, (200, 2))
    parts = nearness.nearness(places, [0])
    asked = np.zeros((200, 200), bool)
    for block in parts.wanted():
        asked[np.ix_(block.origins, block.destinations)] = True
    np.testing.assert_array_equal(asked, parts.asked())
    assert asked[0].all()
    assert asked[:, 0].all()
    np.testing.assert_array_equal(asked, asked.T)
    apart = np.hypot(*(places[:, None] - places).transpose(2, 0, 1))
    nearest = np.argsort(apart, axis=1)[:, 1]
    assert asked[np.arange(200), nearest].mean() > 0.95


def test_estimates_are_as_the_middles_of_groups_are_apart() -> None:
    places = np.random.default_rng(2).uniform((25.0, 0.0), (25.1, 0.1), (100, 2))
    parts = nearness.nearness(places, [0])
    straight = 111_195 * np.hypot(*(places[:, None] - places).transpose(2, 0, 1))
    known = np.where(parts.asked(), 1.5 * straight, np.nan)
    np.testing.assert_allclose(nearness.estimated(straight, known, parts), 1.5 * straight)
