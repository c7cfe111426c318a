"""Files of zones, dropped onto the page: seen, planned around, and told of who lies in one."""

import json
import math
import random
import re
import zipfile
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.app.maps.airspace.published import ed318, layer
from tests.console.steps import (
    awaited, open_example, open_file, open_tab, place_of, planned, state,
)
from tests.console.test_everyone import findings

pytestmark = [pytest.mark.slow, pytest.mark.one_page]

NUM_ZONES = 400
HUB = [25.0, 62.0]
DEGREE_KM = 111.2
DROP = """([name, text]) => {
  const dataTransfer = new DataTransfer();
  dataTransfer.items.add(new File([text], name));
  document.body.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true }));
}"""


def zones(longitude: float, latitude: float) -> str:
    """Return a file of ED-269 with a circle around a place."""
    return json.dumps({"features": [{
        "identifier": "FIN1", "country": "FIN", "name": "Harbour", "type": "COMMON",
        "restriction": "PROHIBITED", "applicability": [{"permanent": "YES"}],
        "zoneAuthority": [{"name": "Port"}],
        "geometry": [{"uomDimensions": "M", "lowerLimit": 0, "lowerVerticalReference": "AGL",
                      "upperLimit": 120, "upperVerticalReference": "AGL",
                      "horizontalProjection": {"type": "Circle", "radius": 300,
                                               "center": [longitude, latitude]}}]}]})


def test_zones_of_a_file_are_seen_planned_around_and_told(page: Page) -> None:
    open_example(page, "city_day")
    customer = state(page, "state.request.customers.0")
    open_file(page, "zones.json", "\ufeff" + zones(*customer["location"]))
    assert state(page, "state.request.airspace.zones.0.format") == "ed269"
    page.get_by_role("button", name="Plan", exact=True).click()
    planned(page, "served")
    tooltip = page.locator(".leaflet-tooltip", has_text="Harbour (FIN1)")
    # While the map settles, what lies under the pointer is drawn anew.
    for step in range(300):
        x, y = place_of(page, f"c:{customer['id']}")
        page.mouse.move(x + 12, y + 10 + step % 4)
        if tooltip.count():
            break
    expect(tooltip).to_contain_text("flying is prohibited")
    expect(tooltip).to_contain_text("from the ground to 120 m above the ground")
    expect(tooltip).to_contain_text("Port")
    open_tab(page, "fleet")
    leave = page.get_by_label("Leave to fly in Harbour (FIN1)")
    leave.check()
    assert state(page, "state.request.airspace.cleared") == ["FIN1"]
    leave.uncheck()
    assert state(page, "state.request.airspace.cleared") == []
    page.get_by_role("button", name="Remove file 1").click()
    assert state(page, "state.request.airspace.zones") == []


@pytest.mark.thorough
def test_what_is_stated_of_a_zone_is_entered_where_it_is_clicked(page: Page) -> None:
    open_example(page, "city_day")
    customer = state(page, "state.request.customers.0")
    file = json.loads(zones(*customer["location"]))
    file["features"][0]["restriction"] = "CONDITIONAL"
    file["features"][0]["geometry"][0]["upperVerticalReference"] = "AMSL"
    open_file(page, "zones.json", json.dumps(file))
    details = page.get_by_role("region", name="Details")
    x, y = place_of(page, f"c:{customer['id']}")
    page.mouse.click(x + 12, y + 11)
    expect(details.get_by_role("heading")).to_have_text("Harbour (FIN1)")
    expect(details).to_contain_text("from the ground to 120 m above the sea")
    details.get_by_label("Leave to fly in Harbour (FIN1)").check()
    details.get_by_label("Conditional zones").select_option("allow")
    details.get_by_label("Ground", exact=True).check()
    details.get_by_label("Lowest").fill("2")
    page.keyboard.press("Enter")
    airspace = state(page, "state.request.airspace")
    assert (airspace["cleared"], airspace["conditional"]) == (["FIN1"], "allow")
    assert airspace["ground"]["lowest"] == 2
    assert findings(page, ".details") == []
    # Who looks for a place on the ground finds it in a zone, too.
    page.evaluate("async () => (await loaded(`store.js`)).store.set({ tool: 'order' })")
    page.mouse.click(x + 12, y + 11)
    assert re.match(r"60\.\d+, 24\.\d+", state(page, "state.order.place"))


DRAWN = """() => [...document.querySelectorAll('.leaflet-overlay-pane canvas')].map((canvas) => {
  const copy = Object.assign(document.createElement('canvas'),
    { width: canvas.width, height: canvas.height });
  const context = copy.getContext('2d', { willReadFrequently: true });
  context.drawImage(canvas, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  return data.filter((value, at) => at % 4 === 3 && value > 0).length;
}).reduce((sum, count) => sum + count, 0)"""


def drawn(page: Page, buffer: str) -> int:
    """Return how many pixels the map draws on with a distance that flights keep."""
    page.get_by_label("Distance kept").fill(buffer)
    page.keyboard.press("Tab")
    awaited(page, "async () => { for (let frames = 3; frames; frames -= 1) await new Promise("
                  "requestAnimationFrame); }")
    return int(page.evaluate(DRAWN))


@pytest.mark.thorough
def test_flights_keep_a_distance_that_is_proposed_stated_and_drawn(page: Page) -> None:
    open_example(page, "city_day")
    customer = state(page, "state.request.customers.0")
    longitude, latitude = customer["location"]
    open_file(page, "zones.json", zones(longitude + 350 / 1000 / DEGREE_KM / 0.497, latitude))
    assert state(page, "state.request.airspace.buffer") == 30
    open_tab(page, "fleet")
    widths = [drawn(page, buffer) for buffer in ("0", "100", "800")]
    assert widths == sorted(set(widths))
    legend = page.locator(".map-legend")
    expect(legend).to_contain_text("Distance that flights keep")
    drawn(page, "0")
    expect(legend).not_to_contain_text("Distance that flights keep")
    page.get_by_label("Distance kept").fill("120")
    page.keyboard.press("Tab")
    assert state(page, "state.request.airspace.buffer") == 120
    page.evaluate("""async () => {
      const { edit } = await loaded(`actions.js`);
      edit((request) => ({ ...request, customers: request.customers.map((customer) =>
        ({ ...customer, served_by: 'drone' })).slice(0, 1) }));
    }""")
    page.get_by_role("button", name="Plan", exact=True).click()
    planned(page, "0 of 1 served")
    open_tab(page, "unassigned")
    panel = page.locator(".panel")
    expect(panel).to_contain_text("m from the zone Harbour (FIN1)")
    expect(panel).to_contain_text("Flights keep 120 m from it")
    open_tab(page, "fleet")
    page.get_by_label("Distance kept").fill("")
    page.keyboard.press("Tab")
    page.get_by_role("button", name="Keep 30 m away").click()
    assert state(page, "state.request.airspace.buffer") == 30


def beside_hub(east_km: float, north_km: float) -> list[float]:
    """Return a place so far from the hub."""
    return [HUB[0] + east_km / DEGREE_KM / math.cos(math.radians(HUB[1])),
            HUB[1] + north_km / DEGREE_KM]


def country() -> dict[str, Any]:
    """Return a country's zones after ED-318, one of which is round a shop near the hub.

    The others lie 15 to 250 km away, half of them circles.
    """
    rng = random.Random(7)
    file = ed318(around(beside_hub(*SHOPS_KM["closed"]), 0.9, rng, is_round=True)
                 | {"layer": layer(0, 1500, "ft") | {"upperReference": "AMSL"}},
                 name=[{"text": "Lentoasema", "lang": "fi-FI"},
                       {"text": "Airport", "lang": "en-GB"}], identifier="EFAIR",
                 zoneAuthority=[{"name": [{"text": "Fintraffic", "lang": "en-GB"}],
                                 "email": "drones@authority.example",
                                 "purpose": "AUTHORIZATION"}])["data"]
    for number in range(1, NUM_ZONES):
        way, turn = rng.uniform(15, 250), rng.uniform(0, 2 * math.pi)
        place = beside_hub(way * math.cos(turn), way * math.sin(turn))
        area = around(place, rng.uniform(0.1, 3), rng, is_round=number % 2 == 0)
        file["features"] += ed318(area | {"layer": layer(0, 120)},
                                  identifier=f"EFD{number}")["data"]["features"]
    return file


def around(place: list[float], radius_km: float, rng: random.Random,
           is_round: bool) -> dict[str, Any]:
    """Return a circle, or a polygon of up to sixty corners, around a place."""
    if is_round:
        return {"type": "Point", "coordinates": place,
                "extent": {"subType": "Circle", "radius": 1000 * radius_km}}
    turns = sorted(rng.uniform(0, 2 * math.pi) for _ in range(rng.randint(4, 60)))
    size = radius_km / DEGREE_KM
    ring = [[place[0] + size * math.cos(turn) / math.cos(math.radians(place[1])),
             place[1] + size * math.sin(turn)] for turn in turns]
    return {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}


SHOPS_KM = {"closed": (3, 4), "east": (2, 0), "west": (-2, -1), "north": (0, 2), "south": (1, -2)}


@pytest.mark.thorough
def test_a_countrys_file_is_dropped_planned_around_and_told_of_and_flights_are_saved(
        page: Page) -> None:
    open_file(page, "shops.json", json.dumps({
        "coordinate_system": "geographic", "depots": [{"id": "hub", "location": HUB}],
        "customers": [{"id": name, "demand": [1], "location": beside_hub(*way)}
                      for name, way in SHOPS_KM.items()],
        "fleet": [{"id": "quad", "flies": True, "count": 2, "capacity": [2], "max_trips": 4}],
        "options": {"time_limit": 60, "search_iterations": 200}}))
    planned(page, "5 of 5 served")
    page.evaluate(DROP, ["finland.json", json.dumps(country())])
    expect(page.locator(".map-legend")).to_contain_text("Published zone")
    open_tab(page, "fleet")
    expect(page.get_by_text(f"File 1: {NUM_ZONES} zones (ED-318)")).to_be_visible()
    page.get_by_role("button", name="Plan", exact=True).click()
    planned(page, "4 of 5 served")
    page.mouse.click(*place_of(page, "c:closed"))
    page.mouse.move(1, 1)
    details = page.get_by_role("region", name="Details")
    expect(details.get_by_role("definition").last).to_have_text(
        "It lies in the zone Airport (EFAIR), where flying takes an authorisation from the ground "
        "to 1,500 ft above the sea. Its authority: Fintraffic, drones@authority.example.")
    open_tab(page, "unassigned")
    expect(page.locator(".panel")).to_contain_text("the zone Airport (EFAIR)")
    assert findings(page, ".panel") == []
    open_tab(page, "export")
    with page.expect_download() as download:
        page.get_by_role("button", name="Save flights").click()
    with zipfile.ZipFile(download.value.path()) as archive:
        missions = [json.loads(archive.read(name)) for name in archive.namelist()
                    if name.endswith(".plan")]
    trips = [trip for route in state(page, "state.plans.1.plan.routes") for trip in route["trips"]]
    assert len(missions) == len(trips) > 0
    assert all(mission["fileType"] == "Plan" for mission in missions)


@pytest.mark.thorough
def test_zones_are_refused_beside_places_on_a_plane(page: Page) -> None:
    open_example(page, "drones")
    open_file(page, "zones.json", zones(25.0, 60.0))
    expect(page.get_by_text("The zones of zones.json lie on the globe")).to_be_visible()


KML = """<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark><name>Old town</name>
<Polygon><outerBoundaryIs><LinearRing><coordinates>24.9,60.2 24.92,60.2 24.92,60.21 24.9,60.2
</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark></Document></kml>"""

POLYGON = {"type": "Polygon", "coordinates": [[[24.9, 60.2], [24.92, 60.2], [24.92, 60.21],
                                               [24.9, 60.2]]]}


@pytest.mark.thorough
@pytest.mark.parametrize(("name", "content"), [
    ("zones.kml", KML),
    ("zones.geojson", json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {}, "geometry": POLYGON}]}))])
def test_areas_of_a_file_are_zones_where_points_would_be_customers(
        page: Page, name: str, content: str) -> None:
    open_example(page, "city_day")
    open_file(page, name, content)
    open_tab(page, "fleet")
    expect(page.get_by_role("button", name="Remove file 1")).to_be_visible()
    assert state(page, "state.request.airspace.zones.0.format") == name.partition(".")[2]
    expect(page.get_by_role("dialog")).to_have_count(0)
