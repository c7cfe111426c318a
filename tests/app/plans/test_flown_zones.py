"""Nobody flies through a zone: random plans, judged by shapely on what was published."""

import json
import math
import random
from typing import Any

import numpy as np
import polyline
import pytest
import shapely
from pyproj import Geod

from app.plans.service import PlanService
from app.requests.reading import read_request
from model.travel.matrices import LocalProjection
from tests.app.conftest import FirstFitPlanner
from tests.app.maps.airspace.published import ed269, zone
from tests.seeds import often, seeds

Data = dict[str, Any]
EARTH = Geod(ellps="WGS84")
CENTER = (24.94, 60.17)
DEGREE_M = 111_195.0
ROUNDED_M = 0.3
"""How far lines of a reply may lie beside what is flown: they have six digits."""

FEET = 0.3048


def place(rng: random.Random, size: float = 4000.0) -> list[float]:
    x, y = rng.uniform(-size, size), rng.uniform(-size, size)
    return [CENTER[0] + x / DEGREE_M / math.cos(math.radians(CENTER[1])), CENTER[1] + y / DEGREE_M]


def star(rng: random.Random, at: list[float], radius: float, corners: int) -> list[list[float]]:
    turns = sorted(rng.uniform(0, 2 * math.pi) for _ in range(corners))
    reach = [radius * rng.uniform(0.4, 1.0) / DEGREE_M for _ in turns]
    return [[at[0] + size * math.cos(turn) / math.cos(math.radians(at[1])),
             at[1] + size * math.sin(turn)] for turn, size in zip(turns, reach, strict=True)]


def area(rng: random.Random) -> Data:
    at, radius = place(rng), rng.choice((60.0, 300.0, 900.0, 2000.0))
    if rng.random() < 0.4:
        return {"type": "Circle", "center": at, "radius": radius}
    rings = [star(rng, at, radius, rng.randint(8, 30))]
    if rng.random() < 0.3:
        rings.append(star(rng, at, 0.3 * radius, 8))
    shape = shapely.Polygon(rings[0], rings[1:])
    return {"type": "Polygon", "coordinates": rings} if shape.is_valid else area(rng)


def volume(rng: random.Random) -> Data:
    limits = {"uomDimensions": rng.choice(("M", "FT")),
              "lowerLimit": rng.choice((None, 0, 0, 60, 150)),
              "lowerVerticalReference": "AGL",
              "upperLimit": rng.choice((None, 50, 120, 400, 99999)),
              "upperVerticalReference": rng.choice(("AGL", "AGL", "AMSL"))}
    return {name: value for name, value in limits.items() if value is not None} | {
        "horizontalProjection": area(rng)}


def zones(rng: random.Random) -> list[Data]:
    return [zone(*[volume(rng) for _ in range(rng.randint(1, 3))], identifier=str(number),
                 restriction=rng.choice(("PROHIBITED", "REQ_AUTHORISATION", "CONDITIONAL",
                                         "NO_RESTRICTION")))
            for number in range(rng.randint(1, 25))]


def asked(rng: random.Random) -> Data:
    return {
        "coordinate_system": "geographic",
        "depots": [{"id": "hub", "location": place(rng)}],
        "customers": [{"id": str(number), "location": place(rng), "demand": [1],
                       "served_by": "drone"} for number in range(8)],
        "fleet": [{"id": "truck", "count": 2, "capacity": [99],
                   "drones": {"count": 2, "capacity": [9], "max_customers_per_sortie": 2,
                              "altitude": rng.choice((30.0, 100.0, 130.0))}}],
        "airspace": {"zones": [ed269(*zones(rng))], "cleared": ["3", "7"],
                     "conditional": rng.choice(("block", "allow")),
                     "wind": {"speed_kmh": rng.choice((0, 20)), "direction_deg": 250}},
        "options": {"time_limit": 0, "geometry": True},
    }


def closed(request: Data) -> tuple[list[Data], list[Data]]:
    """Return the volumes that drones may not fly through, and those that they may not land in.

    By the published limits, in a way of its own.
    """
    altitude = request["fleet"][0]["drones"]["altitude"]
    through, landing = [], []
    for each in request["airspace"]["zones"][0]["data"]["features"]:
        free = each["restriction"] == "NO_RESTRICTION" or each["identifier"] in ("3", "7") or (
            each["restriction"] == "CONDITIONAL"
            and request["airspace"]["conditional"] == "allow")
        for part in () if free else each["geometry"]:
            unit = FEET if part["uomDimensions"] == "FT" else 1.0
            if part.get("lowerLimit", 0) * unit > altitude:
                continue
            landing.append(part["horizontalProjection"])
            upper = part.get("upperLimit", 99999)
            if upper == 99999 or part["upperVerticalReference"] == "AMSL" or (
                    upper * unit >= altitude):
                through.append(part["horizontalProjection"])
    return through, landing


def depth(shape: Data, points: Any, projection: LocalProjection) -> float:
    """Return how many metres the deepest of (point, 2) degrees lies within a published area."""
    if shape["type"] == "Circle":
        count = len(points)
        *_, away = EARTH.inv(np.full(count, shape["center"][0]), np.full(count, shape["center"][1]),
                             points[:, 0], points[:, 1])
        return float((shape["radius"] - np.asarray(away)).max())
    dense = shapely.segmentize(shapely.Polygon(shape["coordinates"][0], shape["coordinates"][1:]),
                               1e-3)
    on_plane = shapely.transform(dense, projection.project)
    planar = np.array(shapely.points(projection.project(points)))
    inside = shapely.covers(on_plane, planar)
    depths = shapely.distance(on_plane.boundary, planar[inside])
    return float(depths.max()) if len(depths) else -1.0


def flown_lines(plan: Data) -> list[Any]:
    """Return all flights' ways, but those that the service had no time left to look for."""
    return [np.array(polyline.decode(line, 6))[:, ::-1]
            for route in plan["routes"] for trip in route["trips"] for sortie in trip["sorties"]
            for line in (*(visit["geometry"] for visit in sortie["customers"]),
                         sortie["recovery_geometry"]) if line is not None]


def judged(seed: int) -> tuple[int, int]:
    """Plan at random and look at each flight; return how many there are, and who is left out."""
    rng = random.Random(seed)
    request = asked(rng)
    body = json.dumps(request).encode()
    plan = json.loads(PlanService(FirstFitPlanner()).reply_to(read_request(body, None), 0.0))
    projection = LocalProjection.around(np.array(
        [each["location"] for each in (*request["depots"], *request["customers"])]))
    through, landing = closed(request)
    lines = flown_lines(plan)
    for line in lines:
        string = shapely.LineString(projection.project(line))
        points = projection.unproject(shapely.get_coordinates(shapely.segmentize(string, 20.0)))
        for shape in through:
            assert depth(shape, points, projection) <= ROUNDED_M, (seed, shape)
        for shape in landing:
            assert depth(shape, line[[0, -1]], projection) <= ROUNDED_M, (seed, shape)
    return len(lines), len(plan["unassigned"])


@pytest.mark.thorough
def test_nobody_flies_through_a_zone() -> None:
    found = [judged(seed) for seed in seeds(40)]
    flights, left_out = (sum(numbers) for numbers in zip(*found, strict=True))
    assert flights > often(100)
    assert left_out > often(20)


@pytest.mark.parametrize("radius", [60.0, 900.0])
def test_a_flight_through_a_zone_would_be_found(radius: float) -> None:
    projection = LocalProjection.around(np.array([CENTER]))
    points = np.array([CENTER, (24.95, 60.17)])
    circle = {"type": "Circle", "center": list(CENTER), "radius": radius}
    ring = star(random.Random(1), list(CENTER), radius, 20)
    assert depth(circle, points, projection) == pytest.approx(radius)
    assert depth({"type": "Polygon", "coordinates": [ring]}, points, projection) > 0.3 * radius
