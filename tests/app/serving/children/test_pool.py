"""Work done by others, some of whom die."""

import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest

from app.schemas.errors import InvalidRequestError
from app.serving.children.child import Child
from app.serving.children.errors import EndedUnexpectedlyError
from app.serving.children.pool import Pool
from app.serving.children.starting import processes, threads
from app.serving.observe.logs import log_config
from tests.app.serving.children import works
from tests.conftest import PATIENCE, eventually

pytestmark = pytest.mark.slow

NEVER: Callable[[], bool] = lambda: False  # noqa: E731


def half(number: int, should_stop: Callable[[], bool]) -> int:
    """Answer what is asked."""
    if number % 2:
        raise ZeroDivisionError(f"{number} is odd")
    return number // 2


@pytest.fixture(scope="module", params=["processes", "threads"])
def pool(request: pytest.FixtureRequest) -> Iterator[Pool]:
    """Return three of a kind."""
    start = (threads(works.opened) if request.param == "threads"
             else processes(works.opened, log_config("json", "error"), [works.__name__]))
    pool = Pool(start, 3, {"half": half})
    yield pool
    pool.close()


@pytest.fixture(scope="module")
def deaths() -> list[str]:
    """Return what those were doing who died."""
    return []


@pytest.fixture(scope="module")
def mortal(deaths: list[str]) -> Iterator[Pool]:
    """Return two processes."""
    pool = Pool(processes(works.opened, log_config("json", "error"), [works.__name__]), 2,
                on_death=deaths.append)
    pool.warm(2)
    yield pool
    pool.close()


def test_results_come_back(pool: Pool) -> None:
    with ThreadPoolExecutor(6) as askers:
        found = askers.map(lambda number: pool.do(works.doubled, (number,), NEVER), range(20))
        assert list(found) == [2 * number for number in range(20)]


def test_questions_are_answered_and_what_is_told_is_heard(pool: Pool) -> None:
    told: list[Any] = []
    assert pool.do(works.ask, (6,), NEVER, {"answer": told.append}) == 3
    assert told == [3]
    with pytest.raises(ZeroDivisionError, match="7 is odd"):
        pool.do(works.ask, (7,), NEVER)


def test_errors_come_back_as_what_they_are(pool: Pool) -> None:
    with pytest.raises(InvalidRequestError) as caught:
        pool.do(works.find_wrong, (), NEVER)
    assert [error.path for error in caught.value.errors] == ["$.depots"]
    with pytest.raises(RuntimeError, match="OwnError") as unsent:
        pool.do(works.fail, (), NEVER)
    assert "works.py" in "".join(unsent.value.__notes__)


def test_work_ends_when_it_is_told_to(pool: Pool) -> None:
    begun = threading.Event()
    listeners = {"begun": lambda _: begun.set()}
    assert pool.do(works.wait, (), begun.is_set, listeners) == "stopped"
    # A late word means nobody else's work.
    assert pool.do(works.doubled, (1,), NEVER) == 2


def test_one_that_does_not_stop_is_ended(mortal: Pool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.serving.children.pool.STOP_SECONDS", 0.05)
    with pytest.raises(EndedUnexpectedlyError):
        mortal.do(works.go_on, (), lambda: True)
    assert mortal.do(works.doubled, (3,), NEVER) == 6


@pytest.mark.parametrize("number", [signal.SIGABRT, signal.SIGKILL])
def test_one_that_dies_takes_nobody_along(mortal: Pool, deaths: list[str], number: int) -> None:
    deaths.clear()
    begun, over = threading.Event(), threading.Event()
    with ThreadPoolExecutor(1) as askers:
        other = askers.submit(mortal.do, works.wait, (), over.is_set,
                              {"begun": lambda _: begun.set()})
        assert begun.wait(PATIENCE)
        with pytest.raises(EndedUnexpectedlyError):
            mortal.do(works.die, (number,), NEVER)
        assert deaths == ["request"]
        # Another takes its place.
        assert mortal.do(works.doubled, (4,), NEVER) == 8
        over.set()
        assert other.result() == "stopped"


def test_one_that_dies_without_work_is_missed_by_nobody(mortal: Pool, deaths: list[str]) -> None:
    deaths.clear()
    dying = mortal.do(works.process, (), NEVER)
    os.kill(dying, signal.SIGKILL)
    eventually(lambda: not Path("/proc", str(dying)).exists())
    eventually(lambda: mortal.do(works.doubled, (2,), NEVER) == 4 and deaths)
    assert deaths == ["nothing"]


def test_work_that_nobody_wants_is_dropped(mortal: Pool, deaths: list[str]) -> None:
    deaths.clear()
    begun = threading.Event()
    call = mortal.begin(works.wait, (), NEVER, "job", {"begun": lambda _: begun.set()})
    eventually(lambda: call.wait(0.01) or begun.is_set())
    call.drop()
    with pytest.raises(EndedUnexpectedlyError):
        call.result()
    assert mortal.do(works.doubled, (2,), NEVER) == 4
    assert deaths == []


def test_one_that_can_not_read_its_work_is_ended(
        mortal: Pool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "known_here_alone", works)
    monkeypatch.setattr(works.doubled, "__module__", "known_here_alone")
    with pytest.raises(EndedUnexpectedlyError):
        mortal.do(works.doubled, (2,), NEVER)
    monkeypatch.undo()
    assert mortal.do(works.doubled, (2,), NEVER) == 4


def test_the_same_does_work_again(mortal: Pool) -> None:
    assert len({mortal.do(works.process, (), NEVER) for _ in range(5)}) == 1


def test_what_hinders_all_of_them_is_told_at_once() -> None:
    pool = Pool(processes(works.refused, log_config("json", "error"), [works.__name__]), 1)
    with pytest.raises(ValueError, match="no policy"):
        pool.warm(1)
    pool.close()


@pytest.mark.parametrize("error", [BlockingIOError("no more processes"), EOFError()])
def test_one_that_cannot_start_now_is_to_be_asked_for_again(error: Exception) -> None:
    def start() -> Child:
        raise error

    pool = Pool(start, 1)
    for _ in range(2):
        with pytest.raises(EndedUnexpectedlyError, match="can be started"):
            pool.do(works.doubled, (1,), NEVER)
    pool.close()


def test_what_cannot_be_sent_takes_no_place() -> None:
    pool = Pool(threads(works.opened), 1)
    with pytest.raises(TypeError, match="lock"):
        pool.do(works.doubled, (threading.Lock(),), NEVER)
    assert pool.do(works.doubled, (2,), NEVER) == 4
    pool.close()
