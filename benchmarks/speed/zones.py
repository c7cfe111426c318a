"""How long requests with a country's zones take until all flights are known.

`python -m benchmarks.speed.zones --zones 2000 --customers 100` draws zones after ED-269, half of
them circles, over a country or close around the customers, and tells the seconds of each step, of
the processor.
"""

import argparse
import json
import math
import random
import time
from typing import Any

from app.requests.conversion.ground import Ground
from app.requests.conversion.places import PlacedRequest
from app.requests.reading import read_request
from app.schemas.request import PlanRequest
from app.serving.load.memory import collect_seldom

CENTER = (25.0, 62.0)
DEGREE_KM = 111.2
SPREADS_KM = {"country": 250.0, "region": 60.0, "city": 20.0}
"""How far zones lie from the middle, by name."""

CUSTOMERS_KM = 15.0
"""How far customers lie from the middle."""

SMALLEST_KM, LARGEST_KM = 0.1, 3.0
"""Radii of zones, small ones being more frequent."""

Data = dict[str, Any]


def drawn(zones: int, customers: int, spread_km: float, seed: int = 7) -> Data:
    """Return a request with zones around its customers."""
    rng = random.Random(seed)

    def place(within: float) -> list[float]:
        x, y = rng.uniform(-within, within), rng.uniform(-within, within)
        return [CENTER[0] + x / DEGREE_KM / math.cos(math.radians(CENTER[1])),
                CENTER[1] + y / DEGREE_KM]

    smaller = min(1.0, spread_km / 60)
    features = [_zone(index, place(spread_km), smaller, rng) for index in range(zones)]
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "hub", "location": list(CENTER)}],
        "customers": [{"id": f"c{index}", "location": place(CUSTOMERS_KM), "demand": [1]}
                      for index in range(customers)],
        "fleet": [{"id": "van", "count": 10, "capacity": [20],
                   "drones": {"count": 1, "capacity": [2]}}],
        "airspace": {"zones": [{"format": "ed269", "data": {"features": features}}]},
        "options": {"time_limit": 10},
    }


def _zone(index: int, center: list[float], smaller: float, rng: random.Random) -> Data:
    radius = 1000 * smaller * math.exp(
        rng.uniform(math.log(SMALLEST_KM), math.log(LARGEST_KM)))
    if index % 2:
        area: Data = {"type": "Circle", "center": center, "radius": radius}
    else:
        count = rng.randint(4, 60)
        turns = sorted(rng.uniform(0, 2 * math.pi) for _ in range(count))
        sizes = [radius * rng.uniform(0.5, 1.0) / 1000 / DEGREE_KM for _ in turns]
        area = {"type": "Polygon", "coordinates": [[
            [center[0] + size * math.cos(turn) / math.cos(math.radians(center[1])),
             center[1] + size * math.sin(turn)] for turn, size in zip(turns, sizes, strict=True)]]}
    return {"identifier": f"Z{index}", "country": "FIN", "name": f"Zone {index}",
            "type": "COMMON", "restriction": "PROHIBITED", "applicability": [{"permanent": "YES"}],
            "zoneAuthority": [{"name": "Authority"}],
            "geometry": [{"uomDimensions": "M", "lowerLimit": 0, "lowerVerticalReference": "AGL",
                          "upperLimit": 120, "upperVerticalReference": "AGL",
                          "horizontalProjection": area}]}


def timed(body: bytes) -> dict[str, float]:
    """Return the processor's seconds of each step, and how much there is to fly around."""
    began = time.process_time()
    request = read_request(body, None)
    read = time.process_time()
    placed = PlacedRequest(request)
    ground = Ground(placed)
    altitude = _altitude(request)
    obstacles = ground.airspace(altitude).obstacles
    merged = time.process_time()
    ground.flights(altitude).legs(60.0)
    flown = time.process_time()
    return {"validated": read - began, "merged": merged - read, "flown": flown - merged,
            "total": flown - began, "edges": len(obstacles.edges),
            "corners": len(obstacles.corners.place)}


def _altitude(request: PlanRequest) -> float:
    return request.fleet[0].drone_types[0].altitude


def main() -> None:
    """Print the seconds of each step."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--zones", type=int, default=2000)
    parser.add_argument("--customers", type=int, default=100)
    parser.add_argument("--spread", choices=SPREADS_KM, nargs="*", default=list(SPREADS_KM))
    arguments = parser.parse_args()
    collect_seldom()  # as the service does
    for spread in arguments.spread:
        body = json.dumps(drawn(arguments.zones, arguments.customers, SPREADS_KM[spread])).encode()
        told = ", ".join(f"{name} {value:.2f}" if isinstance(value, float) else f"{name} {value}"
                         for name, value in timed(body).items())
        print(f"{spread}: {len(body) / 1e6:.1f} MB, {told}", flush=True)


if __name__ == "__main__":
    main()
