"""Jobs make way for plans that somebody waits for."""

import os
import sys
import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from app.serving.load.courtesy import NICENESS, stand_back

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
