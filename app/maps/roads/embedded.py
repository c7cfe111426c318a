"""Roads of an extract: OSRM's adapter, asking the child that answers from its build."""

import threading
import time
from collections.abc import Callable, Sequence
from typing import TypeVar

from app.maps.remote.asking import ShouldStop
from app.maps.roads.building import Build
from app.maps.roads.child import MAX_ROUTE, RoutingChild
from app.maps.roads.engine import (
    USUAL, Block, Driving, RoadRoute, RoadsUnavailableError, RoadTable,
)
from app.maps.roads.osrm import Osrm
from app.maps.roads.osrm_tables import quickest
from app.maps.roads.server import RoadServer
from app.maps.roads.tools import Tools
from model.problem import FloatArray

PLACES_AT_ONCE = 2000
"""Places of one question: where tables are cut, ways are looked for again in each part."""

UNPACKED = {"Accept-Encoding": "identity"}
"""To pack answers takes longer than to find the ways, and they don't leave the machine."""

PATIENCE, FIRST_WAIT = 300.0, 0.05
"""Most seconds for an answer of the child, whom nobody else asks, and until it is asked again."""

LONGEST_ADDRESS = 2**20

NEVER = 10**9
"""Faults after which the child is left alone: it is started again instead."""

THREADS = 2

KEPT = 2
"""Who asks the child before the last may still be waiting for an answer."""

Answer = TypeVar("Answer")


class EmbeddedRoads:
    """Roads of one profile from an extract."""

    name = "osrm"

    def __init__(self, build: Build, tools: Tools) -> None:
        self._build = build
        self.child = RoutingChild(tools.routed, build.data, THREADS)
        self._lock = threading.Lock()
        self._starts = 0  # of the child last asked
        self._asked: list[Osrm] = []

    def start(self) -> None:
        """Start the child, so that the first question needn't wait for it. In place."""
        self.child.start()

    def build(self) -> str:
        """Return what tells the build from others."""
        return self._build.key

    def table(self, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              wanted: Sequence[Block] | None = None,
              driving: Driving = USUAL) -> RoadTable:
        """Return the drives between places."""
        return self._twice(lambda osrm: osrm.table(lon_lat, until, should_stop, wanted, driving),
                           until, should_stop)

    def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
        """Return the drive along points."""
        return self._twice(lambda osrm: osrm.route(lon_lat, until, driving), until)

    def close(self) -> None:
        """End the child, and let go of connections. In place."""
        self.child.stop()
        with self._lock:
            for osrm in self._asked:
                osrm.close()
            self._asked.clear()

    def _twice(self, ask: Callable[[Osrm], Answer], until: float,
               should_stop: ShouldStop = lambda: False) -> Answer:
        """Return an answer, asked for once more if the child ended meanwhile."""
        url, starts = self.child.url(until, should_stop), self.child.starts
        try:
            return ask(self._osrm_at(url, starts))
        except RoadsUnavailableError:
            if time.perf_counter() >= until or not self.child.has_ended_since(starts):
                raise
            url = self.child.url(until, should_stop)
            return ask(self._osrm_at(url, self.child.starts))

    def _osrm_at(self, url: str, starts: int) -> Osrm:
        """Return what asks the child; a new one for each, which has no faults yet."""
        with self._lock:
            if self._starts != starts:
                self._starts = starts
                self._asked.append(Osrm(RoadServer(
                    url, max_places=PLACES_AT_ONCE, max_points=MAX_ROUTE, at_once=THREADS,
                    patience=PATIENCE, first_wait=FIRST_WAIT, max_url=LONGEST_ADDRESS,
                    failures=NEVER, headers=UNPACKED), form=quickest))
                if len(self._asked) > KEPT:
                    self._asked.pop(0).close()
            return self._asked[-1]
