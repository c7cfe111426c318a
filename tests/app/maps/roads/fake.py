"""A source of roads that answers what a test states."""

from collections.abc import Sequence

import numpy as np

from app.maps.remote.asking import ShouldStop
from app.maps.roads.engine import (
    USUAL, Block, Driving, RoadRoute, RoadTable, RoadsError, RoadsUnavailableError,
)
from model.problem import FloatArray


class StatedRoads:
    """Answers the same table whatever is asked, or fails; counts its answers."""

    name = "stated"

    def __init__(self, table: RoadTable | RoadsError, build: str = "1") -> None:
        self.answer = table
        self.map = build
        self.asked: list[FloatArray] = []
        self.driving: list[Driving] = []

    def build(self) -> str:
        return self.map

    def table(self, lon_lat: FloatArray, until: float,
              should_stop: ShouldStop = lambda: False,
              wanted: Sequence[Block] | None = None,
              driving: Driving = USUAL) -> RoadTable:
        self.asked.append(lon_lat)
        self.driving.append(driving)
        if isinstance(self.answer, RoadsError):
            raise self.answer
        return self.answer

    def route(self, lon_lat: FloatArray, until: float, driving: Driving = USUAL) -> RoadRoute:
        raise RoadsUnavailableError("Nobody asks this one for lines.")

    def close(self) -> None:
        self.asked.clear()


def table_of(durations: list[list[float]], snap_m: list[float] | None = None) -> RoadTable:
    """Return a table whose distances are ten metres for each second."""
    seconds = np.array(durations, float)
    size = len(seconds)
    return RoadTable(seconds, 10 * seconds, np.zeros((size, 2)),
                     np.zeros(size) if snap_m is None else np.array(snap_m, float))
