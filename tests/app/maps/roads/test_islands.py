"""Islands of the road graph: where OSRM puts a place depends on what else it is asked about."""

import json
import re
import time
from urllib.parse import unquote

import numpy as np
import polyline
import pytest

from app.maps.roads.engine import RoadTable
from app.maps.roads.osrm import Osrm
from app.maps.roads.server import RoadServer
from tests.app.maps.roads import faults
from tests.app.maps.roads.faults import standing_in

pytestmark = pytest.mark.slow

MAINLAND = 25.0
"""East of it lies an island without a bridge; its places are put on the mainland's shore, unless
all are the island's."""


def answered(method: str, path: str, body: bytes) -> tuple[int, bytes]:
    """Answer as OSRM does, with drives along a parallel at 10 m/s."""
    line, sources, destinations = re.fullmatch(
        r"/table/v1/driving/polyline6\((.*)\)\?.*&sources=(.*)&destinations=(.*)",
        unquote(path)).groups()  # type: ignore[union-attr]
    places = np.array(polyline.decode(line, 6, geojson=True))
    on_island = (places[:, 0] > MAINLAND).all()
    roads = places if on_island else np.minimum(places, (MAINLAND, 90.0))
    origins, targets = ([int(index) for index in text.split(";")]
                        for text in (sources, destinations))
    metres = np.rint(np.abs(np.subtract.outer(roads[origins, 0], roads[targets, 0])) * 1.2e5)
    answer = {"code": "Ok", "distances": metres.tolist(), "durations": (metres / 10).tolist()}
    for part, listed in (("sources", origins), ("destinations", targets)):
        answer[part] = [{"location": roads[index].tolist()} for index in listed]
    return 200, json.dumps(answer).encode()


def table_of(longitudes: list[float], max_places: int) -> RoadTable:
    places = np.column_stack([longitudes, np.full(len(longitudes), 0.0)])
    with standing_in(answered, lambda: faults.nothing) as stand_in:
        engine = Osrm(RoadServer(stand_in.url, max_places))
        table = engine.table(places, time.perf_counter() + 60)
        engine.close()
    return table


@pytest.mark.thorough_after(3)
@pytest.mark.parametrize("longitudes", [
    [24.96, 24.97, 24.98, 25.01, 25.02, 25.03],
    [25.01, 25.02, 25.03, 25.04, 24.98, 24.97],
    [25.01, 25.02, 25.03, 25.04, 25.05, 25.06],
    [25.01, 24.98, 25.02, 25.03, 25.04, 25.05],
])
@pytest.mark.parametrize("max_places", [1, 2, 3])
def test_blocks_lie_where_the_whole_does(longitudes: list[float], max_places: int) -> None:
    table, whole = table_of(longitudes, max_places), table_of(longitudes, 6)
    np.testing.assert_array_equal(table.snapped, whole.snapped)
    np.testing.assert_array_equal(table.durations_s, whole.durations_s)
