"""Plan and problem as files, sheets for drivers, pictures."""

import csv
import json
import zipfile
from collections.abc import Callable
from io import BytesIO, StringIO
from pathlib import Path
from xml.etree import ElementTree

import pytest
from playwright.sync_api import Page, expect

from tests.console.steps import open_example, open_tab, state
from tests.console.test_everyone import findings

pytestmark = pytest.mark.slow

DEPOTS = {"drones": "hub", "city_day": "hub-north"}


def opened(page: Page, name: str) -> Page:
    """Return the page with an example's plan to take away."""
    if state(page, "state.request.depots.0.id") != DEPOTS[name]:
        open_example(page, name)
        open_tab(page, "export")
    return page


def saved(page: Page, button: str) -> bytes:
    """Return the file that a button saves."""
    with page.expect_download() as download:
        page.get_by_role("button", name=button, exact=True).click()
    return Path(download.value.path()).read_bytes()


def test_plan_and_problem_are_saved_as_json(console: Page) -> None:
    page = opened(console, "drones")
    plan = json.loads(saved(page, "Plan as JSON"))
    assert plan["status"] == "complete"
    assert json.loads(saved(page, "Problem as JSON")) == state(page, "state.request")


def test_stops_are_saved_as_csv(console: Page) -> None:
    page = opened(console, "drones")
    rows = list(csv.DictReader(StringIO(saved(page, "Stops as CSV").decode())))
    assert {row["id"] for row in rows} == {"hub", "A", "B", "C", "D"}
    assert next(row for row in rows if row["id"] == "C")["drone"].startswith("truck-")


@pytest.mark.thorough
def test_map_is_saved_as_geojson_and_gpx(console: Page) -> None:
    page = opened(console, "city_day")
    features = json.loads(saved(page, "GeoJSON"))["features"]
    kinds = {feature["properties"]["kind"] for feature in features}
    assert kinds >= {"depot", "customer", "trip", "no_fly"}
    vehicle = state(page, "state.plans.0.plan.routes.0.vehicle")
    gpx = ElementTree.fromstring(saved(page, f"GPX of {vehicle}"))
    assert gpx.tag.endswith("gpx")
    assert len(gpx.findall(".//{*}rtept")) > 3


def test_gpx_is_for_degrees_alone(console: Page) -> None:
    page = opened(console, "drones")
    expect(page.get_by_role("button", name="GPX of").first).to_be_disabled()
    expect(page.get_by_text("GPX needs longitudes and latitudes")).to_be_visible()


@pytest.mark.thorough
def test_picture_is_saved_as_svg_and_png(console: Page) -> None:
    page = opened(console, "city_day")
    picture = ElementTree.fromstring(saved(page, "SVG"))
    assert len(picture.findall(".//{*}path")) > 20
    assert "hub-north" in "".join(picture.itertext())
    assert saved(page, "PNG").startswith(b"\x89PNG")


def test_flights_are_saved_for_flight_controllers(console: Page) -> None:
    page = opened(console, "city_day")
    part = page.locator("#flight-files")
    expect(part).to_contain_text("no permission to fly")
    part.get_by_label("Files").select_option("vehicle")
    with page.expect_download() as download:
        part.get_by_role("button", name="Save flights").click()
    name, content = download.value.suggested_filename, Path(download.value.path()).read_bytes()
    if name.endswith(".zip"):
        with zipfile.ZipFile(BytesIO(content)) as archive:
            content = archive.read(archive.namelist()[1])
    assert json.loads(content)["fileType"] == "Plan"
    part.get_by_label("Format").select_option("dji-wpml")
    expect(part.get_by_role("alert")).to_have_count(0)


@pytest.mark.thorough
def test_flights_that_a_format_cannot_tell_are_refused_in_words(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("422",))
    open_example(page, "berlin")
    open_tab(page, "export")
    part = page.locator("#flight-files")
    part.get_by_label("Format").select_option("dji-wpml")
    part.get_by_role("button", name="Save flights").click()
    expect(part.get_by_role("alert")).to_contain_text("goes up to 54 km/h")
    assert findings(page, ".panel") == []
    part.get_by_label("Format").select_option("kml")
    expect(part.get_by_role("alert")).to_have_count(0)
    assert saved(page, "Save flights").startswith(b"PK")


def test_flights_of_a_plane_are_not_offered(console: Page) -> None:
    page = opened(console, "drones")
    expect(page.get_by_role("button", name="Save flights")).to_be_disabled()


def test_driver_sheet_is_printed(console: Page) -> None:
    page = opened(console, "drones")
    page.evaluate("window.print = () => { window.printed = true; }")
    page.get_by_role("button", name="Print all driver sheets").click()
    assert page.evaluate("window.printed")
    page.emulate_media(media="print")
    sheet = page.locator(".sheet-page").first
    expect(sheet).to_be_visible()
    expect(page.locator("#app")).to_be_hidden()
    expect(sheet).to_contain_text("launch drone-1 to C")
    page.emulate_media(media="screen")
    expect(sheet).to_be_hidden()
