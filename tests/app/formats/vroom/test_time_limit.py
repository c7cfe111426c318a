"""The time limit of `POST /vroom` holds for large requests, and what can't keep it is refused."""

import json
import random
import time
from typing import Any

import pytest

from app.formats.vroom.answering import answer
from app.formats.vroom.errors import TOO_LARGE, VroomError
from app.formats.vroom.places import find_places
from app.formats.vroom.schemas import VroomRequest
from app.formats.vroom.translate import translate
from app.requests.conversion.preparing import Preparing, StoppedError
from app.requests.conversion.work import legs_seconds
from app.schemas.errors import InvalidRequestError
from app.serving.load.received import ReceivedBody
from app.serving.settings import Settings
from model.dialects.vroom.convert import Converter
from model.dialects.vroom.drives import Drives
from model.dialects.vroom.places import Sites
from model.dialects.vroom.work import LegLimit
from model.planner import ALONE, Listener, PlanOptions, PlanResult
from model.problem import Problem
from model.solution import Solution
from tests.app.conftest import FirstFitPlanner

Data = dict[str, Any]

SPEEDS = {"car": 40.0}

LIMIT = LegLimit(10**9, "MOST")


def crowd(jobs: int, speeds: int = 1, **options: Any) -> Data:
    """Return jobs in a city with windows, for vehicles of a speed each."""
    rng = random.Random(0)
    hub = [10.0, 54.0]
    return {
        "vehicles": [{"id": number, "start": hub, "end": hub, "capacity": [9],
                      "speed_factor": 1 + number / 100} for number in range(speeds)],
        "jobs": [{"id": number, "delivery": [1], "time_windows": [[0, 15_000]],
                  "priority": rng.randrange(100),
                  "location": [rng.uniform(10, 10.4), rng.uniform(54, 54.4)]}
                 for number in range(jobs)],
        "options": options}


def asked(request: Data, planner: Any, settings: Settings | None = None,
          waited: float = 0.0) -> Data:
    """Return the reply to a request that came some seconds ago."""
    body = ReceivedBody(json.dumps(request).encode(), time.perf_counter() - waited)
    reply: Data = json.loads(answer(planner, body, settings or Settings(), lambda: False))
    return reply


@pytest.fixture
def no_matrices(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let no matrix be built."""
    def build(*given: Any) -> None:
        raise AssertionError("a matrix was built")

    monkeypatch.setattr(Drives, "_travel", build)


@pytest.mark.thorough
@pytest.mark.usefixtures("no_matrices")
def test_more_work_than_there_is_time_for_is_refused_before_it_is_done() -> None:
    # Far more than there is time for, which is far more than this takes on any machine.
    with pytest.raises(VroomError) as refusal:
        asked(crowd(2500, 80, l=15.0), FirstFitPlanner(), Settings(max_legs=10**9))
    assert refusal.value.code == TOO_LARGE
    for word in ("take about", "time limit of 15 s", "options.l", "TANDEM_MAX_PLAN_SECONDS"):
        assert word in str(refusal.value)


@pytest.mark.usefixtures("no_matrices")
def test_more_matrices_than_memory_holds_are_refused_before_one_is_built() -> None:
    with pytest.raises(VroomError, match=r"\d+ ways .*TANDEM_MAX_LEGS") as refusal:
        asked(crowd(100, 40, l=10), FirstFitPlanner(), Settings(max_legs=200_000))
    assert refusal.value.code == TOO_LARGE


@pytest.mark.parametrize("waited", [0.3, 30.0])
def test_a_small_request_is_answered_though_its_time_is_over(waited: float) -> None:
    reply = asked(crowd(7), FirstFitPlanner(), Settings(vroom_seconds=0.15), waited)
    assert reply["summary"]["unassigned"] == 0


def test_legs_are_not_looked_for_where_there_is_no_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.formats.vroom.places.great_circle_distances", None)
    # Above what may be asked for however little of the time is over.
    assert legs_seconds(4000, 1, 0, True) > 1.5
    request = VroomRequest.model_validate_json(json.dumps(crowd(4000)))
    # From now on: how long a request is read is another matter, and no short one here.
    with pytest.raises(InvalidRequestError) as refusal:
        find_places(request, SPEEDS, preparing=Preparing(seconds=1.5))
    assert "take about" in refusal.value.errors[0].message


def converted(request: Data, preparing: Preparing) -> int:
    """Build the problem of a request; return how many pairs of matrices it has."""
    read = VroomRequest.model_validate_json(json.dumps(request))
    places: Sites = find_places(read, SPEEDS)
    converter = Converter(translate(read), places, LIMIT)
    return len(converter.model(range(len(read.jobs)), preparing).problem.travel)


def test_matrices_are_no_longer_built_once_the_client_has_left() -> None:
    asked_so_far: list[bool] = []

    def should_stop() -> bool:
        asked_so_far.append(True)
        return len(asked_so_far) > 5

    with pytest.raises(StoppedError):
        converted(crowd(10, 40), Preparing(should_stop, began=-1e9))
    assert len(asked_so_far) == 6


def test_matrices_are_no_longer_built_once_the_time_is_over(
        monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("model.dialects.vroom.convert.model_seconds", lambda *_: 0.0)
    monkeypatch.setattr("model.dialects.vroom.convert.attempt_seconds", lambda *_: 0.0)
    with pytest.raises(InvalidRequestError):
        converted(crowd(10, 40), Preparing(seconds=1.0, began=-1e9))


class NotingPlanner(FirstFitPlanner):
    """Notes how long it may take each time."""

    def __init__(self) -> None:
        self.given: list[float] = []

    def plan(self, problem: Problem, options: PlanOptions, received_at: float | None = None,
             listener: Listener = ALONE, start: Solution | None = None) -> PlanResult:
        self.given.append(options.time_limit)
        return super().plan(problem, options, received_at, listener, start)


@pytest.fixture
def limited() -> Data:
    """Return jobs for a vehicle too small for all, which hours cost and kilometres limit."""
    request = crowd(12, l=2.0)
    request["vehicles"][0] |= {"capacity": [3], "max_distance": 150_000}
    return request


@pytest.mark.by_clock
@pytest.mark.parametrize(("seconds", "stages"), [(1e-9, 3), (1.0, 1)])
def test_stages_that_there_is_no_time_for_are_left_out(
        monkeypatch: pytest.MonkeyPatch, limited: Data, seconds: float, stages: int) -> None:
    monkeypatch.setattr("model.dialects.vroom.planning.attempt_seconds", lambda *_: seconds)
    planner = NotingPlanner()
    asked(limited, planner)
    assert len(planner.given) == stages
