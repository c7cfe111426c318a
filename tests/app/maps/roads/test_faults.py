"""Roads through a proxy that delays, cuts and lies: what comes out is right, or an error."""

import gc
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from app.maps.roads.building import Build
from app.maps.roads.engine import RoadsError, RoadsStoppedError, RoadsUnavailableError, RoadTable
from app.maps.roads.osrm import Osrm
from app.maps.roads.server import RoadServer
from app.maps.roads.tools import Tools
from model.problem import FloatArray
from tests.app.conftest import FirstFitPlanner
from tests.app.maps.roads import faults
from tests.app.maps.roads.conftest import HELSINKI_BOX, Places, served
from tests.app.maps.roads.fault_kinds import MENDED, NOWHERE, SLOW, WRONG
from tests.app.maps.roads.faults import Fault, proxied
from tests.app.maps.roads.faulty_plans import Tries

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings(
    # asyncio leaves a socket to be collected if it is cancelled while that connects.
    "ignore:Exception ignored in:pytest.PytestUnraisableExceptionWarning")]

TRIES, PLANS = 500, 40
DOWN = RoadsUnavailableError

CLOSINGS = 8
"""Moments at which what is being asked ends."""


def soon(seconds: float = 60.0) -> float:
    """Return a time that no answer reaches, unless the machine stalls."""
    return time.perf_counter() + seconds


@pytest.fixture(scope="module", autouse=True)
def collected() -> Iterator[None]:
    """Have sockets collected before other tests."""
    yield
    gc.collect()


@pytest.fixture(scope="module")
def places(helsinki_places: Places) -> FloatArray:
    return helsinki_places(12, 6)


@pytest.fixture(scope="module")
def true_table(helsinki_osrm: str, places: FloatArray) -> RoadTable:
    engine = Osrm(RoadServer(helsinki_osrm))
    table = engine.table(places, soon())
    engine.close()
    return table


def engine_at(url: str, **limits: float) -> Osrm:
    return Osrm(RoadServer(**{  # type: ignore[arg-type]
        "url": url, "max_places": 6, "first_wait": 0.001, "failures": 10**9, **limits}))


def assert_equal(table: RoadTable, other: RoadTable) -> None:
    for got, wanted in zip(vars(table).values(), vars(other).values(), strict=True):
        np.testing.assert_array_equal(got, wanted)


class Once:
    """Chooses a fault the first time it is asked, then none."""

    def __init__(self, *planned: Fault) -> None:
        self._left: Iterator[Fault] = iter(planned)

    def __call__(self) -> Fault:
        return next(self._left, faults.nothing)


@pytest.mark.parametrize("name", MENDED)
def test_fault_that_passes_is_mended(name: str, helsinki_osrm: str, places: FloatArray,
                                     true_table: RoadTable) -> None:
    with proxied(helsinki_osrm, Once(MENDED[name], MENDED[name])) as proxy:
        engine = engine_at(proxy.url)
        assert_equal(engine.table(places, soon()), true_table)
        engine.close()
    assert proxy.questions == 4 + 2


@pytest.mark.parametrize("name", MENDED)
def test_fault_that_stays_is_an_error(name: str, helsinki_osrm: str, places: FloatArray) -> None:
    with proxied(helsinki_osrm, lambda: MENDED[name]) as proxy:
        engine = engine_at(proxy.url, max_places=12)
        with pytest.raises(DOWN, match="failed"):
            engine.table(places, soon())
        engine.close()
    assert proxy.questions == 4


@pytest.mark.thorough_after(12)
@pytest.mark.parametrize("name", WRONG)
def test_wrong_answer_is_an_error(name: str, helsinki_osrm: str, places: FloatArray) -> None:
    with proxied(helsinki_osrm, Once(WRONG[name])) as proxy:
        engine = engine_at(proxy.url, at_once=1)
        with pytest.raises(RoadsError):
            engine.table(places, soon())
        engine.close()
    assert proxy.questions <= 4


def test_block_that_contradicts_others_is_asked_for_again(
        helsinki_osrm: str, places: FloatArray, true_table: RoadTable) -> None:
    with proxied(helsinki_osrm, Once(NOWHERE)) as proxy:
        engine = engine_at(proxy.url, at_once=1)
        assert_equal(engine.table(places, soon()), true_table)
        engine.close()
    with proxied(helsinki_osrm, Once(*[NOWHERE] * 5)) as proxy:
        engine = engine_at(proxy.url, at_once=1)
        with pytest.raises(RoadsError, match="without a road"):
            engine.table(places, soon())
        engine.close()


@pytest.mark.thorough
def test_never_a_wrong_table(helsinki_osrm: str, places: FloatArray,
                             true_table: RoadTable) -> None:
    rng = np.random.default_rng(0)
    bad = [*MENDED.values(), *WRONG.values(), *SLOW.values(), NOWHERE]
    many = [*bad, *[faults.nothing] * (2 * len(bad))]
    overruns: list[float] = []

    def tried(seconds: float) -> bool:
        until = soon(seconds)
        try:
            table = (cut if seconds > 2.4 else whole).table(places, until)
        except RoadsError:
            return False
        finally:
            overruns.append(time.perf_counter() - until)
        assert_equal(table, true_table)
        return True

    with proxied(helsinki_osrm, faults.chosen(many, rng)) as proxy:
        cut, whole = (engine_at(proxy.url, patience=0.5, max_places=most) for most in (6, 12))
        with ThreadPoolExecutor(8) as threads:
            went_well = sum(threads.map(tried, rng.uniform(0.0, 3.0, TRIES)))
        cut.close()
        whole.close()
    assert 0.1 * TRIES < went_well < 0.9 * TRIES
    # Eight at once take turns, on a machine that does other things, too.
    assert max(overruns) < 30.0


@pytest.mark.by_clock
@pytest.mark.parametrize("fault", [faults.delay(1_000.0), faults.drip(0.02)])
def test_deadline_is_kept(fault: Fault, helsinki_osrm: str, places: FloatArray) -> None:
    with proxied(helsinki_osrm, lambda: fault) as proxy:
        engine = engine_at(proxy.url)
        until = soon(0.2)
        with pytest.raises(DOWN, match="in time"):
            engine.table(places, until)
        assert 0.0 <= time.perf_counter() - until < 0.5
        engine.close()


@pytest.mark.by_clock
def test_who_stops_doesn_t_wait(helsinki_osrm: str, places: FloatArray) -> None:
    with proxied(helsinki_osrm, lambda: faults.delay(1_000.0)) as proxy:
        engine = engine_at(proxy.url)
        began = time.perf_counter()
        with pytest.raises(RoadsStoppedError):
            engine.table(places, soon(), lambda: proxy.questions > 1)
        assert time.perf_counter() - began < 1.0
        engine.close()


@pytest.mark.parametrize("closing", range(CLOSINGS))
def test_closing_ends_what_is_asked(helsinki_osrm: str, places: FloatArray, closing: int) -> None:
    with proxied(helsinki_osrm, lambda: faults.delay(1_000.0)) as proxy, \
            ThreadPoolExecutor(1) as thread:
        engine = engine_at(proxy.url)
        asked = thread.submit(engine.table, places, soon())
        while proxy.questions == 0:
            assert not asked.done()
            time.sleep(0.0001)
        time.sleep(0.0002 * closing)
        engine.close()
        with pytest.raises(DOWN, match="any more"):
            asked.result()


def test_pause_that_ends_too_late_isn_t_waited_for(helsinki_osrm: str, places: FloatArray) -> None:
    with proxied(helsinki_osrm, Once(faults.status(429, Retry_After="100"))) as proxy:
        engine = engine_at(proxy.url, max_places=len(places))
        with pytest.raises(DOWN, match="429"):
            engine.table(places, soon(99.0))
        engine.close()
    assert proxy.questions == 1


def test_server_that_fails_again_and_again_is_left_alone(
        helsinki_osrm: str, places: FloatArray, true_table: RoadTable,
        monkeypatch: pytest.MonkeyPatch) -> None:
    down = True
    with proxied(helsinki_osrm, lambda: faults.status(500) if down else faults.nothing) as proxy:
        engine = engine_at(proxy.url, failures=3, rest=600.0, at_once=1)
        for _ in range(3):
            with pytest.raises(DOWN, match="500"):
                engine.table(places, soon())
        asked, down = proxy.questions, False
        with pytest.raises(DOWN, match="left alone"):
            engine.table(places, soon())
        assert proxy.questions == asked
        later = time.monotonic() + 601.0
        monkeypatch.setattr("circuitbreaker.monotonic", lambda: later)
        for _ in range(2):
            assert_equal(engine.table(places, soon()), true_table)
        engine.close()


def test_callers_without_time_don_t_make_a_server_seem_down(
        helsinki_osrm: str, places: FloatArray, true_table: RoadTable) -> None:
    with proxied(helsinki_osrm, lambda: faults.delay(0.01)) as proxy:
        engine = engine_at(proxy.url, failures=3, rest=1_000.0)
        for _ in range(5):
            with pytest.raises(DOWN, match="in time"):
                engine.table(places, soon(0.0))
        assert_equal(engine.table(places, soon()), true_table)
        engine.close()


def test_redirections_are_not_followed(helsinki_osrm: str, places: FloatArray) -> None:
    with proxied(helsinki_osrm, lambda: faults.nothing) as other:
        away = faults.status(307, Location=f"{other.url}/table")
        with proxied(helsinki_osrm, lambda: away) as proxy:
            engine = engine_at(proxy.url)
            with pytest.raises(DOWN, match="307"):
                engine.table(places, soon())
            engine.close()
        assert other.questions == 0


def test_long_addresses_are_cut(helsinki_osrm: str, places: FloatArray,
                                true_table: RoadTable) -> None:
    with proxied(helsinki_osrm, lambda: faults.nothing) as proxy:
        engine = engine_at(proxy.url, max_places=100, max_url=225)
        assert_equal(engine.table(places, soon()), true_table)
        engine.close()
    assert proxy.questions == 4


def test_no_plan_has_a_wrong_leg(tools: Tools, prepared_build: Build) -> None:
    with served(tools.folder.parent, prepared_build.data) as url:
        found = Tries(url, HELSINKI_BOX, FirstFitPlanner()).outcomes(PLANS)
    assert found.total() == PLANS
    for outcome in ("all legs true", "said to be estimated", "refused"):
        assert any(outcome in name for name in found), found


@pytest.mark.by_clock
@pytest.mark.parametrize(("planned", "words", "is_late"), [
    ((faults.status(503), faults.delay(1_000)), "failed: status 503", False),
    ((faults.delay(1_000),), "in time", True)])
def test_who_runs_out_of_time_is_told_what_failed_before(
        planned: tuple[Fault, ...], words: str, is_late: bool, helsinki_osrm: str,
        places: FloatArray) -> None:
    with proxied(helsinki_osrm, Once(faults.nothing, *planned)) as proxy:
        engine = engine_at(proxy.url, max_places=100)
        engine.table(places, soon())
        with pytest.raises(RoadsUnavailableError, match=words) as raised:
            engine.table(places, soon(0.8))
        engine.close()
    assert raised.value.is_late == is_late
