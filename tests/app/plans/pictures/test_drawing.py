"""Plans as SVG, PNG and HTML."""

import io
import os
import re
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import polyline
import pytest
from matplotlib.image import imread

from app.plans.pictures.activities import rows_of
from app.plans.pictures.drawing import draw_png, draw_svg
from app.plans.pictures.lines import driven_lines, flown_lines
from app.plans.pictures.page import draw_page
from app.plans.pictures.scene import clock, label
from app.schemas.errors import InvalidRequestError
from tests.app.maps.airspace.published import circle, ed269, zone
from tests.app.plans.pictures.conftest import scene_of

pytestmark = pytest.mark.slow

Request = dict[str, Any]

SVG = "{http://www.w3.org/2000/svg}"
HOSTILE = ("</text><script>alert(1)</script>", "$\\frac{1}{$", "a\x00\x1b\nb", "&amp;\"'", "送货",
           "]]><!--", "\u202etxt", "_x",
           200 * "x")


def shown(svg: bytes) -> tuple[list[str], list[str]]:
    """Return the texts and the names of groups in a picture."""
    root = ElementTree.fromstring(svg)
    assert root.tag == f"{SVG}svg"
    texts = ["".join(node.itertext()).strip() for node in root.iter(f"{SVG}text")]
    return texts, [node.get("id", "") for node in root.iter(f"{SVG}g")]


def named(groups: list[str], start: str) -> list[str]:
    """Return the groups whose name begins so."""
    return [name for name in groups if re.fullmatch(rf"{start}[-\d]+", name)]


def test_map_shows_trips_sorties_areas_and_who_is_left_out(rich: Request,
                                                           two_trips: Request) -> None:
    texts, groups = shown(draw_svg(scene_of(rich, two_trips)))
    assert {"hub", "early", "big", "flown", "too-much"} <= set(texts)
    assert named(groups, "trip") == ["trip-0-0", "trip-0-1"]
    assert named(groups, "sortie") == ["sortie-0-0-0"]
    assert named(groups, "no-fly") == ["no-fly-0"]
    assert named(groups, "unassigned") == ["unassigned-0"]
    assert "truck-1, trip 2: 1 customer" in texts
    assert {"km east", "km north", "unassigned", "depot"} <= set(texts)


def test_zones_that_drones_meet_are_drawn_by_what_they_ask_for(
        example: Callable[[str], Request]) -> None:
    request = example("zones")
    places = [place["location"] for place in (*request["depots"], *request["customers"])]
    west, south = np.min(places, axis=0).tolist()
    far = [west - 5, south]
    request["airspace"] = {"zones": [ed269(
        zone(circle(300, [west, south]), name="Harbour", identifier="H"),
        zone(circle(300, [west, south]), name="Castle", identifier="C",
             restriction="REQ_AUTHORISATION"),
        zone(circle(300, [west, south], upperLimit=30), name="Mast", identifier="M"),
        zone(circle(300, [west, south], lowerLimit=500, upperLimit=900), name="Above"),
        zone(circle(300, [west, south]), name="Open", restriction="NO_RESTRICTION"),
        zone(circle(300, far), name="Elsewhere"))]}
    request["launch_sites"] = [{"id": "car park", "location": places[0]}]
    texts, groups = shown(draw_svg(scene_of(request)))
    assert named(groups, "zone") == ["zone-0", "zone-1", "zone-2"]
    assert {"Harbour (H)", "Castle (C)", "Mast (M)", "zone: flying is prohibited",
            "zone: flying takes an authorisation", "car park", "launch site",
            "zone below the drones: nobody lands in it"} <= set(texts)
    assert not {"Above", "Open", "Elsewhere", "zone: flying takes conditions"} & set(texts)


def test_title_tells_cost_and_counts(rich: Request, two_trips: Request) -> None:
    scene = scene_of(rich, two_trips)
    texts, _ = shown(draw_svg(scene))
    title = (f"Cost {scene.cost['total']:,.2f} · 3 of 4 customers served · 1 vehicle · 2 trips · "
             "1 sortie")
    assert title in texts


def test_timeline_has_a_row_per_vehicle_and_drone_and_clock_times(rich: Request,
                                                                  two_trips: Request) -> None:
    texts, _ = shown(draw_svg(scene_of(rich, two_trips)))
    assert {"truck-1", "drone-1", "drone-2", "0:30", "1:00"} <= set(texts)
    assert {"Serving", "Waiting", "Reloading", "Flying", "Launch, recovery",
            "Window, start of service"} <= set(texts)


def test_rows_hold_what_is_done_and_when(rich: Request, two_trips: Request) -> None:
    truck, first, second = rows_of(scene_of(rich, two_trips))
    bars = {(bar.activity, bar.start, bar.end) for bar in truck.bars}
    assert bars >= {("drive", 3000, 3450), ("serve", 3600, 3900), ("reload", 4800, 5400),
                    ("launch", 3900, 3930), ("launch", 4770, 4800), ("drive", 5400, 5940)}
    assert [(window.earliest, window.latest, window.is_late) for window in truck.windows] == [
        (3600, 7200, False)]
    assert ("fly", 3930, 4770) in {(bar.activity, bar.start, bar.end) for bar in first.bars}
    assert second.bars == ()


def test_launches_begin_sooner_where_a_battery_is_swapped(rich: Request,
                                                          two_trips: Request) -> None:
    rich["fleet"][0]["drones"]["turnaround"] = {"swap_duration": 60}
    first, = two_trips["routes"][0]["trips"][0]["sorties"]
    again = first | {"drone": "truck-1/drone-2", "launch_time": 3990.0}
    two_trips["routes"][0]["trips"][0]["sorties"] = [again, first]
    rows = rows_of(scene_of(rich, two_trips))
    launched = [{(bar.start, bar.end) for bar in row.bars if bar.activity == "launch"}
                for row in rows]
    assert launched[0] >= {(3900, 3930), (3900, 3990)}
    assert [(3900, 3930) in launched[1], (3900, 3990) in launched[2]] == [True, True]


def test_windows_at_the_same_time_have_lanes_of_their_own(rich: Request,
                                                         two_trips: Request) -> None:
    rich["customers"][1]["time_window"] = {"earliest": 5000, "latest": 6000}
    truck = rows_of(scene_of(rich, two_trips))[0]
    assert sorted(truck.lanes) == [0, 1]
    rich["customers"][1]["time_window"] = {"earliest": 7201, "latest": 9000}
    assert rows_of(scene_of(rich, two_trips))[0].lanes == (0, 0)


def test_of_several_windows_that_of_service_is_drawn(rich: Request, two_trips: Request) -> None:
    drawn = rows_of(scene_of(rich, two_trips))[0].windows
    early = rich["customers"][0]
    early["time_windows"] = [{"latest": 100}, early.pop("time_window"), {"earliest": 8000}]
    scene = scene_of(rich, two_trips)
    assert rows_of(scene)[0].windows == drawn
    assert b"0:00 to 0:02, 1:00 to 2:00, 2:13 to" in draw_page(scene)


def test_broken_rules_are_told(rich: Request, two_trips: Request) -> None:
    rich["fleet"][0]["capacity"] = [12]
    texts, _ = shown(draw_svg(scene_of(rich, two_trips)))
    assert any("breaks rules" in text for text in texts)


def test_geographic_plan_is_drawn_in_kilometres(example: Callable[[str], Request]) -> None:
    scene = scene_of(example("city_day"))
    assert scene.layout is not None
    points = np.array(list(scene.layout.points.values()))
    assert 0.5 < np.ptp(points[:, 0]) < 1.5
    texts, groups = shown(draw_svg(scene))
    assert "hub-north" in texts
    assert len(named(groups, "trip")) == scene.summary["trips"] > 0
    assert len(named(groups, "sortie")) == scene.summary["sorties"] > 0


def test_without_locations_there_is_the_timeline_alone() -> None:
    table = {"durations": [[0, 60], [60, 0]], "distances": [[0, 500], [500, 0]]}
    texts, groups = shown(draw_svg(scene_of({
        "depots": [{"id": "hub", "location_index": 0}],
        "customers": [{"id": "A", "location_index": 1, "demand": [1]}],
        "fleet": [{"id": "truck", "count": 1, "capacity": [2]}],
        "matrices": {"truck": table}})))
    assert named(groups, "trip") == []
    assert "truck" in texts
    assert any("There is no map" in text for text in texts)


@pytest.mark.parametrize("customers", [
    [], [{"id": "same place", "location": [0, 0], "demand": [1]}]])
def test_next_to_nothing_is_drawn(smallest: Request, customers: list[Request]) -> None:
    smallest["customers"] = customers
    texts, _ = shown(draw_svg(scene_of(smallest)))
    assert ("No vehicle is used." in texts) == (not customers)


def test_png_is_of_sane_size_and_not_blank(rich: Request, two_trips: Request) -> None:
    pixels = imread(io.BytesIO(draw_png(scene_of(rich, two_trips))), format="png")
    height, width = pixels.shape[:2]
    assert 800 < width < 4000
    assert 500 < height < 6000
    assert 0.005 < np.mean(pixels[..., :3].min(axis=2) < 0.9) < 0.6


class Outside(HTMLParser):
    """Collects what a page runs, or loads from elsewhere."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.addresses: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.add(tag)
        self.addresses += [value or "" for name, value in attrs
                           if name in ("src", "href", "xlink:href", "srcset", "data", "action")
                           and not (value or "").startswith("#")]
        self.addresses += [name for name, _ in attrs if name.startswith("on")]


def test_page_has_picture_costs_and_stops_and_loads_nothing(rich: Request,
                                                            two_trips: Request) -> None:
    page = draw_page(scene_of(rich, two_trips)).decode()
    outside = Outside()
    outside.feed(page)
    assert outside.addresses == []
    assert {"svg", "table"} <= outside.tags
    assert not {"script", "link", "img", "iframe", "object"} & outside.tags
    assert not re.search(r"url\((?!['\"]?#)|@import", page)
    for text in ("Stops of truck-1", "early", "1:00 to 2:00", "drone-1, off at", "Unassigned"):
        assert text in page


@pytest.mark.thorough_after(1)
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_ids_are_only_shown(name: str, rich: Request, two_trips: Request) -> None:
    def renamed(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: renamed(inner) for key, inner in value.items()}
        if isinstance(value, list):
            return [renamed(inner) for inner in value]
        if isinstance(value, str) and value.startswith("truck-1"):
            return name + value.removeprefix("truck")
        return {"early": name, "hub": name, "truck": name}.get(value, value) \
            if isinstance(value, str) else value

    request, plan = renamed(rich), renamed(two_trips)
    for route in plan["routes"]:
        for trip in route["trips"]:
            trip["stops"][0]["kind"] = trip["stops"][-1]["kind"] = "depot"
    request["fleet"][0]["profile"] = "truck"
    scene = scene_of(request, plan)
    texts, groups = shown(draw_svg(scene))
    assert texts.count(" ".join(label(name).split())) + texts.count(label(name)) >= 2
    assert len(named(groups, "trip")) == 2
    assert draw_png(scene).startswith(b"\x89PNG")
    outside = Outside()
    outside.feed(draw_page(scene).decode())
    assert "script" not in outside.tags
    assert outside.addresses == []


def test_labels_are_short_and_printable() -> None:
    assert label("truck-1") == "truck-1"
    assert len(label(500 * "x")) == 28
    assert label("a\nb\x00") == "a\N{REPLACEMENT CHARACTER}b\N{REPLACEMENT CHARACTER}"


@pytest.mark.parametrize(("seconds", "text"), [
    (0, "0:00"), (59, "0:01"), (3570, "1:00"), (90_000, "25:00"), (-3600, "-1:00")])
def test_instants_are_hours_and_minutes(seconds: float, text: str) -> None:
    assert clock(seconds) == text


def test_plan_without_shape_is_refused(rich: Request, two_trips: Request) -> None:
    trips = two_trips["routes"][0]["trips"]
    trips[0]["sorties"][0]["recovery_stop"] = 9
    trips[1]["stops"] = trips[1]["stops"][:1]
    with pytest.raises(InvalidRequestError) as caught:
        scene_of(rich, two_trips)
    assert {(error.code, error.path) for error in caught.value.errors} == {
        ("SORTIE_STOPS", "$.routes[0].trips[0].sorties[0]"),
        ("TRIP_SHAPE", "$.routes[0].trips[1]")}


def thousand_customers() -> tuple[Request, Request]:
    """Return customers in rings, and a plan with fifty to a vehicle."""
    angles = np.linspace(0.0, 2 * np.pi, 1000, endpoint=False)
    radius = 5 + np.arange(1000) % 10
    customers = [{"id": f"c{index}", "location": [float(r * np.cos(a)), float(r * np.sin(a))],
                  "demand": [1], "time_window": {"earliest": 0, "latest": 50_000 + index}}
                 for index, (a, r) in enumerate(zip(angles, radius, strict=True))]
    request = {"planar_unit": 1000, "depots": [{"id": "hub", "location": [0, 0]}],
               "customers": customers,
               "fleet": [{"id": "truck", "count": 20, "capacity": [50]}]}

    def stop(kind: str, name: str, time: float) -> Request:
        return {"kind": kind, "id": name, "arrival": time, "service_start": time,
                "departure": time}

    routes = [{"vehicle": f"truck-{route + 1}", "type": "truck", "trips": [{"stops": [
        stop("depot", "hub", 0.0),
        *(stop("customer", f"c{50 * route + index}", 600.0 * (index + 1)) for index in range(50)),
        stop("depot", "hub", 31_000.0)]}]} for route in range(20)]
    return request, {"routes": routes}


def test_a_thousand_customers_are_drawn_in_seconds() -> None:
    scene = scene_of(*thousand_customers())
    began = time.process_time()
    texts, groups = shown(draw_svg(scene))
    assert time.process_time() - began < 20
    assert len(named(groups, "trip")) == 20
    assert {"hub", "truck-20"} <= set(texts)
    assert "c500" not in texts


@pytest.mark.thorough
def test_threads_draw_the_same_picture_and_change_no_settings(rich: Request,
                                                             two_trips: Request) -> None:
    before = matplotlib.rcParams.copy()
    scene = scene_of(rich, two_trips)
    with ThreadPoolExecutor(4) as threads:
        drawn = set(threads.map(lambda _: draw_svg(scene), range(6)))
    assert len(drawn) == 1
    assert matplotlib.rcParams.copy() == before


@pytest.mark.thorough
def test_no_more_of_matplotlib_is_loaded_than_is_needed() -> None:
    script = "import sys, app.plans.pictures.page; print('matplotlib.pyplot' in sys.modules)"
    root = Path(__file__).parents[4]
    done = subprocess.run([sys.executable, "-c", script], cwd=root, check=True, text=True,
                          stdout=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(root)})
    assert done.stdout == "False\n"


@pytest.mark.parametrize(("line", "points"), [
    ([(3.0, 3.0)], 3), (None, 2), ("no line at all", 2), ([], 2)])
def test_legs_are_drawn_as_the_plan_states_them(
        line: Any, points: int, rich: Request, two_trips: Request) -> None:
    stop = two_trips["routes"][0]["trips"][0]["stops"][1]
    scene = scene_of(rich, two_trips)
    assert scene.layout is not None
    x, y = next(customer["location"] for customer in rich["customers"]
                if customer["id"] == stop["id"])
    if isinstance(line, list):
        line = polyline.encode([(0, 0), *line, (y, x)] if line else [(0, 0), (9, 9)], 6)
    stop["geometry"] = line
    scene = scene_of(rich, two_trips)
    assert scene.layout is not None
    first, *_ = driven_lines(scene.layout, scene.plan.routes[0].trips[0])
    assert len(first) == points
    assert first[-1] == (x, y)
    assert b"trip-0-0" in draw_svg(scene)


def test_flights_around_areas_are_drawn_as_they_are_flown(rich: Request) -> None:
    rich["airspace"] = {"no_fly": [[[0.5, -3], [1.5, -3], [1.5, 1], [0.5, 1]]]}
    rich["options"] = {"geometry": True}
    scene = scene_of(rich)
    assert scene.layout is not None
    lengths = [len(line) for route in scene.plan.routes for trip in route.trips
               for sortie in trip.sorties for line in flown_lines(scene.layout, trip, sortie)]
    assert max(lengths) > 2
    assert b"sortie-" in draw_svg(scene)
