"""Files of zones, dropped onto the page: seen, planned around, and told of who lies in one."""

import json

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import open_example, open_file, open_tab, place_of, planned, state

pytestmark = pytest.mark.slow


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
    expect(tooltip).to_contain_text("0 m AGL \u2013 120 m AGL")
    expect(tooltip).to_contain_text("Port")
    open_tab(page, "fleet")
    page.get_by_role("button", name="Remove file 1").click()
    assert state(page, "state.request.airspace.zones") == []


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
