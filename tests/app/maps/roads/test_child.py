import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from app.maps.roads.building import Build
from app.maps.roads.child import RoutingChild
from app.maps.roads.embedded import EmbeddedRoads
from app.maps.roads.engine import RoadsUnavailableError
from app.maps.roads.osrm import Osrm
from app.maps.roads.server import RoadServer
from app.maps.roads.tools import Tools
from tests.app.maps.roads.conftest import Places, served
from tests.app.maps.roads.wheels import ROOT

pytestmark = pytest.mark.slow


def soon() -> float:
    return time.perf_counter() + 60


def eventually(happens: Callable[[], bool]) -> bool:
    """Tell whether something happens within a minute."""
    until = soon()
    while time.perf_counter() < until and not happens():
        time.sleep(0.01)
    return happens()


def is_running(pid: int) -> bool:
    """Tell whether a process is there, and no zombie."""
    try:
        return "\nState:\tZ" not in Path(f"/proc/{pid}/status").read_text()
    except FileNotFoundError:
        return False


@pytest.fixture
def embedded(prepared_build: Build, tools: Tools) -> Iterator[EmbeddedRoads]:
    engine = EmbeddedRoads(prepared_build, tools)
    yield engine
    engine.close()


def test_a_child_that_is_killed_is_started_again(embedded: EmbeddedRoads,
                                                 helsinki_places: Places) -> None:
    places = helsinki_places(10, 1)
    before = embedded.table(places, soon())
    killed = embedded.child.pid
    assert killed is not None
    os.kill(killed, signal.SIGKILL)
    after = embedded.table(places, soon())
    np.testing.assert_array_equal(before.durations_s, after.durations_s)
    assert embedded.child.starts == 2
    assert embedded.child.pid != killed
    assert not is_running(killed)


def test_routes_survive_the_death_of_a_child_too(embedded: EmbeddedRoads,
                                                 helsinki_places: Places) -> None:
    places = helsinki_places(3, 2)
    before = embedded.route(places, soon())
    os.kill(embedded.child.pid or 0, signal.SIGKILL)
    assert embedded.route(places, soon()).geometry == before.geometry


def test_a_child_ends_with_the_engine(embedded: EmbeddedRoads, helsinki_places: Places) -> None:
    embedded.table(helsinki_places(3, 3), soon())
    pid = embedded.child.pid
    assert pid is not None
    embedded.close()
    assert eventually(lambda: not is_running(pid))
    with pytest.raises(RoadsUnavailableError):
        embedded.table(helsinki_places(3, 3), soon())


def test_a_child_does_not_outlive_its_service(prepared_build: Build, tools: Tools) -> None:
    script = ("import sys, time; from pathlib import Path; "
              "from app.maps.roads.child import RoutingChild; "
              "child = RoutingChild(Path(sys.argv[1]), Path(sys.argv[2]), 1); "
              "child.url(time.perf_counter() + 60); print(child.pid, flush=True); "
              "time.sleep(600)")
    with subprocess.Popen([sys.executable, "-c", script, tools.routed, prepared_build.data],
                          stdout=subprocess.PIPE, text=True, cwd=ROOT) as service:
        assert service.stdout is not None
        pid = int(service.stdout.readline())
        assert is_running(pid)
        service.kill()
    assert eventually(lambda: not is_running(pid))


def test_a_child_that_cannot_live_is_said_to_be_unavailable(prepared_build: Build, tools: Tools,
                                                            ) -> None:
    child = RoutingChild(tools.routed, prepared_build.data.with_name("nothing.osrm"), 1,
                         first_wait=0.01)
    try:
        with pytest.raises(RoadsUnavailableError, match="aren't ready"):
            child.url(time.perf_counter() + 1.0)
        assert eventually(lambda: child.starts > 1)
    finally:
        child.stop()


def test_a_child_without_its_program_is_said_to_be_unavailable(prepared_build: Build) -> None:
    child = RoutingChild(Path("/nowhere/osrm-routed"), prepared_build.data, 1, first_wait=0.01)
    try:
        with pytest.raises(RoadsUnavailableError, match="aren't ready"):
            child.url(time.perf_counter() + 0.5)
    finally:
        child.stop()


def test_nobody_waits_for_a_child_who_wants_to_stop(prepared_build: Build, tools: Tools) -> None:
    child = RoutingChild(tools.routed, prepared_build.data.with_name("nothing.osrm"), 1,
                         first_wait=60.0)
    try:
        with pytest.raises(RoadsUnavailableError):
            child.url(time.perf_counter() + 600, lambda: True)
    finally:
        child.stop()


def test_embedded_roads_are_those_of_a_server(embedded: EmbeddedRoads, prepared_build: Build,
                                              tools: Tools, helsinki_places: Places) -> None:
    """The same build, served as an operator would serve it, asked in one block and in many."""
    places = helsinki_places(60, 4)
    mine = embedded.table(places, soon())
    with served(tools.folder.parent, prepared_build.data) as url:
        server = Osrm(RoadServer(url, max_places=25))
        theirs = server.table(places, soon())
        server.close()
    np.testing.assert_array_equal(mine.durations_s, theirs.durations_s)
    np.testing.assert_array_equal(mine.distances_m, theirs.distances_m)
    np.testing.assert_array_equal(mine.snapped, theirs.snapped)
    assert np.isfinite(mine.durations_s).all()


def test_processes_of_a_pool_end_with_their_service() -> None:
    script = ("import os, time; from concurrent.futures import ProcessPoolExecutor; "
              "from multiprocessing import get_context; "
              "from app.serving.load.with_parent import end_with; "
              "pool = ProcessPoolExecutor(1, get_context('spawn'), end_with, (os.getpid(),)); "
              "print(pool.submit(os.getpid).result(), flush=True); time.sleep(600)")
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True,
                          cwd=ROOT) as service:
        assert service.stdout is not None
        pid = int(service.stdout.readline())
        assert is_running(pid)
        service.kill()
    assert eventually(lambda: not is_running(pid))
