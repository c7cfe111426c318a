"""Where endpoints turn to for plans."""

import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from app.maps.roads.roads import NO_ROADS
from app.plans.desk import CHECKED_AT_ONCE, PlanDesk
from app.requests.bounds import UNBOUNDED
from app.serving.children.line import Line
from app.serving.children.pool import Pool
from app.serving.children.starting import threads
from app.serving.observe.metrics import Metrics
from tests.conftest import SOON

begun = threading.Semaphore(0)
may_end = threading.Event()


def never() -> bool:
    """Tell that nothing is to stop."""
    return False


def wait(line: Line, should_stop: Callable[[], bool]) -> None:
    """Wait until all may end."""
    begun.release()
    may_end.wait()


def answer(line: Line, should_stop: Callable[[], bool]) -> int:
    """Answer at once."""
    return 42


def test_plans_wait_for_no_checks_of_jobs() -> None:
    pool = Pool(threads(lambda line: line), CHECKED_AT_ONCE + 1)
    desk = PlanDesk(pool, (), UNBOUNDED, NO_ROADS, Metrics("1"), lambda _: None)
    with ThreadPoolExecutor(2 * CHECKED_AT_ONCE) as clients:
        for _ in range(2 * CHECKED_AT_ONCE):
            clients.submit(desk.check, wait, should_stop=never)
        try:
            for _ in range(CHECKED_AT_ONCE):
                assert begun.acquire(timeout=SOON)
            patience = time.monotonic() + SOON
            assert desk.do(answer, should_stop=lambda: time.monotonic() > patience) == 42
        finally:
            may_end.set()
    pool.close()
