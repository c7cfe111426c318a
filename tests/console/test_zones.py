"""Files of zones, dropped onto the page: seen, planned around, and told of who lies in one."""

import json
import random
import zipfile
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from benchmarks.speed.zones import CENTER, DEGREE_KM, after_ed318, country
from tests.console.steps import open_example, open_file, open_tab, place_of, planned, state
from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow

NUM_ZONES = 400
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
    page.get_by_role("button", name="Remove file 1").click()
    assert state(page, "state.request.airspace.zones") == []


def published() -> dict[str, Any]:
    """Return a country's zones after ED-318, one of which is round a shop near the hub."""
    file = after_ed318(country(NUM_ZONES, 60.0, random.Random(7)))
    properties = file["features"][-1]["properties"]
    properties |= {"name": [{"text": "Lentoasema", "lang": "fi-FI"},
                            {"text": "Airport", "lang": "en-GB"}],
                   "identifier": "EFAIR", "type": "REQ_AUTHORIZATION",
                   "zoneAuthority": [{"name": [{"text": "Fintraffic", "lang": "en-GB"}],
                                      "email": "drones@authority.example",
                                      "purpose": "AUTHORIZATION"}]}
    file["features"][-1]["geometry"] = {
        "type": "Point", "coordinates": shop("closed")["location"],
        "extent": {"subType": "Circle", "radius": 900},
        "layer": {"lower": 0, "lowerReference": "AGL", "upper": 1500, "upperReference": "AMSL",
                  "uom": "ft"}}
    return file


SHOPS_KM = {"closed": (3, 4), "east": (2, 0), "west": (-2, -1), "north": (0, 2), "south": (1, -2)}


def shop(name: str) -> dict[str, Any]:
    """Return one of the customers, who lie so many km from the hub."""
    x, y = SHOPS_KM[name]
    return {"id": name, "demand": [1],
            "location": [CENTER[0] + 2 * x / DEGREE_KM, CENTER[1] + y / DEGREE_KM]}


def test_a_countrys_file_is_dropped_planned_around_and_told_of_and_flights_are_saved(
        page: Page) -> None:
    open_file(page, "shops.json", json.dumps({
        "coordinate_system": "geographic", "depots": [{"id": "hub", "location": list(CENTER)}],
        "customers": [shop(name) for name in SHOPS_KM],
        "fleet": [{"id": "quad", "flies": True, "count": 2, "capacity": [2], "max_trips": 4}],
        "options": {"search_iterations": 200}}))
    planned(page, "5 of 5 served")
    page.evaluate(DROP, ["finland.json", json.dumps(published())])
    expect(page.locator(".map-legend")).to_contain_text("Published zone")
    open_tab(page, "fleet")
    expect(page.get_by_text(f"File 1: {NUM_ZONES} zones (ed318)")).to_be_visible()
    page.get_by_role("button", name="Plan", exact=True).click()
    planned(page, "4 of 5 served")
    page.mouse.click(*place_of(page, "c:closed"))
    page.mouse.move(1, 1)
    tip = page.locator(".leaflet-tooltip", has_text="closed")
    expect(tip.get_by_role("definition").last).to_have_text(
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


def test_zones_are_refused_beside_places_on_a_plane(page: Page) -> None:
    open_example(page, "drones")
    open_file(page, "zones.json", zones(25.0, 60.0))
    expect(page.get_by_text("The zones of zones.json lie on the globe")).to_be_visible()


KML = """<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark><name>Old town</name>
<Polygon><outerBoundaryIs><LinearRing><coordinates>24.9,60.2 24.92,60.2 24.92,60.21 24.9,60.2
</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark></Document></kml>"""

POLYGON = {"type": "Polygon", "coordinates": [[[24.9, 60.2], [24.92, 60.2], [24.92, 60.21],
                                               [24.9, 60.2]]]}


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
