"""Streets under a plan, and the road of a leg that is clicked."""

import json
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from playwright.sync_api import Browser, Page, expect

from app.maps.roads.tools import Tools
from tests.app.maps.roads.conftest import prepared_once
from tests.app.maps.roads.wheels import WHEELS, pinned, unpacked
from tests.conftest import PATIENCE, eventually
from tests.console.conftest import opening
from tests.console.serving import shared
from tests.console.steps import awaited, idle, open_file, place_of, planned, state

pytestmark = [pytest.mark.slow, pytest.mark.thorough]

HUB = [24.9497, 60.1787]
PLACES = {"station": [24.9425, 60.1704], "market": [24.9480, 60.1679], "park": [24.9437, 60.1664],
          "theatre": [24.9465, 60.1714]}

LIGHT_WATER, DARK_WATER = 0xC5DCEC, 0x14324A

COLOURS = """() => {
  const seen = new Set();
  for (const canvas of document.querySelectorAll('.leaflet-tile-pane canvas')) {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let last = 0;
    for (const pixel of new Uint32Array(data.buffer)) {
      if (pixel !== last && pixel >>> 24 === 255) {
        seen.add(((pixel & 255) << 16) + (pixel & 0xff00) + ((pixel >> 16) & 255));
      }
      last = pixel;
    }
  }
  return [...seen];
}"""
"""Returns the opaque colours of the streets; most pixels are as the one before."""

POLLING = 250
"""Milliseconds between two looks at all pixels, which take a good part of that."""

LEGS = """async () => {
  const load = (path) => loaded(`${path}.js`);
  const [{ store }, { indexOf, shownPlan }] = await Promise.all(['store', 'actions'].map(load));
  return indexOf(shownPlan(store.get())).vehicles[0].trips[0].stops.map(({ line }) => line);
}"""


WRITTEN = """
window.written = new Set();
const write = CanvasRenderingContext2D.prototype.fillText;
CanvasRenderingContext2D.prototype.fillText = function noted(text, ...place) {
  if (this.canvas.closest('.leaflet-container')) window.written.add(text);
  return write.call(this, text, ...place);
};"""
"""Notes what is written on the map."""

ACROSS = ([24.9395, 60.1725], [24.9425, 60.1725])
"""Two places on the two sides of the station's tracks, which roads lead far around."""

HIDDEN = """(lines) => {
  const place = (element) => element.getBoundingClientRect();
  const map = document.querySelector('.map');
  const [[x, y], [otherX, otherY]] = [...map.querySelectorAll('.depot-mark')].map((mark) => [
    place(mark).left, place(mark).top]);
  const [[lon, lat], [otherLon, otherLat]] = lines.shift();
  const merc = (degrees) => Math.asinh(Math.tan((degrees * Math.PI) / 180));
  const scale = (otherX - x) / (otherLon - lon);
  const points = lines.flat().map(([east, north]) => [
    x + scale * (east - lon), y - (scale * 180 * (merc(north) - merc(lat))) / Math.PI]);
  const box = place(map);
  const over = [...document.querySelectorAll('.draw-bar > button, .map-tools, .map-legend, '
    + '.leaflet-control')].map(place).filter(({ width }) => width);
  return points.filter(([left, top]) => left < box.left || left > box.right || top < box.top
    || top > box.bottom || over.some((one) => left > one.left && left < one.right
      && top > one.top && top < one.bottom));
}"""
"""Returns which points of legs aren't seen, given the depots' places and the legs."""


@pytest.fixture(scope="module")
def city(shared_folder: Path) -> Iterator[str]:
    """Return the address of a service with the roads and streets of Helsinki's centre."""
    unpacked(pinned("osrm-bindings"))
    osrm = WHEELS / "osrm"
    tools = Tools(osrm / "bin", osrm / "share" / "profiles")
    extract = prepared_once(tools, shared_folder).path
    with shared(shared_folder / "streets", "tests.console.service",
                TANDEM_ROADS=f"truck=car:{extract}",
                PATH=f"{osrm / 'bin'}{os.pathsep}{os.environ['PATH']}") as address:
        # A console knows of the streets that were drawn when it was opened.
        eventually(lambda: httpx.get(f"{address}/console/config.json", trust_env=False,
                                     timeout=PATIENCE).json()["streets"])
        yield address


LOADED = """() => {
  const tiles = [...document.querySelectorAll('.leaflet-tile-pane canvas')];
  return tiles.length > 0 && tiles.every(({ classList }) => classList.contains(
    'leaflet-tile-loaded'));
}"""
"""Tells whether all tiles of the streets are drawn."""


@pytest.fixture(scope="module")
def shown(browser: Browser, city: str) -> Iterator[Page]:
    """Return a console with the streets, for tests that each begin with a plan of their own."""
    with opening(browser) as opener:
        yield opener(city, allow=("willReadFrequently",))


def planned_in(page: Page, others: dict[str, Any] | None = None) -> None:
    """Plan for the places, or for others."""
    idle(page)
    request = {
        "coordinate_system": "geographic", "depots": [{"id": "hub", "location": HUB}],
        "customers": [{"id": name, "location": place, "demand": [1]}
                      for name, place in PLACES.items()],
        "fleet": [{"id": "truck", "count": 1, "capacity": [9], "costs": {"per_km": 1}}],
        "options": {"time_limit": 0.5}} | (others or {})
    open_file(page, "city.json", json.dumps(request))
    count = len(request["customers"])
    planned(page, f"{count} of {count} served")


def on_screen(page: Page) -> Callable[[list[float]], tuple[float, float]]:
    """Return a function from a place in the city to where the map shows it."""
    (x, y), (other_x, other_y) = (place_of(page, f"c:{name}") for name in ("station", "market"))
    (lon, lat), (other_lon, other_lat) = PLACES["station"], PLACES["market"]

    def position(place: list[float]) -> tuple[float, float]:
        return (x + (place[0] - lon) / (other_lon - lon) * (other_x - x),
                y + (place[1] - lat) / (other_lat - lat) * (other_y - y))

    return position


def streets_with(page: Page, water: int) -> list[int]:
    """Wait until the streets are drawn with water of a colour; return all colours."""
    page.wait_for_function(f"() => ({COLOURS})().includes({water})", polling=POLLING)
    return list(page.evaluate(COLOURS))


def test_map_has_streets_and_thanks_their_makers(shown: Page) -> None:
    planned_in(shown)
    expect(shown.get_by_text("© OpenStreetMap contributors")).to_be_visible()
    expect(shown.locator(".leaflet-tile-pane canvas.leaflet-tile-loaded").first).to_be_visible()
    assert len(streets_with(shown, LIGHT_WATER)) > 6


def test_map_is_dark_at_once_for_whoever_likes_that(open_page: Callable[..., Page],
                                                    city: str) -> None:
    page = open_page(city, allow=("willReadFrequently",), color_scheme="dark")
    planned_in(page)
    assert len(streets_with(page, DARK_WATER)) > 6


def test_streets_stay_from_light_to_dark_and_back_at_any_zoom(shown: Page) -> None:
    planned_in(shown)
    streets_with(shown, LIGHT_WATER)
    for presses in range(3):
        if presses:
            shown.get_by_role("button", name="Zoom in").first.click()
            expect(shown.locator(".leaflet-zoom-anim")).to_have_count(0)
        shown.wait_for_function(LOADED)
        for water, other in ((DARK_WATER, LIGHT_WATER), (LIGHT_WATER, DARK_WATER)):
            shown.keyboard.press("l")
            assert other not in streets_with(shown, water)


def test_streets_weigh_little_and_are_named_once_one_is_near_enough_to_read_it(
        open_page: Callable[..., Page], city: str) -> None:
    page = open_page(city, allow=("willReadFrequently",))
    page.add_init_script(WRITTEN)
    # A browser keeps the first few hundred alone, and modules come first.
    page.add_init_script("performance.setResourceTimingBufferSize(5000)")
    page.reload()
    planned_in(page)

    def streets() -> list[int]:
        sizes = page.evaluate("performance.getEntriesByType('resource').map(entry => "
                              "[entry.name, entry.encodedBodySize])")
        return [size for name, size in sizes if "/map/" in name]

    # Asked again and again: a page of this policy evaluates no text that it is to wait for.
    eventually(streets)
    page.wait_for_function("() => window.written.has('Unioninkatu')")
    page.wait_for_load_state("networkidle")
    assert sum(streets()) < 300_000
    assert "Mannerheimintie" in page.evaluate("[...window.written]")
    page.evaluate("window.written.clear()")
    for _ in range(6):
        page.get_by_role("button", name="Zoom out").first.click()
        expect(page.locator(".leaflet-zoom-anim")).to_have_count(0)
    page.evaluate("window.written.clear()")
    page.keyboard.press("l")
    page.wait_for_load_state("networkidle")
    # Only the ground's own large cities, and stops, are named then.
    stops = {customer["id"] for customer in state(page, "state.request.customers")}
    assert set(page.evaluate("[...window.written]")) - stops <= {"Helsinki"}


def test_all_of_a_plan_on_roads_is_seen(shown: Page) -> None:
    here, there = ACROSS
    across = {"depots": [{"id": "hub", "location": here}, {"id": "yard", "location": there}],
              "customers": [{"id": "over the tracks", "location": there, "demand": [1]}]}
    for width, height in ((1024, 768), (390, 844), (1440, 900)):
        planned_in(shown)
        shown.set_viewport_size({"width": width, "height": height})
        planned_in(shown, across)
        legs = shown.evaluate(LEGS)
        east = [place[0] for leg in legs for place in leg]
        assert max(east) - min(east) > 3 * (there[0] - here[0])
        expect(shown.locator(".map-legend")).to_be_attached()
        shown.wait_for_function(f"(lines) => !({HIDDEN})(structuredClone(lines)).length",
                                arg=[[here, there], *legs])


def test_leg_that_is_clicked_shows_its_road(shown: Page) -> None:
    page = shown
    planned_in(page)
    lines = page.evaluate(LEGS)
    number = max(range(len(lines)), key=lambda stop: len(lines[stop]))
    assert len(lines[number]) > 4
    middle = len(lines[number]) // 2
    (start, end), position = lines[number][middle - 1:middle + 1], on_screen(page)
    page.mouse.click(*position([(start[0] + end[0]) / 2, (start[1] + end[1]) / 2]))
    selection = state(page, "state.selection")
    assert selection.startswith("l:0/0/")
    details = page.get_by_role("region", name="Details")
    for term in ("Road", "Takes", "Departure", "→"):
        expect(details).to_contain_text(term)
    assert len(lines[int(selection.rpartition("/")[2])]) > 2


def roads_of(page: Page) -> int:
    """Return how many legs of the plan that is shown follow roads, once it has legs."""
    return sum(len(line) > 2 for line in page.evaluate(LEGS))


def test_plan_that_is_changed_by_hand_keeps_to_the_roads(shown: Page) -> None:
    planned_in(shown)
    assert roads_of(shown) > 2
    shown.evaluate("async () => (await loaded('actions.js')).select('c:park')")
    details = shown.get_by_role("region", name="Details")
    earlier, later = (details.get_by_role("button", name=name, exact=True)
                      for name in ("Earlier", "Later"))
    (earlier if earlier.is_enabled() else later).click()
    expect(shown.locator("#hand-outcome")).to_be_visible()
    eventually(lambda: roads_of(shown) > 2)


KEEP = """async ([isLinked]) => {
  const load = (path) => loaded(`${path}.js`);
  const [{ store }, api, { openKept, viewShared }] = await Promise.all(
    ['store', 'api', 'keeping/kept'].map(load));
  const { request, plans } = store.get();
  const plan = structuredClone(plans.at(-1).plan);
  if (!isLinked) {
    for (const stop of plan.routes[0].trips[0].stops) delete stop.geometry;
  }
  const id = crypto.randomUUID();
  await api.putKeptPlan(id, { name: id, note: '', request, plan }, null);
  if (isLinked) await viewShared((await api.postLink(id)).token);
  else await openKept({ where: 'service', id });
  return id;
}"""
"""Keeps the plan that is shown, without its ways unless a link is made to it, and opens it."""


@pytest.mark.parametrize("is_linked", [False, True], ids=["opened", "linked"])
def test_roads_of_a_kept_plan_are_kept_or_asked_anew(shown: Page, is_linked: bool) -> None:
    planned_in(shown)
    roads = roads_of(shown)
    name = awaited(shown, KEEP, [is_linked])
    assert state(shown, "state.name") == name
    assert roads_of(shown) == roads > 2
