"""Whole plans on roads that are asked for through a proxy that delays, cuts and lies.

    python -m tests.app.maps.roads.faulty_plans [tries]

Who plans doesn't matter, so it is the tests' own planner.
"""

import json
import logging
import sys
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import cycle, pairwise
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from app.maps.roads.building import build_roads
from app.maps.roads.osrm import Osrm
from app.maps.roads.osrm_tables import in_floats, in_json
from app.maps.roads.roads import Roads
from app.maps.roads.server import RoadServer
from app.maps.roads.setting import Extract
from app.maps.roads.tools import find_tools
from app.plans.service import plan_options
from app.plans.task import task_of
from app.requests.conversion.preparing import Preparing
from app.requests.reading import read_request
from app.schemas.errors import InvalidRequestError, NoRoadsError
from model.planner import Planner
from model.problem import FloatArray
from tests.app.conftest import FirstFitPlanner
from tests.app.maps.roads import faults
from tests.app.maps.roads.conftest import HELSINKI, HELSINKI_BOX, served
from tests.app.maps.roads.fault_kinds import MENDED, NOWHERE, SLOW, WRONG
from tests.app.maps.roads.faults import proxied

TRIES = 500

REQUESTS, PLACES = 11, 13
"""Requests that are tried in turn, and the places of each."""

AT_ONCE = 8

AT_MOST = (PLACES, PLACES, 7)
"""Places of a question: all, or about half."""

SECONDS = (0.1, 4.0)
"""Least and most that a try may take before its search."""

WALKED = 5 / 3.6
"""Metres walked in a second."""

ROUNDING = 0.005
"""Seconds by which a leg may be longer than in truth, as times are whole milliseconds."""

Box = tuple[float, float, float, float]


class Tries:
    """Plans again and again, and compares each leg with the truth.

    Parameters
    ----------
    url
        A server that answers as it should.
    box
        Where places are scattered.
    """

    def __init__(self, url: str, box: Box, planner: Planner) -> None:
        self._url = url
        self._planner = planner
        west, south, east, north = box
        self._places = [np.round(np.random.default_rng(seed).uniform(
            (west, south), (east, north), (PLACES, 2)), 6) for seed in range(REQUESTS)]
        engine = Osrm(RoadServer(url))
        self._true = [_walked(engine, places) for places in self._places]
        engine.close()

    def outcomes(self, count: int, seed: int = 0) -> Counter[str]:
        """Return how many of so many tries came to what; a wrong leg raises.

        Raises
        ------
        AssertionError
            If a plan drives a leg that is neither true nor said to be estimated.
        """
        bad = [*MENDED.values(), *WRONG.values(), *SLOW.values(), NOWHERE]
        rng = np.random.default_rng(seed)
        chosen = faults.chosen([*bad, *[faults.nothing] * (2 * len(bad))], rng)
        with proxied(self._url, chosen) as proxy:
            engines = [Osrm(RoadServer(proxy.url, max_places=most, first_wait=0.001, patience=0.3,
                                       failures=10**9), form=form)
                       for form in (in_json, in_floats) for most in AT_MOST]
            with ThreadPoolExecutor(AT_ONCE) as threads:
                found = Counter(threads.map(self._tried, cycle(engines), range(count),
                                            rng.uniform(*SECONDS, count)))
            for engine in engines:
                engine.close()
        return found

    def _tried(self, engine: Osrm, number: int, seconds: float) -> str:
        which, falls_back = number % REQUESTS, number // REQUESTS % 2 == 1
        body = _request(self._places[which], falls_back)
        request = read_request(json.dumps(body).encode(), self._planner.policies)
        allowed = Preparing(seconds=seconds, least_time=0.0)
        try:
            # With a cache of its own: what was kept from a try before would be no try.
            task = task_of(request, allowed, roads=Roads({"car": engine}))
        except (NoRoadsError, InvalidRequestError) as error:
            return f"refused: {error.title}"
        options = plan_options(request.options)
        result = task.plan(self._planner, options, time.perf_counter())
        reply = task.reply(options, result)
        if reply["legs"][0]["estimated"]:
            assert falls_back
            return "planned: with legs said to be estimated"
        for start, end, seconds in _driven(reply):
            assert abs(seconds - self._true[which][start, end]) < ROUNDING, (number, start, end)
        return "planned: all legs true"


def _walked(engine: Osrm, places: FloatArray) -> FloatArray:
    """Return the true seconds of each leg, ways to and from the road included."""
    table = engine.table(places, time.perf_counter() + 600)
    durations = np.where(np.isnan(table.durations_s),
                         table.durations_s[:, :1] + table.durations_s[:1], table.durations_s)
    walks = table.snap_m / WALKED
    return durations + walks[:, None] + walks


def _request(places: FloatArray, falls_back: bool) -> dict[str, Any]:
    depot, *others = places.tolist()
    return {
        "coordinate_system": "geographic", "depots": [{"id": "0", "location": depot}],
        "customers": [{"id": str(number), "demand": [1], "location": place}
                      for number, place in enumerate(others, 1)],
        "fleet": [{"id": "car", "profile": "car", "count": 3, "capacity": [5]}],
        "roads": {"fallback": "great_circle"} if falls_back else None,
        "options": {"time_limit": 1, "search_iterations": 0}}


def _driven(reply: dict[str, Any]) -> Iterator[tuple[int, int, float]]:
    """Yield the legs that trucks drive, by their places, and how long they take."""
    for route in reply["routes"]:
        for trip in route["trips"]:
            for before, stop in pairwise(trip["stops"]):
                yield int(before["id"]), int(stop["id"]), stop["arrival"] - before["departure"]


def main() -> None:
    """Print what many tries on the roads of Helsinki's centre come to."""
    tries = int(sys.argv[1]) if len(sys.argv) > 1 else TRIES
    logging.disable(logging.WARNING)
    tools = find_tools()
    with TemporaryDirectory() as folder:
        path = Path(folder) / HELSINKI.name
        path.symlink_to(HELSINKI)
        data = build_roads(Extract(path, "car"), tools).data
        with served(tools.folder.parent, data) as url:
            found = Tries(url, HELSINKI_BOX, FirstFitPlanner()).outcomes(tries)
    for outcome, count in sorted(found.items()):
        print(f"{count:4} {outcome}")


if __name__ == "__main__":
    main()
