"""Jobs make way for plans that somebody waits for."""

import os
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from app.serving.load import courtesy
from app.serving.load.courtesy import NICENESS, Courtesy, stand_back
from tests.conftest import soon

pytestmark = pytest.mark.slow


def niceness() -> int:
    """Return that of the thread that asks."""
    return os.getpriority(os.PRIO_PROCESS, threading.get_native_id())


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has priorities of threads")
def test_threads_that_stand_back_leave_others_as_they_are() -> None:
    def searching() -> tuple[int, int]:
        stand_back()
        with ThreadPoolExecutor(1) as pool:
            return niceness(), pool.submit(niceness).result()

    before = niceness()
    with ThreadPoolExecutor(1) as pool:
        assert pool.submit(searching).result() == (NICENESS, NICENESS)
    assert niceness() == before


def test_work_waits_until_nobody_waits_for_a_plan() -> None:
    waits, done = threading.Event(), threading.Event()
    waits.set()
    way = Courtesy(waits.is_set)

    def work() -> None:
        way.give_way()
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    assert not done.is_set()
    waits.clear()
    soon(done.is_set)
    thread.join()


def test_work_is_not_put_off_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(courtesy, "LONGEST", 0.0)
    Courtesy(lambda: True).give_way()
    Courtesy(lambda: True).give_way(lambda: True)
