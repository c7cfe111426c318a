"""How long roads take: to be built, to tell all legs between places, and to tell them again.

    python -m benchmarks.speed.roads examples/helsinki.osm.pbf monaco.osm.pbf

Through the service's own code, with OSRM as it is installed or on the path. Places lie up to a
hundred metres from points of an extract's streets that a seed draws; each table is of others.
"""

import sys
import time
from collections.abc import Callable, Sequence
from functools import cache
from itertools import product
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np
import osmium

from app.maps.roads.building import build_roads
from app.maps.roads.nearness import nearness
from app.maps.roads.opening import opened_roads
from app.maps.roads.roads import Roads
from app.maps.roads.setting import Extract
from app.maps.roads.tools import find_tools
from app.serving.settings import Settings
from model.problem import FloatArray

FULL = (200, 1000, 2000)
FAR = (2500, 5000)
TRIES = 5
PATIENCE = 600.0

METRES_OFF, METRES_PER_DEGREE = 100.0, 111_195.0


def main() -> None:
    """Print a line for each extract and number of places."""
    with TemporaryDirectory() as folder:
        for number, name in enumerate(sys.argv[1:]):
            path = Path(folder) / f"{number}.osm.pbf"
            path.symlink_to(Path(name).resolve())
            print(Path(name).stem, flush=True)
            measure(path, Path(folder) / str(number))


def measure(extract: Path, data: Path) -> None:
    """Print what one extract takes."""
    began = time.perf_counter()
    build_roads(Extract(extract, "car"), find_tools())
    print(f"  built in {time.perf_counter() - began:.2f} s", flush=True)
    with opened_roads(Settings(roads=f"car={extract}", data_dir=data)) as roads:
        first, _ = whole_table(roads, drawn(extract, 2, 0))
        print(f"  first question answered after {1000 * first:.0f} ms")
        for count, tables in (*product(FULL, (whole_table,)), *product(FAR, (near_legs,))):
            tell(count, *zip(*(tables(roads, drawn(extract, count, seed))
                               for seed in range(1, TRIES + 1)), strict=True))


def whole_table(roads: Roads, places: FloatArray) -> tuple[float, float]:
    """Return the seconds of all legs between places, the first time and the second."""
    return twice(lambda: roads.table("car", places, time.perf_counter() + PATIENCE))


def near_legs(roads: Roads, places: FloatArray) -> tuple[float, float]:
    """Return the same of those legs that are asked for of many places."""
    return twice(lambda: roads.near_legs("car", places, nearness(places, [0]),
                                         time.perf_counter() + PATIENCE))


def twice(work: Callable[[], object]) -> tuple[float, float]:
    """Return the seconds that something takes, and takes again."""
    times = [time.perf_counter()]
    for _ in range(2):
        work()
        times.append(time.perf_counter())
    return times[1] - times[0], times[2] - times[1]


def tell(count: int, first: Sequence[float], second: Sequence[float]) -> None:
    """Print how long tables took, in the middle and at most."""
    for name, seconds in (("first", first), ("again", second)):
        print(f"  {count} places {name}: {1000 * median(seconds):.1f} ms, "
              f"at most {1000 * max(seconds):.1f}", flush=True)


def drawn(extract: Path, count: int, seed: int) -> FloatArray:
    """Return (place, 2) longitudes and latitudes by an extract's streets."""
    rng, streets = np.random.default_rng(seed), street_points(extract)
    degrees = METRES_OFF / METRES_PER_DEGREE
    places: FloatArray = (streets[rng.integers(len(streets), size=count)]
                          + rng.uniform(-degrees, degrees, (count, 2)))
    return places


@cache
def street_points(path: Path) -> FloatArray:
    """Return the (point, 2) longitudes and latitudes of all streets that have names."""
    found = osmium.FileProcessor(str(path), osmium.osm.NODE | osmium.osm.WAY).with_locations()
    return np.array([(node.lon, node.lat) for way in found
                     if isinstance(way, osmium.osm.Way)
                     and "highway" in way.tags and "name" in way.tags
                     for node in way.nodes if node.location.valid()])


if __name__ == "__main__":
    main()
