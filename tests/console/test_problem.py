"""A problem from a file or drawn on the map, and edited in forms."""

import json
import re
from collections.abc import Callable

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.console.steps import (
    EXAMPLES, idle, open_example, open_file, open_tab, place_of, planned, state,
)

pytestmark = [pytest.mark.slow, pytest.mark.one_page]


def test_problem_is_opened_from_a_file(console: Page) -> None:
    open_file(console, "mine.json", (EXAMPLES / "smallest.json").read_text("utf-8"))
    planned(console, "2 of 2 served")


def test_file_that_is_no_problem_is_refused_in_words(console: Page) -> None:
    open_file(console, "mine.json", "{")
    expect(console.get_by_role("alert")).to_contain_text("mine.json is not JSON")
    open_file(console, "mine.json", '{"customers": []}')
    expect(console.get_by_role("alert")).to_contain_text("It lacks Depots, Fleet")
    console.get_by_role("alert").get_by_role("button", name="Close").click()


def drawing(page: Page) -> tuple[Locator, tuple[float, float]]:
    """Open an example and the drawing tools; return these and the middle of the map."""
    open_example(page, "drones")
    page.get_by_role("button", name="Draw", exact=True).click()
    area = page.locator(".map").first.bounding_box()
    assert area is not None
    middle = (area["x"] + area["width"] / 2, area["y"] + area["height"] / 2)
    return page.get_by_role("group", name="Drawing tools"), middle


def fill(tools: Locator, label: str, value: str) -> None:
    """Fill a field of a drawing tool."""
    tools.get_by_label(label).fill(value)
    tools.get_by_label(label).press("Tab")


def test_customers_and_windows_are_drawn_and_erased(page: Page) -> None:
    tools, (x, y) = drawing(page)
    tools.get_by_role("button", name="Customer").click()
    fill(tools, "Demand", "4")
    page.mouse.click(x - 150, y + 60)
    page.mouse.click(x - 170, y + 80)
    assert state(page, "state.request.customers.length") == 6
    assert state(page, "state.request.customers.5.demand") == [4]
    tools.get_by_role("button", name="Window", exact=True).click()
    fill(tools, "Opens", "0:30")
    fill(tools, "Closes", "2:00")
    page.mouse.click(x - 150, y + 60)
    assert state(page, "state.request.customers.4.time_window") == {
        "earliest": 1800, "latest": 7200}
    tools.get_by_role("button", name="Erase").click()
    page.mouse.click(x - 170, y + 80)
    assert state(page, "state.request.customers.length") == 5
    page.keyboard.press("Escape")
    page.get_by_role("button", name="Plan", exact=True).click()
    planned(page, "of 5 served")


@pytest.mark.thorough
def test_areas_are_drawn_and_erased(page: Page) -> None:
    tools, (x, y) = drawing(page)
    tools.get_by_role("button", name="No-fly area").click()
    expect(page.locator(".marker-icon.cursor-marker")).to_be_attached()
    corners = [(150, -60), (200, -60), (200, 20), (150, 20)]
    for right, down in [*corners, corners[0]]:
        page.mouse.move(x + right, y + down)
        page.mouse.click(x + right, y + down)
    assert state(page, "state.request.airspace.no_fly.0.length") == 4
    tools.get_by_role("button", name="Erase").click()
    page.mouse.click(x + 175, y - 20)
    assert state(page, "state.request.airspace.no_fly") == []


@pytest.mark.thorough
def test_marks_and_lines_take_no_click_of_who_draws_on_the_ground(page: Page) -> None:
    tools, _ = drawing(page)
    customers = [customer["id"] for customer in state(page, "state.request.customers")]
    corners = [place_of(page, f"c:{name}") for name in customers]
    tools.get_by_role("button", name="No-fly area").click()
    expect(page.locator(".marker-icon.cursor-marker")).to_be_attached()
    (x, y), (other_x, other_y) = corners[0], corners[1]
    on_line = ((x + other_x) / 2, (y + other_y) / 2)
    ring = [corners[0], on_line, corners[1], (other_x + 40, other_y - 200), (x + 120, y - 60)]
    for place in [*ring, ring[0]]:
        page.mouse.move(*place)
        page.mouse.click(*place)
    assert state(page, "state.request.airspace.no_fly.0.length") == len(ring)
    tools.get_by_role("button", name="Customer").click()
    page.mouse.click(corners[1][0] + 3, corners[1][1] + 3)
    first, second = (state(page, f"state.request.customers.{number}.location")
                     for number in (1, len(customers)))
    assert first != second
    tools.get_by_role("button", name="Depot").click()
    depots = state(page, "state.request.depots.length")
    page.mouse.click(*corners[0])
    assert state(page, "state.request.depots.length") == depots + 1
    assert state(page, "state.selection") is None
    page.keyboard.press("Escape")
    page.mouse.click(*place_of(page, f"c:{customers[0]}"))
    assert state(page, "state.selection") is not None


@pytest.mark.thorough
def test_legend_takes_no_click_of_who_draws_on_the_ground(page: Page) -> None:
    tools, _ = drawing(page)
    tools.get_by_role("button", name="No-fly area").click()
    expect(page.locator(".marker-icon.cursor-marker")).to_be_attached()
    summary = page.locator(".map-legend summary").bounding_box()
    assert summary is not None
    x, y = summary["x"] + 10, summary["y"] + summary["height"] / 2
    ring = [(x, y), (x - 150, y - 20), (x - 100, y - 150)]
    for place in [*ring, ring[0]]:
        page.mouse.move(*place)
        page.mouse.click(*place)
    assert state(page, "state.request.airspace.no_fly.0.length") == len(ring)


@pytest.mark.thorough
def test_corner_of_an_area_is_dragged(page: Page) -> None:
    open_example(page, "city_day")
    before = state(page, "state.request.airspace.no_fly.0")
    page.get_by_role("button", name="Draw", exact=True).click()
    page.get_by_role("button", name="Move", exact=True).click()
    corner = page.locator(".marker-icon:not(.marker-icon-middle)").first.bounding_box()
    assert corner is not None
    x, y = corner["x"] + corner["width"] / 2, corner["y"] + corner["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 30, y - 30, steps=5)
    page.mouse.up()
    after = state(page, "state.request.airspace.no_fly.0")
    assert [old != new for old, new in zip(before, after, strict=True)].count(True) == 1


@pytest.mark.thorough
def test_customers_in_an_area_get_a_window(page: Page) -> None:
    tools, (x, y) = drawing(page)
    tools.get_by_role("button", name="Windows in an area").click()
    fill(tools, "Opens", "0:10")
    expect(page.locator(".marker-icon.cursor-marker")).to_be_attached()
    for right, down in [(-430, -345), (440, 345)]:
        page.mouse.move(x + right, y + down)
        page.mouse.click(x + right, y + down)
    windows = [customer["time_window"] for customer in state(page, "state.request.customers")]
    assert [window["earliest"] for window in windows] == [600] * 4


def test_customer_is_dragged(page: Page) -> None:
    open_example(page, "smallest")
    page.get_by_role("button", name="Draw", exact=True).click()
    page.get_by_role("button", name="Move", exact=True).click()
    before = state(page, "state.request.customers.0.location")
    place = place_of(page, "c:A")
    page.mouse.move(*place)
    page.mouse.down()
    page.mouse.move(place[0] + 40, place[1] + 30, steps=4)
    page.mouse.up()
    after = state(page, "state.request.customers.0.location")
    assert after[0] > before[0]
    assert after[1] < before[1]


def test_forms_are_made_from_the_schema_and_change_the_problem(page: Page) -> None:
    open_example(page, "drones")
    open_tab(page, "fleet")
    count = page.get_by_label("Count").first
    count.fill("3")
    count.press("Enter")
    assert state(page, "state.request.fleet.0.count") == 3
    page.get_by_label("Explain fields").check()
    expect(page.get_by_text("How many vehicles there are of this type.")).to_be_visible()
    latest = page.locator("#field-fleet-0-shift-latest")
    latest.fill("5:30")
    latest.press("Enter")
    assert state(page, "state.request.fleet.0.shift.latest") == 19800
    per_km = page.locator("#field-fleet-0-drones-costs-per_km")
    per_km.fill("0.5")
    per_km.press("Enter")
    assert state(page, "state.request.fleet.0.drones.costs.per_km") == 0.5
    wind = page.locator("#field-airspace-wind-speed_kmh")
    wind.fill("20")
    wind.press("Enter")
    assert state(page, "state.request.airspace.wind.speed_kmh") == 20
    page.locator("#field-fleet-0-drones").uncheck()
    expect(per_km).to_have_count(0)
    page.keyboard.press("Escape")
    page.locator(".map").first.focus()
    page.keyboard.press("u")
    assert state(page, "state.request.fleet.0.drones.count") == 1


def test_errors_of_the_service_are_shown_at_their_fields(
        open_page: Callable[..., Page], service: str) -> None:
    page = open_page(service, allow=("422",))
    idle(page)
    request = json.loads((EXAMPLES / "smallest.json").read_text("utf-8"))
    request["fleet"][0]["speed_kmh"] = 0.1
    request["customers"][1]["demand"] = [-1]
    open_file(page, "wrong.json", json.dumps(request))
    expect(page.get_by_role("alert")).to_contain_text("Something in the problem is not right.")
    open_tab(page, "fleet")
    speed = page.locator("#field-fleet-0-speed_kmh")
    expect(page.locator("#field-fleet-0-speed_kmh-error")).to_contain_text("at least 1")
    expect(page.locator("#room-fleet .count")).to_be_visible()
    open_tab(page, "costs")
    place = "Vehicle type truck \u203a Speed km/h"
    page.get_by_role("alert").get_by_role("button", name=place).click()
    expect(speed).to_be_focused()
    speed.fill("40")
    speed.press("Enter")
    expect(page.locator("#field-fleet-0-speed_kmh-error")).to_have_count(0)
    open_tab(page, "customers")
    expect(page.locator("td.invalid")).to_have_attribute("title", re.compile("at least 0"))
