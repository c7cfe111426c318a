"""`airspace.buffer`: how far flights keep from areas and zones, and what is told of it."""

import io
import json
import math
import random
import zipfile
from itertools import pairwise
from typing import Any

import httpx
import numpy as np
import pytest
import shapely
from pyproj import Geod

from model.travel.matrices import LocalProjection
from tests.app.maps.airspace.published import circle, ed269, ed318, geojson, kml, volume, zone
from tests.app.plans.asking import planned, refused
from tests.app.plans.flights.asking import files_of, sent
from tests.app.plans.test_closures import BEHIND, asked, mask
from tests.seeds import often

Data = dict[str, Any]
EARTH = Geod(ellps="WGS84")
BETWEEN = [24.93, 60.1702]
DEGREE_M = 111_195.0


def ring(at: list[float], *metres: tuple[float, float]) -> list[list[float]]:
    """Return corners so many metres east and north of a place."""
    return [[at[0] + east / DEGREE_M / math.cos(math.radians(at[1])), at[1] + north / DEGREE_M]
            for east, north in metres]


BOX = ((-400.0, -300.0), (350.0, -250.0), (420.0, 380.0), (-380.0, 300.0))
SQUARE = ring(BETWEEN, *BOX)
AREA = {"type": "Polygon", "coordinates": [[*SQUARE, SQUARE[0]]]}
ROUND = {"type": "Point", "coordinates": BETWEEN,
         "extent": {"subType": "Circle", "radius": 500.0}}
WAYS: dict[str, Data] = {
    "no_fly": {"no_fly": [SQUARE]},
    "ed269": {"zones": [ed269(zone(volume(horizontalProjection=AREA)))]},
    "ed269 circle": {"zones": [ed269(zone(circle(500, BETWEEN)))]},
    "ed318": {"zones": [ed318(AREA)]},
    "ed318 circle": {"zones": [ed318(ROUND)]},
    "geojson": {"zones": [geojson(AREA)]},
    "kml": {"zones": [kml(" ".join(f"{x},{y}" for x, y in AREA["coordinates"][0]))]},
}


def exported(client: httpx.Client, request: Data, file_format: str = "geojson") -> bytes:
    """Return the file of the only drone's flights."""
    plan = planned(client, request)
    content, = files_of(sent(client, request, plan, file_format, "vehicle")).values()
    return content


def lines(client: httpx.Client, request: Data) -> list[Any]:
    """Return the exported flights as (place, 2) longitudes and latitudes."""
    features = json.loads(exported(client, request))["features"]
    return [np.array(each["geometry"]["coordinates"])[:, :2] for each in features
            if each["properties"]["kind"] == "flight"]


def nearest(line: Any, area: Data) -> float:
    """Return how near a line on the globe comes to an area, negative within, by pyproj."""
    steps = [EARTH.npts(x, y, to_x, to_y, 150, initial_idx=0, terminus_idx=0)
             for (x, y), (to_x, to_y) in pairwise(line.tolist()) if (x, y) != (to_x, to_y)]
    points = np.concatenate(steps)
    count = len(points)
    if "extent" in area or "radius" in area:
        at = area.get("coordinates") or area["center"]
        radius = area["radius"] if "radius" in area else area["extent"]["radius"]
        *_, away = EARTH.inv(np.full(count, at[0]), np.full(count, at[1]), *points.T)
        return float(np.asarray(away).min()) - radius
    around = LocalProjection.around(np.array(area["coordinates"][0]))
    shape = shapely.transform(shapely.Polygon(area["coordinates"][0]), around.project)
    planar = shapely.points(around.project(points))
    inside = bool(shapely.covers(shape, planar).any())
    return -1.0 if inside else float(shapely.distance(shape, planar).min())


@pytest.mark.thorough_after(6)
@pytest.mark.parametrize("buffer", [0, 1, 30, 250])
@pytest.mark.parametrize("way", WAYS)
def test_no_exported_flight_comes_nearer_than_the_buffer(client: httpx.Client, way: str,
                                                         buffer: float) -> None:
    if way == "kml":
        pytest.importorskip("fastkml")
    flown = lines(client, asked(airspace=WAYS[way] | {"buffer": buffer}))
    shape = ROUND if "circle" in way else AREA
    found = min(nearest(line, shape) for line in flown)
    assert found >= buffer - (0 if way != "no_fly" or buffer else 0.1)
    assert found <= buffer * 1.02 + 8


@pytest.mark.slow
def test_random_flights_keep_their_distance(client: httpx.Client) -> None:
    """Circles and polygons of all sizes, judged by what was published; detours among them."""
    rng, bent, close = random.Random(5), 0, 0
    for _ in range(often(20)):
        latitude, buffer = rng.choice((-35.0, 0.0, 48.0, 69.0)), rng.choice((0.0, 5.0, 30.0, 120.0))
        hub, shapes = [10.0, latitude], []
        for _ in range(rng.randint(2, 9)):
            at = ring(hub, (rng.uniform(-3000, 3000), rng.uniform(-3000, 3000)))[0]
            radius = rng.choice((20.0, 150.0, 800.0))
            turns = sorted(rng.uniform(0, 2 * math.pi) for _ in range(rng.randint(5, 12)))
            corners = ring(at, *((radius * math.cos(turn), radius * math.sin(turn))
                                 for turn in turns))
            shapes.append({"type": "Circle", "center": at, "radius": radius}
                          if rng.random() < 0.6 else
                          {"type": "Polygon", "coordinates": [[*corners, corners[0]]]})
        request = asked(ed269(*[zone(volume(horizontalProjection=shape)) for shape in shapes]))
        request["airspace"]["buffer"] = buffer
        request["depots"][0]["location"] = hub
        request["customers"] = [
            {"id": str(number), "demand": [1], "served_by": "drone",
             "location": ring(hub, (rng.uniform(-4000, 4000), rng.uniform(-4000, 4000)))[0]}
            for number in range(6)]
        reply = client.post("/plan", json=request).json()
        if not reply["summary"]["sorties"]:
            continue
        for line in lines(client, request):
            bent += len(line) > 6
            nearby = [nearest(line, shape) for shape in shapes]
            assert min(nearby) >= buffer, (request, line)
            close += min(nearby) < buffer + 10
    assert bent >= often(11)
    assert close >= often(11)


def test_the_edge_of_a_mask_of_the_world_is_kept_from(client: httpx.Client) -> None:
    hole = ring(BETWEEN, (-4000, -2000), (4000, -2000), (4000, 400), (0, -100), (-4000, 400))
    request = asked(mask(hole))
    request["airspace"]["buffer"] = 30
    line = lines(client, request)[0]
    inside = LocalProjection.around(np.array(hole))
    edge = shapely.Polygon(inside.project(np.array(hole))).boundary
    away = shapely.distance(edge, shapely.LineString(inside.project(line)))
    assert 30 <= away <= 39


def test_a_plan_on_a_plane_keeps_its_distance(client: httpx.Client) -> None:
    request = {
        "depots": [{"id": "hub", "location": [0, 0]}], "planar_unit": 1000,
        "customers": [{"id": "far", "location": [2, 0], "demand": [1], "served_by": "drone"}],
        "fleet": [{"id": "truck", "count": 1, "capacity": [9],
                   "drones": {"count": 1, "capacity": [9]}}],
        "airspace": {"no_fly": [[[0.9, -0.4], [1.1, -0.4], [1.1, 0.3], [0.9, 0.3]]],
                     "buffer": 100},
        "options": {"search_iterations": 0}}
    assert planned(client, request)["summary"]["drone_distance"] == pytest.approx(
        2 * (2 * math.hypot(800, 300) + 100 * math.pi / 2 + 200), rel=0.06)


@pytest.mark.parametrize(("upper", "metres"), [(120, 25), (40, 12)])
def test_who_lies_too_near_to_a_zone_is_told_how_near(client: httpx.Client, upper: int,
                                                      metres: float) -> None:
    stated = ed269(zone(circle(400, BEHIND, upperLimit=upper)))
    request = asked(stated)
    request["airspace"]["buffer"] = 30
    request["customers"][0]["location"] = ring(BEHIND, (400 + metres, 0))[0]
    (left,) = planned(client, request)["unassigned"]
    (reason,) = left["reasons"]
    assert reason["code"] == "AIRSPACE"
    away = reason["zone"]["metres"]
    assert away == pytest.approx(metres, abs=2.1)
    assert reason["zone"]["buffer"] == 30
    assert reason["message"] == (
        f"It lies {away} m from the zone Harbour (FIN0001), where flying is prohibited from the "
        f"ground to {upper} m above the ground. Its authority: Port, tower@port.example. "
        "Flights keep 30 m from it (airspace.buffer).")
    remedy = reason["other_remedy"]
    assert remedy.startswith("lies far enough away with airspace.buffer ")
    enough = int(remedy.rpartition(" ")[2])
    assert enough > metres - 10
    request["airspace"]["buffer"] = enough
    assert planned(client, request)["unassigned"] == []
    request["airspace"]["buffer"] = metres + 3
    assert planned(client, request)["unassigned"] != []


@pytest.mark.parametrize("holds", ["customer", "depot"])
def test_who_lies_too_near_to_an_area_is_told_which(client: httpx.Client, holds: str) -> None:
    request = asked(airspace={"no_fly": [SQUARE], "buffer": 30})
    at = ring(BETWEEN, (0, 360))[0]
    request["customers" if holds == "customer" else "depots"][0]["location"] = at
    (left,) = planned(client, request)["unassigned"]
    (reason,) = left["reasons"]
    who = "It lies" if holds == "customer" else "The depot lies"
    assert reason["code"] == "AIRSPACE"
    assert reason["message"].startswith(f"{who} ")
    assert reason["message"].endswith(
        " m from the area airspace.no_fly[0]. Flights keep 30 m from it (airspace.buffer).")
    request["airspace"]["buffer"] = int(reason["other_remedy"].rpartition(" ")[2])
    assert planned(client, request)["unassigned"] == []


def test_the_buffer_is_told_in_the_reply_and_in_what_is_exported(client: httpx.Client) -> None:
    request = asked(airspace=WAYS["ed269 circle"] | {"buffer": 30}, altitude=80)
    request["fleet"][0]["drones"]["speed_kmh"] = 50
    assert planned(client, request)["airspace"] == {"buffer": 30}
    assert "30 m" in json.loads(exported(client, request, "qgc-plan"))["comment"]
    told = json.loads(exported(client, request))
    assert "30 m" in told["comment"]
    assert {each["properties"].get("buffer") for each in told["features"]
            if each["properties"]["kind"] in ("flight", "no_fly")} == {30}
    assert b"Flights keep 30 m from them" in exported(client, request, "kml")
    with zipfile.ZipFile(io.BytesIO(exported(client, request, "dji-wpml"))) as archive:
        assert all(b"30 m" in archive.read(name) for name in archive.namelist())
    request["airspace"]["buffer"] = 0
    assert "airspace" not in planned(client, request)
    assert b"buffer" not in exported(client, request)


@pytest.mark.parametrize("buffer", [-1, 1e9, "wide", None])
def test_no_other_buffer_is_taken(client: httpx.Client, buffer: Any) -> None:
    request = asked()
    request["airspace"]["buffer"] = buffer
    assert [path for _, path in refused(client, request, "/plan")] == ["$.airspace.buffer"]


def comb(teeth: int) -> list[list[float]]:
    """Return the corners of a long area with so many teeth on one side."""
    edge = [(-5000.0 + 10_000.0 * corner / (2 * teeth), 2000.0 if corner % 2 else 700.0)
            for corner in range(2 * teeth + 1)]
    return ring(BETWEEN, *edge, (5000.0, 500.0), (-5000.0, 500.0))


def test_what_grows_in_too_much_time_is_refused_before_it_does(client: httpx.Client) -> None:
    request = asked(airspace={"no_fly": [comb(5_000)], "buffer": 10_000})
    assert [code for code, _ in refused(client, request, "/plan")] == ["TOO_MUCH_WORK"]
    request = asked(airspace={"no_fly": [comb(50)], "buffer": 30})
    assert planned(client, request)["airspace"] == {"buffer": 30}
