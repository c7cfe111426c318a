"""Tiny problems whose answers were worked out by hand."""

import asyncio
import gc
import logging
import os
import secrets
import socket
import threading
import time
from collections import defaultdict
from collections.abc import Callable, Coroutine, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from copy import deepcopy
from heapq import nlargest
from inspect import signature
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pytest
from filelock import FileLock

from app.serving.load.memory import collect_seldom
from model.engine.cores import num_cores
from model.problem import MM_PER_KM, Customer, Depot, DroneType, Problem, Travel, VehicleType

MINUTE = 60_000

PATIENCE, SOON = 180.0, 90.0
"""Seconds to wait for anything, and for what takes not long, on a machine that has much else to do.
"""

PAUSE, LONGEST_PAUSE = 0.01, 0.1
"""Seconds between the first two looks at something, and between later ones at most: whoever asks a
service a hundred times a second takes the processor from what is waited for."""

Result = TypeVar("Result")

WHERE_PLANS_ARE_REFUSED = "model.judge.accepting", "model.dialects.vroom.planning"
"""Loggers that are told when the judge refuses a plan."""


class _Refusals(logging.Handler):
    """Keeps what is told of plans that were refused."""

    def __init__(self) -> None:
        super().__init__()
        self.told: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep a message. In place."""
        self.told.append(record.getMessage())


MOST_WORKERS = 8
"""Processes that run tests at most, since each takes a gigabyte."""


def pytest_xdist_auto_num_workers() -> int:
    """Return how many processes run tests: two for each core, within the quota on them.

    Who waits for a service, a browser or the end of some time leaves a core to another: one more
    than there are cores left a third of two cores idle.
    """
    return min(2 * num_cores(), MOST_WORKERS)


def pytest_configure() -> None:
    """Have Python look for circles of objects seldom, as a service has it."""
    collect_seldom()


def pytest_collection_finish() -> None:
    """Leave out what was imported and collected, by far the most, when circles are looked for."""
    gc.freeze()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests with PostgreSQL as slow, and have the slow ones begin. In place.

    What is quick fills the cores at the end. Of a test's many cases those after the first few are
    marked as thorough, where it says so.
    """
    cases: defaultdict[str, int] = defaultdict(int)
    for item in items:
        if "[postgresql" in item.name:
            item.add_marker(pytest.mark.slow)
        few = item.get_closest_marker("thorough_after")
        if few is not None:
            test = item.nodeid.partition("[")[0]
            cases[test] += 1
            if cases[test] > few.args[0]:
                item.add_marker(pytest.mark.thorough)
    items.sort(key=lambda item: item.get_closest_marker("slow") is None)


SLOWEST = 10
"""Files of tests that are told of at the end, with how long they took."""


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Tell which files took longest, fixtures included, on whichever core they ran."""
    took: defaultdict[str, float] = defaultdict(float)
    for reports in terminalreporter.stats.values():
        for report in reports:
            if isinstance(report, pytest.TestReport):
                took[report.nodeid.partition("::")[0]] += report.duration
    terminalreporter.section(f"slowest {SLOWEST} files")
    for path in nlargest(SLOWEST, took, key=took.__getitem__):
        terminalreporter.write_line(f"{took[path]:7.1f} s  {path}")


TRIES = 20
"""How often a test by the clock is run at most."""

STALL = 0.05
"""Seconds for which the machine may let a test wait before its failure proves nothing."""


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> bool | None:
    """Run a test by the clock once more if it fails while other work has the processor."""
    if pyfuncitem.get_closest_marker("by_clock") is None:
        return None
    given = {name: pyfuncitem.funcargs[name] for name in signature(pyfuncitem.obj).parameters}
    for left in reversed(range(TRIES)):
        began, used = time.perf_counter(), time.process_time()
        try:
            # Tests change requests.
            pyfuncitem.obj(**{name: deepcopy(value) if isinstance(value, dict) else value
                              for name, value in given.items()})
        except (Exception, pytest.fail.Exception):  # a list that is too short, a client that waits
            waited = time.perf_counter() - began - (time.process_time() - used)
            if waited < STALL or left == 0:
                raise
        else:
            break
    return True


@pytest.fixture(autouse=True)
def _no_plan_is_refused(request: pytest.FixtureRequest) -> Iterator[None]:
    """Fail where the judge refused a plan, though another stood for it in the answer."""
    refused = _Refusals()
    for name in WHERE_PLANS_ARE_REFUSED:
        logging.getLogger(name).addHandler(refused)
    yield
    for name in WHERE_PLANS_ARE_REFUSED:
        logging.getLogger(name).removeHandler(refused)
    if request.node.get_closest_marker("plans_are_refused") is None:
        assert refused.told == []


@pytest.fixture(scope="session", autouse=True)
def own_data_dir(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Have services under test keep their data in a folder of their own."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("TANDEM_DATA_DIR", str(tmp_path_factory.mktemp("data")))
        yield


@pytest.fixture(scope="session")
def shared_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder of all processes that run tests, for what takes long and is made once."""
    base = tmp_path_factory.getbasetemp()
    return base.parent if "PYTEST_XDIST_WORKER" in os.environ else base


@contextmanager
def made_once(path: Path) -> Iterator[Path | None]:
    """Yield where to make a file or folder, None if it is there. Others wait meanwhile."""
    with FileLock(path.with_name(f"{path.name}.lock")):
        if path.exists():
            yield None
        else:
            unfinished = path.with_name(f"{path.name}.part")
            yield unfinished
            unfinished.rename(path)


def eventually(happens: Callable[[], Any], seconds: float = PATIENCE) -> Any:
    """Wait until something is true, and return it. Others have the processor meanwhile."""
    deadline, pause = time.monotonic() + seconds, PAUSE
    while not (seen := happens()):
        assert time.monotonic() < deadline, "it did not happen"
        threading.Event().wait(pause)
        pause = min(1.3 * pause, LONGEST_PAUSE)
    return seen


def soon(happens: Callable[[], Any]) -> Any:
    """Wait like `eventually` for what doesn't take long."""
    return eventually(happens, SOON)


def end(thread: threading.Thread) -> None:
    """Wait for the end of a thread that was told to end, and fail if it goes on."""
    thread.join(PATIENCE)
    assert not thread.is_alive(), f"{thread.name} goes on"


def free_port() -> int:
    """Return a port of this machine that nobody listens on.

    It is none of those that systems give to whoever names no port, as anybody might get it then
    before it is used.
    """
    while True:
        port = 10_000 + secrets.randbelow(20_000)
        with socket.socket() as probe, suppress(OSError):
            probe.bind(("127.0.0.1", port))
            return port


def apart(function: Callable[..., Result], *given: Any) -> Result:
    """Call a function in a thread of its own: an open browser has its loop run in the tests'."""
    with ThreadPoolExecutor(1) as executor:
        return executor.submit(function, *given).result()


def complete(coroutine: Coroutine[Any, Any, Result]) -> Result:
    """Run a coroutine in a thread of its own."""
    return apart(asyncio.run, coroutine)


def _street(places: Sequence[float], minutes_per_km: int) -> Travel:
    metres = np.rint(np.abs(np.subtract.outer(places, places)) * 1000).astype(np.int64)
    return Travel(duration=metres * minutes_per_km * MINUTE // 1000,
                  distance=metres * MM_PER_KM // 1000)


def _problem(
    *customers: Customer,
    truck: VehicleType,
    more_types: tuple[VehicleType, ...] = (),
    places: Sequence[float] | None = None,
    num_depots: int = 1,
    unassigned_cost: float = 1000.0,
) -> Problem:
    """Return a problem on a straight street, by default with a customer at every kilometre.

    Trucks (travel 0) need 2 minutes per km, drones (travel 1) need 1.
    """
    num_nodes = num_depots + len(customers)
    if places is None:
        places = range(num_nodes)
    return Problem(
        depots=tuple(Depot(f"depot-{index}") for index in range(num_depots)),
        customers=customers,
        vehicle_types=(truck, *more_types),
        travel=(_street(places, 2), _street(places, 1)),
        coordinates=np.column_stack([places, np.zeros(num_nodes)]).astype(np.float64),
        unassigned_cost=unassigned_cost,
    )


@pytest.fixture(scope="session")
def tiny_problem() -> Callable[..., Problem]:
    """Build a problem on a straight street."""
    return _problem


@pytest.fixture(scope="session")
def customers() -> tuple[Customer, ...]:
    """Four customers a, b, c, d: one unit each, five minutes of service."""
    return tuple(Customer(name, (1000,), service_duration=5 * MINUTE) for name in "abcd")


@pytest.fixture(scope="session")
def truck() -> VehicleType:
    """Two trucks for ten units, without limits and costs."""
    return VehicleType("truck", count=2, capacity=(10_000,), travel=0)


@pytest.fixture(scope="session")
def drones() -> DroneType:
    """One drone for five units; launch and recovery take a minute each."""
    return DroneType(count=1, capacity=(5000,), travel=1, launch_duration=MINUTE,
                     recovery_duration=MINUTE)
