"""Problems whose legs are computed: what their search waits for, and what is refused."""

import json
import subprocess
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import httpx
import pytest

from app.conversion import travels
from app.conversion.preparing import Preparing, StoppedError
from app.conversion.problem import to_problem
from app.conversion.travels import COMPUTED_FROM
from app.errors import InvalidRequestError
from app.plans import large
from app.plans.large import LargeSearch
from app.plans.service import PlanService
from app.requests.bounds import Bounds
from app.requests.reading import read_request
from app.settings import MAX_CUSTOMERS, Settings
from model.problem import Problem
from model.search.compiling import COMPUTED, LARGE, LARGE_RARER
from tests.app.conftest import FirstFitPlanner, ready
from tests.conftest import PATIENCE, eventually

Request = dict[str, Any]


@pytest.fixture(autouse=True)
def computed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Have the legs of all requests computed that state none."""
    monkeypatch.setattr(travels, "COMPUTED_FROM", 0)


@pytest.fixture
def is_compiled(monkeypatch: pytest.MonkeyPatch) -> threading.Event:
    """Return what tells whether the search is compiled, by a process that does nothing."""
    event = threading.Event()
    monkeypatch.setattr(large, "is_compiled", lambda part: event.is_set())
    monkeypatch.setattr(large, "COMPILE_LARGE", "import time; time.sleep(600)")
    return event


def problem_of(request: Request) -> Problem:
    return to_problem(read_request(json.dumps(request).encode(), None))


def _is_ready(service: PlanService) -> bool:
    return service.readiness().is_ready


def with_most_stops(request: Request) -> Request:
    (kind,) = request["fleet"]
    return {**request, "fleet": [{**kind, "max_stops": 1}]}


def test_requests_wait_until_their_search_is_compiled_once(
        serve: Callable[..., httpx.Client], smallest: Request, is_compiled: threading.Event,
        monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[list[str]] = []
    start = subprocess.Popen

    def noted(command: list[str], **options: Any) -> "subprocess.Popen[bytes]":
        begun.append(command)
        return start(command, **options)

    monkeypatch.setattr("app.plans.large.subprocess.Popen", noted)
    client = ready(serve(FirstFitPlanner(), Settings(role="api")))
    assert begun == []  # nobody needs it where so few customers are taken
    for request in (smallest, with_most_stops(smallest)):
        refusal = client.post("/plan", json=request)
        assert refusal.status_code == 503, refusal.text
        assert int(refusal.headers["retry-after"]) > 0
        assert "being compiled" in refusal.json()["detail"]
    eventually(lambda: begun)
    assert len(begun) == 1
    is_compiled.set()
    assert client.post("/plan", json=smallest).status_code == 200


@pytest.mark.parametrize("part", COMPUTED)
def test_a_search_is_waited_for_by_those_who_need_it(
        smallest: Request, part: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(large, "is_compiled", lambda other: other == part)
    monkeypatch.setattr(LargeSearch, "compile", lambda _: None)
    search = LargeSearch()
    assert search.serves(problem_of(smallest)) == (part == LARGE)
    assert search.serves(problem_of(with_most_stops(smallest))) == (part == LARGE_RARER)
    monkeypatch.setattr(travels, "COMPUTED_FROM", 10)
    assert search.serves(problem_of(smallest))


def test_legs_that_do_not_fit_tables_of_32_bits_wait_for_it_too(
        smallest: Request, is_compiled: threading.Event, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(travels, "COMPUTED_FROM", 10)
    monkeypatch.setattr(LargeSearch, "compile", lambda _: None)
    search = LargeSearch()
    for seconds, serves in ((2_147_483, True), (2_147_484, False)):
        table = [[0, 1, seconds], [1, 0, 1], [2, 1, 0]]
        places = [*smallest["depots"], *smallest["customers"]]
        for index, place in enumerate(places):
            place["location_index"] = index
        request = smallest | {"matrices": {"truck": {"durations": table, "distances": table}}}
        assert search.serves(problem_of(request)) == serves


def test_vroom_waits_for_it_too(monkeypatch: pytest.MonkeyPatch,
                                serve: Callable[..., httpx.Client],
                                is_compiled: threading.Event) -> None:
    # Few jobs need no search.
    monkeypatch.setattr("model.dialects.vroom.planning.is_few", lambda *_: False)
    client = ready(serve(FirstFitPlanner(), Settings(role="api")))
    for seconds, status in ((2_147_483, 200), (2_147_484, 503)):
        reply = client.post("/vroom", json={
            "vehicles": [{"id": 1, "start_index": 0}], "jobs": [{"id": 1, "location_index": 1}],
            "matrices": {"car": {"durations": [[0, 5], [seconds, 0]]}}})
        assert reply.status_code == status, reply.text
    assert "being compiled" in reply.json()["detail"]


def test_services_that_take_many_customers_compile_as_they_start(
        monkeypatch: pytest.MonkeyPatch) -> None:
    begun: list[LargeSearch] = []
    monkeypatch.setattr(LargeSearch, "compile", lambda search: begun.append(search))
    for customers, number in ((COMPUTED_FROM, 0), (MAX_CUSTOMERS, 1)):
        service = PlanService(FirstFitPlanner(), bounds=Bounds(customers=customers))
        service.start()
        eventually(partial(_is_ready, service))
        service.stop()
        assert len(begun) == number


def test_process_that_compiles_ends_with_its_service(smallest: Request,
                                                     is_compiled: threading.Event) -> None:
    search = LargeSearch()
    assert not search.serves(problem_of(smallest))
    process = eventually(lambda: search._process)
    search.stop()
    assert process.wait(PATIENCE) != 0
    search.compile()
    assert search._process is process


def test_jobs_wait_for_their_search(smallest: Request, is_compiled: threading.Event) -> None:
    service = PlanService(FirstFitPlanner(), bounds=Bounds(customers=1))
    problem, stopping = problem_of(smallest), threading.Event()
    stopping.set()
    with pytest.raises(StoppedError):
        service.await_search(problem, Preparing(stopping.is_set))
    threading.Timer(0.05, is_compiled.set).start()
    service.await_search(problem, Preparing())
    assert is_compiled.is_set()
    service.stop()


def test_more_places_than_there_is_time_for_are_refused_with_an_estimate(
        smallest: Request, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(travels, "COMPUTED", 7.0)
    request = read_request(json.dumps(smallest).encode(), None)
    began = time.perf_counter()
    with pytest.raises(InvalidRequestError) as refused:
        to_problem(request, Preparing(seconds=10.0, began=began))
    (error,) = refused.value.errors
    assert error.code == "TOO_MUCH_WORK"
    assert error.message.startswith("Plans of so many places take about 21.0 s")
    to_problem(request, Preparing(seconds=60.0, began=began))
