"""Addresses that nobody looks up, and the depot, are put on a map in the dialog."""

import re

import pytest
from playwright.sync_api import Locator, Page, expect

from tests.console.steps import open_file, planned, state
from tests.console.test_importing import SHEET, dialog, read_anew, use
from tests.console.test_everyone import findings

pytestmark = [pytest.mark.slow, pytest.mark.one_page, pytest.mark.thorough]

ADDRESSES = """Name,Street,Zip,Town,kg
Anna,Ring 1,10000,Adorf,5
Ben,Ring 2,10000,Adorf,7
Cleo,Ring 2,10000,Adorf,1
"""


def click_map(page: Page, x: int, y: int) -> None:
    """Click the dialog's map."""
    page.locator(".import-map .map").click(position={"x": x, "y": y})


def address(page: Page, name: str) -> Locator:
    """Return an address in the dialog's list, by whose it is."""
    return page.locator(".import-map li button", has_text=name)


def test_addresses_and_the_depot_are_placed_by_clicks_at_any_width(page: Page) -> None:
    open_file(page, "addresses.csv", ADDRESSES)
    shown = dialog(page)
    expect(shown.get_by_text("Click where the depot is.")).to_be_visible()
    click_map(page, 120, 100)
    expect(address(page, "Anna")).to_have_attribute("aria-pressed", "true")
    expect(page.locator("#use-import")).to_be_disabled()
    assert findings(page, impacts=None) == []
    page.set_viewport_size({"width": 1024, "height": 844})
    assert findings(page, impacts=None) == []
    click_map(page, 150, 110)
    expect(address(page, "Ben, Cleo")).to_have_attribute("aria-pressed", "true")
    page.set_viewport_size({"width": 390, "height": 844})
    assert findings(page, impacts=None) == []
    click_map(page, 160, 140)
    use(page)
    planned(page, "3 of 3 served")
    request = state(page, "state.request")
    places = [customer["location"] for customer in request["customers"]]
    assert places[1] == places[2] != places[0]
    assert all(isinstance(number, float) for place in places for number in place)
    assert request["customers"][0]["info"]["address"] == "Ring 1, 10000 Adorf"


def test_rows_without_a_place_are_left_out_only_if_that_is_said(page: Page) -> None:
    head, anna, ben, cleo = ADDRESSES.splitlines()
    rows = (f"{head},lat,lon", f"{anna},47.38,8.54", f"{ben},,", f"{cleo},,")
    open_file(page, "addresses.csv", "\n".join(rows))
    shown = dialog(page)
    expect(shown.get_by_text("1 address without a place")).to_be_visible()
    expect(page.locator("#use-import")).to_be_disabled()
    expect(shown.get_by_text("Place the addresses on the map, or leave them out.")).to_be_visible()
    shown.get_by_label("Leave them out").check()
    use(page)
    planned(page, "1 of 1 served")


def test_places_are_written_as_well_and_known_the_next_time(page: Page) -> None:
    open_file(page, "addresses.csv", ADDRESSES)
    shown = dialog(page)
    page.locator("#import-depot").fill("47.37, 8.53")
    page.locator("#import-depot").press("Tab")
    read_anew(page)
    for place in ("nowhere", "47.38, 8.54", "47.39 8.51"):
        page.locator("#import-place").fill(place)
        page.locator("#import-place").press("Tab")
    expect(shown.get_by_text("0 addresses without a place")).to_be_visible()
    use(page)
    planned(page, "3 of 3 served")
    assert state(page, "state.request.customers.1.location") == [8.51, 47.39]
    open_file(page, "tomorrow.csv", ADDRESSES.replace("Ben", "Dora"))
    expect(dialog(page).get_by_text("0 addresses without a place")).to_be_visible()
    use(page)
    planned(page, "3 of 3 served")


def test_a_click_on_the_map_says_where_the_depot_is(page: Page) -> None:
    open_file(page, "today.csv", SHEET)
    dialog(page)
    click_map(page, 60, 60)
    expect(page.locator("#import-depot")).to_have_value("")
    page.get_by_role("button", name="Put the depot on the map").click()
    click_map(page, 60, 60)
    expect(page.locator("#import-depot")).to_have_value(re.compile(r"^47\.\d+, 8\.\d+$"))
    read_anew(page)
    use(page)
    planned(page, "2 of 2 served")
    [depot] = state(page, "state.request.depots")
    assert 8.4 < depot["location"][0] < 8.54 < 47.3 < depot["location"][1]


def test_customers_without_a_place_are_placed_one_after_another_on_the_large_map(
        page: Page) -> None:
    customers = [{"id": name, "demand": [1], "location": {"address": f"{name} street"}}
                 for name in ("Anna", "Ben")]
    problem = {"coordinate_system": "geographic", "customers": customers,
               "depots": [{"id": "hub", "location": [8.53, 47.37]}],
               "fleet": [{"id": "van", "count": 1, "capacity": [5]}]}
    page.evaluate("""async (problem) => {
      const { openRequest } = await loaded(`actions.js`);
      openRequest(problem);
    }""", problem)
    doubted = page.locator("#doubted")
    expect(doubted).to_contain_text("2 without any")
    doubted.get_by_role("button", name="Anna").click()
    for x in (300, 340):
        page.locator(".map").first.click(position={"x": x, "y": 200})
    expect(doubted).to_have_count(0)
    assert state(page, "state.tool") is None
    places = [state(page, f"state.request.customers.{number}.location") for number in (0, 1)]
    assert places[0] != places[1]
    assert all(isinstance(place, list) for place in places)
