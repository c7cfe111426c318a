"""Drives along points as lines: asked for in parts that a server takes, and put together again."""

from collections.abc import Sequence

import numpy as np
import polyline

from app.maps.roads.answers import MAX_DISTANCE, MAX_DURATION, NOISE_M
from app.maps.roads.engine import RoadRoute, RoadsAnswerError
from model.problem import FloatArray

DECIMALS = 6
"""Of coordinates in lines: a tenth of a metre."""

Line = list[tuple[float, float]]
"""Latitudes and longitudes."""


def stretches(count: int, most: int) -> list[slice]:
    """Cut so many points into parts of at most so many, each beginning where the last ends."""
    return [slice(begin, begin + most) for begin in range(0, max(count - 1, 1), most - 1)]


def decoded(geometry: str, decimals: int = DECIMALS) -> Line:
    """Return the points of an encoded line.

    Raises
    ------
    RoadsAnswerError
        If it is none, or leaves the globe.
    """
    try:
        line = polyline.decode(geometry, decimals)
    except (IndexError, ValueError):
        raise RoadsAnswerError("The server of roads answered a line that ends too soon.") from None
    if not line or any(abs(latitude) > 90 or abs(longitude) > 180 for latitude, longitude in line):
        raise RoadsAnswerError("The server of roads answered a line that leaves the globe.")
    return line


def route_of(lines: Sequence[Line], distances_m: Sequence[float],
             durations_s: Sequence[float]) -> RoadRoute:
    """Return a route of legs.

    Raises
    ------
    RoadsAnswerError
        If their lengths can't be right.
    """
    distances, durations = np.array(distances_m, np.float64), np.array(durations_s, np.float64)
    if not (_within(distances, -NOISE_M, MAX_DISTANCE) and _within(durations, 0, MAX_DURATION)):
        raise RoadsAnswerError("The server of roads answered a leg that can't be right.")
    return RoadRoute(_joined(lines), tuple(polyline.encode(line, DECIMALS) for line in lines),
                     np.maximum(distances, 0.0), durations)


def joined_route(routes: Sequence[RoadRoute]) -> RoadRoute:
    """Return one route of several, each beginning where the last ends."""
    if len(routes) == 1:
        return routes[0]
    lines = [polyline.decode(leg, DECIMALS) for route in routes for leg in route.legs]
    return RoadRoute(_joined(lines), tuple(leg for route in routes for leg in route.legs),
                     np.concatenate([route.distances_m for route in routes]),
                     np.concatenate([route.durations_s for route in routes]))


def _within(values: FloatArray, least: float, most: float) -> bool:
    return bool(((values >= least) & (values <= most)).all())


def _joined(lines: Sequence[Line]) -> str:
    """Encode lines as one, without what each repeats of the last."""
    whole: Line = []
    for line in lines:
        whole += line[1:] if whole and whole[-1] == line[0] else line
    return polyline.encode(whole, DECIMALS)
